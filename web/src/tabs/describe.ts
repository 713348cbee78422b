/** The machine as its file says it is: picture, chain, axes to drag, where the deviation comes from. */

import { diagnosticList, split, type App, type Tab, type TabHandle } from "../app.ts";
import { latestOnly, type Description, type Link, type PoseDocument, type PoseHeader, type Vector } from "../api.ts";
import { fill, h, perFrame } from "../dom.ts";
import { bars, type BarSpec } from "../figure/bars.ts";
import { chainPicture, travelText, type ChainSpec } from "../figure/chain.ts";
import type { Figure } from "../figure/figure.ts";
import { digitsOfStep, mm, number, um, urad } from "../format.ts";
import type { Frame } from "../frame.ts";
import { exaggerationControl } from "../scene/exaggeration.ts";
import { MachineView } from "../scene/view.ts";

type Direction = "X" | "Y" | "Z" | "axis";

class DescribeTab implements TabHandle {
  private readonly view: MachineView;
  private readonly panel: HTMLElement;
  private readonly head = h("section", { class: "panel" });
  private readonly chain = h("section", { class: "panel" });
  private readonly axes = h("section", { class: "panel" });
  private readonly tip = h("section", { class: "panel" });
  private readonly budget = h("section", { class: "panel" });
  private readonly findings = h("section", { class: "panel" });
  private readonly app: App;
  private machine: string | null = null;
  private described: Description | null = null;
  private at: Record<string, number> = {};
  private pose: PoseDocument | null = null;
  private direction: Direction = "X";
  private bar: Figure<BarSpec> | null = null;
  private picture: Figure<ChainSpec> | null = null;
  private readonly ask = latestOnly<Record<string, number>, Frame<PoseHeader>>(
    (at) => this.app.api.ask("pose", { machine: this.machine, at }),
    (frame) => this.showPose(frame),
    (error) => this.app.fail(error),
  );

  constructor(host: HTMLElement, app: App) {
    this.app = app;
    const { left, right } = split(host, "describe", 0.58);
    this.panel = right;
    this.view = new MachineView(left);
    left.append(h("div", { class: "scene-bottom" }, exaggerationControl(this.view)));
    fill(this.panel, this.head, this.chain, this.axes, this.tip, this.budget, this.findings);
  }

  open(params: Readonly<Record<string, string>>): void {
    const wanted = params["machine"] ?? this.app.state.machine ?? this.app.state.project?.files.find((f) => f.kind === "machine")?.path ?? null;
    if (!wanted) {
      fill(this.head, h("p", {}, "There is no machine file in this folder. Open an example on the first page, or put a machine.toml into the folder."));
      return;
    }
    if (wanted !== this.machine) void this.load(wanted, params["at"]);
  }

  changed(path: string): void {
    if (path === this.machine) void this.load(path);
  }

  private async load(path: string, at?: string): Promise<void> {
    this.machine = path;
    this.app.set({ machine: path });
    this.app.say(`reading ${path}`);
    try {
      const description = await this.app.api.ask("describe", { machine: path });
      if (this.machine !== path) return;
      this.described = description;
      this.at = startPositions(description.links, at);
      this.view.setMachine(description);
      this.showHead(path, description);
      this.picture?.dispose();
      this.picture = chainPicture(this.chain, { title: "From the workpiece to the tool", links: description.links, onhover: (name) => this.view.highlight(name) });
      this.showAxes(description.links);
      this.showFindings(description);
      this.app.say(path);
      this.ask({ ...this.at });
    } catch (error) {
      this.app.fail(error);
    }
  }

  private showHead(path: string, { check }: Description): void {
    const files = this.app.state.project?.files.filter((f) => f.kind === "machine") ?? [];
    const choose = h("select", { ariaLabel: "Machine file", onchange: () => this.app.go("describe", { machine: choose.value }) }, [...new Set([path, ...files.map((f) => f.path)])].map((p) => h("option", { value: p }, p)));
    choose.value = path;
    fill(this.head, h("div", { class: "panel-head" }, h("h1", {}, check.name), choose), h("p", {}, h("code", { class: "chain-text" }, check.chain)), check.source ? h("p", { class: "muted source" }, check.source) : null);
  }

  private showAxes(links: readonly Link[]): void {
    const rows = links.filter((l) => l.kind === "linear" || l.kind === "rotary").map((link) => this.axisRow(link));
    const home = h("button", { onclick: () => this.move(startPositions(links)) }, "All to 0");
    fill(this.axes, h("div", { class: "panel-head" }, h("h2", {}, "Axes"), home), h("table", { class: "axes" }, h("thead", {}, h("tr", {}, h("th", {}, "Axis"), h("th", {}, "Travel"), h("th", {}, h("span", { class: "visually-hidden" }, "Slider")), h("th", { class: "number" }, "Position"))), h("tbody", {}, rows)));
  }

  private axisRow(link: Link): HTMLElement {
    const [from, to] = Array.isArray(link.travel) ? link.travel : link.kind === "rotary" ? [-360, 360] : [-500, 500];
    const unit = link.kind === "linear" ? "mm" : "°";
    const step = to - from > 2000 ? 1 : to - from > 100 ? 0.1 : 0.01;
    const name = `${link.name}${link.carries === "workpiece" ? "\u2032" : ""}`;
    const slider = h("input", { type: "range", min: from, max: to, step, value: String(this.at[link.name] ?? 0), dataAxis: link.name, ariaLabel: `Axis ${name}, ${unit === "mm" ? "millimetres" : "degrees"}` });
    const box = h("input", { type: "number", min: from, max: to, step: "any", value: String(this.at[link.name] ?? 0), class: "position", dataPosition: link.name, ariaLabel: `Position of ${name} in ${unit === "mm" ? "millimetres" : "degrees"}` });
    slider.addEventListener("input", () => {
      box.value = Number(slider.value).toFixed(digitsOfStep(step));
      judge(Number(slider.value));
      this.setAxis(link.name, Number(slider.value));
    });
    box.addEventListener("change", () => {
      const value = Number(box.value);
      if (box.value.trim() === "" || !Number.isFinite(value)) return;
      slider.value = box.value;
      judge(value);
      this.setAxis(link.name, value);
    });
    const travel = h("td", { class: "muted travel" }, travelText(link));
    const judge = (value: number): void => {
      const outside = Array.isArray(link.travel) && (value < from || value > to);
      travel.classList.toggle("outside", outside);
      travel.textContent = outside ? `outside ${travelText(link)}` : travelText(link);
      if (outside) box.setAttribute("aria-invalid", "true");
      else box.removeAttribute("aria-invalid");
    };
    judge(this.at[link.name] ?? 0);
    const row = h("tr", {}, h("td", { class: "axis-name" }, name), travel, h("td", { class: "axis-slider" }, slider), h("td", { class: "number" }, box, h("span", { class: "unit" }, unit)));
    row.addEventListener("pointerenter", () => this.view.highlight(link.name));
    row.addEventListener("pointerleave", () => this.view.highlight(null));
    return row;
  }

  private readonly setAxis = (name: string, value: number): void => {
    this.at[name] = value;
    this.asked();
  };

  private readonly asked = perFrame(() => this.ask({ ...this.at }));

  private move(at: Record<string, number>): void {
    this.at = at;
    if (this.described) this.showAxes(this.described.links);
    this.ask({ ...at });
  }

  private showPose(frame: Frame<PoseHeader>): void {
    this.pose = frame.header.pose;
    this.view.setPoses(frame.f64("nominal"), frame.f64("actual"));
    this.showTip(this.pose);
    this.showBudget();
  }

  private showTip(pose: PoseDocument): void {
    const cells = (values: Vector, text: (v: number) => string): HTMLElement[] => values.map((v) => h("td", { class: "number" }, text(v)));
    const length = Math.hypot(...pose.deviation.tip_um);
    const tilt = Math.hypot(...pose.deviation.axis_urad);
    const vector = (v: number): string => number(v, 6);
    fill(
      this.tip,
      h("div", { class: "panel-head" }, h("h2", {}, "Tool tip, as the workpiece sees it"), h("span", { class: "deviation", dataTest: "tip-length" }, um(length))),
      h(
        "table",
        { class: "tip" },
        h("thead", {}, h("tr", {}, h("th", {}), h("th", { class: "number" }, "X"), h("th", { class: "number" }, "Y"), h("th", { class: "number" }, "Z"), h("th", { class: "number" }, "length"))),
        h(
          "tbody",
          {},
          h("tr", { dataTest: "nominal" }, h("td", {}, "nominal tip"), cells(pose.nominal.tip_mm, (v) => mm(v)), h("td", {})),
          h("tr", { dataTest: "actual" }, h("td", {}, "actual tip"), cells(pose.actual.tip_mm, (v) => mm(v)), h("td", {})),
          h("tr", { class: "deviation-row", dataTest: "deviation" }, h("td", {}, "deviation"), cells(pose.deviation.tip_um, (v) => um(v)), h("td", { class: "number" }, um(length))),
          h("tr", { dataTest: "axis" }, h("td", {}, "tool axis"), cells(pose.nominal.axis, vector), h("td", {})),
          h("tr", { class: "deviation-row", dataTest: "axis-deviation" }, h("td", {}, "deviation"), cells(pose.deviation.axis_urad, (v) => urad(v)), h("td", { class: "number" }, urad(tilt))),
        ),
      ),
    );
  }

  /** Who is to blame: the share of every error, in the direction asked for. */
  private showBudget(): void {
    if (!this.pose) return;
    const index = { X: 0, Y: 1, Z: 2, axis: -1 }[this.direction];
    const all = this.pose.budget.map((entry) => ({ name: entry.error, value: index < 0 ? Math.hypot(...entry.axis_urad) : (entry.tip_um[index] ?? 0) }));
    const least = 0.005 * Math.max(...all.map((b) => Math.abs(b.value)), 1e-6);
    const shown = all.filter((b) => Math.abs(b.value) > least).sort((a, b) => Math.abs(b.value) - Math.abs(a.value));
    const top = shown.slice(0, 14).map((b) => ({ ...b, colour: b.value < 0 ? "var(--series-2)" : "var(--series-1)" }));
    const unit = index < 0 ? "µrad" : "µm";
    const total = index < 0 ? Math.hypot(...this.pose.deviation.axis_urad) : (this.pose.deviation.tip_um[index] ?? 0);
    const spec: BarSpec = { title: index < 0 ? "Share of every error in the tilt of the tool axis" : `Share of every error in ${this.direction}`, unit, bars: top, signed: index >= 0 };
    if (this.bar) this.bar.update(spec);
    else {
      const pick = h("div", { class: "group", role: "group", ariaLabel: "Direction of the shares" }, (["X", "Y", "Z", "axis"] as const).map((d) => h("button", { ariaPressed: String(d === this.direction), onclick: () => this.pick(d) }, d === "axis" ? "tool axis" : d)));
      fill(this.budget, h("div", { class: "panel-head" }, h("h2", {}, "Where it comes from"), pick, h("span", { class: "muted budget-total" })));
      this.bar = bars(this.budget, spec);
    }
    const note = this.budget.querySelector(".budget-total");
    const rest = shown.length - top.length;
    if (note) note.textContent = `${index < 0 ? "together" : "sum"} ${index < 0 ? urad(total) : um(total)}${rest > 0 ? `, ${rest} smaller not shown` : ""}`;
  }

  private pick(direction: Direction): void {
    this.direction = direction;
    this.budget.querySelectorAll(".group button").forEach((button, i) => button.setAttribute("aria-pressed", String(["X", "Y", "Z", "axis"][i] === direction)));
    this.showBudget();
  }

  private showFindings({ check }: Description): void {
    fill(
      this.findings,
      h("h2", {}, "What the check says"),
      check.diagnostics.length > 0 ? diagnosticList(check.diagnostics) : h("p", {}, "No errors or warnings."),
      check.lacks.length > 0 ? [h("h3", { class: "lacks-title" }, "Not stated in the file"), h("ul", { class: "lacks" }, check.lacks.map((text) => h("li", {}, text)))] : null,
    );
  }
}

/** 0, or the end of the travel next to it; `at` as "X=10,C=45". */
function startPositions(links: readonly Link[], at?: string): Record<string, number> {
  const positions: Record<string, number> = {};
  for (const link of links) {
    if (link.kind !== "linear" && link.kind !== "rotary") continue;
    const [from, to] = Array.isArray(link.travel) ? link.travel : [-Infinity, Infinity];
    positions[link.name] = Math.min(to, Math.max(from, 0));
  }
  for (const part of (at ?? "").split(/[ ,]+/)) {
    const [name = "", value = ""] = part.split("=");
    if (name in positions && Number.isFinite(Number(value))) positions[name] = Number(value);
  }
  return positions;
}

export const describe: Tab = {
  title: "Describe",
  mount: (host, app) => new DescribeTab(host, app),
};
