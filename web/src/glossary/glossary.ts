/** The glossary of error names: opened from every name on the page. */

import { dialog } from "../dialog.ts";
import { h, type Child } from "../dom.ts";
import { errorDrawing } from "./drawing.ts";
import { errorName, namesOf, piecesOf } from "./names.ts";
import { readOf, textOf } from "./texts.ts";

const AXES = ["X", "Y", "Z", "A", "B", "C", "U", "V", "W", "w", "t"];

const over = dialog("glossary");
over.element.lang = "en";

/** Explains a name; one that is none opens the first. */
export function explain(name: string): void {
  const error = errorName(name) ?? errorName("EXX");
  if (!error) return;
  const words = textOf(error);
  const choice = h(
    "select",
    { ariaLabel: "Name of the error", dataTest: "glossary-name", onchange: () => explain(choice.value) },
    AXES.map((axis) =>
      h(
        "optgroup",
        { label: axis === "w" ? "Workpiece w" : axis === "t" ? "Tool t" : `Axis ${axis}` },
        namesOf(axis).map((one) => h("option", { value: one }, one)),
      ),
    ),
  );
  choice.value = error.name;
  const row = (term: string, ...what: Child[]): HTMLElement[] => [h("dt", {}, term), h("dd", {}, what)];
  const focused = over.element.contains(document.activeElement) && document.activeElement?.tagName === "SELECT";
  over.show(
    `${error.name}: ${words.title}`,
    h("p", { class: "row" }, choice, h("span", { class: "muted" }, readOf(error))),
    h(
      "div",
      { class: "glossary" },
      errorDrawing(error, `${words.title}: ${words.sign}`),
      h(
        "dl",
        {},
        row("What", words.what),
        row("Kind", words.kind),
        row("Unit", words.unit),
        row("Sign", "actual − nominal. ", words.sign),
        row("At the tool", words.carries),
        row("Seen by", words.instruments),
      ),
    ),
    h(
      "p",
      { class: "hint" },
      "Dashed: nominal. Filled: actual. The directions are those of the machine axes; ISO 230-1, docs/conventions.md.",
    ),
  );
  if (focused) choice.focus();
}

/** A name as a button that explains it. */
export function errorLink(name: string): HTMLElement {
  const error = errorName(name);
  if (!error) return h("span", {}, name);
  return h(
    "button",
    {
      class: "error-link",
      title: textOf(error).title,
      onclick: (event: Event) => {
        event.stopPropagation();
        explain(name);
      },
    },
    name,
  );
}

/** A text whose names of errors are buttons. */
export const withErrorNames = (text: string): Child[] =>
  piecesOf(text).map((piece) => (typeof piece === "string" ? piece : errorLink(piece.name)));
