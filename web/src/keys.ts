/** The list of keys that `?` shows, and whether keys without Ctrl act at all. */

import { dialog, dialogOpen } from "./dialog.ts";
import { h } from "./dom.ts";
import { explain } from "./glossary/glossary.ts";
import { tr } from "./words/index.ts";

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

/** A key that is added somewhere is listed here. */
const GROUPS: readonly { title: string; keys: readonly (readonly [string, string])[] }[] = [
  {
    title: tr`Everywhere`,
    keys: [
      ["?", tr`this list`],
      ["E", tr`names of errors, each with a drawing`],
      [tr`Tab, Shift+Tab`, tr`to the next and the previous control`],
      [tr`← → Home End`, tr`on the tabs and on pages of a tab: move; Enter opens`],
      ["← → ↑ ↓", tr`on the divider: resize the picture`],
      [tr`Esc`, tr`close a dialog`],
    ],
  },
  {
    title: tr`Simulate`,
    keys: [
      [tr`Space`, tr`play, pause`],
      ["← →", tr`a block back, a block on`],
      [tr`Home, End`, tr`to the start, to the end`],
      ["G", tr`go to a line`],
      ["/", tr`find in the program; Enter the next place, Shift+Enter the one before`],
      [tr`N, Shift+N`, tr`the next and the previous issue: collisions, over-travel; where there is none, remarks`],
      [tr`↑ ↓ Page Up, Page Down`, tr`in the source: move the mark; Enter goes to its line`],
    ],
  },
  {
    title: tr`Describe`,
    keys: [
      [tr`Ctrl+S`, tr`save the machine file`],
      [tr`Ctrl+Z, Ctrl+Shift+Z`, tr`undo, redo`],
      [tr`Enter, Esc`, tr`in the field of an error: keep, restore`],
    ],
  },
  {
    title: tr`Machine in three dimensions`,
    keys: [
      ["← → ↑ ↓", tr`turn; with Shift move`],
      ["+ −", tr`nearer, farther`],
      ["0 1 2 3", tr`views: iso, along X, Y, Z`],
      ["4", tr`show everything`],
      ["5", tr`parallel projection`],
    ],
  },
  {
    title: tr`Figures`,
    keys: [
      ["← →", tr`on a curve: read it point by point`],
      ["← → ↑ ↓", tr`on a matrix: read it cell by cell`],
      [tr`Enter`, tr`on a curve over time: go to that time; on a bar, a hole or a row: choose it`],
      ["+ −", tr`on a curve over time: look closer, show all`],
    ],
  },
];

const list = dialog("keys");

function show(): void {
  const single = h("input", {
    type: "checkbox",
    checked: singleKeys(),
    onchange: () => (single.checked ? localStorage.removeItem(KEPT) : localStorage.setItem(KEPT, "off")),
  });
  list.show(
    tr`Keys`,
    h("p", {}, h("label", { class: "check" }, single, tr`Keys without Ctrl act on the page`)),
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
    { class: "keys-button", title: `${tr`Keys`} (?)`, ariaLabel: tr`Keys`, ariaHaspopup: "dialog", onclick: show },
    "?",
  );
}
