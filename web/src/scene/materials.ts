/** The materials of the picture, in the colours of the theme. */

import { DoubleSide, LineBasicMaterial, type Material, MeshBasicMaterial, MeshLambertMaterial } from "three";
import { cssColour } from "../theme.ts";

/** What a part is: it decides the colour. */
export type Role = "bed" | "linear" | "rotary" | "tool" | "cutter" | "part" | "stock";

type Materials = Record<Role, MeshLambertMaterial> & {
  edge: LineBasicMaterial;
  ghost: MeshBasicMaterial;
  ghost_edge: LineBasicMaterial;
};

function solid(name: string): MeshLambertMaterial {
  return new MeshLambertMaterial({
    color: cssColour(name),
    polygonOffset: true,
    polygonOffsetFactor: 1,
    polygonOffsetUnits: 1,
  });
}

function line(name: string, opacity: number): LineBasicMaterial {
  return new LineBasicMaterial({ color: cssColour(name), transparent: true, opacity });
}

export function makeMaterials(): Materials {
  return {
    bed: solid("--scene-bed"),
    linear: solid("--scene-linear"),
    rotary: solid("--scene-rotary"),
    tool: solid("--scene-tool"),
    cutter: solid("--scene-part"),
    part: solid("--scene-part"),
    // The path inside it must be seen.
    stock: new MeshLambertMaterial({
      color: cssColour("--scene-stock"),
      transparent: true,
      opacity: 0.35,
      depthWrite: false,
      side: DoubleSide,
    }),
    edge: line("--scene-edge", 0.5),
    // Drawn after the solid where both coincide, so that an undisplaced body looks clean.
    ghost: new MeshBasicMaterial({
      color: cssColour("--scene-ghost"),
      transparent: true,
      opacity: 0.2,
      depthWrite: false,
      side: DoubleSide,
      polygonOffset: true,
      polygonOffsetFactor: 2,
      polygonOffsetUnits: 2,
    }),
    ghost_edge: line("--scene-ghost", 0.85),
  };
}

export function disposeMaterials(materials: Materials): void {
  for (const material of Object.values<Material>(materials)) material.dispose();
}

/** The same, seen through. */
export function seenThrough(material: MeshLambertMaterial): MeshLambertMaterial {
  const glass = material.clone();
  Object.assign(glass, { transparent: true, opacity: 0.22, depthWrite: false });
  return glass;
}
