/** What tests read of the picture: the scene graph, not the numbers that went in. */

import { type Camera, Vector3 } from "three";
import type { ToolShape } from "../api.ts";
import type { Bodies } from "./bodies.ts";

export interface SceneProbe {
  /** bed_from_body, 12 numbers, of the nominal (or ghost) body as in the scene graph. */
  poseOf(name: string, which?: "nominal" | "ghost"): number[] | null;
  /** The tool tip in the workpiece frame, mm. */
  nominalTip(): [number, number, number] | null;
  /** Least and greatest corner of the parts of a body, in its own frame, mm. */
  boxOf(name: string): number[] | null;
  /** Names of the parts that are seen on a body. */
  partsOf(name: string): string[];
  /** Where a point of a body, in its frame, is seen on the page. */
  pixelOf(name: string, point: [number, number, number]): [number, number] | null;
  frames(): number;
  /** What the Simulate tab shows now: the time, the axis positions, mm and deg, and from where they came, in full. */
  moment?: () => { time_s: number; axes: Record<string, number>; approach: Record<string, number> } | null;
}

declare global {
  interface Window {
    trueaxisScene?: SceneProbe;
  }
}

export function probeOf(
  bodies: Bodies,
  tool: () => ToolShape | null,
  frames: () => number,
  seen: () => { box: DOMRect; camera: Camera },
): SceneProbe {
  return {
    pixelOf: (name, point) => {
      const body = bodies.named(name);
      if (!body) return null;
      const { box, camera } = seen();
      const p = new Vector3(...point).applyMatrix4(body.node.matrixWorld).project(camera);
      return [box.left + (box.width * (p.x + 1)) / 2, box.top + (box.height * (1 - p.y)) / 2];
    },
    poseOf: (name, which = "nominal") => poseOf(bodies, name, which),
    nominalTip: () => nominalTip(bodies, tool()),
    boxOf: (name) => {
      const body = bodies.named(name);
      if (!body) return null;
      const { min, max } = bodies.boxOf(body);
      return [...min.toArray(), ...max.toArray()];
    },
    partsOf: (name) =>
      (bodies.named(name)?.node.children ?? [])
        .filter((child) => "isMesh" in child && child.visible)
        .map((child) => child.name),
    frames,
  };
}

function poseOf(bodies: Bodies, name: string, which: "nominal" | "ghost"): number[] | null {
  const body = bodies.named(name);
  if (!body) return null;
  const node = which === "ghost" ? body.ghost : body.node;
  node.updateWorldMatrix(true, false);
  const e = node.matrixWorld.elements;
  return [0, 4, 8, 1, 5, 9, 2, 6, 10, 12, 13, 14].map((i) => e[i] as number);
}

function nominalTip(bodies: Bodies, tool: ToolShape | null): [number, number, number] | null {
  const w = bodies.nodeAt(bodies.indexOf("workpiece"));
  const t = bodies.nodeAt(bodies.indexOf("tool"));
  if (!w || !t || !tool) return null;
  w.updateWorldMatrix(true, false);
  t.updateWorldMatrix(true, false);
  const tip = new Vector3(...(tool.tip_mm ?? [0, 0, -tool.length_mm]));
  return tip.applyMatrix4(t.matrixWorld).applyMatrix4(w.matrixWorld.clone().invert()).toArray();
}
