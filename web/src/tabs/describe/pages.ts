/** Pages of one panel, one shown at a time. */

import { tr } from "../../words/index.ts";
import { h } from "../../dom.ts";

export interface Page {
  name: string;
  title: string;
  parts: HTMLElement[];
}

export interface Pages {
  element: HTMLElement;
  go(name: string): void;
  /** The page that is shown. */
  now(): string;
}

/** `left` is called before another page is shown, `shown` after it. */
export function pages(list: readonly Page[], left: () => void, shown: () => void): Pages {
  let now = list[0]?.name ?? "";
  const buttons = list.map(({ name, title }) =>
    h(
      "button",
      {
        role: "tab",
        id: `page-tab-${name}`,
        dataPage: name,
        "aria-controls": `page-${name}`,
        onclick: () => choose(name),
      },
      title,
    ),
  );
  const hosts = list.map(({ name, parts }) =>
    h("div", { role: "tabpanel", id: `page-${name}`, "aria-labelledby": `page-tab-${name}` }, parts),
  );
  const strip = h("div", { class: "pages-strip", role: "tablist", ariaLabel: tr`Pages of the machine` }, buttons);
  const go = (name: string): void => {
    if (!list.some((page) => page.name === name)) return;
    left();
    now = name;
    list.forEach((page, i) => {
      const here = page.name === name;
      buttons[i]?.setAttribute("aria-selected", String(here));
      buttons[i]?.setAttribute("tabindex", here ? "0" : "-1");
      if (hosts[i]) hosts[i].hidden = !here;
    });
  };
  const choose = (name: string): void => {
    go(name);
    shown();
  };
  strip.addEventListener("keydown", (event) => {
    const at = buttons.indexOf(document.activeElement as HTMLButtonElement);
    const to = { ArrowRight: at + 1, ArrowLeft: at - 1, Home: 0, End: buttons.length - 1 }[event.key];
    if (to === undefined || at < 0) return;
    event.preventDefault();
    const next = buttons[(to + buttons.length) % buttons.length];
    next?.focus();
    next?.click();
  });
  go(now);
  return { element: h("div", { class: "pages" }, strip, hosts), go, now: () => now };
}
