/** The error budget: what every error does alone, and what an index loses without it. */

import { tr, trText } from "../../words/index.ts";
import { fill, h } from "../../dom.ts";
import { bars, type BarSpec } from "../../figure/bars.ts";
import type { Figure } from "../../figure/figure.ts";
import { number, um, urad } from "../../format.ts";
import { errorLink } from "../../glossary/glossary.ts";
import { indicesOf, titleOf, worstOf, type Correction, type PieceDocument, type Share } from "./types.ts";

type Group = "blame" | "blame_by_body" | "blame_by_kind";
type Measure = "gain" | "alone";
const GROUPS: readonly [Group, string][] = [
  ["blame", tr`by errors`],
  ["blame_by_body", tr`by axes`],
  ["blame_by_kind", tr`by kinds`],
];
const MEASURES: readonly [Measure, string][] = [
  ["gain", tr`gain without it`],
  ["alone", tr`alone`],
];
/** More bars than this hide what matters. */
const MOST = 14;

export interface BudgetActions {
  /** Shows the part without this error. */
  without(error: string): void;
  /** Shows the part after this correction. */
  correct(error: string, text: string): void;
}

export class ErrorBudget {
  private readonly index = h("select", { ariaLabel: tr`Index`, onchange: () => this.draw() });
  private readonly group = h(
    "select",
    { ariaLabel: tr`Grouped by`, onchange: () => this.draw() },
    GROUPS.map(([value, text]) => h("option", { value }, text)),
  );
  private readonly measure = h(
    "select",
    { ariaLabel: tr`What the bars show`, onchange: () => this.draw() },
    MEASURES.map(([value, text]) => h("option", { value }, text)),
  );
  private readonly words = h("p", { class: "muted" });
  private readonly place = h("div");
  private readonly corrections = h("div", { class: "corrections" });
  private readonly actions: BudgetActions;
  private document: PieceDocument | null = null;
  private figure: Figure<BarSpec> | null = null;

  constructor(host: HTMLElement, actions: BudgetActions) {
    this.actions = actions;
    host.append(
      this.corrections,
      h(
        "div",
        { class: "panel" },
        h("div", { class: "row budget-head" }, this.index, this.group, this.measure),
        this.words,
        this.place,
      ),
    );
  }

  /** `file` is the prediction of the file: its corrections are shown whatever is changed. */
  show(document: PieceDocument, file: PieceDocument, fresh: boolean): void {
    this.document = document;
    if (fresh) {
      fill(
        this.index,
        [...indicesOf(document.indices).keys()].map((key) => h("option", { value: key }, titleOf(key))),
      );
      this.index.value = worstOf(document)?.index ?? "volumetric_max_mm";
    }
    this.draw();
    if (fresh) this.showCorrections(file);
  }

  private draw(): void {
    const { document } = this;
    if (!document) return;
    const key = this.index.value;
    const value = indicesOf(document.indices).get(key)?.value ?? 0;
    const gain = this.measure.value === "gain";
    const size = (share: Share): number => 1e3 * (gain ? value - share.without_mm : share.alone_mm);
    const all = document[this.group.value as Group].filter((share) => share.index === key);
    const sorted = [...all].sort((a, b) => Math.abs(size(b)) - Math.abs(size(a)));
    // A share below the resolution of the figures is none.
    const shown = sorted.filter((share) => Math.abs(size(share)) >= 0.05);
    const spec: BarSpec = {
      title: gain ? tr`What ${titleOf(key)} loses without it` : tr`${titleOf(key)} if there were only this error`,
      unit: "µm",
      bars: shown.slice(0, MOST).map((share) => ({
        // The kinds are words, the errors and the axes names.
        name: trText(share.error),
        value: size(share),
        colour: size(share) < 0 ? "var(--series-2)" : "var(--series-1)",
        note: tr`alone ${um(1e3 * share.alone_mm)}, without it ${um(1e3 * share.without_mm)}`,
      })),
      signed: gain,
      ...(this.group.value === "blame" ? { onpick: (bar) => this.actions.without(bar.name) } : {}),
    };
    if (this.figure) this.figure.update(spec);
    else this.figure = bars(this.place, spec);
    const rest = shown.length - spec.bars.length;
    const helps = gain && spec.bars.some((b) => (b.value ?? 0) < 0) ? tr` Orange: it helps by opposing others.` : "";
    const more = rest > 0 ? tr` ${rest} smaller not shown.` : "";
    const click = this.group.value === "blame" ? tr` Click: switch off.` : "";
    this.words.textContent =
      shown.length === 0
        ? tr`No error matters to ${titleOf(key)}: ${um(1e3 * value)}.`
        : tr`${titleOf(key)} is ${um(1e3 * value)}.` + helps + more + click;
  }

  private showCorrections({ corrections: all, judgements: judged }: PieceDocument): void {
    if (all.length === 0) {
      fill(this.corrections);
      return;
    }
    const row = (one: Correction): HTMLElement => {
      const angle = one.change_urad !== undefined;
      const change = one.change_urad ?? one.change_um ?? 0;
      const text = `${change < 0 ? "" : "+"}${angle ? urad(change) : um(change)}`;
      return h(
        "tr",
        { dataCorrection: one.error },
        h("td", {}, h("strong", {}, errorLink(one.error))),
        h("td", { class: "number" }, text),
        judged.map((j) => h("td", { class: "number" }, number(1e3 * (one.indices_mm[j.index] ?? NaN), 1))),
        h(
          "td",
          { class: "number" },
          h(
            "button",
            { onclick: () => this.actions.correct(one.error, `${change} ${angle ? "urad" : "um"}`) },
            tr`Try`,
          ),
        ),
      );
    };
    fill(
      this.corrections,
      h(
        "div",
        { class: "panel" },
        h(
          "div",
          { class: "panel-head" },
          h("h2", {}, tr`One correction that would do`),
          h("span", { class: "muted" }, tr`smallest first, U as it is now; indices in µm after it`),
        ),
        h(
          "table",
          {},
          h(
            "thead",
            {},
            h(
              "tr",
              {},
              h("th", {}, tr`shim`),
              h("th", { class: "number" }, tr`by`),
              judged.map((j) => h("th", { class: "number" }, titleOf(j.index))),
              h("th", {}, h("span", { class: "visually-hidden" }, tr`try it`)),
            ),
          ),
          h("tbody", {}, all.slice(0, 6).map(row)),
        ),
      ),
    );
  }
}
