/** The Describe tab: holds the drafts of machine files together with what the server says of them. */

import { tr, trText } from "../../words/index.ts";
import { diagnosticList, split, type App, type TabHandle } from "../../app.ts";
import { latestOnly, Refusal, type Description, type Diagnostic, type PoseHeader } from "../../api.ts";
import type { Params } from "../../address.ts";
import { fill, h, perFrame } from "../../dom.ts";
import { chainPicture, type ChainSpec } from "../../figure/chain.ts";
import type { Figure } from "../../figure/figure.ts";
import type { Frame } from "../../frame.ts";
import { Exaggeration } from "../../scene/exaggeration.ts";
import { withModels } from "../../scene/models.ts";
import { MachineView } from "../../scene/view.ts";
import { Axes, keptPositions, positionsOf, positionsText } from "./axes.ts";
import { ConditionFields, temperatureText } from "./conditions.ts";
import { Draft } from "./draft.ts";
import { ErrorTable } from "./errors.ts";
import { FileText } from "./file.ts";
import { Head } from "./head.ts";
import { editKey } from "./keys.ts";
import { pages } from "./pages.ts";
import { PosePanels } from "./pose.ts";

export class DescribeTab implements TabHandle {
  private readonly app: App;
  private readonly view: MachineView;
  private readonly head = new Head({
    choose: (path) => this.app.go("describe", { machine: path }),
    undo: () => this.step("undo"),
    redo: () => this.step("redo"),
    save: () => void this.save(),
    saveAs: (path) => void this.saveAs(path),
    takeTheirs: () => void this.takeTheirs(),
  });
  private readonly chain = h("section", { class: "panel" });
  private readonly axes = new Axes({ moved: () => this.askPose(), hovered: (name) => this.view.highlight(name) });
  private readonly conditions = new ConditionFields(() => this.conditionsChanged());
  private readonly pose = new PosePanels();
  private readonly findings = h("section", { class: "panel" });
  private readonly errors = new ErrorTable(
    {
      commit: (error, text) => this.setError(error, text),
      goTo: (line) => this.goToLine(line),
      hovered: (body) => this.view.highlight(body),
      chosen: () => this.keepState(),
    },
    () => this.keepState(),
  );
  private readonly file = new FileText((text) => this.edit(text));
  private readonly pages = pages(
    [
      {
        name: "machine",
        title: tr`Machine and pose`,
        parts: [this.chain, this.axes.element, this.conditions.element, this.pose.tip, this.pose.budget, this.findings],
      },
      { name: "errors", title: tr`Errors`, parts: [this.errors.element] },
      { name: "file", title: tr`File`, parts: [this.file.element] },
    ],
    () => this.file.flush(),
    () => this.keepState(),
  );
  private readonly exaggeration: Exaggeration;
  /** A view of the address, for the machine that is on its way. */
  private wanted_view: string | null = null;
  /** Edits of every file that was open here: choosing another one loses none. */
  private readonly drafts = new Map<string, Draft>();
  private draft: Draft | null = null;
  private described: Description | null = null;
  /** The latest text that is a machine, for the poses. */
  private usable_text = "";
  /** The name that the machine last had. */
  private name = "";
  private scene_key = "";
  private links_key = "";
  private picture: Figure<ChainSpec> | null = null;
  /** Edits of errors one after the other: each needs the text that the last one left. */
  private edits: Promise<unknown> = Promise.resolve();
  private readonly describeLatest = latestOnly<Draft, Description>(
    (draft) => this.app.api.ask("describe", { machine: draft.path, text: draft.text }),
    (description) => void this.showDescription(description),
    (error) => this.app.fail(error),
  );
  private readonly poseLatest = latestOnly<{ machine: string }, Frame<PoseHeader>>(
    (body) => this.app.api.ask("pose", body),
    (frame, { machine }) => machine === this.draft?.path && this.showPose(frame),
    (error) => this.refusePose(error),
  );
  private readonly askPose = perFrame(() => this.sendPose());

  constructor(host: HTMLElement, app: App) {
    this.app = app;
    const { left, right } = split(host, "describe", 0.55);
    this.view = new MachineView(left);
    this.exaggeration = new Exaggeration(this.view, () => this.keepState());
    this.view.tools.onPick = (body) => this.pick(body);
    this.view.onView = (view) => this.app.keep("describe", { view: view === "iso" ? null : view });
    left.append(h("div", { class: "scene-bottom" }, this.exaggeration.element));
    fill(right, h("div", { class: "describe-panel" }, this.head.element, this.pages.element));
    addEventListener("keydown", (event) => this.key(event));
    addEventListener("beforeunload", (event) => {
      this.file.flush();
      if (this.dirtyPaths().size > 0) event.preventDefault();
    });
  }

  // ---- which file ----

  open(params: Readonly<Record<string, string>>): void {
    const wanted = params.machine ?? this.app.state.machine ?? this.machineFiles()[0] ?? null;
    if (!wanted) {
      fill(
        this.findings,
        h(
          "p",
          {},
          tr`There is no machine file in this folder. Open an example on the first page, or put a machine.toml into the folder.`,
        ),
      );
      return;
    }
    this.exaggeration.take(params);
    if (params.page) this.pages.go(params.page);
    this.errors.take(params, wanted !== this.draft?.path);
    if (wanted !== this.draft?.path) void this.load(wanted, params);
    else {
      if (params.view) this.view.setView(params.view);
      if (params.at && this.described) this.moveTo(this.described, params.at);
    }
  }

  /** A body that was pressed in the picture: its errors. */
  private pick(body: string): void {
    this.view.highlight(body);
    if (!this.errors.showBody(body)) {
      this.app.say(
        body === "b" ? tr`The bed has no errors: the others are relative to it.` : tr`${body} has no errors.`,
      );
      return;
    }
    this.pages.go("errors");
    this.keepState();
  }

  /** What is shown, in the address. */
  private keepState(): void {
    const page = this.pages.now();
    this.app.keep("describe", {
      machine: this.draft?.path,
      page: page === "machine" ? null : page,
      ...this.errors.state,
      ...this.exaggeration.state,
      ...this.conditions.state,
    });
  }

  /** A file was saved elsewhere, or news was missed: is ours still as we know it? */
  changed(path: string | null): void {
    for (const draft of this.drafts.values()) if (path === null || path === draft.path) void this.compare(draft);
    // It may be a table or a model that the machine file names.
    if (this.draft && (path === null || !this.drafts.has(path))) this.refresh();
  }

  private moveTo({ links }: Description, at: string): void {
    this.axes.show(links, keptPositions(links, positionsOf(at)));
    this.askPose();
  }

  private machineFiles(): string[] {
    const paths = (this.app.state.project?.files ?? []).filter((f) => f.kind === "machine").map((f) => f.path);
    // Test data of the program last: some of them are wrong on purpose.
    const isTest = (path: string): boolean => /(^|\/)tests?\//.test(path);
    return [...paths.filter((path) => !isTest(path)), ...paths.filter(isTest)];
  }

  private dirtyPaths(): Set<string> {
    return new Set([...this.drafts.values()].filter((d) => d.dirty).map((d) => d.path));
  }

  private async load(path: string, params: Params): Promise<void> {
    this.file.flush();
    try {
      let draft = this.drafts.get(path);
      if (!draft) {
        this.app.say(tr`reading ${path}`);
        const { text, version } = await this.app.api.ask("open", { path });
        draft = new Draft(path, text, version);
        this.drafts.set(path, draft);
      }
      this.app.set({ machine: path });
      this.app.say(path);
      this.draft = draft;
      this.described = null;
      this.usable_text = this.name = "";
      this.scene_key = this.links_key = "";
      this.conditions.reset();
      this.conditions.take(params);
      this.axes.at = positionsOf(params.at ?? "");
      this.wanted_view = params.view ?? null;
      this.refresh();
    } catch (error) {
      this.app.fail(error);
    }
  }

  private async compare(draft: Draft): Promise<void> {
    try {
      const { text, version } = await this.app.api.ask("open", { path: draft.path });
      // Saved by this window meanwhile, or not changed at all.
      if (version === draft.version) return;
      if (draft.dirty) {
        if (draft === this.draft) this.head.showConflict();
        return;
      }
      draft.adopt(text, version);
      if (draft === this.draft) this.refresh();
    } catch (error) {
      this.app.fail(error);
    }
  }

  // ---- editing ----

  private refresh(): void {
    const draft = this.draft;
    if (!draft) return;
    this.file.show(draft.text);
    this.showHead();
    this.describeLatest(draft);
  }

  private edit(text: string): void {
    if (this.draft?.edit(text)) this.refresh();
  }

  private step(which: "undo" | "redo"): void {
    this.file.flush();
    if (this.draft?.[which]()) this.refresh();
  }

  private setError(error: string, value: string): Promise<void> {
    const run = async (): Promise<void> => {
      const draft = this.draft;
      if (!draft) return;
      const { text } = await this.app.api.ask("set-error", { machine: draft.path, text: draft.text, error, value });
      if (draft.edit(text) && draft === this.draft) this.refresh();
    };
    const done = this.edits.then(run);
    this.edits = done.catch(() => undefined);
    return done;
  }

  private key(event: KeyboardEvent): void {
    const wanted = this.app.state.tab === "describe" ? editKey(event) : null;
    if (!wanted) return;
    event.preventDefault();
    if (wanted === "save") void this.save();
    else this.step(wanted);
  }

  // ---- saving ----

  private async save(): Promise<void> {
    // A field that still has the focus hands over its text first.
    (document.activeElement as HTMLElement | null)?.blur();
    this.file.flush();
    await this.edits;
    const draft = this.draft;
    if (!draft || !this.accepted() || !draft.dirty) return;
    try {
      await this.write(draft, draft.path, draft.version);
      this.head.closeBanner();
    } catch (error) {
      if (Refusal.from(error).code === "conflict") this.head.showConflict();
      else this.app.fail(error);
    }
  }

  private async saveAs(path: string): Promise<void> {
    this.file.flush();
    await this.edits;
    const draft = this.draft;
    if (!draft || !this.accepted()) return;
    try {
      const copy = draft.renamed(path, "");
      await this.write(copy, path, null);
      this.drafts.delete(draft.path);
      this.drafts.set(path, copy);
      this.draft = copy;
      await this.app.loadProject();
      this.app.set({ machine: path });
      this.refresh();
      this.app.go("describe", { machine: path });
    } catch (error) {
      const refusal = Refusal.from(error);
      this.head.askName(
        refusal.code === "conflict"
          ? tr`${path} is there already; choose another name`
          : `${trText(refusal.message)}. ${trText(refusal.hint)}`,
      );
    }
  }

  /** What stands red in a field is not in the text: saving without it would surprise. */
  private accepted(): boolean {
    const [first] = this.errors.invalid;
    if (first === undefined) return true;
    this.app.fail(
      new Refusal(
        "not-accepted",
        tr`${first} holds a value that cannot be saved`,
        tr`Correct it in the table of errors, or press Escape in its field; nothing has been saved.`,
      ),
    );
    return false;
  }

  private async write(draft: Draft, path: string, version: string | null): Promise<void> {
    const { text } = draft;
    const saved = await this.app.api.ask("save", { path, text, version, window: this.app.api.window });
    draft.wasSaved(text, saved.version);
    this.showHead();
    this.app.say(tr`${path} is saved`);
  }

  private async takeTheirs(): Promise<void> {
    const draft = this.draft;
    if (!draft) return;
    try {
      const { text, version } = await this.app.api.ask("open", { path: draft.path });
      draft.adopt(text, version);
      this.head.closeBanner();
      this.refresh();
    } catch (error) {
      this.app.fail(error);
    }
  }

  // ---- showing ----

  private showHead(): void {
    const draft = this.draft;
    if (!draft) return;
    const check = this.described?.check;
    this.name = check?.name ?? this.name;
    this.head.show({
      name: this.name || draft.path,
      draft,
      usable: check?.usable ?? true,
      files: this.machineFiles(),
      dirty: this.dirtyPaths(),
    });
    this.app.unsaved("describe", [...this.dirtyPaths()]);
  }

  private async showDescription(description: Description): Promise<void> {
    const draft = this.draft;
    // The text went on meanwhile: its own answer follows.
    if (!draft || description.text !== draft.text) return;
    const first = this.described === null;
    this.described = description;
    this.showHead();
    const { check } = description;
    this.file.showProblems(check.diagnostics);
    this.showFindings(description, []);
    if (!check.usable) {
      if (first) this.showUnusable(draft.path);
      return;
    }
    this.usable_text = draft.text;
    this.showLinks(description);
    this.errors.show(description.errors, description.links);
    if (description.tool) this.conditions.show(description.tool, description.tools, description.sensors);
    await this.showScene();
    this.askPose();
  }

  /** A file that never was a machine here: there is no picture of it. */
  private showUnusable(path: string): void {
    this.pages.go("file");
    const hint = tr`The page “File” shows what is wrong, line by line.`;
    this.pose.refuse(new Refusal("unusable", tr`${path} cannot be used yet`, hint));
    this.head.showDeviation(null);
  }

  private showLinks({ links }: Description): void {
    const key = JSON.stringify(links);
    if (key === this.links_key) return;
    this.links_key = key;
    this.picture?.dispose();
    this.picture = chainPicture(this.chain, {
      title: tr`From the workpiece to the tool`,
      links,
      onhover: (name) => this.view.highlight(name),
    });
    this.axes.show(links, keptPositions(links, this.axes.at));
  }

  /** Builds the picture again only if a body is another one; the errors only move the ghost. */
  private async showScene(): Promise<void> {
    const description = this.described;
    const draft = this.draft;
    if (!description || !draft) return;
    const length = this.conditions.now.tool_length_mm;
    const tool =
      length === null || !description.tool
        ? description.tool
        : { ...description.tool, length_mm: length, tip_mm: null };
    const { links, models } = description;
    const key = JSON.stringify([draft.path, links, models, tool]);
    if (key === this.scene_key) return;
    const same_file = this.scene_key.startsWith(`["${draft.path}"`);
    this.scene_key = key;
    try {
      const { machine, diagnostics } = await withModels(
        this.app.api,
        { machine: draft.path, text: draft.text },
        { links, models, tool },
      );
      if (key !== this.scene_key) return;
      this.view.setMachine(machine, same_file);
      if (this.wanted_view) this.view.setView(this.wanted_view);
      this.wanted_view = null;
      this.showFindings(description, diagnostics);
    } catch (error) {
      this.app.fail(error);
    }
  }

  private showFindings({ check }: Description, of_models: readonly Diagnostic[]): void {
    const diagnostics = [...check.diagnostics, ...of_models];
    // Of a file that is no machine nothing more is said.
    const lacks = check.lacks ?? [];
    fill(
      this.findings,
      h("h2", {}, tr`What the check says`),
      diagnostics.length > 0 ? diagnosticList(diagnostics) : h("p", {}, tr`No errors or warnings.`),
      lacks.length > 0
        ? [
            h("h3", { class: "lacks-title" }, tr`Not stated in the file`),
            h(
              "ul",
              { class: "lacks" },
              lacks.map((text) => h("li", {}, trText(text))),
            ),
          ]
        : null,
      check.source
        ? [h("h3", { class: "lacks-title" }, tr`Source`), h("p", { class: "muted source", dataOwn: "" }, check.source)]
        : null,
    );
  }

  private goToLine(line: number): void {
    this.pages.go("file");
    this.file.goTo(line);
  }

  // ---- the pose ----

  private conditionsChanged(): void {
    void this.showScene().then(() => this.askPose());
  }

  private sendPose(): void {
    const { draft, conditions } = this;
    if (!draft || !this.described || this.usable_text === "") return;
    this.app.keep("describe", { at: positionsText(this.axes.at, this.described.links), ...conditions.state });
    this.poseLatest({
      machine: draft.path,
      text: this.usable_text,
      at: { ...this.axes.at },
      tool_length_mm: conditions.now.tool_length_mm ?? undefined,
      temperature: temperatureText(conditions.now),
    } as { machine: string });
  }

  private showPose(frame: Frame<PoseHeader>): void {
    const { pose, bodies, diagnostics } = frame.header;
    // Of a chain that is another one by now; its own pose follows.
    if (bodies.length !== this.described?.links.length) return;
    this.view.setPoses(frame.f64("nominal"), frame.f64("actual"));
    this.pose.show(pose, diagnostics, temperatureText(this.conditions.now) !== undefined);
    this.errors.showPose(pose, this.axes.at);
    this.head.showDeviation(pose.deviation.tip_um);
  }

  private refusePose(error: unknown): void {
    const refusal = Refusal.from(error);
    if (refusal.code === "connection") {
      this.app.fail(error);
      return;
    }
    this.pose.refuse(refusal);
    this.errors.showPose(null, this.axes.at);
    this.head.showDeviation(null);
  }
}
