/** The tool as it is drawn: its tip stands where the simulation says it is. */

import { Matrix4, Vector3 } from "three";
import type { MachineDescription, ToolShape, Vector } from "../../api.ts";
import { matrixOf } from "../../scene/shapes.ts";

/** Diameter of a tool of unknown diameter, in lengths: so slim that the path beside it is seen. */
const SLIM = 0.06;

/** The tip, given in the workpiece frame, carried into the body of the tool by the poses of this moment. */
export function toolOf(machine: MachineDescription, tip_mm: Vector, nominal: Float64Array): ToolShape {
  const pose = (kind: "workpiece" | "tool"): Matrix4 => matrixOf(nominal, 12 * machine.links.findIndex((link) => link.kind === kind), new Matrix4());
  const tip = new Vector3(...tip_mm).applyMatrix4(pose("workpiece")).applyMatrix4(pose("tool").invert());
  const length = tip.length();
  const own = machine.tool;
  if (Math.abs(length - own.length_mm) < 1e-3) return own;
  return { length_mm: length, diameter_mm: own.diameter_mm ?? SLIM * length, tip_mm: [tip.x, tip.y, tip.z] };
}
