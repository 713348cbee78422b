/** What the server says about one simulation, typed. */

import type { App } from "../../app.ts";
import type { Diagnostic, Model, SurfaceModel, Vector } from "../../api.ts";
import type { Frame } from "../../frame.ts";
import { modelsOf } from "../../scene/models.ts";

/** A place in the program where a number is largest. */
interface Worst {
  value: number;
  line: number;
  program: number;
  time_s: number;
}

/** The document of `trueaxis simulate --format json`, as far as the page prints it. */
export interface SimulationDocument {
  machine: { name: string; chain: string };
  control: string;
  set_up_given: boolean;
  time_s: number;
  rapid_s: number;
  dwell_s: number;
  feed_mm: number;
  moves: number;
  deviation: {
    tip_um: Worst;
    tip_rms_um: number;
    feed_um: Worst;
    normal_um: Worst;
    binormal_um: Worst;
    axis_urad: Worst;
  };
  troubles_left_out: number;
}

export interface SimulatedAxis {
  name: string;
  unit: "mm" | "deg";
  travel: [number, number] | null;
  /** mm/s or deg/s; null where the machine file states none. */
  velocity: number | null;
  acceleration: number | null;
}

export interface Quantity {
  key: string;
  title: string;
  unit: string;
  limits?: [number, number] | null;
}

export interface Mark {
  kind: string;
  grave: boolean;
  time_s: number;
  until_s: number | null;
  text: string;
  program: number;
  line: number;
}

export interface SetUpTool {
  tool: number;
  name: string;
  /** The tip in the body of the tool holder. */
  tip_mm: Vector;
  /** Diameter and length of its cylinders, from the tip upwards; empty where nothing is stated. */
  segments_mm: [number, number][];
}

export interface SimulationHeader {
  simulation: number;
  document: SimulationDocument;
  duration_s: number;
  nodes: number;
  kept: number;
  thinned: boolean;
  axes: SimulatedAxis[];
  quantities: Quantity[];
  programs: { name: string; path: string | null; lines: number }[];
  marks: Mark[];
  bodies: string[];
  tools: SetUpTool[];
  /** Stock, part and fixtures of the set-up. */
  on_workpiece: SurfaceModel[];
  diagnostics: Diagnostic[];
}

/** Where everything is at one time. */
export interface Moment {
  time_s: number;
  program: number;
  line: number;
  axes: Record<string, number>;
  /** From which side each axis came: +1, −1, 0 where it has not moved. */
  approach: Record<string, number>;
  /** The nominal tip in the workpiece frame. */
  tip_mm: Vector;
  off_tip_um: Vector;
  off_axis_urad: Vector;
  /** Feed, normal, binormal; null where the tip stands. */
  along_path_um: Vector | null;
  speed_mm_per_min: number;
  rapid: boolean;
  waits: boolean;
  tool: number | null;
}

export type Colour = "deviation" | "feed" | "load";

export interface PathHeader {
  origin_mm: Vector;
  unit: string;
  title: string;
  low: number;
  high: number;
  chord_mm: number;
  complete: boolean;
}

export interface CurvesHeader {
  from_s: number;
  to_s: number;
  columns: number;
  quantities: string[];
}

/** What is to be simulated. */
export interface Job {
  machine: string;
  /** A file of the project, or one that was dropped. */
  program: string | { name: string; text: string };
  /** Without one the file beside the program. */
  setup?: string | undefined;
  control?: string | undefined;
  keep_going?: boolean;
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
    const { program, ...rest } = job;
    const body = typeof program === "string" ? { ...rest, program } : { ...rest, ...program };
    const frame = await app.api.ask<Frame<SimulationHeader>>("simulate", body, {
      onProgress: watch.progress,
      signal: watch.signal,
    });
    return new Simulation(app, frame);
  }

  at(time_s: number): Promise<Frame<{ moment: Moment }>> {
    return this.ask("simulation-at", { time_s });
  }

  async step(from_s: number, step: "next" | "previous"): Promise<number> {
    return (await this.ask<{ time_s: number }>("simulation-block", { from_s, step })).time_s;
  }

  async timeOf(program: number, line: number): Promise<number> {
    return (await this.ask<{ time_s: number }>("simulation-block", { program, line })).time_s;
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

  private ask<T>(name: string, body: object): Promise<T> {
    return this.app.api.ask<T>(name, { simulation: this.header.simulation, ...body });
  }
}
