/** A campaign while it is measured: stations, readings, how well they repeat; or a machine that is not there. */

import { refusedWith } from "../words/told.ts";
import { tr, trText } from "../words/index.ts";
import type { ServeMeasure, ServeMeasureCheck, ServeMeasureSheet } from "../../types.d.ts";
import { diagnosticList, split, type App, type Tab, type TabHandle } from "../app.ts";
import { latestOnly, Refusal, type Request } from "../api.ts";
import { fill, h } from "../dom.ts";
import { fileSelect, isAbort, Question, showRefusal } from "./measure/ask.ts";
import { dropOn, handOver, type TextFile } from "./measure/drop.ts";
import { baseName, fetchMade, filesPanel } from "./measure/made.ts";
import { Sheet } from "./measure/sheet.ts";
import { SheetView } from "./measure/sheetview.ts";
import { headPanel, remarksPanel, sectionPanel } from "./measure/shown.ts";
import { sheetTable } from "./measure/table.ts";
import { count, refusalWords, unitText } from "./measure/words.ts";

type CheckBody = Request<"measure-check">;

/** Typed readings outlive a reload of the page, until they are cleared. */
interface Draft {
  head: string;
  rows: string[][];
}

class MeasureTab implements TabHandle {
  private readonly app: App;
  private readonly head = h("section", { class: "panel form" });
  private readonly side = h("div", { class: "result" });
  private readonly sheet_head = h("section", { class: "panel", hidden: true });
  private readonly view = new SheetView(() => this.typed());
  private readonly progress = h("section", { class: "panel", hidden: true, dataTest: "progress" });
  private readonly repeats = h("div", {});
  private readonly saving = h("section", { class: "panel", hidden: true });
  private readonly virtual_form = h("section", { class: "panel", hidden: true });
  private readonly virtual = h("div", {});
  private readonly open_file: HTMLElement;
  private readonly sheets_question: Question<"measure-sheet">;
  private readonly virtual_question: Question<"measure">;
  private campaign: string | null = null;
  private instrument: string | null = null;
  private seed = "";
  private answer: ServeMeasureSheet | null = null;
  private sheet: Sheet | null = null;
  private asked = "";
  /** Versions of the files that this window has saved, so that it may save them again. */
  private readonly versions = new Map<string, string>();
  private readonly check = latestOnly<CheckBody, ServeMeasureCheck>(
    (body) => this.app.api.ask("measure-check", body),
    (reply, body) => this.showRepeats(reply, body),
    (error) => this.showUnread(error),
  );

  constructor(host: HTMLElement, app: App) {
    this.app = app;
    this.sheets_question = new Question(app, "measure-sheet", () => this.askAgain());
    this.virtual_question = new Question(app, "measure");
    const { left, right } = split(host, "measure", 0.6);
    const scroll = h("div", { class: "scroll" }, this.sheet_head, this.view.element);
    left.append(scroll);
    this.open_file = dropOn(host, app, tr`Open readings …`, (file) => this.take(file));
    fill(right, this.head, this.side, this.progress, this.repeats, this.saving, this.virtual_form, this.virtual);
  }

  open(params: Readonly<Record<string, string>>): void {
    const { examples } = this.app.state.project ?? { examples: [] };
    const campaign =
      params.campaign ?? this.campaign ?? examples.find((example) => example.tab === "measure")?.path ?? null;
    if (campaign !== this.campaign) this.virtual.replaceChildren();
    this.campaign = campaign;
    // The tab's own link names the machine only: what was open stays.
    if (params.campaign) this.instrument = params.instrument ?? null;
    this.seed = params.seed ?? this.seed;
    void this.run();
  }

  hide(): void {
    this.sheets_question.stop();
    this.virtual_question.stop();
  }

  changed(path: string | null): void {
    if (this.sheets_question.isChangedBy(path)) this.askAgain();
  }

  private askAgain(): void {
    this.asked = "";
    if (this.app.state.tab === "measure") void this.run();
  }

  private go(change: { campaign?: string; instrument?: string | null; seed?: string }): void {
    const { campaign, instrument, seed } = {
      campaign: this.campaign,
      instrument: this.instrument,
      seed: this.seed,
      ...change,
    };
    this.app.go("measure", { campaign, instrument, seed });
  }

  // ---- the campaign ----

  private showForm(): void {
    const campaigns = fileSelect(
      this.app,
      tr`Campaign`,
      "measure",
      (file) => file.kind === "campaign",
      this.campaign,
      (campaign) => this.go({ campaign, instrument: null, seed: "" }),
    );
    const plan = h(
      "button",
      {
        title: tr`The stations on the machine, and the programs`,
        onclick: () => this.app.go("plan", { campaign: this.campaign }),
      },
      tr`Plan`,
    );
    fill(
      this.head,
      h(
        "div",
        { class: "row" },
        h("label", { class: "field grow" }, h("span", {}, tr`Campaign`), campaigns),
        this.open_file,
        this.campaign ? plan : null,
      ),
    );
  }

  private clear(): void {
    this.answer = null;
    this.sheet = null;
    for (const panel of [this.sheet_head, this.progress, this.saving, this.virtual_form]) panel.hidden = true;
    for (const part of [this.side, this.repeats, this.view.element, this.virtual]) part.replaceChildren();
  }

  private async run(): Promise<void> {
    this.showForm();
    const { campaign } = this;
    if (!campaign) {
      this.clear();
      const words = tr`Choose a campaign: it names the machine, the instruments and the paths with their stations.`;
      fill(this.side, h("section", { class: "panel" }, h("p", {}, words)));
      return;
    }
    if (this.asked !== campaign) {
      this.asked = campaign;
      this.clear();
      fill(this.side, h("section", { class: "panel muted" }, tr`Working out the stations …`));
      try {
        const answer = await this.sheets_question.ask({ campaign }, tr`stations of ${campaign}`);
        if (this.asked !== campaign) return;
        this.answer = answer;
      } catch (error) {
        if (this.asked !== campaign) return;
        this.asked = "";
        if (isAbort(error)) return;
        this.clear();
        showRefusal(this.side, error, this.elsewhere(error));
        return;
      }
    }
    if (this.answer) this.showSheet(this.answer);
  }

  /** Campaigns whose readings are files already have no stations. */
  private elsewhere(error: unknown): Node | undefined {
    if (Refusal.from(error).code !== "no-path") return undefined;
    return h(
      "p",
      { class: "row" },
      tr`Are its readings taken already?`,
      h("button", { onclick: () => this.app.go("identify", { campaign: this.campaign }) }, tr`Open it in Identify`),
    );
  }

  private showSheet(answer: ServeMeasureSheet): void {
    const header = answer.sheets.find((one) => one.instrument === this.instrument) ?? answer.sheets[0];
    if (!header) return;
    if (this.sheet?.header !== header) {
      this.sheet = new Sheet(header);
      this.restore(this.sheet);
    }
    const sheet = this.sheet;
    const all = answer.sheets.reduce((sum, one) => sum + one.rows.length, 0);
    fill(
      this.side,
      h(
        "section",
        { class: "panel" },
        h("h1", { dataOwn: true }, answer.name),
        h(
          "p",
          { class: "muted" },
          tr`${answer.machine}: ${count(all, "station")} of ${count(answer.sheets.length, "instrument")}.`,
        ),
      ),
      remarksPanel(answer.diagnostics),
    );
    fill(
      this.sheet_head,
      h(
        "div",
        { class: "row" },
        answer.sheets.length > 1
          ? h(
              "label",
              { class: "field" },
              h("span", {}, tr`Instrument`),
              this.instrumentSelect(answer, header.instrument),
            )
          : h("h2", {}, `${header.instrument} (${trText(header.kind)})`),
        h(
          "button",
          { dataTest: "again", title: tr`A second run repeats every station`, onclick: () => this.again() },
          tr`All stations again`,
        ),
        h("button", { dataTest: "clear", onclick: () => this.forget() }, tr`Clear`),
      ),
      h(
        "p",
        { class: "muted note" },
        header.paths.map((path) => `${path.name}: ${count(path.stations, "station")}`).join(" · "),
      ),
      h(
        "p",
        { class: "muted note" },
        tr`Positions in mm and degrees. Type the readings, with a point or a comma, or drop a CSV anywhere on this page (commas or semicolons); + takes one more reading in the same place.`,
      ),
    );
    for (const panel of [this.sheet_head, this.progress, this.saving, this.virtual_form]) panel.hidden = false;
    this.view.show(sheet);
    this.showSaving();
    this.showVirtualForm();
    this.looked();
    this.app.say(this.campaign ?? "");
  }

  private instrumentSelect(answer: ServeMeasureSheet, now: string): HTMLElement {
    const select = h(
      "select",
      { ariaLabel: tr`Instrument`, dataTest: "instrument", onchange: () => this.go({ instrument: select.value }) },
      answer.sheets.map((one) => h("option", { value: one.instrument }, `${one.instrument} (${trText(one.kind)})`)),
    );
    select.value = now;
    return select;
  }

  // ---- readings ----

  private key(sheet: Sheet): string {
    return `readings:${this.app.state.project?.folder}:${this.campaign}:${sheet.header.instrument}`;
  }

  private keep(sheet: Sheet): void {
    const draft: Draft = { head: sheet.head, rows: sheet.rows.map((row) => row.cells) };
    try {
      localStorage.setItem(this.key(sheet), JSON.stringify(draft));
    } catch {
      // More than the browser keeps: then they last as long as the page.
    }
  }

  private restore(sheet: Sheet): void {
    try {
      const draft = JSON.parse(localStorage.getItem(this.key(sheet)) ?? "null") as Draft | null;
      const width = sheet.header.columns.length;
      if (!draft?.rows.every((cells) => cells.length === width)) return;
      sheet.restore(draft.rows);
      sheet.head = draft.head;
    } catch {
      // Not what this page wrote.
    }
  }

  private typed(): void {
    if (!this.sheet) return;
    this.keep(this.sheet);
    this.looked();
  }

  private again(): void {
    this.sheet?.again();
    if (this.sheet) this.view.show(this.sheet);
    this.typed();
  }

  private forget(): void {
    const { sheet } = this;
    if (!sheet) return;
    if (sheet.done > 0 && !window.confirm(tr`Clear ${count(sheet.done, "reading")} of ${sheet.header.instrument}?`))
      return;
    sheet.clear();
    localStorage.removeItem(this.key(sheet));
    this.view.show(sheet);
    this.looked();
  }

  private take(file: TextFile): void {
    const { sheet } = this;
    if (!sheet) return;
    const words = tr`Replace ${count(sheet.done, "reading")} of ${sheet.header.instrument} by those of ${file.name}?`;
    if (sheet.done > 0 && !window.confirm(words)) return;
    try {
      const unused = sheet.take(file.name, file.text);
      this.view.show(sheet);
      this.typed();
      this.app.say([`${file.name}: ${count(sheet.rows.length, "row")}`, ...unused].join("; "));
    } catch (error) {
      this.app.fail(error);
    }
  }

  /** Progress at once; the server looks at the readings as `identify` does. */
  private looked(): void {
    const { sheet, campaign } = this;
    if (!sheet || !campaign) return;
    const { done } = sheet;
    const all = sheet.rows.length;
    const bad = sheet.bad();
    fill(
      this.progress,
      h("h2", {}, tr`Readings`),
      h(
        "p",
        { class: "readings-progress" },
        h("progress", { max: String(Math.max(1, all)), value: done, ariaLabel: tr`Readings taken` }),
        h("strong", { dataTest: "done" }, all === 1 ? tr`${done} of 1 reading` : tr`${done} of ${all} readings`),
      ),
      bad.length > 0
        ? h(
            "ul",
            { class: "bad-cells", role: "alert" },
            bad.slice(0, 8).map((cell) => h("li", { class: "unsound" }, cell.words)),
            bad.length > 8 ? h("li", { class: "muted" }, tr`and ${bad.length - 8} more`) : null,
          )
        : null,
    );
    if (done === 0) this.repeats.replaceChildren();
    else
      this.check({
        campaign,
        instrument: sheet.header.instrument,
        name: baseName(sheet.header.file),
        text: sheet.csv(),
      });
  }

  private showRepeats(reply: ServeMeasureCheck, body: CheckBody): void {
    // The answer to a sheet that is not shown any more.
    if (body.instrument !== this.sheet?.header.instrument || body.campaign !== this.campaign) return;
    if (reply.channels.length === 0) {
      const words =
        reply.repeated === 0
          ? tr`No place has been read twice so far: the repeatability is not known. + at the end of a row takes one more reading there.`
          : tr`The reading of this instrument is where the axes stood: its repeatability is seen in Identify.`;
      fill(
        this.repeats,
        h("section", { class: "panel" }, h("h2", {}, tr`Repeatability`), h("p", { class: "muted" }, words)),
      );
      return;
    }
    const unit = unitText(reply.channels[0]?.unit ?? "um");
    const places =
      reply.repeated === 1
        ? tr`1 place of ${reply.places} read more than once`
        : tr`${reply.repeated} places of ${reply.places} read more than once`;
    fill(
      this.repeats,
      sheetTable({
        title: tr`Repeatability`,
        key: "repeats",
        head: (tr) => [
          tr`channel`,
          tr`standard deviation s, ${unit}`,
          tr`degrees of freedom`,
          tr`largest range, ${unit}`,
          tr`noise stated, ${unit}`,
        ],
        digits: [undefined, 3, 0, 3, 3],
        rows: reply.channels.map((one) => [one.channel, one.s, one.degrees_of_freedom, one.largest_range, one.stated]),
        note: tr`${places}; s from all of them together, n − 1 degrees of freedom in each.`,
      }),
      reply.diagnostics.length > 0 ? remarksPanel(reply.diagnostics) : null,
    );
  }

  private showUnread(error: unknown): void {
    const refusal = Refusal.from(error);
    fill(
      this.repeats,
      h(
        "section",
        { class: "panel refused", role: "alert" },
        h("h2", {}, tr`These readings cannot be used yet`),
        refusal.diagnostics.length > 0
          ? diagnosticList(refusal.diagnostics.slice(0, 8))
          : h(
              "p",
              {},
              refusedWith("span", {}, refusal, refusal.message),
              " ",
              refusedWith("span", { class: "hint" }, refusal, refusal.hint),
            ),
      ),
    );
  }

  // ---- saving ----

  private showSaving(): void {
    const { sheet } = this;
    if (!sheet) return;
    const { file, named, there } = sheet.header;
    const said = h("p", { class: "note", role: "status", dataTest: "saved" });
    const name = h("input", {
      type: "text",
      class: "short",
      value: file,
      ariaLabel: tr`Name of the readings in the project folder`,
      dataTest: "save-name",
    });
    const identify = h(
      "button",
      { dataTest: "identify", onclick: () => this.identify(name.value.trim()) },
      tr`Identify with these readings`,
    );
    const submit = (event: Event): void => {
      event.preventDefault();
      void this.save(name.value.trim(), said);
    };
    fill(
      this.saving,
      h("h2", {}, tr`Into the project`),
      h(
        "form",
        { class: "save-form", onsubmit: submit },
        h("label", { class: "field grow" }, h("span", {}, tr`Name`), name),
        h("button", { type: "submit", dataTest: "save" }, tr`Save as CSV`),
        identify,
        said,
      ),
      h(
        "p",
        { class: "muted note" },
        named
          ? tr`${file} is where the campaign has the readings of this instrument${there ? tr`; it is there already, and is not replaced` : ""}.`
          : tr`The campaign names no file of readings; with readings = "${baseName(file)}" under [instrument.${sheet.header.instrument}] identify finds them.`,
      ),
    );
  }

  /** Whether the readings may go on; what keeps them is said. */
  private usable(said?: HTMLElement): boolean {
    const { sheet } = this;
    const bad = sheet?.bad()[0];
    const words = !sheet || sheet.done === 0 ? tr`There is no reading yet.` : bad ? `${bad.words}.` : null;
    if (words && said) {
      fill(said, words);
      said.classList.add("unsound");
    } else if (words) this.app.fail(new Refusal("no-readings", words));
    return words === null;
  }

  private async save(path: string, said: HTMLElement): Promise<void> {
    const { sheet } = this;
    if (!sheet || !this.usable(said)) return;
    try {
      const version = this.versions.get(path) ?? null;
      const saved = await this.app.api.ask("save", { path, text: sheet.csv(), version, window: this.app.api.window });
      this.versions.set(path, saved.version);
      fill(said, tr`${count(sheet.done, "reading")} saved as ${path}.`);
      said.classList.remove("unsound");
    } catch (error) {
      const refusal = Refusal.from(error);
      fill(said, refusalWords(refusal));
      said.classList.add("unsound");
    }
  }

  private identify(path: string): void {
    const { sheet } = this;
    if (!sheet || !this.usable()) return;
    handOver({ name: baseName(path) || "readings.csv", text: sheet.csv() });
    this.app.go("identify", { campaign: this.campaign });
  }

  // ---- a machine that is not there ----

  private showVirtualForm(): void {
    const seed = h("input", {
      type: "number",
      class: "short",
      min: "0",
      step: "1",
      value: this.seed,
      placeholder: tr`that of the file`,
      ariaLabel: tr`Random seed`,
      dataTest: "seed",
    });
    const run = (event: Event): void => {
      event.preventDefault();
      this.seed = seed.value.trim();
      void this.measure();
    };
    fill(
      this.virtual_form,
      h("h2", {}, tr`Try it on a virtual machine`),
      h(
        "form",
        { class: "save-form", onsubmit: run },
        h("label", { class: "field" }, h("span", {}, tr`Seed`), seed),
        h("button", { type: "submit", dataTest: "virtual" }, tr`Measure`),
      ),
      h(
        "p",
        { class: "muted note" },
        tr`What the instruments would read on the machine of [truth], with the noise and the disturbances that the campaign states. The same seed gives the same readings.`,
      ),
    );
  }

  private async measure(): Promise<void> {
    const { campaign } = this;
    if (!campaign) return;
    fill(this.virtual, h("section", { class: "panel muted" }, tr`Reading the instruments on the virtual machine …`));
    try {
      const body = { campaign, ...(this.seed ? { seed: Number(this.seed) } : {}) };
      const reply = await this.virtual_question.ask(body, tr`measuring ${campaign} on a virtual machine`);
      if (campaign === this.campaign) this.showVirtual(reply);
    } catch (error) {
      if (campaign !== this.campaign) return;
      this.virtual.replaceChildren();
      if (!isAbort(error)) showRefusal(this.virtual, error);
    }
  }

  private showVirtual(reply: ServeMeasure): void {
    const own = reply.document.instruments.findIndex((one) => one.name === this.sheet?.header.instrument);
    const put = async (): Promise<void> => {
      const blob = await fetchMade(reply.made, own);
      this.take({ name: baseName(reply.made.files[own]?.name ?? ""), text: await blob.text() });
    };
    fill(
      this.virtual,
      headPanel(
        reply.shown,
        own >= 0
          ? h(
              "button",
              {
                class: "primary",
                dataTest: "put",
                onclick: () => void put().catch((error: unknown) => this.app.fail(error)),
              },
              tr`Put these readings into the sheet`,
            )
          : null,
      ),
      filesPanel(
        this.app,
        reply.made,
        tr`Virtual readings`,
        tr`One table for each instrument, and what is true; nothing is written before you download or save it.`,
      ),
      reply.shown.sections.map(sectionPanel),
    );
  }
}

export const measure: Tab = {
  title: tr`Measure`,
  mount: (host, app) => new MeasureTab(host, app),
};
