/** The text of a new set-up file from what was typed in a form. */

import { tr } from "../../words/index.ts";

/** Empty where nothing was typed. */
export interface SetUpForm {
  program: string;
  control: string;
  /** `G54`. */
  offset: string;
  /** By axis, in mm or deg. */
  positions: Record<string, { value: string; unit: string }>;
  tools: ToolForm[];
  start: Record<string, { value: string; unit: string }>;
  /** Edges and centre of a box in the workpiece frame, mm. */
  stock: { edges: [string, string, string]; centre: [string, string, string] };
  fixtures: { file: string; placement: string }[];
}

export interface ToolForm {
  number: string;
  name: string;
  /** From the gauge line to the tip, mm. */
  length: string;
  diameter: string;
  /** Diameter and length of the holder above the cutter, mm. */
  holder_diameter: string;
  holder_length: string;
}

/** A decimal comma counts as a point. */
export const plain = (typed: string): string => typed.trim().replace(",", ".");

/** What is wrong with a field; null for a number or nothing. */
export function wrongNumber(typed: string, at_least?: number): string | null {
  const text = plain(typed);
  if (text === "") return null;
  const value = Number(text);
  if (!Number.isFinite(value)) return tr`"${typed}" is not a number`;
  if (at_least !== undefined && value <= at_least) return tr`must be greater than ${at_least}`;
  return null;
}

const quoted = (text: string): string => JSON.stringify(text);
const quantity = (value: string, unit: string): string => `"${plain(value)} ${unit}"`;
const given = (value: string): boolean => plain(value) !== "";

function positions(values: SetUpForm["positions"]): string[] {
  return Object.entries(values)
    .filter(([, { value }]) => given(value))
    .map(([axis, { value, unit }]) => `${axis} = ${quantity(value, unit)}`);
}

function tool(form: ToolForm): string[] {
  const { diameter, length, holder_diameter, holder_length } = form;
  // A holder needs the length of the cutter before it.
  const cutter = Number(plain(length)) - Number(plain(holder_length));
  const has_holder = [diameter, length, holder_diameter, holder_length].every(given) && cutter > 0;
  return [
    "",
    `[tool.${plain(form.number)}]`,
    ...(given(form.name) ? [`name = ${quoted(form.name.trim())}`] : []),
    ...(given(length) ? [`length = ${quantity(length, "mm")}`] : []),
    ...(given(diameter) ? [`diameter = ${quantity(diameter, "mm")}`] : []),
    ...(has_holder
      ? [
          "# From the tip upwards: diameter and length of the cutter, then of the holder.",
          `shape = [[${quantity(diameter, "mm")}, ${quantity(String(cutter), "mm")}], [${quantity(holder_diameter, "mm")}, ${quantity(holder_length, "mm")}]]`,
        ]
      : []),
  ];
}

/** The file, in the order of docs/reference/program.md. */
export function setUpText(form: SetUpForm): string {
  const offsets = positions(form.positions);
  const start = positions(form.start);
  const { edges, centre } = form.stock;
  const lines = [
    `# Set-up of ${form.program}: work offset, tools, stock.`,
    `name = ${quoted(form.program)}`,
    ...(form.control ? [`control = ${quoted(form.control)}`] : []),
    ...(offsets.length > 0 ? [`workpiece_at = ${quoted(form.offset)}`] : []),
    "",
    "# Machine coordinates of the spindle gauge line at program zero, rotary axes at 0.",
    `[work_offset.${form.offset}]`,
    ...offsets,
    ...form.tools.filter((t) => given(t.number)).flatMap(tool),
    ...(start.length > 0 ? ["", "[start]", ...start] : []),
    ...(edges.every(given)
      ? [
          "",
          "[stock]",
          `box = "${edges.map(plain).join(" ")} mm"`,
          `placement = "${centre.map((v) => plain(v) || "0").join(" ")} mm"`,
        ]
      : []),
    ...form.fixtures
      .filter((f) => given(f.file))
      .flatMap((f) => [
        "",
        "[[fixture]]",
        `stl = ${quoted(f.file)}`,
        `unit = "mm"`,
        ...(given(f.placement) ? [`placement = "${f.placement.trim()} mm"`] : []),
      ]),
  ];
  return `${lines.join("\n")}\n`;
}
