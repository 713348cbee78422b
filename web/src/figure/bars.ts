/** Horizontal bars, signed, with uncertainty: an error budget, for example. */

import { tr } from "../words/index.ts";
import { s } from "../dom.ts";
import { explain } from "../glossary/glossary.ts";
import { errorName } from "../glossary/names.ts";
import { NO_NUMBER, number, withUncertainty } from "../format.ts";
import { figure, letters, ticks, type Drawing, type Figure } from "./figure.ts";

export interface Bar {
  name: string;
  /** null: nothing can be said; `missing` stands in place of the bar. */
  value: number | null;
  missing?: string;
  /** Standard uncertainty; the whisker is ± 2u (k = 2). */
  u?: number | null;
  colour?: string;
  /** Shown on hover after the value. */
  note?: string;
}

export interface BarSpec {
  title: string;
  unit: string;
  digits?: number;
  bars: Bar[];
  /** Default: true if a value is negative. */
  signed?: boolean;
  /** A tolerance, drawn as a line. */
  limit?: { value: number; label: string };
  /** The same scale for several figures. */
  max?: number;
  onpick?: (bar: Bar, index: number) => void;
}

const ROW = 19;

/** Value and uncertainty to the digits of the figure. */
function valueText(bar: Bar, spec: BarSpec): string {
  return bar.value === null ? NO_NUMBER : withUncertainty(bar.value, bar.u, spec.digits ?? 1, spec.unit);
}

function drawBars(d: Drawing, spec: BarSpec): void {
  const names = Math.min(0.4 * d.width, 14 + 6.6 * Math.max(4, ...spec.bars.map((b) => letters(b.name))));
  const values = 26 + 6.4 * Math.max(0, ...spec.bars.map((b) => valueText(b, spec).length - 2));
  const signed = spec.signed ?? spec.bars.some((b) => (b.value ?? 0) < 0);
  const largest = Math.max(spec.limit?.value ?? 0, ...spec.bars.map((b) => Math.abs(b.value ?? 0) + 2 * (b.u ?? 0)));
  // Zeros alone stand on a scale of one unit.
  const most = spec.max ?? (largest > 0 ? largest : 1);
  const [left, right] = [names, Math.max(names + 40, d.width - values)];
  const x = (v: number): number =>
    signed ? (left + right) / 2 + (v / most) * ((right - left) / 2) : left + (v / most) * (right - left);
  const bottom = spec.bars.length * ROW + 4;
  const t = ticks(signed ? -most : 0, most, (right - left) / 60);
  for (const v of t.values) {
    d.svg.append(
      s("line", {
        x1: x(v),
        x2: x(v),
        y1: 0,
        y2: bottom,
        stroke: v === 0 ? "var(--line-strong)" : "var(--line)",
        "stroke-width": v === 0 ? 1.2 : 0.7,
      }),
    );
    d.svg.append(
      s("text", { x: x(v), y: bottom + 14, "text-anchor": "middle", fill: "var(--muted)" }, number(v, t.digits)),
    );
  }
  d.svg.append(s("text", { x: d.width, y: bottom + 14, "text-anchor": "end", fill: "var(--muted)" }, spec.unit));
  spec.bars.forEach((bar, i) => drawBar(d, spec, bar, i, { x, names }));
  if (spec.limit) {
    const at = x(spec.limit.value);
    d.svg.append(
      s("line", { x1: at, x2: at, y1: 0, y2: bottom, stroke: "var(--bad)", "stroke-dasharray": "6 3" }),
      s("text", { x: at - 4, y: bottom - 4, "text-anchor": "end", fill: "var(--bad)" }, spec.limit.label),
    );
  }
}

function drawBar(d: Drawing, spec: BarSpec, bar: Bar, i: number, g: { x: (v: number) => number; names: number }): void {
  const y = i * ROW + 3;
  const [a, b] = [g.x(0), g.x(bar.value ?? 0)].sort((p, q) => p - q) as [number, number];
  const colour = bar.colour ?? "var(--series-1)";
  const text = valueText(bar, spec);
  const words = `${bar.name}: ${text}${bar.note ? `, ${bar.note}` : ""}`;
  const name = s("text", { x: g.names - 8, y: y + 11, "text-anchor": "end", fill: "var(--ink)" }, bar.name);
  const row = s(
    "g",
    { class: spec.onpick ? "pick" : "" },
    s("title", {}, words),
    s("rect", { x: 0, y: y - 3, width: d.width, height: ROW, fill: "transparent" }),
  );
  row.append(
    s("rect", { x: a, y: y + 1, width: bar.value === null ? 0 : Math.max(0.75, b - a), height: ROW - 8, fill: colour }),
    s("text", { x: d.width, y: y + 11, "text-anchor": "end", fill: "var(--ink)" }, text),
  );
  if (bar.value === null && bar.missing)
    row.append(s("text", { x: g.x(0) + 6, y: y + 11, fill: "var(--warn)" }, bar.missing));
  if (bar.u && bar.value !== null) {
    const [from, to] = [g.x(bar.value - 2 * bar.u), g.x(bar.value + 2 * bar.u)];
    const mid = y + ROW / 2 - 2.5;
    for (const line of [
      [from, to, mid, mid],
      [from, from, mid - 4, mid + 4],
      [to, to, mid - 4, mid + 4],
    ] as const)
      row.append(
        s("line", { x1: line[0], x2: line[1], y1: line[2], y2: line[3], stroke: "var(--ink)", "stroke-width": 1.2 }),
      );
  }
  const pick = spec.onpick;
  if (pick) {
    row.setAttribute("tabindex", "0");
    row.setAttribute("role", "button");
    row.setAttribute("aria-label", words);
    for (const one of row.querySelectorAll("text")) one.setAttribute("aria-hidden", "true");
    pressed(row, () => pick(bar, i));
  }
  d.svg.append(row, name);
  if (errorName(bar.name)) explained(name, bar.name);
}

/** As a button: a click, Enter or space. */
function pressed(element: SVGElement, act: () => void): void {
  element.addEventListener("click", act);
  element.addEventListener("keydown", (event) => {
    if (event.key !== "Enter" && event.key !== " ") return;
    event.preventDefault();
    act();
  });
}

/** The name of an error leads to the glossary. */
function explained(text: SVGElement, name: string): void {
  text.setAttribute("class", "error-text-link");
  text.setAttribute("tabindex", "0");
  text.setAttribute("role", "button");
  text.setAttribute("aria-label", tr`${name}: what it is`);
  pressed(text, () => explain(name));
}

export function bars(host: HTMLElement, spec: BarSpec): Figure<BarSpec> {
  return figure(host, spec, (now) => ({
    title: now.title,
    draw: (d) => drawBars(d, now),
    columns: () => [
      { heading: "name", shown: tr`name`, values: now.bars.map((b) => b.name) },
      { heading: `value (${now.unit})`, shown: tr`value (${now.unit})`, values: now.bars.map((b) => b.value) },
      { heading: `u (${now.unit})`, values: now.bars.map((b) => b.u ?? null) },
    ],
    height: () => now.bars.length * ROW + 24,
  }));
}
