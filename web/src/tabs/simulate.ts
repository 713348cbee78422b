/** What the machine does with a program: play it, see where it is slow, off, or runs into something. */

import { tr, trText } from "../words/index.ts";
import { split, type App, type Tab, type TabHandle } from "../app.ts";
import { Refusal, type Diagnostic, type MachineDescription } from "../api.ts";
import { numberIn, short, type Params } from "../address.ts";
import { fill, h } from "../dom.ts";
import { keepFile, keptFile } from "../files.ts";
import { tabKey } from "../keys.ts";
import { Reads } from "../reads.ts";
import { Exaggeration } from "../scene/exaggeration.ts";
import { withModels } from "../scene/models.ts";
import { MachineView } from "../scene/view.ts";
import { bodyOf, Simulation, type Job, type Moment } from "./simulate/answers.ts";
import { Choices, dropTarget, NOTHING_CHOSEN, type Choice, type Dropped } from "./simulate/choices.ts";
import { Curves } from "./simulate/curves.ts";
import { Find } from "./simulate/find.ts";
import { ToolPath } from "./simulate/path.ts";
import { Player } from "./simulate/player.ts";
import { Readout } from "./simulate/readout.ts";
import { SetUpDialog } from "./simulate/setup.ts";
import { SourceList, type LineNote } from "./simulate/source.ts";
import { StockInTime } from "./simulate/stock.ts";
import { Summary } from "./simulate/summary.ts";
import { Timeline } from "./simulate/timeline.ts";
import { toolNote, toolOf } from "./simulate/tool.ts";
import { Transport } from "./simulate/transport.ts";
import { WhyHere } from "./simulate/whyhere.ts";
import { takeDropped } from "./start.ts";

class SimulateTab implements TabHandle {
  private readonly app: App;
  private readonly host: HTMLElement;
  private readonly view: MachineView;
  private readonly choices: Choices;
  private readonly setup: SetUpDialog;
  private readonly summary = new Summary(
    (time_s) => this.player.seek(time_s),
    () => this.stateSetUp(),
  );
  private readonly busy = h("section", { class: "panel simulate-busy", hidden: true });
  private readonly source_head = h("div", { class: "panel-head source-head" });
  private readonly source = new SourceList((line) => this.toLine(line));
  private readonly find = new Find({
    find: (text, step) => this.source.find(text, step),
    go: (line) => this.toLine(line),
    closed: () => this.source.focus(),
  });
  private readonly readout = new Readout(() => this.whyHere());
  private readonly why: WhyHere;
  private readonly player: Player;
  private readonly transport: Transport;
  private readonly timeline: Timeline;
  private readonly path: ToolPath;
  private readonly exaggeration: Exaggeration;
  private readonly stock: StockInTime;
  /** What the address says of the simulation that is on its way. */
  private wanted: Params = {};
  private readonly curves: Curves;
  private choice: Choice = NOTHING_CHOSEN;
  private dropped: Dropped | null = null;
  /** Programs that were dropped in this window, by name: going back in the browser finds them. */
  private readonly kept = new Map<string, Dropped>();
  private drawn: MachineDescription | null = null;
  /** How many errors the machine file states. */
  private stated_errors = 0;
  private simulation: Simulation | null = null;
  private stop: AbortController | null = null;
  private readonly reads = new Reads(() => this.askAgain());
  /** A file has changed while another tab was shown. */
  private is_stale = false;
  private moment: Moment | null = null;
  /** Index of the program whose source is shown. */
  private shown_program = 0;
  private readonly texts = new Map<number, { name: string; text: string }>();
  /** Which tool is drawn, and where its tip is in the holder. */
  private drawn_tool = "";
  private in_sight = false;

  constructor(host: HTMLElement, app: App) {
    this.app = app;
    this.host = host;
    const top = h("div", { class: "simulate-top" });
    const { left, right } = split(top, "simulate", 0.56);
    this.view = new MachineView(left);
    this.player = new Player({
      show: (t) => this.showTime(t),
      step: (t, step) => this.step(t, step),
      failed: (e) => this.failed(e),
      changed: (on) => this.transport.setPlaying(on),
    });
    this.transport = new Transport(this.player);
    this.timeline = new Timeline((t) => this.player.seek(t));
    this.path = new ToolPath(
      this.view,
      (e) => this.failed(e),
      () => this.keepState(),
    );
    this.exaggeration = new Exaggeration(this.view, () => this.keepState());
    this.stock = new StockInTime(
      this.view,
      (e) => this.failed(e),
      () => this.keepState(),
    );
    this.view.onView = (view) => this.app.keep("simulate", { view: view === "iso" ? null : view });
    this.curves = new Curves({
      seek: (t) => this.player.seek(t),
      zoomed: (window_s) => this.zoomed(window_s),
      chosen: () => this.keepState(),
      failed: (e) => this.failed(e),
    });
    this.choices = new Choices(
      app,
      (choice, dropped) => this.go(choice, dropped),
      () => this.stateSetUp(),
    );
    this.why = new WhyHere(app);
    this.setup = new SetUpDialog(app, (path) => this.setUpSaved(path));
    left.append(h("div", { class: "scene-bottom" }, this.stock.control, this.path.control, this.exaggeration.element));
    right.classList.add("simulate-side");
    fill(
      right,
      this.choices.element,
      this.busy,
      this.summary.element,
      h(
        "section",
        { class: "panel simulate-source", ariaLabel: tr`Source` },
        this.source_head,
        this.find.element,
        this.source.element,
      ),
      this.readout.element,
      this.why.element,
    );
    fill(
      host,
      h(
        "div",
        { class: "simulate" },
        top,
        h("div", { class: "simulate-time" }, this.transport.element, this.timeline.element),
        this.curves.element,
      ),
      this.setup.element,
    );
    dropTarget(host, (file) => void this.choices.take(file));
    let known = app.state.project;
    app.subscribe(({ project }) => {
      if (project === known) return;
      known = project;
      // Files that are new or gone.
      if (this.in_sight) this.choices.show(this.choice, this.dropped);
    });
    document.addEventListener("keydown", (event) => {
      if (this.in_sight && this.simulation && (this.transport.key(event) || this.key(event))) event.preventDefault();
    });
    document.addEventListener("visibilitychange", () => {
      if (document.hidden) this.player.pause();
    });
  }

  // ---- what to simulate ----

  open(params: Params): void {
    this.in_sight = true;
    void this.openWith(params).catch((error) => this.app.fail(error));
  }

  private async openWith(params: Params): Promise<void> {
    const { folder = "" } = this.app.state.project ?? {};
    if (window.trueaxisScene) window.trueaxisScene.moment = () => this.moment;
    const first = this.app.state.project?.files.find((f) => f.kind === "machine")?.path ?? null;
    const machine = params.machine ?? this.app.state.machine ?? first;
    // The tab's own link names the machine only: what was open goes on, on that machine.
    const goes_on = !params.program && !params.dropped;
    const fresh = takeDropped();
    if (fresh) this.keep(fresh);
    if (params.dropped && !this.kept.has(params.dropped)) {
      const file = await keptFile(folder, params.dropped);
      if (file) this.kept.set(file.name, file);
    }
    const dropped = goes_on ? this.dropped : (this.kept.get(params.dropped ?? "") ?? null);
    const choice: Choice = goes_on
      ? { ...this.choice, machine }
      : {
          machine,
          program: params.program ?? null,
          setup: params.setup ?? null,
          control: params.control ?? null,
          optional: params.optional?.toLowerCase() === "off" ? "off" : null,
        };
    if (!this.is_stale && dropped === this.dropped && JSON.stringify(choice) === JSON.stringify(this.choice)) {
      if (this.simulation) this.takeState(params);
      else this.wanted = params;
      return;
    }
    this.wanted = params;
    this.choice = choice;
    this.dropped = dropped;
    this.choices.show(choice, dropped);
    // The machine that was open: a copied link names it, too.
    this.app.keep("simulate", { machine });
    if (params.dropped && !dropped)
      this.app.fail(
        new Refusal(
          "dropped-file",
          tr`${params.dropped} is not kept by this browser any more`,
          tr`Drop it here again.`,
        ),
      );
    void this.run();
  }

  hide(): void {
    this.in_sight = false;
    this.player.pause();
  }

  changed(path: string | null): void {
    if (this.reads.isChangedBy(path)) this.askAgain();
  }

  private askAgain(): void {
    this.is_stale = !this.in_sight;
    if (this.in_sight) void this.run();
  }

  private go(choice: Choice, dropped: Dropped | null): void {
    if (dropped) this.keep(dropped);
    this.app.go("simulate", {
      machine: choice.machine,
      program: choice.program,
      dropped: dropped?.name,
      setup: choice.setup,
      control: choice.control,
      optional: choice.optional,
    });
  }

  /** The last few only: they may be large. */
  private keep(dropped: Dropped): void {
    this.kept.delete(dropped.name);
    this.kept.set(dropped.name, dropped);
    void keepFile(this.app.state.project?.folder ?? "", dropped);
    const [oldest] = this.kept.keys();
    if (this.kept.size > 4 && oldest) this.kept.delete(oldest);
  }

  private job(): Job | null {
    const { machine, program, setup, control, optional } = this.choice;
    const what = this.dropped ?? program;
    if (!machine || !what) return null;
    return {
      machine,
      program: what,
      ...(setup ? { setup } : {}),
      ...(control ? { control } : {}),
      ...(optional === "off" ? { optional_blocks: false } : {}),
    };
  }

  // ---- the set-up ----

  private stateSetUp(): void {
    const { program, setup, control } = this.choice;
    const dropped = this.dropped;
    if (!program || dropped) {
      const message = dropped
        ? tr`${dropped.name} is in no folder, so no set-up can be saved with it`
        : tr`no program is chosen`;
      this.app.fail(new Refusal("set-up", message, tr`Put the program into the project folder and choose it there.`));
      return;
    }
    const header = this.simulation?.header;
    const used = header?.document.tools.map((tool) => tool.tool).filter((number) => number > 0) ?? [];
    const axes = header?.axes ?? this.drawn?.links.flatMap(axisOf) ?? [];
    void this.setup.open({ program, setup, control, axes, tools: used });
  }

  private setUpSaved(path: string): void {
    this.app.say(tr`${path} was saved`);
    this.choices.show(this.choice, this.dropped);
    void this.run();
  }

  // ---- the simulation ----

  private async run(keep_going = false): Promise<void> {
    this.stop?.abort();
    const stop = new AbortController();
    this.stop = stop;
    this.is_stale = false;
    const job = this.job();
    this.clear();
    try {
      await this.reads.of(this.showMachine(stop.signal));
      if (!job) {
        fill(
          this.busy,
          h(
            "p",
            {},
            this.choice.machine
              ? tr`Choose a program of the folder, or drop one here.`
              : tr`There is no machine file in this folder: put a machine.toml into it, or open an example on the first page.`,
          ),
        );
        this.busy.hidden = false;
        return;
      }
      const simulation = await this.reads.of(this.simulate({ ...job, keep_going }, stop));
      if (stop.signal.aborted) return;
      await this.take(simulation);
    } catch (error) {
      if (stop.signal.aborted) return;
      await this.refused(Refusal.from(error), keep_going);
    }
  }

  private clear(): void {
    this.player.reset(0);
    this.simulation = null;
    this.moment = null;
    this.texts.clear();
    this.drawn_tool = "";
    this.view.overlay.note("tool", null);
    this.summary.clear();
    this.readout.clear();
    this.why.clear();
    this.curves.clear();
    this.path.setSimulation(null);
    this.stock.setSimulation(null);
    this.timeline.setProgram(0, []);
    this.transport.setTime(0);
    this.source.show("", []);
    fill(this.source_head);
    this.host.classList.remove("simulated");
  }

  private async showMachine(signal: AbortSignal): Promise<unknown> {
    const machine = this.choice.machine;
    if (!machine) return null;
    this.app.set({ machine });
    const description = await this.app.api.ask("describe", { machine }, { signal });
    const { links, models, tool } = description;
    const { machine: drawn } = await withModels(this.app.api, { machine }, { links, models, tool });
    if (signal.aborted) return description;
    this.drawn = drawn;
    this.stated_errors = description.check.errors?.length ?? 0;
    this.view.setMachine(drawn);
    if (this.wanted.view) this.view.setView(this.wanted.view);
    return description;
  }

  private async simulate(job: Job, stop: AbortController): Promise<Simulation> {
    const name = typeof job.program === "string" ? job.program : job.program.name;
    const meter = h("progress", { max: "1", value: 0, ariaLabel: tr`Simulation` });
    const share = h("span", { class: "muted number" }, "0 %");
    const cancel = (): void => {
      stop.abort();
      fill(
        this.busy,
        h(
          "p",
          { class: "row" },
          h("span", {}, tr`Stopped.`),
          h("button", { onclick: () => void this.run() }, tr`Simulate`),
        ),
      );
    };
    fill(
      this.busy,
      h("p", {}, tr`Simulating `, h("code", {}, name)),
      h("p", { class: "row" }, meter, share, h("button", { dataTest: "cancel", onclick: cancel }, tr`Cancel`)),
    );
    this.busy.hidden = false;
    const progress = (done: number): void => {
      meter.value = done;
      share.textContent = `${Math.floor(100 * done)} %`;
    };
    return Simulation.run(this.app, job, { progress, signal: stop.signal });
  }

  private async take(simulation: Simulation): Promise<void> {
    const { header } = simulation;
    this.simulation = simulation;
    this.busy.hidden = true;
    this.host.classList.add("simulated");
    this.summary.show(header, this.stated_errors);
    this.readout.setAxes(header.axes);
    this.player.reset(header.duration_s);
    this.timeline.setProgram(header.duration_s, header.marks);
    this.stock.setSimulation(simulation);
    this.path.setSimulation(simulation);
    this.curves.setSimulation(simulation);
    // Before the source is here: a long one takes a second, and what one chooses meanwhile must stay.
    const { wanted } = this;
    this.wanted = {};
    this.takeState({ ...wanted, t: String(numberIn(wanted.t) ?? 0) });
    this.keepState();
    this.app.say("");
    await this.showProgram(0);
  }

  // ---- the address ----

  /** What the address says of how the simulation is shown; what it does not say stays. */
  private takeState(params: Params): void {
    this.exaggeration.take(params);
    this.path.take(params.by);
    this.stock.take(params);
    this.curves.take(params.curves);
    if (params.view) this.view.setView(params.view);
    const time_s = numberIn(params.t);
    if (time_s !== null && short(time_s, 4) !== short(this.moment?.time_s ?? NaN, 4)) this.player.seek(time_s);
  }

  private keepState(): void {
    this.app.keep("simulate", {
      ...this.exaggeration.state,
      ...this.stock.state,
      by: this.path.state,
      curves: this.curves.state,
    });
  }

  /** Shows the source with the errors underlined, and what is wrong. */
  private async refused(refusal: Refusal, kept_going: boolean): Promise<void> {
    this.busy.hidden = true;
    const name = this.dropped?.name ?? this.choice.program ?? "";
    const wrong = refusal.diagnostics.some((d) => d.severity === "error" && ofFile(d, name) && d.line);
    this.summary.refuse(refusal, wrong && !kept_going ? () => void this.run(true) : null);
    try {
      const text =
        this.dropped?.text ??
        (this.choice.program ? (await this.app.api.ask("open", { path: this.choice.program })).text : "");
      if (!text || this.simulation) return;
      const notes = notesOf(refusal.diagnostics, name);
      this.showSource(name, text, notes);
      const first = notes.find((n) => n.severity === "error");
      if (first) this.source.reveal(first.line);
    } catch (error) {
      this.app.fail(error);
    }
  }

  /** A simulation that the server has let go is made again. */
  private failed(error: unknown): void {
    if (error instanceof Refusal && error.code === "gone") void this.run();
    else this.app.fail(error);
  }

  // ---- the source ----

  private async showProgram(index: number): Promise<void> {
    const { simulation } = this;
    if (!simulation) return;
    this.shown_program = index;
    const known = this.texts.get(index) ?? (await simulation.source(index));
    if (simulation !== this.simulation) return;
    this.texts.set(index, known);
    if (this.shown_program !== index) return;
    const { header } = simulation;
    const path = header.programs[index]?.path ?? known.name;
    const marks = header.marks
      .filter((m) => m.grave && m.program === index)
      .map((m) => ({ line: m.line, severity: "error", message: trText(m.text) }));
    this.showSource(known.name, known.text, [...notesOf(header.diagnostics, path), ...marks]);
    if (this.moment?.program !== index) return;
    this.source.setCurrent(this.moment.line);
    this.readOut(this.moment);
  }

  private showSource(name: string, text: string, notes: LineNote[]): void {
    const programs = this.simulation?.header.programs ?? [];
    const choose = h(
      "select",
      { ariaLabel: tr`Program`, onchange: () => void this.showProgram(Number(choose.value)) },
      programs.map((p, i) => h("option", { value: i }, p.name)),
    );
    choose.value = String(this.shown_program);
    const errors = notes.filter((n) => n.severity === "error").length;
    fill(
      this.source_head,
      h("h2", {}, tr`Source`),
      programs.length > 1 ? choose : h("code", { class: "muted", title: name }, name.replace(/^.*[\\/]/, "")),
      errors > 0
        ? h("span", { class: "source-errors" }, errors === 1 ? tr`1 place underlined` : tr`${errors} places underlined`)
        : null,
      this.find.button,
    );
    this.find.clear();
    this.source.show(text, notes);
  }

  private toLine(line: number): void {
    const { simulation } = this;
    const program = this.shown_program;
    if (simulation) this.player.goWhere(() => simulation.timeOf(program, line));
  }

  // ---- keys ----

  /** The keys of the tab beside those of the player; true if this was one. */
  private key(event: KeyboardEvent): boolean {
    const key = tabKey(event);
    if (key === "g") this.find.open("line");
    else if (key === "/") this.find.open("text");
    else if (key === "n") this.toIssue(event.shiftKey ? -1 : 1);
    else return false;
    return true;
  }

  /** The next or the previous collision or over-travel, around the ends; of a program without, the next remark. */
  private toIssue(step: 1 | -1): void {
    const all = this.simulation?.header.marks ?? [];
    const marks = (all.some((m) => m.grave) ? all.filter((m) => m.grave) : all).toSorted((a, b) => a.time_s - b.time_s);
    const now_s = this.moment?.time_s ?? 0;
    const next =
      step > 0
        ? (marks.find((m) => m.time_s > now_s + 1e-9) ?? marks[0])
        : (marks.findLast((m) => m.time_s < now_s - 1e-9) ?? marks.at(-1));
    if (next) this.player.seek(next.time_s);
    this.app.say(
      next
        ? tr`${marks.indexOf(next) + 1} of ${marks.length}: ${trText(next.text)}, line ${next.line}`
        : tr`No issue in this program`,
    );
  }

  // ---- the moment ----

  private step(from_s: number, step: "next" | "previous"): Promise<number> {
    return this.simulation?.step(from_s, step) ?? Promise.resolve(from_s);
  }

  private async showTime(time_s: number): Promise<void> {
    const { simulation } = this;
    if (!simulation) return;
    const frame = await simulation.at(time_s);
    if (simulation !== this.simulation) return;
    const { moment } = frame.header;
    const [nominal, actual] = [frame.f64("nominal"), frame.f64("actual")];
    this.moment = moment;
    this.app.keep("simulate", { t: time_s > 0 ? short(time_s, 4) : null });
    this.showTool(moment, nominal);
    this.view.setPoses(nominal, actual);
    this.path.setTime(time_s);
    this.stock.setTime(time_s);
    this.timeline.setTime(time_s);
    this.transport.setTime(time_s);
    this.curves.setTime(time_s);
    if (moment.program !== this.shown_program)
      void this.showProgram(moment.program).catch((error) => this.failed(error));
    else this.source.setCurrent(moment.line);
    this.readOut(moment);
  }

  /** The moment in numbers, with its block once the source is here. */
  private readOut(moment: Moment): void {
    const is_here = this.texts.has(moment.program) && moment.program === this.shown_program;
    this.readout.show(moment, is_here ? this.source.textOf(moment.line).trim() : "");
  }

  /** What makes the deviation at the present block. */
  private whyHere(): void {
    const { moment, simulation } = this;
    const job = this.job();
    if (!job || !simulation || !moment) return;
    if (moment.line < 1 || moment.program !== 0) {
      const message = moment.line < 1 ? tr`no block runs at this moment` : tr`this block is in a subprogram`;
      this.app.fail(new Refusal("why-here", message, tr`Choose a block of the main program.`));
      return;
    }
    void this.why.show(bodyOf(job), moment.line, simulation.header.marks);
  }

  /** The tool of the set-up in place of that of the machine file. */
  private showTool(moment: Moment, nominal: Float64Array): void {
    const { drawn, simulation } = this;
    if (!drawn || !simulation) return;
    const { tools } = simulation.header;
    const tool = toolOf(drawn, tools, moment, nominal);
    const key = [moment.tool, ...(tool.tip_mm ?? []).map((v) => v.toFixed(3))].join(" ");
    if (key === this.drawn_tool) return;
    this.drawn_tool = key;
    this.view.setTool(tool);
    this.view.overlay.note("tool", toolNote(drawn, tools, moment));
  }

  private zoomed(window_s: [number, number] | null): void {
    this.timeline.setWindow(window_s);
    this.path.setWindow(window_s);
  }
}

/** An axis as a set-up states it. */
const axisOf = ({ name, kind }: MachineDescription["links"][number]): { name: string; unit: "mm" | "deg" }[] =>
  kind === "linear" || kind === "rotary" ? [{ name, unit: kind === "rotary" ? "deg" : "mm" }] : [];

/** Programs are named with or without their folder. */
function ofFile(d: Diagnostic, name: string): boolean {
  const base = (path: string): string => path.replace(/^.*[\\/]/, "");
  return !d.file || d.file === name || base(d.file) === base(name);
}

function notesOf(diagnostics: readonly Diagnostic[], name: string): LineNote[] {
  return diagnostics
    .filter((d) => d.line && ofFile(d, name))
    .map((d) => ({
      line: d.line as number,
      column: d.column,
      severity: d.severity,
      message: trText(d.message),
      hint: trText(d.hint ?? ""),
    }));
}

export const simulate: Tab = {
  title: tr`Simulate`,
  mount: (host, app) => new SimulateTab(host, app),
};
