/** The numbers of a figure as a table: for those who do not see it, and for those who want to read them off. */

import { tr, trText } from "../words/index.ts";
import { dialog } from "../dialog.ts";
import { h } from "../dom.ts";
import { number } from "../format.ts";
import type { Column } from "./figure.ts";

/** More rows are in the CSV file. */
const MOST_ROWS = 500;

const over = dialog("data");

function cell(value: number | string | null | undefined, heads_row: boolean): HTMLElement {
  if (typeof value === "number") return h("td", { class: "number" }, number(value, digitsOf(value)));
  return heads_row ? h("th", { scope: "row" }, value ?? "–") : h("td", {}, value ?? "–");
}

/** About four figures that count. */
const digitsOf = (value: number): number =>
  Number.isInteger(value) ? 0 : Math.min(9, Math.max(0, 3 - Math.floor(Math.log10(Math.abs(value)))));

export function showData(title: string, columns: readonly Column[]): void {
  const rows = Math.max(0, ...columns.map((column) => column.values.length));
  const shown = Math.min(rows, MOST_ROWS);
  // A matrix has the names of its rows in a column without a heading.
  over.show(
    title,
    h(
      "table",
      { class: "data" },
      h(
        "thead",
        {},
        h(
          "tr",
          {},
          columns.map(({ heading, shown: words = trText(heading), values }) =>
            h(
              heading ? "th" : "td",
              { class: typeof values[0] === "number" ? "number" : "", scope: heading ? "col" : null },
              words,
            ),
          ),
        ),
      ),
      h(
        "tbody",
        {},
        Array.from({ length: shown }, (_, i) =>
          h(
            "tr",
            {},
            columns.map(({ values }, j) => cell(values[i], j === 0)),
          ),
        ),
      ),
    ),
    shown < rows
      ? h("p", { class: "muted" }, tr`The first ${shown} of ${rows} rows; all of them are in the CSV file.`)
      : null,
  );
}
