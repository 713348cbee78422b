/** The text of the machine file, to be edited, with what is wrong in it. */

import { severityWord, tr } from "../../words/index.ts";
import type { Diagnostic } from "../../api.ts";
import { fill, h } from "../../dom.ts";

/** After this pause in typing the text is read, ms. */
const PAUSE = 500;

export class FileText {
  readonly element = h("section", { class: "panel file-panel" });
  private readonly area = h("textarea", {
    class: "file-text",
    spellcheck: "false",
    autocomplete: "off",
    wrap: "off",
    ariaLabel: tr`Text of the file`,
  });
  private readonly gutter = h("div", { class: "file-gutter", ariaHidden: "true" });
  private readonly problems = h("ul", { class: "diagnostics file-problems", ariaLive: "polite" });
  private readonly typed: (text: string) => void;
  private timer: ReturnType<typeof setTimeout> | undefined;
  private marked = new Map<number, string>();
  private lines = 0;
  /** A text area turns CR LF into LF; they are put back, so that a save changes no other line. */
  private crlf = false;

  constructor(typed: (text: string) => void) {
    this.typed = typed;
    this.area.addEventListener("input", () => {
      this.number();
      clearTimeout(this.timer);
      this.timer = setTimeout(() => this.flush(), PAUSE);
    });
    this.area.addEventListener("scroll", () => (this.gutter.scrollTop = this.area.scrollTop));
    fill(this.element, this.problems, h("div", { class: "file-body" }, this.gutter, this.area));
  }

  /** Hands over what was typed, at once. */
  flush(): void {
    if (this.timer === undefined) return;
    clearTimeout(this.timer);
    this.timer = undefined;
    this.typed(this.crlf ? this.area.value.replaceAll("\n", "\r\n") : this.area.value);
  }

  show(text: string): void {
    this.crlf = text.includes("\r\n");
    const shown = text.replaceAll("\r\n", "\n");
    // Ends of lines of both kinds would all become one.
    const mixed = (this.crlf ? shown.replaceAll("\n", "\r\n") : shown) !== text;
    this.area.readOnly = mixed;
    this.area.title = mixed
      ? tr`The lines of this file end in two ways: edit it with a text editor, or its errors in the table`
      : "";
    if (this.timer !== undefined || this.area.value === shown) return;
    const top = this.area.scrollTop;
    this.area.value = shown;
    this.number();
    this.area.scrollTop = top;
  }

  showProblems(diagnostics: readonly Diagnostic[]): void {
    this.marked = new Map(diagnostics.flatMap((d) => (d.line ? [[d.line, d.severity] as const] : [])));
    this.lines = 0;
    this.number();
    fill(
      this.problems,
      diagnostics.map((d) =>
        h(
          "li",
          { class: `diagnostic ${d.severity}` },
          h("span", { class: "diagnostic-severity" }, severityWord(d.severity)),
          d.line
            ? h("button", { class: "line-link", onclick: () => this.goTo(d.line as number) }, tr`line ${d.line}`)
            : null,
          h("span", {}, d.message),
          d.hint ? h("span", { class: "hint" }, d.hint) : null,
        ),
      ),
    );
  }

  /** Puts the cursor on a line. */
  goTo(line: number): void {
    const before = this.area.value.split("\n").slice(0, line - 1);
    const from = before.reduce((sum, text) => sum + text.length + 1, 0);
    const end = this.area.value.indexOf("\n", from);
    this.area.focus();
    this.area.setSelectionRange(from, end < 0 ? this.area.value.length : end);
    const height = Number.parseFloat(getComputedStyle(this.area).lineHeight);
    this.area.scrollTop = Math.max(0, (line - 4) * height);
  }

  private number(): void {
    const count = this.area.value.split("\n").length;
    if (count === this.lines) return;
    this.lines = count;
    fill(
      this.gutter,
      Array.from({ length: count }, (_, i) => h("div", { class: this.marked.get(i + 1) ?? null }, i + 1)),
    );
    this.gutter.scrollTop = this.area.scrollTop;
  }
}
