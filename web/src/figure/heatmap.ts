/** A matrix as coloured cells (correlations of what was identified). */

import { s } from "../dom.ts";
import { number, withUnit } from "../format.ts";
import { isDark } from "../theme.ts";
import { css, diverging, divergingDark, rangeOf, sequential, type ColourMap } from "./colours.ts";
import { figure, letters, type Drawing, type Figure } from "./figure.ts";

export interface HeatmapSpec {
  title: string;
  rows: string[];
  columns: string[];
  /** Row by row. */
  values: ArrayLike<number>;
  unit?: string;
  digits?: number;
  /** Default [−1, 1] with a diverging map if values are signed. */
  range?: [number, number];
  /** What a cell without a number means, for the readout. */
  blank?: string;
}

function drawHeatmap(d: Drawing, spec: HeatmapSpec): void {
  const [n, m] = [spec.rows.length, spec.columns.length];
  const named = m <= 60;
  const left = named ? 10 + 7.4 * Math.max(3, ...spec.rows.map((r) => letters(r))) : 10;
  const top = named ? 10 + 7.4 * Math.max(3, ...spec.columns.map((c) => letters(c))) : 10;
  const cell = Math.max(2, Math.min(26, (d.width - left - 4) / Math.max(1, m)));
  const found = rangeOf(spec.values);
  const range = spec.range ?? (found[0] < 0 ? [-Math.max(-found[0], found[1]), Math.max(-found[0], found[1])] : found);
  const map = range[0] < 0 ? (isDark() ? divergingDark : diverging) : sequential;
  const readout = s("text", { x: left, y: top + n * cell + 16, fill: "var(--ink)", "data-hover": "" });
  for (let i = 0; i < n; i++) {
    for (let j = 0; j < m; j++) {
      const value = spec.values[i * m + j] as number;
      const rect = s("rect", {
        x: left + j * cell,
        y: top + i * cell,
        width: cell - (cell > 6 ? 1 : 0),
        height: cell - (cell > 6 ? 1 : 0),
        fill: Number.isFinite(value) ? css(map((value - range[0]) / (range[1] - range[0] || 1))) : "var(--line)",
      });
      rect.addEventListener("pointerenter", () => (readout.textContent = cellText(spec, i, j)));
      d.svg.append(rect);
      if (cell >= 25 && Number.isFinite(value))
        d.svg.append(
          s(
            "text",
            {
              x: left + (j + 0.5) * cell,
              y: top + (i + 0.5) * cell + 3,
              "text-anchor": "middle",
              "font-size": 8,
              fill: inkOn(map, value, range),
              "pointer-events": "none",
            },
            number(value, 1),
          ),
        );
    }
    if (named && cell >= 9)
      d.svg.append(
        s(
          "text",
          {
            x: left - 6,
            y: top + (i + 0.5) * cell + 4,
            "text-anchor": "end",
            fill: "var(--muted)",
            "font-size": Math.min(11, cell),
          },
          spec.rows[i] ?? "",
        ),
      );
  }
  if (named && cell >= 9)
    spec.columns.forEach((name, j) =>
      d.svg.append(
        s(
          "text",
          {
            transform: `translate(${left + (j + 0.5) * cell + 4} ${top - 6}) rotate(-90)`,
            fill: "var(--muted)",
            "font-size": Math.min(11, cell),
          },
          name,
        ),
      ),
    );
  d.svg.append(readout);
  addCellKeys(d, spec, readout);
}

/** What can be read on the colour of a cell. */
function inkOn(map: ColourMap, value: number, range: [number, number]): string {
  if (map === sequential) return value - range[0] > 0.55 * (range[1] - range[0]) ? "#15191e" : "#ffffff";
  return Math.abs(value) > 0.6 * range[1] ? "var(--surface)" : "var(--ink)";
}

/** "EX0C – A x: 10.00 µm". */
function cellText(spec: HeatmapSpec, i: number, j: number): string {
  const value = spec.values[i * spec.columns.length + j] as number;
  const text = Number.isFinite(value)
    ? withUnit(value, spec.digits ?? 2, spec.unit ?? "")
    : (spec.blank ?? withUnit(value, 2, ""));
  return `${spec.rows[i]} – ${spec.columns[j]}: ${text}`;
}

/** Arrow keys walk through the cells and read them out. */
function addCellKeys(d: Drawing, spec: HeatmapSpec, readout: SVGTextElement): void {
  const [n, m] = [spec.rows.length, spec.columns.length];
  let [i, j] = [0, -1];
  d.svg.addEventListener("keydown", (event) => {
    const step = { ArrowLeft: [0, -1], ArrowRight: [0, 1], ArrowUp: [-1, 0], ArrowDown: [1, 0] }[event.key];
    if (!step) return;
    event.preventDefault();
    i = Math.max(0, Math.min(n - 1, i + (step[0] as number)));
    j = Math.max(0, Math.min(m - 1, j + (step[1] as number)));
    readout.textContent = cellText(spec, i, j);
  });
}

export function heatmap(host: HTMLElement, spec: HeatmapSpec): Figure<HeatmapSpec> {
  return figure(host, spec, (now) => ({
    title: now.title,
    draw: (d) => drawHeatmap(d, now),
    columns: () => [
      { heading: now.unit ? `(${now.unit})` : "", values: now.rows },
      ...now.columns.map((heading, j) => ({
        heading,
        values: now.rows.map((_, i) => now.values[i * now.columns.length + j] ?? null),
      })),
    ],
    height: (width) => {
      const left = 10 + 7.4 * Math.max(3, ...now.rows.map((r) => letters(r)));
      const top = 10 + 7.4 * Math.max(3, ...now.columns.map((c) => letters(c)));
      return (
        top + 24 + now.rows.length * Math.max(2, Math.min(26, (width - left - 4) / Math.max(1, now.columns.length)))
      );
    },
  }));
}
