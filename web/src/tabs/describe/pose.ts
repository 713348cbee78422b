/** Where the tool tip is, and which error puts it there. */

import { tr } from "../../words/index.ts";
import { refusedWith } from "../../words/told.ts";
import { diagnosticList } from "../../app.ts";
import type { Diagnostic, PoseDocument, Refusal, Vector } from "../../api.ts";
import { fill, h } from "../../dom.ts";
import { bars, type BarSpec } from "../../figure/bars.ts";
import type { Figure } from "../../figure/figure.ts";
import { mm, number, um, urad } from "../../format.ts";

type Direction = "X" | "Y" | "Z" | "axis";
const DIRECTIONS: readonly Direction[] = ["X", "Y", "Z", "axis"];

/** Bars that are shown at once. */
const MOST_BARS = 14;

export class PosePanels {
  readonly tip = h("section", { class: "panel" });
  readonly budget = h("section", { class: "panel" });
  private pose: PoseDocument | null = null;
  private direction: Direction = "X";
  private readonly pick = h("div", { class: "group", role: "group", ariaLabel: tr`Direction of the shares` });
  private readonly total = h("span", { class: "muted budget-total" });
  private bar: Figure<BarSpec> | null = null;

  constructor() {
    fill(
      this.pick,
      DIRECTIONS.map((d) =>
        h(
          "button",
          { ariaPressed: String(d === this.direction), dataDirection: d, onclick: () => this.choose(d) },
          d === "axis" ? tr`tool axis` : d,
        ),
      ),
    );
    fill(this.budget, h("div", { class: "panel-head" }, h("h2", {}, tr`Where it comes from`), this.pick, this.total));
  }

  show(pose: PoseDocument, notes: readonly Diagnostic[], warm: boolean): void {
    this.pose = pose;
    this.showTip(pose, notes, warm);
    this.showBudget();
  }

  /** No pose: why not. The numbers of the last one go. */
  refuse(refusal: Refusal): void {
    this.pose = null;
    const list =
      refusal.diagnostics.length > 0
        ? diagnosticList(refusal.diagnostics)
        : [
            refusedWith("p", { class: "field-problem" }, refusal, refusal.message),
            refusedWith("p", { class: "hint" }, refusal, refusal.hint),
          ];
    fill(this.tip, h("h2", {}, tr`Tool tip, as the workpiece sees it`), list);
    this.total.textContent = "";
    this.bar?.update({ title: "", unit: "µm", bars: [] });
  }

  private showTip(pose: PoseDocument, notes: readonly Diagnostic[], warm: boolean): void {
    const cells = (values: Vector, text: (v: number) => string): HTMLElement[] =>
      values.map((v) => h("td", { class: "number" }, text(v)));
    const length = Math.hypot(...pose.deviation.tip_um);
    const tilt = Math.hypot(...pose.deviation.axis_urad);
    const heads = h(
      "tr",
      {},
      h("td", {}),
      ["X", "Y", "Z", tr`length`].map((name) => h("th", { class: "number" }, name)),
    );
    const row = (test: string, name: string, values: HTMLElement[], last = "", deviation = false): HTMLElement =>
      h(
        "tr",
        { class: deviation ? "deviation-row" : null, dataTest: test },
        h("td", {}, name),
        values,
        h("td", { class: "number" }, last),
      );
    fill(
      this.tip,
      h("h2", {}, warm ? tr`Tool tip, on the part at 20 °C` : tr`Tool tip, as the workpiece sees it`),
      h(
        "table",
        { class: "tip" },
        h("thead", {}, heads),
        h(
          "tbody",
          {},
          row(
            "nominal",
            tr`nominal tip`,
            cells(pose.nominal.tip_mm, (v) => mm(v)),
          ),
          row(
            "actual",
            tr`actual tip`,
            cells(pose.actual.tip_mm, (v) => mm(v)),
          ),
          row(
            "deviation",
            tr`deviation`,
            cells(pose.deviation.tip_um, (v) => um(v)),
            um(length),
            true,
          ),
          row(
            "axis",
            tr`tool axis`,
            cells(pose.nominal.axis, (v) => number(v, 6)),
          ),
          row(
            "axis-deviation",
            tr`deviation`,
            cells(pose.deviation.axis_urad, (v) => urad(v)),
            urad(tilt),
            true,
          ),
        ),
      ),
      notes.length > 0 ? diagnosticList(notes) : null,
    );
  }

  /** The error budget: the share of every error, in the direction asked for. */
  private showBudget(): void {
    const { pose, direction } = this;
    if (!pose) return;
    const index = DIRECTIONS.indexOf(direction);
    const tilt = direction === "axis";
    const all = pose.budget.map((entry) => ({
      name: entry.error,
      value: tilt ? Math.hypot(...entry.axis_urad) : (entry.tip_um[index] ?? 0),
    }));
    const least = 0.005 * Math.max(...all.map((b) => Math.abs(b.value)), 1e-6);
    const shown = all.filter((b) => Math.abs(b.value) > least).sort((a, b) => Math.abs(b.value) - Math.abs(a.value));
    const top = shown
      .slice(0, MOST_BARS)
      .map((b) => ({ ...b, colour: b.value < 0 ? "var(--series-2)" : "var(--series-1)" }));
    const spec: BarSpec = {
      title: tilt ? tr`Share of every error in the tilt of the tool axis` : tr`Share of every error in ${direction}`,
      unit: tilt ? "µrad" : "µm",
      bars: top,
      signed: !tilt,
    };
    if (this.bar) this.bar.update(spec);
    else this.bar = bars(this.budget, spec);
    const sum = tilt
      ? tr`together ${urad(Math.hypot(...pose.deviation.axis_urad))}`
      : tr`sum ${um(pose.deviation.tip_um[index])}`;
    const rest = shown.length - top.length;
    this.total.textContent =
      top.length === 0 ? tr`no error acts here` : rest > 0 ? tr`${sum}, ${rest} smaller not shown` : sum;
  }

  private choose(direction: Direction): void {
    this.direction = direction;
    for (const button of this.pick.querySelectorAll("button"))
      button.setAttribute("aria-pressed", String(button.dataset.direction === direction));
    this.showBudget();
  }
}
