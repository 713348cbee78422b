/** The source of the program: only the lines in sight are in the page, so that 10⁶ lines scroll well. */

import { severityWord, tr } from "../../words/index.ts";
import { fill, h, perFrame, type Child } from "../../dom.ts";
import { Lines } from "./lines.ts";

/** What the program reader or the simulation says about a line. */
export interface LineNote {
  line: number;
  /** From 1; without it the whole line is meant. */
  column?: number | null | undefined;
  severity: string;
  message: string;
  hint?: string | null | undefined;
}

const ROW = 19;
/** Browsers do not lay out more than about 17 million px; above this the scroll bar is a scale. */
const TALLEST = 8_000_000;
/** After the user has scrolled, the list does not follow the program for this long. */
const REST_MS = 2500;

/** Comments and block numbers stand back. */
const PIECE = /\([^)]*\)|;.*$|^\s*\/?\s*N\d+/gi;

export class SourceList {
  readonly element: HTMLElement;
  private readonly scroll = h("div", {
    class: "source-scroll",
    tabindex: "0",
    role: "listbox",
    ariaLabel: tr`Source of the program. Arrow keys move the mark, Enter or a click on a line goes to it.`,
  });
  private readonly tall = h("div", { class: "source-tall" });
  private readonly rows = h("div", { class: "source-rows" });
  private readonly tip = h("div", { class: "source-tip", role: "tooltip", id: "source-tip", hidden: true });
  private lines = new Lines("");
  private notes = new Map<number, LineNote[]>();
  private current = 0;
  /** The line that the arrow keys have reached, or that was found; 0: none. */
  private cursor = 0;
  /** Height of what is in sight, px. */
  private sight = 0;
  private scrolled_at = -Infinity;
  /** The scroll position that this list set itself. */
  private own_top = -1;
  private readonly pick: (line: number) => void;
  private readonly draw = perFrame(() => this.render());

  constructor(pick: (line: number) => void) {
    this.pick = pick;
    this.tall.append(this.rows);
    this.scroll.append(this.tall);
    this.element = h("div", { class: "source-list" }, this.scroll, this.tip);
    this.scroll.addEventListener("scroll", () => this.scrolled());
    this.scroll.addEventListener("wheel", (event) => this.wheel(event), { passive: false });
    this.scroll.addEventListener("keydown", (event) => this.key(event));
    this.rows.addEventListener("click", (event) => this.clicked(event));
    for (const kind of ["pointerover", "focusin"])
      this.rows.addEventListener(kind, (event) => this.showTip(event.target));
    for (const kind of ["pointerleave", "focusout"]) this.rows.addEventListener(kind, () => (this.tip.hidden = true));
    new ResizeObserver(() => this.resize()).observe(this.scroll);
  }

  show(text: string, notes: readonly LineNote[]): void {
    this.lines = new Lines(text);
    this.setNotes(notes);
    this.current = this.cursor = 0;
    this.own_top = 0;
    this.resize();
    this.scroll.scrollTop = 0;
  }

  setNotes(notes: readonly LineNote[]): void {
    this.notes = new Map();
    for (const note of notes) this.notes.set(note.line, [...(this.notes.get(note.line) ?? []), note]);
    this.draw();
  }

  textOf(line: number): string {
    return this.lines.line(line);
  }

  /** The block that runs now; it is kept in sight. */
  setCurrent(line: number): void {
    if (line === this.current) return;
    this.current = line;
    if (performance.now() - this.scrolled_at > REST_MS) {
      this.cursor = 0;
      this.reveal(line);
    }
    this.draw();
  }

  /** Marks the next or the previous line with these words and shows it; null where there is none. */
  find(words: string, step: 1 | -1): number | null {
    const line = this.lines.find(words, this.cursor || this.current || 1, step);
    if (line !== null) this.mark(line);
    return line;
  }

  focus(): void {
    this.scroll.focus({ preventScroll: true });
  }

  private mark(line: number): void {
    this.cursor = Math.min(this.lines.count, Math.max(1, line));
    this.scrolled_at = performance.now();
    this.reveal(this.cursor);
    this.draw();
  }

  /** Scrolls a line into sight, if it is not. */
  reveal(line: number): void {
    const first = this.first();
    const rows = this.rowsInSight();
    if (line - 1 >= first + 1 && line <= first + rows - 2) return;
    this.setFirst(line - 1 - Math.floor(0.4 * rows));
  }

  // ---- which lines are in sight ----

  private rowsInSight(): number {
    return this.sight / ROW;
  }

  private height(): number {
    return Math.min(TALLEST, this.lines.count * ROW);
  }

  /** Lines per px of scrolling. */
  private scale(): number {
    const way = this.height() - this.sight;
    return way > 0 ? Math.max(0, this.lines.count - this.rowsInSight()) / way : 1 / ROW;
  }

  private first(): number {
    return this.scroll.scrollTop * this.scale();
  }

  private setFirst(line: number): void {
    const most = Math.max(0, this.lines.count - this.rowsInSight());
    const top = Math.min(most, Math.max(0, line)) / this.scale();
    this.scroll.scrollTop = top;
    this.own_top = this.scroll.scrollTop;
    this.draw();
  }

  private resize(): void {
    this.sight = this.scroll.clientHeight;
    this.tall.style.height = `${this.height()}px`;
    this.rows.style.height = `${this.sight}px`;
    this.draw();
  }

  private scrolled(): void {
    if (Math.abs(this.scroll.scrollTop - this.own_top) > 1) this.scrolled_at = performance.now();
    this.own_top = -1;
    this.tip.hidden = true;
    this.draw();
  }

  /** Where the scroll bar is a scale, the wheel still moves by lines. */
  private wheel(event: WheelEvent): void {
    if (event.ctrlKey || this.lines.count * ROW <= TALLEST) return;
    event.preventDefault();
    this.scrolled_at = performance.now();
    this.setFirst(this.first() + event.deltaY / (event.deltaMode === 1 ? 1 : ROW));
  }

  private key(event: KeyboardEvent): void {
    const page = Math.max(1, Math.floor(this.rowsInSight()) - 1);
    const by = { ArrowUp: -1, ArrowDown: 1, PageUp: -page, PageDown: page }[event.key];
    const at = this.cursor || this.current || Math.round(this.first()) + 1;
    if (event.key === "Enter" && event.target === this.scroll) this.pick(at);
    else if (by === undefined) return;
    else {
      if (Math.abs(by) > 1) this.setFirst(Math.round(this.first()) + by);
      this.mark(at + by);
    }
    event.preventDefault();
  }

  private clicked(event: Event): void {
    const row = (event.target as HTMLElement).closest<HTMLElement>(".source-line");
    if (row && (document.getSelection()?.toString() ?? "") === "") this.pick(Number(row.dataset.line));
  }

  // ---- drawing ----

  private render(): void {
    const first = this.first();
    const top = Math.floor(first);
    const count = Math.ceil(this.rowsInSight()) + 1;
    const rows: HTMLElement[] = [];
    for (let line = top + 1; line <= Math.min(this.lines.count, top + count); line++) rows.push(this.row(line));
    const inner = h("div", { class: "source-inner" }, rows);
    inner.style.transform = `translateY(${(-(first - top) * ROW).toFixed(1)}px)`;
    fill(this.rows, inner);
    const marked = this.cursor || this.current;
    if (inner.querySelector(`#source-line-${marked}`))
      this.scroll.setAttribute("aria-activedescendant", `source-line-${marked}`);
    else this.scroll.removeAttribute("aria-activedescendant");
  }

  private row(line: number): HTMLElement {
    const notes = this.notes.get(line) ?? [];
    const worst = notes.some((n) => n.severity === "error") ? "error" : notes.length > 0 ? "warning" : "";
    const text = this.lines.line(line);
    return h(
      "div",
      {
        class: `source-line ${worst}${line === this.cursor ? " marked" : ""}`,
        role: "option",
        id: `source-line-${line}`,
        dataLine: line,
        ariaCurrent: line === this.current ? "true" : null,
        ariaSelected: String(line === this.current),
      },
      h("span", { class: "source-number" }, line),
      h("span", { class: "source-text" }, notes.length > 0 ? underlined(text, notes) : coloured(text)),
    );
  }

  private showTip(target: EventTarget | null): void {
    const mark = (target as HTMLElement | null)?.closest?.<HTMLElement>(".source-mark");
    this.tip.hidden = !mark;
    if (!mark) return;
    fill(
      this.tip,
      h("strong", { class: mark.dataset.severity ?? "" }, severityWord(mark.dataset.severity ?? "")),
      " ",
      h("span", {}, mark.dataset.message ?? ""),
      mark.dataset.hint ? h("p", { class: "hint" }, mark.dataset.hint) : null,
    );
    const box = mark.getBoundingClientRect();
    const around = this.element.getBoundingClientRect();
    const below = box.bottom - around.top + 4;
    const up = below + this.tip.offsetHeight > around.height;
    this.tip.style.top = `${up ? Math.max(0, box.top - around.top - this.tip.offsetHeight - 4) : below}px`;
    this.tip.style.left = `${Math.max(4, Math.min(box.left - around.left, around.width - this.tip.offsetWidth - 8))}px`;
  }
}

function coloured(text: string): Child[] {
  const parts: Child[] = [];
  let at = 0;
  for (const found of text.matchAll(PIECE)) {
    parts.push(text.slice(at, found.index), h("span", { class: "source-faint" }, found[0]));
    at = found.index + found[0].length;
  }
  return [...parts, text.slice(at)];
}

/** Each note underlines the word at its column; after the end of the line, an empty place. */
function underlined(text: string, notes: readonly LineNote[]): Child[] {
  const parts: Child[] = [];
  let at = 0;
  const spans = notes.map((note) => ({ note, ...spanOf(text, note.column) })).sort((a, b) => a.from - b.from);
  for (const { note, from, to } of spans) {
    const start = Math.max(at, from);
    if (to <= start && from < text.length) {
      // Two notes on one word: the second says its message with the first.
      const before = parts.at(-1);
      if (before instanceof HTMLElement) before.dataset.message += ` – ${note.message}`;
      continue;
    }
    parts.push(coloured(text.slice(at, start)));
    parts.push(
      h(
        "span",
        {
          class: `source-mark ${note.severity === "error" ? "error" : "warning"}`,
          tabindex: "0",
          ariaDescribedby: "source-tip",
          ariaLabel: `${text.slice(start, to)} ${severityWord(note.severity)}: ${note.message}`,
          dataSeverity: note.severity,
          dataMessage: note.message,
          dataHint: note.hint ?? "",
        },
        text.slice(start, to) || "\u00a0\u00a0",
      ),
    );
    at = to;
  }
  return [...parts, coloured(text.slice(at))];
}

function spanOf(text: string, column: number | null | undefined): { from: number; to: number } {
  if (!column) {
    const from = text.length - text.trimStart().length;
    return { from, to: text.length };
  }
  const from = Math.min(column - 1, text.length);
  const word = /^(\w[\w.=+-]*|\S)/.exec(text.slice(from))?.[0] ?? text.slice(from, from + 1);
  return { from, to: from + word.length };
}
