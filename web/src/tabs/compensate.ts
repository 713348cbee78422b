/** What must be commanded instead: a program, tables of a control, values of an axis, a path on a measured blank. */

import { tr, trText } from "../words/index.ts";
import { split, type App, type Tab, type TabHandle } from "../app.ts";
import { fill, h } from "../dom.ts";
import type { Figure } from "../figure/index.ts";
import type { FileKind, Request } from "../api.ts";
import { isAbort, Question, reportButton, showRefusal } from "./measure/ask.ts";
import { downloadButton, filesPanel, saveForm, type Made } from "./measure/made.ts";
import { headPanel, remarksPanel, sectionPanel, type Shown } from "./measure/shown.ts";
import type { Choice, Of } from "./compensate/documents.ts";
import { KINDS } from "./compensate/documents.ts";
import { formRows, type Target } from "./compensate/form.ts";
import {
  alongPanel,
  cannotPanel,
  changesPanel,
  deviationTable,
  leftTable,
  tablesVerdict,
  valuesPanel,
  wallPanel,
  type Drawn,
} from "./compensate/panels.ts";

const NOTHING: Choice = {
  of: "program",
  machine: null,
  program: null,
  setup: null,
  control: null,
  target: "sinumerik",
  axis: "",
  at: "",
  step: "",
  study: null,
  temperature: "",
  residual: "",
  options: [],
};

/** Sections of the report of tables that the page shows in its own way, by their titles from the server. */
const TABLES_DRAWN = ["Tool tip over the travel of all axes", "Represented", "Not represented, each alone, at the tip"];

class CompensateTab implements TabHandle {
  private readonly app: App;
  private readonly head = h("section", { class: "panel form" });
  private readonly result = h("div", { class: "result" });
  private readonly pictures = h("div", { class: "scroll pictures" });
  private readonly questions: {
    program: Question<"compensate-program">;
    tables: Question<"compensate-tables">;
    values: Question<"compensate-values">;
    blank: Question<"compensate-adapt">;
  };
  private choice: Choice = NOTHING;
  private targets: readonly Target[] = [];
  /** The axes of the machine, for the values of one of them. */
  private axes: readonly string[] = [];
  private axes_of: string | null = null;
  private figures: Figure<never>[] = [];
  /** The question that the page shows, or that is under way. */
  /** What the report of what is shown is asked with. */
  private report: Record<string, string | null | undefined> | null = null;
  private asked = "";

  constructor(host: HTMLElement, app: App) {
    this.app = app;
    this.questions = {
      program: new Question(app, "compensate-program", () => this.askAgain()),
      tables: new Question(app, "compensate-tables", () => this.askAgain()),
      values: new Question(app, "compensate-values", () => this.askAgain()),
      blank: new Question(app, "compensate-adapt", () => this.askAgain()),
    };
    const { left, right } = split(host, "compensate", 0.5);
    left.append(this.pictures);
    fill(right, this.head, this.result);
  }

  open(params: Readonly<Record<string, string>>): void {
    const named = Object.keys(params).some((key) => key !== "machine");
    // The tab's own link names the machine only: what was open goes on, on that machine.
    this.choice = named || this.choice === NOTHING ? this.read(params) : this.choice;
    if (!named && params.machine && params.machine !== this.choice.machine)
      this.choice = { ...this.choice, machine: params.machine, at: "", axis: "", step: "" };
    void this.run();
  }

  hide(): void {
    this.stop();
  }

  changed(path: string | null): void {
    if (this.questions[this.choice.of].isChangedBy(path)) this.askAgain();
  }

  private askAgain(): void {
    this.axes_of = null;
    this.asked = "";
    if (this.app.state.tab === "compensate") void this.run();
  }

  private stop(): void {
    for (const question of Object.values(this.questions)) question.stop();
  }

  /** The choice in the address; what it leaves out is as in the first example. */
  private read(params: Readonly<Record<string, string>>): Choice {
    const { project, machine } = this.app.state;
    const example = project?.examples.find((one) => one.tab === "compensate");
    // A link of the first page names a study only.
    const of = KINDS.find(([key]) => key === params.of)?.[0] ?? (params.study ? "blank" : "program");
    const alone = Object.keys(params).length === 0 && !machine;
    const program = params.program ?? (alone ? (example?.path ?? this.only("program")) : null);
    const blank = project?.files.find((file) => file.kind === "blank")?.path ?? null;
    return {
      ...NOTHING,
      of,
      machine: params.machine ?? (alone ? (example?.machine ?? this.only("machine")) : machine),
      program,
      setup: params.setup ?? null,
      control: params.control ?? null,
      target: params.target ?? NOTHING.target,
      axis: params.axis ?? "",
      at: params.at ?? "",
      step: params.step ?? "",
      study: params.study ?? (of === "blank" ? blank : null),
      temperature: params.temperature ?? "",
      residual: params.residual ?? "",
      options: params.options?.split(",").filter(Boolean) ?? [],
    };
  }

  /** The file of a kind, where the project has one. */
  private only(kind: FileKind): string | null {
    const files = (this.app.state.project?.files ?? []).filter((file) => file.kind === kind);
    return files.length === 1 ? (files[0]?.path ?? null) : null;
  }

  private go(change: Partial<Choice>): void {
    const { options, ...rest } = { ...this.choice, ...change };
    this.app.go("compensate", { ...rest, options: options.join(",") });
  }

  private showForm(): void {
    const known = { targets: this.targets, axes: this.axes };
    fill(
      this.head,
      formRows(this.app, this.choice, known, (change) => this.go(change)),
    );
    const button = this.report && reportButton(this.app, this.report);
    if (button) this.head.append(h("div", { class: "row" }, button));
  }

  private clear(): void {
    for (const one of this.figures) one.dispose();
    this.figures = [];
    this.pictures.replaceChildren();
    this.result.replaceChildren();
  }

  private say(words: string): void {
    this.clear();
    fill(this.result, h("section", { class: "panel" }, h("p", {}, words)));
    fill(this.pictures, h("p", { class: "empty" }, tr`The deviations before and after are drawn here.`));
  }

  // ---- asking ----

  private missing(): string | null {
    const { of, machine, program, study } = this.choice;
    if (of === "blank") return study ? null : tr`Choose a study: it names the path, the measured blank and the cutter.`;
    if (!machine) return tr`Choose a machine file: its errors are what is compensated.`;
    if (of === "program" && !program) return tr`Choose an NC program of the folder.`;
    return null;
  }

  private async run(): Promise<void> {
    this.showForm();
    const missing = this.missing();
    if (missing) {
      this.stop();
      this.asked = "";
      this.say(missing);
      return;
    }
    this.fillAxis();
    let asked = JSON.stringify(this.choice);
    if (asked !== this.asked) this.report = null;
    // Coming back to the tab shows what is there.
    if (asked === this.asked) return;
    this.asked = asked;
    this.stop();
    this.say(tr`Working out the compensation, and proving it …`);
    try {
      await this.prepare();
      if (this.asked !== asked) return;
      asked = JSON.stringify(this.choice);
      this.asked = asked;
      await this.ask(asked);
    } catch (error) {
      // Another choice has taken its place: what went wrong with this one is of no interest.
      if (this.asked !== asked) return;
      this.asked = "";
      if (isAbort(error)) return;
      this.clear();
      showRefusal(this.result, error, this.advice(error));
    }
  }

  /** The first axis, where none of this machine is chosen. */
  private fillAxis(): void {
    const { of, machine, axis } = this.choice;
    if (of === "values" && this.axes_of === machine && !this.axes.includes(axis))
      this.choice = { ...this.choice, axis: this.axes[0] ?? "" };
  }

  /** The controls that tables can be made for, and the axes of the machine: once each. */
  private async prepare(): Promise<void> {
    const { of, machine } = this.choice;
    if (of === "tables" && this.targets.length === 0) this.targets = await this.app.api.ask("compensate-targets", {});
    if (of === "values" && machine && this.axes_of !== machine) {
      const described = await this.app.api.ask("describe", { machine });
      this.axes = described.links.map((link) => link.name);
      this.axes_of = machine;
    }
    this.fillAxis();
    this.showForm();
  }

  private on(option: string): boolean {
    return this.choice.options.includes(option);
  }

  /** The way to the report of what was asked: with the same options, without the files that it names itself. */
  private reported(verb: string, files: { file: string | null; machine?: string | null }, body: object): void {
    const named = new Set<unknown>(Object.values(files));
    const options = Object.fromEntries(Object.entries(body).filter(([, value]) => !named.has(value)));
    this.report = { verb, ...files, with: JSON.stringify(options) };
    this.showForm();
  }

  private async ask(asked: string): Promise<void> {
    const { of, machine, program, study, target, axis, at, step, setup, control, temperature, residual } = this.choice;
    const warm = {
      machine: machine ?? "",
      ...(temperature ? { temperature } : {}),
      ...(this.on("machine-only") ? { machine_only: true } : {}),
    };
    const fresh = (): boolean => this.asked === asked;
    if (of === "program") {
      const body: Request<"compensate-program"> = {
        ...warm,
        program: program ?? "",
        ...(setup ? { setup } : {}),
        ...(control ? { control } : {}),
        ...(residual ? { residual } : {}),
        ...(this.on("flat") ? { flat: true } : {}),
        ...(this.on("position-only") ? { position_only: true } : {}),
        ...(this.on("keep-unproved") ? { keep_unproved: true } : {}),
      };
      this.reported("compensate-program", { file: program, machine }, body);
      const frame = await this.questions.program.ask(body, tr`compensating ${program}`);
      if (!fresh()) return;
      const { header } = frame;
      this.begin(header.shown, [
        deviationTable(header.document),
        header.made.files.length > 0 ? this.programPanel(header.made) : null,
      ]);
      this.figures.push(...alongPanel(this.pictures, header, frame.f64("along")));
      const changes = changesPanel(header);
      if (changes) this.pictures.append(changes);
      this.sections(header.shown, ["Deviation of the actual tool, before and after"]);
      this.end(header.diagnostics);
    } else if (of === "tables") {
      const body = {
        ...warm,
        target,
        ...(at ? { at } : {}),
        ...(this.on("no-kinematics") ? { no_kinematics: true } : {}),
      };
      this.reported("compensate-tables", { file: machine }, body);
      const reply = await this.questions.tables.ask(body, tr`tables of ${machine}`);
      if (!fresh()) return;
      this.begin({ ...reply.shown, verdict: tablesVerdict(reply) }, [
        leftTable(reply),
        filesPanel(this.app, reply.made, tr`Files for the control`, tr`Nothing is written before you download a file.`),
        reply.document.notes.length > 0
          ? h(
              "section",
              { class: "panel" },
              h("h2", {}, tr`At the control`),
              h(
                "ul",
                { class: "remarks" },
                reply.document.notes.map((note) => h("li", {}, trText(note))),
              ),
            )
          : null,
      ]);
      this.draw(cannotPanel(reply));
      this.sections(reply.shown, TABLES_DRAWN);
      this.end(reply.diagnostics);
    } else if (of === "values") {
      const body = { ...warm, axis, ...(at ? { at } : {}), ...(step ? { step } : {}) };
      const reply = await this.questions.values.ask(body, tr`values of ${axis}`);
      if (!fresh()) return;
      this.begin(reply.shown, [
        filesPanel(this.app, reply.made, tr`The values as a file`, tr`CSV with units in its headings.`),
      ]);
      this.draw(valuesPanel(reply));
      this.sections(reply.shown, []);
      this.end(reply.diagnostics);
    } else {
      const body = { study: study ?? "", ...(control ? { control } : {}) };
      this.reported("compensate-adapt", { file: study }, body);
      const reply = await this.questions.blank.ask(body, tr`adapting the path of ${study}`);
      if (!fresh()) return;
      const files =
        reply.made.files.length > 0
          ? filesPanel(this.app, reply.made, tr`The adapted path`, tr`Nothing is written before you download a file.`)
          : h(
              "section",
              { class: "panel" },
              h("p", { class: "unsound" }, tr`The adapted path must not be cut: no file.`),
            );
      this.begin(reply.shown, [files]);
      this.draw(wallPanel(reply));
      this.sections(reply.shown, []);
      this.end(reply.diagnostics);
    }
    this.app.say(of === "blank" ? (study ?? "") : of === "program" ? (program ?? "") : (machine ?? ""));
  }

  // ---- the answer ----

  private begin(shown: Shown, panels: (HTMLElement | null)[]): void {
    this.clear();
    fill(this.result, headPanel(shown), panels);
  }

  private draw({ panel, figures }: Drawn): void {
    this.pictures.append(panel);
    this.figures.push(...figures);
  }

  private sections(shown: Shown, left_out: readonly string[]): void {
    for (const section of shown.sections)
      if (!left_out.includes(section.title)) this.result.append(sectionPanel(section));
  }

  private end(diagnostics: Parameters<typeof remarksPanel>[0]): void {
    const remarks = remarksPanel(diagnostics);
    if (remarks) this.result.append(remarks);
    if (this.pictures.childElementCount === 0)
      this.pictures.append(h("p", { class: "empty" }, tr`The figures are in the tables on the right.`));
  }

  /** Where the compensated program goes: to this computer's downloads, or into the project, to be simulated. */
  private programPanel(made: Made): HTMLElement {
    const then = h("div", { class: "row" });
    const saved = (path: string): void =>
      fill(
        then,
        h("button", { class: "primary", dataTest: "simulate", onclick: () => this.simulate(path) }, tr`Simulate it`),
      );
    return h(
      "section",
      { class: "panel", dataTest: "program-file" },
      h("div", { class: "panel-head" }, h("h2", {}, tr`The compensated program`), downloadButton(this.app, made, 0)),
      saveForm(this.app, made, 0, saved),
      h(
        "p",
        { class: "muted note" },
        tr`A file that is there is replaced only if TrueAxis wrote it and it was not edited since. To simulate the program, save it first.`,
      ),
      then,
    );
  }

  private simulate(program: string): void {
    const { machine, control, program: was } = this.choice;
    const beside = `${(was ?? "").replace(/\.[^./]*$/, "")}.setup.toml`;
    const there = this.app.state.project?.files.some((file) => file.path === beside);
    this.app.go("simulate", { machine, program, setup: this.choice.setup ?? (there ? beside : null), control });
  }

  /** What can be done on this tab about a refusal. */
  private advice(error: unknown): HTMLElement | undefined {
    const code = (error as { code?: string }).code;
    const words: Partial<Record<string, string>> = {
      "no-workpiece-temperature": tr`State the temperatures above, or tick “machine alone, without a part” where no part is cut, such as for a check with a laser.`,
      "unknown-control": tr`Choose the control above.`,
      "already-compensated": tr`Choose the program as the postprocessor wrote it.`,
    };
    const text = code ? words[code] : undefined;
    return text ? h("p", { class: "note" }, text) : undefined;
  }
}

export type { Of };
export const compensate: Tab = {
  title: tr`Compensate`,
  mount: (host, app) => new CompensateTab(host, app),
};
