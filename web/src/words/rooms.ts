/** The files of a language together: one for each room of the page, and those of the reports. */

import type { Dictionary, Language } from "./index.ts";

/** What a file of a language may have. */
export interface Room {
  /** Texts of the page, by the English ones in `tr`. */
  texts?: Dictionary;
  /** Texts of the server that are in no report. */
  server?: Dictionary;
  /** Titles of diagnostics, by their codes. */
  codes?: Dictionary;
}

type Files<T> = Readonly<Record<string, T>>;

export function languageOf(files: Files<Room>, reports: Files<string>): Language {
  const rooms = Object.values(files);
  const all = (part: keyof Room): Dictionary[] => rooms.map((room) => room[part] ?? {});
  return { texts: all("texts"), server: all("server"), codes: all("codes"), reports: Object.values(reports) };
}
