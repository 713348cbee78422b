/** From where the scene is seen: two cameras, the mouse and the keys that move them, the buttons over the picture. */

import { tr } from "../words/index.ts";
import { Box3, OrthographicCamera, PerspectiveCamera, Vector3 } from "three";
import { OrbitControls } from "three/addons/controls/OrbitControls.js";
import { h } from "../dom.ts";

type ViewName = "iso" | "x" | "y" | "z";

/** From where each view looks. */
const VIEWS: Record<ViewName, { from: [number, number, number]; label: string; title: string }> = {
  iso: { from: [-0.62, -1, 0.62], label: tr`Iso`, title: tr`Iso: look from the front, left, above (0)` },
  x: { from: [1, 0, 0.0001], label: "X", title: tr`X: look along X (1)` },
  y: { from: [0, -1, 0.0001], label: "Y", title: tr`Y: look along Y, from the front (2)` },
  z: { from: [0, -0.0001, 1], label: "Z", title: tr`Z: look along Z, from above (3)` },
};

const KEYS: Record<string, ViewName> = { "0": "iso", "1": "x", "2": "y", "3": "z" };
const TURNS: Record<string, [number, number]> = {
  ArrowLeft: [-1, 0],
  ArrowRight: [1, 0],
  ArrowUp: [0, -1],
  ArrowDown: [0, 1],
};

/** For the address: "x", "iso,parallel" or azimuth, elevation (°), height that is seen, target (mm). */
export type ViewState = string;

interface Seen {
  /** What the whole picture has to show. */
  corners: () => Vector3[];
  moved: () => void;
  /** The user chose another view. */
  chosen: () => void;
}

export class ViewCamera {
  readonly buttons: HTMLElement;
  private readonly perspective = new PerspectiveCamera(28, 1, 1, 1e5);
  private readonly orthographic = new OrthographicCamera(-1, 1, 1, -1, 1, 1e5);
  private current: PerspectiveCamera | OrthographicCamera = this.perspective;
  /** Half of what the parallel projection shows in height, mm, at zoom 1. */
  private half = 1000;
  private aspect = 1;
  /** The view that the camera has by a name. */
  private named: ViewName | null = null;
  private controls: OrbitControls | null = null;
  private readonly seen: Seen;
  private readonly parallel = h(
    "button",
    {
      onclick: () => this.chosen(() => this.toggleParallel()),
      ariaPressed: "false",
      title: tr`Parallel projection (5)`,
    },
    tr`Parallel`,
  );

  constructor(seen: Seen) {
    this.seen = seen;
    this.perspective.up.set(0, 0, 1);
    this.orthographic.up.set(0, 0, 1);
    const views = (Object.keys(VIEWS) as ViewName[]).map((name) =>
      h(
        "button",
        {
          title: VIEWS[name].title,
          ariaLabel: VIEWS[name].title,
          onclick: () => this.chosen(() => this.setView(name)),
        },
        VIEWS[name].label,
      ),
    );
    const fit = h("button", { title: tr`Show everything (4)`, onclick: () => this.chosen(() => this.fit()) }, tr`Fit`);
    this.buttons = h(
      "div",
      { class: "scene-tools" },
      h("div", { class: "group", role: "group", ariaLabel: tr`View` }, views),
      h("div", { class: "group" }, fit, this.parallel),
    );
  }

  get camera(): PerspectiveCamera | OrthographicCamera {
    return this.current;
  }

  /** Mouse, fingers and keys on the picture. */
  attach(canvas: HTMLCanvasElement): void {
    canvas.tabIndex = 0;
    canvas.setAttribute("role", "img");
    canvas.setAttribute(
      "aria-label",
      tr`Machine in three dimensions. Arrow keys turn, Shift and arrow keys move, plus and minus zoom, 0 to 3 choose a view.`,
    );
    canvas.addEventListener("keydown", (event) => this.key(event));
    this.controls = new OrbitControls(this.current, canvas);
    this.controls.addEventListener("change", () => this.seen.moved());
    this.controls.addEventListener("end", () => this.chosen(() => (this.named = null)));
  }

  // ---- what is seen ----

  setView(name: ViewName): void {
    this.look(new Vector3(...VIEWS[name].from).normalize(), this.seen.corners());
    this.named = name;
  }

  private chosen(act: () => void): void {
    act();
    this.seen.chosen();
  }

  /** The view in words, for the address. */
  get state(): ViewState {
    const parallel = this.current === this.orthographic ? ",parallel" : "";
    if (this.named) return `${this.named}${parallel}`;
    const arm = this.arm();
    const degrees = (angle: number): string => ((angle * 180) / Math.PI).toFixed(1);
    const place = this.target()
      .toArray()
      .map((v) => v.toFixed(1));
    const elevation = Math.asin(Math.max(-1, Math.min(1, arm.z / arm.length())));
    return (
      [degrees(Math.atan2(arm.y, arm.x)), degrees(elevation), this.height().toPrecision(4), ...place].join(",") +
      parallel
    );
  }

  /** Goes to a view in words; one that cannot be read changes nothing. */
  set state(words: ViewState) {
    const parts = words.split(",");
    const parallel = parts.at(-1) === "parallel";
    if (parallel) parts.pop();
    if (parallel !== (this.current === this.orthographic)) this.toggleParallel();
    const [name] = parts;
    if (name && name in VIEWS) this.setView(name as ViewName);
    const numbers = parts.map(Number);
    if (numbers.length !== 6 || !numbers.every(Number.isFinite)) return;
    const [azimuth, elevation, height, x, y, z] = numbers as [number, number, number, number, number, number];
    if (!(height > 0)) return;
    const [a, e] = [(azimuth * Math.PI) / 180, (elevation * Math.PI) / 180];
    this.half = height / 2;
    this.place(
      new Vector3(Math.cos(e) * Math.cos(a), Math.cos(e) * Math.sin(a), Math.sin(e)),
      new Vector3(x, y, z),
      this.half / this.tangent(),
    );
  }

  fit(): void {
    this.show(this.seen.corners());
  }

  /** Points fill the picture, seen from where the camera stands, or opposite if what faces `front` is hidden from there. */
  show(corners: readonly Vector3[], front = new Vector3(0, 0, 1)): void {
    const from = this.arm().normalize();
    const level = front.clone().setZ(0);
    const away = from.dot(level);
    if (level.length() > 0.3 && away < 0) from.addScaledVector(level, (-2 * away) / level.lengthSq());
    this.look(from, corners);
  }

  private look(from: Vector3, corners: readonly Vector3[]): void {
    const right = new Vector3(0, 0, 1).cross(from).normalize();
    const up = from.clone().cross(right);
    // In the directions of the picture: to the right, up, towards the camera.
    const seen = new Box3().setFromPoints(corners.map((p) => new Vector3(p.dot(right), p.dot(up), p.dot(from))));
    const middle = seen.getCenter(new Vector3());
    const centre = new Vector3()
      .addScaledVector(right, middle.x)
      .addScaledVector(up, middle.y)
      .addScaledVector(from, middle.z);
    let distance = 0;
    this.half = 0;
    for (const corner of corners) {
      const off = corner.clone().sub(centre);
      const half = 1.08 * Math.max(Math.abs(off.dot(up)), Math.abs(off.dot(right)) / this.aspect);
      this.half = Math.max(this.half, half);
      distance = Math.max(distance, off.dot(from) + half / this.tangent());
    }
    this.place(from, centre, distance);
  }

  private place(from: Vector3, centre: Vector3, distance: number): void {
    this.named = null;
    for (const camera of [this.perspective, this.orthographic]) {
      camera.position.copy(centre).addScaledVector(from, distance);
      camera.near = Math.max(1, distance / 200);
      camera.far = Math.max(5e4, distance * 20);
    }
    this.orthographic.zoom = 1;
    this.controls?.target.copy(centre);
    this.project();
  }

  private toggleParallel(): void {
    const on = this.current === this.perspective;
    const to = on ? this.orthographic : this.perspective;
    const [arm, target] = [this.arm(), this.target()];
    if (on) {
      to.position.copy(this.current.position);
      this.half = arm.length() * this.tangent();
      this.orthographic.zoom = 1;
    } else
      to.position.copy(target).addScaledVector(arm.normalize(), this.half / this.orthographic.zoom / this.tangent());
    to.near = this.current.near;
    to.far = this.current.far;
    this.current = to;
    if (this.controls) this.controls.object = to;
    this.parallel.setAttribute("aria-pressed", String(on));
    this.project();
  }

  resize(width: number, height: number): void {
    this.aspect = width / height;
    this.project();
  }

  private project(): void {
    const { half, aspect } = this;
    this.perspective.aspect = aspect;
    this.perspective.updateProjectionMatrix();
    Object.assign(this.orthographic, { left: -half * aspect, right: half * aspect, top: half, bottom: -half });
    this.orthographic.updateProjectionMatrix();
    this.controls?.update();
    this.seen.moved();
  }

  /** What is seen in height where the camera looks, mm. */
  height(): number {
    return (
      2 *
      (this.current === this.orthographic ? this.half / this.orthographic.zoom : this.arm().length() * this.tangent())
    );
  }

  private tangent(): number {
    return Math.tan((this.perspective.fov * Math.PI) / 360);
  }

  private target(): Vector3 {
    return this.controls?.target ?? new Vector3();
  }

  /** From the target of the view to the camera. */
  private arm(): Vector3 {
    return this.current.position.clone().sub(this.target());
  }

  // ---- keys ----

  private key(event: KeyboardEvent): void {
    const view = KEYS[event.key];
    const turn = TURNS[event.key];
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    if (view) this.setView(view);
    else if (event.key === "4") this.fit();
    else if (event.key === "5") this.toggleParallel();
    else if (event.key === "+" || event.key === "=") this.zoom(0.85);
    else if (event.key === "-") this.zoom(1 / 0.85);
    else if (turn && event.shiftKey) this.pan(...turn);
    else if (turn) this.turn(...turn);
    else return;
    if (turn || "+=-".includes(event.key)) this.named = null;
    event.preventDefault();
    this.seen.chosen();
  }

  private turn(x: number, y: number): void {
    const arm = this.arm();
    const polar = Math.min(3.1, Math.max(0.04, arm.angleTo(new Vector3(0, 0, 1)) + 0.08 * y));
    const azimuth = Math.atan2(arm.y, arm.x) + 0.1 * x;
    const way = new Vector3(Math.sin(polar) * Math.cos(azimuth), Math.sin(polar) * Math.sin(azimuth), Math.cos(polar));
    this.current.position.copy(this.target()).addScaledVector(way, arm.length());
    this.moved();
  }

  private pan(x: number, y: number): void {
    const by = new Vector3(-x, y, 0)
      .applyQuaternion(this.current.quaternion)
      .multiplyScalar(0.05 * this.arm().length());
    this.current.position.add(by);
    this.controls?.target.add(by);
    this.moved();
  }

  private zoom(by: number): void {
    if (this.current === this.orthographic) this.orthographic.zoom /= by;
    else this.current.position.copy(this.target()).addScaledVector(this.arm(), by);
    this.moved();
  }

  private moved(): void {
    this.current.updateProjectionMatrix();
    this.controls?.update();
    this.seen.moved();
  }
}
