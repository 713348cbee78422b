/**
 * What the server says, in the language of the page: the dictionaries of its reports (crates/trueaxis-words), with the same
 * rules. `{0}` is any text, `{0n}` one that begins with a number; a value is looked up, too; of two sentences that fit, the
 * one with more letters of its own is taken. Of several sentences in a row, each is looked up where the whole is not known.
 */

type Lookup = (text: string) => string | undefined;

interface Sentence {
  fits: RegExp;
  /** Number of the value in each group. */
  values: number[];
  /** Groups that are numbers, and groups that are the beginning of a file's name, as in `{0}.nc on {1}`. */
  numeric: boolean[];
  named: boolean[];
  /** The translation: texts, and numbers of values. */
  said: (string | number)[];
  weight: number;
}

/** A value in a value in a value: deeper, texts stay English. */
const DEEPEST = 4;
/** A letter follows a point, as in `part 5.nc`: a name, of which no word is said in another language. */
const FILE = /[\p{L}\d]\.[A-Za-z]/u;
const HOLE = /\{(\d+)n?\}/;

const unquoted = (text: string): string => JSON.parse(text) as string;

/** Lines such as `"{0n} of {1n} points" = "{0} von {1} Punkten"`, and a bare word before `=`. */
export function entriesOf(toml: string): [string, string][] {
  const line = /^\s*("(?:[^"\\]|\\.)*"|[\w-]+)\s*=\s*("(?:[^"\\]|\\.)*")\s*(?:#.*)?$/;
  return toml.split("\n").flatMap((text): [string, string][] => {
    const found = line.exec(text);
    if (!found?.[1] || !found[2]) return [];
    return [[found[1].startsWith('"') ? unquoted(found[1]) : found[1], unquoted(found[2])]];
  });
}

function sentenceOf(english: string, other: string): Sentence {
  const pieces = english.split(/(\{\d+n?\})/);
  const holes = pieces.filter((_, i) => i % 2 === 1);
  const pattern = pieces.map((piece, i) => {
    if (i % 2 === 0) return piece.replace(/[.*+?^${}()|[\]\\]/g, "\\$&");
    return piece.endsWith("n}") ? "(\\s*[\\d+\\-−–±].*?)" : "(.+?)";
  });
  return {
    fits: new RegExp(`^${pattern.join("")}$`, "su"),
    values: holes.map((hole) => Number(HOLE.exec(hole)?.[1])),
    numeric: holes.map((hole) => hole.endsWith("n}")),
    named: holes.map((_, i) => /^\.\p{L}/u.test(pieces[2 * i + 2] ?? "")),
    said: other.split(/(\{\d+n?\})/).map((piece, i) => (i % 2 === 0 ? piece : Number(HOLE.exec(piece)?.[1]))),
    weight: pieces.filter((_, i) => i % 2 === 0).join("").length,
  };
}

/** Sentences one after the other; nothing if one of them is not known. */
function inSentences(
  text: string,
  depth: number,
  find: (text: string, depth: number) => string | undefined,
): string | undefined {
  const parts = text.split(/(?<=\.) +(?=\p{Lu})/u);
  if (parts.length < 2) return undefined;
  const said = parts.map((part) => find(part, depth + 1));
  return said.includes(undefined) ? undefined : said.join(" ");
}

/** Looks texts up in dictionaries as `entriesOf` gives them. */
export function lookupOf(entries: readonly (readonly [string, string])[]): Lookup {
  const texts = new Map(entries);
  const sentences = [...texts].filter(([english]) => HOLE.test(english)).map((entry) => sentenceOf(...entry));
  sentences.sort((a, b) => b.weight - a.weight);
  const known = new Map<string, string | undefined>();
  const find = (text: string, depth: number): string | undefined => {
    if (depth > DEEPEST || !/\p{L}/u.test(text)) return undefined;
    const whole = texts.get(text);
    if (whole !== undefined) return whole;
    for (const { fits, values, numeric, named, said } of sentences) {
      const groups = fits.exec(text)?.slice(1);
      if (!groups || groups.some((group, i) => numeric[i] && FILE.test(group))) continue;
      const inside = (number: number): string => {
        const group = values.indexOf(number);
        const value = groups[group] ?? "";
        return named[group] ? value : (find(value, depth + 1) ?? value);
      };
      return said.map((piece) => (typeof piece === "string" ? piece : inside(piece))).join("");
    }
    return inSentences(text, depth, find);
  };
  return (text) => {
    if (!known.has(text)) known.set(text, find(text, 0));
    return known.get(text);
  };
}
