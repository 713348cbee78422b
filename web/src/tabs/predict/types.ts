/** The answers of `predict` and `what-if`, and the names of the indices. */

import { tr, trText } from "../../words/index.ts";
import type { Diagnostic } from "../../api.ts";
import type { DrawingDocument, DrawingEntry } from "../../../types.d.ts";
import type { Frame } from "../../frame.ts";

export type Verdict = "pass" | "fail" | "undecided";
export const VERDICTS: Readonly<Record<Verdict, string>> = { pass: tr`PASS`, fail: tr`FAIL`, undecided: tr`UNDECIDED` };

export interface Spread {
  mean_mm: number;
  u_mm: number;
  interval_95_mm: [number, number];
}

export interface IndexValue {
  value: number;
  u_mm: number;
  monte_carlo?: Spread;
}

export interface Judgement {
  index: string;
  value_mm: number;
  tolerance_mm: number;
  /** U where the study judges by ISO 14253-1. */
  expanded_mm: number | null;
  used_ratio: number;
  decisive: boolean;
  verdict: Verdict;
}

export interface Share {
  error: string;
  index: string;
  alone_mm: number;
  without_mm: number;
}

export interface Correction {
  error: string;
  change_um?: number;
  change_urad?: number;
  indices_mm: Record<string, number>;
}

type Grouped = { paper?: Record<string, IndexValue>; iso?: Record<string, IndexValue>; volumetric_max_mm?: IndexValue };

/** The document of `trueaxis predict --format json`. */
export interface PieceDocument {
  study: string;
  machine: { name: string; chain: string };
  test_piece: string;
  verdict: Verdict;
  indices: Grouped;
  judgements: Judgement[];
  setting_command: Record<string, number>;
  positions: (Grouped & { position: number; z_mm: number; height_mm: number })[];
  blame: Share[];
  blame_by_body: Share[];
  blame_by_kind: Share[];
  corrections: Correction[];
  variants: { name: string; indices_mm: Record<string, number> }[];
  commands: Record<string, number>[];
  monte_carlo: { samples: number; seed: number } | null;
  temperature_log: string | null;
  warnings: string[];
}

export interface FittedCircle {
  name: string;
  centre_mm: [number, number];
  radius_mm: number;
  inner_mm: number;
  outer_mm: number;
}

export interface Section {
  z_mm: number;
  height_mm: number;
  radius_mm: number;
  points: number;
  circles: FittedCircle[];
}

export interface PieceHeader {
  kind: "test-piece";
  document: PieceDocument;
  machine: string;
  rotary: string[];
  tool_length_mm: number;
  errors: { name: string; unit: string }[];
  sensors: string[];
  sections: Section[];
  diagnostics: Diagnostic[];
}

export type PieceFrame = Frame<PieceHeader>;

export interface Hole {
  nominal_mm: [number, number, number];
  error_um: [number, number, number];
  u_um: [number, number, number];
  compensation_increments: number[];
  time_s: number;
}

export interface HoleSet {
  compensation: string;
  worst_mm: number;
  u_worst_mm: number;
  in_tolerance: boolean | null;
  holes: Hole[];
}

export interface HolesHeader {
  kind: "holes";
  document: {
    name: string;
    increment_mm: number;
    tolerance_mm: number | null;
    applied: string;
    in_tolerance: boolean | null;
    temperature_log: string | null;
    sets: HoleSet[];
    sets_at_start: HoleSet[] | null;
    u_lacks: string[];
    warnings: string[];
  };
  diagnostics: Diagnostic[];
}

export type DrawingHeader = DrawingEntry & { kind: "drawing" };
export type CharacteristicValue = DrawingDocument["characteristics"][number];
export type CutPoint = DrawingDocument["features"][number]["most"];

/** What the command line calls the indices. */
const TITLES: Record<string, string> = {
  roundness_eq18_mm: "roundness, paper Eq 18",
  angularity_eq19_mm: "angularity, paper Eq 19",
  coaxiality_eq20_mm: "coaxiality, paper Eq 20",
  coaxiality_diameter_mm: "coaxiality, Eq 20 as diameter",
  roundness_lsc_mm: "roundness, least squares",
  roundness_mzc_mm: "roundness, minimum zone",
  roundness_mic_mm: "roundness, maximum inscribed",
  roundness_mcc_mm: "roundness, minimum circumscribed",
  coaxiality_lsc_mm: "coaxiality, diameter",
  angularity_zone_mm: "angularity, zone",
  volumetric_max_mm: "greatest deviation of the tip",
};

/** As the command line and the tables that are saved say. */
export const nameOf = (key: string): string => TITLES[key] ?? key.replace(/_mm$/, "").replaceAll("_", " ");

export const titleOf = (key: string): string => trText(nameOf(key));

/** All indices of a document by key, in its order. */
export function indicesOf(grouped: Grouped): Map<string, IndexValue> {
  const all = new Map(Object.entries({ ...grouped.paper, ...grouped.iso }));
  if (grouped.volumetric_max_mm) all.set("volumetric_max_mm", grouped.volumetric_max_mm);
  return all;
}

/** The judged index that is nearest to its tolerance, or farthest beyond it. */
export function worstOf(document: PieceDocument): Judgement | null {
  const deciding = document.judgements.filter((j) => j.decisive);
  const among = deciding.length > 0 ? deciding : document.judgements;
  return among.reduce<Judgement | null>((worst, j) => (worst && worst.used_ratio >= j.used_ratio ? worst : j), null);
}

/** U for k = 2, or what the decision rule of the study took. */
export function expanded(value: IndexValue, judged: Judgement | undefined): number {
  return judged?.expanded_mm ?? 2 * value.u_mm;
}

/** The numbers of one section out of an array that holds all sections one after the other. */
export function partOf<T extends Float32Array | Float64Array>(
  values: T,
  sections: readonly Section[],
  index: number,
  width = 1,
): T {
  const before = sections.slice(0, index).reduce((sum, s) => sum + s.points, 0);
  return values.subarray(width * before, width * (before + (sections[index]?.points ?? 0))) as T;
}
