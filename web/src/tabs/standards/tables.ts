/** Result tables of every standard: symbols, what they mean, values, uncertainties. */

import { tr, trText } from "../../words/index.ts";
import type { ServeEvaluate } from "../../../types.d.ts";
import type { Cell, Sheet } from "../measure/table.ts";
import {
  as,
  kindOf,
  type Circular,
  type Diagonals,
  type Drift,
  type EvaluateDocument,
  type Positioning,
  type Rotation,
} from "./documents.ts";

type ReportTable = ServeEvaluate["figures"][number];

const value = (of: Record<string, unknown>, key: string): number | null =>
  typeof of[key] === "number" ? (of[key] as number) : null;

/** ISO 230-2: key, symbol, name, what it says in a workshop. */
const FIGURES: readonly [string, string, string, string][] = [
  [
    "A",
    "A",
    tr`bidirectional accuracy of positioning`,
    tr`what to expect of a commanded position from either side: means ± 2s`,
  ],
  ["A_up", "A↑", tr`accuracy, rising`, tr`the same, approached from below only`],
  ["A_down", "A↓", tr`accuracy, falling`, tr`the same, approached from above only`],
  ["R", "R", tr`bidirectional repeatability`, tr`widest scatter at one target, with its reversal`],
  ["R_up", "R↑", tr`repeatability, rising`, tr`widest 4s at one target, from below`],
  ["R_down", "R↓", tr`repeatability, falling`, tr`widest 4s at one target, from above`],
  [
    "E",
    "E",
    tr`bidirectional systematic error`,
    tr`range of the means: what a table of compensation can take away, with B`,
  ],
  ["E_up", "E↑", tr`systematic error, rising`, tr`range of the means from below`],
  ["E_down", "E↓", tr`systematic error, falling`, tr`range of the means from above`],
  [
    "M",
    "M",
    tr`mean bidirectional error`,
    tr`range of the mean of both directions: what a one-way table can take away`,
  ],
  ["B", "B", tr`reversal error`, tr`largest lost motion at any target`],
  ["B_mean", "B̄", tr`mean reversal error`, tr`mean lost motion, rising minus falling`],
];

/** Unit of deviations as shown and in keys, unit of positions. */
export function unitsOf(p: Positioning): { key: string; shown: string; place: string } {
  return p.kind === "rotary"
    ? { key: "arcsec", shown: "arcsec", place: "deg" }
    : { key: "um", shown: "µm", place: "mm" };
}

function positioning(document: EvaluateDocument): Sheet[] {
  const p = as<Positioning>(document);
  const { key, shown, place } = unitsOf(p);
  const U = p[`U_${key}`] as Record<string, unknown>;
  const figures: Sheet = {
    key: "figures",
    title: tr`ISO 230-2 figures of the axis`,
    head: ["", tr`figure`, shown, "U (k = 2)"],
    rows: FIGURES.map(([name, symbol, title]) => [symbol, title, value(p, `${name}_${key}`), value(U, name)]),
    hints: FIGURES.map((f) => f[3]),
    note: tr`–: the readings do not allow it, or nothing is known of the instrument (U).`,
  };
  const vdi: Sheet = {
    key: "vdi3441",
    title: tr`VDI/DGQ 3441`,
    head: ["", tr`figure`, shown],
    rows: [
      ["P", tr`positional uncertainty`, "P"],
      ["Pa", tr`positional deviation`, "Pa"],
      ["Ps max", tr`positional scatter`, "Ps"],
      ["U max", tr`reversal`, "U"],
    ].map(([symbol, title, name]): Cell[] => [symbol as string, title as string, value(p.vdi3441, `${name}_${key}`)]),
  };
  const b5: Sheet = {
    key: "b5_54",
    title: tr`Form of ASME B5.54`,
    head: ["", tr`figure`, shown],
    rows: [
      [tr`both`, tr`range of all readings`, "accuracy"],
      ["↑", tr`range of all readings, rising`, "accuracy_up"],
      ["↓", tr`range of all readings, falling`, "accuracy_down"],
      [tr`repeat`, tr`largest range at one target from one side`, "repeatability"],
      [tr`reversal`, tr`largest reversal`, "reversal"],
    ].map(([symbol, title, name]): Cell[] => [
      symbol as string,
      title as string,
      value(p.b5_54_form, `${name}_${key}`),
    ]),
    note: tr`The form was not compared with the text of the standard.`,
  };
  const order =
    document.standard === "vdi3441"
      ? [vdi, figures, b5]
      : document.standard === "b5.54"
        ? [b5, figures, vdi]
        : [figures, vdi, b5];
  return [...order, ...budget(p), targets(p, key, shown, place)];
}

function budget(p: Positioning): Sheet[] {
  if (!p.budget) return [];
  // Of a rotary axis in the other unit than its figures.
  const [end, shown] = p.kind === "rotary" ? ["_u_urad", "µrad"] : ["_u_um", "µm"];
  const words = (name: string): string =>
    name === "drift" ? tr`drift, each reading` : trText(name.replaceAll("_", " "));
  const rows = Object.entries(p.budget).map(([name, u]): Cell[] => [words(name.replace(end, "")), u]);
  return [
    {
      key: "budget",
      title: tr`Measuring uncertainty (ISO/TR 230-9)`,
      head: [tr`contribution, over the measured length`, tr`standard uncertainty, ${shown}`],
      rows,
    },
  ];
}

function targets(p: Positioning, key: string, shown: string, place: string): Sheet {
  const columns = ["mean_up", "mean_down", "mean", "s_up", "s_down", "B", "R_up", "R_down", "R"];
  return {
    key: "targets",
    title: tr`Every target, ${shown}`,
    head: [tr`target, ${place}`, "n↑", "n↓", "x̄↑", "x̄↓", "x̄", "s↑", "s↓", "B", "R↑", "R↓", "R"],
    rows: p.positions.map((one) => [
      value(one, `target_${place}`),
      value(one, "n_up"),
      value(one, "n_down"),
      ...columns.map((name) => value(one, `${name}_${key}`)),
    ]),
    digits: [1, 0, 0],
  };
}

function circular(document: EvaluateDocument): Sheet[] {
  const c = as<Circular>(document);
  const figures: Cell[][] = [];
  for (const way of ["ccw", "cw"]) {
    if (value(c, `G_${way}_um`) === null) continue;
    const side = way === "ccw" ? tr`counter-clockwise` : tr`clockwise`;
    figures.push(
      [`G ${way}`, tr`circular deviation, ${side}`, value(c, `G_${way}_um`)],
      [`F max ${way}`, tr`greatest radial deviation, ${side}`, value(c, `F_${way}_max_um`)],
      [`F min ${way}`, tr`least radial deviation, ${side}`, value(c, `F_${way}_min_um`)],
    );
  }
  if (c.G_b_um !== null) figures.push(["G(b)", tr`bidirectional circular deviation`, c.G_b_um]);
  if (c.D_um !== null) figures.push(["D", tr`mean bidirectional radial deviation`, c.D_um]);
  const sheets: Sheet[] = [
    {
      key: "figures",
      title: tr`ISO 230-4 figures of the test`,
      head: ["", tr`figure`, "µm"],
      rows: figures,
      note: tr`G about the least-squares centre, F about the nominal one, outward positive.`,
    },
  ];
  const causes = c.causes;
  if (!causes) return sheets;
  const [x, y] = c.axes;
  const rows: Cell[][] = [
    ...Object.entries(causes.backlash_um).map(([axis, b]): Cell[] => [tr`reversal ${axis} (B = E↑ − E↓)`, b, "µm"]),
    [tr`scale ${x} − ${y}, over the diameter`, causes.scale_mismatch_um, "µm"],
    [tr`squareness ${x}${y}, closer than 90°`, causes.squareness_urad, "µrad"],
    [tr`servo mismatch, ccw along +45°`, causes.servo_mismatch_um, "µm"],
    [tr`ellipse along 45°`, causes.diagonal_ellipse_um, "µm"],
    [tr`centre ${x}`, causes.centre_um?.[0] ?? null, "µm"],
    [tr`centre ${y}`, causes.centre_um?.[1] ?? null, "µm"],
    [tr`residual, rms`, causes.residual_rms_um, "µm"],
  ];
  sheets.push({
    key: "causes",
    title: tr`What makes it unround`,
    head: [tr`cause`, tr`value`, tr`unit`],
    rows: rows.filter((row) => row[1] !== null),
    note: tr`Least squares over all paths; 10° after each reversal are left out for the spikes.`,
  });
  if (causes.spikes.length > 0) {
    sheets.push({
      key: "spikes",
      title: tr`Reversal spikes`,
      head: [tr`axis`, tr`at, deg`, tr`way`, "µm"],
      rows: causes.spikes.map((s) => [s.axis, s.at_deg, s.direction, s.height_um]),
      digits: [undefined, 0],
      note: tr`Largest residual within 10° after the reversal, outward positive.`,
    });
  }
  return sheets;
}

const CHANNEL_UNITS: readonly [string, string][] = [
  ["um", "µm"],
  ["urad", "µrad"],
  ["degC", "°C"],
];

function drift(document: EvaluateDocument): Sheet[] {
  const d = as<Drift>(document);
  const minutes = Math.round(d.window_s / 60);
  const rows = d.channels.map((channel): Cell[] => {
    const [key, shown] = CHANNEL_UNITS.find(([unit]) => `range_${unit}` in channel) ?? ["", ""];
    const of = (name: string): number | null => value(channel, `${name}_${key}`);
    return [
      String(channel.name),
      shown,
      of("range"),
      of("first_window"),
      of("largest_window"),
      (value(channel, "largest_window_from_s") ?? 0) / 60,
      of("end"),
    ];
  });
  return [
    {
      key: "figures",
      title: tr`ISO 230-3 range of every channel`,
      head: [
        tr`channel`,
        tr`unit`,
        tr`range`,
        tr`first ${minutes} min`,
        tr`worst ${minutes} min`,
        tr`from, min`,
        tr`end − begin`,
      ],
      rows,
      digits: [undefined, undefined, 2, 2, 2, 1, 2],
    },
  ];
}

const VOLUME: readonly [string, string, string][] = [
  ["E_d", "E", tr`bidirectional systematic deviation`],
  ["E_d_up", "E↑", tr`systematic deviation, rising`],
  ["E_d_down", "E↓", tr`systematic deviation, falling`],
  ["R_d", "R", tr`bidirectional repeatability`],
  ["B_d", "B", tr`reversal value`],
  ["A_d", "A", tr`bidirectional accuracy`],
];

function diagonals(document: EvaluateDocument): Sheet[] {
  const d = as<Diagonals>(document);
  const columns = ["A", "E", "E_up", "E_down", "M", "R", "B"];
  const sheets: Sheet[] = [
    {
      key: "figures",
      title: tr`ISO 230-6 figures of the volume`,
      head: ["", tr`largest of all diagonals`, "µm"],
      rows: VOLUME.map(([key, , title]) => [
        key.replace("_up", "↑").replace("_down", "↓"),
        title,
        value(d, `${key}_um`),
      ]),
    },
    {
      key: "diagonals",
      title: tr`Every diagonal, µm`,
      head: [tr`diagonal`, "A", "E", "E↑", "E↓", "M", "R", "B", tr`stretch, µm/m`],
      rows: d.diagonals.map((one) => [
        one.diagonal,
        ...columns.map((name) => value(one, `${name}_um`)),
        one.stretch_um_per_m,
      ]),
    },
  ];
  if (d.squareness.length > 0)
    sheets.push({
      key: "squareness",
      title: tr`Squareness`,
      head: [tr`axes`, tr`from`, tr`closer than 90°, µrad`],
      rows: d.squareness.map((s) => [
        s.axes,
        s.from === "body" ? tr`body diagonals` : tr`face diagonals`,
        s.closer_urad,
      ]),
      note: tr`A hint: straightness, roll and pitch lengthen diagonals too.`,
    });
  return sheets;
}

function rotation(document: EvaluateDocument): Sheet[] {
  const r = as<Rotation>(document);
  return [
    {
      key: "figures",
      title: tr`ISO 230-7 error motions over ${r.revolutions} revolutions`,
      head: [
        tr`sensitive direction`,
        tr`total, µm`,
        tr`synchronous, µm`,
        tr`asynchronous, µm`,
        tr`once per revolution, µm`,
      ],
      rows: r.motions.map((m) => [
        // As a tolerance names it.
        m.sensitive,
        m.total_um,
        m.synchronous_um,
        m.asynchronous_um,
        m.fundamental_um,
      ]),
      note: tr`Radial: about the least-squares centre, without the once-per-revolution part; axial: with it.`,
    },
  ];
}

/** Columns of the report whose words are a verdict. Names of figures stay: a tolerance is stated for them. */
const VERDICTS = ["verdict", "decision"];

/** A table of the report, as it stands there. */
function sheetOf(table: ReportTable, key: string): Sheet {
  const { title, note, headings, rows, words } = table;
  const cells = rows.map((row) => row.map((cell, j) => (VERDICTS.includes(headings[j] ?? "") ? trText(cell) : cell)));
  return {
    key,
    title: trText(title),
    head: headings.map(trText),
    rows: cells,
    words,
    ...(note ? { note: trText(note) } : {}),
  };
}

/** Tolerances first; of geometric tests and probes the tables of the report. */
export function sheetsOf(header: ServeEvaluate): Sheet[] {
  const { document, figures, details } = header;
  const [first] = figures;
  const judged = document.decisions && first ? [sheetOf(first, "tolerances")] : [];
  const kind = kindOf(document);
  if (kind !== "other") return [...judged, ...{ positioning, circular, drift, diagonals, rotation }[kind](document)];
  const results = figures.slice(judged.length).map((table, i) => sheetOf(table, i === 0 ? "figures" : `figures-${i}`));
  return [...judged, ...results, ...details.map((table, i) => sheetOf(table, `details-${i}`))];
}

const WORDS: Record<string, string> = {
  A: tr`accuracy`,
  R: tr`repeatability`,
  E: tr`systematic`,
  M: tr`mean`,
  B: tr`reversal`,
  E_d: tr`systematic`,
  R_d: tr`repeatability`,
  B_d: tr`reversal`,
  A_d: tr`accuracy`,
};

/** What stands large at the head: the figures that are asked for first. */
export interface Tile {
  symbol: string;
  /** One word beside the symbol, and the whole name. */
  word: string;
  title: string;
  value: number | null;
  U?: number | null;
  unit: string;
}

export function tilesOf(document: EvaluateDocument): Tile[] {
  switch (kindOf(document)) {
    case "positioning": {
      const p = as<Positioning>(document);
      const { key, shown } = unitsOf(p);
      const U = p[`U_${key}`] as Record<string, unknown>;
      return FIGURES.filter(([name]) => ["A", "R", "E", "M", "B"].includes(name)).map(([name, symbol, title]) => ({
        symbol,
        word: WORDS[name] ?? "",
        title,
        value: value(p, `${name}_${key}`),
        U: value(U, name),
        unit: shown,
      }));
    }
    case "circular": {
      const c = as<Circular>(document);
      return [
        ["G_ccw", "G ccw", tr`circular deviation`],
        ["G_cw", "G cw", tr`circular deviation`],
        ["G_b", "G(b)", tr`bidirectional circular deviation`],
        ["D", "D", tr`mean bidirectional radial deviation`],
      ]
        .map(([key, symbol, title]) => ({
          symbol: symbol as string,
          word: "",
          title: title as string,
          value: value(c, `${key}_um`),
          unit: "µm",
        }))
        .filter((tile) => tile.value !== null);
    }
    case "diagonals":
      return VOLUME.filter(([key]) => /_d$/.test(key)).map(([key, , title]) => ({
        symbol: key,
        word: WORDS[key] ?? "",
        title,
        value: value({ ...document }, `${key}_um`),
        unit: "µm",
      }));
    case "rotation":
      return as<Rotation>(document).motions.map((m) => ({
        symbol: m.sensitive,
        word: tr`total`,
        title: tr`total error motion`,
        value: m.total_um,
        unit: "µm",
      }));
    case "drift":
      return (drift(document)[0]?.rows ?? [])
        .filter((row) => row[1] !== "°C")
        .map((row) => ({
          symbol: String(row[0]),
          word: tr`range`,
          title: tr`range over the whole test`,
          value: row[2] as number | null,
          unit: String(row[1]),
        }));
    case "other":
      return [];
  }
}
