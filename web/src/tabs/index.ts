/** The tabs, in the order of the verbs. A new tab is one line here. */

import type { TabEntry } from "../app.ts";

export const TABS: readonly TabEntry[] = [
  { name: "start", title: "Start", load: async () => (await import("./start.ts")).start },
  { name: "describe", title: "Describe", load: async () => (await import("./describe.ts")).describe },
  { name: "simulate", title: "Simulate", load: async () => (await import("./simulate.ts")).simulate },
  { name: "predict", title: "Predict", load: async () => (await import("./predict.ts")).predict },
  { name: "plan", title: "Plan", load: async () => (await import("./plan.ts")).plan },
  { name: "measure", title: "Measure", load: async () => (await import("./measure.ts")).measure },
  { name: "identify", title: "Identify", load: async () => (await import("./identify.ts")).identify },
  { name: "compensate", title: "Compensate", load: async () => (await import("./compensate.ts")).compensate },
  { name: "verify", title: "Verify", load: async () => (await import("./verify.ts")).verify },
  { name: "standards", title: "Standards", load: async () => (await import("./standards.ts")).standards },
  { name: "live", title: "Live", load: async () => (await import("./live.ts")).live },
  { name: "report", title: "Report", load: async () => (await import("./report.ts")).report },
];
