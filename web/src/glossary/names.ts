/** Names of errors by ISO 230-1, taken apart: E, the direction, a 0 for location errors, the axis. */

export type Letter = "X" | "Y" | "Z";

export interface ErrorName {
  name: string;
  kind: "motion" | "location";
  /** Translation along a direction, or rotation about it. */
  how: "along" | "about";
  /** The direction of the deviation, or the axis of the rotation. */
  direction: Letter;
  body: "linear" | "rotary" | "workpiece" | "tool";
  /** X … W, A B C, w, t. */
  axis: string;
  /** The direction that the axis moves along or turns about; of workpiece and tool null. */
  own: Letter | null;
}

const TURNS = "ABC";
/** Where the axes of ISO 841 lie. */
const OWN: Record<string, Letter> = {
  X: "X",
  Y: "Y",
  Z: "Z",
  U: "X",
  V: "Y",
  W: "Z",
  A: "X",
  B: "Y",
  C: "Z",
};
const NAME = /^E([XYZABC])(0?)([XYZUVWABCwt])$/;
/** The same in a text. */
const IN_TEXT = /\bE(?:[XYZABC]0?[XYZUVWABC]|[XYZABC]0[wt])\b/g;

/** The letter of a direction: that of a rotation about X is A. */
export const turnOf = (about: Letter): string => TURNS["XYZ".indexOf(about)] ?? "";

/** null: not the name of an error. */
export function errorName(name: string): ErrorName | null {
  const [, component = "", zero, axis = ""] = NAME.exec(name) ?? [];
  const is_mounting = axis === "w" || axis === "t";
  if (!component || (is_mounting && !zero)) return null;
  const about = TURNS.includes(component);
  return {
    name,
    kind: zero ? "location" : "motion",
    how: about ? "about" : "along",
    direction: (about ? "XYZ"[TURNS.indexOf(component)] : component) as Letter,
    body: axis === "w" ? "workpiece" : axis === "t" ? "tool" : TURNS.includes(axis) ? "rotary" : "linear",
    axis,
    own: OWN[axis] ?? null,
  };
}

/** A text in pieces: what stands between the names of errors, and the names. */
export function piecesOf(text: string): (string | ErrorName)[] {
  const pieces: (string | ErrorName)[] = [];
  let at = 0;
  for (const { 0: word, index } of text.matchAll(IN_TEXT)) {
    const name = errorName(word);
    if (!name) continue;
    if (index > at) pieces.push(text.slice(at, index));
    pieces.push(name);
    at = index + word.length;
  }
  if (at < text.length) pieces.push(text.slice(at));
  return pieces;
}

/** All names of an axis, error motions first. */
export function namesOf(axis: string): string[] {
  const components = [..."XYZABC"];
  const location = components.map((c) => `E${c}0${axis}`);
  return axis === "w" || axis === "t" ? location : [...components.map((c) => `E${c}${axis}`), ...location];
}

/** The third direction. */
export const third = (one: Letter, other: Letter): Letter =>
  (["X", "Y", "Z"] as const).find((l) => l !== one && l !== other) ?? one;

/** +1 where the second direction follows the first: X, Y, Z, X. The third then points to who looks at both. */
export const handed = (first: Letter, second: Letter): 1 | -1 =>
  ("XYZ".indexOf(second) - "XYZ".indexOf(first) + 3) % 3 === 1 ? 1 : -1;
