/** The text of a mapping file from what was chosen for each column: docs/reference/evaluation.md. */

import { tr } from "../../words/index.ts";
import { quoted } from "../../toml.ts";

export interface MappedColumn {
  /** Its heading; empty where there is none. */
  heading: string;
  /** Its name in our tables; empty if it is not used. */
  role: string;
  /** Empty where it has none. */
  unit: string;
  negate: boolean;
  /** What words of the file mean. */
  words: readonly (readonly [word: string, ours: string])[];
}

export interface MappedTable {
  separator: string;
  /** Empty: the numbers of the file decide. */
  decimal: string;
  heading_line: number | null;
  /** The line of the headings or of the first reading, from 1. */
  first_line: number;
  rows_below_headings: number;
  /** The beginning of the line after the last reading; empty if all lines are readings. */
  until: string;
  columns: readonly MappedColumn[];
}

const SEPARATORS: Record<string, string> = { "\t": "tab", " ": "spaces" };

/** Roles that were chosen for several columns are numbered in their order: `up_1`, `up_2`. */
export function roles(columns: readonly MappedColumn[], numbered: readonly string[]): string[] {
  const counts: Record<string, number> = {};
  return columns.map(({ role }) => {
    if (!numbered.includes(role)) return role;
    counts[role] = (counts[role] ?? 0) + 1;
    return `${role}_${counts[role]}`;
  });
}

/** What is wrong with the choice; null if nothing is. */
export function wrongColumns(columns: readonly MappedColumn[], names: readonly string[]): string | null {
  const used = names.filter((name) => name !== "");
  if (used.length < 2) return tr`State the meaning of at least two columns.`;
  const twice = used.find((name, i) => used.indexOf(name) !== i);
  if (twice) return tr`Two columns are "${twice}": leave one of them.`;
  const bare = columns.find((column) => column.role !== "" && column.unit === "?");
  return bare ? tr`The unit of "${bare.heading || bare.role}" is not stated.` : null;
}

/** A heading names its column where it is the only one of this name. */
function place(table: MappedTable, at: number): string {
  const heading = table.columns[at]?.heading ?? "";
  const same = table.columns.filter((other) => other.heading.toLowerCase() === heading.toLowerCase());
  const named = table.heading_line !== null && heading !== "" && same.length === 1;
  return named ? quoted(heading) : String(at + 1);
}

function words(of: MappedColumn["words"]): string[] {
  const meant = [...new Set(of.map(([, ours]) => ours).filter(Boolean))];
  if (meant.length === 0) return [];
  const lists = meant.map((ours) => {
    const theirs = of.filter(([, other]) => other === ours).map(([word]) => quoted(word));
    return `${ours} = [${theirs.join(", ")}]`;
  });
  return [`words = { ${lists.join(", ")} }`];
}

/** The file; `names` are the roles with their numbers. */
export function mappingText(readings: string, table: MappedTable, names: readonly string[]): string {
  const lines = [
    `# What the columns of ${readings.replace(/^.*\//, "")} are.`,
    `separator = ${quoted(SEPARATORS[table.separator] ?? table.separator)}`,
    ...(table.decimal ? [`decimal = ${quoted(table.decimal)}`] : []),
    ...(table.heading_line === null ? ["headings = false"] : []),
    ...(table.rows_below_headings > 0 ? [`rows_below_headings = ${table.rows_below_headings}`] : []),
    ...(table.first_line > 1 ? [`skip_rows = ${table.first_line - 1}`] : []),
    ...(table.until.trim() ? [`until = ${quoted(table.until.trim())}`] : []),
    ...table.columns.flatMap((column, at) => {
      const name = names[at];
      if (!name) return [];
      return [
        "",
        `[columns.${name}]`,
        `column = ${place(table, at)}`,
        ...(column.unit ? [`unit = ${quoted(column.unit)}`] : []),
        ...(column.negate ? ["sign = -1"] : []),
        ...words(column.words),
      ];
    }),
  ];
  return `${lines.join("\n")}\n`;
}
