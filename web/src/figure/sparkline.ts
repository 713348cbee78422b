/** A curve without axes, in a line of text: its shape at a glance. */

import { s } from "../dom.ts";
import { padded } from "./figure.ts";
import { rangeOf } from "./colours.ts";

export interface SparkSpec {
  x: ArrayLike<number>;
  y: ArrayLike<number>;
  /** Read out to those who do not see it. */
  label: string;
  width?: number;
  height?: number;
  /** Where the axis stands now. */
  at?: number | null;
}

export interface Sparkline {
  svg: SVGSVGElement;
  /** Moves the mark of the present position; null or beyond the curve: none. */
  mark(at: number | null): void;
}

export function markedSparkline(spec: SparkSpec): Sparkline {
  const { width = 90, height = 20 } = spec;
  const svg = s("svg", {
    class: "sparkline",
    width,
    height,
    viewBox: `0 0 ${width} ${height}`,
    role: "img",
    "aria-label": spec.label,
  });
  const x_range = rangeOf(spec.x);
  const y_found = rangeOf(spec.y);
  const y_range = padded([Math.min(0, y_found[0]), Math.max(0, y_found[1])], 0.1);
  const x = (v: number): number => ((v - x_range[0]) / (x_range[1] - x_range[0] || 1)) * width;
  const y = (v: number): number => height - ((v - y_range[0]) / (y_range[1] - y_range[0])) * height;
  const points = Array.from(
    { length: Math.min(spec.x.length, spec.y.length) },
    (_, i) => `${x(spec.x[i] as number).toFixed(1)} ${y(spec.y[i] as number).toFixed(1)}`,
  );
  svg.append(s("line", { x1: 0, x2: width, y1: y(0), y2: y(0), stroke: "var(--line-strong)", "stroke-width": 0.8 }));
  if (points.length > 1)
    svg.append(s("path", { d: `M${points.join("L")}`, fill: "none", stroke: "var(--series-1)", "stroke-width": 1.4 }));
  const line = s("line", { y1: 0, y2: height, stroke: "var(--accent)", visibility: "hidden" });
  svg.append(line);
  const mark = (at: number | null): void => {
    const seen = at !== null && at >= x_range[0] && at <= x_range[1];
    line.setAttribute("visibility", seen ? "visible" : "hidden");
    if (!seen) return;
    line.setAttribute("x1", x(at).toFixed(1));
    line.setAttribute("x2", x(at).toFixed(1));
  };
  mark(spec.at ?? null);
  return { svg, mark };
}

export const sparkline = (spec: SparkSpec): SVGSVGElement => markedSparkline(spec).svg;
