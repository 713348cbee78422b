/** Numbers as they are shown: fixed digits, a real minus sign, a narrow no-break space before the unit. */

/** U+202F, between number and unit. */
export const NARROW_SPACE = "\u202f";
const MINUS = "\u2212";
/** What stands where a number is undefined. */
export const NO_NUMBER = "–";

/**
 * Digits after the point as Rust's `{:.N}` prints them: the exact decimal value of the double,
 * and exact ties to the even digit (`toFixed` takes them away from zero). ASCII, `-0.0` kept out.
 */
export function fixed(value: number, digits: number): string {
  if (!Number.isFinite(value)) return NO_NUMBER;
  if (Math.abs(value) >= 1e21) return value.toExponential(6);
  let text = Math.abs(value).toFixed(digits);
  // A double that is an exact tie has only zeros after the five.
  const exact = Math.abs(value).toFixed(Math.min(100, digits + 40));
  const rest = digits === 0 ? exact.slice(exact.indexOf(".") + 1) : exact.slice(exact.indexOf(".") + 1 + digits);
  if (/^50*$/.test(rest)) {
    const down = digits === 0 ? exact.slice(0, exact.indexOf(".")) : exact.slice(0, exact.indexOf(".") + 1 + digits);
    if (Number(down.at(-1)) % 2 === 0) text = down;
  }
  return value < 0 && /[1-9]/.test(text) ? `-${text}` : text;
}

/** As `fixed`, with the typographic minus sign. */
export function number(value: number | null | undefined, digits: number): string {
  if (value === null || value === undefined || !Number.isFinite(value)) return NO_NUMBER;
  return fixed(value, digits).replace("-", MINUS);
}

/** `withUnit(29.1234, 1, "µm")` -> "29.1 µm". */
export function withUnit(value: number | null | undefined, digits: number, unit: string): string {
  const text = number(value, digits);
  return text === NO_NUMBER || unit === "" ? text : `${text}${NARROW_SPACE}${unit}`;
}

export const um = (value: number | null | undefined, digits = 1): string => withUnit(value, digits, "µm");
export const urad = (value: number | null | undefined, digits = 1): string => withUnit(value, digits, "µrad");
export const mm = (value: number | null | undefined, digits = 4): string => withUnit(value, digits, "mm");
/** Angles stand without a space (ISO 80000-1). */
export const deg = (value: number | null | undefined, digits = 3): string =>
  withUnit(value, digits, "°").replace(NARROW_SPACE, "");
export const celsius = (value: number | null | undefined, digits = 1): string => withUnit(value, digits, "°C");
export const seconds = (value: number | null | undefined, digits = 1): string => withUnit(value, digits, "s");

/** "12.0 ± 1.0 µm"; without an uncertainty only the value. */
export function withUncertainty(value: number, u: number | null | undefined, digits: number, unit: string): string {
  if (u === null || u === undefined || !Number.isFinite(u)) return withUnit(value, digits, unit);
  return `${number(value, digits)}${NARROW_SPACE}±${NARROW_SPACE}${number(u, digits)}${NARROW_SPACE}${unit}`;
}

/** "4 h 21 min 58.9 s", from an hour on; below, null. */
function hours(time_s: number): string | null {
  // Rounded first: not "59 min 60.0 s".
  const tenths = Math.round(10 * time_s);
  if (!(tenths >= 36_000)) return null;
  const minutes = Math.floor(tenths / 600);
  const rest = number((tenths - 600 * minutes) / 10, 1);
  return `${Math.floor(minutes / 60)}${NARROW_SPACE}h ${minutes % 60}${NARROW_SPACE}min ${rest}${NARROW_SPACE}s`;
}

/** "5 min 13.6 s", "4 h 21 min 58.9 s". */
export function duration(time_s: number): string {
  const tenths = Math.round(10 * time_s);
  if (tenths < 600) return `${number(time_s, 1)}${NARROW_SPACE}s`;
  const minutes = Math.floor(tenths / 600);
  return hours(time_s) ?? `${minutes}${NARROW_SPACE}min ${number((tenths - 600 * minutes) / 10, 1)}${NARROW_SPACE}s`;
}

/** " min:s" after a time of less than an hour; the longer ones have their units in them. */
export const clockUnit = (time_s: number): string => (hours(time_s) === null ? " min:s" : "");

/** "2:05.3" of a machining time, minutes and seconds; from an hour on with its units. */
export function clock(time_s: number): string {
  const long = hours(time_s);
  if (long !== null) return long;
  const minutes = Math.floor(time_s / 60);
  const rest = fixed(time_s - 60 * minutes, 1);
  return `${minutes}:${rest.padStart(4, "0")}`;
}

/** "1.2 MB" of a file. */
export function bytes(count: number): string {
  if (count < 1000) return withUnit(count, 0, "B");
  if (count < 1e6) return withUnit(count / 1e3, 1, "kB");
  return withUnit(count / 1e6, 1, "MB");
}

/** Digits after the point that a step of an axis needs. */
export function digitsOfStep(step: number): number {
  if (!(step > 0)) return 0;
  return Math.max(0, Math.min(9, -Math.floor(Math.log10(step) + 1e-9)));
}

/** A factor as it is printed in pictures: "×1", "×2500" with a narrow space from 10 000. */
export function factor(k: number): string {
  const digits = k >= 10 || Number.isInteger(k) ? 0 : 1;
  return `×${fixed(k, digits).replace(/\B(?=(\d{3})+(?!\d))/g, k >= 1e4 ? NARROW_SPACE : "")}`;
}

/** What stands between semicolons. */
export const listed = (text: string): string[] =>
  text
    .split(";")
    .map((one) => one.trim())
    .filter(Boolean);
