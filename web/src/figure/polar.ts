/** Deviations from a circle, magnified by a factor that is printed, with fitted circles. */

import { tr } from "../words/index.ts";
import { s } from "../dom.ts";
import { factor, number, withUnit } from "../format.ts";
import { rangeOf, seriesColour } from "./colours.ts";
import { drawLegend } from "./chart.ts";
import { figure, roundNumber, type Drawing, type Figure } from "./figure.ts";

export interface PolarSeries {
  name: string;
  angle_rad: ArrayLike<number>;
  /** Deviation from the nominal radius, in `unit`. */
  deviation: ArrayLike<number>;
  colour?: string;
  dash?: string;
  points?: boolean;
  /** The last point is joined to the first. */
  closed?: boolean;
}

export interface PolarCircle {
  name: string;
  /** Centre and radius as deviations from the nominal circle, in `unit`. */
  x: number;
  y: number;
  radius: number;
  colour?: string;
  dash?: string;
}

export interface PolarSpec {
  title: string;
  /** Of the deviations. */
  unit: string;
  /** How many of `unit` are 1 mm; for the printed factor. Default 1000 (µm). */
  units_per_mm?: number;
  /** The nominal radius; without it the factor cannot be printed and the scale is. */
  radius_mm?: number;
  series: PolarSeries[];
  circles?: PolarCircle[];
  /** Names of the directions at 0° and 90°. */
  axes?: [string, string];
  height?: number;
}

interface Scale {
  cx: number;
  cy: number;
  base: number;
  /** px per unit of deviation. */
  k: number;
  step: number;
}

function scaleOf(spec: PolarSpec, width: number, height: number): Scale {
  const half = Math.min(width, height - 34) / 2 - 30;
  let most = 1e-12;
  for (const one of spec.series) for (const v of rangeOf(one.deviation)) most = Math.max(most, Math.abs(v));
  for (const c of spec.circles ?? []) most = Math.max(most, Math.abs(c.radius) + Math.hypot(c.x, c.y));
  const base = 0.66 * half;
  let k = (half - base) / most;
  if (spec.radius_mm) {
    // A round factor is easier to read off: px per mm of the circle, times the factor.
    const per_mm = base / spec.radius_mm;
    const magnification = roundNumber((k * (spec.units_per_mm ?? 1000)) / per_mm, false);
    k = (magnification * per_mm) / (spec.units_per_mm ?? 1000);
  }
  return { cx: width / 2, cy: 20 + (height - 34) / 2, base, k, step: roundNumber((half - base) / k / 2.2, false) };
}

function drawPolarGrid(svg: SVGSVGElement, spec: PolarSpec, c: Scale, half: number): void {
  for (let i = -3; i <= 4; i++) {
    const r = c.base + i * c.step * c.k;
    if (r <= 4 || r > half + 1) continue;
    // Where rings lie close together, every other one has its number.
    const numbered = i % 2 === 0 || c.step * c.k >= 13;
    svg.append(
      s("circle", {
        cx: c.cx,
        cy: c.cy,
        r,
        fill: "none",
        stroke: i === 0 ? "var(--ink)" : "var(--line)",
        "stroke-width": i === 0 ? 1.2 : 0.7,
        "stroke-dasharray": i === 0 ? null : "2 3",
      }),
    );
    if (numbered)
      svg.append(
        s(
          "text",
          { x: c.cx + r * Math.cos(1.2) + 2, y: c.cy - r * Math.sin(1.2), fill: "var(--muted)", "font-size": 10 },
          i === 0 ? `0 ${spec.unit}` : number(i * c.step, Math.max(0, -Math.floor(Math.log10(c.step) + 1e-9))),
        ),
      );
  }
  for (let a = 0; a < 360; a += 30) {
    const [x, y] = [Math.cos((a * Math.PI) / 180), -Math.sin((a * Math.PI) / 180)];
    svg.append(
      s("line", {
        x1: c.cx,
        y1: c.cy,
        x2: c.cx + half * x,
        y2: c.cy + half * y,
        stroke: "var(--line)",
        "stroke-width": a % 90 === 0 ? 1 : 0.5,
      }),
    );
    if (a % 90 === 0) {
      const name = a === 0 ? (spec.axes?.[0] ?? "") : a === 90 ? (spec.axes?.[1] ?? "") : "";
      svg.append(
        s(
          "text",
          {
            x: c.cx + (half + 14) * x,
            y: c.cy + (half + 12) * y + 4,
            "text-anchor": x > 0.5 ? "start" : x < -0.5 ? "end" : "middle",
            fill: "var(--muted)",
          },
          name ? `${name} ${a}°` : `${a}°`,
        ),
      );
    }
  }
}

function drawPolar(d: Drawing, spec: PolarSpec): void {
  const c = scaleOf(spec, d.width, d.height);
  const half = Math.min(d.width, d.height - 34) / 2 - 30;
  drawPolarGrid(d.svg, spec, c, half);
  const at = (angle: number, deviation: number): [number, number] => {
    const r = c.base + c.k * deviation;
    return [c.cx + r * Math.cos(angle), c.cy - r * Math.sin(angle)];
  };
  for (const [i, circle] of (spec.circles ?? []).entries()) {
    const colour = circle.colour ?? seriesColour(i + spec.series.length);
    // Only deviations are magnified: a circle beside the centre is drawn as its deviations are, as a limaçon.
    const round = Array.from({ length: 180 }, (_, j) => (j * Math.PI) / 90).map((a) =>
      at(a, circle.radius + circle.x * Math.cos(a) + circle.y * Math.sin(a)),
    );
    d.svg.append(
      s("path", {
        d: `M${round.map(([x, y]) => `${x.toFixed(2)} ${y.toFixed(2)}`).join("L")}Z`,
        fill: "none",
        stroke: colour,
        "stroke-width": 1.4,
        "stroke-dasharray": circle.dash ?? "6 3",
      }),
    );
    d.svg.append(s("circle", { cx: c.cx + c.k * circle.x, cy: c.cy - c.k * circle.y, r: 2.5, fill: colour }));
  }
  for (const [i, one] of spec.series.entries()) {
    const colour = one.colour ?? seriesColour(i);
    const points = Array.from({ length: Math.min(one.angle_rad.length, one.deviation.length) }, (_, j) =>
      at(one.angle_rad[j] as number, one.deviation[j] as number),
    ).filter(([x, y]) => Number.isFinite(x + y));
    if (one.points) for (const [x, y] of points) d.svg.append(s("circle", { cx: x, cy: y, r: 2.2, fill: colour }));
    else
      d.svg.append(
        s("path", {
          d: `M${points.map(([x, y]) => `${x.toFixed(2)} ${y.toFixed(2)}`).join("L")}${one.closed ? "Z" : ""}`,
          fill: "none",
          stroke: colour,
          "stroke-width": 1.7,
          "stroke-dasharray": one.dash ?? null,
        }),
      );
  }
  const items = [...spec.series, ...(spec.circles ?? [])].map((one, i) => ({
    name: one.name,
    colour: one.colour ?? seriesColour(i),
    dash: one.dash ?? ("radius" in one ? "6 3" : undefined),
  }));
  drawLegend(d.svg, items, 4, 8);
  const magnified = spec.radius_mm
    ? tr`deviations ${factor((c.k * (spec.units_per_mm ?? 1000)) / (c.base / spec.radius_mm))}`
    : tr`${withUnit(c.step, 3, spec.unit)} per ring`;
  d.svg.append(s("text", { x: 4, y: d.height - 4, fill: "var(--actual-ink)", "font-weight": "600" }, magnified));
  addPolarReadout(d, spec, c, at);
}

function addPolarReadout(
  d: Drawing,
  spec: PolarSpec,
  c: Scale,
  at: (angle: number, deviation: number) => [number, number],
): void {
  const text = s("text", {
    x: d.width - 4,
    y: d.height - 4,
    "text-anchor": "end",
    fill: "var(--ink)",
    "data-hover": "",
  });
  const dot = s("circle", { r: 3.6, fill: "var(--ink)", visibility: "hidden", "data-hover": "" });
  d.svg.append(text, dot);
  const first = spec.series[0];
  if (!first || first.angle_rad.length === 0) return;
  let index = 0;
  const show = (i: number): void => {
    index = (i + first.angle_rad.length) % first.angle_rad.length;
    const [angle, value] = [first.angle_rad[index] as number, first.deviation[index] as number];
    const [x, y] = at(angle, value);
    dot.setAttribute("cx", String(x));
    dot.setAttribute("cy", String(y));
    dot.setAttribute("visibility", "visible");
    text.textContent = `${number(((((angle * 180) / Math.PI) % 360) + 360) % 360, 1)}°: ${withUnit(value, 2, spec.unit)}`;
  };
  d.svg.addEventListener("pointermove", (event) => {
    const own = d.svg.getBoundingClientRect();
    const angle = Math.atan2(c.cy - (event.clientY - own.top), event.clientX - own.left - c.cx);
    let [best, least] = [0, 9];
    for (let i = 0; i < first.angle_rad.length; i++) {
      const away = Math.abs(
        Math.atan2(Math.sin((first.angle_rad[i] as number) - angle), Math.cos((first.angle_rad[i] as number) - angle)),
      );
      if (away < least) [best, least] = [i, away];
    }
    show(best);
  });
  d.svg.addEventListener("keydown", (event) => {
    const step = { ArrowLeft: 1, ArrowRight: -1 }[event.key];
    if (step === undefined) return;
    event.preventDefault();
    show(index + step);
  });
  d.svg.addEventListener("pointerleave", () => {
    dot.setAttribute("visibility", "hidden");
    text.textContent = "";
  });
}

export function polar(host: HTMLElement, spec: PolarSpec): Figure<PolarSpec> {
  return figure(host, spec, (now) => ({
    title: now.title,
    draw: (d) => drawPolar(d, now),
    columns: () =>
      now.series.flatMap((one) => [
        { heading: `${one.name} angle (rad)`, shown: tr`${one.name} angle (rad)`, values: one.angle_rad },
        {
          heading: `${one.name} deviation (${now.unit})`,
          shown: tr`${one.name} deviation (${now.unit})`,
          values: one.deviation,
        },
      ]),
    height: (width) => Math.min(now.height ?? 380, width + 34),
  }));
}
