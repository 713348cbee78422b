/** Readings of instruments judged by ISO 230: charts, figures with their uncertainty, every target. */

import type { ServeEvaluate, StandardEntry } from "../../types.d.ts";
import type { Request } from "../api.ts";
import { diagnosticList, split, type App, type Tab, type TabHandle } from "../app.ts";
import type { Params } from "../address.ts";
import { fill, h } from "../dom.ts";
import { keepFile, keptFile } from "../files.ts";
import type { Figure } from "../figure/index.ts";
import type { Frame } from "../frame.ts";
import { NARROW_SPACE, number } from "../format.ts";
import { fileSelect, isAbort, Question, reportButton, showRefusal } from "./measure/ask.ts";
import { dropOn, type TextFile } from "./measure/drop.ts";
import { sheetTable } from "./measure/table.ts";
import { as, kindOf, type Circular, type EvaluateDocument } from "./standards/documents.ts";
import { drawPictures } from "./standards/pictures.ts";
import { sheetsOf, tilesOf } from "./standards/tables.ts";
import { takeDropped } from "./start.ts";

type Header = ServeEvaluate;

type Standard = StandardEntry;

/** What the headings of a table say about the test that it is of. */
const BY_HEADING: readonly [RegExp, string][] = [
  [/\bdiagonal\b/, "iso230-6"],
  [/\btarget_(mm|deg)\b/, "iso230-2"],
  [/\bx_mm\b.*\by_mm\b/, "iso230-4"],
  [/\btime_(min|s|h)\b/, "iso230-3"],
  [/\bangle_deg\b/, "iso230-7"],
];

/** The standard that the headings are of; null if they are of none. */
function guess(text: string): string | null {
  const heading = text.split(/\r?\n/).find((line) => line.trim() !== "" && !line.startsWith("#")) ?? "";
  if (text.trimStart().startsWith("<")) return "iso230-4";
  return BY_HEADING.find(([pattern]) => pattern.test(heading))?.[1] ?? null;
}

/** The form of a dropped file, by its ending as on the command line. */
function formOf(name: string): string {
  return /\.qif$/i.test(name) ? "qif" : /\.md$/i.test(name) ? "ecmc-md" : "csv";
}

/** What the server is asked for; the machine is of the other tabs. */
function asked({ machine: _, ...rest }: Params): string {
  return JSON.stringify(rest);
}

class StandardsTab implements TabHandle {
  private readonly app: App;
  private readonly head = h("section", { class: "panel form" });
  private readonly result = h("div", { class: "result" });
  private readonly charts: HTMLElement;
  private readonly open_file: HTMLElement;
  private readonly question: Question<"evaluate">;
  private figures: Figure<never>[] = [];
  private standards: Standard[] = [];
  private dropped: TextFile | null = null;
  private conditions: string | null = null;
  private standard = "iso230-2";
  private shown = false;
  /** The address that the answer on the page is of. */
  private last = "";
  private params: Readonly<Record<string, string>> = {};

  constructor(host: HTMLElement, app: App) {
    this.app = app;
    this.question = new Question(app, "evaluate");
    const { left, right } = split(host, "standards", 0.56);
    this.charts = h("div", { class: "scroll pictures" });
    left.append(this.charts);
    this.open_file = dropOn(host, app, "Open readings …", (file) => this.take(file));
    fill(right, this.head, this.result);
  }

  open(params: Readonly<Record<string, string>>): void {
    const fresh = takeDropped();
    if (fresh) {
      this.take(fresh);
      return;
    }
    // Coming back by the tab shows what was there.
    if (this.shown && (asked(params) === this.last || (!params.path && !params.dropped))) return;
    void this.openWith(params);
  }

  private async openWith(params: Params): Promise<void> {
    this.params = params;
    if (params.path) this.dropped = null;
    else if (params.dropped && this.dropped?.name !== params.dropped)
      this.dropped = await keptFile(this.app.state.project?.folder ?? "", params.dropped);
    if (params === this.params) void this.run();
  }

  hide(): void {
    this.question.stop();
  }

  changed(path: string): void {
    if (path === this.params.path || path === this.conditions) void this.run();
  }

  private take(file: TextFile): void {
    this.dropped = file;
    this.last = "";
    void keepFile(this.app.state.project?.folder ?? "", file);
    // The same name again may be another text: `go` routes again even if the address stays.
    this.app.go("standards", { dropped: file.name });
  }

  /** Changes one field of the form; the address keeps all of them. */
  private choose(change: Record<string, string | null>): void {
    const { machine: _, ...rest } = this.params;
    this.app.go("standards", { ...rest, ...change });
  }

  private async run(): Promise<void> {
    try {
      if (this.standards.length === 0) this.standards = await this.app.api.ask("standards", {});
      const params = this.params;
      const path = this.dropped ? null : (params.path ?? null);
      const standard = params.standard ?? (await this.standardIn(path)) ?? "iso230-2";
      if (params !== this.params) return;
      this.standard = standard;
      this.showForm();
      if (!path && !this.dropped) {
        this.clear();
        fill(
          this.result,
          h(
            "section",
            { class: "panel" },
            h(
              "p",
              {},
              params.dropped
                ? `${params.dropped} is not kept by this browser any more: drop it again.`
                : "Choose readings above, or drop a CSV anywhere here. Nothing leaves this computer.",
            ),
          ),
        );
        return;
      }
      const frame = await this.question.ask(this.body(path), `evaluating ${path ?? this.dropped?.name ?? ""}`);
      this.show(frame, path);
    } catch (error) {
      if (isAbort(error)) return;
      this.clear();
      showRefusal(
        this.result,
        error,
        h(
          "p",
          { class: "note" },
          "Readings of the instruments of a campaign are not judged by a standard: drop them in ",
          h("a", { href: "#identify" }, "Identify"),
          ".",
        ),
      );
    }
  }

  /** By the headings of the readings. */
  private async standardIn(path: string | null): Promise<string | null> {
    const text = this.dropped?.text ?? (path ? (await this.app.api.ask("open", { path })).text : "");
    return guess(text);
  }

  private body(path: string | null): Request<"evaluate"> {
    const { standard } = this;
    const { radius, window, conditions, feature } = this.params;
    const from = this.dropped
      ? { name: this.dropped.name, text: this.dropped.text, import: formOf(this.dropped.name) }
      : { path };
    const more = Object.fromEntries(Object.entries({ radius, window, conditions, feature }).filter(([, v]) => v));
    return { standard, ...from, ...more };
  }

  private clear(): void {
    for (const one of this.figures) one.dispose();
    this.figures = [];
    this.shown = false;
    fill(
      this.charts,
      h("p", { class: "empty" }, "The charts stand here. Drop a CSV of readings anywhere on this page."),
    );
    this.result.replaceChildren();
  }

  // ---- the form ----

  private showForm(): void {
    const { standard } = this;
    const { path = null, conditions } = this.params;
    const choice = h(
      "select",
      {
        ariaLabel: "Standard",
        dataTest: "standard",
        onchange: () => this.choose({ standard: choice.value, radius: null, window: null }),
      },
      this.standards.map((one) => h("option", { value: one.key }, one.title)),
    );
    choice.value = standard;
    const isReadings = ({ kind }: { kind: string }): boolean => kind === "readings";
    const now = this.dropped ? null : path;
    const files = fileSelect(
      this.app,
      this.dropped ? this.dropped.name : "Readings",
      "standards",
      isReadings,
      now,
      (chosen) =>
        this.choose({
          path: chosen,
          dropped: null,
          standard: null,
          radius: null,
          window: null,
          conditions: null,
          feature: null,
        }),
    );
    const beside = h(
      "select",
      {
        ariaLabel: "Conditions of the test",
        class: "file-select",
        onchange: () => this.choose({ conditions: beside.value || null }),
      },
      h("option", { value: "" }, this.dropped ? "none" : "of the same name beside the readings"),
      this.conditionFiles().map((p) => h("option", { value: p }, p)),
    );
    beside.value = conditions ?? "";
    const field = (key: string, label: string, hint: string): HTMLElement => {
      const box = h("input", {
        type: "text",
        class: "short",
        value: this.params[key] ?? "",
        placeholder: hint,
        onchange: () => this.choose({ [key]: box.value.trim() || null }),
      });
      return h("label", { class: "field" }, h("span", {}, label), box);
    };
    fill(
      this.head,
      h(
        "div",
        { class: "row" },
        h("label", { class: "field" }, h("span", {}, "Standard"), choice),
        reportButton(this.app, { verb: "evaluate", file: now, standard }),
      ),
      h("div", { class: "row" }, h("label", { class: "field grow" }, h("span", {}, "Readings"), files), this.open_file),
      h(
        "div",
        { class: "row" },
        h("label", { class: "field grow" }, h("span", {}, "Conditions"), beside),
        standard === "iso230-4" ? field("radius", "Nominal radius", "of the conditions, e.g. 150 mm") : null,
        standard === "iso230-3" ? field("window", "Window", "60 min") : null,
        /\.qif$/i.test(this.dropped?.name ?? path ?? "") ? field("feature", "Feature", "name or id") : null,
      ),
    );
  }

  /** TOML files that may hold conditions: those in the folders of readings. */
  private conditionFiles(): string[] {
    const files = this.app.state.project?.files ?? [];
    const folder = (path: string): string => path.replace(/[^/]*$/, "");
    const here = this.dropped ? null : folder(this.params.path ?? "");
    const readings = new Set(
      files
        .filter((file) => file.kind === "readings" && !/(^|\/)tests?\//.test(file.path))
        .map((file) => folder(file.path)),
    );
    return files
      .filter(
        (file) =>
          file.kind === "other" &&
          file.path.endsWith(".toml") &&
          (here === null ? readings.has(folder(file.path)) : folder(file.path) === here),
      )
      .map((file) => file.path);
  }

  // ---- the answer ----

  private show(frame: Frame<Header>, path: string | null): void {
    const { document, text, pictures, conditions_file, diagnostics } = frame.header;
    this.clear();
    this.shown = true;
    this.last = asked(this.params);
    this.conditions = conditions_file;
    const circle =
      kindOf(document) === "circular"
        ? { radius_mm: as<Circular>(document).radius_mm, axes: as<Circular>(document).axes }
        : {};
    this.charts.replaceChildren();
    this.figures = drawPictures(this.charts, frame, pictures, circle);
    const file = path ?? this.dropped?.name ?? document.file;
    // Title, standard, then machine, axis, instrument, date, temperature: as on the command line.
    const circumstances = text.split("\n")[2]?.trim() ?? file;
    fill(
      this.result,
      h(
        "section",
        { class: "panel" },
        h("h1", {}, document.name ?? file),
        h("p", { class: "muted", dataTest: "circumstances" }, circumstances),
        this.tiles(document),
        h("p", { class: "muted note", dataTest: "conditions" }, this.conditionsText(document, conditions_file, file)),
        diagnostics.length > 0 ? diagnosticList(diagnostics) : null,
      ),
      sheetsOf(document).map(sheetTable),
    );
    this.app.say(file);
  }

  private tiles(document: EvaluateDocument): HTMLElement {
    return h(
      "dl",
      { class: "tiles" },
      tilesOf(document).map((tile) =>
        h(
          "div",
          { class: "tile", title: tile.title, dataTile: tile.symbol },
          h("dt", {}, tile.symbol, h("span", { class: "muted tile-word" }, tile.word)),
          h(
            "dd",
            {},
            h("strong", {}, number(tile.value, 2)),
            h("span", { class: "unit" }, `${NARROW_SPACE}${tile.unit}`),
            tile.U != null
              ? h(
                  "span",
                  { class: "muted tile-u", title: "expanded uncertainty, k = 2" },
                  `U ${number(tile.U, 2)}${NARROW_SPACE}${tile.unit}`,
                )
              : null,
          ),
        ),
      ),
    );
  }

  /** What is known beside the readings, and what is taken for granted without it. */
  private conditionsText(document: EvaluateDocument, conditions: string | null, file: string): string {
    const used =
      kindOf(document) === "circular"
        ? ` Nominal circle: radius ${number(as<Circular>(document).radius_mm, 4)}${NARROW_SPACE}mm about ${as<Circular>(
            document,
          )
            .centre_mm.map((v) => number(v, 4))
            .join(", ")}${NARROW_SPACE}mm.`
        : "";
    if (conditions) return `Conditions: ${conditions}.${used}`;
    const lacking =
      kindOf(document) === "positioning"
        ? "nothing is known of instrument and temperature, so that no uncertainty U can be stated"
        : "nothing is known of instrument, date and temperature";
    const beside = this.dropped
      ? "Choose a conditions file above if there is one."
      : `It would be ${file.replace(/\.[^./]*$/, "")}.toml, beside the readings.`;
    return `No conditions file: ${lacking}. ${beside}${used}`;
  }
}

export const standards: Tab = {
  title: "Standards",
  mount: (host, app) => new StandardsTab(host, app),
};
