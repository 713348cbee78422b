/** What is chosen on the tab, and the answers of the server. */

import { tr } from "../../words/index.ts";
import type {
  ServeCompensateAdapt,
  ServeCompensateProgram,
  ServeCompensateTables,
  ServeCompensateValues,
} from "../../../types.d.ts";

export type ProgramHeader = ServeCompensateProgram;
export type TablesReply = ServeCompensateTables;
export type ValuesReply = ServeCompensateValues;
export type AdaptReply = ServeCompensateAdapt;

/** What is to be compensated. */
export type Of = "program" | "tables" | "values" | "blank";

export const KINDS: readonly [Of, string][] = [
  ["program", tr`NC program`],
  ["tables", tr`Tables of a control`],
  ["values", tr`Values of an axis`],
  ["blank", tr`Path on a blank`],
];

/** What stands in the address. */
export interface Choice {
  of: Of;
  machine: string | null;
  program: string | null;
  setup: string | null;
  control: string | null;
  target: string;
  axis: string;
  /** The position of the other axes. */
  at: string;
  step: string;
  study: string | null;
  temperature: string;
  residual: string;
  /** Options that are on, by their names on the command line. */
  options: readonly string[];
}
