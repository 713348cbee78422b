/** The tabs, in the order of the verbs. A new tab is one line here. */

import { tr } from "../words/index.ts";
import type { TabEntry } from "../app.ts";

export const TABS: readonly TabEntry[] = [
  { name: "start", title: tr`Start`, load: async () => (await import("./start.ts")).start },
  { name: "describe", title: tr`Describe`, load: async () => (await import("./describe.ts")).describe },
  { name: "simulate", title: tr`Simulate`, load: async () => (await import("./simulate.ts")).simulate },
  { name: "predict", title: tr`Predict`, load: async () => (await import("./predict.ts")).predict },
  { name: "plan", title: tr`Plan`, load: async () => (await import("./plan.ts")).plan },
  { name: "measure", title: tr`Measure`, load: async () => (await import("./measure.ts")).measure },
  { name: "identify", title: tr`Identify`, load: async () => (await import("./identify.ts")).identify },
  { name: "compensate", title: tr`Compensate`, load: async () => (await import("./compensate.ts")).compensate },
  { name: "verify", title: tr`Verify`, load: async () => (await import("./verify.ts")).verify },
  { name: "standards", title: tr`Standards`, load: async () => (await import("./standards.ts")).standards },
  { name: "live", title: tr`Live`, load: async () => (await import("./live.ts")).live },
  { name: "report", title: tr`Report`, load: async () => (await import("./report.ts")).report },
];
