/** What the server says about one simulation, typed. */

import type { App } from "../../app.ts";
import type {
  ServeSimulate,
  ServeSimulationAt,
  ServeSimulationCurves,
  ServeSimulationPath,
  ServeSimulationPathRequest,
  ServeSimulationStock,
} from "../../../types.d.ts";
import type { Model, Question, Reply, Request } from "../../api.ts";
import type { Frame } from "../../frame.ts";
import { sameFiles } from "../../api.ts";
import { modelsOf } from "../../scene/models.ts";

export type SimulationHeader = ServeSimulate;
export type SimulationDocument = ServeSimulate["document"];
export type SimulatedAxis = ServeSimulate["axes"][number];
export type Quantity = ServeSimulate["quantities"][number];
export type Mark = ServeSimulate["marks"][number];
export type SetUpTool = ServeSimulate["tools"][number];
/** Where everything is at one time. */
export type Moment = ServeSimulationAt["moment"];
export type Colour = ServeSimulationPathRequest["colour"];
export type StockHeader = ServeSimulationStock;
export type PathHeader = ServeSimulationPath;
export type CurvesHeader = ServeSimulationCurves;

/** Questions about a simulation. */
type About = Extract<Question, `simulation-${string}`>;

/** What is to be simulated. */
export interface Job {
  machine: string;
  /** A file of the project, or one that was dropped. */
  program: string | { name: string; text: string };
  /** Without one the file beside the program. */
  setup?: string | undefined;
  control?: string | undefined;
  /** False: blocks with `/` are left out. */
  optional_blocks?: boolean;
  keep_going?: boolean;
}

/** As the server is asked. */
export function bodyOf<J extends Pick<Job, "program">>({ program, ...rest }: J) {
  return typeof program === "string" ? { ...rest, program } : { ...rest, ...program };
}

export interface Watch {
  progress: (share: number) => void;
  signal: AbortSignal;
}

/** The questions about one machine and program. */
export class Simulation {
  readonly header: SimulationHeader;
  readonly on_workpiece: Model[];
  private readonly app: App;

  constructor(app: App, frame: Frame<SimulationHeader>) {
    this.app = app;
    this.header = frame.header;
    this.on_workpiece = modelsOf(frame.header.on_workpiece, frame.f32("corners_mm"));
  }

  static async run(app: App, job: Job, watch: Watch): Promise<Simulation> {
    const body = bodyOf(job);
    const frame = await app.api.ask("simulate", body, {
      onProgress: watch.progress,
      signal: watch.signal,
    });
    return sameFiles(new Simulation(app, frame), frame);
  }

  at(time_s: number): Promise<Frame<{ moment: Moment }>> {
    return this.ask("simulation-at", { time_s });
  }

  stock(time_s: number, signal: AbortSignal): Promise<Frame<StockHeader>> {
    return this.app.api.ask("simulation-stock", { simulation: this.header.simulation, time_s }, { signal });
  }

  async step(from_s: number, step: "next" | "previous"): Promise<number> {
    return (await this.ask("simulation-block", { from_s, step })).time_s;
  }

  async timeOf(program: number, line: number): Promise<number> {
    return (await this.ask("simulation-block", { program, line })).time_s;
  }

  path(colour: Colour, points: number, window_s: [number, number] | null): Promise<Frame<PathHeader>> {
    return this.ask("simulation-path", {
      colour,
      points,
      ...(window_s ? { from_s: window_s[0], to_s: window_s[1] } : {}),
    });
  }

  curves(quantities: string[], columns: number, window_s: [number, number] | null): Promise<Frame<CurvesHeader>> {
    const [from_s, to_s] = window_s ?? [0, this.header.duration_s];
    return this.ask("simulation-curves", { from_s, to_s, columns, quantities });
  }

  source(program: number): Promise<{ name: string; text: string }> {
    return this.ask("simulation-source", { program });
  }

  private ask<N extends About>(name: N, body: Omit<Request<N>, "simulation">): Promise<Reply<N>> {
    return this.app.api.ask(name, { simulation: this.header.simulation, ...body } as Request<N>);
  }
}
