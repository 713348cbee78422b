/** The document of `trueaxis identify --format json`, as far as the page shows it. */

import type { ServeIdentify } from "../../../types.d.ts";

export type IdentifyHeader = ServeIdentify;
export type IdentifyDocument = ServeIdentify["document"];
/** `value_um` and `u_um`, or the same with `_urad`, `_um_per_m`, `_um_per_h` or `_urad_per_h`; null where the readings do not determine it. */
export type Found = IdentifyDocument["errors"][number];
export type Score = NonNullable<IdentifyDocument["rms"]["in_sample"]>;
export type Unobservable = IdentifyDocument["unobservable"][number];
export type Instrument = ServeIdentify["instruments"][number];

export type Unit = "µm" | "µrad" | "µm/m" | "µm/h" | "µrad/h";

export function unitOf(found: Found): Unit {
  if (found.value_um_per_m !== undefined) return "µm/m";
  if (found.value_um_per_h !== undefined) return "µm/h";
  if (found.value_urad_per_h !== undefined) return "µrad/h";
  return found.value_urad === undefined ? "µm" : "µrad";
}

export function foundValue(found: Found): number | null {
  return (
    found.value_um ?? found.value_urad ?? found.value_um_per_m ?? found.value_um_per_h ?? found.value_urad_per_h ?? null
  );
}
