/** Shapes of the machine file as geometry; placements as matrices (doubles kept). */

import {
  type Box3,
  BoxGeometry,
  BufferAttribute,
  BufferGeometry,
  CylinderGeometry,
  ExtrudeGeometry,
  Matrix4,
  Shape as Outline,
  Vector3,
} from "three";
import type { Shape } from "../api.ts";
import type { Role } from "./materials.ts";

/** A piece of geometry that moves with one body. */
export interface Part {
  /** Index in `links`; null is the bed. */
  body: number | null;
  name: string;
  geometry: BufferGeometry;
  /** body_from_part */
  matrix: Matrix4;
  /** Default: that of its body. */
  role?: Role;
}

export function cornersOf({ min, max }: Box3): Vector3[] {
  return Array.from(
    { length: 8 },
    (_, i) => new Vector3(i & 1 ? max.x : min.x, i & 2 ? max.y : min.y, i & 4 ? max.z : min.z),
  );
}

/** 12 numbers (rotation row by row, origin) -> matrix. */
export function matrixOf(p: ArrayLike<number>, offset = 0, into = new Matrix4()): Matrix4 {
  const n = (i: number): number => p[offset + i] as number;
  return into.set(n(0), n(1), n(2), n(9), n(3), n(4), n(5), n(10), n(6), n(7), n(8), n(11), 0, 0, 0, 1);
}

/** Its z axis along `direction`, origin at `at`. */
export function alongMatrix(at: Vector3, direction: Vector3): Matrix4 {
  const z = direction.clone().normalize();
  const x = Math.abs(z.z) < 0.9 ? new Vector3(0, 0, 1).cross(z).normalize() : new Vector3(0, 1, 0).cross(z).normalize();
  const y = z.clone().cross(x);
  return new Matrix4().makeBasis(x, y, z).setPosition(at);
}

/** A cone or cylinder standing on z = 0. */
export function standingCone(base_radius: number, top_radius: number, length: number): BufferGeometry {
  return new CylinderGeometry(top_radius, base_radius, length, 48).rotateX(Math.PI / 2).translate(0, 0, length / 2);
}

export function geometryOf(shape: Shape): BufferGeometry {
  if ("box" in shape) return new BoxGeometry(...shape.box);
  if ("cone" in shape) {
    const { base_diameter_mm, top_diameter_mm, length_mm } = shape.cone;
    return standingCone(base_diameter_mm / 2, top_diameter_mm / 2, length_mm);
  }
  if ("prism" in shape) {
    const outline = new Outline();
    shape.prism.outline_mm.forEach(([x, y], i) => (i === 0 ? outline.moveTo(x, y) : outline.lineTo(x, y)));
    outline.closePath();
    return new ExtrudeGeometry(outline, { depth: shape.prism.length_mm, bevelEnabled: false });
  }
  // Of an STL file only the name is known here.
  if ("stl" in shape) return new BufferGeometry();
  const positions = shape.mesh instanceof Float32Array ? shape.mesh : Float32Array.from(shape.mesh);
  const geometry = new BufferGeometry();
  geometry.setAttribute("position", new BufferAttribute(positions, 3));
  geometry.computeVertexNormals();
  return geometry;
}
