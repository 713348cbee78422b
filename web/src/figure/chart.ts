/** Lines and points over two axes. */

import { tr } from "../words/index.ts";
import { s } from "../dom.ts";
import { number, withUnit } from "../format.ts";
import { rangeOf, seriesColour } from "./colours.ts";
import { axisTitle, figure, letters, padded, ticks, type Column, type Drawing, type Figure } from "./figure.ts";

export interface Axis {
  label: string;
  unit?: string;
  min?: number;
  max?: number;
  /** Digits of the readout under the pointer. */
  digits?: number;
}

export interface Series {
  name: string;
  x: ArrayLike<number>;
  y: ArrayLike<number>;
  /** Standard uncertainty of y: drawn as ± 2u (k = 2) whiskers on points, as a band on lines. */
  u?: ArrayLike<number>;
  /** Half the width of a band around the line, such as 2s of repeated readings. */
  half?: ArrayLike<number>;
  colour?: string;
  dash?: string;
  /** Without a name in the legend and under the pointer (single readings of a line that has one). */
  quiet?: boolean;
  /** Default: a line; scatter() turns it into points. */
  line?: boolean;
  points?: boolean;
}

export interface Limit {
  value: number;
  label: string;
  axis?: "x" | "y";
}

export interface ChartSpec {
  title: string;
  x: Axis;
  y: Axis;
  series: Series[];
  limits?: Limit[];
  /** px; default 0.55 of the width, at most 320. */
  height?: number;
  /** One millimetre is as long on both axes. */
  equal?: boolean;
}

interface Frame {
  left: number;
  right: number;
  top: number;
  bottom: number;
  x: (v: number) => number;
  y: (v: number) => number;
}

/** Half the height of whisker or band at a point. */
function halfWidth(series: Series, i: number): number {
  return series.half?.[i] ?? 2 * (series.u?.[i] ?? 0);
}

function ranges(spec: ChartSpec): { x: [number, number]; y: [number, number] } {
  const all = (pick: (series: Series) => ArrayLike<number>[]): [number, number] => {
    const each = spec.series
      .flatMap(pick)
      .filter((a) => a.length > 0)
      .map(rangeOf);
    return each.length === 0 ? [0, 1] : [Math.min(...each.map((r) => r[0])), Math.max(...each.map((r) => r[1]))];
  };
  const x = all((series) => [series.x]);
  const y = all((series) => {
    if (!series.u && !series.half) return [series.y];
    return [
      Array.from(series.y, (v, i) => v - halfWidth(series, i)),
      Array.from(series.y, (v, i) => v + halfWidth(series, i)),
    ];
  });
  for (const limit of spec.limits ?? []) {
    const range = limit.axis === "x" ? x : y;
    range[0] = Math.min(range[0], limit.value);
    range[1] = Math.max(range[1], limit.value);
  }
  const wide = padded(x, spec.equal || spec.series.some((one) => one.points) ? 0.05 : 0);
  const tall = padded(y);
  return { x: [spec.x.min ?? wide[0], spec.x.max ?? wide[1]], y: [spec.y.min ?? tall[0], spec.y.max ?? tall[1]] };
}

/** The series that the legend names, each with its place among all. */
function named(spec: ChartSpec): [Series, number][] {
  return spec.series.map((one, i): [Series, number] => [one, i]).filter(([one]) => !one.quiet);
}

function frameOf(
  spec: ChartSpec,
  width: number,
  height: number,
): { frame: Frame; x: [number, number]; y: [number, number] } {
  const r = ranges(spec);
  const legend = named(spec).length > 1 ? 20 : 6;
  const frame = { left: 54, right: width - 12, top: legend, bottom: height - 36 };
  if (spec.equal) {
    const per_mm = Math.min(
      (frame.right - frame.left) / (r.x[1] - r.x[0]),
      (frame.bottom - frame.top) / (r.y[1] - r.y[0]),
    );
    for (const [range, pixels] of [
      [r.x, frame.right - frame.left],
      [r.y, frame.bottom - frame.top],
    ] as const) {
      const middle = (range[0] + range[1]) / 2;
      range[0] = middle - pixels / per_mm / 2;
      range[1] = middle + pixels / per_mm / 2;
    }
  }
  const x = (v: number): number => frame.left + ((v - r.x[0]) / (r.x[1] - r.x[0])) * (frame.right - frame.left);
  const y = (v: number): number => frame.bottom - ((v - r.y[0]) / (r.y[1] - r.y[0])) * (frame.bottom - frame.top);
  return { frame: { ...frame, x, y }, ...r };
}

/** Grid, ticks, titles. */
function drawAxes(svg: SVGSVGElement, spec: ChartSpec, f: Frame, x: [number, number], y: [number, number]): void {
  const tx = ticks(x[0], x[1], Math.max(2, (f.right - f.left) / 80));
  const ty = ticks(y[0], y[1], Math.max(2, (f.bottom - f.top) / 38));
  for (const v of tx.values) {
    svg.append(
      s("line", {
        x1: f.x(v),
        x2: f.x(v),
        y1: f.top,
        y2: f.bottom,
        stroke: "var(--line)",
        "stroke-width": v === 0 ? 1.4 : 0.7,
      }),
      s("text", { x: f.x(v), y: f.bottom + 14, "text-anchor": "middle", fill: "var(--muted)" }, number(v, tx.digits)),
    );
  }
  for (const v of ty.values) {
    svg.append(
      s("line", {
        x1: f.left,
        x2: f.right,
        y1: f.y(v),
        y2: f.y(v),
        stroke: v === 0 ? "var(--line-strong)" : "var(--line)",
        "stroke-width": v === 0 ? 1.2 : 0.7,
      }),
      s("text", { x: f.left - 6, y: f.y(v) + 4, "text-anchor": "end", fill: "var(--muted)" }, number(v, ty.digits)),
    );
  }
  svg.append(
    s(
      "text",
      { x: (f.left + f.right) / 2, y: f.bottom + 30, "text-anchor": "middle", fill: "var(--ink)" },
      axisTitle(spec.x.label, spec.x.unit),
    ),
    s(
      "text",
      { transform: `translate(11 ${(f.top + f.bottom) / 2}) rotate(-90)`, "text-anchor": "middle", fill: "var(--ink)" },
      axisTitle(spec.y.label, spec.y.unit),
    ),
  );
}

/** A path with at most a few points per pixel: least and greatest of each column are kept. */
function pathOf(series: Series, f: Frame): string {
  const n = Math.min(series.x.length, series.y.length);
  const many = n > 4 * (f.right - f.left);
  let text = "";
  let pen = false;
  const to = (i: number): void => {
    const y = series.y[i] as number;
    if (!Number.isFinite(y)) {
      pen = false;
      return;
    }
    text += `${pen ? "L" : "M"}${f.x(series.x[i] as number).toFixed(2)} ${f.y(y).toFixed(2)}`;
    pen = true;
  };
  if (!many) for (let i = 0; i < n; i++) to(i);
  else {
    const bucket = Math.ceil(n / (f.right - f.left));
    for (let i = 0; i < n; i += bucket) {
      let [low, high] = [i, i];
      for (let j = i; j < Math.min(n, i + bucket); j++) {
        if ((series.y[j] as number) < (series.y[low] as number)) low = j;
        if ((series.y[j] as number) > (series.y[high] as number)) high = j;
      }
      for (const j of [low, high].sort((a, b) => a - b)) to(j);
    }
  }
  return text;
}

function drawSeries(svg: SVGSVGElement, series: Series, colour: string, f: Frame): void {
  const n = Math.min(series.x.length, series.y.length);
  if ((series.u || series.half) && !series.points) {
    const side = (sign: number): string[] =>
      Array.from(
        { length: n },
        (_, i) =>
          `${f.x(series.x[i] as number).toFixed(2)} ${f.y((series.y[i] as number) + sign * halfWidth(series, i)).toFixed(2)}`,
      );
    svg.append(s("path", { d: `M${side(1).join("L")}L${side(-1).reverse().join("L")}Z`, fill: colour, opacity: 0.15 }));
  }
  if (series.line !== false)
    svg.append(
      s("path", {
        d: pathOf(series, f),
        fill: "none",
        stroke: colour,
        "stroke-width": 1.6,
        "stroke-linejoin": "round",
        "stroke-dasharray": series.dash ?? null,
      }),
    );
  if (!series.points) return;
  for (let i = 0; i < Math.min(n, 20_000); i++) {
    const [x, y] = [f.x(series.x[i] as number), f.y(series.y[i] as number)];
    if (!Number.isFinite(y)) continue;
    const u = series.u?.[i];
    if (u)
      svg.append(
        s("line", {
          x1: x,
          x2: x,
          y1: f.y((series.y[i] as number) - 2 * u),
          y2: f.y((series.y[i] as number) + 2 * u),
          stroke: colour,
          "stroke-width": 1,
        }),
      );
    svg.append(s("circle", { cx: x, cy: y, r: n > 300 ? 1.5 : 2.6, fill: colour }));
  }
}

/** Names of the series above the plot, wrapped by measured guess. */
export function drawLegend(
  svg: SVGSVGElement,
  items: { name: string; colour: string; dash?: string | undefined }[],
  left: number,
  top: number,
): void {
  let x = left;
  for (const { name, colour, dash } of items) {
    svg.append(
      s("line", {
        x1: x,
        x2: x + 16,
        y1: top,
        y2: top,
        stroke: colour,
        "stroke-width": 2.4,
        "stroke-dasharray": dash ?? null,
      }),
      s("text", { x: x + 20, y: top + 4, fill: "var(--ink)" }, name),
    );
    x += 34 + 6.1 * letters(name);
  }
}

/** A line under the pointer (or moved by arrow keys) with the values there. */
function addReadout(d: Drawing, spec: ChartSpec, f: Frame): void {
  const line = s("line", {
    y1: f.top,
    y2: f.bottom,
    stroke: "var(--muted)",
    "stroke-dasharray": "3 3",
    "data-hover": "",
  });
  const box = s("text", {
    y: f.top + 12,
    fill: "var(--ink)",
    "font-weight": "600",
    "paint-order": "stroke",
    stroke: "var(--surface)",
    "stroke-width": 4,
    "data-hover": "",
  });
  const dots = spec.series.map((one, i) =>
    s("circle", { r: 3.4, fill: one.colour ?? seriesColour(i), stroke: "var(--surface)", "data-hover": "" }),
  );
  const group = s("g", { visibility: "hidden", "data-hover": "" }, line, ...dots, box);
  d.svg.append(group);
  const longest = named(spec).reduce<Series | null>((a, [b]) => (a && a.x.length >= b.x.length ? a : b), null);
  if (!longest || longest.x.length === 0) return;
  let at = 0;
  const nearest = (series: Series, px: number, py?: number): number => {
    let [best, distance] = [-1, Infinity];
    for (let i = 0; i < series.x.length; i++) {
      const away =
        Math.abs(f.x(series.x[i] as number) - px) + (py === undefined ? 0 : Math.abs(f.y(series.y[i] as number) - py));
      if (away < distance) [best, distance] = [i, away];
    }
    return best;
  };
  const show = (px: number, py?: number): void => {
    group.setAttribute("visibility", "visible");
    const lines: string[] = [];
    let x_here = 0;
    const far = spec.series.map((one) => nearest(one, px, one.line === false ? py : undefined));
    spec.series.forEach((one, k) => {
      const i = far[k] as number;
      const dot = dots[k];
      if (i < 0 || !dot || one.quiet) return;
      const [x, y] = [one.x[i] as number, one.y[i] as number];
      if (one === longest) {
        at = i;
        x_here = x;
      }
      dot.setAttribute("cx", String(f.x(x)));
      dot.setAttribute("cy", String(f.y(y)));
      lines.push(
        `${named(spec).length > 1 ? `${one.name} ` : ""}${withUnit(y, spec.y.digits ?? 2, spec.y.unit ?? "")}`,
      );
    });
    const x = f.x(x_here);
    line.setAttribute("x1", String(x));
    line.setAttribute("x2", String(x));
    const right = x > (f.left + f.right) / 2;
    box.setAttribute("text-anchor", right ? "end" : "start");
    box.replaceChildren(
      ...[withUnit(x_here, spec.x.digits ?? 2, spec.x.unit ?? ""), ...lines].map((text, i) =>
        s("tspan", { x: x + (right ? -8 : 8), dy: i === 0 ? 0 : 14 }, text),
      ),
    );
  };
  d.svg.addEventListener("pointermove", (event) => {
    const own = d.svg.getBoundingClientRect();
    show(event.clientX - own.left, event.clientY - own.top);
  });
  const hide = (): void => group.setAttribute("visibility", "hidden");
  d.svg.addEventListener("pointerleave", hide);
  d.svg.addEventListener("blur", hide);
  d.svg.addEventListener("keydown", (event) => {
    const step = { ArrowLeft: -1, ArrowRight: 1 }[event.key];
    if (step === undefined) return;
    event.preventDefault();
    at = Math.max(0, Math.min(longest.x.length - 1, at + step));
    show(f.x(longest.x[at] as number));
  });
}

function drawChart(d: Drawing, spec: ChartSpec): void {
  const { frame, x, y } = frameOf(spec, d.width, d.height);
  drawAxes(d.svg, spec, frame, x, y);
  for (const limit of spec.limits ?? []) {
    const across = limit.axis !== "x";
    const p = across ? frame.y(limit.value) : frame.x(limit.value);
    d.svg.append(
      s("line", {
        x1: across ? frame.left : p,
        x2: across ? frame.right : p,
        y1: across ? p : frame.top,
        y2: across ? p : frame.bottom,
        stroke: "var(--bad)",
        "stroke-dasharray": "6 3",
      }),
      s(
        "text",
        {
          x: across ? frame.right - 4 : p + 4,
          y: across ? p - 4 : frame.top + 10,
          "text-anchor": across ? "end" : "start",
          fill: "var(--bad)",
        },
        limit.label,
      ),
    );
  }
  spec.series.forEach((one, i) => drawSeries(d.svg, one, one.colour ?? seriesColour(i), frame));
  if (named(spec).length > 1)
    drawLegend(
      d.svg,
      named(spec).map(([one, i]) => ({ name: one.name, colour: one.colour ?? seriesColour(i), dash: one.dash })),
      frame.left,
      8,
    );
  addReadout(d, spec, frame);
}

function columnsOf(spec: ChartSpec): Column[] {
  return spec.series.flatMap((one) => {
    const name = spec.series.length > 1 ? `${one.name} ` : "";
    const columns: Column[] = [
      { heading: `${name}${axisTitle(spec.x.label, spec.x.unit)}`, values: one.x },
      { heading: `${name}${axisTitle(spec.y.label, spec.y.unit)}`, values: one.y },
    ];
    const unit = spec.y.unit ?? "1";
    if (one.half)
      columns.push({
        heading: `${name}half width of the band (${unit})`,
        shown: tr`${name}half width of the band (${unit})`,
        values: one.half,
      });
    if (one.u) columns.push({ heading: `${name}u (${unit})`, values: one.u });
    return columns;
  });
}

export function lineChart(host: HTMLElement, spec: ChartSpec): Figure<ChartSpec> {
  return figure(host, spec, (now) => ({
    title: now.title,
    draw: (d) => drawChart(d, now),
    columns: () => columnsOf(now),
    height: (width) => now.height ?? Math.min(320, Math.max(150, 0.55 * width)),
  }));
}

export function scatter(host: HTMLElement, spec: ChartSpec): Figure<ChartSpec> {
  const asPoints = (now: ChartSpec): ChartSpec => ({
    ...now,
    series: now.series.map((one) => ({ line: false, points: true, ...one })),
  });
  const chart = lineChart(host, asPoints(spec));
  return { ...chart, update: (next) => chart.update(asPoints(next)) };
}
