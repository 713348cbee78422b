/** Readings of instruments judged by ISO 230: charts, figures with their uncertainty, every target. */

import { tr, trText } from "../words/index.ts";
import type { ServeEvaluate, StandardEntry } from "../../types.d.ts";
import { Refusal, type Request } from "../api.ts";
import { diagnosticList, split, type App, type Tab, type TabHandle } from "../app.ts";
import type { Params } from "../address.ts";
import { fill, h } from "../dom.ts";
import { FileDialog, type Stated } from "../filedialog.ts";
import { keepFile, keptFile, removeFile } from "../files.ts";
import type { Figure } from "../figure/index.ts";
import type { Frame } from "../frame.ts";
import { listed, NARROW_SPACE, number } from "../format.ts";
import { fileSelect, isAbort, Question, reportButton, showRefusal } from "./measure/ask.ts";
import { dropOn, type TextFile } from "./measure/drop.ts";
import { sheetTable } from "./measure/table.ts";
import { ColumnsForm } from "./standards/columns.ts";
import { conditionsForm } from "./standards/conditions.ts";
import { as, kindOf, STATED, type Circular, type EvaluateDocument } from "./standards/documents.ts";
import { drawPictures } from "./standards/pictures.ts";
import { keepInProject } from "./standards/keep.ts";
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

/** Problems that go away where it is said what the columns are. */
const OF_COLUMNS = [
  "unknown-headings",
  "missing-unit",
  "missing-column",
  "duplicate-column",
  "ambiguous-number",
  "mixed-decimals",
  "not-a-number",
  "unknown-word",
  "wrong-unit",
];

/** A file beside readings: `x.csv` has `x.toml` and `x.map.toml`. */
const besideOf = (readings: string, ending: string): string => `${readings.replace(/\.[^./]*$/, "")}${ending}`;

/** What was typed for a dropped file. */
interface Typed {
  mapping: string | null;
  stated: string | null;
}

/** What tolerances look like: the figures of each standard. */
const TOLERANCES: Record<string, string> = {
  "iso230-1": "EC0Y=10 arcsec",
  "iso230-3": "x.range=10 um; y.range=10 um",
  "iso230-4": "G_ccw=15 um; G_cw=15 um",
  "iso230-6": "E_d=20 um",
  "iso230-7": "radial rotating.total=3 um",
  "iso230-10": "offset of the ball from the spindle=5 um",
};

/** What the server is asked for; the machine is of the other tabs. */
function asked({ machine: _, ...rest }: Params): string {
  return JSON.stringify(rest);
}

/** The circle that the deviations are from. */
function nominalText(document: EvaluateDocument): string {
  if (kindOf(document) !== "circular") return "";
  const { radius_mm, centre_mm } = as<Circular>(document);
  const mm = (text: string): string => `${text}${NARROW_SPACE}mm`;
  const centre = centre_mm.map((v) => number(v, 4)).join(", ");
  return tr` Nominal circle: radius ${mm(number(radius_mm, 4))} about ${mm(centre)}.`;
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
  private typed: Typed = { mapping: null, stated: null };
  private conditions: string | null = null;
  private readonly columns: FileDialog;
  private readonly stating: FileDialog;
  private standard = "iso230-2";
  private shown = false;
  /** The address that the answer on the page is of. */
  private last = "";
  private params: Readonly<Record<string, string>> = {};

  constructor(host: HTMLElement, app: App) {
    this.app = app;
    this.question = new Question(app, "evaluate", () => this.askAgain());
    this.columns = new FileDialog(app, "columns", tr`Columns of the readings`, tr`Save and evaluate`);
    this.stating = new FileDialog(app, "conditions", tr`Conditions of the test`, tr`Save and evaluate`);
    const { left, right } = split(host, "standards", 0.56);
    this.charts = h("div", { class: "scroll pictures" });
    left.append(this.charts);
    this.open_file = dropOn(host, app, tr`Open readings …`, (file) => void this.take(file));
    fill(right, this.head, this.result);
  }

  open(params: Readonly<Record<string, string>>): void {
    const fresh = takeDropped();
    if (fresh) {
      void this.take(fresh);
      return;
    }
    // Coming back by the tab shows what was there; not so where something else has been asked since.
    const goes_on = !params.path && !params.dropped && (this.params.path || this.params.dropped);
    const wanted = goes_on ? this.params : params;
    if (this.shown && [wanted, this.params].every((one) => asked(one) === this.last)) return;
    void this.openWith(wanted);
  }

  private async openWith(params: Params): Promise<void> {
    this.params = params;
    if (params.path) {
      this.dropped = null;
      this.typed = { mapping: null, stated: null };
    } else if (params.dropped && this.dropped?.name !== params.dropped) {
      const name = params.dropped;
      const [dropped, mapping, stated] = await Promise.all(
        [name, besideOf(name, ".map.toml"), besideOf(name, ".toml")].map((one) => this.kept(one)),
      );
      if (params !== this.params) return;
      this.dropped = dropped ?? null;
      this.typed = { mapping: mapping?.text ?? null, stated: stated?.text ?? null };
    }
    if (params === this.params) void this.run();
  }

  private kept(name: string): Promise<TextFile | null> {
    return keptFile(this.app.state.project?.folder ?? "", name);
  }

  hide(): void {
    this.question.stop();
  }

  changed(path: string | null): void {
    if (this.question.isChangedBy(path)) this.askAgain();
  }

  private askAgain(): void {
    this.last = "";
    if (this.app.state.tab === "standards") void this.run();
  }

  private async take(file: TextFile): Promise<void> {
    const folder = this.app.state.project?.folder ?? "";
    // What was stated of another file of this name does not count for this one.
    const before = await this.kept(file.name);
    const same = before?.text === file.text || this.dropped?.text === file.text;
    if (!same) {
      this.typed = { mapping: null, stated: null };
      for (const ending of [".map.toml", ".toml"]) await removeFile(folder, besideOf(file.name, ending));
    } else if (this.dropped?.name !== file.name) {
      const [mapping, stated] = await Promise.all(
        [".map.toml", ".toml"].map((ending) => this.kept(besideOf(file.name, ending))),
      );
      this.typed = { mapping: mapping?.text ?? null, stated: stated?.text ?? null };
    }
    this.dropped = file;
    this.last = "";
    void keepFile(folder, file);
    // The same name again may be another text: `go` routes again even if the address stays.
    this.app.go("standards", { dropped: file.name });
  }

  /** Changes one field of the form; the address keeps all of them. */
  private choose(change: Record<string, string | null>): void {
    const { machine: _, ...rest } = this.params;
    this.app.go("standards", { ...rest, ...change });
  }

  private async run(): Promise<void> {
    const { params } = this;
    this.question.stop();
    try {
      if (this.standards.length === 0) this.standards = await this.app.api.ask("standards", {});
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
                ? tr`${params.dropped} is not kept by this browser any more: drop it again.`
                : tr`Choose readings above, or drop a CSV anywhere here. Nothing leaves this computer.`,
            ),
          ),
        );
        return;
      }
      const frame = await this.question.ask(this.body(path), tr`evaluating ${path ?? this.dropped?.name ?? ""}`);
      if (params === this.params) this.show(frame, path);
    } catch (error) {
      if (isAbort(error) || params !== this.params) return;
      this.clear();
      const [before, after] =
        tr`Readings of the instruments of a campaign are not judged by a standard: drop them in ${"|"}.`.split("|");
      const codes = error instanceof Refusal ? error.diagnostics.map((d) => d.code) : [];
      showRefusal(
        this.result,
        error,
        codes.some((code) => OF_COLUMNS.includes(code))
          ? this.columnsButton(tr`Say what the columns are …`, "primary")
          : null,
        h("p", { class: "note" }, before, h("a", { href: "#identify" }, tr`Identify`), after),
      );
    }
  }

  /** By the headings of the readings. */
  private async standardIn(path: string | null): Promise<string | null> {
    const text = this.dropped?.text ?? (path ? (await this.app.api.ask("open", { path })).text : "");
    return guess(text);
  }

  private body(path: string | null): Request<"evaluate"> {
    const { standard, typed } = this;
    const { radius, window, conditions, feature } = this.params;
    const from = this.dropped
      ? {
          name: this.dropped.name,
          text: this.dropped.text,
          ...(typed.mapping === null ? {} : { mapping: typed.mapping }),
          ...(typed.stated === null || conditions ? {} : { stated: typed.stated }),
        }
      : { path };
    const more = Object.fromEntries(Object.entries({ radius, window, conditions, feature }).filter(([, v]) => v));
    return { standard, ...from, ...more, ...this.judged() };
  }

  private judged(): Pick<Request<"evaluate">, "tolerances" | "is_simple"> {
    const { tolerances, simple } = this.params;
    return tolerances ? { tolerances: listed(tolerances), is_simple: simple === "1" } : {};
  }

  // ---- what is stated beside the readings ----

  private columnsButton(text: string, style: string | null = null): HTMLElement | null {
    const name = this.dropped?.name ?? this.params.path;
    if (!name) return null;
    return h(
      "button",
      {
        class: style,
        dataTest: "columns",
        title: tr`Which column is what, its unit and its sign`,
        onclick: () => void this.stateColumns(name),
      },
      text,
    );
  }

  private async stateColumns(name: string): Promise<void> {
    const { dropped } = this;
    const known = this.standards.find((one) => one.key === this.standard)?.columns ?? [];
    const of = { name, path: dropped ? null : name, text: dropped?.text ?? null };
    await this.columns.open({
      title: [tr`Columns of `, h("code", {}, name)],
      path: besideOf(name, ".map.toml"),
      form: async (mapping) => {
        // A file of a person is edited as it is: a form would lose its comments.
        if (mapping !== null && !dropped) return null;
        const from = dropped ? { text: dropped.text } : { path: name };
        const asked = this.app.api.ask("readings-columns", { ...from, ...(mapping === null ? {} : { mapping }) });
        // One that cannot be read is corrected as text.
        const answer = await (mapping === null ? asked : asked.catch(() => null));
        if (answer === null || answer.is_mapping_text) return null;
        const { table } = answer;
        if (!table) throw new Refusal("no-table", tr`${name} has no two columns`, tr`Is it a table of readings?`);
        return new ColumnsForm(this.app, of, known, table);
      },
      ...(dropped ? { kept: this.keptText(dropped.name, ".map.toml", "mapping") } : {}),
      saved: () => void this.run(),
    });
  }

  private async stateConditions(name: string): Promise<void> {
    const { dropped, standard } = this;
    const path = this.params.conditions ?? this.conditions ?? besideOf(name, ".toml");
    await this.stating.open({
      title: [tr`Conditions of `, h("code", {}, name)],
      path,
      form: (text) => (text === null ? conditionsForm(standard, name) : null),
      ...(dropped && !this.params.conditions ? { kept: this.keptText(dropped.name, ".toml", "stated") } : {}),
      saved: () => void this.run(),
    });
  }

  /** Of a dropped file: this browser keeps what is stated, as it keeps the file. */
  private keptText(name: string, ending: string, which: keyof Typed): NonNullable<Stated["kept"]> {
    return {
      text: this.typed[which],
      where: tr`kept by this browser with the file that was dropped`,
      keep: async (text) => {
        this.typed = { ...this.typed, [which]: text };
        await keepFile(this.app.state.project?.folder ?? "", { name: besideOf(name, ending), text });
      },
    };
  }

  /** Puts a dropped file and what was stated of it into the project. */
  private async keep(): Promise<void> {
    const { dropped, typed, params } = this;
    if (!dropped) return;
    const path = await keepInProject(this.app, dropped, typed);
    if (path) this.app.go("standards", { ...params, machine: null, dropped: null, path, standard: this.standard });
  }

  private clear(): void {
    for (const one of this.figures) one.dispose();
    this.figures = [];
    this.shown = false;
    this.conditions = null;
    fill(
      this.charts,
      h("p", { class: "empty" }, tr`The charts stand here. Drop a CSV of readings anywhere on this page.`),
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
        ariaLabel: tr`Standard`,
        dataTest: "standard",
        onchange: () =>
          this.choose({ standard: choice.value, radius: null, window: null, tolerances: null, simple: null }),
      },
      this.standards.map((one) => h("option", { value: one.key }, trText(one.title))),
    );
    choice.value = standard;
    const isReadings = ({ kind }: { kind: string }): boolean => kind === "readings";
    const now = this.dropped ? null : path;
    const files = fileSelect(
      this.app,
      this.dropped ? this.dropped.name : tr`Readings`,
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
          tolerances: null,
          simple: null,
        }),
    );
    const beside = h(
      "select",
      {
        ariaLabel: tr`Conditions of the test`,
        class: "file-select",
        onchange: () => this.choose({ conditions: beside.value || null }),
      },
      h("option", { value: "" }, this.conditionsWord()),
      this.conditionFiles().map((p) => h("option", { value: p }, p)),
    );
    beside.value = conditions ?? "";
    const name = this.dropped?.name ?? path;
    const isTable = name !== null && !/\.(qif|md|rtl|rta)$/i.test(name);
    const tolerance = tr`such as ${TOLERANCES[standard] ?? "A=10 um; R=5 um"}`;
    const field = (key: string, label: string, hint: string, isLong = false): HTMLElement => {
      const box = h("input", {
        type: "text",
        class: isLong ? null : "short",
        dataField: key,
        value: this.params[key] ?? "",
        placeholder: hint,
        onchange: () => this.choose({ [key]: box.value.trim() || null }),
      });
      return h("label", { class: isLong ? "field grow" : "field" }, h("span", {}, label), box);
    };
    fill(
      this.head,
      h(
        "div",
        { class: "row" },
        h("label", { class: "field" }, h("span", {}, tr`Standard`), choice),
        reportButton(this.app, {
          verb: "evaluate",
          file: now,
          standard,
          ...Object.fromEntries(STATED.map((key) => [key, this.params[key] ?? null])),
        }),
        this.dropped && isTable
          ? h(
              "button",
              {
                dataTest: "keep-readings",
                title: tr`Readings, columns and conditions as files of the project: for a report, and for the next time`,
                onclick: () => void this.keep(),
              },
              tr`Save in the project …`,
            )
          : null,
      ),
      h(
        "div",
        { class: "row" },
        h("label", { class: "field grow" }, h("span", {}, tr`Readings`), files),
        this.open_file,
        isTable ? this.columnsButton(tr`Columns …`) : null,
      ),
      h(
        "div",
        { class: "row" },
        h("label", { class: "field grow" }, h("span", {}, tr`Conditions`), beside),
        name
          ? h(
              "button",
              { dataTest: "state-conditions", onclick: () => void this.stateConditions(name) },
              tr`State them …`,
            )
          : null,
        standard === "iso230-4" ? field("radius", tr`Nominal radius`, tr`of the conditions, e.g. 150 mm`) : null,
        standard === "iso230-3" ? field("window", tr`Window`, "60 min") : null,
        /\.qif$/i.test(name ?? "") ? field("feature", tr`Feature`, tr`name or id`) : null,
      ),
      h(
        "div",
        { class: "row" },
        field("tolerances", tr`Tolerances`, tolerance, true),
        this.params.tolerances ? this.simpleBox() : null,
      ),
    );
  }

  private simpleBox(): HTMLElement {
    const box = h("input", {
      type: "checkbox",
      checked: this.params.simple === "1",
      onchange: () => this.choose({ simple: box.checked ? "1" : null }),
    });
    return h("label", { title: tr`Without the uncertainty U: simple acceptance` }, box, tr` by the value alone`);
  }

  private conditionsWord(): string {
    if (!this.dropped) return tr`of the same name beside the readings`;
    return this.typed.stated === null ? tr`none` : tr`as stated here`;
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
    const circumstances = (text.split("\n")[2]?.trim() ?? file).split(" · ");
    fill(
      this.result,
      h(
        "section",
        { class: "panel" },
        h("h1", { dataOwn: "" }, document.name ?? file),
        h("p", { class: "muted", dataTest: "circumstances", dataOwn: "" }, circumstances.map(trText).join(" · ")),
        this.verdict(document),
        this.tiles(document),
        h("p", { class: "muted note", dataTest: "conditions" }, this.conditionsText(document, conditions_file, file)),
        diagnostics.length > 0 ? diagnosticList(diagnostics) : null,
      ),
      sheetsOf(frame.header).map(sheetTable),
    );
    this.app.say(file);
  }

  /** Against the tolerances. */
  private verdict(document: EvaluateDocument): HTMLElement | null {
    const { decisions } = document;
    if (!decisions) return null;
    const standing = { conforming: "pass", "not conforming": "fail" }[decisions.decision] ?? "undecided";
    return h(
      "p",
      { class: `verdict-band ${standing}`, dataTest: "decision" },
      h("strong", {}, trText(decisions.decision)),
      h("span", {}, decisions.rule === "simple" ? tr`by the values alone` : tr`by ${decisions.rule}`),
    );
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
                  { class: "muted tile-u", title: tr`expanded uncertainty, k = 2` },
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
    const encoding = this.dropped?.encoding ? tr` Read as ${this.dropped.encoding}.` : "";
    const more = `${nominalText(document)}${encoding}`;
    if (conditions) return `${tr`Conditions: ${conditions}.`}${more}`;
    if (this.dropped && this.typed.stated !== null) return `${tr`Conditions as stated here.`}${more}`;
    const lacking =
      kindOf(document) === "positioning"
        ? tr`nothing is known of instrument and temperature, so that no uncertainty U can be stated`
        : tr`nothing is known of instrument, date and temperature`;
    const beside = this.dropped
      ? tr`Choose a conditions file above if there is one, or state them.`
      : tr`It would be ${besideOf(file, ".toml")}, beside the readings.`;
    return tr`No conditions file: ${lacking}. ${beside}${more}`;
  }
}

export const standards: Tab = {
  title: tr`Standards`,
  mount: (host, app) => new StandardsTab(host, app),
};
