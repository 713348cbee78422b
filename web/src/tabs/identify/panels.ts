/** Verdict, scores, errors with their uncertainty, what is not observable: the result of an identification. */

import { told } from "../../words/told.ts";
import { tr, trText } from "../../words/index.ts";
import { diagnosticList } from "../../app.ts";
import { h } from "../../dom.ts";
import { bars, type Bar, type BarSpec, type Figure } from "../../figure/index.ts";
import { number, withUnit } from "../../format.ts";
import { withErrorNames } from "../../glossary/glossary.ts";
import { sheetTable, type Sheet } from "../measure/table.ts";
import { count } from "../measure/words.ts";
import {
  unitOf,
  foundValue,
  type Found,
  type IdentifyDocument,
  type IdentifyHeader,
  type Score,
  type Unit,
  type Unobservable,
} from "./documents.ts";

export function verdictPanel(doc: IdentifyDocument): HTMLElement {
  const { verdict } = doc;
  const known = doc.errors.filter((one) => foundValue(one) !== null).length;
  const all = doc.errors.length;
  const found =
    all === 0
      ? tr`no error of the machine is unknown`
      : all === 1
        ? tr`${known} of 1 error found`
        : tr`${known} of ${all} errors found`;
  return h(
    "section",
    { class: "panel" },
    h("h1", { dataOwn: true }, doc.name),
    h(
      "p",
      { class: `verdict ${verdict.good ? "" : "bad"}`, role: "status", dataTest: "verdict" },
      h("span", { class: "verdict-word" }, verdict.good ? tr`Good` : tr`Not good`),
      told("span", {}, verdict.words),
    ),
    h(
      "p",
      { class: "muted" },
      tr`${count(doc.readings, "reading")} in ${count(doc.places, "place")}: ${found}. Rank ${doc.rank}, condition ${number(doc.condition, 1)}.`,
    ),
    doc.left_out.length > 0
      ? h("p", { class: "muted note" }, tr`Not supported by the readings, and left out: ${doc.left_out.join(", ")}.`)
      : null,
  );
}

/** The four scores side by side: the residual must be as small as the repeatability of the instrument. */
export function scorePanel(doc: IdentifyDocument): HTMLElement {
  const rows: [string, string, Score | null][] = [
    ["without_model", tr`without errors of the machine, set-up only`, doc.rms.without_model],
    ["in_sample", tr`in sample`, doc.rms.in_sample],
    ["held_out", tr`held out, by place`, doc.rms.held_out],
    [
      "repeatability",
      doc.repeatability_is_measured ? tr`repeatability, from repeated readings` : tr`repeatability, as stated`,
      doc.rms.repeatability,
    ],
  ];
  const there = rows.filter((row): row is [string, string, Score] => row[2] !== null);
  const most = Math.max(1e-9, ...there.map(([, , score]) => score.times_noise ?? 0));
  const units = (["um", "urad"] as const).filter((unit) => there.some(([, , score]) => score[unit] !== null));
  return h(
    "section",
    { class: "panel", dataSheet: "scores" },
    h("h2", {}, tr`Root mean square of the residuals`),
    h(
      "table",
      {},
      h(
        "thead",
        {},
        h(
          "tr",
          {},
          h("td", {}),
          h("th", {}, h("span", { class: "visually-hidden" }, tr`Bar`)),
          units.map((unit) => h("th", { class: "number" }, unit === "um" ? "µm" : "µrad")),
          h("th", { class: "number" }, tr`× noise`),
        ),
      ),
      h(
        "tbody",
        {},
        there.map(([key, label, score]) =>
          h(
            "tr",
            { dataScore: key },
            h("td", {}, label),
            h(
              "td",
              { class: "score-cell" },
              h("span", {
                class: `score-bar ${key === "without_model" ? "muted-bar" : ""}`,
                style: { width: `${(100 * (score.times_noise ?? 0)) / most}%` },
              }),
            ),
            units.map((unit) => h("td", { class: "number" }, number(score[unit], 3))),
            h("td", { class: "number" }, number(score.times_noise, 2)),
          ),
        ),
      ),
    ),
  );
}

function barOf(found: Found): Bar {
  const value = foundValue(found);
  if (value === null) return { name: found.name, value: null, missing: tr`not observable with these readings` };
  const weak = found.z !== null && Math.abs(found.z) < 2;
  return {
    name: found.name,
    value,
    u: found.u,
    note: `z = ${number(found.z, 1)}`,
    ...(weak ? { colour: "var(--line-strong)" } : {}),
  };
}

/** Bars of one group, lengths and angles apart. */
export function foundPanel(
  title: string,
  found: readonly Found[],
  note: string,
): { panel: HTMLElement; figures: Figure<BarSpec>[] } {
  const panel = h("section", { class: "panel" });
  const figures: Figure<BarSpec>[] = [];
  for (const unit of ["µm", "µrad"] as Unit[]) {
    const own = found.filter((one) => unitOf(one) === unit);
    if (own.length > 0)
      figures.push(
        bars(panel, {
          title: `${title}, ${unit === "µm" ? tr`lengths` : tr`angles`}`,
          unit,
          digits: 1,
          bars: own.map(barOf),
        }),
      );
  }
  panel.append(h("p", { class: "muted note" }, note));
  return { panel, figures };
}

export function valueSheet(doc: IdentifyDocument): Sheet {
  const rows = [...doc.errors, ...doc.setup].map((one) => [one.name, foundValue(one), one.u, unitOf(one), one.z]);
  return {
    key: "values",
    title: tr`All values`,
    head: (tr) => [tr`unknown`, tr`value`, tr`standard uncertainty u`, tr`unit`, tr`z = value / u`],
    rows,
    digits: [undefined, 3, 3, undefined, 1],
  };
}

export function confoundedPanel(unobservable: readonly Unobservable[], good: string): HTMLElement {
  const n = unobservable.length;
  return h(
    "section",
    { class: "panel", dataTest: "confounded" },
    h(
      "h2",
      {},
      n === 0
        ? tr`Not separable`
        : n === 1
          ? tr`1 combination that cannot be separated`
          : tr`${n} combinations that cannot be separated`,
    ),
    n === 0
      ? h("p", {}, good)
      : h(
          "ul",
          { class: "confounded" },
          unobservable.map((one) =>
            h(
              "li",
              {},
              told("p", {}, one.words, withErrorNames),
              one.resolve_with
                ? h("p", { class: "muted" }, tr`What would tell: `, told("span", {}, one.resolve_with))
                : null,
              h("p", { class: "muted" }, h("code", {}, withErrorNames(one.combination))),
            ),
          ),
        ),
  );
}

/** Pairs that the readings hold together strongly, in words; the same bound as on the command line. */
const STRONG = 0.9;

export function strongPairs(names: readonly string[], correlation: ArrayLike<number>): { words: string; r: number }[] {
  const n = names.length;
  const pairs: { words: string; r: number }[] = [];
  for (let i = 0; i < n; i++) {
    for (let j = i + 1; j < n; j++) {
      const r = correlation[i * n + j] as number;
      const signed = `${r > 0 ? "+" : ""}${number(r, 3)}`;
      if (Math.abs(r) > STRONG)
        pairs.push({
          r,
          words:
            r < 0
              ? tr`${names[i]} and ${names[j]} (${signed}): their sum is better known than each`
              : tr`${names[i]} and ${names[j]} (${signed}): their difference is better known than each`,
        });
    }
  }
  return pairs.sort((a, b) => Math.abs(b.r) - Math.abs(a.r)).slice(0, 10);
}

export function outlierPanel(doc: IdentifyDocument): HTMLElement {
  const sheets: Sheet[] = [
    {
      key: "outliers",
      title: tr`Outliers`,
      head: (tr) => [tr`reading`, tr`channel`, tr`studentised residual`],
      rows: doc.outliers.map((o) => [`${o.file}:${o.line}`, o.channel, o.studentised]),
      digits: [undefined, 0, 1],
    },
    {
      key: "influence",
      title: tr`Readings that move the result most`,
      head: (tr) => [tr`reading`, tr`leverage`, tr`Cook’s distance`],
      rows: doc.most_influential.map((m) => [`${m.file}:${m.line}`, m.leverage, m.cook]),
      digits: [undefined, 3, 4],
    },
    {
      key: "follows",
      title: tr`Whether the residual follows the axes`,
      head: (tr) => [tr`places by`, tr`share of it, held out, %`],
      rows: doc.residual_follows.map((f) => [trText(f.what), 100 * f.share]),
      digits: [undefined, 1],
      note: tr`Above zero: something of the machine is left that the model does not have.`,
    },
  ];
  const [outliers, ...more] = sheets as [Sheet, ...Sheet[]];
  return h(
    "div",
    {},
    doc.outliers.length > 0
      ? sheetTable(outliers)
      : h(
          "section",
          { class: "panel", dataSheet: "outliers" },
          h("h2", {}, tr`Outliers`),
          h(
            "p",
            {},
            tr`None: no reading is farther off than ${withUnit(doc.outlier_limit, 1, "")} times its standard uncertainty.`,
          ),
        ),
    more.map(sheetTable),
    doc.diagnostics.length > 0
      ? h("section", { class: "panel" }, h("h2", {}, tr`Remarks`), diagnosticList(doc.diagnostics))
      : null,
  );
}

/** "machine-identified.toml" of "machines/lei-hsu-mill/machine.toml". */
export function identifiedName({ machine }: IdentifyHeader): string {
  return (machine ?? "machine.toml").replace(/^.*\//, "").replace(/(\.[^.]*)?$/, "-identified.toml");
}
