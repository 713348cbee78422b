/** Which keys do what: the list that `?` shows, and whether keys without Ctrl act at all. */

import { dialog, dialogOpen } from "./dialog.ts";
import { h } from "./dom.ts";
import { explain } from "./glossary/glossary.ts";

interface Group {
  title: string;
  keys: readonly [string, string][];
}

/** Every key of the page. A key that is added somewhere is listed here. */
const GROUPS: readonly Group[] = [
  {
    title: "Everywhere",
    keys: [
      ["?", "this list"],
      ["E", "names of errors, each with a drawing"],
      ["Tab, Shift+Tab", "to the next and the previous control"],
      ["← → Home End", "on the tabs and on pages of a tab: move; Enter opens"],
      ["← → ↑ ↓", "on the divider: resize the picture"],
      ["Esc", "close a dialog"],
    ],
  },
  {
    title: "Simulate",
    keys: [
      ["Space", "play, pause"],
      ["← →", "a block back, a block on"],
      ["Home, End", "to the start, to the end"],
      ["G", "go to a line"],
      ["/", "find in the program; Enter the next place, Shift+Enter the one before"],
      ["N, Shift+N", "the next and the previous issue: collisions, over-travel; where there is none, remarks"],
      ["↑ ↓ Page Up, Page Down", "in the source: move the mark; Enter goes to its line"],
    ],
  },
  {
    title: "Describe",
    keys: [
      ["Ctrl+S", "save the machine file"],
      ["Ctrl+Z, Ctrl+Shift+Z", "undo, redo"],
      ["Enter, Esc", "in the field of an error: keep, restore"],
    ],
  },
  {
    title: "Machine in three dimensions",
    keys: [
      ["← → ↑ ↓", "turn; with Shift move"],
      ["+ −", "nearer, farther"],
      ["0 1 2 3", "views: iso, along X, Y, Z"],
      ["4", "show everything"],
      ["5", "parallel projection"],
    ],
  },
  {
    title: "Figures",
    keys: [
      ["← →", "on a curve: read it point by point"],
      ["← → ↑ ↓", "on a matrix: read it cell by cell"],
      ["Enter", "on a curve over time: go to that time; on a bar, a hole or a row: choose it"],
      ["+ −", "on a curve over time: look closer, show all"],
    ],
  },
];

const KEPT = "trueaxis-single-keys";

/** Keys without Ctrl can be switched off: speech input and shaking hands press them by mistake. */
export const singleKeys = (): boolean => localStorage.getItem(KEPT) !== "off";

/** What a single key means, if it is for the tab and not for a control, a text or a dialog. */
export function tabKey(event: KeyboardEvent): string | null {
  if (event.defaultPrevented || event.ctrlKey || event.metaKey || event.altKey) return null;
  if (dialogOpen() || (event.key.length === 1 && !singleKeys())) return null;
  const at = event.target as HTMLElement;
  if (at.matches("input:not([type=range], [type=checkbox]), select, textarea")) return null;
  return event.key.length === 1 ? event.key.toLowerCase() : event.key;
}

const list = dialog("keys");

function show(): void {
  const single = h("input", {
    type: "checkbox",
    checked: singleKeys(),
    onchange: () => (single.checked ? localStorage.removeItem(KEPT) : localStorage.setItem(KEPT, "off")),
  });
  list.show(
    "Keys",
    h("p", {}, h("label", { class: "check" }, single, "Keys without Ctrl act on the page")),
    h(
      "div",
      { class: "keys" },
      GROUPS.map(({ title, keys }) =>
        h(
          "section",
          {},
          h("h3", {}, title),
          h(
            "table",
            {},
            h(
              "tbody",
              {},
              keys.map(([key, what]) => h("tr", {}, h("th", { scope: "row" }, h("kbd", {}, key)), h("td", {}, what))),
            ),
          ),
        ),
      ),
    ),
  );
}

/** The button of the bar; `?` does the same. */
export function keysButton(): HTMLElement {
  document.addEventListener("keydown", (event) => {
    const key = tabKey(event);
    if (key === "?") show();
    else if (key === "e") explain("");
    else return;
    event.preventDefault();
  });
  return h(
    "button",
    { class: "keys-button", title: "Keys (?)", ariaLabel: "Keys", ariaHaspopup: "dialog", onclick: show },
    "?",
  );
}
