/** The arrow of positive motion of every axis, drawn over the machine. */

import {
  type Box3,
  BufferGeometry,
  Group,
  Line,
  LineBasicMaterial,
  type Matrix4,
  Mesh,
  MeshBasicMaterial,
  Vector3,
} from "three";
import type { Link } from "../api.ts";
import { alongMatrix, standingCone } from "./shapes.ts";

export interface AxisArrow {
  /** Child of the body. */
  group: Group;
  /** Where the letter stands, in the body. */
  label_at: Vector3;
  text: string;
}

function head(material: MeshBasicMaterial, at: Vector3, direction: Vector3, size: number): Mesh {
  const mesh = new Mesh(standingCone(0.32 * size, 0, size), material);
  mesh.matrixAutoUpdate = false;
  mesh.matrix.copy(alongMatrix(at, direction));
  mesh.renderOrder = 10;
  return mesh;
}

function stroke(points: Vector3[], material: LineBasicMaterial): Line {
  const line = new Line(new BufferGeometry().setFromPoints(points), material);
  line.renderOrder = 10;
  return line;
}

/**
 * `box` bounds the body in its own frame. The arrow shows how the *body* moves on a positive
 * command; an axis that carries the workpiece moves its body the other way and has a prime (ISO 841).
 */
export function axisArrow(link: Link, box: Box3, body: Matrix4, size: number, colour: string): AxisArrow {
  const sense = link.sense ?? (link.carries === "workpiece" ? -1 : 1);
  const d = new Vector3(...link.direction).normalize().multiplyScalar(sense);
  const group = new Group();
  const solid = new MeshBasicMaterial({ color: colour, depthTest: false, transparent: true });
  const thin = new LineBasicMaterial({ color: colour, depthTest: false, transparent: true });
  const text = `+${link.name}${link.carries === "workpiece" ? "\u2032" : ""}`;
  const centre = box.getCenter(new Vector3());
  const extent = box.getSize(new Vector3());
  if (link.kind === "linear") {
    const up = new Vector3(0, 0, 1).transformDirection(body.clone().invert());
    const vertical = Math.abs(d.dot(up)) > 0.7;
    const from = centre.clone();
    if (vertical) from.x += extent.x / 2 + 0.25 * size;
    else
      from.addScaledVector(
        up,
        (Math.abs(up.x) * extent.x + Math.abs(up.y) * extent.y + Math.abs(up.z) * extent.z) / 2 + 0.12 * size,
      );
    const to = from.clone().addScaledVector(d, size);
    group.add(stroke([from, to], thin), head(solid, to, d, 0.3 * size));
    return { group, label_at: to.clone().addScaledVector(d, 0.55 * size), text };
  }
  const axis = d.clone().multiplyScalar(centre.dot(d));
  const side =
    new Vector3(1, 0, 0).cross(d).length() > 0.3
      ? new Vector3(1, 0, 0).cross(d).normalize()
      : new Vector3(0, 1, 0).cross(d).normalize();
  const other = d.clone().cross(side);
  const across = extent.clone().sub(
    d
      .clone()
      .multiply(extent)
      .set(Math.abs(d.x * extent.x), Math.abs(d.y * extent.y), Math.abs(d.z * extent.z)),
  );
  const radius = Math.min(1.6 * size, Math.max(0.7 * size, 0.36 * Math.max(across.x, across.y, across.z) + 0.2 * size));
  const point = (angle: number): Vector3 =>
    axis
      .clone()
      .addScaledVector(side, radius * Math.cos(angle))
      .addScaledVector(other, radius * Math.sin(angle));
  const points = Array.from({ length: 49 }, (_, i) => point(-2.4 + (4.4 * i) / 48));
  const tangent = point(2.01).sub(point(2.0)).normalize();
  group.add(stroke(points, thin), head(solid, point(2.0), tangent, 0.3 * size));
  return {
    group,
    label_at: point(2.0)
      .addScaledVector(point(2.0).sub(axis).normalize(), 0.3 * size)
      .addScaledVector(tangent, 0.3 * size),
    text,
  };
}
