/** What the machine is like, from readings: verdict, errors with their uncertainty, residuals. */

import { tr, trText } from "../words/index.ts";
import { split, type App, type Tab, type TabHandle } from "../app.ts";
import type { Params } from "../address.ts";
import { Refusal } from "../api.ts";
import { download, fill, h } from "../dom.ts";
import { keepFile, keptFile } from "../files.ts";
import { heatmap, type Figure, type HeatmapSpec } from "../figure/index.ts";
import type { Frame } from "../frame.ts";
import { fileSelect, isAbort, Question, reportButton, showRefusal } from "./measure/ask.ts";
import { dropOn, takeHanded, type TextFile } from "./measure/drop.ts";
import { sheetTable } from "./measure/table.ts";
import type { IdentifyHeader, Instrument } from "./identify/documents.ts";
import {
  confoundedPanel,
  foundPanel,
  identifiedName,
  outlierPanel,
  scorePanel,
  strongPairs,
  valueSheet,
  verdictPanel,
} from "./identify/panels.ts";
import { Residuals } from "./identify/residuals.ts";

class IdentifyTab implements TabHandle {
  private readonly app: App;
  private readonly head = h("section", { class: "panel form" });
  private readonly result = h("div", { class: "result" });
  private readonly residuals: Residuals;
  private readonly map = h("section", { class: "panel" });
  private readonly pairs = h("ul", { class: "note" });
  private readonly open_file: HTMLElement;
  private readonly question: Question<"identify">;
  private figures: Figure<never>[] = [];
  private heat: Figure<HeatmapSpec> | null = null;
  private campaign: string | null = null;
  /** The campaign that the answer on the page is of. */
  private shown: string | null = null;
  private instruments: Instrument[] = [];
  private dropped: TextFile | null = null;
  private instrument: string | null = null;
  private asked = "";

  constructor(host: HTMLElement, app: App) {
    this.app = app;
    this.question = new Question(app, "identify", () => this.askAgain());
    const { left, right } = split(host, "identify", 0.52);
    const pictures = h("div", { class: "scroll pictures" });
    left.append(pictures);
    this.residuals = new Residuals(pictures);
    pictures.append(this.map);
    this.open_file = dropOn(host, app, tr`Open readings …`, (file) => this.take(file));
    this.clear();
    fill(right, this.head, this.result);
  }

  open(params: Params): void {
    void this.openWith(params).catch((error: unknown) => this.app.fail(error));
  }

  private async openWith(params: Params): Promise<void> {
    const campaign =
      params.campaign ??
      this.campaign ??
      this.app.state.project?.examples.find((example) => example.tab === "identify")?.path ??
      null;
    if (campaign !== this.campaign) {
      this.instruments = [];
      this.dropped = null;
      this.instrument = null;
    }
    this.campaign = campaign;
    const handed = takeHanded();
    if (handed) {
      this.take(handed);
      return;
    }
    if (params.dropped && params.dropped !== this.dropped?.name) {
      this.dropped = await keptFile(this.app.state.project?.folder ?? "", params.dropped);
      if (campaign !== this.campaign) return;
      if (!this.dropped)
        this.app.fail(
          new Refusal(
            "dropped-file",
            tr`${params.dropped} is not kept by this browser any more`,
            tr`Drop it here again.`,
          ),
        );
    }
    if (params.instrument) this.instrument = params.instrument;
    void this.run();
  }

  hide(): void {
    this.question.stop();
  }

  changed(path: string | null): void {
    if (this.question.isChangedBy(path)) this.askAgain();
  }

  private askAgain(): void {
    this.asked = "";
    if (this.app.state.tab === "identify") void this.run();
  }

  private take(file: TextFile): void {
    this.dropped = file;
    void keepFile(this.app.state.project?.folder ?? "", file);
    this.asked = "";
    this.instrument = this.instruments.length === 1 ? (this.instruments[0]?.name ?? null) : null;
    void this.run();
  }

  private async run(): Promise<void> {
    this.app.keep("identify", {
      campaign: this.campaign,
      dropped: this.dropped?.name,
      instrument: this.dropped ? this.instrument : null,
    });
    this.showForm();
    if (!this.campaign) {
      this.clear();
      fill(
        this.result,
        h(
          "section",
          { class: "panel" },
          h(
            "p",
            {},
            tr`Choose a campaign: it names the machine, the unknown errors and the readings of its instruments.`,
          ),
        ),
      );
      return;
    }
    if (this.dropped && this.instruments.length > 1 && !this.instrument) {
      this.clear();
      fill(
        this.result,
        h(
          "section",
          { class: "panel" },
          h("p", {}, tr`Which instrument are the readings in ${this.dropped.name} of? Choose it above.`),
        ),
      );
      return;
    }
    const body = {
      campaign: this.campaign,
      ...(this.dropped
        ? {
            name: this.dropped.name,
            text: this.dropped.text,
            ...(this.instrument ? { instrument: this.instrument } : {}),
          }
        : {}),
    };
    const asked = JSON.stringify(body);
    // Coming back to the tab shows what is there; a question that was stopped is asked again.
    if (asked === this.asked) return;
    this.asked = asked;
    if (this.campaign !== this.shown) this.clear();
    if (this.figures.length === 0)
      fill(
        this.result,
        h(
          "section",
          { class: "panel muted" },
          tr`Fitting the errors to the readings, and checking them on readings held out …`,
        ),
      );
    try {
      this.show(await this.question.ask(body, tr`identifying from ${this.dropped?.name ?? this.campaign}`));
    } catch (error) {
      if (this.asked === asked) this.asked = "";
      if (isAbort(error)) return;
      this.clear();
      showRefusal(
        this.result,
        error,
        this.dropped
          ? undefined
          : h(
              "p",
              { class: "note" },
              tr`A CSV of readings that is dropped anywhere on this page is used with this campaign.`,
            ),
      );
    }
  }

  private clear(): void {
    for (const one of this.figures) one.dispose();
    this.figures = [];
    this.residuals.clear();
    this.map.hidden = true;
    this.result.replaceChildren();
  }

  // ---- the form ----

  private showForm(): void {
    const campaigns = fileSelect(
      this.app,
      tr`Campaign`,
      "identify",
      (file) => file.kind === "campaign",
      this.campaign,
      (campaign) => this.app.go("identify", { campaign }),
    );
    fill(
      this.head,
      h(
        "div",
        { class: "row" },
        h("label", { class: "field grow" }, h("span", {}, tr`Campaign`), campaigns),
        this.open_file,
        reportButton(this.app, { verb: "identify", file: this.dropped ? null : this.campaign }),
      ),
      this.readingsRow(),
    );
  }

  /** Whose readings are used: the tables of the campaign, or a dropped file in the place of one of them. */
  private readingsRow(): HTMLElement | null {
    const { dropped } = this;
    if (!dropped) {
      if (this.instruments.length === 0) return null;
      return h(
        "p",
        { class: "muted note" },
        this.instruments
          .map((one) => `${one.name} (${trText(one.kind)}): ${one.tables.join(", ") || tr`no readings`}`)
          .join(" · "),
      );
    }
    const back = h("button", { onclick: () => this.forget() }, tr`Readings of the campaign`);
    return h(
      "div",
      { class: "row" },
      h("strong", {}, dropped.name),
      h("span", { class: "muted" }, tr`instead of the readings of`),
      this.instrumentField(),
      back,
    );
  }

  /** Whose readings the dropped ones are: to be chosen if there are several, to be named while nothing is known. */
  private instrumentField(): HTMLElement {
    const known = this.instruments;
    if (known.length === 1) return h("span", {}, known[0]?.name ?? "");
    if (known.length === 0) {
      const name = h("input", {
        type: "text",
        class: "short",
        value: this.instrument ?? "",
        placeholder: tr`instrument, if there are several`,
        ariaLabel: tr`Instrument of the dropped readings`,
        onchange: () => this.choose(name.value.trim()),
      });
      return name;
    }
    const of = h(
      "select",
      {
        ariaLabel: tr`Instrument of the dropped readings`,
        dataTest: "instrument",
        onchange: () => this.choose(of.value),
      },
      h("option", { value: "", disabled: true }, tr`of which instrument? …`),
      known.map((one) => h("option", { value: one.name }, `${one.name} (${trText(one.kind)})`)),
    );
    of.value = this.instrument ?? "";
    return of;
  }

  private choose(instrument: string): void {
    this.instrument = instrument || null;
    void this.run();
  }

  private forget(): void {
    this.dropped = null;
    void this.run();
  }

  // ---- the answer ----

  private show(frame: Frame<IdentifyHeader>): void {
    const { header } = frame;
    const { document } = header;
    this.instruments = header.instruments;
    this.clear();
    this.shown = this.campaign;
    this.showForm();
    this.residuals.show(frame);
    this.showCorrelation(header.correlation, frame.f64("correlation"));
    fill(this.result, verdictPanel(document), scorePanel(document));
    if (document.errors.length > 0)
      this.add(
        foundPanel(
          tr`Errors of the machine`,
          document.errors,
          tr`Bars: value; whiskers: ± 2u, about 95 %. Grey: not significantly different from zero (|z| below 2).`,
        ),
      );
    this.result.append(confoundedPanel(document.unobservable, tr`All unknowns are observable with these readings.`));
    if (document.errors.length > 0) this.result.append(this.savePanel(header));
    if (document.setup.length > 0)
      this.add(
        foundPanel(
          tr`Set-up of the instruments`,
          document.setup,
          tr`Where balls, sockets and optics really sat: found along with the errors, of no interest afterwards.`,
        ),
      );
    this.result.append(outlierPanel(document), sheetTable(valueSheet(document)));
    this.app.say(this.dropped?.name ?? this.campaign ?? "");
  }

  private add({ panel, figures }: { panel: HTMLElement; figures: Figure<never>[] }): void {
    this.result.append(panel);
    this.figures.push(...figures);
  }

  private showCorrelation(names: string[], values: Float64Array): void {
    const spec: HeatmapSpec = {
      title: tr`Correlation of what was identified`,
      rows: names,
      columns: names,
      values,
      range: [-1, 1],
      digits: 3,
      blank: tr`not observable`,
    };
    this.map.hidden = names.length === 0;
    if (this.heat) this.heat.update(spec);
    else {
      this.heat = heatmap(this.map, spec);
      this.map.append(this.pairs);
    }
    const strong = strongPairs(names, values);
    fill(
      this.pairs,
      strong.length > 0
        ? strong.map(({ words }) => h("li", {}, words))
        : h("li", { class: "muted" }, tr`No two unknowns are correlated by more than 0.9.`),
    );
  }

  private savePanel(header: IdentifyHeader): HTMLElement {
    const file = header.machine_file;
    const name = identifiedName(header);
    if (!file)
      return h(
        "section",
        { class: "panel" },
        h("h2", {}, tr`The identified machine`),
        h("p", {}, tr`No machine file is offered: these readings do not support one.`),
      );
    const save = (): void => {
      download(name, file.text);
      for (const table of file.tables) download(table.name.replace(/^.*\//, ""), table.text, "text/csv");
    };
    const tables = file.tables.map((table) => table.name).join(", ");
    return h(
      "section",
      { class: "panel" },
      h(
        "div",
        { class: "panel-head" },
        h("h2", {}, tr`The identified machine`),
        h("button", { class: "primary", dataTest: "save-machine", onclick: save }, tr`Save the identified machine`),
      ),
      h(
        "p",
        { class: "muted" },
        tables
          ? tr`${name} and ${tables}: ${header.machine} with the errors found here in place of its own, each with its uncertainty.`
          : tr`${name}: ${header.machine} with the errors found here in place of its own, each with its uncertainty.`,
      ),
      header.document.verdict.good
        ? null
        : h(
            "p",
            { class: "unsound" },
            tr`The verdict is not good: something that these errors do not describe is left in the readings.`,
          ),
    );
  }
}

export const identify: Tab = {
  title: tr`Identify`,
  mount: (host, app) => new IdentifyTab(host, app),
};
