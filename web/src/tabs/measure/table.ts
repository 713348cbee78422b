/** A table of results with its data as CSV. */

import { tr } from "../../words/index.ts";
import { download, h } from "../../dom.ts";
import { csvOf, fileName } from "../../figure/figure.ts";
import { number } from "../../format.ts";
import { withErrorNames } from "../../glossary/glossary.ts";

export type Cell = string | number | null;

/** Headings are said in the language of the page; those that are made by a function stay English in the CSV file. */
type Headings = string[] | ((tr: Say) => string[]);
type Say = typeof tr;

const english: Say = (texts, ...values) => String.raw({ raw: texts }, ...values);
const headings = (head: Headings, say: Say): string[] => (typeof head === "function" ? head(say) : head);

export interface Sheet {
  title: string;
  note?: string;
  /** With their units. */
  head: Headings;
  rows: Cell[][];
  /** Digits after the point, for each column; default 2. */
  digits?: (number | undefined)[];
  /** Key for tests, and for styles. */
  key?: string;
  /** Longer words on the first cell of each row. */
  hints?: (string | undefined)[];
  /** Of cells that are text already: whether a column has words, and not numbers. */
  words?: readonly boolean[];
}

function cell(value: Cell, digits: number, is_text: boolean, hint?: string): HTMLElement {
  if (typeof value === "string")
    return h("td", { class: is_text ? null : "number", title: hint }, withErrorNames(value));
  return h("td", { class: "number" }, number(value, digits));
}

function columnIsText(sheet: Sheet, j: number): boolean {
  return sheet.words?.[j] ?? sheet.rows.some((row) => typeof row[j] === "string");
}

export function sheetTable(sheet: Sheet): HTMLElement {
  const csv = (): string =>
    csvOf(
      headings(sheet.head, english).map((heading, j) => ({ heading, values: sheet.rows.map((row) => row[j] ?? null) })),
    );
  const save = h(
    "button",
    {
      class: "figure-save",
      ariaLabel: tr`Save the table ${sheet.title} as CSV`,
      onclick: () => download(`${fileName(sheet.title)}.csv`, csv(), "text/csv"),
    },
    "CSV",
  );
  return h(
    "section",
    { class: "panel sheet figure", dataSheet: sheet.key ?? fileName(sheet.title) },
    h("div", { class: "figure-head" }, h("h2", {}, sheet.title), h("span", { class: "figure-menu" }, save)),
    h(
      "div",
      { class: "sheet-scroll" },
      h(
        "table",
        {},
        h(
          "thead",
          {},
          h(
            "tr",
            {},
            headings(sheet.head, tr).map((text, j) =>
              h(text ? "th" : "td", { class: columnIsText(sheet, j) ? "" : "number" }, text),
            ),
          ),
        ),
        h(
          "tbody",
          {},
          sheet.rows.map((row, i) =>
            h(
              "tr",
              {},
              row.map((value, j) =>
                cell(value, sheet.digits?.[j] ?? 2, sheet.words?.[j] ?? true, j === 0 ? sheet.hints?.[i] : undefined),
              ),
            ),
          ),
        ),
      ),
    ),
    sheet.note ? h("p", { class: "muted note" }, sheet.note) : null,
  );
}
