/** The ground of the picture: light, and a grid of round millimetres. */

import {
  type Box3,
  DirectionalLight,
  GridHelper,
  Group,
  HemisphereLight,
  type LineBasicMaterial,
  Vector3,
} from "three";
import { cssColour } from "../theme.ts";

export function lights(): Group {
  const sun = new DirectionalLight(0xffffff, 1.5);
  sun.position.set(-0.25, -1.0, 1.3);
  return new Group().add(new HemisphereLight(0xffffff, 0xb4bac2, 2.2), sun);
}

export interface Grid {
  helper: GridHelper;
  step_mm: number;
}

/** Under everything in `box`. */
export function gridUnder(box: Box3): Grid {
  const size = box.getSize(new Vector3());
  const wide = Math.max(size.x, size.y) * 1.5;
  const cell = 10 ** Math.floor(Math.log10(wide / 8));
  const step_mm = wide / cell > 40 ? 5 * cell : wide / cell > 16 ? 2 * cell : cell;
  const count = 2 * Math.ceil(wide / step_mm / 2);
  const helper = new GridHelper(count * step_mm, count, cssColour("--scene-grid"), cssColour("--scene-grid"));
  const material = helper.material as LineBasicMaterial;
  material.transparent = true;
  material.opacity = 0.55;
  helper.rotateX(Math.PI / 2);
  const centre = box.getCenter(new Vector3());
  helper.position.set(
    Math.round(centre.x / step_mm) * step_mm,
    Math.round(centre.y / step_mm) * step_mm,
    box.min.z - 1e-3 * wide,
  );
  return { helper, step_mm };
}
