/** Is it as promised: readings against the machine file, calibrations, certificates, measured parts. */

import { tr } from "../words/index.ts";
import { split, type App, type Tab, type TabHandle } from "../app.ts";
import type { FileKind, Request } from "../api.ts";
import { fill, h, type Child } from "../dom.ts";
import type { Figure } from "../figure/index.ts";
import { fileSelect, isAbort, Question, reportButton, showRefusal } from "./measure/ask.ts";
import { headPanel, remarksPanel, sectionPanel } from "./measure/shown.ts";
import { pictures, type VerifyReply } from "./verify/pictures.ts";

type What = Request<"verify">["what"];

interface Subject {
  title: string;
  /** The question. */
  words: string;
  /** What the file is called. */
  label: string;
  kind: FileKind;
  /** What to do where none is chosen. */
  hint: string;
}

const SUBJECTS: Record<What, Subject> = {
  readings: {
    title: tr`Readings`,
    words: tr`Do the readings agree with the machine file?`,
    label: tr`Comparison`,
    kind: "comparison",
    hint: tr`Choose a comparison: a TOML file with [compare] names the campaign, its readings and the decision rule.`,
  },
  diff: {
    title: tr`Calibrations`,
    words: tr`Two calibrations: which errors have changed significantly?`,
    label: tr`Older machine file`,
    kind: "machine",
    hint: tr`Choose two machine files of one machine, the older first.`,
  },
  history: {
    title: tr`History`,
    words: tr`How do the figures change over the calibrations, and when is a limit reached?`,
    label: tr`Folder`,
    kind: "machine",
    hint: tr`Choose a folder with the machine files of one machine, one for each calibration, each with its date.`,
  },
  certificate: {
    title: tr`Certificate`,
    words: tr`What does a compensation leave at poses that were not used for it?`,
    label: tr`Study`,
    kind: "certificate",
    hint: tr`Choose the study of a certificate: it names the compensation, the determination and the readings that validate it.`,
  },
  laser: {
    title: tr`Laser`,
    words: tr`What does a laser read before and after a compensation?`,
    label: tr`Campaign`,
    kind: "campaign",
    hint: tr`Choose a campaign of lasers, such as examples/07_verify/laser-before-after-x.toml.`,
  },
  part: {
    title: tr`Part`,
    words: tr`Is a measured part within its tolerances, and was the prediction right?`,
    label: tr`Measured part`,
    kind: "measured",
    hint: tr`Choose a file with [measured] or [cmm]: the test piece, its points or figures, the decision rule.`,
  },
};

/** Is typed the same in every language. */
const LIMITS = "EC0X=40 urad; EXX=12 um";

const WHATS = Object.keys(SUBJECTS) as What[];

interface Choice {
  what: What;
  file: string | null;
  /** The newer machine file of two. */
  now: string | null;
  limits: string;
}

class VerifyTab implements TabHandle {
  private readonly app: App;
  private readonly head = h("section", { class: "panel form" });
  private readonly result = h("div", { class: "result" });
  private readonly pictures = h("div", { class: "scroll pictures" });
  private readonly question: Question<"verify">;
  private choice: Choice | null = null;
  private figures: Figure<never>[] = [];
  private asked = "";

  constructor(host: HTMLElement, app: App) {
    this.app = app;
    this.question = new Question(app, "verify", () => this.askAgain());
    const { left, right } = split(host, "verify", 0.5);
    left.append(this.pictures);
    fill(right, this.head, this.result);
  }

  open(params: Readonly<Record<string, string>>): void {
    const { machine, ...own } = params;
    // The tab's own link names the machine only: what was open stays.
    if (this.choice === null || Object.keys(own).length > 0) this.choice = this.read(own, machine);
    void this.run();
  }

  hide(): void {
    this.question.stop();
  }

  changed(path: string | null): void {
    // A history has what its folder has: a new file counts.
    const is_new = this.choice?.what === "history" && /\.(toml|json)$/.test(path ?? "");
    if (this.question.isChangedBy(path) || is_new) this.askAgain();
  }

  private askAgain(): void {
    this.asked = "";
    if (this.app.state.tab === "verify") void this.run();
  }

  private read(params: Readonly<Record<string, string>>, machine: string | undefined): Choice {
    const files = this.app.state.project?.files ?? [];
    const kind = files.find((file) => file.path === params.file)?.kind;
    // A link of the first page names a file only: its kind tells what is asked.
    const by_kind = WHATS.find((what) => SUBJECTS[what].kind === kind && what !== "history");
    const what = WHATS.find((one) => one === params.what) ?? by_kind ?? "readings";
    if (!params.what && what === "diff") return { what, file: machine ?? null, now: params.file ?? null, limits: "" };
    const example = this.app.state.project?.examples.find((one) => one.tab === "verify");
    const none_named = !params.what && !params.file;
    return {
      what,
      file: params.file ?? (none_named ? (example?.path ?? null) : null),
      now: params.new ?? null,
      limits: params.limits ?? "",
    };
  }

  private go(change: Partial<Choice>): void {
    const next = { ...(this.choice ?? { what: "readings", file: null, now: null, limits: "" }), ...change };
    this.app.go("verify", { what: next.what, file: next.file, new: next.now, limits: next.limits });
  }

  // ---- the form ----

  private showForm({ what, file, now, limits }: Choice): void {
    const subject = SUBJECTS[what];
    const kinds = h(
      "div",
      { class: "group", role: "group", ariaLabel: tr`What is verified` },
      WHATS.map((key) =>
        h(
          "button",
          {
            ariaPressed: String(key === what),
            dataWhat: key,
            title: SUBJECTS[key].words,
            onclick: () => this.go({ what: key, file: key === what ? file : this.first(key), now: null, limits: "" }),
          },
          SUBJECTS[key].title,
        ),
      ),
    );
    const rows: Child[] = [h("div", { class: "row" }, kinds)];
    if (what === "history") rows.push(this.folderRow(file, limits));
    else {
      rows.push(this.fileRow(subject.label, "file", subject.kind, file, (path) => this.go({ file: path })));
      if (what === "diff")
        rows.push(this.fileRow(tr`Newer machine file`, "new", "machine", now, (path) => this.go({ now: path })));
    }
    const report =
      what === "diff"
        ? reportButton(this.app, { verb: "diff", machine: file, file: now })
        : reportButton(this.app, { verb: what === "readings" ? "verify" : what, file });
    if (report) rows.push(h("div", { class: "row" }, report));
    fill(this.head, h("div", { class: "compensate-form" }, rows));
  }

  /** The first file of a kind, so that something is there to look at. */
  private first(what: What): string | null {
    if (what === "diff" || what === "laser") return null;
    if (what === "history") return this.folders()[0] ?? null;
    return this.app.state.project?.files.find((one) => one.kind === SUBJECTS[what].kind)?.path ?? null;
  }

  private fileRow(
    label: string,
    test: string,
    kind: FileKind,
    now: string | null,
    choose: (path: string) => void,
  ): HTMLElement {
    const element = fileSelect(this.app, label, "none", (one) => one.kind === kind, now, choose);
    element.dataset.test = test;
    return h("div", { class: "row" }, h("label", { class: "field grow" }, h("span", {}, label), element));
  }

  /** Folders with several machine files. */
  private folders(): string[] {
    const counts = new Map<string, number>();
    for (const { path, kind } of this.app.state.project?.files ?? []) {
      const folder = path.replace(/\/?[^/]*$/, "");
      if (kind === "machine" && folder) counts.set(folder, (counts.get(folder) ?? 0) + 1);
    }
    const several = [...counts].filter(([, count]) => count > 1).map(([folder]) => folder);
    // Folders that are called so come first, test data of the program last.
    const rank = (folder: string): number =>
      /histor|calibration/i.test(folder) ? 0 : /(^|\/)tests?(\/|$)/.test(folder) ? 2 : 1;
    return several.sort((a, b) => rank(a) - rank(b) || a.localeCompare(b));
  }

  private folderRow(now: string | null, limits: string): HTMLElement {
    const folders = [...new Set([...(now ? [now] : []), ...this.folders()])];
    const select = h(
      "select",
      {
        ariaLabel: tr`Folder`,
        class: "file-select",
        dataTest: "file",
        onchange: () => this.go({ file: select.value }),
      },
      now ? null : h("option", { value: "", disabled: true }, tr`Folder …`),
      folders.map((folder) => h("option", { value: folder }, folder)),
    );
    select.value = now ?? "";
    const limit = h("input", {
      type: "text",
      class: "short",
      value: limits,
      placeholder: LIMITS,
      ariaLabel: tr`Limits of figures, separated by semicolons`,
      dataTest: "limits",
      onchange: () => this.go({ limits: limit.value.trim() }),
    });
    return h(
      "div",
      { class: "row" },
      h("label", { class: "field grow" }, h("span", {}, tr`Folder`), select),
      h("label", { class: "field" }, h("span", {}, tr`Limits`), limit),
    );
  }

  // ---- asking ----

  private clear(): void {
    for (const one of this.figures) one.dispose();
    this.figures = [];
    this.pictures.replaceChildren();
    this.result.replaceChildren();
  }

  private say(words: string): void {
    this.clear();
    fill(this.result, h("section", { class: "panel" }, h("p", {}, words)));
  }

  private async run(): Promise<void> {
    const { choice } = this;
    if (!choice) return;
    this.showForm(choice);
    const { what, file, now, limits } = choice;
    if (!file || (what === "diff" && !now)) {
      this.question.stop();
      this.asked = "";
      this.say(SUBJECTS[what].hint);
      return;
    }
    const body = {
      what,
      file,
      ...(now ? { new: now } : {}),
      ...(limits
        ? {
            limits: limits
              .split(";")
              .map((one) => one.trim())
              .filter(Boolean),
          }
        : {}),
    };
    const asked = JSON.stringify(body);
    // Coming back to the tab shows what is there.
    if (asked === this.asked) return;
    this.asked = asked;
    this.say(tr`Comparing …`);
    try {
      const reply = await this.question.ask(body, tr`verifying ${file}`);
      if (this.asked === asked) this.show(reply);
    } catch (error) {
      if (this.asked !== asked) return;
      this.asked = "";
      if (isAbort(error)) return;
      this.clear();
      showRefusal(this.result, error);
    }
  }

  private show(reply: VerifyReply): void {
    this.clear();
    fill(this.result, headPanel(reply.shown), reply.shown.sections.map(sectionPanel), remarksPanel(reply.diagnostics));
    this.figures = pictures(this.pictures, reply.document);
    if (this.figures.length === 0)
      this.pictures.append(h("p", { class: "empty" }, tr`The figures are in the tables on the right.`));
    this.app.say(this.choice?.file ?? "");
  }
}

export const verify: Tab = {
  title: tr`Verify`,
  mount: (host, app) => new VerifyTab(host, app),
};
