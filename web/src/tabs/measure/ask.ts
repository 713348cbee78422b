/** One long question at a time, with its progress in the status line; and what stands at the head of a tab. */

import { refusedWith } from "../../words/told.ts";
import { tr, trText } from "../../words/index.ts";
import { diagnosticList, type App } from "../../app.ts";
import { Refusal, type Diagnostic, type ProjectFile, type Reply, type Request } from "../../api.ts";
import { fill, h, type Child } from "../../dom.ts";
import { Reads } from "../../reads.ts";
import { count } from "./words.ts";

/** Questions of tabs that ask one at a time. */
type Asked =
  | "plan"
  | "identify"
  | "evaluate"
  | "compensate-program"
  | "compensate-tables"
  | "compensate-values"
  | "compensate-adapt"
  | "verify"
  | "measure-sheet"
  | "measure-check"
  | "measure";

/** Asks; a newer question drops the older one. */
export class Question<N extends Asked> {
  private readonly app: App;
  private readonly name: N;
  private readonly reads: Reads;
  private running: AbortController | null = null;

  /** `again` asks once more: a file was changed while the question was under way. */
  constructor(app: App, name: N, again: () => void = () => {}) {
    this.app = app;
    this.name = name;
    this.reads = new Reads(again);
  }

  /** Whether its answer is of another state of the files; null: any file may have changed. */
  isChangedBy(path: string | null): boolean {
    return this.reads.isChangedBy(path);
  }

  stop(): void {
    this.running?.abort();
    this.running = null;
  }

  async ask(body: Request<N>, text: string): Promise<Reply<N>> {
    this.stop();
    const own = new AbortController();
    this.running = own;
    const progress = this.app.progress(text);
    try {
      const asking = this.app.api.ask(this.name, body, {
        signal: own.signal,
        onProgress: (share, note) => progress.report(share, note ? trText(note) : text),
      });
      return await this.reads.of(asking);
    } finally {
      if (this.running === own || this.running === null) progress.done();
    }
  }
}

export function isAbort(error: unknown): boolean {
  return error instanceof DOMException && error.name === "AbortError";
}

/** Most places of one refusal that are shown. */
const MOST_TOLD = 12;

/** What is wrong with the input and what to do, where the result would stand. */
export function showRefusal(host: HTMLElement, error: unknown, ...more: Child[]): void {
  const refusal = Refusal.from(error);
  const [errors, others] = [true, false].map((wanted) =>
    refusal.diagnostics.filter((d) => (d.severity === "error") === wanted),
  ) as [Diagnostic[], Diagnostic[]];
  const list = (all: readonly Diagnostic[]): Child =>
    all.length > 0
      ? [
          diagnosticList(all.slice(0, MOST_TOLD)),
          all.length > MOST_TOLD ? h("p", { class: "muted" }, tr`and ${all.length - MOST_TOLD} more`) : null,
        ]
      : null;
  const isShown = refusal.diagnostics.some((d) => refusal.message.endsWith(d.message));
  fill(
    host,
    h(
      "section",
      { class: "panel refused", role: "alert" },
      isShown ? null : refusedWith("h2", {}, refusal, refusal.message),
      isShown || !refusal.hint ? null : refusedWith("p", { class: "hint" }, refusal, refusal.hint),
      list(errors),
      others.length > 0
        ? h(
            "details",
            { open: errors.length === 0 },
            h("summary", { class: "muted" }, count(others.length, "warning or note", "warnings and notes")),
            list(others),
          )
        : null,
      more,
    ),
  );
}

/** A file of the folder: what is shipped as examples first; test data of the program last. */
export function fileSelect(
  app: App,
  label: string,
  tab: string,
  wanted: (file: ProjectFile) => boolean,
  now: string | null,
  choose: (path: string) => void,
): HTMLSelectElement {
  const project = app.state.project;
  const examples = (project?.examples ?? []).filter((example) => example.tab === tab);
  const shown = new Set(examples.map((example) => example.path));
  const files = (project?.files ?? []).filter((file) => wanted(file) && !shown.has(file.path)).map((file) => file.path);
  const isTest = (path: string): boolean => /(^|\/)tests?\//.test(path);
  files.sort((a, b) => Number(isTest(a)) - Number(isTest(b)) || a.localeCompare(b));
  const option = (path: string, text = path): HTMLElement => h("option", { value: path }, text);
  const select = h(
    "select",
    { ariaLabel: label, class: "file-select", onchange: () => choose(select.value) },
    now && !shown.has(now) && !files.includes(now) ? option(now) : null,
    now ? null : h("option", { value: "", disabled: true }, `${label} …`),
    examples.length > 0
      ? h(
          "optgroup",
          { label: tr`Examples` },
          examples.map((example) => option(example.path, trText(example.title))),
        )
      : null,
    files.length > 0
      ? h(
          "optgroup",
          { label: tr`Files of this folder` },
          files.map((path) => option(path)),
        )
      : null,
  );
  select.value = now ?? "";
  return select;
}

/** The way to the report of the same question; only for files, as a report names what it read. */
export function reportButton(app: App, params: Record<string, string | null | undefined>): HTMLElement | null {
  if (!app.has("report") || !params.file) return null;
  return h("button", { class: "report-link", onclick: () => app.go("report", params) }, tr`Report`);
}
