/** A window over the page: Escape, its button or a press around it close it, and the focus goes back. */

import { fill, h, type Child } from "./dom.ts";
import { tr } from "./words/index.ts";

export interface Dialog {
  readonly element: HTMLDialogElement;
  /** Shows `content` under `title`; another content replaces it. */
  show(title: string, ...content: Child[]): void;
  close(): void;
}

export function dialog(name: string): Dialog {
  const title = h("h2", { id: `${name}-title` });
  // With the keys, as it may be longer than the screen.
  const body = h("div", { class: "dialog-body", tabindex: "0", role: "group", "aria-labelledby": title.id });
  const element = h(
    "dialog",
    { class: `dialog dialog-${name}`, "aria-labelledby": title.id },
    h(
      "div",
      { class: "dialog-head" },
      title,
      h(
        "button",
        {
          class: "dialog-close",
          ariaLabel: tr`Close`,
          title: `${tr`Close`} (Esc)`,
          onclick: () => element.close(),
        },
        "×",
      ),
    ),
    body,
  );
  let before: HTMLElement | null = null;
  element.addEventListener("click", (event) => event.target === element && element.close());
  // Keys are those of the dialog while it is open.
  element.addEventListener("keydown", (event) => event.stopPropagation());
  element.addEventListener("close", () => {
    // The event comes some time after the end; the window may be open again.
    if (element.open) return;
    element.remove();
    if (before?.isConnected) before.focus();
    before = null;
  });
  return {
    element,
    show(words, ...content) {
      title.textContent = words;
      fill(body, content);
      body.scrollTop = 0;
      if (element.open) return;
      before = document.activeElement as HTMLElement | null;
      document.body.append(element);
      element.showModal();
    },
    close: () => element.close(),
  };
}

/** Whether a window lies over the page: keys are not for what is below. */
export const dialogOpen = (): boolean => document.querySelector("dialog[open]") !== null;
