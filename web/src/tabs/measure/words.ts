/** Units and numbers as the tables of TrueAxis write them. */

import { number, NO_NUMBER } from "../../format.ts";
import { trText } from "../../words/index.ts";

export { duration } from "../../format.ts";

/** Units of the documents as shown. */
export function unitText(unit: string): string {
  return ({ um: "µm", urad: "µrad", degC: "°C", arcsec: "″", deg: "°" } as Record<string, string>)[unit] ?? unit;
}

/** Three figures that count: 0.920, 1.27, 10.0, 313. */
export function significant(value: number | null | undefined, figures = 3): string {
  if (value === null || value === undefined || !Number.isFinite(value)) return NO_NUMBER;
  const power = value === 0 ? 0 : Math.floor(Math.log10(Math.abs(value)));
  return number(value, Math.min(12, Math.max(0, figures - 1 - power)));
}

/** "1 path", "4 paths". */
export function count(n: number, one: string, many = `${one}s`): string {
  const word = n === 1 ? one : many;
  const text = `${n} ${word}`;
  // A dictionary may have both as one: Chinese puts a measure word between them.
  const said = trText(text);
  return said === text ? `${n} ${trText(word)}` : said;
}

/** What was refused and what to do, on one line. */
export function refusalWords({ message, hint }: { message: string; hint: string }): string {
  return `${trText(message)}${hint ? `: ${trText(hint)}` : ""}.`;
}
