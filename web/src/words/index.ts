/** The language of the frame: that of the browser, or the user's choice kept in localStorage. What the tabs say is English. */

import { de } from "./de.ts";
import { en, type Words } from "./en.ts";
import { zh } from "./zh.ts";

const LANGUAGES: Readonly<Record<string, Words>> = { en, de, zh };
const KEPT = "trueaxis-language";

export const languages = Object.entries(LANGUAGES).map(([code, { name }]) => ({ code, name }));

export function language(): string {
  const kept = localStorage.getItem(KEPT);
  if (kept && kept in LANGUAGES) return kept;
  const own = navigator.language.slice(0, 2);
  return own in LANGUAGES ? own : "en";
}

export const words: Words = LANGUAGES[language()] ?? en;

/** The page is loaded again; its address and the dropped files are kept, unsaved edits are asked about. */
export function chooseLanguage(code: string): void {
  localStorage.setItem(KEPT, code);
  location.reload();
}
