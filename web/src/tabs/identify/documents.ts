/** The document of `trueaxis identify --format json`, as far as the page shows it. */

import type { ServeIdentify } from "../../../types.d.ts";

export type IdentifyHeader = ServeIdentify;
export type IdentifyDocument = ServeIdentify["document"];
/** `value_um` and `u_um`, or the same with `_urad` or `_um_per_m`; null where the readings do not determine it. */
export type Found = IdentifyDocument["errors"][number];
export type Score = NonNullable<IdentifyDocument["rms"]["in_sample"]>;
export type Unobservable = IdentifyDocument["unobservable"][number];
export type Instrument = ServeIdentify["instruments"][number];

export type Unit = "µm" | "µrad" | "µm/m";

export function unitOf(found: Found): Unit {
  if (found.value_um_per_m !== undefined) return "µm/m";
  return found.value_urad === undefined ? "µm" : "µrad";
}

export function foundValue(found: Found): number | null {
  return found.value_um ?? found.value_urad ?? found.value_um_per_m ?? null;
}
