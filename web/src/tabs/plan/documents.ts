/** The document of `trueaxis plan --format json`, as far as the page shows it. */

import type { ServePlan } from "../../../types.d.ts";

export type PlanHeader = ServePlan;
export type PlanDocument = ServePlan["document"];
export type PathDocument = PlanDocument["paths"][number];
export type Expected = PlanDocument["expected"][number];
/** The check of a program that could be made. */
export type Program = Exclude<NonNullable<PathDocument["program"]>, { missing: string }>;

/** The check of the program of a path, if it could be made. */
export function programOf({ program }: PathDocument): Program | null {
  return program && !("missing" in program) ? program : null;
}
export type Chosen = NonNullable<PlanDocument["chosen"]>;
