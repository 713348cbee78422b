import { languageOf, type Room } from "../rooms.ts";

export const de = languageOf(
  import.meta.glob<Room>(["./*.ts", "!./index.ts"], { eager: true }),
  // What the reports of the program say.
  import.meta.glob<string>("../../../../crates/trueaxis-words/src/de/*.toml", {
    query: "?raw",
    import: "default",
    eager: true,
  }),
);
