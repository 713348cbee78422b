/** Deviation before and after, changed lines, residual deviation with tables: the results of a compensation. */

import { tr, trText } from "../../words/index.ts";
import { h } from "../../dom.ts";
import { bars, lineChart, type Figure } from "../../figure/index.ts";
import type { Series } from "../../figure/chart.ts";
import { number } from "../../format.ts";
import type { Shown } from "../measure/shown.ts";
import { sheetTable, type Cell } from "../measure/table.ts";
import type { AdaptReply, ProgramHeader, TablesReply, ValuesReply } from "./documents.ts";

export interface Drawn {
  panel: HTMLElement;
  figures: Figure<never>[];
}

type ProgramDocument = ProgramHeader["document"];
type Residual = ProgramDocument["before"];

/** Largest and root mean square of the deviation of the tool, and the lines where it is largest. */
export function deviationTable({ before, after, ends_compared, uncertainty }: ProgramDocument): HTMLElement {
  const largest = (
    words: string,
    unit: string,
    key: "tip_at_ends_um" | "tip_between_um" | "axis_at_ends_urad" | "axis_between_urad",
  ): Cell[] => [words, unit, before[key].value, before[key].line, after[key].value, after[key].line];
  const rms = (words: string, unit: string, of: (residual: Residual) => number): Cell[] => [
    words,
    unit,
    of(before),
    null,
    of(after),
    null,
  ];
  const u =
    uncertainty.places > 0 && uncertainty.largest_u_um > 0
      ? tr` Standard uncertainty of the tip by the model: at most ${number(uncertainty.largest_u_um, 3)} µm (k = 1) at ${uncertainty.places} places.`
      : tr` The machine file states no uncertainties: those of the corrections are not known.`;
  return sheetTable({
    title: tr`Deviation of the actual tool, before and after`,
    key: "deviations",
    head: ["", tr`unit`, tr`before`, tr`at line`, tr`after`, tr`at line`],
    digits: [undefined, undefined, 3, 0, 3, 0],
    rows: [
      largest(tr`tip at the ends of blocks, largest`, "µm", "tip_at_ends_um"),
      rms(tr`tip at the ends of blocks, rms`, "µm", (residual) => residual.tip_at_ends_rms_um),
      largest(tr`tip between them, largest`, "µm", "tip_between_um"),
      largest(tr`tool axis at the ends of blocks, largest`, "µrad", "axis_at_ends_urad"),
      rms(tr`tool axis at the ends of blocks, rms`, "µrad", (residual) => residual.axis_at_ends_rms_urad),
      largest(tr`tool axis between them, largest`, "µrad", "axis_between_urad"),
    ],
    note: tr`The written program, read back and simulated on the actual machine, against the program as it was on the nominal machine; ${ends_compared} ends of blocks. Curves: the largest deviation in each block. Lines are those of the program as it was.${u}`,
  });
}

/** Deviation along the program before and after, and the residual deviation on a scale of its own. */
export function alongPanel(host: HTMLElement, header: ProgramHeader, along: Float64Array): Figure<never>[] {
  const column = (j: number): number[] =>
    Array.from({ length: Math.floor(along.length / 5) }, (_, i) => along[5 * i + j] as number);
  const [line, tip_before, tip_after, axis_before, axis_after] = [0, 1, 2, 3, 4].map(column) as [
    number[],
    number[],
    number[],
    number[],
    number[],
  ];
  if (line.length === 0) return [];
  const { document } = header;
  const one = (name: string, y: number[], colour: string): Series => ({
    name,
    x: line,
    y,
    colour,
    ...(line.length === 1 ? { points: true } : {}),
  });
  const x = { label: tr`line of the program as it was`, digits: 0 };
  const chart = (title: string, unit: string, series: Series[], limit?: number): Figure<never> =>
    lineChart(host, {
      title,
      x,
      y: { label: tr`deviation`, unit, min: 0 },
      series,
      ...(limit === undefined
        ? {}
        : { limits: [{ value: limit, label: tr`residual asked for: ${number(limit, 1)} ${unit}` }] }),
      height: 210,
    }) as unknown as Figure<never>;
  const figures = [
    chart(tr`Tip, before and after`, "µm", [
      one(tr`before`, tip_before, "var(--actual)"),
      one(tr`after`, tip_after, "var(--series-1)"),
    ]),
    chart(
      tr`Tip, residual deviation`,
      "µm",
      [one(tr`after`, tip_after, "var(--series-1)")],
      1e3 * document.residual_mm,
    ),
  ];
  if (Math.max(...axis_before, ...axis_after) > 1e-6)
    figures.push(
      chart(tr`Tool axis, before and after`, "µrad", [
        one(tr`before`, axis_before, "var(--actual)"),
        one(tr`after`, axis_after, "var(--series-1)"),
      ]),
    );
  return figures;
}

/** Lines as they were and as they are, side by side. */
export function changesPanel(header: ProgramHeader): HTMLElement | null {
  const { changes, made } = header;
  const text = made.files[0];
  if (!changes) {
    if (!text) return null;
    return h(
      "section",
      { class: "panel", dataTest: "new-text" },
      h("h2", {}, tr`The new program`),
      h(
        "p",
        { class: "muted" },
        text.whole
          ? tr`The program was unrolled: its lines are not those of the program as it was.`
          : tr`The program was unrolled: its lines are not those of the program as it was. This is its beginning.`,
      ),
      h("pre", { class: "program tall", tabindex: "0" }, text.beginning),
    );
  }
  const shown = changes.lines.length;
  const words =
    changes.changed === 0
      ? tr`No line has changed.`
      : tr`${changes.changed} of ${changes.of} lines have changed${shown < changes.changed ? tr`; the first ${shown} of them` : ""}.`;
  return h(
    "section",
    { class: "panel", dataTest: "changes" },
    h("h2", {}, tr`Changed lines`),
    h("p", { class: "muted" }, words),
    shown === 0
      ? null
      : h(
          "div",
          { class: "changes", tabindex: "0", role: "region", ariaLabel: tr`Changed lines` },
          h(
            "table",
            {},
            h(
              "thead",
              {},
              h(
                "tr",
                {},
                h("th", { class: "number" }, tr`line`),
                h("th", {}, tr`as it was`),
                h("th", {}, tr`compensated`),
              ),
            ),
            h(
              "tbody",
              {},
              changes.lines.map(({ line, was, is }) =>
                h(
                  "tr",
                  { dataLine: line },
                  h("td", { class: "number muted" }, String(line)),
                  h("td", {}, h("code", {}, was)),
                  h("td", {}, h("code", {}, is.join("\n"))),
                ),
              ),
            ),
          ),
        ),
  );
}

// ---- tables of a control ----

/** Deviation over the travel without tables, with them, and if the control took them with the wrong sign. */
export function leftTable({ document }: TablesReply): HTMLElement {
  const row = (words: string, of: TablesReply["document"]["before_um"]): Cell[] => [
    words,
    of.max,
    of.rms,
    of.axis_urad,
    Object.entries(of.at)
      .map(([axis, value]) => `${axis} ${number(value, 1)}`)
      .join(" "),
  ];
  return sheetTable({
    title: tr`Deviation of the tool over the travel of all axes`,
    key: "left",
    head: ["", tr`tip largest, µm`, tr`tip rms, µm`, tr`tool axis largest, µrad`, tr`largest at, mm and °`],
    digits: [undefined, 3, 3, 3, undefined],
    rows: [
      row(tr`without tables`, document.before_um),
      row(tr`with tables`, document.left_um),
      row(tr`with tables, part zero set again`, document.left_zero_set_um),
      row(tr`with the wrong sign`, document.wrong_sign_um),
    ],
    note: tr`The files, read back and applied as the control does, at ${document.left_um.poses} poses, each reached from both sides. A wrong sign is about twice as bad as no table: try one position on the machine first.`,
  });
}

/** What the tables are good for, in one sentence. */
export function tablesVerdict({ document }: TablesReply): Shown["verdict"] {
  const { before_um: before, left_um: left } = document;
  const better = left.max < before.max;
  return {
    standing: better ? "good" : "bad",
    word: better ? tr`BETTER` : tr`NOT BETTER`,
    sentence: tr`with the tables the tip deviates by up to ${number(left.max, 1)} µm instead of ${number(before.max, 1)} µm over the travel, rms ${number(left.rms, 1)} µm instead of ${number(before.rms, 1)} µm`,
  };
}

/** Each error that the tables cannot hold: what it costs without and with them. */
export function cannotPanel({ document }: TablesReply): Drawn {
  const { cannot, represents } = document;
  const panel = h("section", { class: "panel", dataTest: "cannot" }, h("h2", {}, tr`What the tables cannot represent`));
  const figures: Figure<never>[] = [];
  if (cannot.length === 0) panel.append(h("p", {}, tr`Nothing: all errors of the machine file are in the tables.`));
  else {
    panel.append(
      h(
        "p",
        { class: "muted" },
        represents.length === 0
          ? tr`Each alone on the machine: the largest deviation of the tip that is left with the tables. Represented: none.`
          : tr`Each alone on the machine: the largest deviation of the tip that is left with the tables. Represented: ${represents.join(", ")}.`,
      ),
    );
    const host = h("div", {});
    panel.append(host);
    figures.push(
      bars(host, {
        title: tr`Left with the tables`,
        unit: "µm",
        bars: cannot.map((one) => ({ name: one.error, value: one.left_um, note: trText(one.instead) })),
        digits: 2,
      }) as unknown as Figure<never>,
    );
    panel.append(
      sheetTable({
        title: tr`Errors left`,
        key: "cannot",
        head: [tr`error`, tr`without tables, µm`, tr`with tables, µm`, tr`compensate it instead`],
        digits: [undefined, 3, 3, undefined],
        rows: cannot.map((one) => [one.error, one.before_um, one.left_um, trText(one.instead)]),
      }),
    );
  }
  return { panel, figures };
}

// ---- values of an axis ----

/** The values over the travel, with the uncertainty of the error that they undo. */
export function valuesPanel({ document }: ValuesReply): Drawn {
  const panel = h("section", { class: "panel" });
  const figures: Figure<never>[] = [];
  for (const axis of document.axes) {
    const linear = axis.positions.some((one) => "position_mm" in one);
    const [place, unit, of] = linear
      ? (["position_mm", "µm", "um"] as const)
      : (["position_deg", "µrad", "urad"] as const);
    const read = (one: (typeof axis.positions)[number], key: string): number => {
      const value = (one as Record<string, unknown>)[key];
      return typeof value === "number" ? value : Number.NaN;
    };
    const x = axis.positions.map((one) => read(one, place));
    const y = axis.positions.map((one) => read(one, `value_${of}`));
    const u = axis.positions.map((one) => read(one, `u_${of}`));
    const has_u = u.every((value) => Number.isFinite(value));
    const host = h("div", {});
    panel.append(host);
    figures.push(
      lineChart(host, {
        title: tr`Values to be added to ${axis.axis}`,
        x: { label: tr`position of ${axis.axis}`, unit: linear ? "mm" : "°" },
        y: { label: tr`value`, unit },
        series: [{ name: tr`value`, x, y, points: true, ...(has_u ? { u } : {}) }],
      }) as unknown as Figure<never>,
    );
    panel.append(
      h(
        "p",
        { class: "muted note" },
        tr`In least increments of ${axis.increment}; the control adds them to the command.${has_u ? tr` Whiskers: ± 2u of the error that is compensated, about 95 %.` : tr` The machine file states no uncertainty for this axis.`}`,
      ),
    );
  }
  return { panel, figures };
}

// ---- a path on a measured blank ----

/** The wall that remains at each place of the map, as programmed and adapted. */
export function wallPanel({ document }: AdaptReply): Drawn {
  const panel = h("section", { class: "panel" });
  const x = document.map.map((_, i) => i + 1);
  const chart = (title: string, series: Series[]): Figure<never> => {
    const host = h("div", {});
    panel.append(host);
    return lineChart(host, {
      title,
      x: { label: tr`place of the map`, digits: 0 },
      y: { label: tr`wall`, unit: "mm", digits: 4 },
      series,
      limits: [{ value: document.wall.least_mm, label: tr`least: ${number(document.wall.least_mm, 3)} mm` }],
      height: 230,
    }) as unknown as Figure<never>;
  };
  const before = document.map.map((cell) => cell.wall_before_mm);
  const after = document.map.map((cell) => cell.wall_after_mm);
  const u = document.map.map((cell) => cell.u_wall_mm);
  const figures = [
    chart(tr`Remaining wall, as programmed and adapted`, [
      { name: tr`as programmed`, x, y: before, colour: "var(--actual)" },
      { name: tr`adapted`, x, y: after, colour: "var(--series-1)" },
    ]),
    chart(tr`Remaining wall, adapted`, [{ name: tr`adapted`, x, y: after, u, colour: "var(--series-1)" }]),
  ];
  panel.append(
    h(
      "p",
      { class: "muted note" },
      tr`Places row by row around the part. Band: ± 2u of the wall, about 95 %. Below zero the wall is cut through.`,
    ),
  );
  return { panel, figures };
}
