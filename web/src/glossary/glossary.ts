/** The glossary of error names: opened from every name on the page. */

import { tr } from "../words/index.ts";
import { dialog } from "../dialog.ts";
import { h, type Child } from "../dom.ts";
import { errorDrawing } from "./drawing.ts";
import { errorName, namesOf, piecesOf } from "./names.ts";
import { readOf, textOf } from "./texts.ts";

const AXES = ["X", "Y", "Z", "A", "B", "C", "U", "V", "W", "w", "t"];

const over = dialog("glossary");

/** Explains a name; one that is none opens the first. */
export function explain(name: string): void {
  const error = errorName(name) ?? errorName("EXX");
  if (!error) return;
  const words = textOf(error);
  const choice = h(
    "select",
    { ariaLabel: tr`Name of the error`, dataTest: "glossary-name", onchange: () => explain(choice.value) },
    AXES.map((axis) =>
      h(
        "optgroup",
        { label: axis === "w" ? tr`Workpiece w` : axis === "t" ? tr`Tool t` : tr`Axis ${axis}` },
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
        row(tr`What`, words.what),
        row(tr`Kind`, words.kind),
        row(tr`Unit`, words.unit),
        row(tr`Sign`, tr`actual − nominal. `, words.sign),
        row(tr`At the tool`, words.carries),
        row(tr`Seen by`, words.instruments),
      ),
    ),
    h(
      "p",
      { class: "hint" },
      tr`Dashed: nominal. Filled: actual. The directions are those of the machine axes; ISO 230-1, docs/conventions.md.`,
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
