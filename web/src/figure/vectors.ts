/** Vectors at places of a machine, magnified by a factor that is printed, from any side. */

import { tr } from "../words/index.ts";
import { s } from "../dom.ts";
import { factor, number, withUnit } from "../format.ts";
import { drawLegend } from "./chart.ts";
import { rangeOf } from "./colours.ts";
import { figure, roundNumber, type Drawing, type Figure } from "./figure.ts";

export interface VectorSet {
  name: string;
  /** x, y, z per place, µm. */
  um: ArrayLike<number>;
  colour: string;
}

export interface VectorSpec {
  title: string;
  /** x, y, z per place, mm. */
  at_mm: ArrayLike<number>;
  sets: VectorSet[];
  magnification: number;
  /** From where it is seen, degrees: about Z from +X, and above the XY plane. */
  azimuth: number;
  elevation: number;
  height?: number;
}

type Triple = [number, number, number];

interface View {
  x: (p: Triple) => number;
  y: (p: Triple) => number;
  /** px per mm. */
  scale: number;
}

const place = (from: ArrayLike<number>, i: number): Triple => [
  from[3 * i] as number,
  from[3 * i + 1] as number,
  from[3 * i + 2] as number,
];
const length = (v: Triple): number => Math.hypot(...v);

/** The box around all places: least and greatest of each direction. */
function boxOf(spec: VectorSpec): [Triple, Triple] {
  const n = Math.floor(spec.at_mm.length / 3);
  const ranges = [0, 1, 2].map((j) =>
    n > 0 ? rangeOf(Array.from({ length: n }, (_, i) => spec.at_mm[3 * i + j] as number)) : ([0, 1] as const),
  );
  return [ranges.map((r) => r[0]) as Triple, ranges.map((r) => r[1]) as Triple];
}

function cornersOf([low, high]: [Triple, Triple]): Triple[] {
  return Array.from({ length: 8 }, (_, i) => [0, 1, 2].map((j) => ((i >> j) & 1 ? high : low)[j]) as Triple);
}

/** Seen in parallel, the box in the middle with room for the arrows around it. */
function viewOf(spec: VectorSpec, corners: Triple[], width: number, height: number): View {
  const [a, e] = [(spec.azimuth * Math.PI) / 180, (spec.elevation * Math.PI) / 180];
  const right: Triple = [-Math.sin(a), Math.cos(a), 0];
  const up: Triple = [-Math.sin(e) * Math.cos(a), -Math.sin(e) * Math.sin(a), Math.cos(e)];
  const dot = (p: Triple, q: Triple): number => p[0] * q[0] + p[1] * q[1] + p[2] * q[2];
  const [x, y] = [rangeOf(corners.map((p) => dot(p, right))), rangeOf(corners.map((p) => dot(p, up)))];
  const scale = Math.min((width - 150) / Math.max(1e-6, x[1] - x[0]), (height - 130) / Math.max(1e-6, y[1] - y[0]));
  const [cx, cy] = [(x[0] + x[1]) / 2, (y[0] + y[1]) / 2];
  return {
    x: (p) => width / 2 + scale * (dot(p, right) - cx),
    y: (p) => height / 2 - scale * (dot(p, up) - cy),
    scale,
  };
}

/** Edges of the box, and what each direction runs over, in mm. */
function drawBox(d: Drawing, corners: Triple[], [low, high]: [Triple, Triple], v: View): void {
  for (let i = 0; i < 8; i++) {
    for (let j = 0; j < 3; j++) {
      if ((i >> j) & 1) continue;
      const [p, q] = [corners[i] as Triple, corners[i | (1 << j)] as Triple];
      d.svg.append(s("line", { x1: v.x(p), y1: v.y(p), x2: v.x(q), y2: v.y(q), stroke: "var(--line)" }));
    }
  }
  ["X", "Y", "Z"].forEach((name, j) => {
    const [from, to] = outerEdge(corners, j, v);
    const [dx, dy] = [v.x(to) - v.x(from), v.y(to) - v.y(from)];
    // An edge that is seen from its end has no name.
    if (Math.hypot(dx, dy) < 24 || (high[j] as number) === (low[j] as number)) return;
    const text = `${name} ${number(low[j], 0)} … ${withUnit(high[j], 0, "mm")}`;
    const steep = Math.abs(dy) > Math.abs(dx);
    const falls = dy * dx > 0;
    const [x, y] = [(v.x(from) + v.x(to)) / 2, (v.y(from) + v.y(to)) / 2];
    const flat = Math.abs(dy) < 0.1 * Math.abs(dx);
    d.svg.append(
      s(
        "text",
        {
          x: x + (steep ? -8 : flat ? 0 : falls ? -8 : 8),
          y: y + (steep ? 4 : 18),
          "text-anchor": flat ? "middle" : steep || falls ? "end" : "start",
          fill: "var(--muted)",
        },
        text,
      ),
    );
  });
}

/** The edge along a direction that lies outside in the picture: below, or at the left if it is upright. */
function outerEdge(corners: Triple[], j: number, v: View): [Triple, Triple] {
  const starts = corners.map((_, i) => i).filter((i) => !((i >> j) & 1));
  const edges = starts.map((i): [Triple, Triple] => [corners[i] as Triple, corners[i | (1 << j)] as Triple]);
  const [a, b] = edges[0] as [Triple, Triple];
  const steep = Math.abs(v.y(b) - v.y(a)) > Math.abs(v.x(b) - v.x(a));
  const outside = ([p, q]: [Triple, Triple]): number => (steep ? -(v.x(p) + v.x(q)) : v.y(p) + v.y(q));
  return edges.reduce((best, edge) => (outside(edge) > outside(best) + 1e-9 ? edge : best));
}

function arrowPath(x: number, y: number, dx: number, dy: number): string {
  const l = Math.hypot(dx, dy);
  if (l < 0.3) return "";
  const head = Math.min(6, 0.4 * l);
  const [ux, uy] = [dx / l, dy / l];
  const [tx, ty] = [x + dx, y + dy];
  const side = (k: number): string =>
    `${(tx - head * ux + k * 0.45 * head * uy).toFixed(1)} ${(ty - head * uy - k * 0.45 * head * ux).toFixed(1)}`;
  return `M${x.toFixed(1)} ${y.toFixed(1)}L${tx.toFixed(1)} ${ty.toFixed(1)}M${side(1)}L${tx.toFixed(1)} ${ty.toFixed(1)}L${side(-1)}`;
}

function drawVectors(d: Drawing, spec: VectorSpec): void {
  const box = boxOf(spec);
  const corners = cornersOf(box);
  const v = viewOf(spec, corners, d.width, d.height);
  drawBox(d, corners, box, v);
  const n = Math.floor(spec.at_mm.length / 3);
  const far = spec.magnification / 1000;
  for (let i = 0; i < n; i++) {
    const at = place(spec.at_mm, i);
    const [x, y] = [v.x(at), v.y(at)];
    const values = spec.sets.map((set) => `${set.name} ${withUnit(length(place(set.um, i)), 1, "µm")}`).join(", ");
    const group = s(
      "g",
      {},
      s("title", {}, `X ${number(at[0], 1)}, Y ${number(at[1], 1)}, Z ${withUnit(at[2], 1, "mm")}: ${values}`),
      s("circle", { cx: x, cy: y, r: 1.6, fill: "var(--muted)" }),
    );
    for (const set of spec.sets) {
      const um = place(set.um, i);
      const tip: Triple = [at[0] + far * um[0], at[1] + far * um[1], at[2] + far * um[2]];
      const path = arrowPath(x, y, v.x(tip) - x, v.y(tip) - y);
      if (path) group.append(s("path", { d: path, fill: "none", stroke: set.colour, "stroke-width": 1.2 }));
    }
    d.svg.append(group);
  }
  drawLegend(d.svg, spec.sets, 4, 8);
  drawScale(d, spec, v);
}

/** The factor, and an arrow of a round length. */
function drawScale(d: Drawing, spec: VectorSpec, v: View): void {
  const px_per_um = (v.scale * spec.magnification) / 1000;
  const um = roundNumber(70 / px_per_um, false);
  const y = d.height - 8;
  d.svg.append(
    s("text", { x: 4, y, fill: "var(--actual-ink)", "font-weight": "600" }, tr`arrows ${factor(spec.magnification)}`),
    s("path", { d: arrowPath(120, y - 4, um * px_per_um, 0), fill: "none", stroke: "var(--ink)", "stroke-width": 1.4 }),
    s("text", { x: 126 + um * px_per_um, y, fill: "var(--ink)" }, withUnit(um, um < 1 ? 2 : 0, "µm")),
  );
}

/** A factor at which the longest arrow takes a fair part of the picture. */
export function fairMagnification(at_mm: ArrayLike<number>, um: ArrayLike<number>): number {
  const spec = { at_mm } as VectorSpec;
  const [low, high] = boxOf(spec);
  const extent = Math.max(1, length([high[0] - low[0], high[1] - low[1], high[2] - low[2]]));
  let longest = 0;
  for (let i = 0; 3 * i < um.length; i++) longest = Math.max(longest, length(place(um, i)));
  return longest > 0 ? Math.max(1, roundNumber((0.15 * extent * 1000) / longest)) : 1000;
}

export function vectors(host: HTMLElement, spec: VectorSpec): Figure<VectorSpec> {
  return figure(host, spec, (now) => ({
    title: now.title,
    draw: (d) => drawVectors(d, now),
    columns: () => {
      const n = Math.floor(now.at_mm.length / 3);
      const column = (from: ArrayLike<number>, j: number): number[] =>
        Array.from({ length: n }, (_, i) => from[3 * i + j] as number);
      const three = (name: string, unit: string, from: ArrayLike<number>, shown = name) =>
        ["X", "Y", "Z"].map((axis, j) => ({
          heading: `${name} ${axis} (${unit})`,
          shown: `${shown} ${axis} (${unit})`,
          values: column(from, j),
        }));
      return [
        ...three("place", "mm", now.at_mm, tr`place`),
        ...now.sets.flatMap((set) => three(set.name, "µm", set.um)),
      ];
    },
    height: (width) => now.height ?? Math.min(430, Math.max(260, 0.6 * width)),
  }));
}
