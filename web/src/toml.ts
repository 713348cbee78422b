/** Small TOML texts from the fields of a form; nothing is written for an empty field. */

import { tr } from "./words/index.ts";

/** A field; its value is text, with its unit where it has one. */
export interface Field {
  /** `uncertainty`; empty at the top of the file. `[[x]]` is written for a name that ends in `[]`. */
  section: string;
  key: string;
  label: string;
  /** What it looks like. */
  example: string;
  /** A date is written without quotes; several texts stand between commas. */
  kind?: "text" | "date" | "texts";
  needed?: boolean;
  /** What it must look like, and how that is said. */
  pattern?: readonly [RegExp, string];
}

const DATE: Required<Field>["pattern"] = [/^\d{4}-\d{2}-\d{2}$/, tr`a date is written 2026-11-28`];

/** A field of text. */
export const field = (section: string, key: string, label: string, example: string): Field => ({
  section,
  key,
  label,
  example,
});

export const date = (section: string, key: string, label: string): Field => ({
  ...field(section, key, label, "2026-11-28"),
  kind: "date",
  pattern: DATE,
});

export const quoted = (text: string): string => JSON.stringify(text);

/** By section and key. */
export type Values = Record<string, string>;

export const nameOf = (field: Pick<Field, "section" | "key">): string =>
  field.section ? `${field.section}.${field.key}` : field.key;

/** What is wrong with a field; null for a good one or nothing. */
export function wrongField({ pattern, label, needed }: Field, value: string): string | null {
  const text = value.trim();
  if (needed && text === "") return tr`${label}: it is needed`;
  return text === "" || !pattern || pattern[0].test(text) ? null : `${label}: ${pattern[1]}`;
}

function written({ kind, key }: Field, text: string): string {
  if (kind === "date") return `${key} = ${text}`;
  if (kind === "texts") {
    const all = text.split(",").map((one) => quoted(one.trim()));
    return `${key} = [${all.join(", ")}]`;
  }
  return `${key} = ${quoted(text)}`;
}

/** The lines of a file: a comment, then section by section. */
export function tomlOf(comment: string, fields: readonly Field[], values: Values): string {
  const lines = [`# ${comment}`];
  for (const section of [...new Set(fields.map((field) => field.section))]) {
    const rows = fields
      .filter((field) => field.section === section)
      .flatMap((field) => {
        const text = values[nameOf(field)]?.trim() ?? "";
        return text === "" ? [] : [written(field, text)];
      });
    if (rows.length === 0) continue;
    if (section) lines.push("", section.endsWith("[]") ? `[[${section.slice(0, -2)}]]` : `[${section}]`);
    lines.push(...rows);
  }
  return `${lines.join("\n")}\n`;
}
