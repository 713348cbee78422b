/** The bodies of the machine in the scene graph: each nominal and solid, and actual as a ghost. */

import {
  Box3,
  EdgesGeometry,
  Group,
  LineSegments,
  Matrix4,
  Mesh,
  type MeshLambertMaterial,
  type Object3D,
  type Vector3,
} from "three";
import type { Link } from "../api.ts";
import { cssColour } from "../theme.ts";
import { disposeMaterials, makeMaterials, seenThrough, type Role } from "./materials.ts";
import { homePoses } from "./schematic.ts";
import { cornersOf, matrixOf, type Part } from "./shapes.ts";

/** A part as it is drawn. */
export interface DrawnPart {
  readonly body: Body;
  readonly role: Role;
  readonly solid: Mesh;
  readonly edges: LineSegments;
  readonly ghost: Mesh;
  readonly ghost_edges: LineSegments;
}

/** How a body is drawn. */
export type Look = "solid" | "glass" | "hidden";

interface Body {
  name: string;
  node: Group;
  ghost: Group;
}

const newBody = (name: string): Body => ({ name, node: new Group(), ghost: new Group() });

export class Bodies {
  readonly root = new Group();
  readonly ghost_root = new Group();
  links: readonly Link[] = [];
  private bed = newBody("b");
  private moving: Body[] = [];
  private parts: DrawnPart[] = [];
  private materials = makeMaterials();
  private glass = new Map<Role, MeshLambertMaterial>();
  /** Of bodies that are not solid, by name. */
  private readonly looks = new Map<string, Look>();
  private lit: string | null = null;

  /** New bodies without parts, all axes at 0. */
  build(links: readonly Link[]): void {
    this.clear();
    this.links = links;
    this.moving = links.map((link) => newBody(link.name));
    this.root.add(this.bed.node);
    for (const { node, ghost } of this.moving) {
      node.matrixAutoUpdate = ghost.matrixAutoUpdate = false;
      this.root.add(node);
      this.ghost_root.add(ghost);
    }
    homePoses(links).forEach((pose, i) => this.place(i, pose, pose));
  }

  clear(): void {
    for (const part of [...this.parts]) this.remove(part);
    this.root.clear();
    this.ghost_root.clear();
    this.bed = newBody("b");
    this.moving = [];
    this.looks.clear();
    this.lit = null;
  }

  // ---- parts ----

  add({ body: index, name, geometry, matrix, role = this.roleOf(index) }: Part): DrawnPart {
    const body = this.bodyAt(index);
    const lines = new EdgesGeometry(geometry, 25);
    const part: DrawnPart = {
      body,
      role,
      solid: new Mesh(geometry, this.materials[role]),
      edges: new LineSegments(lines, this.materials.edge),
      ghost: new Mesh(geometry, this.materials.ghost),
      ghost_edges: new LineSegments(lines, this.materials.ghost_edge),
    };
    const { solid, edges, ghost, ghost_edges } = part;
    for (const node of [solid, edges, ghost, ghost_edges]) {
      node.name = name;
      node.matrixAutoUpdate = false;
      node.matrix.copy(matrix);
      node.matrixWorldNeedsUpdate = true;
    }
    ghost.renderOrder = 5;
    ghost_edges.renderOrder = 6;
    body.node.add(solid, edges);
    body.ghost.add(ghost, ghost_edges);
    this.parts.push(part);
    this.dress(part);
    return part;
  }

  remove(part: DrawnPart): void {
    for (const node of [part.solid, part.edges, part.ghost, part.ghost_edges]) node.removeFromParent();
    part.solid.geometry.dispose();
    part.edges.geometry.dispose();
    this.parts = this.parts.filter((p) => p !== part);
  }

  private bodyAt(index: number | null): Body {
    return index === null ? this.bed : (this.moving[index] ?? this.bed);
  }

  private roleOf(index: number | null): Role {
    const kind = index === null ? undefined : this.links[index]?.kind;
    return kind === undefined ? "bed" : kind === "workpiece" ? "part" : (kind as "linear" | "rotary" | "tool");
  }

  /** Index of the body that carries the workpiece or the tool; −1 without one. */
  indexOf(kind: "workpiece" | "tool"): number {
    return this.links.findIndex((link) => link.kind === kind);
  }

  /** The scene graph of a body, for what is drawn on it besides its parts. */
  nodeAt(index: number): Group | null {
    return this.moving[index]?.node ?? null;
  }

  named(name: string): Body | null {
    return name === "b" ? this.bed : (this.moving.find((body) => body.name === name) ?? null);
  }

  /** The solids of the bodies that satisfy `which`; the bed is null. */
  solids(which: (index: number | null) => boolean = () => true): Mesh[] {
    const wanted = new Set([null, ...this.links.keys()].filter(which).map((index) => this.bodyAt(index)));
    return this.parts.filter((part) => wanted.has(part.body)).map((part) => part.solid);
  }

  /** Bounds of what is seen of a body, in its own frame. */
  boxOf(body: Body): Box3 {
    const box = new Box3();
    for (const { solid } of this.parts.filter((part) => part.body === body && part.solid.visible)) {
      solid.geometry.computeBoundingBox();
      if (solid.geometry.boundingBox) box.union(solid.geometry.boundingBox.clone().applyMatrix4(solid.matrix));
    }
    return box;
  }

  /** Corners of the boxes around what is seen, where the bodies stand now. */
  corners(): Vector3[] {
    return this.parts
      .filter(({ solid }) => solid.visible)
      .flatMap(({ solid }) => {
        solid.geometry.computeBoundingBox();
        const box = solid.geometry.boundingBox;
        return box && !box.isEmpty() ? cornersOf(box).map((corner) => corner.applyMatrix4(solid.matrixWorld)) : [];
      });
  }

  // ---- poses ----

  /**
   * 12 numbers per body, in the order of `links`: bed_from_body. The ghost has the displacement of
   * every body point times k: R_n + k·(R_a − R_n), o_n + k·(o_a − o_n); k = 1 is true.
   */
  setPoses(nominal: Float64Array, actual: Float64Array, k: number): void {
    const n = new Matrix4();
    const a = new Matrix4();
    this.moving.forEach((_, i) => {
      matrixOf(nominal, 12 * i, n);
      matrixOf(actual, 12 * i, a);
      for (let j = 0; j < 16; j++)
        a.elements[j] = (n.elements[j] as number) + k * ((a.elements[j] as number) - (n.elements[j] as number));
      this.place(i, n, a);
    });
  }

  private place(index: number, nominal: Matrix4, ghost: Matrix4): void {
    const body = this.moving[index];
    if (!body) return;
    body.node.matrix.copy(nominal);
    body.ghost.matrix.copy(ghost);
    body.node.matrixWorldNeedsUpdate = true;
    body.ghost.matrixWorldNeedsUpdate = true;
  }

  // ---- colours ----

  /** New colours after a change of theme. */
  repaint(): void {
    this.lit = null;
    disposeMaterials(this.materials);
    for (const material of this.glass.values()) material.dispose();
    this.glass.clear();
    this.materials = makeMaterials();
    for (const part of this.parts) {
      part.edges.material = this.materials.edge;
      part.ghost.material = this.materials.ghost;
      part.ghost_edges.material = this.materials.ghost_edge;
      this.dress(part);
    }
  }

  /** Marks one body (an axis row under the mouse); null marks none. */
  highlight(name: string | null): void {
    const before = this.lit;
    this.lit = name;
    for (const part of this.parts) if (part.body.name === before || part.body.name === name) this.dress(part);
  }

  /** Names of the bodies that have parts, in the order of the chain; the bed is `b`. */
  get names(): string[] {
    const has = new Set(this.parts.map((part) => part.body.name));
    return ["b", ...this.links.map((link) => link.name)].filter((name) => has.has(name));
  }

  lookOf(name: string): Look {
    return this.looks.get(name) ?? "solid";
  }

  setLook(name: string, look: Look): void {
    this.looks.set(name, look);
    for (const part of this.parts) if (part.body.name === name) this.dress(part);
  }

  /** The body that a solid is of. */
  ownerOf(solid: Object3D): string | null {
    return this.parts.find((part) => part.solid === solid)?.body.name ?? null;
  }

  /** Material and visibility of a part by how its body is drawn. */
  private dress({ body, role, solid, edges, ghost, ghost_edges }: DrawnPart): void {
    const look = this.lookOf(body.name);
    const base = look === "glass" ? this.glassOf(role) : this.materials[role];
    const shared = new Set<unknown>([...Object.values(this.materials), ...this.glass.values()]);
    if (!shared.has(solid.material) && !Array.isArray(solid.material)) solid.material.dispose();
    solid.material = base;
    // A layer that no camera and no ray looks at: `visible` says whether a part is wanted at all.
    for (const node of [solid, edges, ghost, ghost_edges]) node.layers.set(look === "hidden" ? 31 : 0);
    if (body.name !== this.lit) return;
    const lit = base.clone();
    lit.color.lerp(lit.color.clone().set(cssColour("--scene-arrow")), 0.55);
    solid.material = lit;
  }

  private glassOf(role: Role): MeshLambertMaterial {
    const known = this.glass.get(role) ?? seenThrough(this.materials[role]);
    this.glass.set(role, known);
    return known;
  }
}
