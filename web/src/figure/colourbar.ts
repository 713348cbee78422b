/** The scale of a coloured picture. */

import { tr } from "../words/index.ts";
import { s } from "../dom.ts";
import { number } from "../format.ts";
import { css, sequential, type ColourMap } from "./colours.ts";
import { letters, ticks } from "./figure.ts";

export interface ColourBarSpec {
  title: string;
  unit: string;
  range: [number, number];
  map?: ColourMap | undefined;
}

/** A vertical bar with ticks; 1 px steps of the map. */
export function colourBar(spec: ColourBarSpec): SVGSVGElement {
  const height = 180;
  const top = 28;
  const map = spec.map ?? sequential;
  const [low, high] = spec.range;
  const words = `${spec.title} (${spec.unit})`;
  const width = Math.max(96, 12 + 6.9 * letters(words));
  const right = width - 6;
  const svg = s("svg", {
    class: "colour-bar",
    width,
    height: height + top + 12,
    role: "img",
    "aria-label": tr`${spec.title}: ${number(low, 2)} to ${number(high, 2)} ${spec.unit}`,
    "font-size": "11",
  });
  svg.append(s("text", { x: right, y: 16, "text-anchor": "end", fill: "var(--ink)", "font-weight": "600" }, words));
  for (let i = 0; i < 60; i++)
    svg.append(
      s("rect", {
        x: right - 14,
        y: top + ((59 - i) * height) / 60,
        width: 14,
        height: height / 60 + 0.5,
        fill: css(map((i + 0.5) / 60)),
      }),
    );
  const { values, digits } = ticks(low, high, 6);
  for (const value of values) {
    const y = high > low ? top + height * (1 - (value - low) / (high - low)) : top + height / 2;
    svg.append(
      s("line", { x1: right - 18, x2: right - 14, y1: y, y2: y, stroke: "var(--muted)" }),
      s("text", { x: right - 21, y: y + 4, "text-anchor": "end", fill: "var(--ink)" }, number(value, digits)),
    );
  }
  return svg;
}
