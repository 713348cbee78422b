/** Pages of one panel, one shown at a time. */

import { h } from "../../dom.ts";

export interface Page {
  name: string;
  title: string;
  parts: HTMLElement[];
}

export interface Pages {
  element: HTMLElement;
  go(name: string): void;
}

/** `left` is called before another page is shown. */
export function pages(list: readonly Page[], left: () => void): Pages {
  const buttons = list.map(({ name, title }) =>
    h(
      "button",
      { role: "tab", id: `page-tab-${name}`, dataPage: name, "aria-controls": `page-${name}`, onclick: () => go(name) },
      title,
    ),
  );
  const hosts = list.map(({ name, parts }) =>
    h("div", { role: "tabpanel", id: `page-${name}`, "aria-labelledby": `page-tab-${name}` }, parts),
  );
  const strip = h("div", { class: "pages-strip", role: "tablist", ariaLabel: "Pages of the machine" }, buttons);
  const go = (name: string): void => {
    left();
    list.forEach((page, i) => {
      const here = page.name === name;
      buttons[i]?.setAttribute("aria-selected", String(here));
      buttons[i]?.setAttribute("tabindex", here ? "0" : "-1");
      if (hosts[i]) hosts[i].hidden = !here;
    });
  };
  strip.addEventListener("keydown", (event) => {
    const step = { ArrowRight: 1, ArrowLeft: -1 }[event.key];
    const at = buttons.indexOf(document.activeElement as HTMLButtonElement);
    if (step === undefined || at < 0) return;
    const next = buttons[(at + step + buttons.length) % buttons.length];
    next?.focus();
    next?.click();
  });
  go(list[0]?.name ?? "");
  return { element: h("div", { class: "pages" }, strip, hosts), go };
}
