/**
 * A machine drawn from nothing but its chain: bed, guideways along the travel, carriages, rotary
 * tables, forks, spindle, tool, workpiece – so that any machine file reads as a machine. Bodies
 * that have models of their own are left out.
 *
 * Everything is laid out in the machine frame with all axes at 0, from the workpiece and from the
 * tool towards the bed; each part then belongs to one body.
 */

import { Box3, BoxGeometry, type BufferGeometry, Matrix4, Vector3 } from "three";
import type { Link, MachineDescription } from "../api.ts";
import { alongMatrix, matrixOf, standingCone, type Part } from "./shapes.ts";

const UP = new Vector3(0, 0, 1);

/** bed_from_body with all axes at 0. */
export function homePoses(links: readonly Link[]): Matrix4[] {
  const poses: (Matrix4 | undefined)[] = [];
  const pose = (i: number, depth: number): Matrix4 => {
    const known = poses[i];
    const link = links[i];
    if (known) return known;
    if (!link || depth > links.length) return new Matrix4();
    const here = matrixOf(link.placement);
    const found = link.parent === null ? here : new Matrix4().multiplyMatrices(pose(link.parent, depth + 1), here);
    poses[i] = found;
    return found;
  };
  return links.map((_, i) => pose(i, 0));
}

/** A length that fits the machine: half of its shortest linear travel, within reason. */
export function unitOf(links: readonly Link[]): number {
  const spans = links
    .filter((l) => l.kind === "linear" && Array.isArray(l.travel))
    .map((l) => Math.abs((l.travel as [number, number])[1] - (l.travel as [number, number])[0]));
  const shortest = spans.length > 0 ? Math.min(...spans) : 500;
  return Math.min(500, Math.max(60, 0.5 * shortest));
}

/** Indices from a link towards the bed, without the link itself. */
function towardsBed(links: readonly Link[], from: number): number[] {
  const list: number[] = [];
  let at = links[from]?.parent ?? null;
  while (at !== null && list.length <= links.length) {
    list.push(at);
    at = links[at]?.parent ?? null;
  }
  return list;
}

class Draft {
  readonly parts: Part[] = [];
  readonly home: Matrix4[];
  readonly unit: number;
  /** Where the beam that a body carries lies, so that its own guideways stand under its ends. */
  readonly spans = new Map<number, { length: number; centre: Vector3 }>();
  /** What stands on the bed. */
  readonly footprint = new Box3();
  private readonly has: Set<number | null>;
  readonly links: readonly Link[];

  constructor(machine: MachineDescription) {
    this.links = machine.links;
    this.home = homePoses(machine.links);
    this.unit = unitOf(machine.links);
    this.has = new Set(machine.models.map((m) => m.body));
  }

  private add(body: number | null, name: string, geometry: BufferGeometry, bed_from_part: Matrix4): void {
    if (this.has.has(body)) return;
    const home = body === null ? new Matrix4() : (this.home[body] as Matrix4);
    this.parts.push({ body, name, geometry, matrix: home.clone().invert().multiply(bed_from_part) });
  }

  /** A box with edges along x, y, z of the machine. */
  box(body: number | null, name: string, centre: Vector3, size: Vector3): void {
    if (body === null) this.footprint.union(new Box3().setFromCenterAndSize(centre, size));
    this.add(
      body,
      name,
      new BoxGeometry(Math.max(1, size.x), Math.max(1, size.y), Math.max(1, size.z)),
      new Matrix4().setPosition(centre),
    );
  }

  /** A cylinder from `base` along `direction`. */
  cylinder(
    body: number | null,
    name: string,
    base: Vector3,
    direction: Vector3,
    radius: number,
    length: number,
    top = radius,
  ): void {
    this.add(body, name, standingCone(radius, top, length), alongMatrix(base, direction));
  }

  /** Direction of a link's axis and origin of its body, in the machine frame. */
  axis(i: number): { d: Vector3; o: Vector3 } {
    const home = this.home[i] as Matrix4;
    const link = this.links[i] as Link;
    return { d: new Vector3(...link.direction).transformDirection(home), o: new Vector3().setFromMatrixPosition(home) };
  }

  /** How far the body runs from home along +d of its direction: [least, most], mm. */
  reach(i: number): [number, number] {
    const link = this.links[i] as Link;
    const sense = link.sense ?? (link.carries === "workpiece" ? -1 : 1);
    const [from, to] = Array.isArray(link.travel) ? link.travel : [-1.5 * this.unit, 1.5 * this.unit];
    return sense > 0 ? [from, to] : [-to, -from];
  }
}

const plus = (a: Vector3, b: Vector3, k = 1): Vector3 => a.clone().addScaledVector(b, k);
/** Half-extent `along` |d| and `across` elsewhere, as a full box size. */
const sized = (d: Vector3, along: number, across: number, height: number): Vector3 =>
  new Vector3(
    Math.abs(d.x) * along + (1 - Math.abs(d.x)) * across,
    Math.abs(d.y) * along + (1 - Math.abs(d.y)) * across,
    height,
  );

/** From the workpiece down to the bed; returns where the bed begins and how wide it must be. */
function workpieceSide(draft: Draft, w: number): { z: number; centre: Vector3; size: Vector3 } {
  const u = draft.unit;
  const chain = towardsBed(draft.links, w);
  const part = new Vector3().setFromMatrixPosition(draft.home[w] as Matrix4);
  const at = part.clone();
  const size = new Vector3(3 * u, 3 * u, 0);
  const centre = part.clone();
  chain.forEach((body, k) => {
    const link = draft.links[body] as Link;
    const below = chain[k + 1] ?? null;
    const { d, o } = draft.axis(body);
    const level = Math.abs(d.z) > 0.7;
    if (link.kind === "rotary" && level) {
      at.x = o.x;
      at.y = o.y;
      draft.cylinder(body, `${link.name} table`, plus(at, UP, -0.25 * u), UP, 0.95 * u, 0.25 * u);
      draft.cylinder(below, `${link.name} bearing`, plus(at, UP, -0.5 * u), UP, 0.7 * u, 0.25 * u);
      at.z -= 0.5 * u;
    } else if (link.kind === "rotary") {
      cradle(draft, body, below, link.name, at, d, o);
      at.set(o.x, o.y, Math.min(at.z - 0.3 * u, o.z - 1.5 * u));
    } else if (level) {
      const [low, high] = draft.reach(body);
      draft.box(body, `${link.name} knee`, plus(at, UP, -0.25 * u), new Vector3(2.2 * u, 2.2 * u, 0.5 * u));
      draft.box(
        body,
        `${link.name} column`,
        plus(at, UP, -0.5 * u - 0.5 * (high - low)),
        new Vector3(0.9 * u, 0.9 * u, high - low),
      );
      at.z -= 0.5 * u + (high - low) * 0.5;
    } else {
      const [low, high] = draft.reach(body);
      const along = k === 0 ? Math.max(3.2 * u, 0.6 * (high - low)) : 2.6 * u;
      draft.box(body, `${link.name} slide`, plus(at, UP, -0.17 * u), sized(d, along, 2.2 * u, 0.34 * u));
      const middle = plus(plus(at, d, (low + high) / 2), UP, -0.42 * u);
      const length = high - low + along;
      const side = new Vector3().crossVectors(UP, d).normalize();
      for (const sign of [-0.7, 0.7])
        draft.box(below, `${link.name} guideway`, plus(middle, side, sign * u), sized(d, length, 0.22 * u, 0.16 * u));
      draft.box(below, `${link.name} way bed`, plus(middle, UP, -0.2 * u), sized(d, length, 1.9 * u, 0.24 * u));
      const box = sized(d, length, 2.4 * u, 0);
      size.max(box);
      if (below === null) centre.set(middle.x, middle.y, 0);
      at.z -= 0.74 * u;
    }
  });
  if (chain.length === 0) draft.box(null, "table", plus(at, UP, -0.15 * u), new Vector3(3.4 * u, 3.4 * u, 0.3 * u));
  return { z: at.z - (chain.length === 0 ? 0.3 * u : 0), centre, size };
}

/** A swivelling table between two supports. */
function cradle(
  draft: Draft,
  body: number,
  below: number | null,
  name: string,
  at: Vector3,
  d: Vector3,
  o: Vector3,
): void {
  const u = draft.unit;
  const floor = Math.min(at.z - 0.15 * u, o.z - 0.3 * u);
  const middle = new Vector3(o.x, o.y, floor);
  draft.box(body, `${name} cradle`, middle, sized(d, 2.5 * u, 1.3 * u, 0.3 * u));
  const base = Math.min(at.z - 0.3 * u, o.z - 1.5 * u);
  for (const sign of [-1, 1]) {
    const cheek = plus(o, d, sign * 1.25 * u);
    const top = Math.max(o.z + 0.3 * u, floor);
    draft.box(
      body,
      `${name} cheek`,
      new Vector3(cheek.x, cheek.y, (top + floor) / 2),
      sized(d, 0.2 * u, 0.9 * u, top - floor + 0.3 * u),
    );
    draft.cylinder(
      body,
      `${name} trunnion`,
      plus(o, d, sign * 1.3 * u),
      d.clone().multiplyScalar(sign),
      0.3 * u,
      0.25 * u,
    );
    const support = plus(o, d, sign * 1.75 * u);
    const height = o.z + 0.45 * u - base;
    draft.box(
      below,
      `${name} support`,
      new Vector3(support.x, support.y, base + height / 2),
      sized(d, 0.4 * u, 1.1 * u, height),
    );
  }
}

/** From the tool up and back to the bed, over the floor at `floor`. */
function toolSide(draft: Draft, t: number, floor: number): void {
  const u = draft.unit;
  const chain = towardsBed(draft.links, t);
  const home = draft.home[t] as Matrix4;
  const nose = new Vector3().setFromMatrixPosition(home);
  const up = UP.clone().transformDirection(home);
  const holder = chain[0] ?? null;
  draft.cylinder(holder, "spindle nose", nose, up, 0.2 * u, 0.2 * u, 0.34 * u);
  draft.cylinder(holder, "spindle", plus(nose, up, 0.2 * u), up, 0.34 * u, 1.0 * u);
  let at = plus(nose, up, 1.2 * u);
  let behind: Vector3 | null = null;
  chain.forEach((body, k) => {
    const link = draft.links[body] as Link;
    const below = chain[k + 1] ?? null;
    const { d, o } = draft.axis(body);
    if (link.kind === "rotary") at = swivel(draft, body, below, link.name, at, d, o);
    else {
      ({ at, behind } = slide(draft, body, below, at, d, behind, floor, chain.slice(k + 1)));
    }
  });
}

/** A rotary axis of the head; returns where its carrier goes on. */
function swivel(
  draft: Draft,
  body: number,
  below: number | null,
  name: string,
  at: Vector3,
  d: Vector3,
  o: Vector3,
): Vector3 {
  const u = draft.unit;
  if (Math.abs(d.z) < 0.3) {
    const crown = Math.max(at.z, o.z + 0.9 * u) + 0.15 * u;
    draft.cylinder(body, `${name} pivot`, plus(o, d, -0.55 * u), d, 0.28 * u, 1.1 * u);
    for (const sign of [-1, 1]) {
      const arm = plus(o, d, sign * 0.62 * u);
      draft.box(
        below,
        `${name} fork`,
        new Vector3(arm.x, arm.y, (crown + o.z - 0.35 * u) / 2),
        sized(d, 0.2 * u, 0.7 * u, crown - o.z + 0.35 * u),
      );
    }
    draft.box(below, `${name} crown`, new Vector3(o.x, o.y, crown + 0.12 * u), sized(d, 1.44 * u, 0.7 * u, 0.24 * u));
    return new Vector3(o.x, o.y, crown + 0.24 * u);
  }
  if (Math.abs(d.z) > 0.95) {
    const base = new Vector3(o.x, o.y, at.z);
    draft.cylinder(body, `${name} flange`, base, UP, 0.62 * u, 0.22 * u);
    draft.cylinder(below, `${name} bearing`, plus(base, UP, 0.22 * u), UP, 0.5 * u, 0.25 * u);
    return plus(base, UP, 0.47 * u);
  }
  // A nutating head: the swivel sits on the inclined axis.
  const upward = d.clone().multiplyScalar(Math.sign(d.z));
  const seat = plus(o, upward, Math.max(0.4 * u, at.clone().sub(o).dot(upward)));
  draft.cylinder(body, `${name} swivel`, plus(seat, upward, -0.45 * u), upward, 0.5 * u, 0.45 * u);
  draft.cylinder(below, `${name} seat`, seat, upward, 0.55 * u, 0.6 * u);
  return plus(seat, upward, 0.6 * u);
}

/** Horizontally across the way of a slide; away from whoever looks from the front left. */
function across(d: Vector3): Vector3 {
  const side = new Vector3().crossVectors(UP, d).normalize();
  return side.y < -1e-9 || (Math.abs(side.y) < 1e-9 && side.x < 0) ? side.negate() : side;
}

/** Where the carrier of a ram stands: beside the way of the next slide, so that its beam passes the ram. */
function backOf(draft: Draft, rest: number[]): Vector3 {
  const next = rest.find((i) => draft.links[i]?.kind === "linear" && Math.abs(draft.axis(i).d.z) < 0.7);
  return next === undefined ? new Vector3(0, 1, 0) : across(draft.axis(next).d);
}

interface Slide {
  at: Vector3;
  /** The side on which the next carrier stands. */
  behind: Vector3 | null;
}

/** A linear axis of the head with what guides it on its carrier. */
function slide(
  draft: Draft,
  body: number,
  below: number | null,
  at: Vector3,
  d: Vector3,
  behind: Vector3 | null,
  floor: number,
  rest: number[],
): Slide {
  const u = draft.unit;
  const name = draft.links[body]?.name ?? "";
  const [low, high] = draft
    .reach(body)
    .map((q) => q * (d.z < -0.7 ? -1 : 1))
    .sort((a, b) => a - b) as [number, number];
  if (Math.abs(d.z) > 0.7) {
    const saddle = at.z + high + 0.7 * u;
    const top = saddle + 0.6 * u - low;
    draft.box(
      body,
      `${name} ram`,
      new Vector3(at.x, at.y, (top + at.z) / 2),
      new Vector3(0.9 * u, 0.9 * u, top - at.z),
    );
    const back = behind ?? backOf(draft, rest);
    if (below === null) {
      const foot = plus(new Vector3(at.x, at.y, 0), back, 1.55 * u);
      draft.box(
        null,
        "column",
        new Vector3(foot.x, foot.y, (floor + top) / 2),
        new Vector3(1.5 * u, 1.5 * u, top - floor),
      );
      for (const sign of [-0.4, 0.4])
        draft.box(
          null,
          `${name} guideway`,
          plus(new Vector3(at.x + sign * u, at.y, (saddle + low + top) / 2), back, 0.7 * u),
          new Vector3(0.16 * u, 0.22 * u, top - saddle - low + u),
        );
      draft.box(
        body,
        `${name} head slide`,
        plus(new Vector3(at.x, at.y, at.z + 0.7 * u), back, 0.5 * u),
        new Vector3(1.2 * u, 0.3 * u, 1.2 * u),
      );
      return { at: foot, behind: back };
    }
    draft.box(
      below,
      `${name} saddle`,
      plus(new Vector3(at.x, at.y, saddle), back, 0.6 * u),
      new Vector3(1.3 * u, 0.3 * u, 1.3 * u),
    );
    return { at: plus(new Vector3(at.x, at.y, saddle), back, 0.75 * u), behind: back };
  }
  const side = across(d);
  const middle = plus(at, d, (low + high) / 2);
  const length = high - low + 2.4 * u;
  if (behind && Math.abs(behind.dot(d)) > 0.7) {
    // This axis moves along the way the last part looked back: its body is a beam across, guided at both ends.
    return portal(draft, body, below, name, at, d, side, low, high, floor);
  }
  const beam = plus(middle, side, 0.45 * u);
  draft.box(below, `${name} beam`, beam, sized(d, length, 0.8 * u, 1.1 * u));
  for (const sign of [-0.35, 0.35])
    draft.box(
      below,
      `${name} guideway`,
      plus(plus(middle, side, 0.02 * u), UP, sign * u),
      sized(d, length, 0.12 * u, 0.14 * u),
    );
  if (below === null || rest.length === 0) {
    for (const sign of [-0.5, 0.5]) {
      const foot = plus(beam, d, sign * (length - 0.8 * u));
      draft.box(
        null,
        "column",
        new Vector3(foot.x, foot.y, (floor + at.z + 0.55 * u) / 2),
        sized(d, 0.8 * u, 1.1 * u, at.z + 0.55 * u - floor),
      );
    }
  } else {
    draft.spans.set(below, { length, centre: beam });
  }
  return { at: beam, behind: side };
}

/** A body that carries a beam and runs on two walls. */
function portal(
  draft: Draft,
  body: number,
  below: number | null,
  name: string,
  at: Vector3,
  d: Vector3,
  side: Vector3,
  low: number,
  high: number,
  floor: number,
): Slide {
  const u = draft.unit;
  const span = draft.spans.get(body) ?? { length: 3 * u, centre: at };
  const length = high - low + 1.6 * u;
  for (const sign of [-0.5, 0.5]) {
    const end = plus(span.centre, side, sign * (span.length + 0.2 * u));
    const rail = end.z - 0.75 * u;
    draft.box(body, `${name} foot`, new Vector3(end.x, end.y, rail + 0.65 * u), sized(d, 1.3 * u, 0.6 * u, 1.1 * u));
    const wall = plus(end, d, (low + high) / 2);
    draft.box(below, `${name} guideway`, new Vector3(wall.x, wall.y, rail), sized(d, length, 0.22 * u, 0.2 * u));
    draft.box(below, `${name} wall`, new Vector3(wall.x, wall.y, rail - 0.35 * u), sized(d, length, 0.5 * u, 0.5 * u));
    // Posts instead of a closed wall: one sees the work.
    for (const k of [-0.5, 0, 0.5]) {
      const post = plus(wall, d, k * (length - 0.5 * u));
      draft.box(
        below,
        `${name} post`,
        new Vector3(post.x, post.y, (rail - 0.6 * u + floor) / 2),
        sized(d, 0.5 * u, 0.5 * u, rail - 0.6 * u - floor),
      );
    }
  }
  return { at: new Vector3(span.centre.x, span.centre.y, span.centre.z - 0.75 * u), behind: side };
}

/** Parts for every body without a model, except workpiece and tool (the scene draws those). */
export function schematic(machine: MachineDescription): Part[] {
  const draft = new Draft(machine);
  const w = machine.links.findIndex((l) => l.kind === "workpiece");
  const t = machine.links.findIndex((l) => l.kind === "tool");
  if (w < 0 || t < 0) return [];
  const bed = workpieceSide(draft, w);
  const u = draft.unit;
  toolSide(draft, t, bed.z);
  const ground = draft.footprint
    .union(new Box3().setFromCenterAndSize(bed.centre.setZ(bed.z), bed.size))
    .expandByScalar(0.3 * u);
  const size = ground.getSize(new Vector3()).setZ(0.5 * u);
  draft.box(null, "bed", ground.getCenter(new Vector3()).setZ(bed.z - 0.25 * u), size);
  return draft.parts;
}
