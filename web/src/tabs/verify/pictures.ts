/** The pictures of what was verified, drawn from the documents of `trueaxis verify`. */

import { tr, trText } from "../../words/index.ts";
import type { ServeVerify } from "../../../types.d.ts";
import { h } from "../../dom.ts";
import { bars, lineChart, scatter, type Figure } from "../../figure/index.ts";
import type { Limit, Series } from "../../figure/chart.ts";
import { number } from "../../format.ts";
import { unitText } from "../measure/words.ts";

export type VerifyReply = ServeVerify;
type Document = VerifyReply["document"];
type Of<S extends Document["schema"]> = Extract<Document, { schema: S }>;
type Drawn = Figure<never>[];

/** Most charts of a history that are drawn at once. */
const MOST_CHARTS = 24;

const as = (figure: unknown): Figure<never> => figure as Figure<never>;

/** The numbers of one unit of entries whose keys end with it. */
function keyed(entry: object, key: string): number {
  const value = (entry as Record<string, unknown>)[key];
  return typeof value === "number" ? value : Number.NaN;
}

/** Measured − expected of every reading, each with its U. */
function readings(host: HTMLElement, document: Of<"trueaxis/verify/1">): Drawn {
  const drawn: Drawn = [];
  for (const unit of ["um", "urad"]) {
    const all = document.deviations.filter((one) => Number.isFinite(keyed(one, `deviation_${unit}`)));
    if (all.length === 0) continue;
    const nameOf = (one: (typeof all)[number]): string => tr`${one.instrument}, channel ${one.channel + 1}`;
    const names = [...new Set(all.map(nameOf))];
    const series = names.map((name): Series => {
      const mine = all.filter((one) => nameOf(one) === name);
      return {
        name,
        x: mine.map((one) => one.line),
        y: mine.map((one) => keyed(one, `deviation_${unit}`)),
        // Whiskers are twice this long: U.
        u: mine.map((one) => keyed(one, `expanded_${unit}`) / 2),
      };
    });
    drawn.push(
      as(
        scatter(host, {
          title: tr`Measured − expected, with U (k = ${number(document.coverage_factor, 0)})`,
          x: { label: tr`line of the readings`, digits: 0 },
          y: { label: tr`deviation`, unit: unitText(unit) },
          series,
          height: 300,
        }),
      ),
    );
  }
  return drawn;
}

/** What has moved, and what that does to the tip. */
function calibrations(host: HTMLElement, document: Of<"trueaxis/diff/1">): Drawn {
  const drawn: Drawn = [];
  const colours: Record<string, string> = { yes: "var(--bad)", perhaps: "var(--warn)" };
  for (const unit of ["um", "urad"]) {
    // What has changed comes first.
    const order = ({ moved }: (typeof document.errors)[number]): number => ["yes", "perhaps", moved].indexOf(moved);
    const all = document.errors
      .filter((one) => one.unit === unit && one.change !== null)
      .sort((a, b) => order(a) - order(b));
    if (all.length === 0) continue;
    drawn.push(
      as(
        bars(host, {
          title: tr`Change of each error, ${unitText(unit)}`,
          unit: unitText(unit),
          digits: 2,
          bars: all.map((one) => ({
            name: one.error,
            value: one.change,
            u: one.u_change,
            colour: colours[one.moved] ?? "var(--line-strong)",
            note: tr`changed: ${trText(one.moved)}${one.E_n === null ? "" : `, E_n ${number(one.E_n, 2)}`}`,
          })),
        }),
      ),
    );
  }
  host.append(
    h(
      "p",
      { class: "muted note picture-note" },
      tr`New − old where the change is clearest; whiskers ± 2u, about 95 %. Red: changed significantly; amber: perhaps; grey: no.`,
    ),
  );
  const shares = document.tip.shares.filter((one) => one.largest_um > 0).slice(0, 20);
  if (shares.length > 0)
    drawn.push(
      as(
        bars(host, {
          title: tr`What the change of each error alone does to the tip, largest`,
          unit: "µm",
          digits: 2,
          bars: shares.map((one) => ({ name: one.error, value: one.largest_um })),
        }),
      ),
    );
  return drawn;
}

/** 2026-03-05 as 2026.17. */
function year(date: string): number {
  const at = new Date(`${date}T00:00:00Z`);
  const of = at.getUTCFullYear();
  const [from, to] = [Date.UTC(of, 0, 1), Date.UTC(of + 1, 0, 1)];
  return of + (at.getTime() - from) / (to - from);
}

/** Figures over the calibrations; those that need attention first. */
function history(host: HTMLElement, document: Of<"trueaxis/history/1">): Drawn {
  const is_loud = (one: (typeof document.series)[number]): boolean =>
    one.jumps.length > 0 || one.outside.length > 0 || one.exceeded === true;
  const all = [...document.series].sort((a, b) => Number(is_loud(b)) - Number(is_loud(a)));
  const chart = (one: (typeof all)[number]): Figure<never> => {
    const { control_limits, limit } = one;
    const unit = unitText(one.unit);
    const sides = one.points.some((point) => point.value < 0) ? [-1, 1] : [1];
    const limits: Limit[] = [
      ...(control_limits
        ? [
            { value: control_limits[0], label: tr`lower control limit` },
            { value: control_limits[2], label: tr`upper control limit` },
          ]
        : []),
      ...(limit === null
        ? []
        : sides.map((side) => ({ value: side * limit, label: tr`limit ${number(side * limit, 1)} ${unit}` }))),
    ];
    const has_u = one.points.every((point) => point.u !== null);
    return as(
      lineChart(host, {
        title: is_loud(one) ? tr`${one.figure} – needs attention` : one.figure,
        x: { label: tr`year`, digits: 2 },
        y: { label: one.figure, unit },
        series: [
          {
            name: one.figure,
            x: one.points.map((point) => year(point.date)),
            y: one.points.map((point) => point.value),
            points: true,
            ...(has_u ? { u: one.points.map((point) => point.u as number) } : {}),
          },
        ],
        limits,
        height: 190,
      }),
    );
  };
  const drawn = all.slice(0, MOST_CHARTS).map(chart);
  const words = tr`Whiskers: ± 2u, about 95 %.${all.length > MOST_CHARTS ? tr` The first ${MOST_CHARTS} of ${all.length} figures.` : ""}`;
  host.append(h("p", { class: "muted note picture-note" }, words));
  return drawn;
}

/** Every pose of the validation: before, after, what was predicted, the limit. */
function certificate(host: HTMLElement, document: Of<"trueaxis/certificate/1">): Drawn {
  const { poses, expanded_um } = document.validation;
  const x = poses.map((_, i) => i + 1);
  const one = (name: string, y: number[], more: Partial<Series> = {}): Series => ({
    name,
    x,
    y,
    line: false,
    points: true,
    ...more,
  });
  const before = one(
    tr`before`,
    poses.map((pose) => pose.length_before_um),
    { colour: "var(--actual)" },
  );
  const after = one(
    tr`after`,
    poses.map((pose) => pose.length_after_um),
    {
      colour: "var(--series-1)",
      // Whiskers are twice this long: U.
      u: poses.map(() => expanded_um / 2),
    },
  );
  const within = one(
    tr`predicted to be within (95 %)`,
    poses.map((pose) => pose.predicted_within_um),
    {
      colour: "var(--muted)",
      line: true,
      points: false,
      dash: "4 3",
    },
  );
  const limit = { value: document.decision.limit_um, label: tr`limit ${number(document.decision.limit_um, 1)} µm` };
  const chart = (title: string, series: Series[]): Figure<never> =>
    as(
      scatter(host, {
        title,
        x: { label: tr`pose of the validation`, digits: 0 },
        y: { label: tr`deviation of the tip`, unit: "µm", min: 0 },
        series,
        limits: [limit],
        height: 240,
      }),
    );
  const drawn = [
    chart(tr`Deviation of the tip, without and with the compensation`, [before, after]),
    chart(tr`Deviation of the tip with the compensation`, [after, within]),
  ];
  const words = tr`Whiskers: U of one coordinate of a reading, ${number(expanded_um, 2)} µm (k = ${number(document.decision.coverage_factor, 0)}).`;
  host.append(h("p", { class: "muted note picture-note" }, words));
  return drawn;
}

/** By the names of the document. */
const COMPENSATIONS: Readonly<Record<string, string>> = {
  none: tr`compensation: none`,
  machine: tr`compensation: machine`,
  comprehensive: tr`compensation: comprehensive`,
};

/** What each laser reads on each path under each compensation. */
function lasers(host: HTMLElement, document: Of<"trueaxis/before-after/1">): Drawn {
  const paths = [...new Set(document.curves.map((curve) => `${curve.laser}, ${curve.path}`))];
  const colours: Record<string, string> = {
    none: "var(--actual)",
    machine: "var(--series-5)",
    comprehensive: "var(--series-1)",
  };
  return paths.map((path) => {
    const curves = document.curves.filter((curve) => `${curve.laser}, ${curve.path}` === path);
    const series = curves.flatMap((curve): Series[] =>
      (["up_um", "down_um"] as const)
        .filter((side) => curve.targets.some((target) => target[side] !== null))
        .map((side) => ({
          name: COMPENSATIONS[curve.compensation] ?? curve.compensation,
          x: curve.targets.map((target) => target.target_mm),
          y: curve.targets.map((target) => target[side] ?? Number.NaN),
          colour: colours[curve.compensation] ?? "var(--series-3)",
          quiet: side === "down_um",
          ...(side === "down_um" ? { dash: "4 3" } : {}),
        })),
    );
    return as(
      lineChart(host, {
        title: tr`${path}: mean deviation at each target`,
        x: { label: tr`target on ${curves[0]?.axis ?? ""}`, unit: "mm", digits: 1 },
        y: { label: tr`deviation`, unit: "µm" },
        series,
        height: 250,
      }),
    );
  });
}

/** Indices as measured and as predicted, and the sections that were measured by points. */
function part(host: HTMLElement, document: Of<"trueaxis/verify-part/1">): Drawn {
  const um = (mm: number | null | undefined): number | null => (mm === null || mm === undefined ? null : 1e3 * mm);
  const measured = document.indices.map((one) => ({
    name: trText(one.index.replace(/_mm$/, "").replaceAll("_", " ")),
    value: um(one.mean_mm ?? one.measured_mm[0]),
    u: um(one.u_mean_mm ?? one.u_measured_mm?.[0]),
    note: one.tolerance_mm === null ? "" : tr`limit ${number(1e3 * one.tolerance_mm, 1)} µm`,
  }));
  const predicted = document.indices.map((one, i) => ({
    name: measured[i]?.name ?? "",
    value: um(one.predicted_mm),
    missing: tr`not predicted`,
    u: um(one.u_predicted_mm),
  }));
  const of = (one: { value: number | null; u: number | null }): number => (one.value ?? 0) + 2 * (one.u ?? 0);
  const max = Math.max(1e-9, ...measured.map(of), ...predicted.map(of));
  const drawn = [
    as(bars(host, { title: tr`Measured, mean of the parts`, unit: "µm", digits: 1, bars: measured, max })),
    as(bars(host, { title: tr`Predicted`, unit: "µm", digits: 1, bars: predicted, max })),
  ];
  host.append(h("p", { class: "muted note picture-note" }, tr`Whiskers: ± 2u, about 95 %; both on one scale.`));
  const sections = document.sections.filter((one) => one.part === 1).slice(0, 8);
  if (sections.length > 0)
    drawn.push(
      as(
        lineChart(host, {
          title: tr`Points of part 1, normal deviation in each section`,
          x: { label: tr`azimuth`, unit: "°", digits: 1 },
          y: { label: tr`deviation; above 0: material left`, unit: "µm" },
          series: sections.map((one) => ({
            name: `z ${number(one.z_mm, 1)} mm`,
            x: one.azimuth_deg,
            y: one.e_mm.map((value) => 1e3 * value),
          })),
          height: 250,
        }),
      ),
    );
  return drawn;
}

/** The pictures of a document; some have none. */
export function pictures(host: HTMLElement, document: Document): Drawn {
  switch (document.schema) {
    case "trueaxis/verify/1":
      return readings(host, document);
    case "trueaxis/diff/1":
      return calibrations(host, document);
    case "trueaxis/history/1":
      return history(host, document);
    case "trueaxis/certificate/1":
      return certificate(host, document);
    case "trueaxis/before-after/1":
      return lasers(host, document);
    case "trueaxis/verify-part/1":
      return part(host, document);
    default:
      return [];
  }
}
