/** The last hours: of each axis what the tool was off before and after the correction, and the temperatures. */

import { tr } from "../../words/index.ts";
import type { LiveHistory } from "../../../types.d.ts";
import { fill, h } from "../../dom.ts";
import { number } from "../../format.ts";
import { timePlot, type TimePlot, type TimePlotSpec } from "../../plot/timeplot.ts";
import { unitOf } from "./words.ts";

/** Between two lines that are further apart than this no run was going on, s; or three times what is usual here. */
const GAP_S = 60;

/** Where a line of the history is followed by a gap. */
export function gapsIn(date_s: readonly number[]): Set<number> {
  const steps = date_s.slice(1).map((at, i) => at - (date_s[i] ?? at));
  const usual = [...steps].sort((a, b) => a - b)[steps.length >> 1] ?? 0;
  return new Set(steps.flatMap((step, i) => (step > Math.max(GAP_S, 3 * usual) ? [i] : [])));
}

/** The values with a hole in each gap, so that no curve leads over it. */
function withHoles(values: readonly (number | null)[], holes: ReadonlySet<number>): Float64Array {
  return Float64Array.from(
    values.flatMap((v, i) => (holes.has(i) ? [v ?? Number.NaN, Number.NaN] : [v ?? Number.NaN])),
  );
}

/** Hours before the last line; the time of a hole is in the middle of its gap. */
export function hoursBefore(date_s: readonly number[], holes: ReadonlySet<number>): Float64Array {
  const last = date_s[date_s.length - 1] ?? 0;
  const hours = (at: number): number => (at - last) / 3600;
  return Float64Array.from(
    date_s.flatMap((at, i) => (holes.has(i) ? [hours(at), hours((at + (date_s[i + 1] ?? at)) / 2)] : [hours(at)])),
  );
}

/** The names of the curves in their colours. */
function legend(names: readonly [string, number][]): HTMLElement {
  return h(
    "span",
    { class: "live-legend" },
    names.map(([name, colour]) => h("span", { style: { "--colour": `var(--series-${colour + 1})` } }, name)),
  );
}

export class Shift {
  readonly element = h("div", { class: "live-shift" });
  private readonly plots = new Map<string, TimePlot>();

  clear(): void {
    for (const plot of this.plots.values()) plot.dispose();
    this.plots.clear();
    fill(this.element);
  }

  show(history: LiveHistory | null): void {
    if (!history || history.date_s.length < 2) {
      this.clear();
      if (history) fill(this.element, h("p", { class: "muted note" }, tr`The history begins after some ten seconds.`));
      return;
    }
    const holes = gapsIn(history.date_s);
    const time_s = hoursBefore(history.date_s, holes);
    const curve = (values: readonly (number | null)[]): Float64Array => withHoles(values, holes);
    const specs = new Map<string, TimePlotSpec>();
    for (const axis of history.axes) {
      const unit = unitOf(axis.unit);
      const one = (value: number | null): string => (value === null ? "–" : number(value, 1));
      specs.set(axis.axis, {
        title: tr`${axis.axis}: off by the model, before ${one(axis.before_max)} at most, ${one(axis.before_rms)} rms; after ${one(axis.left_max)} at most, ${one(axis.left_rms)} rms`,
        unit,
        digits: 1,
        time_s,
        time_unit: "h",
        series: [
          { name: tr`before`, values: curve(axis.before), colour: 1 },
          { name: tr`after`, values: curve(axis.left), colour: 0 },
        ],
        height: 150,
      });
    }
    if (history.sensors.length > 0)
      specs.set("°C", {
        title: tr`Temperatures`,
        unit: "°C",
        digits: 2,
        time_s,
        time_unit: "h",
        series: history.sensors.map((sensor) => ({ name: sensor.sensor, values: curve(sensor.celsius) })),
        height: 130,
      });
    for (const [key, plot] of this.plots)
      if (!specs.has(key)) {
        plot.dispose();
        this.plots.delete(key);
      }
    if (this.plots.size === 0) fill(this.element);
    for (const [key, spec] of specs) {
      const there = this.plots.get(key);
      if (there) there.update(spec);
      else {
        const plot = timePlot(this.element, spec, { group: "live" });
        plot.element.dataset.quantity = key;
        plot.element.append(legend(spec.series.map((one, i) => [one.name, one.colour ?? i])));
        this.plots.set(key, plot);
      }
    }
  }
}
