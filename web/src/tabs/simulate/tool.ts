/** The tool of the present moment, as it is drawn. */

import { tr } from "../../words/index.ts";
import { Matrix4, Vector3 } from "three";
import type { MachineDescription, ToolShape } from "../../api.ts";
import { matrixOf } from "../../scene/shapes.ts";
import type { Moment, SetUpTool } from "./answers.ts";

/**
 * The cylinders that the set-up states, where the tool sits in its holder: it is there before the
 * program counts with its length. Else the tool of the machine file, its tip where the program puts it.
 */
export function toolOf(
  machine: MachineDescription,
  tools: readonly SetUpTool[],
  moment: Moment,
  nominal: Float64Array,
): ToolShape {
  const stated = tools.find((tool) => tool.tool === moment.tool);
  if (stated && stated.segments_mm.length > 0) {
    const { tip_mm, segments_mm } = stated;
    return { length_mm: Math.hypot(...tip_mm), diameter_mm: segments_mm[0]?.[0] ?? null, tip_mm, segments_mm };
  }
  const tip = tipInHolder(machine, moment, nominal);
  const length = tip.length();
  const own = machine.tool;
  return own && Math.abs(length - own.length_mm) < 1e-3
    ? own
    : { length_mm: length, diameter_mm: own?.diameter_mm ?? null, tip_mm: tip.toArray() };
}

/** What must be said about the picture of the tool. */
export function toolNote(machine: MachineDescription, tools: readonly SetUpTool[], moment: Moment): string | null {
  const stated = tools.find((tool) => tool.tool === moment.tool);
  if (stated ? stated.segments_mm.length > 0 : machine.tool?.diameter_mm != null) return null;
  return moment.tool === null ? tr`tool of unknown diameter` : tr`T${moment.tool} of unknown diameter`;
}

/** The tip, given in the workpiece frame, carried into the body of the tool by the poses of this moment. */
function tipInHolder(machine: MachineDescription, moment: Moment, nominal: Float64Array): Vector3 {
  const pose = (kind: "workpiece" | "tool"): Matrix4 =>
    matrixOf(nominal, 12 * machine.links.findIndex((link) => link.kind === kind), new Matrix4());
  return new Vector3(...moment.tip_mm).applyMatrix4(pose("workpiece")).applyMatrix4(pose("tool").invert());
}
