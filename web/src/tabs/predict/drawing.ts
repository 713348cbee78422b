/** A part by its drawing: each characteristic against its tolerance, and where its surfaces are off. */

import { tr, trText } from "../../words/index.ts";
import { diagnosticList, split, type App } from "../../app.ts";
import { fill, h } from "../../dom.ts";
import { number } from "../../format.ts";
import type { Frame } from "../../frame.ts";
import { withErrorNames } from "../../glossary/glossary.ts";
import { DeviationMap } from "./deviationmap.ts";
import { studyChoice } from "./summary.ts";
import { VERDICTS, type CharacteristicValue, type CutPoint, type DrawingHeader, type Verdict } from "./types.ts";

const SENTENCES = {
  pass: tr`the part will be in tolerance`,
  fail: tr`a characteristic will be out of tolerance`,
  undecided: tr`a characteristic is nearer to its limit than its uncertainty`,
};

export class Drawing {
  private readonly app: App;
  private readonly head = h("div", { class: "panel predict-head" });
  private readonly verdict = h("div", { class: "verdict-band", role: "status" });
  private readonly values = h("div", { class: "panel" });
  private readonly budget = h("div", { class: "panel" });
  private readonly surfaces = h("div", { class: "panel" });
  private chosen = 0;

  readonly map: DeviationMap;

  constructor(host: HTMLElement, app: App) {
    this.app = app;
    const { left, right } = split(host, "drawing", 0.5);
    this.map = new DeviationMap(left);
    right.classList.add("predict-drawing");
    right.append(this.head, this.verdict, this.values, this.budget, this.surfaces);
  }

  show(path: string, frame: Frame<DrawingHeader>): void {
    const { document, diagnostics } = frame.header;
    const nearest = document.characteristics.reduce((w, c) => (w.used_ratio >= c.used_ratio ? w : c));
    this.chosen = document.characteristics.indexOf(nearest);
    fill(
      this.head,
      h(
        "div",
        { class: "panel-head" },
        h("h1", { dataOwn: "" }, document.name),
        this.compensation(path, document),
        studyChoice(this.app, path),
      ),
      h("p", { class: "muted" }, tr`${document.part}; ${document.steps} steps of the tools${withoutU(document)}`),
      diagnosticList(diagnostics),
    );
    this.verdict.className = `verdict-band ${document.outcome}`;
    fill(
      this.verdict,
      h("strong", { dataTest: "verdict" }, VERDICTS[document.outcome as Verdict]),
      h("span", {}, SENTENCES[document.outcome as Verdict]),
      document.compensated_outcome
        ? h(
            "span",
            { dataTest: "compensated" },
            tr`by the compensated program: ${trText(document.compensated_outcome)} with the zero kept, ${trText(document.compensated_zero_set_outcome ?? "")} with it set again`,
          )
        : null,
      document.monte_carlo
        ? h(
            "span",
            { class: "muted", dataTest: "many", title: tr`${document.monte_carlo.samples} machines drawn within u` },
            tr`good on ${share(document.monte_carlo.good_ratio)} of machines`,
          )
        : null,
      h(
        "span",
        { class: "verdict-worst", dataTest: "worst" },
        tr`${trText(nearest.name)}: ${number(100 * nearest.used_ratio, 0)} % of its tolerance`,
      ),
      document.outcome === "pass"
        ? null
        : h(
            "span",
            { class: "verdict-correction", dataTest: "correction" },
            withErrorNames(correction(document.sufficient)),
          ),
    );
    this.showValues(document);
    this.showBudget(nearest);
    this.showSurfaces(document);
    this.map.show(frame);
  }

  /** What the program compensated for the machine would make of the part; asked for, as it cuts the part twice more. */
  private compensation(path: string, document: DrawingHeader["document"]): HTMLElement {
    const is_shown = document.compensated_outcome !== undefined;
    return h(
      "button",
      {
        dataTest: "compensate",
        ariaPressed: String(is_shown),
        title: tr`The part as the program of \`compensate program\` cuts it`,
        onclick: () => this.app.go("predict", { study: path, compensated: is_shown ? null : "true" }),
      },
      tr`Compensate the program`,
    );
  }

  private showValues(document: DrawingHeader["document"]): void {
    const row = (value: CharacteristicValue, i: number): HTMLElement =>
      h(
        "tr",
        { class: i === this.chosen ? "judged" : "", dataSet: value.name, onclick: () => this.pick(document, value, i) },
        h("td", {}, h("button", { class: "link" }, trText(value.name))),
        h("td", { class: "number", dataCell: "value" }, number(1e3 * value.value_mm, 2)),
        h("td", { class: "number muted", dataCell: "u" }, number(1e3 * value.u_mm, 2)),
        h("td", { class: "number muted" }, number(1e3 * value.points_mm, 2)),
        h("td", { class: "number muted" }, number(1e3 * value.nominal_mm, 2)),
        h("td", { class: "number" }, allowed(value)),
        h("td", { class: `used ${value.outcome}` }, `${number(100 * value.used_ratio, 0)} %`),
        value.monte_carlo ? h("td", { class: "number" }, share(value.monte_carlo.good_ratio)) : null,
        compensated("kept", value.compensated),
        compensated("set", value.compensated_zero_set),
      );
    fill(
      this.values,
      h("div", { class: "panel-head" }, h("h2", {}, tr`Characteristics, in µm`)),
      h(
        "table",
        { class: "hole-sets" },
        h(
          "thead",
          {},
          h(
            "tr",
            {},
            h("th", {}, tr`characteristic`),
            h("th", { class: "number" }, tr`value`),
            h("th", { class: "number" }, "u"),
            h("th", { class: "number", title: tr`by how much the value changes with half of the points` }, tr`points`),
            h(
              "th",
              { class: "number", title: tr`what the program leaves on a machine without errors` },
              tr`program alone`,
            ),
            h("th", { class: "number" }, tr`allowed`),
            h("th", {}, tr`used`),
            document.monte_carlo
              ? h(
                  "th",
                  { class: "number", title: tr`the share of machines drawn within u on which it is in tolerance` },
                  tr`good on`,
                )
              : null,
            document.compensated_outcome
              ? h(
                  "th",
                  { class: "number", title: tr`by the compensated program, the zero where it was set before` },
                  tr`zero kept`,
                )
              : null,
            document.compensated_outcome
              ? h(
                  "th",
                  { class: "number", title: tr`the same with the zero set again by compensated motion` },
                  tr`zero set again`,
                )
              : null,
          ),
        ),
        h("tbody", {}, document.characteristics.map(row)),
      ),
    );
  }

  private pick(document: DrawingHeader["document"], value: CharacteristicValue, i: number): void {
    this.chosen = i;
    this.showValues(document);
    this.showBudget(value);
    this.map.mark(document.features.flatMap((f, k) => (value.features.includes(f.name) ? [k] : [])));
  }

  private showBudget(value: CharacteristicValue): void {
    fill(
      this.budget,
      h("div", { class: "panel-head" }, h("h2", {}, tr`Errors in ${trText(value.name)}, in µm`)),
      h(
        "table",
        { class: "hole-sets" },
        h(
          "thead",
          {},
          h(
            "tr",
            {},
            h("th", {}, tr`error`),
            h("th", { class: "number" }, tr`without it`),
            h("th", { class: "number" }, tr`change`),
          ),
        ),
        h(
          "tbody",
          {},
          value.errors.map((effect) =>
            h(
              "tr",
              { dataError: effect.error },
              h("td", {}, withErrorNames(effect.error)),
              h("td", { class: "number" }, number(1e3 * effect.without_mm, 2)),
              h("td", { class: "number" }, number(1e3 * (effect.without_mm - value.value_mm), 2)),
            ),
          ),
        ),
      ),
    );
  }

  private showSurfaces(document: DrawingHeader["document"]): void {
    const cell = (point: CutPoint): HTMLElement =>
      h(
        "td",
        { class: "number", title: placeOf(point) },
        number(1e3 * point.deviation_mm, 2),
        h("span", { class: "muted" }, tr` T${point.tool} line ${point.line}`),
      );
    fill(
      this.surfaces,
      h("div", { class: "panel-head" }, h("h2", {}, tr`Surfaces, deviations in µm`)),
      h(
        "table",
        { class: "hole-sets" },
        h(
          "thead",
          {},
          h(
            "tr",
            {},
            h("th", {}, tr`feature`),
            h("th", { class: "number" }, tr`points`),
            h("th", { class: "number" }, tr`most left`),
            h("th", { class: "number" }, tr`most missing`),
          ),
        ),
        h(
          "tbody",
          {},
          document.features.map((feature) =>
            h(
              "tr",
              { dataFeature: feature.name },
              h("td", {}, feature.name),
              h("td", { class: "number" }, String(feature.points)),
              cell(feature.most),
              cell(feature.least),
            ),
          ),
        ),
      ),
    );
  }
}

const placeOf = (point: CutPoint): string =>
  `${point.nominal_mm.map((c, k) => `${"XYZ"[k]} ${c.toFixed(2)}`).join(" ")} mm`;

/** A value by the compensated program, in the colour of its verdict. */
const compensated = (cell: string, found: CharacteristicValue["compensated"]): HTMLElement | null =>
  found ? h("td", { class: `number ${found.outcome}`, dataCell: cell }, number(1e3 * found.value_mm, 2)) : null;

/** Which single correction would do. */
const correction = (names: readonly string[]): string =>
  names.length === 0
    ? tr`No single correction brings all characteristics into tolerance.`
    : tr`The correction of ${names.join(tr` alone, or of `)} alone brings all characteristics into tolerance.`;

/** What is not all is not called 100 %. */
const share = (ratio: number): string =>
  ratio > 0.999 && ratio < 1 ? "> 99.9 %" : ratio > 0 && ratio < 0.001 ? "< 0.1 %" : `${number(100 * ratio, 1)} %`;

/** What u leaves out. */
function withoutU({ errors_without_u: { length: n } }: DrawingHeader["document"]): string {
  if (n === 0) return "";
  return n === 1
    ? tr`; 1 error of the machine file states no uncertainty and adds nothing to u`
    : tr`; ${n} errors of the machine file state no uncertainty and add nothing to u`;
}

const allowed = (value: CharacteristicValue): string =>
  value.low_mm === null
    ? number(1e3 * value.high_mm, 1)
    : `${number(1e3 * value.low_mm, 1)} … ${number(1e3 * value.high_mm, 1)}`;
