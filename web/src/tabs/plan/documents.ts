/** The document of `trueaxis plan --format json`, as far as the page shows it. */

import type { Diagnostic } from "../../api.ts";
import type { Unobservable } from "../identify/documents.ts";

export interface Expected {
  name: string;
  unit: "um" | "urad" | string;
  u: number | null;
  expanded_k2: number | null;
}

export interface Program {
  duration_s: number;
  sound: boolean;
  errors: string[];
  grave: string[];
  minor: string[];
}

export interface PathDocument {
  name: string;
  stations: number;
  feed_mm_per_min: number | null;
  dwell_s: number | null;
  channels: string[];
  unit: string;
  seen_of_10_um_or_urad: { error: string; largest: number[] }[];
  program: Program | null;
}

export interface Chosen {
  poses: number;
  candidates: number;
  blocked: number;
  readings: number;
  time_s: number | null;
  expected: Expected[];
  grid: { poses: number; expected: Expected[] } | null;
}

export interface PlanDocument {
  name: string;
  machine: string;
  chain: string;
  paths: PathDocument[];
  expected: Expected[];
  unobservable: Unobservable[];
  rank: number;
  condition: number;
  chosen: Chosen | null;
}

export interface PlanHeader {
  document: PlanDocument;
  machine: string;
  axes: { name: string; unit: "mm" | "deg" }[];
  paths: {
    name: string;
    instrument: string;
    kind: string;
    stations: number;
    files: { name: string; text: string }[];
  }[];
  diagnostics: Diagnostic[];
}
