/** Words of times, units, and of what the server says about a run. */

import { tr, trText } from "../../words/index.ts";
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

/** Reasons of a state and faults of a sensor that have names or numbers in them. */
const SAID: readonly (readonly [RegExp, (first: string, second: string) => string])[] = [
  [/^link lost: (.+)$/, (what) => tr`link lost: ${what}`],
  [/^sensor (.+?): (.+)$/, (sensor, what) => tr`sensor ${sensor}: ${said(what)}`],
  [/^workpiece sensor (.+?): (.+)$/, (sensor, what) => tr`workpiece sensor ${sensor}: ${said(what)}`],
  [/^setup (\S+): its zero was not touched yet$/, (setup) => tr`setup ${setup}: its zero was not touched yet`],
  [/^its last sample is older than (\S+) s$/, (age) => tr`its last sample is older than ${age} s`],
  [/^its last sample is no number: (.+)$/, (text) => tr`its last sample is no number: ${text}`],
  [/^(\S+) °C is outside its range$/, (celsius) => tr`${celsius} °C is outside its range`],
  [/^(\S+) to (\S+) °C is faster than its rate$/, (from, to) => tr`${from} to ${to} °C is faster than its rate`],
  [/^it stays at (\S+) °C while others move$/, (celsius) => tr`it stays at ${celsius} °C while others move`],
];

/** A reason or a fault as the server says it, in the language of the page. */
export function said(text: string): string {
  for (const [pattern, words] of SAID) {
    const [, first, second = ""] = pattern.exec(text) ?? [];
    if (first !== undefined) return words(first, second);
  }
  return trText(text);
}
