/** The tool path in the picture: coloured by deviation, feed or axis load; finer in a window of time. */

import { tr } from "../../words/index.ts";
import { latestOnly } from "../../api.ts";
import { h } from "../../dom.ts";
import { clock, clockUnit, mm } from "../../format.ts";
import type { Frame } from "../../frame.ts";
import type { MachineView } from "../../scene/view.ts";
import type { Colour, PathHeader, Simulation } from "./answers.ts";

const COLOURS: readonly [Colour, string, string][] = [
  ["deviation", tr`deviation`, tr`Distance of the actual tip from the nominal tip`],
  ["feed", tr`feed`, tr`Velocity of the tip along the path`],
  ["load", tr`axis load`, tr`Largest share of its velocity limit that any axis uses`],
];
/** Enough for a picture; more are fetched for a window of time. */
const MOST_POINTS = 200_000;

interface Asked {
  simulation: Simulation;
  colour: Colour;
  window_s: [number, number] | null;
}

export class ToolPath {
  readonly control: HTMLElement;
  private readonly view: MachineView;
  private simulation: Simulation | null = null;
  private colour: Colour = "deviation";
  /** The user has said what the colour shows. */
  private picked = false;
  private window_s: [number, number] | null = null;
  private time_s: Float64Array = new Float64Array();
  private now_s = 0;
  private readonly ask = latestOnly<Asked, Frame<PathHeader>>(
    ({ simulation, colour, window_s }) =>
      simulation.path(colour, Math.min(MOST_POINTS, this.view.mostPathPoints), window_s),
    (frame, asked) => this.answered(frame, asked),
    (error) => this.failed(error),
  );
  private readonly failed: (error: unknown) => void;
  private readonly changed: () => void;

  constructor(view: MachineView, failed: (error: unknown) => void, changed: () => void) {
    this.view = view;
    this.failed = failed;
    this.changed = changed;
    const buttons = COLOURS.map(([colour, word, title]) =>
      h(
        "button",
        { title, dataColour: colour, ariaPressed: String(colour === this.colour), onclick: () => this.pick(colour) },
        word,
      ),
    );
    this.control = h(
      "div",
      { class: "scene-control" },
      h("span", { class: "muted" }, tr`Path by`),
      h("span", { class: "group", role: "group", ariaLabel: tr`What the colour of the path shows` }, buttons),
      h(
        "button",
        {
          title: tr`Show the path as large as the picture; Fit shows the machine again`,
          dataTest: "look-at-path",
          onclick: () => view.fitPath(),
        },
        tr`Look at it`,
      ),
    );
  }

  setSimulation(simulation: Simulation | null): void {
    this.simulation = simulation;
    // A machine without errors has no deviation to look at.
    if (simulation && !this.picked)
      this.show(simulation.header.document.deviation.tip_um.value > 0 ? "deviation" : "feed");
    this.window_s = null;
    this.time_s = new Float64Array();
    this.view.setPath(null);
    this.view.overlay.note("path", null);
    this.request();
  }

  setWindow(window_s: [number, number] | null): void {
    this.window_s = window_s;
    this.request();
  }

  /** What is done by now is bright; before the first move all of it is, as a preview. */
  setTime(time_s: number): void {
    this.now_s = time_s;
    let [done, above] = [0, this.time_s.length];
    while (done < above) {
      const middle = (done + above) >> 1;
      if ((this.time_s[middle] as number) <= time_s) done = middle + 1;
      else above = middle;
    }
    this.view.setPathProgress(time_s > 0 ? done : this.time_s.length);
  }

  private pick(colour: Colour): void {
    this.take(colour);
    this.changed();
  }

  /** For the address; null while the user has not chosen. */
  get state(): Colour | null {
    return this.picked ? this.colour : null;
  }

  /** As an address says. */
  take(wanted: string | undefined): void {
    const colour = COLOURS.find(([key]) => key === wanted)?.[0];
    if (!colour || (this.picked && colour === this.colour)) return;
    this.picked = true;
    this.show(colour);
    this.request();
  }

  private show(colour: Colour): void {
    this.colour = colour;
    for (const button of this.control.querySelectorAll<HTMLElement>("[data-colour]"))
      button.setAttribute("aria-pressed", String(button.dataset.colour === colour));
  }

  private request(): void {
    if (this.simulation) this.ask({ simulation: this.simulation, colour: this.colour, window_s: this.window_s });
  }

  private answered(frame: Frame<PathHeader>, { simulation, colour, window_s }: Asked): void {
    if (simulation !== this.simulation) return;
    const { header } = frame;
    this.time_s = frame.f64("time_s");
    const rapid = frame.u8("rapid");
    const deviations = frame.f32("off_um").map((um) => um / 1000);
    this.view.setPath(
      {
        positions: frame.f32("tip_mm"),
        origin: header.origin_mm,
        values: frame.f32("value"),
        rapid,
        deviations,
        range: [header.low, header.high],
      },
      header.low === header.high
        ? undefined
        : { title: COLOURS.find(([key]) => key === colour)?.[1] ?? header.title, unit: header.unit },
    );
    const part = window_s
      ? tr`path from ${clock(window_s[0])} to ${clock(window_s[1])}${clockUnit(window_s[1])}`
      : null;
    const coarse = header.complete ? null : tr`path drawn within ${mm(header.chord_mm, 3)}`;
    this.view.overlay.note("path", [part, coarse].filter(Boolean).join(", ") || null);
    this.setTime(this.now_s);
  }
}
