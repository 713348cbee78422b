/** Words of times, units, and of what the server says about a run. */

import { tr } from "../../words/index.ts";
import { number, NARROW_SPACE } from "../../format.ts";

/** "now", "12 s ago", "5 min ago", "3 h ago", "2 days ago". */
export function ago(seconds: number): string {
  if (seconds < 3) return tr`now`;
  if (seconds >= 172800) return tr`${number(seconds / 86400, 0)}${NARROW_SPACE}days ago`;
  const [value, unit] = seconds < 90 ? [seconds, "s"] : seconds < 5400 ? [seconds / 60, "min"] : [seconds / 3600, "h"];
  return tr`${number(value, 0)}${NARROW_SPACE}${unit} ago`;
}

/** The unit as it is shown. */
export function unitOf(unit: string): string {
  return unit === "um" ? "µm" : "µrad";
}

/** Which error is compensated. */
export function compensated(of: string): string {
  return { comprehensive: tr`comprehensive`, machine: tr`machine` }[of] ?? of;
}

const EVENTS: Readonly<Record<string, string>> = {
  Off: tr`Off`,
  Arm: tr`Arm`,
  Run: tr`Run`,
  Hold: tr`Hold`,
  RampDown: tr`RampDown`,
  Latched: tr`Latched`,
  datum: tr`datum`,
  "datum-cleared": tr`datum-cleared`,
  "datum-refused": tr`datum-refused`,
  part: tr`part`,
  "part-lost": tr`part-lost`,
};

/** What an event of the journal is. */
export const eventWord = (event: string): string => EVENTS[event] ?? event;
