import { languageOf, type Room } from "../rooms.ts";

export const zh = languageOf(
  import.meta.glob<Room>(["./*.ts", "!./index.ts"], { eager: true }),
  // What the reports of the program say.
  import.meta.glob<string>("../../../../crates/trueaxis-words/src/zh/*.toml", {
    query: "?raw",
    import: "default",
    eager: true,
  }),
);
