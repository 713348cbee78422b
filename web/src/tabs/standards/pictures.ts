/** The charts of the standards, from what the server says is in them. */

import { tr, trText } from "../../words/index.ts";
import type { PictureEntry } from "../../../types.d.ts";
import {
  lineChart,
  polar,
  seriesColour,
  type ChartSpec,
  type Figure,
  type PolarSpec,
  type Series,
} from "../../figure/index.ts";
import { h } from "../../dom.ts";
import type { Frame } from "../../frame.ts";

type Slice = [first: number, count: number];

export type Picture = PictureEntry;
export type ScatterPicture = Extract<Picture, { kind: "scatter" }>;
export type PolarPicture = Extract<Picture, { kind: "polar" }>;

interface Arrays {
  line: Float64Array;
  points: Float64Array;
}

/** The sixth colour looks much like the first: the seventh comes before it. */
function colourOf(index: number): string {
  return seriesColour(index === 5 ? 6 : index === 6 ? 5 : index);
}

/** One column of a slice of entries of `width` numbers. */
function column(from: Float64Array, [first, count]: Slice, width: number, j: number): Float64Array {
  return Float64Array.from({ length: count }, (_, i) => from[width * (first + i) + j] as number);
}

/** "target, mm" -> label and unit; a lone unit stays as it is. */
function axisOf(text: string): { label: string; unit?: string } {
  const [, label, unit] = /^(.*)(?:, |，)(.*)$/.exec(trText(text)) ?? [];
  return label === undefined || unit === undefined ? { label: text } : { label, unit };
}

function seriesOf(picture: ScatterPicture, { line, points }: Arrays): Series[] {
  const series: Series[] = [];
  for (const band of picture.bands) {
    const colour = colourOf(band.colour);
    const half = column(line, band.line, 3, 2);
    series.push({
      name: trText(band.label),
      colour,
      x: column(line, band.line, 3, 0),
      y: column(line, band.line, 3, 1),
      ...(half.some((w) => w > 0) ? { half } : {}),
    });
    if (band.points[1] > 0)
      series.push({
        name: tr`${trText(band.label)}, readings`,
        quiet: true,
        colour,
        line: false,
        points: true,
        x: column(points, band.points, 2, 0),
        y: column(points, band.points, 2, 1),
      });
  }
  if (picture.dashed[1] > 0)
    series.push({
      name: tr`mean of both`,
      colour: "var(--ink)",
      dash: "5 4",
      x: column(points, picture.dashed, 2, 0),
      y: column(points, picture.dashed, 2, 1),
    });
  return series;
}

function chartSpec(picture: ScatterPicture, arrays: Arrays): ChartSpec {
  const series = seriesOf(picture, arrays);
  const spec: ChartSpec = {
    title: trText(picture.title),
    x: { ...axisOf(picture.x), digits: 1 },
    y: axisOf(picture.y),
    series,
    height: 330,
  };
  if (!picture.from_zero) return spec;
  // Zero belongs on the axis even if all readings lie on one side of it.
  const edges = series.flatMap((one) =>
    Array.from(one.y, (v, i) => [v - (one.half?.[i] ?? 0), v + (one.half?.[i] ?? 0)]).flat(),
  );
  if (edges.every((v) => v > 0)) spec.y.min = 0;
  if (edges.every((v) => v < 0)) spec.y.max = 0;
  return spec;
}

function polarSpec(
  picture: PolarPicture,
  { points }: Arrays,
  circle: { radius_mm?: number; axes?: [string, string] },
): PolarSpec {
  return {
    title: trText(picture.title),
    unit: "µm",
    height: 560,
    ...circle,
    series: picture.lines.map((one) => ({
      name: trText(one.label),
      colour: colourOf(one.colour),
      angle_rad: column(points, one.points, 2, 0),
      deviation: column(points, one.points, 2, 1),
    })),
  };
}

/** Draws all pictures into `host`; returns the figures, to be disposed of. */
export function drawPictures(
  host: HTMLElement,
  frame: Frame<unknown>,
  pictures: readonly Picture[],
  circle: { radius_mm?: number; axes?: [string, string] },
): Figure<never>[] {
  const arrays = { line: frame.f64("line"), points: frame.f64("points") };
  return pictures.map((picture) => {
    const panel = h("section", { class: "panel picture" });
    host.append(panel);
    const drawn =
      picture.kind === "polar"
        ? polar(panel, polarSpec(picture, arrays, circle))
        : lineChart(panel, chartSpec(picture, arrays));
    if (picture.note) panel.append(h("p", { class: "muted note" }, trText(picture.note)));
    return drawn as Figure<never>;
  });
}
