/** The tool as cylinders, and the block that stands in for an unknown workpiece. */

import { BoxGeometry, CylinderGeometry, Matrix4, Raycaster, Vector3 } from "three";
import type { ToolShape } from "../api.ts";
import type { Bodies } from "./bodies.ts";
import { unitOf } from "./schematic.ts";
import { standingCone, type Part } from "./shapes.ts";

/** Radius of a tool of unknown diameter, in lengths: so slim that it covers little. */
const SLIM = 0.03;

/** What the set-up states of the tool; else a holder and a cutter of its length. */
export function toolParts(bodies: Bodies, tool: ToolShape): Part[] {
  const body = bodies.indexOf("tool");
  if (body < 0) return [];
  return tool.segments_mm?.length
    ? stated(body, tool, tool.segments_mm)
    : inProportion(body, tool, unitOf(bodies.links));
}

function stated(body: number, { length_mm, tip_mm }: ToolShape, segments: readonly [number, number][]): Part[] {
  const [x, y, tip] = tip_mm ?? [0, 0, -length_mm];
  let z = tip;
  return segments.map(([diameter, length], i) => {
    const matrix = new Matrix4().makeTranslation(x, y, z);
    z += length;
    return {
      body,
      name: i === 0 ? "tool" : "tool holder",
      geometry: standingCone(diameter / 2, diameter / 2, length),
      matrix,
      role: i === 0 ? "cutter" : "tool",
    };
  });
}

function inProportion(body: number, { length_mm, diameter_mm }: ToolShape, u: number): Part[] {
  if (!(length_mm > 0)) return [];
  const radius = diameter_mm !== null && diameter_mm > 0 ? diameter_mm / 2 : SLIM * length_mm;
  const holder = Math.min(0.45 * length_mm, 0.5 * u);
  const cutter = new CylinderGeometry(radius, radius, length_mm - holder, 32)
    .rotateX(Math.PI / 2)
    .translate(0, 0, -(length_mm + holder) / 2);
  return [
    {
      body,
      name: "tool holder",
      geometry: standingCone(Math.max(1.5 * radius, 0.12 * u), Math.max(2 * radius, 0.2 * u), holder),
      matrix: new Matrix4().makeTranslation(0, 0, -holder),
    },
    { body, name: "tool", geometry: cutter, matrix: new Matrix4(), role: "cutter" },
  ];
}

/** A block at part zero: it fills the room down to the table where there is some. */
export function workpieceBlock(bodies: Bodies): Part | null {
  const w = bodies.indexOf("workpiece");
  const node = bodies.nodeAt(w);
  if (!node) return null;
  const u = unitOf(bodies.links);
  bodies.root.updateMatrixWorld(true);
  const down = new Vector3(0, 0, -1).transformDirection(node.matrixWorld);
  const zero = new Vector3().setFromMatrixPosition(node.matrixWorld);
  const carriers = bodies.solids((i) => i === null || bodies.links[i]?.carries === "workpiece");
  const gap = new Raycaster(zero, down, 0, 1.5 * u).intersectObjects(carriers, false)[0]?.distance ?? 0;
  const roomy = gap > 0.12 * u;
  const height = roomy ? gap : 0.32 * u;
  const matrix = new Matrix4().makeTranslation(0, 0, roomy ? -gap / 2 : height / 2);
  return { body: w, name: "workpiece", geometry: new BoxGeometry(0.62 * u, 0.62 * u, height), matrix };
}
