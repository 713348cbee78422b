/** Time series on uPlot: stacked plots with one cursor and one zoom, limits, min/max envelopes. */

import { tr } from "../words/index.ts";
import uPlot from "uplot";
import "uplot/dist/uPlot.min.css";
import { h, perFrame } from "../dom.ts";
import { csvOf, exportMenu, type Column } from "../figure/figure.ts";
import { number, withUnit } from "../format.ts";
import { cssColour, onTheme } from "../theme.ts";

export interface TimeSeries {
  name: string;
  values: ArrayLike<number>;
  /** Least and greatest within each step of time, where the values were thinned out. */
  low?: ArrayLike<number>;
  high?: ArrayLike<number>;
  /** Index into the series colours; default its place. */
  colour?: number;
  /** Filled down to the series before: least and greatest as two series. */
  filled?: boolean;
}

export interface TimeLimit {
  value: number;
  label: string;
}

export interface TimeMark {
  time_s: number;
  label: string;
  kind: "error" | "warning" | "note";
}

export interface TimePlotSpec {
  title: string;
  unit: string;
  digits?: number;
  time_s: ArrayLike<number>;
  /** What the times are in, if not in seconds. */
  time_unit?: string;
  series: TimeSeries[];
  limits?: TimeLimit[];
  marks?: TimeMark[];
  /** What is said about the values under the cursor; default every series by its name. */
  readout?: (index: number) => string;
  /** px without the title; default 130. */
  height?: number;
}

export interface TimePlotOptions {
  /** Plots of one group share cursor and zoom. */
  group?: string;
  /** The user clicked at this time. */
  onpick?: (time_s: number) => void;
  /** The user zoomed; null is the whole duration. Ask the server for finer data here. */
  onzoom?: (range_s: [number, number] | null) => void;
}

export interface TimePlot {
  readonly element: HTMLElement;
  update(spec: TimePlotSpec): void;
  /** Where the program stands now. */
  setTime(time_s: number | null): void;
  zoom(range_s: [number, number] | null): void;
  csvText(): string;
  dispose(): void;
}

/** The plots of each group, so that a zoom of one is a zoom of all. */
const groups = new Map<string, Set<TimePlotView>>();

/** What is not a number is a hole for uPlot only if it is null. */
function floats(values: ArrayLike<number>): (number | null)[] | Float64Array {
  const all = values instanceof Float64Array ? values : Float64Array.from(values);
  return all.some(Number.isNaN) ? Array.from(all, (v) => (Number.isNaN(v) ? null : v)) : all;
}

function dataOf(spec: TimePlotSpec): uPlot.AlignedData {
  const columns: ((number | null)[] | Float64Array)[] = [floats(spec.time_s)];
  for (const one of spec.series) {
    columns.push(floats(one.values));
    if (one.low && one.high) columns.push(floats(one.low), floats(one.high));
  }
  return columns as unknown as uPlot.AlignedData;
}

class TimePlotView implements TimePlot {
  readonly element: HTMLElement;
  private readonly place = h("div", { class: "timeplot-place" });
  private readonly title = h("figcaption", { class: "figure-title" });
  private readonly readout = h("span", { class: "muted timeplot-readout", ariaLive: "off" });
  private readonly now = h("div", { class: "timeplot-now", hidden: true });
  private plot: uPlot | null = null;
  private spec: TimePlotSpec;
  private readonly options: TimePlotOptions;
  private now_s: number | null = null;
  private range: [number, number] | null = null;
  private readonly watch: ResizeObserver;
  private readonly stop_theme: () => void;

  constructor(host: HTMLElement, spec: TimePlotSpec, options: TimePlotOptions) {
    this.spec = spec;
    this.options = options;
    const menu = exportMenu(() => this.spec.title, {
      png: () => this.png(),
      csv: () => this.csvText(),
      columns: () => this.columns(),
    });
    this.place.tabIndex = 0;
    // Its keys are its own: a screen reader hands them over.
    this.place.setAttribute("role", "application");
    this.place.addEventListener("keydown", (event) => this.key(event));
    this.element = h(
      "figure",
      { class: "figure timeplot" },
      h("div", { class: "figure-head" }, this.title, this.readout, menu),
      this.place,
    );
    host.append(this.element);
    if (options.group) groups.set(options.group, (groups.get(options.group) ?? new Set()).add(this));
    this.watch = new ResizeObserver(perFrame(() => this.resize()));
    this.watch.observe(this.place);
    this.stop_theme = onTheme(() => this.build());
    this.build();
  }

  update(spec: TimePlotSpec): void {
    const same =
      this.plot !== null &&
      spec.series.length === this.spec.series.length &&
      spec.series.every((one, i) => one.name === this.spec.series[i]?.name && !one.low === !this.spec.series[i]?.low);
    this.spec = spec;
    if (!same) this.build();
    else {
      this.plot?.setData(dataOf(spec), this.range === null);
      if (this.range) this.plot?.setScale("x", { min: this.range[0], max: this.range[1] });
    }
  }

  setTime(time_s: number | null): void {
    this.now_s = time_s;
    this.placeNow();
  }

  /** The present moment is an element of its own: the curves are not drawn again while playing. */
  private placeNow(): void {
    const plot = this.plot;
    if (!plot) return;
    if (this.now.parentElement !== plot.over) plot.over.append(this.now);
    const x = this.now_s === null ? -1 : plot.valToPos(this.now_s, "x");
    this.now.hidden = !(x >= 0 && x <= plot.bbox.width / devicePixelRatio);
    this.now.style.transform = `translateX(${x.toFixed(1)}px)`;
  }

  zoom(range_s: [number, number] | null): void {
    this.range = range_s;
    const time = this.spec.time_s;
    const [min, max] = range_s ?? [time[0] ?? 0, time[time.length - 1] ?? 1];
    this.plot?.setScale("x", { min, max });
  }

  csvText(): string {
    return csvOf(this.columns());
  }

  private columns(): Column[] {
    const { series, unit, time_s, time_unit = "s" } = this.spec;
    return [
      { heading: `time (${time_unit})`, shown: tr`time (${time_unit})`, values: time_s },
      ...series.flatMap((one) => [
        { heading: `${one.name} (${unit})`, values: one.values },
        ...(one.low && one.high
          ? [
              {
                heading: `${one.name} least (${unit})`,
                shown: tr`${one.name} least (${unit})`,
                values: one.low,
              },
              {
                heading: `${one.name} greatest (${unit})`,
                shown: tr`${one.name} greatest (${unit})`,
                values: one.high,
              },
            ]
          : []),
      ]),
    ];
  }

  dispose(): void {
    this.watch.disconnect();
    this.stop_theme();
    if (this.options.group) groups.get(this.options.group)?.delete(this);
    this.plot?.destroy();
    this.element.remove();
  }

  private build(): void {
    this.plot?.destroy();
    this.title.textContent = this.spec.title;
    this.place.setAttribute(
      "aria-label",
      tr`${this.spec.title}, ${this.spec.unit}, over time. Arrow keys move the cursor, Enter goes there, plus and minus zoom.`,
    );
    this.plot = new uPlot(this.config(), dataOf(this.spec), this.place);
    if (this.range) this.zoom(this.range);
  }

  private config(): uPlot.Options {
    const ink = cssColour("--muted");
    const line = cssColour("--line");
    const { group } = this.options;
    const series: uPlot.Series[] = [{ label: tr`time` }];
    const bands: uPlot.Band[] = [];
    this.spec.series.forEach((one, i) => {
      const colour = cssColour(`--series-${((one.colour ?? i) % 7) + 1}`);
      series.push({ label: one.name, stroke: colour, width: 1.4, points: { show: false } });
      if (one.filled && series.length > 2)
        bands.push({ series: [series.length - 1, series.length - 2], fill: `${colour}38` });
      if (!one.low || !one.high) return;
      series.push(
        { stroke: "transparent", points: { show: false } },
        { stroke: "transparent", points: { show: false } },
      );
      bands.push({ series: [series.length - 1, series.length - 2], fill: `${colour}38` });
    });
    const axis = {
      stroke: ink,
      grid: { stroke: line, width: 0.7 },
      ticks: { stroke: line, width: 0.7 },
      font: "11px system-ui, sans-serif",
    };
    return {
      width: Math.max(80, this.place.clientWidth),
      height: this.spec.height ?? 130,
      legend: { show: false },
      scales: { x: { time: false }, y: { range: (_, low, high) => this.tall(low, high) } },
      axes: [
        {
          ...axis,
          size: 28,
          values: (_, values) => values.map((v) => withUnit(v, v % 1 === 0 ? 0 : 2, this.spec.time_unit ?? "s")),
        },
        {
          ...axis,
          size: 58,
          space: 18,
          values: (_, values, __, ___, step) =>
            values.map((v) => number(v, Math.max(0, -Math.floor(Math.log10(step) + 1e-9)))),
        },
      ],
      series,
      bands,
      cursor: {
        y: false,
        drag: { x: true, y: false, setScale: false },
        points: { size: 6 },
        ...(group ? { sync: { key: group, setSeries: false } } : {}),
      },
      hooks: {
        setCursor: [(plot) => this.showReadout(plot)],
        setSelect: [(plot) => this.selected(plot)],
        draw: [(plot) => this.drawOver(plot)],
        ready: [(plot) => this.listen(plot)],
      },
    };
  }

  /** Limits stay in sight if they are not far off. */
  private tall(low: number, high: number): [number, number] {
    if (!Number.isFinite(low) || !Number.isFinite(high)) return [0, 1];
    const span = high - low || Math.abs(high) || 1;
    for (const { value } of this.spec.limits ?? []) {
      if (value > high && value < high + span) high = value;
      if (value < low && value > low - span) low = value;
    }
    return [low - 0.06 * span, high + 0.06 * span];
  }

  private listen(plot: uPlot): void {
    let down_x = 0;
    plot.over.addEventListener("pointerdown", (event) => (down_x = event.clientX));
    plot.over.addEventListener("click", (event) => {
      if (Math.abs(event.clientX - down_x) > 3) return;
      this.options.onpick?.(plot.posToVal(event.offsetX, "x"));
    });
    plot.over.addEventListener("dblclick", () => this.zoomAll(null));
  }

  private selected(plot: uPlot): void {
    const { left, width } = plot.select;
    if (width < 4) return;
    const range: [number, number] = [plot.posToVal(left, "x"), plot.posToVal(left + width, "x")];
    plot.setSelect({ left: 0, top: 0, width: 0, height: 0 }, false);
    this.zoomAll(range);
  }

  private zoomAll(range: [number, number] | null): void {
    const all = this.options.group ? groups.get(this.options.group) : undefined;
    for (const one of all ?? [this]) one.zoom(range);
    this.options.onzoom?.(range);
  }

  private key(event: KeyboardEvent): void {
    const plot = this.plot;
    if (!plot) return;
    const step = { ArrowLeft: -8, ArrowRight: 8 }[event.key];
    const { min = 0, max = 1 } = plot.scales.x ?? {};
    const [a, b] = [min ?? 0, max ?? 1];
    const left = Math.max(0, plot.cursor.left ?? 0);
    const centre = plot.posToVal(left, "x");
    if (step !== undefined)
      plot.setCursor({ left: Math.min(plot.over.clientWidth, Math.max(0, left + step)), top: 10 });
    else if (event.key === "Enter") this.options.onpick?.(centre);
    else if (event.key === "+" || event.key === "=")
      this.zoomAll([centre - (centre - a) * 0.6, centre + (b - centre) * 0.6]);
    else if (event.key === "-" || event.key === "Escape") this.zoomAll(null);
    else return;
    event.preventDefault();
  }

  private showReadout(plot: uPlot): void {
    const i = plot.cursor.idx;
    if (i === null || i === undefined) {
      this.readout.textContent = this.spec.unit;
      return;
    }
    const time = withUnit(this.spec.time_s[i], 2, this.spec.time_unit ?? "s");
    if (this.spec.readout) {
      this.readout.textContent = `${this.spec.readout(i)}   ${time}`;
      return;
    }
    const parts = this.spec.series.map(
      (one) => `${one.name} ${withUnit(one.values[i], this.spec.digits ?? 2, this.spec.unit)}`,
    );
    this.readout.textContent = [time, ...parts].join("   ");
  }

  /** Limits and marks, over the curves. */
  private drawOver(plot: uPlot): void {
    const { ctx } = plot;
    const { left, top, width, height } = plot.bbox;
    const pixel = devicePixelRatio;
    ctx.save();
    ctx.beginPath();
    ctx.rect(left, top, width, height);
    ctx.clip();
    ctx.font = `${11 * pixel}px system-ui, sans-serif`;
    ctx.textAlign = "left";
    ctx.textBaseline = "alphabetic";
    ctx.lineWidth = pixel;
    ctx.setLineDash([6 * pixel, 3 * pixel]);
    ctx.strokeStyle = ctx.fillStyle = cssColour("--bad");
    for (const { value, label } of this.spec.limits ?? []) {
      const y = plot.valToPos(value, "y", true);
      ctx.beginPath();
      ctx.moveTo(left, y);
      ctx.lineTo(left + width, y);
      ctx.stroke();
      ctx.fillText(label, left + 4 * pixel, y - 14 * pixel < top ? y + 12 * pixel : y - 3 * pixel);
    }
    ctx.setLineDash([]);
    for (const mark of this.spec.marks ?? []) {
      const x = plot.valToPos(mark.time_s, "x", true);
      ctx.fillStyle = cssColour(mark.kind === "error" ? "--bad" : mark.kind === "warning" ? "--warn" : "--muted");
      ctx.fillRect(x - pixel, top, 2 * pixel, height);
    }
    ctx.restore();
    this.placeNow();
  }

  private resize(): void {
    const width = this.place.clientWidth;
    if (width > 0 && this.plot && width !== this.plot.width)
      this.plot.setSize({ width, height: this.spec.height ?? 130 });
  }

  private png(): Promise<Blob | null> {
    const from = this.plot?.ctx.canvas;
    if (!from) return Promise.resolve(null);
    const canvas = h("canvas", { width: from.width, height: from.height + 24 * devicePixelRatio });
    const paint = canvas.getContext("2d");
    if (paint) {
      paint.fillStyle = cssColour("--surface");
      paint.fillRect(0, 0, canvas.width, canvas.height);
      paint.fillStyle = cssColour("--ink");
      paint.font = `600 ${13 * devicePixelRatio}px system-ui, sans-serif`;
      paint.fillText(`${this.spec.title} (${this.spec.unit})`, 8, 16 * devicePixelRatio);
      paint.drawImage(from, 0, 24 * devicePixelRatio);
    }
    return new Promise((resolve) => canvas.toBlob(resolve));
  }
}

export function timePlot(host: HTMLElement, spec: TimePlotSpec, options: TimePlotOptions = {}): TimePlot {
  return new TimePlotView(host, spec, options);
}
