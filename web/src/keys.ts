/** The list of keys that `?` shows (its texts: words/), and whether keys without Ctrl act at all. A key that is added somewhere is listed there. */

import { dialog, dialogOpen } from "./dialog.ts";
import { h } from "./dom.ts";
import { explain } from "./glossary/glossary.ts";
import { words } from "./words/index.ts";

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
    words.keys,
    h("p", {}, h("label", { class: "check" }, single, words.single_keys)),
    h(
      "div",
      { class: "keys" },
      words.key_groups.map(({ title, keys }) =>
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
    { class: "keys-button", title: `${words.keys} (?)`, ariaLabel: words.keys, ariaHaspopup: "dialog", onclick: show },
    "?",
  );
}
