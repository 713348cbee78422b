/** The document of `trueaxis identify --format json`, as far as the page shows it. */

import type { Diagnostic } from "../../api.ts";

/** Either `value_um` and `u_um`, or `value_urad` and `u_urad`; null where the readings cannot tell. */
export interface Found {
  name: string;
  value_um?: number | null;
  value_urad?: number | null;
  u: number | null;
  z: number | null;
}

export interface Score {
  um: number | null;
  urad: number | null;
  times_noise: number | null;
}

export interface Unobservable {
  combination: string;
  words: string;
  resolve_with: string | null;
}

export interface IdentifyDocument {
  name: string;
  machine: string;
  date: string | null;
  verdict: { key: string; words: string; good: boolean };
  errors: Found[];
  setup: Found[];
  unobservable: Unobservable[];
  left_out: string[];
  rms: { in_sample: Score | null; held_out: Score | null; repeatability: Score | null; without_model: Score | null };
  repeatability_is_measured: boolean;
  readings: number;
  places: number;
  rank: number;
  condition: number;
  birge_ratio: number;
  residual_follows: { what: string; share: number }[];
  outliers: { file: string; line: number; channel: number; studentised: number }[];
  outlier_limit: number;
  most_influential: { file: string; line: number; leverage: number; cook: number | null }[];
  diagnostics: Diagnostic[];
}

export interface Instrument {
  name: string;
  kind: string;
  channels: string[];
  tables: string[];
}

export interface IdentifyHeader {
  document: IdentifyDocument;
  machine: string;
  instruments: Instrument[];
  correlation: string[];
  machine_file: { text: string; tables: { name: string; text: string }[] } | null;
  diagnostics: Diagnostic[];
}

export type Unit = "µm" | "µrad";

export function unitOf(found: Found): Unit {
  return found.value_urad === undefined ? "µm" : "µrad";
}

export function foundValue(found: Found): number | null {
  return (unitOf(found) === "µm" ? found.value_um : found.value_urad) ?? null;
}
