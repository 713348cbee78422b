/**
 * The language of the page: that of the browser, or the user's choice kept in localStorage.
 *
 * English stands where it is used, in `tr`; a language is a dictionary of these texts, loaded before the page is made.
 * Numbers are written the same in all languages, with a decimal point, as in programs, tables and reports.
 */

import { entriesOf, lookupOf } from "./sentences.ts";

export type Dictionary = Readonly<Record<string, string>>;

/** The texts of the page, those of the server that only the page shows, and the dictionaries of its reports. */
export interface Language {
  texts: readonly Dictionary[];
  server: readonly Dictionary[];
  reports: readonly string[];
  /** Titles of diagnostics, by their codes. */
  codes: readonly Dictionary[];
}

/** As the choice names them, and where the texts are. */
const LANGUAGES: Readonly<Record<string, { name: string; load: () => Promise<Language | null> }>> = {
  en: { name: "English", load: async () => null },
  de: { name: "Deutsch", load: async () => (await import("./de/index.ts")).de },
  zh: { name: "中文", load: async () => (await import("./zh/index.ts")).zh },
};
const KEPT = "trueaxis-language";

export const languages = Object.entries(LANGUAGES).map(([code, { name }]) => ({ code, name }));

export function language(): string {
  const kept = localStorage.getItem(KEPT);
  if (kept && kept in LANGUAGES) return kept;
  const own = navigator.language.slice(0, 2);
  return own in LANGUAGES ? own : "en";
}

/** The page is loaded again; its address and the dropped files are kept, unsaved edits are asked about. */
export function chooseLanguage(code: string): void {
  localStorage.setItem(KEPT, code);
  location.reload();
}

let dictionary = new Map<string, string>();
let codes = new Map<string, string>();
let ofServer: (text: string) => string | undefined = () => undefined;
/** The pieces of a text between its values, and which value follows each: the same for every use of one place. */
const pieces = new WeakMap<TemplateStringsArray, { texts: string[]; order: number[] }>();

/** Before anything is shown: a text that was made earlier stays English. */
export async function loadLanguage(): Promise<void> {
  const chosen = await LANGUAGES[language()]?.load();
  if (!chosen) return;
  dictionary = new Map(chosen.texts.flatMap((texts) => Object.entries(texts)));
  codes = new Map(chosen.codes.flatMap((titles) => Object.entries(titles)));
  // Words of the page are also said by the server (units, axes); its short sentences would fit anything.
  const words = chosen.texts.flatMap((texts) => Object.entries(texts)).filter(([text]) => !text.includes("{"));
  const server = chosen.server.flatMap((texts) => Object.entries(texts));
  ofServer = lookupOf([...words, ...chosen.reports.flatMap(entriesOf), ...server]);
}

/** The English text of a place is its key: `{0}`, `{1}` stand for the values. */
export const keyOf = (texts: readonly string[]): string =>
  texts.reduce((key, text, i) => (i === 0 ? text : `${key}{${i - 1}}${text}`), "");

function piecesOf(texts: TemplateStringsArray): { texts: string[]; order: number[] } {
  const known = pieces.get(texts);
  if (known) return known;
  const translated = dictionary.get(keyOf(texts));
  const split = translated === undefined ? [] : translated.split(/\{(\d+)\}/);
  const made =
    translated === undefined
      ? { texts: [...texts], order: texts.slice(1).map((_, i) => i) }
      : { texts: split.filter((_, i) => i % 2 === 0), order: split.filter((_, i) => i % 2 === 1).map(Number) };
  pieces.set(texts, made);
  return made;
}

/**
 * A text in the language of the page: tr`${n} of ${m} lines`. The dictionary has "{0} of {1} lines" and may use the
 * values in another order.
 */
export function tr(texts: TemplateStringsArray, ...values: readonly unknown[]): string {
  const { texts: between, order } = piecesOf(texts);
  return between.reduce((said, text, i) => said + String(values[order[i - 1] ?? 0]) + text);
}

/** `error`, `warning` or `note` of a diagnostic: not the error of a machine. */
export function severityWord(severity: string): string {
  return ofServer(`severity ${severity}`) ?? severity;
}

/** What a diagnostic is about, by its code; null in English, where its message says it. */
export const codeWords = (code: string): string | null => codes.get(code) ?? null;

/** A text that comes from the server, or from a table, where a dictionary knows it. */
export const trText = (text: string): string => ofServer(text) ?? text;
