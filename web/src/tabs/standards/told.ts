/** What the server says of figures, in the language of the page: titles, notes, names of curves. */

import { tr, trText } from "../../words/index.ts";

/** Texts with values in them. */
const WITH_VALUES: readonly [RegExp, (first: string, second: string) => string][] = [
  [/^axis (\S+)$/, (axis) => tr`axis ${axis}`],
  [/^Diagonal (\S+)$/, (name) => tr`Diagonal ${name}`],
  [/^Error motion, (.+)$/, (direction) => tr`Error motion, ${trText(direction)}`],
  [/^(straightness|flatness|squareness|parallelism) (\(\w+\))$/, (kind, error) => `${trText(kind)} ${error}`],
  [/^Solid circle: nominal, radius (\S+) mm\.$/, (radius) => tr`Solid circle: nominal, radius ${radius} mm.`],
  [/^(\S+) to the right, (\S+) upwards\.$/, (right, up) => tr`${right} to the right, ${up} upwards.`],
  [/^One reading in (\d+) is drawn\.$/, (step) => tr`One reading in ${step} is drawn.`],
  [
    /^A hit scatters by (.+) \((\S+) degrees of freedom\)\.$/,
    (s, n) => tr`A hit scatters by ${s} (${n} degrees of freedom).`,
  ],
  [
    /^A reading scatters by (.+) \((\S+) degrees of freedom\)\.$/,
    (s, n) => tr`A reading scatters by ${s} (${n} degrees of freedom).`,
  ],
  [
    /^Tolerance (.+) by ISO 14253-1: pass if \|value\| \+ U is within it, fail if \|value\| − U is beyond it\.$/,
    (limit) =>
      tr`Tolerance ${limit} by ISO 14253-1: pass if |value| + U is within it, fail if |value| − U is beyond it.`,
  ],
  // That of a straightness, not that of a program, which has the same word.
  [/^line$/, () => tr`line${""}`],
  [/^For the machine file: (.+)\.$/, (line) => tr`For the machine file: ${line}.`],
];

function sentence(text: string): string {
  for (const [pattern, said] of WITH_VALUES) {
    const found = pattern.exec(text);
    if (found) return said(found[1] ?? "", found[2] ?? "");
  }
  return trText(text);
}

/** Sentence by sentence; the spaces around them stay. */
export const told = (text: string): string =>
  text
    .split(/((?:^|(?<=\.)) +(?=[A-Z]|$))/)
    .map(sentence)
    .join("");
