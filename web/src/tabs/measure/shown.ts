/** The report of a command on the page: verdict, sentences, tables, as the server sends them. */

import { told } from "../../words/told.ts";
import { tr, trText } from "../../words/index.ts";
import type { ServeVerify } from "../../../types.d.ts";
import { withErrorNames } from "../../glossary/glossary.ts";
import { diagnosticList } from "../../app.ts";
import type { Diagnostic } from "../../api.ts";
import { download, h, type Child } from "../../dom.ts";
import { csvOf, fileName } from "../../figure/figure.ts";

export type Shown = ServeVerify["shown"];
export type ShownSection = Shown["sections"][number];
type ShownItem = ShownSection["items"][number];
type ShownTable = Extract<ShownItem, { kind: "table" }>;

/** "NOT PROVED" -> "Not proved". */
function inWords(word: string): string {
  return word.charAt(0) + word.slice(1).toLowerCase();
}

/** Title, subject and verdict; the verdict is announced. */
export function headPanel(shown: Shown, ...more: Child[]): HTMLElement {
  const { verdict } = shown;
  const state = verdict ? { good: "", bad: "bad", open: "warn" }[verdict.standing] : "";
  return h(
    "section",
    { class: "panel" },
    told("h1", { class: "shown-title" }, shown.title),
    verdict
      ? h(
          "p",
          { class: `verdict ${state}`, role: "status", dataTest: "verdict" },
          h("span", { class: "verdict-word" }, inWords(trText(verdict.word))),
          told("span", {}, verdict.sentence),
        )
      : null,
    shown.lines.map((line) => told("p", { class: "muted" }, line)),
    more,
  );
}

const NUMBER = /^[+-]?\d[\d.]*(e[+-]?\d+)?$/;

/** A cell of a report with the minus sign of the page. */
function cellText(cell: string): string {
  return NUMBER.test(cell) ? cell.replace(/^-/, "−") : cell;
}

function tableOf(title: string, table: ShownTable): HTMLElement {
  const { headings, rows } = table;
  const columns = Math.max(headings.length, ...rows.map((row) => row.length));
  const right = Array.from({ length: columns }, (_, j) => {
    const cells = rows.map((row) => row[j] ?? "").filter((cell) => cell !== "" && cell !== "–");
    return cells.length > 0 && cells.every((cell) => NUMBER.test(cell));
  });
  const aligned = (j: number): string => (right[j] ? "number" : "");
  return h(
    "div",
    { class: "sheet-scroll" },
    h(
      "table",
      { class: "report-table", ariaLabel: title },
      headings.length > 0
        ? h(
            "thead",
            {},
            h(
              "tr",
              {},
              headings.map((text, j) => told(text ? "th" : "td", { class: aligned(j) }, text)),
            ),
          )
        : null,
      h(
        "tbody",
        {},
        rows.map((row) =>
          h(
            "tr",
            {},
            row.map((cell, j) => told("td", { class: aligned(j) }, cell, (text) => withErrorNames(cellText(text)))),
          ),
        ),
      ),
    ),
    table.note ? told("p", { class: "muted note" }, table.note) : null,
  );
}

function item(title: string, one: ShownItem): HTMLElement {
  switch (one.kind) {
    case "paragraph":
      return told("p", {}, one.text);
    case "note":
      return told("p", { class: "muted note" }, one.text);
    case "list":
      return h(
        "ul",
        { class: "remarks" },
        one.lines.map((line) => told("li", {}, line)),
      );
    case "code":
      return h("pre", { class: "program", tabindex: "0" }, one.text);
    case "table":
      return tableOf(title, one);
  }
}

/** A section of the report; its first table can be saved as CSV. */
export function sectionPanel(section: ShownSection): HTMLElement {
  const title = section.title ? trText(section.title) : tr`Notes`;
  const table = section.items.find((one): one is ShownTable => one.kind === "table");
  const save = (): void => {
    if (!table) return;
    const width = Math.max(table.headings.length, ...table.rows.map((row) => row.length));
    const columns = Array.from({ length: width }, (_, j) => ({
      heading: table.headings[j] ?? "",
      values: table.rows.map((row) => row[j] ?? ""),
    }));
    download(`${fileName(title)}.csv`, csvOf(columns), "text/csv");
  };
  return h(
    "section",
    { class: "panel sheet figure", dataSection: section.title || "Notes" },
    h(
      "div",
      { class: "figure-head" },
      h("h2", {}, title),
      table
        ? h(
            "span",
            { class: "figure-menu" },
            h("button", { class: "figure-save", ariaLabel: tr`Save the table ${title} as CSV`, onclick: save }, "CSV"),
          )
        : null,
    ),
    section.items.map((one) => item(title, one)),
  );
}

/** What the input made the program say; nothing if it said nothing. */
export function remarksPanel(diagnostics: readonly Diagnostic[]): HTMLElement | null {
  if (diagnostics.length === 0) return null;
  return h(
    "section",
    { class: "panel", dataTest: "remarks" },
    h("h2", {}, tr`Warnings and notes`),
    diagnosticList(diagnostics.slice(0, 50)),
    diagnostics.length > 50 ? h("p", { class: "muted" }, tr`and ${diagnostics.length - 50} more`) : null,
  );
}
