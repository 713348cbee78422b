/** The document of `trueaxis evaluate --format json`, as far as tables and tiles need it. */

import type { ServeEvaluate } from "../../../types.d.ts";

export interface Positioning {
  kind: "linear" | "rotary";
  positions: Record<string, number | null>[];
  budget: Record<string, number | null> | null;
  vdi3441: Record<string, number | null>;
  b5_54_form: Record<string, number | null>;
  /** `A_um`, `U_um: {A: …}` and so on. */
  [key: string]: unknown;
}

export interface Circular {
  axes: [string, string];
  radius_mm: number;
  centre_mm: [number, number];
  paths: {
    direction: string;
    points: number;
    overlap_left_out_deg: number;
    G_um: number;
    F_max_um: number;
    F_min_um: number;
  }[];
  causes: {
    backlash_um: Record<string, number | null>;
    scale_mismatch_um: number | null;
    squareness_urad: number | null;
    servo_mismatch_um: number | null;
    diagonal_ellipse_um: number | null;
    centre_um: [number, number] | null;
    spikes: { axis: string; at_deg: number; direction: string; height_um: number }[];
    residual_rms_um: number | null;
  } | null;
  G_b_um: number | null;
  D_um: number | null;
  [key: string]: unknown;
}

export interface Drift {
  window_s: number;
  duration_s: number;
  channels: Record<string, number | string | null>[];
}

export interface Diagonals {
  diagonals: (Positioning & { diagonal: string; stretch_um_per_m: number | null })[];
  squareness: { axes: string; closer_urad: number; from: string }[];
  [key: string]: unknown;
}

export interface Rotation {
  revolutions: number;
  readings_per_revolution: number;
  readings_left_out: number;
  motions: {
    sensitive: string;
    total_um: number;
    synchronous_um: number;
    asynchronous_um: number | null;
    fundamental_um: number;
  }[];
}

export type EvaluateDocument = ServeEvaluate["document"];

export type Kind = "positioning" | "circular" | "drift" | "diagonals" | "rotation" | "other";

/** Which kind of test the document is of, by what it holds. */
export function kindOf(document: EvaluateDocument): Kind {
  if ("positions" in document) return "positioning";
  if ("diagonals" in document) return "diagonals";
  if ("motions" in document) return "rotation";
  if ("channels" in document) return "drift";
  return "paths" in document ? "circular" : "other";
}

export const as = <T>(document: EvaluateDocument): T => document as unknown as T;

/** Parameters of the address that readings are evaluated with, besides file and standard. */
export const STATED = ["tolerances", "simple", "conditions", "radius", "window", "feature"] as const;
