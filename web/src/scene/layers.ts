/** What is drawn in the frame of the workpiece: tool paths and surfaces, coloured by value. */

import {
  Box3,
  BufferAttribute,
  BufferGeometry,
  Group,
  Line,
  LineBasicMaterial,
  Mesh,
  MeshBasicMaterial,
  DoubleSide,
  Points,
  PointsMaterial,
  Vector2,
  Vector3,
} from "three";
import { colourTable, rangeOf, sequential, type ColourMap } from "../figure/colours.ts";

export interface PathData {
  /** x, y, z per point, mm, workpiece frame, relative to `origin`. */
  positions: Float32Array;
  origin: readonly [number, number, number];
  /** What is coloured, one per point; NaN is grey. */
  values: Float32Array;
  /** 1 where the point is reached in rapid. */
  rapid?: Uint8Array;
  /** Actual − nominal, x, y, z per point, mm: drawn exaggerated as a second line. */
  deviations?: Float32Array;
  map?: ColourMap;
  /** Default: the range of the values. */
  range?: [number, number];
}

export interface SurfaceData {
  /** x, y, z per point, mm, workpiece frame: rings one after the other. */
  positions: Float32Array;
  rings: number;
  points_per_ring: number;
  /** True if the last point of a ring is joined to its first. */
  closed: boolean;
  /** Actual − nominal, x, y, z per point, mm. */
  displacements?: Float32Array;
  values: Float32Array;
  map?: ColourMap;
  range?: [number, number];
}

function paint(
  values: Float32Array,
  map: ColourMap,
  range: [number, number],
  alpha: (i: number) => number,
): Uint8Array {
  const table = colourTable(map);
  const [low, high] = range;
  const scale = high > low ? 255 / (high - low) : 0;
  const colours = new Uint8Array(4 * values.length);
  for (let i = 0; i < values.length; i++) {
    const v = values[i] as number;
    const at = 4 * i;
    if (!Number.isNaN(v)) {
      const k = 3 * Math.max(0, Math.min(255, Math.round((v - low) * scale)));
      colours[at] = table[k] as number;
      colours[at + 1] = table[k + 1] as number;
      colours[at + 2] = table[k + 2] as number;
    } else {
      colours[at] = colours[at + 1] = colours[at + 2] = 90;
    }
    colours[at + 3] = alpha(i);
  }
  return colours;
}

function displaced(positions: Float32Array, by: Float32Array | undefined, k: number, into: Float32Array): void {
  if (!by) into.set(positions);
  else for (let i = 0; i < positions.length; i++) into[i] = (positions[i] as number) + k * (by[i] as number);
}

/**
 * The points of a long path that matter at the size of the whole: a point is kept once it lies
 * farther than a tolerance from the last one kept, or its value or kind has changed. The tolerance
 * starts at 1/4000 of the extent and doubles until at most `budget` points are left.
 */
export function thinned(
  positions: Float32Array,
  values: Float32Array,
  rapid: Uint8Array | undefined,
  range: [number, number],
  budget: number,
): Uint32Array {
  const n = Math.floor(positions.length / 3);
  if (n <= budget) return Uint32Array.from({ length: n }, (_, i) => i);
  const [low, high] = rangeOf(positions);
  const step = 0.04 * (range[1] - range[0]) || Infinity;
  const kept = new Uint32Array(n);
  for (let tolerance = (high - low) / 4000, value_step = step; ; tolerance *= 2, value_step *= 1.5) {
    let count = 0;
    let last = -1;
    for (let i = 0; i < n && count <= budget; i++) {
      const far =
        last < 0 ||
        i === n - 1 ||
        Math.hypot(
          (positions[3 * i] as number) - (positions[3 * last] as number),
          (positions[3 * i + 1] as number) - (positions[3 * last + 1] as number),
          (positions[3 * i + 2] as number) - (positions[3 * last + 2] as number),
        ) > tolerance;
      if (
        !far &&
        Math.abs((values[i] as number) - (values[last] as number)) <= value_step &&
        rapid?.[i] === rapid?.[last]
      )
        continue;
      kept[count++] = i;
      last = i;
    }
    if (count <= budget || tolerance > high - low) return kept.slice(0, Math.min(count, budget));
  }
}

/** A line of vertex colours that can be shifted by a part of a point: WebGL lines are one point thin. */
function shiftable(shift: { value: Vector2 }): LineBasicMaterial {
  // Seen through the machine: most of a path is covered by something.
  const material = new LineBasicMaterial({ vertexColors: true, transparent: true, depthTest: false });
  material.onBeforeCompile = (shader) => {
    shader.uniforms.shift = shift;
    shader.vertexShader = shader.vertexShader
      .replace("void main() {", "uniform vec2 shift;\nvoid main() {")
      .replace("#include <project_vertex>", "#include <project_vertex>\n\tgl_Position.xy += shift * gl_Position.w;");
  };
  return material;
}

/** One polyline of any length, coloured by its values: what is done thick and bright, the rest thin and paler. */
export class PathLayer {
  readonly group = new Group();
  readonly range: [number, number];
  readonly count: number;
  private readonly geometry = new BufferGeometry();
  private readonly rest: BufferGeometry;
  private readonly done: Line;
  /** The same line one point to the right and one up, so that it is seen on fine screens. */
  private readonly beside: Line[];
  private readonly shifts = [{ value: new Vector2() }, { value: new Vector2() }];
  private readonly dim: Line;
  private ghost: Line | null = null;
  private readonly data: PathData;
  /** Indices of the points that are drawn, ascending. */
  private readonly kept: Uint32Array;

  constructor(data: PathData, ghost: string, budget = 2_000_000) {
    this.data = data;
    this.count = Math.floor(data.positions.length / 3);
    this.range = data.range ?? rangeOf(data.values);
    this.kept = thinned(data.positions, data.values, data.rapid, this.range, budget);
    const index = new BufferAttribute(this.kept, 1);
    const position = new BufferAttribute(data.positions, 3);
    this.geometry.setAttribute("position", position).setIndex(index);
    const rapid = data.rapid;
    const colour = new BufferAttribute(
      paint(data.values, data.map ?? sequential, this.range, (i) => (rapid?.[i] ? 70 : 255)),
      4,
      true,
    );
    this.geometry.setAttribute("color", colour);
    this.rest = new BufferGeometry().setAttribute("position", position).setAttribute("color", colour).setIndex(index);
    this.done = new Line(this.geometry, shiftable({ value: new Vector2() }));
    this.beside = this.shifts.map((shift) => new Line(this.geometry, shiftable(shift)));
    this.dim = new Line(
      this.rest,
      new LineBasicMaterial({ vertexColors: true, transparent: true, opacity: 0.9, depthTest: false }),
    );
    if (data.deviations)
      this.ghost = new Line(
        new BufferGeometry()
          .setAttribute("position", new BufferAttribute(new Float32Array(data.positions.length), 3))
          .setIndex(index),
        new LineBasicMaterial({ color: ghost, transparent: true, opacity: 0.8 }),
      );
    for (const line of [this.dim, this.done, ...this.beside]) line.renderOrder = 8;
    this.group.add(this.dim, this.done, ...this.beside);
    if (this.ghost) this.group.add(this.ghost);
    for (const line of this.group.children) line.frustumCulled = false;
    this.group.position.set(...data.origin);
    this.setExaggeration(1);
    this.setProgress(this.count);
  }

  setProgress(n: number): void {
    // How many of the kept points lie before n.
    let [done, above] = [0, this.kept.length];
    while (done < above) {
      const middle = (done + above) >> 1;
      if ((this.kept[middle] as number) < n) done = middle + 1;
      else above = middle;
    }
    this.geometry.setDrawRange(0, done);
    this.rest.setDrawRange(Math.max(0, done - 1), this.kept.length);
    this.ghost?.geometry.setDrawRange(0, done);
    this.dim.visible = done < this.kept.length;
  }

  setExaggeration(k: number): void {
    if (!this.ghost) return;
    const position = this.ghost.geometry.getAttribute("position") as BufferAttribute;
    displaced(this.data.positions, this.data.deviations, k, position.array as Float32Array);
    position.needsUpdate = true;
  }

  /** Where the path cuts; all of it if it is rapid throughout. */
  extent(): Box3 {
    const box = new Box3();
    const { positions, rapid } = this.data;
    const add = (i: number): unknown =>
      box.expandByPoint(new Vector3(positions[3 * i], positions[3 * i + 1], positions[3 * i + 2]));
    for (const i of this.kept) if (!rapid?.[i]) add(i);
    if (box.isEmpty()) for (const i of this.kept) add(i);
    return box;
  }

  /** The size of the picture in points; a picture in a hurry has thin lines. */
  setPicture(width: number, height: number, thick: boolean): void {
    this.shifts[0]?.value.set(2 / width, 0);
    this.shifts[1]?.value.set(0, 2 / height);
    for (const line of this.beside) line.visible = thick;
  }

  /** The displaced line. */
  setGhostVisible(visible: boolean): void {
    if (this.ghost) this.ghost.visible = visible;
  }

  dispose(): void {
    for (const line of [this.done, ...this.beside, this.dim, this.ghost]) {
      line?.geometry.dispose();
      (line?.material as LineBasicMaterial | undefined)?.dispose();
    }
  }
}

/** A measured or predicted surface: rings of points, coloured by value, displaced by k times its deviation. */
export class SurfaceLayer {
  readonly group = new Group();
  readonly range: [number, number];
  private readonly geometry = new BufferGeometry();
  private readonly data: SurfaceData;

  constructor(data: SurfaceData) {
    this.data = data;
    this.range = data.range ?? rangeOf(data.values);
    this.geometry.setAttribute("position", new BufferAttribute(new Float32Array(data.positions.length), 3));
    this.geometry.setAttribute(
      "color",
      new BufferAttribute(
        paint(data.values, data.map ?? sequential, this.range, () => 255),
        4,
        true,
      ),
    );
    if (data.rings > 1 && data.points_per_ring > 1) {
      this.geometry.setIndex(grid(data.rings, data.points_per_ring, data.closed));
      this.group.add(new Mesh(this.geometry, new MeshBasicMaterial({ vertexColors: true, side: DoubleSide })));
    } else
      this.group.add(
        new Points(this.geometry, new PointsMaterial({ vertexColors: true, size: 3, sizeAttenuation: false })),
      );
    for (const child of this.group.children) child.frustumCulled = false;
    this.setExaggeration(1);
  }

  setExaggeration(k: number): void {
    const position = this.geometry.getAttribute("position") as BufferAttribute;
    displaced(this.data.positions, this.data.displacements, k, position.array as Float32Array);
    position.needsUpdate = true;
    this.geometry.computeBoundingBox();
  }

  dispose(): void {
    this.geometry.dispose();
    for (const child of this.group.children) ((child as Mesh).material as MeshBasicMaterial).dispose();
  }
}

function grid(rings: number, m: number, closed: boolean): number[] {
  const index: number[] = [];
  const last = closed ? m : m - 1;
  for (let r = 0; r + 1 < rings; r++) {
    for (let j = 0; j < last; j++) {
      const a = r * m + j;
      const b = r * m + ((j + 1) % m);
      index.push(a, b, a + m, b, b + m, a + m);
    }
  }
  return index;
}
