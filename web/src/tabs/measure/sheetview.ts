/** The sheet as a table to type into. */

import { tr } from "../../words/index.ts";
import { fill, h } from "../../dom.ts";
import { plainNumber, type Sheet } from "./sheet.ts";

const FEED = "feed_mm_per_min";

/** More rows than this make a table slow. */
const MOST_ROWS = 400;

export class SheetView {
  readonly element = h("div", { class: "readings-sheet", tabindex: "-1" });
  private readonly changed: () => void;
  private sheet: Sheet | null = null;
  private from = 0;

  constructor(changed: () => void) {
    this.changed = changed;
  }

  show(sheet: Sheet, from = 0): void {
    this.sheet = sheet;
    this.from = Math.max(0, Math.min(from, sheet.rows.length - 1));
    this.draw();
  }

  private draw(): void {
    const { sheet } = this;
    if (!sheet) return;
    const { columns } = sheet.header;
    const to = Math.min(sheet.rows.length, this.from + MOST_ROWS);
    const shown = shownColumns(sheet);
    const head = shown.map((j) => {
      const { name, read } = columns[j] as { name: string; read: boolean };
      return h(
        "th",
        { class: `number ${read ? "read" : ""}`, scope: "col", title: name },
        name === FEED ? tr`feed, mm/min` : name,
      );
    });
    const rows = sheet.rows.slice(this.from, to).flatMap((row, k) => {
      const begins = row.path !== undefined && (k === 0 || sheet.rows[this.from + k - 1]?.path !== row.path);
      const heading = h("tr", { class: "path-row" }, h("th", { colspan: head.length + 2 }, tr`Path ${row.path}`));
      return [...(begins ? [heading] : []), this.row(sheet, shown, this.from + k)];
    });
    fill(
      this.element,
      sheet.rows.length > MOST_ROWS ? this.pages(sheet.rows.length) : null,
      h(
        "table",
        { ariaLabel: tr`Readings of ${sheet.header.instrument}` },
        h("thead", {}, h("tr", {}, h("th", { class: "number", scope: "col" }, tr`No.`), head, h("td", {}))),
        h("tbody", {}, rows),
      ),
    );
  }

  private pages(count: number): HTMLElement {
    const starts = Array.from({ length: Math.ceil(count / MOST_ROWS) }, (_, i) => i * MOST_ROWS);
    const select = h(
      "select",
      {
        ariaLabel: tr`Rows that are shown`,
        onchange: () => {
          this.from = Number(select.value);
          this.draw();
        },
      },
      starts.map((from) => h("option", { value: from }, tr`rows ${from + 1} to ${Math.min(count, from + MOST_ROWS)}`)),
    );
    select.value = String(this.from - (this.from % MOST_ROWS));
    return h("div", { class: "row" }, select, h("span", { class: "muted" }, tr`of ${count}`));
  }

  private row(sheet: Sheet, shown: readonly number[], i: number): HTMLElement {
    const { columns } = sheet.header;
    const cells = sheet.rows[i]?.cells ?? [];
    const one = (text: string, j: number): HTMLElement => {
      const column = columns[j];
      if (!column?.read) return h("td", { class: "number muted" }, short(text));
      const input = h("input", {
        type: "text",
        inputmode: "decimal",
        class: "reading",
        value: text,
        ariaLabel: tr`${column.name} of row ${i + 1}`,
        ariaInvalid: String(isBad(text)),
        oninput: () => {
          cells[j] = input.value;
          input.setAttribute("aria-invalid", String(isBad(input.value)));
          this.changed();
        },
        onkeydown: (event: KeyboardEvent) => this.move(event, i, j),
        dataCell: `${i}-${j}`,
      });
      return h("td", { class: "number" }, input);
    };
    const again = (): void => {
      sheet.repeat(i);
      this.draw();
      this.changed();
      this.focus(i + 1, sheet.read[0] ?? 0);
    };
    return h(
      "tr",
      { dataRow: i, title: rest(sheet, shown, cells) },
      h("td", { class: "number muted" }, String(i + 1)),
      shown.map((j) => one(cells[j] ?? "", j)),
      h(
        "td",
        {},
        h(
          "button",
          {
            class: "repeat",
            title: tr`One more reading in this place`,
            ariaLabel: tr`Repeat row ${i + 1}`,
            onclick: again,
          },
          "+",
        ),
      ),
    );
  }

  private focus(row: number, column: number): void {
    this.element.querySelector<HTMLInputElement>(`[data-cell="${row}-${column}"]`)?.focus();
  }

  /** Enter and the arrows go from row to row, as in a spreadsheet. */
  private move(event: KeyboardEvent, row: number, column: number): void {
    const step = event.key === "Enter" || event.key === "ArrowDown" ? 1 : event.key === "ArrowUp" ? -1 : 0;
    if (step === 0) return;
    event.preventDefault();
    this.focus(row + step, column);
  }
}

/** Positions, readings and feed; sides, directions, groups and times stand in the file and in the hint of a row. */
function shownColumns(sheet: Sheet): number[] {
  const has_feeds = (j: number): boolean => sheet.rows.some((row) => row.cells[j] !== "0");
  return sheet.header.columns.flatMap(({ name, read }, j) =>
    read || /^[A-Z]\d?$/.test(name) || (name === FEED && has_feeds(j)) ? [j] : [],
  );
}

function rest(sheet: Sheet, shown: readonly number[], cells: readonly string[]): string {
  const others = sheet.header.columns.flatMap(({ name }, j) =>
    shown.includes(j) || cells[j] === "0" ? [] : [`${name} ${short(cells[j] ?? "")}`],
  );
  return others.join(", ");
}

function isBad(text: string): boolean {
  return text.trim() !== "" && plainNumber(text) === null;
}

/** Positions as typed numbers have them: not seventeen digits. */
function short(text: string): string {
  const value = Number(text);
  if (text === "" || !Number.isFinite(value)) return text;
  return String(Math.round(value * 1e4) / 1e4).replace("-", "−");
}
