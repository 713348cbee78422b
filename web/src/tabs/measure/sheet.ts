/** Readings while they are taken: rows of a sheet, typed or from a file, and the CSV that `identify` reads. */

import { tr } from "../../words/index.ts";
import type { ServeMeasureSheet } from "../../../types.d.ts";
import { Refusal } from "../../api.ts";

export type SheetHeader = ServeMeasureSheet["sheets"][number];

/** One reading: a cell for each column of the sheet. */
export interface Row {
  cells: string[];
  /** The name of its path, where that is known. */
  path?: string | undefined;
}

/** What is wrong with a cell, by its place. */
export interface BadCell {
  row: number;
  column: number;
  words: string;
}

const NUMBER = /^[+-]?(\d+(\.\d*)?|\.\d+)(e[+-]?\d+)?$/i;

/** "−1,5" as "-1.5"; null for what is no number. */
export function plainNumber(text: string): string | null {
  const plain = text.trim().replace("−", "-").replace(",", ".");
  return NUMBER.test(plain) ? plain : null;
}

/** The lines of comment at the head of a table, and the table without them. */
function withoutComments(text: string): { head: string; lines: string[] } {
  const lines = text.replace(/^\uFEFF/, "").split(/\r?\n/);
  const is_comment = (line: string): boolean => line.trimStart().startsWith("#");
  return {
    head: lines
      .filter(is_comment)
      .map((line) => `${line}\n`)
      .join(""),
    lines: lines.filter((line) => !is_comment(line) && line.trim() !== ""),
  };
}

/** Cells of a line; semicolons or tabs where the headings have them, else commas. Then decimals may have a comma. */
function separatorOf(heading: string): string {
  if (heading.includes(";")) return ";";
  return heading.includes("\t") ? "\t" : ",";
}

export class Sheet {
  readonly header: SheetHeader;
  /** Comments that go before the table. */
  head = "";
  rows: Row[];

  constructor(header: SheetHeader) {
    this.header = header;
    this.rows = this.empty();
  }

  private empty(): Row[] {
    return this.header.rows.map((cells, i) => ({ cells: [...cells], path: this.pathOf(i) }));
  }

  /** The name of the path of a station, counted from 0. */
  private pathOf(station: number): string | undefined {
    let before = 0;
    for (const { name, stations } of this.header.paths) {
      before += stations;
      if (station < before) return name;
    }
    return undefined;
  }

  /** The cells that were kept; paths are known as long as there is one row for each station. */
  restore(rows: readonly string[][]): void {
    const known = rows.length === this.header.rows.length;
    this.rows = rows.map((cells, i) => ({ cells, path: known ? this.pathOf(i) : undefined }));
  }

  /** Columns that are read, not commanded. */
  get read(): number[] {
    return this.header.columns.flatMap((column, j) => (column.read ? [j] : []));
  }

  clear(): void {
    this.rows = this.empty();
    this.head = "";
  }

  /** The stations once more. */
  again(): void {
    this.rows.push(...this.empty());
  }

  /** One more reading in the place of a row, right after it. */
  repeat(row: number): void {
    const of = this.rows[row];
    if (!of) return;
    const { read } = this;
    const cells = of.cells.map((cell, j) => (read.includes(j) ? "" : cell));
    this.rows.splice(row + 1, 0, { cells, path: of.path });
  }

  /** Rows with all of their readings. */
  get done(): number {
    return this.rows.filter((row) => this.read.every((j) => plainNumber(row.cells[j] ?? "") !== null)).length;
  }

  /** Cells that are no number, and those that are missing in a row that was begun. */
  bad(): BadCell[] {
    const { read } = this;
    return this.rows.flatMap(({ cells }, row) => {
      const begun = read.some((j) => (cells[j] ?? "").trim() !== "");
      if (!begun) return [];
      return read.flatMap((column): BadCell[] => {
        const text = (cells[column] ?? "").trim();
        const name = this.header.columns[column]?.name ?? "";
        if (text === "") return [{ row, column, words: tr`row ${row + 1}: ${name} is missing` }];
        if (plainNumber(text) === null)
          return [{ row, column, words: tr`row ${row + 1}: ${name} “${text}” is no number` }];
        return [];
      });
    });
  }

  /** Rows with readings as CSV; columns that some of them lack are left out where they are not needed. */
  csv(): string {
    const { columns } = this.header;
    const { read } = this;
    const rows = this.rows.filter(({ cells }) => read.every((j) => plainNumber(cells[j] ?? "") !== null));
    const optional = (name: string): boolean => ["group", "time_s"].includes(name);
    const kept = columns.flatMap(({ name }, j) =>
      optional(name) && rows.some(({ cells }) => (cells[j] ?? "") === "") ? [] : [j],
    );
    const line = (cells: readonly string[]): string => `${cells.join(",")}\n`;
    const of = (cells: readonly string[], j: number): string => plainNumber(cells[j] ?? "") ?? cells[j] ?? "";
    return [
      this.head,
      line(kept.map((j) => columns[j]?.name ?? "")),
      ...rows.map(({ cells }) => line(kept.map((j) => of(cells, j)))),
    ].join("");
  }

  /** Takes the rows of a table in place of its own; returns what was not used of it, in words. */
  take(name: string, text: string): string[] {
    const { head, lines } = withoutComments(text);
    const [heading, ...rest] = lines;
    if (heading === undefined || rest.length === 0)
      throw new Refusal(
        "empty-table",
        tr`${name} has no readings`,
        tr`One line of headings, then one row for each reading.`,
      );
    const separator = separatorOf(heading);
    const cellsOf = (line: string): string[] => line.split(separator).map((cell) => cell.trim());
    const names = cellsOf(heading);
    const { columns } = this.header;
    const at = columns.map((column) => names.indexOf(column.name));
    const missing = this.read.filter((j) => (at[j] ?? -1) < 0).map((j) => columns[j]?.name);
    if (missing.length > 0)
      throw new Refusal(
        "missing-column",
        tr`${name} has no column ${missing.join(", ")}`,
        tr`The readings of ${this.header.instrument} have the headings ${columns.map((column) => column.name).join(", ")}.`,
      );
    const has_places = columns.some((column, j) => !column.read && column.name.length === 1 && (at[j] ?? -1) >= 0);
    if (!has_places && rest.length !== this.header.rows.length)
      throw new Refusal(
        "missing-column",
        tr`${name} has ${rest.length} rows without positions, and there are ${this.header.rows.length} stations`,
        tr`Give the axes as columns (X, Y, Z in mm, A, B, C in degrees), or one row for each station.`,
      );
    const rows = rest.map((line, i) => {
      const cells = cellsOf(line);
      const station = has_places ? [] : (this.header.rows[i] ?? []);
      return columns.map((_, j) => {
        const from = at[j] ?? -1;
        const text = from < 0 ? (station[j] ?? "") : (cells[from] ?? "");
        // A number of the table; anything else stays, and is named.
        return plainNumber(text) ?? text;
      });
    });
    this.restore(rows);
    this.head = head;
    const unused = names.filter((one) => one && !columns.some((column) => column.name === one));
    return unused.length > 0 ? [tr`not used: ${unused.join(", ")}`] : [];
  }
}
