/** Go to a line of the program, or find a text in it: a row over the source that G, / and a button open. */

import { tr } from "../../words/index.ts";
import { h } from "../../dom.ts";

export interface FindActions {
  /** Marks the next or the previous place; the line, or null where the text is not in the program. */
  find(text: string, step: 1 | -1): number | null;
  /** Goes to a line, the time too. */
  go(line: number): void;
  /** The row is closed: the source has the focus again. */
  closed(): void;
}

export class Find {
  readonly element: HTMLFormElement;
  readonly button: HTMLButtonElement;
  private readonly text = h("input", {
    type: "text",
    class: "find-text",
    placeholder: tr`find`,
    ariaLabel: tr`Find in the program`,
    spellcheck: "false",
    autocomplete: "off",
  });
  private readonly line = h("input", {
    type: "number",
    class: "find-line",
    min: "1",
    step: "1",
    placeholder: tr`line`,
    ariaLabel: tr`Go to line`,
  });
  private readonly found = h("span", { class: "muted", role: "status", dataTest: "found" });
  private readonly actions: FindActions;

  constructor(actions: FindActions) {
    this.actions = actions;
    this.button = h(
      "button",
      {
        class: "find-open",
        title: tr`Find (/), go to a line (G)`,
        ariaExpanded: "false",
        onclick: () => this.toggle(),
      },
      tr`Find`,
    );
    const step = (words: string, sign: string, by: 1 | -1): HTMLElement =>
      h("button", { type: "button", ariaLabel: words, title: words, onclick: () => this.next(by) }, sign);
    this.element = h(
      "form",
      { class: "row find", role: "search", hidden: true },
      this.text,
      h("span", { class: "group" }, step(tr`The place before`, "↑", -1), step(tr`The next place`, "↓", 1)),
      this.line,
      this.found,
    );
    this.element.addEventListener("submit", (event) => event.preventDefault());
    this.element.addEventListener("keydown", (event) => this.key(event));
  }

  open(what: "text" | "line"): void {
    this.element.hidden = false;
    this.button.setAttribute("aria-expanded", "true");
    this[what].focus();
    this[what].select();
  }

  /** Another program: what was found is not in it. */
  clear(): void {
    this.found.textContent = "";
  }

  private toggle(): void {
    if (this.element.hidden) this.open("text");
    else this.close();
  }

  private close(): void {
    this.element.hidden = true;
    this.button.setAttribute("aria-expanded", "false");
    this.actions.closed();
  }

  private key(event: KeyboardEvent): void {
    if (event.key === "Escape") this.close();
    else if (event.key === "Enter" && event.target === this.text) this.next(event.shiftKey ? -1 : 1);
    else if (event.key === "Enter" && event.target === this.line) this.goToLine();
    else return;
    event.preventDefault();
  }

  private next(step: 1 | -1): void {
    if (this.text.value === "") return;
    const line = this.actions.find(this.text.value, step);
    this.found.textContent = line === null ? tr`not in this program` : tr`line ${line}`;
  }

  private goToLine(): void {
    const line = Math.round(Number(this.line.value));
    if (!(line >= 1)) return;
    this.found.textContent = "";
    this.actions.go(line);
    this.close();
  }
}
