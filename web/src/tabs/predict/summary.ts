/** The verdict, and every index with U against its tolerance. */

import { tr } from "../../words/index.ts";
import type { App } from "../../app.ts";
import { download, fill, h, s } from "../../dom.ts";
import { csvOf, fileName } from "../../figure/figure.ts";
import { NO_NUMBER, number, um } from "../../format.ts";
import {
  expanded,
  indicesOf,
  nameOf,
  titleOf,
  VERDICTS,
  worstOf,
  type IndexValue,
  type Judgement,
  type PieceDocument,
  type Verdict,
} from "./types.ts";

const MEANINGS: Record<Verdict, string> = {
  pass: tr`the part will be in tolerance`,
  fail: tr`the part will be out of tolerance`,
  undecided: tr`the tolerance lies within the uncertainty`,
};

interface Row {
  key: string;
  value: IndexValue;
  judged: Judgement | undefined;
  before: number | undefined;
}

export class Summary {
  readonly element = h("div", { class: "predict-summary" });
  private readonly head = h("div", { class: "panel predict-head" });
  private readonly verdict = h("div", { class: "verdict-band", role: "status" });
  private readonly table = h("div", { class: "panel predict-indices" });
  private readonly app: App;
  /** Low windows show what is judged first. */
  private all = innerHeight > 840;

  constructor(app: App) {
    this.app = app;
    this.element.append(this.head, this.verdict, this.table);
  }

  /** `before` is the prediction of the file while something is changed. */
  show(path: string, document: PieceDocument, before: PieceDocument | null): void {
    this.showHead(path, document);
    this.showVerdict(document, before);
    this.showIndices(document, before);
  }

  private showHead(path: string, document: PieceDocument): void {
    fill(
      this.head,
      h("div", { class: "panel-head" }, h("h1", { dataOwn: "" }, document.study), studyChoice(this.app, path)),
      h(
        "p",
        { class: "muted" },
        document.machine.name,
        "  ",
        h("code", {}, document.machine.chain),
        " · ",
        document.test_piece,
      ),
    );
  }

  private showVerdict(document: PieceDocument, before: PieceDocument | null): void {
    const worst = worstOf(document);
    const word = worst ? VERDICTS[document.verdict] : tr`NO VERDICT`;
    const meaning = worst ? MEANINGS[document.verdict] : tr`the test piece states no tolerance`;
    this.verdict.className = `verdict-band ${worst ? document.verdict : "undecided"}`;
    const changed = before && before.verdict !== document.verdict ? tr`, was ${VERDICTS[before.verdict]}` : "";
    fill(
      this.verdict,
      h("strong", { dataTest: "verdict" }, word),
      h("span", {}, before ? tr`if changed so: ${meaning}${changed}` : meaning),
      worst
        ? h(
            "span",
            { class: "verdict-worst", dataTest: "worst" },
            tr`${titleOf(worst.index)} ${um(1e3 * worst.value_mm)} of ${um(1e3 * worst.tolerance_mm)}, ${number(100 * worst.used_ratio, 0)} % used`,
          )
        : null,
    );
  }

  private showIndices(document: PieceDocument, before: PieceDocument | null): void {
    const every = rowsOf(document, before);
    const judged = every.filter((row) => row.judged);
    const rows = this.all || judged.length === 0 ? every : judged;
    const more = h(
      "button",
      { class: "figure-save", dataTest: "more-indices", onclick: () => this.toggle(document, before) },
      this.all ? tr`only the judged` : tr`all ${every.length}`,
    );
    const most = Math.max(
      1e-9,
      ...rows.map(({ value, judged, before: b }) =>
        Math.max(value.value + expanded(value, judged), judged?.tolerance_mm ?? 0, b ?? 0),
      ),
    );
    const certain = every.every(({ value }) => value.u_mm === 0);
    const u_words = certain ? tr`no uncertainty stated` : tr`U for k = 2`;
    const rule = document.judgements.some((j) => j.expanded_mm !== null)
      ? tr`judged by ISO 14253-1 with U`
      : tr`simple acceptance: value against tolerance; ${u_words}`;
    const save = h(
      "button",
      {
        class: "figure-save",
        ariaLabel: tr`Save the indices as CSV`,
        onclick: () => download(`${fileName(document.study)}-indices.csv`, csv(every), "text/csv"),
      },
      "CSV",
    );
    const words = [tr`index`, ...(before ? [tr`before`] : []), tr`value`, "U", tr`tolerance`, tr`used`, ""];
    fill(
      this.table,
      h(
        "div",
        { class: "panel-head" },
        h("h2", {}, tr`Indices, µm`),
        h("span", { class: "muted" }, rule),
        judged.length > 0 && judged.length < every.length ? more : null,
        save,
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
            words.map((word, i) =>
              h(
                "th",
                {
                  class: i === 0 || word === "" ? "" : "number",
                  title:
                    word === "U"
                      ? tr`expanded uncertainty: that of the decision rule where the study judges by ISO 14253-1, else for k = 2`
                      : null,
                },
                word || h("span", { class: "visually-hidden" }, tr`bar`),
              ),
            ),
          ),
        ),
        h(
          "tbody",
          {},
          rows.map((row) => indexRow(row, most, before !== null)),
        ),
      ),
    );
  }

  private toggle(document: PieceDocument, before: PieceDocument | null): void {
    this.all = !this.all;
    this.showIndices(document, before);
  }
}

/** The judged ones first, then as the document has them. */
function rowsOf(document: PieceDocument, before: PieceDocument | null): Row[] {
  const earlier = before ? indicesOf(before.indices) : null;
  const rows = [...indicesOf(document.indices)].map(([key, value]) => ({
    key,
    value,
    judged: document.judgements.find((j) => j.index === key),
    before: earlier?.get(key)?.value,
  }));
  return [...rows.filter((r) => r.judged), ...rows.filter((r) => !r.judged)];
}

function indexRow({ key, value, judged, before }: Row, most: number, changed: boolean): HTMLElement {
  const cell = (name: string, text: string, kind = ""): HTMLElement =>
    h("td", { class: `number ${kind}`, dataCell: name }, text);
  const u = expanded(value, judged);
  const moved = before !== undefined && number(1e3 * before, 1) !== number(1e3 * value.value, 1);
  return h(
    "tr",
    { class: judged ? `judged ${judged.verdict}` : "unjudged", dataIndex: key },
    h("td", {}, titleOf(key)),
    changed ? cell("before", number(before === undefined ? null : 1e3 * before, 1), "muted") : null,
    cell("value", number(1e3 * value.value, 1), moved ? "moved" : ""),
    cell("U", u === 0 ? NO_NUMBER : number(1e3 * u, 1), "muted"),
    cell("tolerance", judged ? number(1e3 * judged.tolerance_mm, 1) : ""),
    cell("used", judged ? `${number(100 * judged.used_ratio, 0)} %` : "", judged?.verdict ?? ""),
    h(
      "td",
      { class: "bar-cell" },
      bar(
        value.value / most,
        u / most,
        judged ? judged.tolerance_mm / most : null,
        judged?.verdict,
        changed ? (before ?? 0) / most : null,
      ),
    ),
  );
}

const COLOURS: Record<Verdict, string> = { pass: "var(--good)", fail: "var(--bad)", undecided: "var(--warn)" };

/** Value, ± U, tolerance as a tick, all as shares of the width. */
function bar(
  value: number,
  u: number,
  tolerance: number | null,
  verdict: Verdict | undefined,
  before: number | null,
): SVGSVGElement {
  const x = (share: number): number => 2 + 116 * Math.max(0, Math.min(1, share));
  const svg = s("svg", {
    viewBox: "0 0 120 14",
    preserveAspectRatio: "none",
    class: "index-bar",
    "aria-hidden": "true",
  });
  svg.append(
    s("rect", {
      x: 2,
      y: 4,
      width: Math.max(1, x(value) - 2),
      height: 6,
      fill: verdict ? COLOURS[verdict] : "var(--line-strong)",
    }),
  );
  svg.append(
    s("line", { x1: x(value - u), x2: x(value + u), y1: 7, y2: 7, stroke: "var(--ink)", "stroke-width": 1.2 }),
  );
  if (before !== null)
    svg.append(
      s("path", { d: `M${x(before)} 1v12`, stroke: "var(--muted)", "stroke-width": 1, "stroke-dasharray": "2 2" }),
    );
  if (tolerance !== null)
    svg.append(s("path", { d: `M${x(tolerance)} 0v14`, stroke: "var(--ink)", "stroke-width": 2 }));
  return svg;
}

function csv(rows: readonly Row[]): string {
  return csvOf([
    { heading: "index", values: rows.map((r) => nameOf(r.key)) },
    { heading: "value (um)", values: rows.map((r) => 1e3 * r.value.value) },
    { heading: "u (um)", values: rows.map((r) => 1e3 * r.value.u_mm) },
    { heading: "tolerance (um)", values: rows.map((r) => (r.judged ? 1e3 * r.judged.tolerance_mm : null)) },
    { heading: "verdict", values: rows.map((r) => r.judged?.verdict ?? null) },
    { heading: "in the file (um)", values: rows.map((r) => (r.before === undefined ? null : 1e3 * r.before)) },
  ]);
}

/** The studies of the folder, and the way to the report. */
export function studyChoice(app: App, path: string): HTMLElement {
  const files = app.state.project?.files.filter((f) => f.kind === "study") ?? [];
  const choose = h(
    "select",
    { ariaLabel: tr`Study`, onchange: () => app.go("predict", { study: choose.value }) },
    [...new Set([path, ...files.map((f) => f.path)])].map((p) => h("option", { value: p }, p)),
  );
  choose.value = path;
  return h(
    "span",
    { class: "predict-choice" },
    choose,
    h("button", { onclick: () => app.go("report", { verb: "predict", file: path }) }, tr`Report`),
  );
}
