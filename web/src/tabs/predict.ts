/** The test piece before it is cut: is it good, which error contributes what, and what if? */

import { tr } from "../words/index.ts";
import { refusedWith } from "../words/told.ts";
import { diagnosticList, split, type App, type Tab, type TabHandle } from "../app.ts";
import { latestOnly, Refusal } from "../api.ts";
import type { Params } from "../address.ts";
import { fill, h } from "../dom.ts";
import { number } from "../format.ts";
import type { Frame } from "../frame.ts";
import { ErrorBudget } from "./predict/budget.ts";
import { Details } from "./predict/details.ts";
import { Drawing } from "./predict/drawing.ts";
import { Holes } from "./predict/holes.ts";
import { PieceView } from "./predict/piece.ts";
import { Reads } from "../reads.ts";
import { Sections } from "./predict/sections.ts";
import { studyChoice, Summary } from "./predict/summary.ts";
import type { DrawingHeader, HolesHeader, PieceFrame } from "./predict/types.ts";
import { WhatIf, type Changes } from "./predict/whatif.ts";

type Answer = PieceFrame | Frame<HolesHeader> | Frame<DrawingHeader>;
type Page = "budget" | "what-if" | "numbers";
const PAGES: readonly [Page, string][] = [
  ["budget", tr`Error budget`],
  ["what-if", tr`What if`],
  ["numbers", tr`All numbers`],
];

interface Wanted {
  study: string;
  changes: Changes;
  asked_at: number;
}

class PredictTab implements TabHandle {
  private readonly app: App;
  private readonly empty = h("div", { class: "panel predict-empty" });
  private readonly piece_page = h("div", { class: "predict-page", hidden: true });
  private readonly holes_page = h("div", { class: "predict-page", hidden: true });
  private readonly drawing_page = h("div", { class: "predict-page", hidden: true });
  private readonly pages = new Map<Page, HTMLElement>();
  private readonly page_buttons = h("div", { class: "group", role: "group", ariaLabel: tr`Shown below` });
  private piece: {
    summary: Summary;
    view: PieceView;
    sections: Sections;
    budget: ErrorBudget;
    what_if: WhatIf;
    details: Details;
  } | null = null;
  private holes: Holes | null = null;
  private drawing: Drawing | null = null;
  private study: string | null = null;
  /** The study that cannot be predicted as its files are. */
  private refused: string | null = null;
  /** Whether a part is judged by its program compensated for the machine, too. */
  private compensated = false;
  private stop = new AbortController();
  private readonly reads = new Reads(() => this.askAgain());
  /** A file has changed while another tab was shown. */
  private is_stale = false;
  /** What the address says of how it is shown. */
  private wanted: Params = {};
  private page: Page = "budget";
  /** The prediction of the file; what is shown may be changed. */
  private base: PieceFrame | null = null;
  private readonly ask = latestOnly<Wanted, PieceFrame>(
    ({ study, changes }) =>
      this.app.api.ask("what-if", { study, ...changes }) as Promise<unknown> as Promise<PieceFrame>,
    (frame, wanted) => this.showChanged(frame, wanted),
    (error) => this.piece?.what_if.refuse(Refusal.from(error)),
  );

  constructor(host: HTMLElement, app: App) {
    this.app = app;
    fill(host, this.empty, this.piece_page, this.holes_page, this.drawing_page);
  }

  open(params: Readonly<Record<string, string>>): void {
    const wanted = params.study ?? this.study ?? this.firstStudy();
    if (wanted === null) {
      fill(
        this.empty,
        h(
          "p",
          {},
          tr`There is no study in this folder. Open an example on the first page, or put a study that names a machine and a test piece or a part into the folder.`,
        ),
      );
      return;
    }
    const compensated = params.compensated === "true";
    this.wanted = params;
    if (wanted === this.study && compensated === this.compensated && !this.is_stale) {
      if (this.base || this.drawing) this.takeState();
      return;
    }
    this.compensated = compensated;
    void this.load(wanted);
  }

  /** That of the first example, where there are examples. */
  private firstStudy(): string | null {
    const project = this.app.state.project;
    return (
      project?.examples.find((e) => e.tab === "predict")?.path ??
      project?.files.find((f) => f.kind === "study")?.path ??
      null
    );
  }

  changed(path: string | null): void {
    if (this.reads.isChangedBy(path)) this.askAgain();
  }

  private askAgain(): void {
    const study = this.study ?? this.refused;
    this.is_stale = this.app.state.tab !== "predict";
    if (this.is_stale || !study) return;
    // What was tried stays.
    const { what = null } = this.piece && this.base ? { what: this.piece.what_if.state } : this.wanted;
    this.wanted = { ...this.wanted, ...(what ? { what } : {}) };
    void this.load(study);
  }

  private async load(study: string): Promise<void> {
    this.stop.abort();
    const stop = new AbortController();
    this.stop = stop;
    this.study = study;
    this.refused = null;
    this.is_stale = false;
    const progress = this.app.progress(tr`predicting ${study}`);
    try {
      const asked = this.compensated ? { study, compensated: true } : { study };
      const options = { onProgress: progress.report, signal: stop.signal };
      const frame = (await this.reads.of(this.app.api.ask("predict", asked, options))) as unknown as Answer;
      if (stop.signal.aborted) return;
      progress.done();
      this.empty.hidden = true;
      this.holes_page.hidden = frame.header.kind !== "holes";
      this.drawing_page.hidden = frame.header.kind !== "drawing";
      this.piece_page.hidden = frame.header.kind !== "test-piece";
      if (isHoles(frame)) this.showHoles(study, frame);
      else if (isDrawing(frame)) this.showDrawing(study, frame);
      else this.showPiece(study, frame);
      this.app.say(study);
      this.takeState();
    } catch (error) {
      progress.done();
      if (stop.signal.aborted) return;
      this.study = null;
      this.refused = study;
      this.showFailure(study, Refusal.from(error));
    }
  }

  // ---- the address ----

  /** How the prediction is shown, as the address says: changes of the machine, the page below, magnification. */
  private takeState(): void {
    const { what, page, k } = this.wanted;
    const { piece } = this;
    if (this.base && piece) {
      piece.what_if.take(what ?? null);
      piece.view.magnifier.take(k);
      if (page || what) this.showPage(PAGES.find(([name]) => name === page)?.[0] ?? this.page);
    } else if (!this.drawing_page.hidden) this.drawing?.map.magnifier.take(k);
    this.app.keep("predict", { study: this.study });
  }

  /** Nothing of another study stays beside the message. */
  private showFailure(study: string, refusal: Refusal): void {
    this.piece_page.hidden = this.holes_page.hidden = this.drawing_page.hidden = true;
    this.empty.hidden = false;
    fill(
      this.empty,
      h("div", { class: "panel-head" }, h("h1", {}, tr`${study} cannot be predicted`), studyChoice(this.app, study)),
      refusedWith("p", {}, refusal, refusal.message),
      refusal.hint ? refusedWith("p", { class: "hint" }, refusal, refusal.hint) : null,
      diagnosticList(refusal.diagnostics),
      h("button", { onclick: () => void this.load(study) }, tr`Try again`),
      this.compensated
        ? h("button", { onclick: () => this.app.go("predict", { study }) }, tr`Without the compensated program`)
        : null,
    );
  }

  // ---- holes ----

  private showHoles(study: string, frame: Frame<HolesHeader>): void {
    this.base = null;
    this.holes ??= new Holes(this.holes_page, this.app);
    this.holes.show(study, frame.header);
  }

  private showDrawing(study: string, frame: Frame<DrawingHeader>): void {
    this.base = null;
    if (!this.drawing) {
      this.drawing = new Drawing(this.drawing_page, this.app);
      this.drawing.map.magnifier.onMoved = (k) => this.app.keep("predict", { k });
    }
    this.drawing.show(study, frame);
  }

  // ---- a test piece ----

  private showPiece(study: string, frame: PieceFrame): void {
    this.base = frame;
    this.piece ??= this.build();
    const { summary, view, sections, budget, what_if, details } = this.piece;
    summary.show(study, frame.header.document, null);
    sections.show(frame, null, true);
    budget.show(frame.header.document, frame.header.document, true);
    details.show(frame, null);
    what_if.open(frame.header);
    // Last: the picture is fitted to the room that the others leave.
    view.show(frame, true);
  }

  private build(): NonNullable<PredictTab["piece"]> {
    const { left, right } = split(this.piece_page, "predict", 0.44);
    const scene = h("div", { class: "predict-scene" });
    const polar = h("div", { class: "panel predict-sections" });
    const summary = new Summary(this.app);
    left.append(scene, polar);
    right.append(summary.element, h("div", { class: "predict-switch" }, this.page_buttons));
    for (const [page, title] of PAGES) {
      const host = h("div", { class: "predict-lower", dataPage: page });
      this.pages.set(page, host);
      right.append(host);
      this.page_buttons.append(h("button", { dataShow: page, onclick: () => this.choosePage(page) }, title));
    }
    const place = (page: Page): HTMLElement => this.pages.get(page) as HTMLElement;
    const what_if = new WhatIf(place("what-if"), (changes) => this.change(changes));
    const budget = new ErrorBudget(place("budget"), {
      without: (error) => this.tryIt(() => what_if.without(error)),
      correct: (error, text) => this.tryIt(() => what_if.correct(error, text)),
    });
    const view = new PieceView(scene);
    view.magnifier.onMoved = (k) => this.app.keep("predict", { k });
    const built = {
      summary,
      view,
      sections: new Sections(polar, (index) => view.mark(index)),
      budget,
      what_if,
      details: new Details(place("numbers")),
    };
    this.showPage("budget");
    return built;
  }

  private choosePage(page: Page): void {
    this.showPage(page);
    this.app.keep("predict", { page: page === "budget" ? null : page });
  }

  private showPage(page: Page): void {
    this.page = page;
    for (const [name, host] of this.pages) host.hidden = name !== page;
    for (const button of this.page_buttons.querySelectorAll("button"))
      button.setAttribute("aria-pressed", String(button.dataset.show === page));
  }

  private tryIt(change: () => void): void {
    this.choosePage("what-if");
    change();
  }

  private change(changes: Changes | null): void {
    if (!this.study || !this.base) return;
    this.app.keep("predict", { what: this.piece?.what_if.state ?? null });
    if (changes) this.ask({ study: this.study, changes, asked_at: performance.now() });
    else this.draw(this.base, null);
  }

  private showChanged(frame: PieceFrame, wanted: Wanted): void {
    // The study may have been reset or opened another study meanwhile.
    if (wanted.study !== this.study || !this.base || !this.piece?.what_if.changes()) return;
    const answered = performance.now() - wanted.asked_at;
    this.draw(frame, this.base);
    const drawn = performance.now() - wanted.asked_at;
    this.piece.what_if.answered(answered, drawn);
    this.app.say(tr`what if: answered in ${number(answered, 0)} ms`);
  }

  private draw(frame: PieceFrame, before: PieceFrame | null): void {
    if (!this.piece || !this.study) return;
    const { document } = frame.header;
    const earlier = before?.header.document ?? null;
    this.piece.summary.show(this.study, document, earlier);
    this.piece.view.show(frame, false);
    this.piece.sections.show(frame, before, false);
    this.piece.budget.show(document, earlier ?? document, false);
    this.piece.details.show(frame, earlier);
  }
}

const isDrawing = (frame: Answer): frame is Frame<DrawingHeader> => frame.header.kind === "drawing";
const isHoles = (frame: Answer): frame is Frame<HolesHeader> => frame.header.kind === "holes";

export const predict: Tab = {
  title: tr`Predict`,
  mount: (host, app) => new PredictTab(host, app),
};
