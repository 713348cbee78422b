/** What was answered about a new machine, and the request that it becomes. */

import { tr } from "../../words/index.ts";
import type { Request } from "../../api.ts";

export interface AxisAnswer {
  from: string;
  to: string;
  unlimited: boolean;
  /** Its plus is against ISO 841. */
  reversed: boolean;
}

export interface MachineAnswers {
  kind: string;
  name: string;
  workpiece: string[];
  tilting: "A" | "B" | null;
  /** mm; empty as in the template. */
  height: string;
  axes: Record<string, AxisAnswer>;
}

/** A decimal comma counts as a point; 1,000 may be one or a thousand, and is none. */
const numberOf = (typed: string): number =>
  /^[+-]?[1-9]\d{0,2},\d{3}$/.test(typed.trim()) ? Number.NaN : Number(typed.trim().replace(",", ".") || "x");

/** What is wrong with the answers; null if nothing is. */
export function wrongAnswers(answers: MachineAnswers, axes: readonly string[]): string | null {
  if (answers.name.trim() === "") return tr`The machine has no name.`;
  if (/["\\]/.test(answers.name)) return tr`The name cannot contain " or \\.`;
  if (answers.height.trim() !== "" && !Number.isFinite(numberOf(answers.height)))
    return tr`"${answers.height}" is not a number of mm.`;
  for (const axis of axes) {
    const { from, to, unlimited } = answers.axes[axis] as AxisAnswer;
    if (unlimited && !"XYZ".includes(axis)) continue;
    const bad = [from, to].find((end) => !Number.isFinite(numberOf(end)));
    if (bad !== undefined) return tr`${axis}: "${bad}" is not a number.`;
    if (numberOf(from) >= numberOf(to)) return tr`${axis} goes from the smaller to the larger number.`;
  }
  return null;
}

export function machineRequest(answers: MachineAnswers, axes: readonly string[]): Request<"new-machine"> {
  const { kind, name, workpiece, tilting, height } = answers;
  const travel = (axis: string): [number, number] | null => {
    const { from, to, unlimited } = answers.axes[axis] as AxisAnswer;
    return unlimited && !"XYZ".includes(axis) ? null : [numberOf(from), numberOf(to)];
  };
  return {
    kind,
    name: name.trim(),
    workpiece,
    tilting,
    travels: Object.fromEntries(axes.map((axis) => [axis, travel(axis)])),
    reversed: axes.filter((axis) => answers.axes[axis]?.reversed),
    height_mm: height.trim() === "" ? null : numberOf(height),
  };
}
