/** The pages of the other tabs as one file: made by the server, shown, saved, printed. */

import { language, tr, trText } from "../words/index.ts";
import type { ServeReport, ServeReportRequest } from "../../types.d.ts";
import type { App, Tab, TabHandle } from "../app.ts";
import type { FileKind } from "../api.ts";
import { download, fill, h } from "../dom.ts";
import { FileDialog } from "../filedialog.ts";
import { bytes, listed } from "../format.ts";
import { Reads } from "../reads.ts";
import { headingForm } from "./report/heading.ts";
import { STATED } from "./standards/documents.ts";

interface Verb {
  name: ServeReportRequest["verb"];
  title: string;
  /** What the verb reads. */
  file: readonly FileKind[];
  needs_machine: boolean;
}

const VERBS: readonly Verb[] = [
  { name: "predict", title: tr`Predict: the part before it is cut`, file: ["study"], needs_machine: false },
  {
    name: "simulate",
    title: tr`Simulate: what the machine does with a program`,
    file: ["program"],
    needs_machine: true,
  },
  { name: "plan", title: tr`Plan: what a campaign will show`, file: ["campaign"], needs_machine: false },
  { name: "identify", title: tr`Identify: the machine from readings`, file: ["campaign"], needs_machine: false },
  { name: "evaluate", title: tr`Evaluate: readings by ISO 230`, file: ["readings"], needs_machine: false },
  { name: "verify", title: tr`Verify: readings against the machine file`, file: ["comparison"], needs_machine: false },
  { name: "diff", title: tr`Verify: a calibration against an older one`, file: ["machine"], needs_machine: true },
  { name: "history", title: tr`Verify: the history of a folder`, file: [], needs_machine: false },
  {
    name: "certificate",
    title: tr`Verify: certificate of a compensation`,
    file: ["certificate"],
    needs_machine: false,
  },
  { name: "laser", title: tr`Verify: a laser before and after`, file: ["campaign"], needs_machine: false },
  { name: "part", title: tr`Verify: a measured part`, file: ["measured"], needs_machine: false },
  { name: "rtcp", title: tr`Identify: rotary centres in the control`, file: ["rtcp"], needs_machine: false },
  { name: "compensate-program", title: tr`Compensate: an NC program`, file: ["program"], needs_machine: true },
  { name: "compensate-tables", title: tr`Compensate: tables of a control`, file: ["machine"], needs_machine: false },
  {
    name: "compensate-adapt",
    title: tr`Compensate: a path on a measured blank`,
    file: ["blank"],
    needs_machine: false,
  },
];

type Made = ServeReport;

class ReportTab implements TabHandle {
  private readonly app: App;
  private readonly verb = h(
    "select",
    { ariaLabel: tr`Kind of report`, onchange: () => this.showFiles() },
    VERBS.map(({ name, title }) => h("option", { value: name }, title)),
  );
  private readonly file = h("select", { ariaLabel: tr`File`, dataTest: "report-file" });
  private readonly machine = h("select", { ariaLabel: tr`Machine file` });
  private readonly standard = h("select", { ariaLabel: tr`Standard` });
  private readonly target = h("select", { ariaLabel: tr`Control` });
  private readonly make = h("button", { class: "primary", onclick: () => void this.run() }, tr`Make the report`);
  private readonly save = h("button", { disabled: true, onclick: () => void this.saveAs("html") }, tr`Save HTML`);
  private readonly heading = h("select", {
    ariaLabel: tr`Heading to be filed and signed`,
    title: tr`A TOML file with [report]: number, date, customer, operator, logo, signatures`,
  });
  private readonly pdf = h(
    "button",
    { disabled: true, dataTest: "save-pdf", onclick: () => void this.saveAs("pdf") },
    tr`Save PDF`,
  );
  private readonly print = h(
    "button",
    {
      disabled: true,
      title: tr`The browser's print dialog also saves as PDF`,
      onclick: () => this.frame?.contentWindow?.print(),
    },
    tr`Print or PDF`,
  );
  private readonly note = h("span", { class: "muted", dataTest: "report-note" });
  private readonly page = h("div", { class: "report-page" });
  private frame: HTMLIFrameElement | null = null;
  private made: Made | null = null;
  private stop = new AbortController();
  private last = "";
  /** A report was asked for, not only chosen. */
  private is_asked = false;
  private readonly reads = new Reads(() => this.askAgain());
  /** What else readings are evaluated with, as the address states it, for one file and one standard. */
  private evaluated: { of: string; with: Record<string, string | null> } = { of: "", with: {} };
  /** What else a compensation was asked with, as the address states it (JSON), for one kind and its files. */
  private compensated = { of: "", with: "" };
  private readonly stating: FileDialog;

  constructor(host: HTMLElement, app: App) {
    this.app = app;
    this.stating = new FileDialog(app, "heading", tr`Heading of reports`, tr`Save and make the report`);
    fill(
      host,
      h(
        "div",
        { class: "report" },
        h(
          "div",
          { class: "report-head" },
          this.verb,
          this.file,
          this.machine,
          this.standard,
          this.target,
          this.heading,
          h("button", { dataTest: "state-heading", onclick: () => void this.stateHeading() }, tr`Heading …`),
          this.make,
          h("span", { class: "report-after" }, this.note, this.save, this.pdf, this.print),
        ),
        this.page,
      ),
    );
    this.showEmpty();
  }

  /** The standards and the controls of tables that the server knows, once. */
  private async loadChoices(): Promise<void> {
    if (this.standard.options.length > 0) return;
    const [standards, targets] = await Promise.all([
      this.app.api.ask("standards", {}),
      this.app.api.ask("compensate-targets", {}),
    ]);
    const option = ({ key, title }: { key: string; title: string }): HTMLElement =>
      h("option", { value: key }, trText(title));
    fill(this.standard, standards.map(option));
    fill(this.target, targets.map(option));
  }

  open(params: Readonly<Record<string, string>>): void {
    this.show(params).catch((error: unknown) => this.app.fail(error));
  }

  private async show(params: Readonly<Record<string, string>>): Promise<void> {
    await this.loadChoices();
    const verb = params.verb ?? this.verb.value;
    this.verb.value = VERBS.some((v) => v.name === verb) ? verb : "predict";
    this.showFiles(params.file, params.machine ?? this.app.state.machine ?? undefined);
    if (params.standard) this.standard.value = params.standard;
    const stated = STATED.map((key) => [key, params[key] ?? null]);
    this.evaluated = { of: this.readings(), with: Object.fromEntries(stated) };
    this.compensated = { of: this.chosen(), with: params.with ?? "" };
    const { target } = objectOf(params.with ?? "");
    if (typeof target === "string") this.target.value = target;
    // A link that names its file asks for the report; coming back to the tab does not ask again.
    const asked = this.asked();
    if (params.file && asked !== this.last) void this.run();
    this.last = asked;
  }

  /** What is chosen, of what the kind of report needs. */
  private asked(): string {
    return JSON.stringify([
      this.verb.value,
      this.file.value,
      this.machine.hidden ? null : this.machine.value,
      this.standard.hidden ? null : this.standard.value,
      this.decides(),
      this.options(),
    ]);
  }

  /** A report that is shown is that of its files as they are now; a server that was started again has none. */
  changed(path: string | null): void {
    if (this.reads.isChangedBy(path)) this.askAgain();
  }

  private askAgain(): void {
    const is_same = this.last === this.asked();
    this.last = "";
    if (!this.is_asked) return;
    if (is_same && this.app.state.tab === "report") void this.run();
    else this.take(null);
  }

  hide(): void {
    // What was being made is asked for again.
    if (this.made === null) this.last = "";
    this.stop.abort();
  }

  private showEmpty(): void {
    fill(
      this.page,
      h(
        "p",
        { class: "report-empty muted" },
        tr`Choose what to report on. The report is one HTML file with all figures in it: it opens offline, and the browser prints it or saves it as PDF. With a heading it can be filed and signed (docs/reference/report.md).`,
      ),
    );
  }

  private showFiles(file?: string, machine?: string): void {
    const verb = VERBS.find((v) => v.name === this.verb.value);
    if (!verb) return;
    // What the first page offers comes first.
    const offered = new Set(this.app.state.project?.examples.map((e) => e.path));
    const files = [...(this.app.state.project?.files ?? [])].sort(
      (a, b) => Number(offered.has(b.path)) - Number(offered.has(a.path)),
    );
    const of = (kinds: readonly FileKind[], also: string | undefined): HTMLElement[] =>
      [...new Set([...(also ? [also] : []), ...files.filter((f) => kinds.includes(f.kind)).map((f) => f.path)])].map(
        (path) => h("option", { value: path }, path),
      );
    fill(this.file, of(verb.file, file));
    if (file) this.file.value = file;
    fill(this.machine, of(["machine"], machine));
    if (machine) this.machine.value = machine;
    const chosen = this.heading.value;
    fill(this.heading, h("option", { value: "" }, tr`no heading`), of(["heading"], undefined));
    this.heading.value = chosen;
    this.heading.hidden = this.heading.options.length < 2;
    this.machine.hidden = !verb.needs_machine;
    this.standard.hidden = verb.name !== "evaluate";
    this.target.hidden = verb.name !== "compensate-tables";
    this.make.disabled = this.file.options.length === 0;
  }

  private async run(): Promise<void> {
    const verb = VERBS.find((v) => v.name === this.verb.value);
    if (!verb || !this.file.value) return;
    const body = {
      verb: verb.name,
      file: this.file.value,
      language: language(),
      ...(verb.needs_machine ? { machine: this.machine.value } : {}),
      ...(verb.name === "evaluate" ? { standard: this.standard.value, ...this.decides() } : {}),
      ...(this.isCompensation() ? { options: this.options() } : {}),
      ...(this.heading.value ? { heading: this.heading.value } : {}),
    };
    this.last = this.asked();
    this.is_asked = true;
    this.app.keep("report", {
      verb: body.verb,
      file: body.file,
      machine: body.machine ?? null,
      standard: body.standard ?? null,
      ...(this.evaluated.of === this.readings() ? this.evaluated.with : {}),
      with: this.isCompensation() ? JSON.stringify(this.options()) : null,
    });
    this.stop.abort();
    const stop = new AbortController();
    this.stop = stop;
    const progress = this.app.progress(tr`reporting on ${body.file}`);
    this.make.disabled = true;
    this.take(null);
    try {
      const options = { onProgress: progress.report, signal: stop.signal };
      this.take(await this.reads.of(this.app.api.ask("report", body, options)));
    } catch (error) {
      if (!stop.signal.aborted) this.app.fail(error);
    } finally {
      // A newer one is on its way.
      if (this.stop === stop) {
        progress.done();
        this.make.disabled = false;
      }
    }
  }

  private readings(): string {
    return `${this.file.value}\n${this.standard.value}`;
  }

  /** Tolerances and conditions of one test are not those of another. */
  private decides(): Partial<ServeReportRequest> {
    if (this.standard.hidden || this.evaluated.of !== this.readings()) return {};
    const { tolerances, simple, ...rest } = this.evaluated.with;
    const given = Object.fromEntries(Object.entries(rest).filter(([, value]) => value));
    return { ...given, ...(tolerances ? { tolerances: listed(tolerances), is_simple: simple === "1" } : {}) };
  }

  private chosen(): string {
    return `${this.verb.value}\n${this.file.value}\n${this.machine.value}`;
  }

  private isCompensation(): boolean {
    return this.verb.value.startsWith("compensate-");
  }

  /** Options of one program are not those of another; the control of tables is chosen here. */
  private options(): Record<string, unknown> {
    if (!this.isCompensation()) return {};
    const given = this.compensated.of === this.chosen() ? objectOf(this.compensated.with) : {};
    return this.target.hidden ? given : { ...given, target: this.target.value };
  }

  /** A heading is stated in a form; one that is there is edited as text. */
  private async stateHeading(): Promise<void> {
    const path = this.heading.value || "report-heading.toml";
    await this.stating.open({
      title: [tr`Heading of reports`],
      path,
      form: (text) => (text === null ? headingForm() : null),
      saved: (saved) => {
        this.showFiles(this.file.value, this.machine.value);
        this.heading.hidden = false;
        if (![...this.heading.options].some((option) => option.value === saved))
          this.heading.append(h("option", { value: saved }, saved));
        this.heading.value = saved;
        void this.run();
      },
    });
  }

  private take(made: Made | null): void {
    this.made = made;
    this.frame = null;
    this.save.disabled = this.pdf.disabled = this.print.disabled = true;
    this.note.textContent = "";
    this.showEmpty();
    if (!made) return;
    // The same origin, so that the browser can print what is in it; no scripts.
    this.frame = h("iframe", {
      class: "report-frame",
      title: made.name,
      sandbox: "allow-same-origin allow-modals",
      src: made.url.replace(/^\//, ""),
      onload: () => (this.print.disabled = false),
    });
    this.note.textContent = `${made.name}, ${bytes(made.bytes)}`;
    this.save.disabled = false;
    this.pdf.disabled = made.pdf === null;
    this.pdf.title = made.pdf === null ? tr`This build writes no PDF: print it, or take the Debian package` : "";
    const warning = made.diagnostics.map((d) => d.message).join("; ");
    if (warning) this.note.textContent += `: ${warning}`;
    fill(this.page, this.frame);
  }

  private async saveAs(form: "html" | "pdf"): Promise<void> {
    const { made } = this;
    const url = form === "pdf" ? made?.pdf : made?.url;
    if (!made || !url) return;
    const name = made.name.replace(/html$/, form);
    try {
      const response = await fetch(url.replace(/^\//, ""));
      if (!response.ok) throw new Error(tr`the server no longer has ${name}: make the report again`);
      const type = form === "pdf" ? "application/pdf" : "text/html";
      download(name, new Blob([await response.arrayBuffer()], { type }));
    } catch (error) {
      this.app.fail(error);
    }
  }
}

/** What an address states may be anything. */
function objectOf(text: string): Record<string, unknown> {
  try {
    const value: unknown = JSON.parse(text);
    return typeof value === "object" && value !== null ? { ...value } : {};
  } catch {
    return {};
  }
}

export const report: Tab = {
  title: tr`Report`,
  mount: (host, app) => new ReportTab(host, app),
};
