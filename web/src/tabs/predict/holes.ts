/** A study of holes: where each will be, without and with compensation. */

import { tr, trText } from "../../words/index.ts";
import { diagnosticList, split, type App } from "../../app.ts";
import { fill, h } from "../../dom.ts";
import type { Figure } from "../../figure/figure.ts";
import { clock, number, um } from "../../format.ts";
import { holePlan, type HolePlanSpec } from "./holeplan.ts";
import { studyChoice } from "./summary.ts";
import { VERDICTS, type HoleSet, type HolesHeader } from "./types.ts";

const WORDS: Record<string, string> = {
  none: tr`none`,
  machine: tr`machine only`,
  comprehensive: tr`comprehensive`,
};
const word = (name: string): string => WORDS[name] ?? name;
const COLOURS = ["var(--series-1)", "var(--series-2)", "var(--series-3)"];

export class Holes {
  private readonly app: App;
  private readonly head = h("div", { class: "panel predict-head" });
  private readonly verdict = h("div", { class: "verdict-band", role: "status" });
  private readonly sets = h("div", { class: "panel" });
  private readonly table = h("div", { class: "panel predict-holes" });
  private readonly picks = h("div", { class: "group", role: "group", ariaLabel: tr`Compensation` });
  private readonly place = h("div", { class: "hole-plan" });
  private document: HolesHeader["document"] | null = null;
  private plan: Figure<HolePlanSpec> | null = null;
  private shown = 0;
  private chosen: number | null = null;

  constructor(host: HTMLElement, app: App) {
    this.app = app;
    const { left, right } = split(host, "holes", 0.5);
    left.classList.add("predict-plan");
    left.append(h("div", { class: "panel-head" }, h("h2", {}, tr`Where the holes will be`), this.picks), this.place);
    right.append(this.head, this.verdict, this.sets, this.table);
  }

  show(path: string, { document, diagnostics }: HolesHeader): void {
    this.document = document;
    this.chosen = null;
    this.shown = Math.max(
      0,
      document.sets.findIndex((set) => set.compensation === document.applied),
    );
    fill(
      this.head,
      h("div", { class: "panel-head" }, h("h1", { dataOwn: "" }, document.name), studyChoice(this.app, path)),
      document.temperature_log
        ? h("p", { class: "muted" }, tr`temperatures of `, h("code", {}, document.temperature_log))
        : null,
    );
    this.showVerdict(document);
    this.showSets(document, diagnostics);
    fill(
      this.picks,
      document.sets.map((set, i) =>
        h("button", { dataSet: set.compensation, onclick: () => this.pick(i) }, word(set.compensation)),
      ),
    );
    this.pick(this.shown);
  }

  private showVerdict(document: HolesHeader["document"]): void {
    const good = document.in_tolerance;
    const meaning =
      good === null
        ? tr`the study states no tolerance`
        : good
          ? tr`all stated tolerances will be kept`
          : tr`a tolerance will not be kept`;
    const applied = document.sets.find((set) => set.compensation === document.applied);
    this.verdict.className = `verdict-band ${good === null ? "undecided" : good ? "pass" : "fail"}`;
    fill(
      this.verdict,
      h("strong", { dataTest: "verdict" }, good === null ? tr`NO VERDICT` : VERDICTS[good ? "pass" : "fail"]),
      h("span", {}, tr`${meaning}, compensation: ${word(document.applied)}`),
      applied
        ? h(
            "span",
            { class: "verdict-worst", dataTest: "worst" },
            document.tolerance_mm === null
              ? tr`worst hole ${um(1e3 * applied.worst_mm)}`
              : tr`worst hole ${um(1e3 * applied.worst_mm)} of ${um(1e3 * document.tolerance_mm)}`,
          )
        : null,
    );
  }

  private showSets(document: HolesHeader["document"], diagnostics: HolesHeader["diagnostics"]): void {
    const row = (set: HoleSet, when: string): HTMLElement =>
      h(
        "tr",
        {
          class: when === "" && set.compensation === document.applied ? "judged" : "",
          dataSet: `${set.compensation}${when}`,
        },
        h("td", {}, word(set.compensation), h("span", { class: "muted" }, when)),
        h("td", { class: "number", dataCell: "worst" }, number(1e3 * set.worst_mm, 1)),
        h("td", { class: "number muted", dataCell: "U" }, number(2e3 * set.u_worst_mm, 1)),
        h("td", { class: "number" }, number(document.tolerance_mm === null ? null : 1e3 * document.tolerance_mm, 1)),
        h(
          "td",
          { class: `used ${set.in_tolerance === null ? "" : set.in_tolerance ? "pass" : "fail"}` },
          set.in_tolerance === null ? "" : set.in_tolerance ? tr`in tolerance` : tr`out of tolerance`,
        ),
      );
    fill(
      this.sets,
      h(
        "div",
        { class: "panel-head" },
        h("h2", {}, tr`Compensation, worst hole in µm`),
        h(
          "span",
          { class: "muted" },
          tr`${document.sets[0]?.holes.length ?? 0} holes; increments of ${um(1e3 * document.increment_mm, 0)}`,
        ),
      ),
      h(
        "table",
        { class: "hole-sets" },
        h(
          "thead",
          {},
          h(
            "tr",
            {},
            h("th", {}, tr`compensation`),
            h("th", { class: "number" }, tr`worst`),
            h("th", { class: "number" }, "U (k = 2)"),
            h("th", { class: "number" }, tr`tolerance`),
            h("th", {}, h("span", { class: "visually-hidden" }, tr`verdict`)),
          ),
        ),
        h(
          "tbody",
          {},
          document.sets.map((set) => row(set, "")),
          (document.sets_at_start ?? []).map((set) => row(set, tr`, temperatures of the start held`)),
        ),
      ),
      document.warnings.length > 0
        ? h(
            "ul",
            { class: "warnings" },
            document.warnings.map((text) => h("li", { lang: "en" }, text)),
          )
        : null,
      document.u_lacks.length > 0
        ? h("p", { class: "muted" }, tr`U lacks: ${document.u_lacks.map(trText).join(", ")} (none stated).`)
        : null,
      diagnostics.length > 0 ? diagnosticList(diagnostics.filter((d) => !document.warnings.includes(d.message))) : null,
    );
  }

  private pick(set: number): void {
    this.shown = set;
    this.picks
      .querySelectorAll("button")
      .forEach((button, i) => button.setAttribute("aria-pressed", String(i === set)));
    this.draw();
    this.showTable();
  }

  private draw(): void {
    const set = this.document?.sets[this.shown];
    if (!this.document || !set) return;
    const spec: HolePlanSpec = {
      title: tr`Compensation: ${word(set.compensation)}, worst hole ${um(1e3 * set.worst_mm)}, U ${um(2e3 * set.u_worst_mm)}`,
      holes: set.holes,
      tolerance_um: this.document.tolerance_mm === null ? null : 1e3 * this.document.tolerance_mm,
      colour: COLOURS[this.shown % COLOURS.length] ?? "var(--ink)",
      chosen: this.chosen,
      onpick: (hole) => this.choose(hole),
    };
    if (this.plan) this.plan.update(spec);
    else this.plan = holePlan(this.place, spec);
  }

  private choose(hole: number): void {
    this.chosen = this.chosen === hole ? null : hole;
    this.draw();
    this.table.querySelectorAll("tbody tr").forEach((row, i) => {
      row.classList.toggle("chosen", i === this.chosen);
      if (i === this.chosen) row.scrollIntoView({ block: "nearest" });
    });
  }

  private showTable(): void {
    const { document } = this;
    const set = document?.sets[this.shown];
    if (!document || !set) return;
    const timed = set.holes.some((hole) => hole.time_s > 0);
    const numeric = (text: string, cell?: string): HTMLElement =>
      h("td", { class: "number", dataCell: cell ?? null }, text);
    const words = [
      tr`hole`,
      ...(timed ? [tr`time, min:s`] : []),
      "X, mm",
      "Y, mm",
      "dX",
      "dY",
      tr`length`,
      "u(dX)",
      "u(dY)",
      ...(set.compensation === "none" ? [] : [tr`added, increments`]),
    ];
    fill(
      this.table,
      h("div", { class: "panel-head" }, h("h2", {}, tr`Holes, compensation ${word(set.compensation)}, µm`)),
      h(
        "table",
        {},
        h(
          "thead",
          {},
          h(
            "tr",
            {},
            words.map((text, i) => h("th", { class: i === 0 ? "" : "number" }, text)),
          ),
        ),
        h(
          "tbody",
          {},
          set.holes.map((hole, i) =>
            h(
              "tr",
              { dataHole: String(i + 1), class: i === this.chosen ? "chosen" : "", onclick: () => this.choose(i) },
              h("td", {}, String(i + 1)),
              timed ? numeric(clock(hole.time_s)) : null,
              numeric(number(hole.nominal_mm[0], 3)),
              numeric(number(hole.nominal_mm[1], 3)),
              numeric(number(hole.error_um[0], 1), "dX"),
              numeric(number(hole.error_um[1], 1), "dY"),
              numeric(number(Math.hypot(hole.error_um[0], hole.error_um[1]), 1)),
              numeric(number(hole.u_um[0], 1)),
              numeric(number(hole.u_um[1], 1)),
              set.compensation === "none"
                ? null
                : numeric(
                    hole.compensation_increments
                      .slice(0, 2)
                      .map((n) => number(n, 0))
                      .join(", "),
                  ),
            ),
          ),
        ),
      ),
    );
  }
}
