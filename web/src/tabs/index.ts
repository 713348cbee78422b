/** The tabs, in the order of the verbs. A new tab is one line here. */

import type { TabEntry } from "../app.ts";

export const TABS: readonly TabEntry[] = [
  { name: "start", title: "Start", load: async () => (await import("./start.ts")).start },
  { name: "describe", title: "Describe", load: async () => (await import("./describe.ts")).describe },
  { name: "simulate", title: "Simulate", load: async () => (await import("./simulate.ts")).simulate },
];
