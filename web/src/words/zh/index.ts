import type { Dictionary, Language } from "../index.ts";
import { codes as ncCodes } from "./codes-nc.ts";
import { codes as inputCodes } from "./codes-input.ts";
import { codes as identifyCodes } from "./codes-identify.ts";
import { codes as verifyCodes } from "./codes-verify.ts";
import * as compensate from "./compensate.ts";
import * as describe from "./describe.ts";
import * as figure from "./figure.ts";
import * as frame from "./frame.ts";
import * as glossary from "./glossary.ts";
import * as identify from "./identify.ts";
import * as live from "./live.ts";
import * as measure from "./measure.ts";
import * as plan from "./plan.ts";
import * as predict from "./predict.ts";
import * as report from "./report.ts";
import * as scene from "./scene.ts";
import * as simulate from "./simulate.ts";
import * as standards from "./standards.ts";
import * as start from "./start.ts";
import * as verify from "./verify.ts";

const ROOMS: readonly { texts: Dictionary; server?: Dictionary }[] = [
  compensate,
  describe,
  figure,
  frame,
  glossary,
  identify,
  live,
  measure,
  plan,
  predict,
  report,
  scene,
  simulate,
  standards,
  start,
  verify,
];
/** What the reports of the program say: the files of crates/trueaxis-words. */
const REPORTS = import.meta.glob<string>("../../../../crates/trueaxis-words/src/zh/*.toml", {
  query: "?raw",
  import: "default",
  eager: true,
});

export const zh: Language = {
  texts: ROOMS.map((room) => room.texts),
  server: ROOMS.map((room) => room.server ?? {}),
  reports: Object.values(REPORTS),
  codes: [ncCodes, inputCodes, identifyCodes, verifyCodes],
};
