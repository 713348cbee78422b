/** What to measure: paths on the machine, what they see, how well every error will be known. */

import { tr } from "../words/index.ts";
import { diagnosticList, split, type App, type Tab, type TabHandle } from "../app.ts";
import { numberIn, type Params } from "../address.ts";
import { latestOnly, type PoseHeader } from "../api.ts";
import { CONTROLS } from "../controls.ts";
import { fill, h } from "../dom.ts";
import type { Figure } from "../figure/index.ts";
import { deg, mm, number, NARROW_SPACE } from "../format.ts";
import type { Frame } from "../frame.ts";
import { MachineView } from "../scene/view.ts";
import { confoundedPanel } from "./identify/panels.ts";
import { fileSelect, isAbort, Question, reportButton, showRefusal } from "./measure/ask.ts";
import { dropOn, handOver } from "./measure/drop.ts";
import type { PlanHeader } from "./plan/documents.ts";
import { chosenPanel, expectedPanel, pathsPanel, programsPanel, seenPanel, summaryPanel } from "./plan/panels.ts";
import { StationLayer } from "./plan/stations.ts";

/** More rows than this make a list slow; the slider reaches every station. */
const MOST_ROWS = 600;

interface Pose {
  machine: string;
  at: Record<string, number>;
}

class PlanTab implements TabHandle {
  private readonly app: App;
  private readonly view: MachineView;
  private readonly layer: StationLayer;
  private readonly head = h("section", { class: "panel form" });
  private readonly summary = h("div");
  private readonly paths = h("div");
  private readonly stations = h("section", { class: "panel", hidden: true });
  private readonly result = h("div", { class: "result" });
  private readonly programs = h("div");
  private readonly open_file: HTMLElement;
  private readonly slider: HTMLInputElement;
  private readonly where = h("output", { class: "station-now" });
  private readonly question: Question<"plan">;
  private figures: Figure<never>[] = [];
  private frame: Frame<PlanHeader> | null = null;
  private campaign: string | null = null;
  /** The campaign that the answer on the page is of. */
  private shown: string | null = null;
  private dialect = "sinumerik";
  private asked = "";
  private machine: string | null = null;
  /** Its file may have changed since it was drawn. */
  private is_machine_old = false;
  private tool_mm = 100;
  /** The camera comes close once per machine; then it stays where the user put it. */
  private come_close = false;
  private path = 0;
  private station = 0;
  /** What the address says of how the plan is shown. */
  private wanted: Params = {};
  private readonly pose = latestOnly<Pose, Frame<PoseHeader>>(
    (pose) => this.app.api.ask("pose", pose),
    (frame) => this.showPose(frame),
    (error) => this.app.fail(error),
  );

  constructor(host: HTMLElement, app: App) {
    this.app = app;
    this.question = new Question(app, "plan", () => this.askAgain());
    const { left, right } = split(host, "plan", 0.54);
    this.view = new MachineView(left);
    this.layer = new StationLayer(this.view);
    this.slider = h("input", {
      type: "range",
      min: "0",
      max: "0",
      step: "1",
      value: "0",
      class: "station-slider",
      ariaLabel: tr`Station of the path`,
      oninput: () => this.go(Number(this.slider.value)),
    });
    left.append(
      h(
        "div",
        { class: "scene-bottom" },
        h(
          "div",
          { class: "scene-control" },
          h("button", { title: tr`Look at the stations from near`, onclick: () => this.layer.closeUp() }, tr`Close up`),
          h("span", {}, tr`Station`),
          this.slider,
          this.where,
        ),
      ),
    );
    this.open_file = dropOn(host, app, tr`Readings …`, (file) => {
      handOver(file);
      app.go("identify", { campaign: this.campaign });
    });
    this.open_file.title = tr`Measured already? Readings opened here, or dropped anywhere on this page, go to Identify`;
    fill(right, this.head, this.summary, this.paths, this.result, this.stations, this.programs);
  }

  open(params: Readonly<Record<string, string>>): void {
    this.campaign =
      params.campaign ??
      this.campaign ??
      this.app.state.project?.examples.find((example) => example.tab === "plan")?.path ??
      null;
    this.dialect = params.dialect ?? this.dialect;
    this.wanted = params;
    void this.run().then(() => this.takeState());
  }

  /** The path and the station of the address. */
  private takeState(): void {
    const { path, station } = this.wanted;
    const header = this.frame?.header;
    if (!header || this.campaign !== this.shown) return;
    this.wanted = {};
    const at = header.paths.findIndex((one) => one.name === path);
    if (at >= 0 && at !== this.path) this.choosePath(at);
    const n = numberIn(station);
    if (n !== null && n - 1 !== this.station) this.go(Math.min(Math.max(0, this.span()[1] - 1), Math.max(0, n - 1)));
  }

  hide(): void {
    this.question.stop();
  }

  changed(path: string | null): void {
    if (this.question.isChangedBy(path)) this.askAgain();
  }

  private askAgain(): void {
    this.asked = "";
    this.is_machine_old = true;
    if (this.app.state.tab === "plan") void this.run();
  }

  private async run(): Promise<void> {
    this.showForm();
    if (!this.campaign) {
      this.clear();
      fill(
        this.result,
        h(
          "section",
          { class: "panel" },
          h("p", {}, tr`Choose a campaign: it names the machine, the unknown errors, the instrument and its paths.`),
        ),
      );
      return;
    }
    const body = { campaign: this.campaign, dialect: this.dialect };
    const asked = JSON.stringify(body);
    if (asked === this.asked) return;
    this.asked = asked;
    if (this.campaign !== this.shown) this.clear();
    if (!this.frame)
      fill(
        this.result,
        h("section", { class: "panel muted" }, tr`Working out the paths, what they see, and their programs …`),
      );
    try {
      await this.show(await this.question.ask(body, tr`planning ${this.campaign}`));
    } catch (error) {
      if (this.asked === asked) this.asked = "";
      if (isAbort(error)) return;
      this.clear();
      showRefusal(this.result, error);
    }
  }

  private clear(): void {
    for (const one of this.figures) one.dispose();
    this.figures = [];
    this.frame = null;
    this.stations.hidden = true;
    for (const panel of [this.summary, this.paths, this.stations, this.result, this.programs]) panel.replaceChildren();
  }

  private showForm(): void {
    const campaigns = fileSelect(
      this.app,
      tr`Campaign`,
      "plan",
      (file) => file.kind === "campaign",
      this.campaign,
      (campaign) => this.app.go("plan", { campaign, dialect: this.dialect }),
    );
    fill(
      this.head,
      h(
        "div",
        { class: "row" },
        h("label", { class: "field grow" }, h("span", {}, tr`Campaign`), campaigns),
        this.open_file,
        this.measureButton(),
        reportButton(this.app, { verb: "plan", file: this.campaign }),
      ),
    );
  }

  private measureButton(): HTMLElement | null {
    const { campaign } = this;
    if (!campaign) return null;
    return h(
      "button",
      { title: tr`Type the readings, station by station`, onclick: () => this.app.go("measure", { campaign }) },
      tr`Measure`,
    );
  }

  private dialectSelect(): HTMLElement {
    const select = h(
      "select",
      {
        ariaLabel: tr`Control of the programs`,
        dataTest: "dialect",
        onchange: () => this.app.go("plan", { campaign: this.campaign, dialect: select.value }),
      },
      CONTROLS.map(([key, title]) => h("option", { value: key }, title)),
    );
    select.value = this.dialect;
    return select;
  }

  // ---- the answer ----

  private async show(frame: Frame<PlanHeader>): Promise<void> {
    const { header } = frame;
    const { document } = header;
    if (header.machine !== this.machine || this.is_machine_old) {
      const described = await this.app.api.ask("describe", { machine: header.machine ?? "" });
      this.view.setMachine(described);
      this.view.setArrowsVisible(false);
      this.tool_mm = described.tool?.length_mm ?? this.tool_mm;
      this.come_close = header.machine !== this.machine;
      this.machine = header.machine;
      this.is_machine_old = false;
    }
    this.clear();
    this.frame = frame;
    this.shown = this.campaign;
    fill(this.summary, summaryPanel(document));
    this.draw(expectedPanel(document));
    this.result.append(confoundedPanel(document.unobservable, tr`All unknowns are observable.`));
    if (document.chosen) this.result.append(chosenPanel(document.chosen));
    this.draw(seenPanel(document));
    fill(this.programs, programsPanel(header, this.dialectSelect()));
    if (header.diagnostics.length > 0)
      this.programs.append(
        h("section", { class: "panel" }, h("h2", {}, tr`Remarks`), diagnosticList(header.diagnostics)),
      );
    // The chosen poses come last, and are what the plan is about.
    const wanted = document.chosen ? header.paths.length - 1 : Math.min(this.path, header.paths.length - 1);
    this.choosePath(Math.max(0, wanted));
    this.app.say(this.campaign ?? "");
  }

  private draw({ panel, figures }: { panel: HTMLElement; figures: Figure<never>[] }): void {
    this.result.append(panel);
    this.figures.push(...figures);
  }

  // ---- stations ----

  private choosePath(path: number): void {
    const header = this.frame?.header;
    if (!header) return;
    this.path = path;
    fill(
      this.paths,
      pathsPanel(header, path, (chosen) => this.choosePath(chosen)),
    );
    this.slider.max = String(Math.max(0, (header.paths[path]?.stations ?? 1) - 1));
    this.layer.show(this.tools(), 0, this.tool_mm);
    this.view.overlay.note("stations", tr`Strokes: tool axis at every station; the tool is that of the machine file`);
    this.listStations();
    this.go(0);
  }

  /** Number of the first station of the shown path among all, and how many it has. */
  private span(): [number, number] {
    const paths = this.frame?.header.paths ?? [];
    return [paths.slice(0, this.path).reduce((sum, path) => sum + path.stations, 0), paths[this.path]?.stations ?? 0];
  }

  private tools(): Float64Array {
    const [first, count] = this.span();
    return this.frame?.f64("tools").slice(6 * first, 6 * (first + count)) ?? new Float64Array();
  }

  /** Axis positions at a station of the shown path, by name. */
  private commands(station: number): Record<string, number> {
    const { frame } = this;
    if (!frame) return {};
    const { axes } = frame.header;
    const commands = frame.f64("commands");
    const row = this.span()[0] + station;
    return Object.fromEntries(axes.map(({ name }, j) => [name, commands[axes.length * row + j] as number]));
  }

  private listStations(): void {
    const header = this.frame?.header;
    if (!header) return;
    const [, count] = this.span();
    const shown = Math.min(count, MOST_ROWS);
    const cells = (i: number): HTMLElement[] => {
      const at = this.commands(i);
      return header.axes.map(({ name, unit }) => h("td", { class: "number" }, number(at[name], unit === "mm" ? 3 : 4)));
    };
    const rows = Array.from({ length: shown }, (_, i) =>
      h(
        "tr",
        {
          dataStation: i,
          tabindex: "0",
          onclick: () => this.go(i),
          onkeydown: (event: KeyboardEvent) => event.key === "Enter" && this.go(i),
        },
        h("td", { class: "number" }, String(i + 1)),
        cells(i),
      ),
    );
    const heading = header.axes.map(({ name, unit }) =>
      h("th", { class: "number" }, `${name}, ${unit === "mm" ? "mm" : "°"}`),
    );
    const name = header.paths[this.path]?.name ?? "";
    this.stations.hidden = count === 0;
    fill(
      this.stations,
      h("h2", {}, name === "chosen" ? tr`Stations of the chosen poses` : tr`Stations of path ${name}`),
      h(
        "div",
        { class: "stations" },
        h(
          "table",
          {},
          h("thead", {}, h("tr", {}, h("th", { class: "number" }, tr`No.`), heading)),
          h("tbody", {}, rows),
        ),
      ),
      shown < count
        ? h("p", { class: "muted note" }, tr`The first ${shown} of ${count}; the slider below the machine reaches all.`)
        : null,
    );
  }

  /** Puts the machine at a station. */
  private go(station: number): void {
    if (!this.machine || !this.frame || this.span()[1] === 0) return;
    this.slider.value = String(station);
    this.station = station;
    this.app.keep("plan", {
      campaign: this.campaign,
      path: this.frame.header.paths[this.path]?.name,
      station: station === 0 ? null : String(station + 1),
    });
    const at = this.commands(station);
    // Lengths in a row have their unit once, after the last.
    const value = (name: string, unit: string, next: string | undefined): string =>
      unit !== "mm" ? deg(at[name], 1) : next === "mm" ? number(at[name], 1) : mm(at[name], 1);
    const text = this.frame.header.axes
      .map(({ name, unit }, i, axes) => `${name}${NARROW_SPACE}${value(name, unit, axes[i + 1]?.unit)}`)
      .join(" ");
    this.where.textContent = tr`${station + 1} of ${this.span()[1]}: ${text}`;
    this.slider.setAttribute("aria-valuetext", this.where.textContent);
    for (const row of this.stations.querySelectorAll<HTMLElement>("[data-station]")) {
      const here = row.dataset.station === String(station);
      if (here !== (row.getAttribute("aria-selected") === "true")) row.setAttribute("aria-selected", String(here));
      if (here) scrollInto(row);
    }
    this.layer.mark(station);
    this.pose({ machine: this.machine, at });
  }

  private showPose(frame: Frame<PoseHeader>): void {
    this.view.setPoses(frame.f64("nominal"), frame.f64("actual"));
    // Where to measure is a matter of the nominal machine.
    this.view.setGhostVisible(false);
    if (this.come_close) this.layer.closeUp();
    this.come_close = false;
  }
}

/** Scrolls the list only, not the page around it. */
function scrollInto(row: HTMLElement): void {
  const box = row.closest<HTMLElement>(".stations");
  if (!box) return;
  const [top, bottom] = [row.offsetTop - 28, row.offsetTop + row.offsetHeight];
  if (top < box.scrollTop) box.scrollTop = top;
  else if (bottom > box.scrollTop + box.clientHeight) box.scrollTop = bottom - box.clientHeight;
}

export const plan: Tab = {
  title: tr`Plan`,
  mount: (host, app) => new PlanTab(host, app),
};
