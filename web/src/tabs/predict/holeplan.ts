/** Holes seen along the tool, with an arrow from where each should be to where it will be. */

import { tr } from "../../words/index.ts";
import { s } from "../../dom.ts";
import { factor, um } from "../../format.ts";
import { rangeOf } from "../../figure/colours.ts";
import { figure, roundNumber, type Drawing, type Figure } from "../../figure/figure.ts";
import type { Hole } from "./types.ts";

export interface HolePlanSpec {
  title: string;
  holes: Hole[];
  /** Drawn as a circle about every hole, at the scale of the arrows. */
  tolerance_um: number | null;
  colour: string;
  chosen: number | null;
  onpick: (hole: number) => void;
}

const EDGE = 74;
/** px, of the longest arrow. */
const LONGEST = 56;

interface Plan {
  at: (x_mm: number, y_mm: number) => [number, number];
  /** px per µm of the arrows. */
  k: number;
  magnified: number;
}

function planOf(spec: HolePlanSpec, width: number, height: number): Plan {
  const x = rangeOf(spec.holes.map((hole) => hole.nominal_mm[0]));
  const y = rangeOf(spec.holes.map((hole) => hole.nominal_mm[1]));
  const span = Math.max(x[1] - x[0], y[1] - y[0], 1e-3);
  const per_mm = (Math.min(width, height) - 2 * EDGE) / span;
  const longest = Math.max(1e-6, ...spec.holes.map((hole) => Math.hypot(hole.error_um[0], hole.error_um[1])));
  // A round factor, so that a reader can divide by it.
  const magnified = Math.max(1, roundNumber(LONGEST / ((longest / 1e3) * per_mm), false));
  const at = (px: number, py: number): [number, number] => [
    width / 2 + (px - (x[0] + x[1]) / 2) * per_mm,
    height / 2 - (py - (y[0] + y[1]) / 2) * per_mm,
  ];
  return { at, k: (magnified * per_mm) / 1e3, magnified };
}

function drawPlan(d: Drawing, spec: HolePlanSpec): void {
  const plan = planOf(spec, d.width, d.height);
  const places = spec.holes.map((hole) => plan.at(hole.nominal_mm[0], hole.nominal_mm[1]));
  d.svg.append(s("polygon", { points: places.map((p) => p.join(",")).join(" "), fill: "none", stroke: "var(--line)" }));
  const numbered = Math.max(1, Math.ceil(spec.holes.length / 8));
  spec.holes.forEach((hole, i) => {
    const [x, y] = places[i] as [number, number];
    d.svg.append(holeMark(spec, plan, hole, i, [x, y]));
    if (i % numbered !== 0) return;
    const inward = (v: number, middle: number): number => middle + (v - middle) * 0.78;
    d.svg.append(
      s(
        "text",
        { x: inward(x, d.width / 2), y: inward(y, d.height / 2) + 4, "text-anchor": "middle", fill: "var(--muted)" },
        String(i + 1),
      ),
    );
  });
  drawScale(d, spec, plan);
}

function holeMark(spec: HolePlanSpec, plan: Plan, hole: Hole, i: number, [x, y]: [number, number]): SVGGElement {
  const [dx, dy] = [plan.k * hole.error_um[0], -plan.k * hole.error_um[1]];
  const length = Math.hypot(dx, dy);
  const words = tr`hole ${i + 1}: dX ${um(hole.error_um[0])}, dY ${um(hole.error_um[1])}`;
  const group = s("g", { class: "pick", tabindex: "0", role: "button", "aria-label": words }, s("title", {}, words));
  const within = spec.tolerance_um === null ? 0 : plan.k * spec.tolerance_um;
  if (within > 3 && within < EDGE)
    group.append(
      s("circle", { cx: x, cy: y, r: within, fill: "none", stroke: "var(--line-strong)", "stroke-dasharray": "2 2" }),
    );
  group.append(
    s("circle", {
      cx: x,
      cy: y,
      r: spec.chosen === i ? 5 : 3,
      fill: spec.chosen === i ? "var(--accent)" : "var(--surface)",
      stroke: "var(--ink)",
    }),
    s("circle", { cx: x, cy: y, r: 10, fill: "transparent" }),
  );
  if (length > 1) {
    const [ux, uy] = [dx / length, dy / length];
    const head = Math.min(7, length);
    const [tx, ty] = [x + dx, y + dy];
    const barb = (side: number): string =>
      `${tx - head * ux + side * 0.4 * head * uy},${ty - head * uy - side * 0.4 * head * ux}`;
    group.append(
      s("line", { x1: x, y1: y, x2: tx, y2: ty, stroke: spec.colour, "stroke-width": 1.8 }),
      s("polygon", { points: `${tx},${ty} ${barb(1)} ${barb(-1)}`, fill: spec.colour }),
    );
  }
  group.addEventListener("click", () => spec.onpick(i));
  group.addEventListener("keydown", (event) => event.key === "Enter" && spec.onpick(i));
  return group;
}

/** A bar as long as the arrow of a round deviation, the factor, the axes. */
function drawScale(d: Drawing, spec: HolePlanSpec, plan: Plan): void {
  const bar = roundNumber(40 / plan.k, false);
  const [y, length] = [14, plan.k * bar];
  d.svg.append(
    s("path", {
      d: `M6 ${y - 5}v10M6 ${y}h${length}M${6 + length} ${y - 5}v10`,
      stroke: "var(--ink)",
      "stroke-width": 1.6,
      fill: "none",
    }),
    s("text", { x: 14 + length, y: y + 4, fill: "var(--ink)" }, um(bar, bar < 1 ? 2 : 0)),
    s(
      "text",
      { x: 4, y: d.height - 6, fill: "var(--actual-ink)", "font-weight": "600" },
      tr`arrows ${factor(plan.magnified)}`,
    ),
    s(
      "text",
      { x: d.width - 4, y: d.height - 6, "text-anchor": "end", fill: "var(--muted)" },
      tr`X to the right, Y upwards`,
    ),
  );
  if (spec.tolerance_um === null) return;
  const drawn = plan.k * spec.tolerance_um > 3 && plan.k * spec.tolerance_um < EDGE;
  const tolerance = um(spec.tolerance_um, 0);
  d.svg.append(
    s(
      "text",
      { x: d.width - 4, y: 18, "text-anchor": "end", fill: "var(--muted)" },
      drawn ? tr`tolerance ${tolerance}, dashed` : tr`tolerance ${tolerance}`,
    ),
  );
}

export function holePlan(host: HTMLElement, spec: HolePlanSpec): Figure<HolePlanSpec> {
  return figure(host, spec, (now) => ({
    title: now.title,
    draw: (d) => drawPlan(d, now),
    columns: () => [
      { heading: "hole", values: now.holes.map((_, i) => i + 1) },
      ...(["X", "Y", "Z"] as const).map((axis, k) => ({
        heading: `${axis} (mm)`,
        values: now.holes.map((hole) => hole.nominal_mm[k] as number),
      })),
      ...(["X", "Y", "Z"] as const).map((axis, k) => ({
        heading: `d${axis} (um)`,
        values: now.holes.map((hole) => hole.error_um[k] as number),
      })),
      ...(["X", "Y", "Z"] as const).map((axis, k) => ({
        heading: `u(d${axis}) (um)`,
        values: now.holes.map((hole) => hole.u_um[k] as number),
      })),
    ],
    height: (width) => Math.max(220, Math.min(width, (host.clientHeight || 700) - 30)),
  }));
}
