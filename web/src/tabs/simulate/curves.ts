/** Axis positions, velocities and deviations over time: least and greatest in each step, finer in a window. */

import { tr, trText } from "../../words/index.ts";
import { latestOnly } from "../../api.ts";
import { fill, h } from "../../dom.ts";
import { number, withUnit } from "../../format.ts";
import type { Frame } from "../../frame.ts";
import { timePlot, type TimeMark, type TimePlot, type TimePlotSpec } from "../../plot/timeplot.ts";
import type { CurvesHeader, Quantity, Simulation } from "./answers.ts";

const COLUMNS = 600;
const FIRST_SHOWN = ["tip", "path.speed", "X", "X.speed"];
/** Words of the buttons for what is not an axis. */
const SHORT: Record<string, string> = {
  "path.speed": tr`speed`,
  tip: tr`deviation`,
  feed: tr`feed`,
  normal: tr`normal`,
  binormal: tr`binormal`,
  axis: tr`tilt`,
};

interface Asked {
  simulation: Simulation;
  keys: string[];
  window_s: [number, number] | null;
}

export interface CurvesOwner {
  seek(time_s: number): void;
  zoomed(window_s: [number, number] | null): void;
  /** Other curves are shown. */
  chosen(): void;
  failed(error: unknown): void;
}

/** The titles of an axis have its name in them. */
function titleOf({ key, title }: Quantity): string {
  const axis = key.replace(/\.speed$/, "");
  if (title === `Position of ${axis}`) return tr`Position of ${axis}`;
  if (title === `Speed of ${axis}`) return tr`Speed of ${axis}`;
  return trText(title);
}

export class Curves {
  readonly element: HTMLElement;
  private readonly choice = h("div", { class: "curves-choice" });
  private readonly plots_place = h("div", { class: "curves-plots" });
  private readonly whole = h(
    "button",
    {
      class: "curves-whole",
      hidden: true,
      title: tr`Show the whole time again (double click)`,
      dataTest: "whole-time",
      onclick: () => this.zoomOut(),
    },
    tr`Whole time`,
  );
  private readonly plots = new Map<string, TimePlot>();
  private readonly owner: CurvesOwner;
  private simulation: Simulation | null = null;
  private shown = FIRST_SHOWN;
  private window_s: [number, number] | null = null;
  private now_s = 0;
  private readonly ask = latestOnly<Asked, Frame<CurvesHeader>>(
    ({ simulation, keys, window_s }) => simulation.curves(keys, COLUMNS, window_s),
    (frame, asked) => this.answered(frame, asked),
    (error) => this.owner.failed(error),
  );

  constructor(owner: CurvesOwner) {
    this.owner = owner;
    this.element = h("section", { class: "curves", ariaLabel: tr`Curves over time` }, this.choice, this.plots_place);
  }

  setSimulation(simulation: Simulation): void {
    this.clear();
    this.simulation = simulation;
    const keys = simulation.header.quantities.map((q) => q.key);
    this.shown = this.shown.filter((key) => keys.includes(key));
    if (this.shown.length === 0) this.shown = keys.slice(0, 2);
    this.showChoice();
    this.request();
  }

  clear(): void {
    for (const plot of this.plots.values()) plot.dispose();
    this.plots.clear();
    this.simulation = null;
    this.window_s = null;
    this.whole.hidden = true;
    fill(this.choice);
  }

  setTime(time_s: number): void {
    this.now_s = time_s;
    for (const plot of this.plots.values()) plot.setTime(time_s);
  }

  private zoomOut(): void {
    for (const plot of this.plots.values()) plot.zoom(null);
    this.zoomed(null);
  }

  private zoomed(window_s: [number, number] | null): void {
    const end = this.simulation?.header.duration_s ?? 0;
    this.window_s = window_s && [Math.max(0, window_s[0]), Math.min(end, window_s[1])];
    this.whole.hidden = this.window_s === null;
    this.request();
    this.owner.zoomed(this.window_s);
  }

  private request(): void {
    if (this.simulation && this.shown.length > 0 && this.simulation.header.duration_s > 0)
      this.ask({ simulation: this.simulation, keys: this.shown, window_s: this.window_s });
  }

  private answered(frame: Frame<CurvesHeader>, { simulation, keys, window_s }: Asked): void {
    if (simulation !== this.simulation) return;
    const { from_s, to_s, columns } = frame.header;
    const [low, high] = [frame.f32("low"), frame.f32("high")];
    const time_s = Float64Array.from({ length: columns }, (_, i) => from_s + ((i + 0.5) * (to_s - from_s)) / columns);
    keys.forEach((key, i) => {
      const quantity = simulation.header.quantities.find((q) => q.key === key);
      if (!quantity || !this.shown.includes(key)) return;
      const part = (values: Float32Array): Float64Array =>
        Float64Array.from(values.subarray(i * columns, (i + 1) * columns));
      this.showPlot(key, this.spec(quantity, time_s, part(low), part(high)), window_s);
    });
  }

  private spec(quantity: Quantity, time_s: Float64Array, low: Float64Array, high: Float64Array): TimePlotSpec {
    const { unit, limits, key } = quantity;
    const title = titleOf(quantity);
    const marks: TimeMark[] = (this.simulation?.header.marks ?? [])
      .filter((m) => m.grave)
      .map((m) => ({ time_s: m.time_s, label: trText(m.text), kind: "error" }));
    const labels = key.endsWith(".speed")
      ? [tr`least velocity`, tr`greatest velocity`]
      : [tr`least travel`, tr`greatest travel`];
    const lines = (limits ?? []).map((value, i) => ({ value, label: labels[i] ?? "" }));
    // Their names are headings of the CSV file.
    const series = [
      { name: "least", values: low, colour: 0 },
      { name: "greatest", values: high, colour: 0, filled: true },
    ];
    const digits = unit === "mm" || unit === "deg" ? 3 : unit === "mm/min" ? 0 : 1;
    const readout = (i: number): string => {
      const [least, greatest] = [number(low[i], digits), withUnit(high[i], digits, unit)];
      return greatest.startsWith(least) ? greatest : `${least} … ${greatest}`;
    };
    return { title, unit, digits, time_s, series, limits: lines, marks, readout, height: 118 };
  }

  private showPlot(key: string, spec: TimePlotSpec, window_s: [number, number] | null): void {
    let plot = this.plots.get(key);
    if (plot) plot.update(spec);
    else {
      plot = timePlot(this.plots_place, spec, {
        group: "simulate",
        onpick: (time_s) => this.owner.seek(time_s),
        onzoom: (range) => this.zoomed(range),
      });
      plot.element.dataset.quantity = key;
      this.plots.set(key, plot);
      if (window_s) plot.zoom(window_s);
    }
    plot.setTime(this.now_s);
  }

  private showChoice(): void {
    const all = this.simulation?.header.quantities ?? [];
    const axes = this.simulation?.header.axes.map((a) => a.name) ?? [];
    const group = (title: string, list: Quantity[], word: (q: Quantity) => string): HTMLElement | null =>
      list.length === 0
        ? null
        : h(
            "span",
            { class: "curves-group" },
            h("span", { class: "muted" }, title),
            h(
              "span",
              { class: "group", role: "group", ariaLabel: title },
              list.map((q) => this.chip(q, word(q))),
            ),
          );
    fill(
      this.choice,
      group(
        tr`Position`,
        all.filter((q) => axes.includes(q.key)),
        (q) => q.key,
      ),
      group(
        tr`Velocity`,
        all.filter((q) => axes.some((a) => q.key === `${a}.speed`)),
        (q) => q.key.replace(".speed", ""),
      ),
      group(
        tr`Tip`,
        all.filter((q) => !axes.includes(q.key.replace(".speed", ""))),
        (q) => SHORT[q.key] ?? q.key,
      ),
      this.whole,
    );
  }

  private chip(quantity: Quantity, word: string): HTMLElement {
    const { key, unit } = quantity;
    const title = titleOf(quantity);
    const chip = h(
      "button",
      {
        ariaPressed: String(this.shown.includes(key)),
        title: `${title} (${unit})`,
        ariaLabel: `${word}: ${title}, ${unit}`,
        dataKey: key,
        onclick: () => this.toggle(key, chip),
      },
      word,
    );
    return chip;
  }

  private toggle(key: string, chip: HTMLElement): void {
    const on = !this.shown.includes(key);
    this.shown = on ? [...this.shown, key] : this.shown.filter((k) => k !== key);
    chip.setAttribute("aria-pressed", String(on));
    if (on) this.request();
    else {
      this.plots.get(key)?.dispose();
      this.plots.delete(key);
    }
    this.owner.chosen();
  }

  /** For the address; null: those at the beginning. */
  get state(): string | null {
    const keys = this.shown.join(",");
    return keys === FIRST_SHOWN.join(",") ? null : keys || "none";
  }

  /** The curves that an address names, if the simulation has them. */
  take(wanted: string | undefined): void {
    if (wanted === undefined || wanted === (this.state ?? FIRST_SHOWN.join(","))) return;
    const all = this.simulation?.header.quantities.map((q) => q.key) ?? [];
    this.shown = wanted.split(",").filter((key) => all.includes(key));
    for (const [key, plot] of this.plots) {
      if (this.shown.includes(key)) continue;
      plot.dispose();
      this.plots.delete(key);
    }
    this.showChoice();
    this.request();
  }
}
