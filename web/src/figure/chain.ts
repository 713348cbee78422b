/** The chain of a machine as a picture: workpiece … bed … tool. */

import { tr, trText } from "../words/index.ts";
import type { Link } from "../api.ts";
import { s } from "../dom.ts";
import { deg, mm, NARROW_SPACE, number } from "../format.ts";
import { figure, letters, type Figure } from "./figure.ts";

export interface ChainSpec {
  title: string;
  links: readonly Link[];
  onhover?: (name: string | null) => void;
}

/** "0 … 6200 mm", "±135 °". */
export function travelText(link: Pick<Link, "kind" | "travel">): string {
  if (link.kind !== "linear" && link.kind !== "rotary") return "";
  if (!link.travel) return tr`no travel stated`;
  if (typeof link.travel === "string") return trText(link.travel);
  const [from, to] = link.travel;
  const unit = (v: number, digits: number): string => (link.kind === "linear" ? mm(v, digits) : deg(v, digits));
  const digits = Number.isInteger(from) && Number.isInteger(to) ? 0 : 1;
  if (from === -to) return `±${unit(to, digits)}`;
  return `${number(from, digits)}${NARROW_SPACE}…${NARROW_SPACE}${unit(to, digits)}`;
}

interface Cell {
  name: string;
  below: string;
  kind: Link["kind"] | "bed";
  body: string;
}

/** Chain order with the bed where the carriers change. */
function cellsOf(links: readonly Link[]): Cell[] {
  const cells: Cell[] = [];
  let bed = false;
  for (const link of links) {
    if (!bed && link.carries === "tool" && link.kind !== "workpiece") {
      cells.push({ name: "bed", below: "", kind: "bed", body: "b" });
      bed = true;
    }
    const prime = link.carries === "workpiece" ? "\u2032" : "";
    const name = link.kind === "workpiece" ? "workpiece" : link.kind === "tool" ? "tool" : `${link.name}${prime}`;
    cells.push({ name, below: travelText(link), kind: link.kind, body: link.name });
  }
  return cells;
}

/** As it is shown. */
const nameOf = ({ name, kind }: Cell): string =>
  ({ bed: tr`bed`, workpiece: tr`workpiece`, tool: tr`tool` })[kind as string] ?? name;

/** A double arrow for a slide, an arc for a turn. */
function glyph(kind: Cell["kind"], x: number, y: number): SVGElement[] {
  const line = { fill: "none", stroke: "var(--muted)", "stroke-width": 1.3 };
  if (kind === "linear")
    return [
      s("path", {
        d: `M${x - 11} ${y}H${x + 11}M${x - 7} ${y - 3.5}L${x - 11} ${y}L${x - 7} ${y + 3.5}M${x + 7} ${y - 3.5}L${x + 11} ${y}L${x + 7} ${y + 3.5}`,
        ...line,
      }),
    ];
  if (kind === "rotary")
    return [
      s("path", {
        d: `M${x - 9} ${y + 3}A9 7 0 1 1 ${x + 9} ${y + 3}M${x + 9.5} ${y - 2.5}L${x + 9} ${y + 3}L${x + 4} ${y + 1.2}`,
        ...line,
      }),
    ];
  return [];
}

export function chainPicture(host: HTMLElement, spec: ChainSpec): Figure<ChainSpec> {
  return figure(host, spec, (now) => {
    const cells = cellsOf(now.links);
    return {
      title: now.title,
      height: () => 64,
      columns: () => [
        { heading: "link", shown: tr`link`, values: cells.map((c) => c.name) },
        {
          heading: "travel (mm or deg)",
          shown: tr`travel (mm or deg)`,
          values: cells.map((c) => c.below),
        },
      ],
      draw: ({ svg, width }) => {
        const step = width / cells.length;
        const box = Math.min(64, step - 10);
        svg.append(
          s("line", {
            x1: step / 2,
            x2: width - step / 2,
            y1: 24,
            y2: 24,
            stroke: "var(--line-strong)",
            "stroke-width": 3,
          }),
        );
        cells.forEach((cell, i) => {
          const x = (i + 0.5) * step;
          const ends = cell.kind === "bed" || cell.kind === "workpiece" || cell.kind === "tool";
          const fill =
            cell.kind === "bed"
              ? "var(--line)"
              : cell.kind === "workpiece"
                ? "var(--scene-part)"
                : cell.kind === "rotary"
                  ? "var(--accent-soft)"
                  : "var(--raised)";
          const group = s(
            "g",
            {},
            s("title", {}, cell.below || nameOf(cell)),
            s("rect", {
              x: x - box / 2,
              y: 3,
              width: box,
              height: 42,
              rx: 3,
              fill,
              stroke: "var(--line-strong)",
              opacity: cell.kind === "workpiece" ? 0.75 : 1,
            }),
            s(
              "text",
              {
                x,
                y: ends ? 28 : 20,
                "text-anchor": "middle",
                fill: "var(--ink)",
                "font-weight": "600",
                "font-size": ends && box >= 54 ? Math.min(11.5, (box - 8) / 5.2) : 12.5,
              },
              // Where the word would be too small, the letter of the chain.
              ends && box < 54 ? cell.body : nameOf(cell),
            ),
            ...glyph(cell.kind, x, 34),
          );
          group.addEventListener("pointerenter", () => now.onhover?.(cell.body));
          group.addEventListener("pointerleave", () => now.onhover?.(null));
          svg.append(group);
          // Words that would run into their neighbours are left to the tooltip.
          const size = Math.min(10.5, (step - 6) / (0.62 * letters(cell.below)));
          if (size > 8)
            svg.append(
              s("text", { x, y: 60, "text-anchor": "middle", fill: "var(--muted)", "font-size": size }, cell.below),
            );
        });
      },
    };
  });
}
