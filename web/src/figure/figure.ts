/** What every figure has: a title, a drawing that follows its host's size and the theme, a menu to save it. */

import { tr } from "../words/index.ts";
import { download, h, perFrame, s } from "../dom.ts";
import { onTheme } from "../theme.ts";
import { showData } from "./data.ts";

/** Columns of the data of a figure, as they go into the CSV file: heading with unit, values. */
export interface Column {
  heading: string;
  /** The heading on the page, where that of the file stays English. */
  shown?: string;
  values: ArrayLike<number | string | null>;
}

export interface Drawing {
  svg: SVGSVGElement;
  width: number;
  height: number;
}

export interface FigureSource {
  title: string;
  /** Draws everything into an empty svg. */
  draw(drawing: Drawing): void;
  columns(): Column[];
  /** Height for a width, px. */
  height(width: number): number;
}

export interface Figure<D> {
  readonly element: HTMLElement;
  update(data: D): void;
  /** A standalone file: colours resolved, no style sheet needed. */
  svgText(): string;
  csvText(): string;
  dispose(): void;
}

/** "Radial deviation (µm)" -> "radial-deviation-um", for file names. */
export function fileName(title: string): string {
  return (
    title
      .toLowerCase()
      .replaceAll("µ", "u")
      .replace(/[^a-z0-9äöüß\p{Script=Han}]+/gu, "-")
      .replace(/^-|-$/g, "") || "figure"
  );
}

export function csvOf(columns: readonly Column[]): string {
  const rows = Math.max(0, ...columns.map((c) => c.values.length));
  const cell = (value: number | string | null | undefined): string => {
    if (value === null || value === undefined || (typeof value === "number" && Number.isNaN(value))) return "";
    const text = String(value);
    return /[",\n]/.test(text) ? `"${text.replaceAll('"', '""')}"` : text;
  };
  const lines = [columns.map((c) => cell(c.heading)).join(",")];
  for (let i = 0; i < rows; i++) lines.push(columns.map((c) => cell(c.values[i])).join(","));
  return `${lines.join("\n")}\n`;
}

const PAINTED = ["fill", "stroke", "stop-color"] as const;

/** The drawing as a file of its own: variables replaced by their values now. */
export function standaloneSvg(svg: SVGSVGElement): string {
  const copy = svg.cloneNode(true) as SVGSVGElement;
  const style = getComputedStyle(document.documentElement);
  for (const node of [copy, ...copy.querySelectorAll("*")]) {
    for (const name of PAINTED) {
      const variable = /^var\((--[\w-]+)\)$/.exec(node.getAttribute(name) ?? "")?.[1];
      if (variable) node.setAttribute(name, style.getPropertyValue(variable).trim());
    }
    if (node.getAttribute("data-hover") !== null) node.remove();
  }
  copy.setAttribute("xmlns", "http://www.w3.org/2000/svg");
  copy.setAttribute("font-family", "Helvetica, Arial, sans-serif");
  copy.insertBefore(
    s("rect", { width: "100%", height: "100%", fill: style.getPropertyValue("--surface").trim() }),
    copy.firstChild,
  );
  return `<?xml version="1.0" encoding="UTF-8"?>\n${new XMLSerializer().serializeToString(copy)}\n`;
}

/** Rasterises at twice the size on screen. */
export async function pngOf(svg_text: string, width: number, height: number): Promise<Blob | null> {
  const image = new Image();
  const url = URL.createObjectURL(new Blob([svg_text], { type: "image/svg+xml" }));
  try {
    await new Promise((resolve, reject) => {
      image.onload = resolve;
      image.onerror = reject;
      image.src = url;
    });
    const canvas = h("canvas", { width: 2 * width, height: 2 * height });
    canvas.getContext("2d")?.drawImage(image, 0, 0, 2 * width, 2 * height);
    return await new Promise((resolve) => canvas.toBlob(resolve));
  } finally {
    URL.revokeObjectURL(url);
  }
}

export interface Exports {
  svg?: () => string;
  png: () => Promise<Blob | null>;
  csv: () => string;
  columns: () => Column[];
}

/** The small menu at the upper right of a figure: its numbers as a table, SVG, PNG, CSV. */
export function exportMenu(title: () => string, exports: Exports): HTMLElement {
  const item = (label: string, run: () => void): HTMLElement =>
    h("button", { class: "figure-save", ariaLabel: tr`Save as ${label}`, onclick: run }, label);
  const table = h(
    "button",
    {
      class: "figure-save",
      title: tr`The numbers of this figure as a table`,
      onclick: () => showData(title(), exports.columns()),
    },
    tr`Table`,
  );
  const save = h(
    "span",
    { class: "figure-menu", role: "group", ariaLabel: tr`This figure as numbers and files` },
    table,
  );
  const svg = exports.svg;
  if (svg) save.append(item("SVG", () => download(`${fileName(title())}.svg`, svg(), "image/svg+xml")));
  save.append(
    item("PNG", () => void exports.png().then((blob) => blob && download(`${fileName(title())}.png`, blob))),
    item("CSV", () => download(`${fileName(title())}.csv`, exports.csv(), "text/csv")),
  );
  return save;
}

/** Puts a figure into `host`. `make` says how to draw given data. */
export function figure<D>(host: HTMLElement, data: D, make: (data: D) => FigureSource): Figure<D> {
  let source = make(data);
  const title = h("figcaption", { class: "figure-title" });
  const place = h("div", { class: "figure-place" });
  const csvText = (): string => csvOf(source.columns());
  let svg = s("svg");
  let [width, height] = [0, 0];
  const svgText = (): string => standaloneSvg(svg);
  const menu = exportMenu(() => source.title, {
    svg: svgText,
    png: () => pngOf(svgText(), width, height),
    csv: csvText,
    columns: () => source.columns(),
  });
  const element = h("figure", { class: "figure" }, h("div", { class: "figure-head" }, title, menu), place);
  host.append(element);

  const draw = (): void => {
    width = Math.max(120, Math.floor(place.clientWidth));
    height = Math.round(source.height(width));
    title.textContent = source.title;
    svg = s("svg", {
      width,
      height,
      viewBox: `0 0 ${width} ${height}`,
      role: "img",
      "aria-label": source.title,
      tabindex: "0",
      "font-size": "11",
      class: "figure-svg",
    });
    source.draw({ svg, width, height });
    // What holds buttons is no picture to a screen reader: they would be lost in it.
    if (svg.querySelector("[tabindex]")) {
      svg.setAttribute("role", "group");
      svg.removeAttribute("tabindex");
    }
    const focused = place.contains(document.activeElement);
    place.replaceChildren(svg);
    if (focused) svg.focus({ preventScroll: true });
  };
  let drawn_width = 0;
  const watch = new ResizeObserver(
    perFrame(() => {
      if (place.clientWidth === drawn_width || place.clientWidth === 0) return;
      drawn_width = place.clientWidth;
      draw();
    }),
  );
  watch.observe(place);
  // Colours are variables, but some are mixed in script: drawn again after a change of theme.
  const stop = onTheme(() => draw());
  draw();
  return {
    element,
    update(next) {
      source = make(next);
      draw();
    },
    svgText,
    csvText,
    dispose() {
      watch.disconnect();
      stop();
      element.remove();
    },
  };
}

/** About how many letters wide a text is: a Chinese sign is as wide as two. */
export const letters = (text: string): number =>
  [...text].reduce((sum, sign) => sum + (/[\u2e80-\uffef]/.test(sign) ? 1.8 : 1), 0);

// ---- axes ------------------------------------------------------------------------------------

/** At most about `count` round values from `low` to `high`. */
export function ticks(low: number, high: number, count: number): { values: number[]; digits: number; step: number } {
  const span = high - low;
  if (!(span > 0) || !Number.isFinite(span)) return { values: [low], digits: 0, step: 1 };
  const raw = span / Math.max(1, count);
  const power = 10 ** Math.floor(Math.log10(raw));
  const step = [1, 2, 5, 10].map((m) => m * power).find((x) => x >= raw * 0.999) ?? 10 * power;
  const values: number[] = [];
  for (let i = Math.ceil(low / step - 1e-9); i * step <= high + 1e-9 * span; i++)
    values.push(i * step === 0 ? 0 : i * step);
  return { values, digits: Math.max(0, -Math.floor(Math.log10(step) + 1e-9)), step };
}

/** A round number not below, finer than 1, 2, 5. */
export const finelyRounded = (x: number): number => {
  const power = 10 ** Math.floor(Math.log10(x));
  return [1, 1.5, 2, 3, 4, 5, 6, 8, 10].map((m) => m * power).find((m) => m >= x) ?? x;
};

/** The least round number of 1, 2, 5 × 10ⁿ that is not below x (or the greatest not above). */
export function roundNumber(x: number, up = true): number {
  if (!(x > 0)) return 1;
  const power = 10 ** Math.floor(Math.log10(x));
  const steps = [1, 2, 5, 10].map((m) => m * power);
  return up
    ? (steps.find((y) => y >= x * 0.9999) ?? 10 * power)
    : (steps.reverse().find((y) => y <= x * 1.0001) ?? power);
}

/** Widened by a little, so that nothing lies on the frame; not empty. */
export function padded([low, high]: [number, number], share = 0.06): [number, number] {
  if (low === high) {
    const by = Math.abs(low) > 0 ? 0.1 * Math.abs(low) : 1;
    return [low - by, high + by];
  }
  const by = share * (high - low);
  return [low - by, high + by];
}

/** "position (mm)". */
export function axisTitle(label: string, unit?: string): string {
  return unit ? `${label} (${unit})` : label;
}
