/** The present moment in numbers: block, axes, deviation in the workpiece and along the path. */

import { tr } from "../../words/index.ts";
import { fill, h } from "../../dom.ts";
import { number, withUnit } from "../../format.ts";
import type { Moment, SimulatedAxis } from "./answers.ts";

const DEVIATIONS: readonly [string, string, (m: Moment) => number | null | undefined][] = [
  ["dev-X", "X", (m) => m.off_tip_um[0]],
  ["dev-Y", "Y", (m) => m.off_tip_um[1]],
  ["dev-Z", "Z", (m) => m.off_tip_um[2]],
  ["dev-length", tr`length`, (m) => Math.hypot(...m.off_tip_um)],
  ["dev-feed", tr`feed`, (m) => m.along_path_um?.[0]],
  ["dev-normal", tr`normal`, (m) => m.along_path_um?.[1]],
  ["dev-binormal", tr`binorm.`, (m) => m.along_path_um?.[2]],
  ["dev-tilt", tr`tilt`, (m) => Math.hypot(...m.off_axis_urad)],
];

/** What the tip does now. */
function doing(moment: Moment): string {
  if (moment.waits) return tr`waits`;
  const speed = withUnit(moment.speed_mm_per_min, 0, "mm/min");
  return moment.rapid ? tr`rapid, ${speed}` : speed;
}

export class Readout {
  readonly element = h("section", { class: "panel readout", ariaLabel: tr`The present moment` });
  private axes: SimulatedAxis[] = [];
  private readonly place = h("span", { class: "muted", dataTest: "place" });
  private readonly block = h("code", { class: "readout-block", dataTest: "block" });
  private readonly speed = h("span", { dataTest: "speed" });
  private readonly cells = new Map<string, HTMLElement>();
  private readonly why: HTMLElement;

  /** `why`: shows what makes the deviation at the present block. */
  constructor(why: () => void) {
    this.why = h(
      "button",
      {
        type: "button",
        dataTest: "why-here",
        title: tr`What each error contributes at this block, and what slows it`,
        onclick: why,
      },
      tr`Why here?`,
    );
  }

  setAxes(axes: SimulatedAxis[]): void {
    this.axes = axes;
    this.cells.clear();
    const cell = (key: string): HTMLElement => {
      const td = h("td", { class: "number", dataTest: key });
      this.cells.set(key, td);
      return td;
    };
    const heading = (words: readonly string[]): HTMLElement =>
      h(
        "tr",
        {},
        words.map((word) => h("th", { class: "number" }, word)),
      );
    fill(
      this.element,
      h("div", { class: "readout-head" }, this.place, this.block, this.speed, this.why),
      h(
        "table",
        { class: "readout-axes" },
        h("thead", {}, heading(axes.map((a) => `${a.name} (${a.unit === "deg" ? "°" : a.unit})`))),
        h(
          "tbody",
          {},
          h(
            "tr",
            {},
            axes.map((a) => cell(`axis-${a.name}`)),
          ),
        ),
      ),
      h(
        "table",
        { class: "readout-deviation" },
        h("caption", {}, tr`Deviation of the tool tip (µm) and tilt of the tool (µrad)`),
        h("thead", {}, heading(DEVIATIONS.map(([, word]) => word))),
        h(
          "tbody",
          {},
          h(
            "tr",
            { class: "deviation-row" },
            DEVIATIONS.map(([key]) => cell(key)),
          ),
        ),
      ),
    );
  }

  clear(): void {
    fill(this.element);
  }

  show(moment: Moment, block: string): void {
    const place = moment.line > 0 ? tr`line ${moment.line}` : tr`start`;
    this.place.textContent = moment.tool === null ? place : `${place}, T${moment.tool}`;
    this.block.textContent = block;
    this.block.title = block;
    this.speed.textContent = doing(moment);
    for (const axis of this.axes) {
      const at = moment.axes[axis.name];
      const cell = this.cells.get(`axis-${axis.name}`);
      if (!cell) continue;
      cell.textContent = number(at, 4);
      cell.classList.toggle(
        "outside",
        axis.travel !== null && at !== undefined && (at < axis.travel[0] || at > axis.travel[1]),
      );
    }
    for (const [key, , value] of DEVIATIONS) {
      const cell = this.cells.get(key);
      if (cell) cell.textContent = number(value(moment), 1);
    }
  }
}
