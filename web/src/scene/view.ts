/** The machine in three dimensions: nominal solid, actual as a ghost, drawn only when something changed. */

import {
  AxesHelper,
  Box3,
  BufferGeometry,
  CylinderGeometry,
  DirectionalLight,
  EdgesGeometry,
  GridHelper,
  Group,
  HemisphereLight,
  LineBasicMaterial,
  LineSegments,
  Material,
  Matrix4,
  Mesh,
  MeshBasicMaterial,
  MeshLambertMaterial,
  Object3D,
  OrthographicCamera,
  PerspectiveCamera,
  Raycaster,
  Scene,
  Vector3,
  WebGLRenderer,
  BoxGeometry,
  DoubleSide,
} from "three";
import { OrbitControls } from "three/addons/controls/OrbitControls.js";
import type { MachineDescription } from "../api.ts";
import { download, h } from "../dom.ts";
import { factor } from "../format.ts";
import { colourBar, type ColourBarSpec } from "../figure/colourbar.ts";
import { cssColour, onTheme } from "../theme.ts";
import { axisArrow } from "./arrows.ts";
import { PathLayer, SurfaceLayer, type PathData, type SurfaceData } from "./layers.ts";
import { Overlay } from "./overlay.ts";
import { drawnByProcessor, Pace } from "./pace.ts";
import { homePoses, schematic, unitOf } from "./schematic.ts";
import { geometryOf, matrixOf, standingCone } from "./shapes.ts";

export type ViewName = "iso" | "x" | "y" | "z";

/** From where each view looks, and what is up in it. */
const VIEWS: Record<ViewName, { from: [number, number, number]; label: string; title: string }> = {
  iso: { from: [-0.62, -1, 0.62], label: "Iso", title: "Look from the front, left, above (0)" },
  x: { from: [1, 0, 0.0001], label: "X", title: "Look along X (1)" },
  y: { from: [0, -1, 0.0001], label: "Y", title: "Look along Y, from the front (2)" },
  z: { from: [0, -0.0001, 1], label: "Z", title: "Look along Z, from above (3)" },
};

/** The block that is drawn where no workpiece is known. */
const STAND_IN = "workpiece";

type Role = "bed" | "linear" | "rotary" | "tool" | "part";

interface Body {
  name: string;
  node: Group;
  ghost: Group;
  meshes: Mesh[];
}

/** What tests read: the scene graph, not the numbers that went in. */
export interface SceneProbe {
  /** bed_from_body, 12 numbers, of the nominal (or ghost) body as the scene graph has it. */
  poseOf(name: string, which?: "nominal" | "ghost"): number[] | null;
  nominalTip(): [number, number, number] | null;
  /** Least and greatest corner of the models of a body, in its own frame, mm. */
  boxOf(name: string): number[] | null;
  frames(): number;
  /** What the Simulate tab shows now: the time, the axis positions, mm and deg, and from where they came, in full. */
  moment?: () => { time_s: number; axes: Record<string, number>; approach: Record<string, number> } | null;
}

declare global {
  interface Window {
    trueaxisScene?: SceneProbe;
  }
}

export class MachineView {
  readonly element = h("div", { class: "scene" });
  readonly overlay = new Overlay();
  private readonly scene = new Scene();
  private readonly renderer: WebGLRenderer | null;
  private readonly perspective = new PerspectiveCamera(28, 1, 1, 1e5);
  private readonly orthographic = new OrthographicCamera(-1, 1, 1, -1, 1, 1e5);
  private camera: PerspectiveCamera | OrthographicCamera = this.perspective;
  private controls: OrbitControls | null = null;
  private readonly lights = new Group();
  private readonly machine_root = new Group();
  private readonly ghost_root = new Group();
  private readonly bed: Body = { name: "b", node: new Group(), ghost: new Group(), meshes: [] };
  private bodies: Body[] = [];
  private machine: MachineDescription | null = null;
  private grid: GridHelper | null = null;
  private path: PathLayer | null = null;
  private surface: SurfaceLayer | null = null;
  private readonly layers = new Group();
  private readonly size = { width: 1, height: 1 };
  private scheduled = false;
  private drawn = 0;
  private k = 1;
  private ghost_wanted = true;
  private poses: { nominal: Float64Array; actual: Float64Array } | null = null;
  private arrows: Group[] = [];
  private materials: Partial<Record<Role | "edge" | "ghost" | "ghost-edge", Material>> = {};
  private pace: Pace | null = null;
  private readonly watch: ResizeObserver;
  private readonly stop_theme: () => void;
  private readonly projection = h("button", { onclick: () => this.setOrthographic(this.camera === this.perspective), ariaPressed: "false", title: "Parallel projection (5)" }, "Parallel");

  constructor(host: HTMLElement) {
    host.append(this.element);
    this.renderer = this.makeRenderer();
    this.element.append(this.overlay.element);
    this.buildTools();
    this.scene.add(this.machine_root, this.ghost_root, this.lights);
    this.lights.add(new HemisphereLight(0xffffff, 0xb4bac2, 2.2));
    const sun = new DirectionalLight(0xffffff, 1.5);
    sun.position.set(-0.25, -1.0, 1.3);
    this.lights.add(sun);
    this.perspective.up.set(0, 0, 1);
    this.orthographic.up.set(0, 0, 1);
    this.watch = new ResizeObserver(() => this.resize());
    this.watch.observe(this.element);
    this.stop_theme = onTheme(() => this.repaint());
    window.trueaxisScene = { poseOf: (name, which) => this.poseOf(name, which), nominalTip: () => this.nominalTip(), boxOf: (name) => this.boxOf(name), frames: () => this.drawn };
  }

  private makeRenderer(): WebGLRenderer | null {
    try {
      const slow = drawnByProcessor();
      const renderer = new WebGLRenderer({ antialias: !slow, alpha: true });
      this.pace = new Pace(renderer, slow, () => this.schedule());
      const canvas = renderer.domElement;
      canvas.tabIndex = 0;
      canvas.setAttribute("role", "img");
      canvas.setAttribute("aria-label", "Machine in three dimensions. Arrow keys turn, Shift and arrow keys move, plus and minus zoom, 0 to 3 choose a view.");
      canvas.addEventListener("keydown", (event) => this.key(event));
      this.element.append(canvas);
      this.controls = new OrbitControls(this.camera, canvas);
      this.controls.addEventListener("change", () => this.requestRender());
      return renderer;
    } catch {
      this.element.append(h("p", { class: "scene-failed" }, "This browser cannot draw in three dimensions (WebGL is off). All figures and tables work without it."));
      return null;
    }
  }

  private buildTools(): void {
    const views = h("div", { class: "group", role: "group", ariaLabel: "View" }, (Object.keys(VIEWS) as ViewName[]).map((name) => h("button", { title: VIEWS[name].title, ariaLabel: VIEWS[name].title, onclick: () => this.setView(name) }, VIEWS[name].label)));
    const fit = h("button", { title: "Show everything (4)", onclick: () => this.fit() }, "Fit");
    const picture = h("button", { title: "Save the picture as PNG", onclick: () => this.savePng("machine") }, "PNG");
    this.element.append(h("div", { class: "scene-tools" }, views, h("div", { class: "group" }, fit, this.projection), picture));
  }

  // ---- the machine ----

  /** Builds the bodies of the chain; models where the machine file has them, else a schematic. */
  setMachine(machine: MachineDescription, keep_view = false): void {
    this.clearMachine();
    this.machine = machine;
    this.bodies = machine.links.map((link) => ({ name: link.name, node: new Group(), ghost: new Group(), meshes: [] }));
    for (const body of [this.bed, ...this.bodies]) {
      body.node.matrixAutoUpdate = false;
      body.ghost.matrixAutoUpdate = false;
      this.machine_root.add(body.node);
      if (body !== this.bed) this.ghost_root.add(body.ghost);
    }
    this.makeMaterials();
    for (const model of machine.models) if (!("stl" in model.shape)) this.addPart(model.body, model.name, geometryOf(model.shape), matrixOf(model.placement));
    for (const part of schematic(machine)) this.addPart(part.body, part.name, part.geometry, part.matrix);
    homePoses(machine.links).forEach((pose, i) => this.placeBody(i, pose, pose));
    this.addTool();
    this.addWorkpiece();
    this.attachLayers();
    this.addArrows();
    this.addGrid();
    this.ghost_root.visible = false;
    this.showStandIn();
    if (!keep_view) this.setView("iso");
    this.requestRender();
  }

  private clearMachine(): void {
    for (const root of [this.machine_root, this.ghost_root]) {
      root.traverse((node) => (node as Mesh).geometry?.dispose());
      root.clear();
    }
    this.bed.node = new Group();
    this.bed.ghost = new Group();
    this.bed.meshes = [];
    this.arrows = [];
    this.poses = null;
    this.overlay.clearLabels();
    this.overlay.note("factor", null);
  }

  private bodyOf(index: number | null): Body {
    return index === null ? this.bed : (this.bodies[index] ?? this.bed);
  }

  private roleOf(index: number | null): Role {
    const kind = index === null ? undefined : this.machine?.links[index]?.kind;
    return kind === undefined ? "bed" : kind === "workpiece" ? "part" : kind;
  }

  private addPart(index: number | null, name: string, geometry: BufferGeometry, matrix: Matrix4, role: Role = this.roleOf(index)): Mesh {
    const body = this.bodyOf(index);
    const mesh = new Mesh(geometry, this.materials[role]);
    const edges = new LineSegments(new EdgesGeometry(geometry, 25), this.materials.edge);
    const ghost = new Mesh(geometry, this.materials.ghost);
    const ghost_edges = new LineSegments(edges.geometry, this.materials["ghost-edge"]);
    for (const node of [mesh, edges, ghost, ghost_edges]) {
      node.name = name;
      node.matrixAutoUpdate = false;
      node.matrix.copy(matrix);
    }
    mesh.userData["role"] = role;
    ghost.renderOrder = 5;
    ghost_edges.renderOrder = 6;
    body.node.add(mesh, edges);
    body.ghost.add(ghost, ghost_edges);
    body.meshes.push(mesh);
    return mesh;
  }

  private addTool(): void {
    const machine = this.machine;
    const t = machine?.links.findIndex((l) => l.kind === "tool") ?? -1;
    if (!machine || t < 0 || machine.models.some((m) => m.body === t)) return;
    const { length_mm, diameter_mm } = machine.tool;
    if (!(length_mm > 0)) return;
    const u = unitOf(machine.links);
    const radius = diameter_mm !== null && diameter_mm > 0 ? diameter_mm / 2 : Math.min(0.1 * u, 0.1 * length_mm);
    const holder = Math.min(0.45 * length_mm, 0.5 * u);
    this.addPart(t, "tool holder", standingCone(Math.max(1.5 * radius, 0.12 * u), Math.max(2 * radius, 0.2 * u), holder), new Matrix4().makeTranslation(0, 0, -holder));
    this.addPart(t, "tool", new CylinderGeometry(radius, radius, length_mm - holder, 32).rotateX(Math.PI / 2).translate(0, 0, -(length_mm + holder) / 2), new Matrix4(), "part");
  }

  /** A block at part zero: it fills the room down to the table where there is some. */
  private addWorkpiece(): void {
    const machine = this.machine;
    const w = machine?.links.findIndex((l) => l.kind === "workpiece") ?? -1;
    const body = this.bodies[w];
    if (!machine || !body || machine.models.some((m) => m.body === w)) return;
    const u = unitOf(machine.links);
    this.scene.updateMatrixWorld(true);
    const down = new Vector3(0, 0, -1).transformDirection(body.node.matrixWorld);
    const zero = new Vector3().setFromMatrixPosition(body.node.matrixWorld);
    const carriers = [this.bed, ...this.bodies.filter((_, i) => machine.links[i]?.carries === "workpiece")];
    const hits = new Raycaster(zero, down, 0, 1.5 * u).intersectObjects(carriers.flatMap((b) => b.meshes), false);
    const gap = hits[0]?.distance ?? 0;
    const height = gap > 0.12 * u ? gap : 0.32 * u;
    const z = gap > 0.12 * u ? -gap / 2 : height / 2;
    this.addPart(w, STAND_IN, new BoxGeometry(0.62 * u, 0.62 * u, height), new Matrix4().makeTranslation(0, 0, z));
    const axes = new AxesHelper(0.5 * u);
    axes.renderOrder = 9;
    body.node.add(axes);
  }

  private addArrows(): void {
    const machine = this.machine;
    if (!machine) return;
    const size = 0.085 * this.bounds().getSize(new Vector3()).length();
    machine.links.forEach((link, i) => {
      const body = this.bodies[i];
      if (!body || (link.kind !== "linear" && link.kind !== "rotary")) return;
      const box = new Box3();
      for (const mesh of body.meshes) box.union(new Box3().setFromBufferAttribute(mesh.geometry.getAttribute("position") as never).applyMatrix4(mesh.matrix));
      if (box.isEmpty()) box.setFromCenterAndSize(new Vector3(), new Vector3(size, size, size));
      const arrow = axisArrow(link, box, body.node.matrix, size, cssColour("--scene-arrow"));
      body.node.add(arrow.group);
      this.arrows.push(arrow.group);
      this.overlay.label(`axis ${link.name}`, arrow.text, () => arrow.label_at.clone().applyMatrix4(body.node.matrixWorld));
    });
  }

  private addGrid(): void {
    if (this.grid) this.scene.remove(this.grid);
    this.grid?.geometry.dispose();
    const box = this.bounds();
    const size = box.getSize(new Vector3());
    const wide = Math.max(size.x, size.y) * 1.5;
    const cell = 10 ** Math.floor(Math.log10(wide / 8));
    const step = wide / cell > 40 ? 5 * cell : wide / cell > 16 ? 2 * cell : cell;
    const count = 2 * Math.ceil(wide / step / 2);
    this.grid = new GridHelper(count * step, count, cssColour("--scene-grid"), cssColour("--scene-grid"));
    const material = this.grid.material as LineBasicMaterial;
    material.transparent = true;
    material.opacity = 0.55;
    this.grid.rotateX(Math.PI / 2);
    const centre = box.getCenter(new Vector3());
    this.grid.position.set(Math.round(centre.x / step) * step, Math.round(centre.y / step) * step, box.min.z - 1e-3 * wide);
    this.scene.add(this.grid);
    this.overlay.note("grid", `grid ${step} mm`);
  }

  private bounds(): Box3 {
    this.scene.updateMatrixWorld(true);
    const box = new Box3();
    for (const body of [this.bed, ...this.bodies]) for (const mesh of body.meshes) box.expandByObject(mesh);
    // Without a machine, the part alone is the picture.
    if (box.isEmpty()) box.expandByObject(this.layers);
    if (box.isEmpty()) box.setFromCenterAndSize(new Vector3(), new Vector3(500, 500, 500));
    return box;
  }

  // ---- materials ----

  private makeMaterials(): void {
    for (const old of Object.values(this.materials)) old.dispose();
    const solid = (name: string): Material => new MeshLambertMaterial({ color: cssColour(name), polygonOffset: true, polygonOffsetFactor: 1, polygonOffsetUnits: 1 });
    const line = (name: string, opacity: number): Material => new LineBasicMaterial({ color: cssColour(name), transparent: true, opacity });
    this.materials = {
      bed: solid("--scene-bed"),
      linear: solid("--scene-linear"),
      rotary: solid("--scene-rotary"),
      tool: solid("--scene-tool"),
      part: solid("--scene-part"),
      edge: line("--scene-edge", 0.5),
      // Behind the solid where both coincide, so that an undisplaced body looks clean.
      ghost: new MeshBasicMaterial({ color: cssColour("--scene-ghost"), transparent: true, opacity: 0.2, depthWrite: false, side: DoubleSide, polygonOffset: true, polygonOffsetFactor: 2, polygonOffsetUnits: 2 }),
      "ghost-edge": line("--scene-ghost", 0.85),
    };
  }

  /** New colours after a change of theme. */
  private repaint(): void {
    this.makeMaterials();
    for (const body of [this.bed, ...this.bodies]) {
      for (const [group, mesh, edge] of [[body.node, null, "edge"], [body.ghost, "ghost", "ghost-edge"]] as const) {
        for (const child of group.children) {
          if (child instanceof LineSegments && !(child instanceof AxesHelper)) child.material = this.materials[edge] as Material;
          else if (child instanceof Mesh) child.material = this.materials[mesh ?? (child.userData["role"] as Role)] as Material;
        }
      }
    }
    for (const arrow of this.arrows) for (const child of arrow.children) ((child as Mesh).material as MeshBasicMaterial).color.set(cssColour("--scene-arrow"));
    if (this.machine) this.addGrid();
    this.requestRender();
  }

  /** Marks one body (an axis row under the mouse); null marks none. */
  highlight(name: string | null): void {
    for (const body of this.bodies) {
      for (const mesh of body.meshes) {
        const role = mesh.userData["role"] as Role;
        const base = this.materials[role] as MeshLambertMaterial;
        if (mesh.material !== base) (mesh.material as Material).dispose();
        if (body.name === name) {
          const lit = base.clone();
          lit.color.lerp(lit.color.clone().set(cssColour("--scene-arrow")), 0.55);
          mesh.material = lit;
        } else mesh.material = base;
      }
    }
    this.requestRender();
  }

  /** The arrows of positive motion are in the way of close looks. */
  setArrowsVisible(visible: boolean): void {
    for (const arrow of this.arrows) arrow.visible = visible;
    this.overlay.element.classList.toggle("without-labels", !visible);
    this.requestRender();
  }

  // ---- poses ----

  /**
   * 12 numbers per body, in the order of `links`: bed_from_body. The ghost has the displacement of
   * every body point times `exaggeration`: R_n + k·(R_a − R_n), o_n + k·(o_a − o_n); k = 1 is true.
   */
  setPoses(nominal: Float64Array, actual: Float64Array, exaggeration = this.k): void {
    const changed = exaggeration !== this.k || this.poses === null;
    this.poses = { nominal, actual };
    this.k = exaggeration;
    const n = new Matrix4();
    const a = new Matrix4();
    this.bodies.forEach((_, i) => {
      matrixOf(nominal, 12 * i, n);
      matrixOf(actual, 12 * i, a);
      const ghost = a.clone();
      for (let j = 0; j < 16; j++) ghost.elements[j] = (n.elements[j] as number) + exaggeration * ((a.elements[j] as number) - (n.elements[j] as number));
      this.placeBody(i, n, ghost);
    });
    if (changed) {
      this.path?.setExaggeration(exaggeration);
      this.surface?.setExaggeration(exaggeration);
    }
    this.showGhost();
  }

  private noteFactor(): void {
    const text = this.k === 1 ? "Actual machine: true size (×1)" : `Actual machine: deviations ${factor(this.k)}`;
    this.overlay.note("factor", this.ghost_wanted ? text : null, "actual");
  }

  setExaggeration(k: number): void {
    if (this.poses) this.setPoses(this.poses.nominal, this.poses.actual, k);
    else {
      this.k = k;
      this.path?.setExaggeration(k);
      this.surface?.setExaggeration(k);
      this.requestRender();
    }
  }

  setGhostVisible(visible: boolean): void {
    this.ghost_wanted = visible;
    this.showGhost();
  }

  private showGhost(): void {
    this.ghost_root.visible = this.ghost_wanted && this.poses !== null;
    this.path?.setGhostVisible(this.ghost_wanted);
    this.noteFactor();
    this.requestRender();
  }

  private placeBody(index: number, nominal: Matrix4, ghost: Matrix4): void {
    const body = this.bodies[index];
    if (!body) return;
    body.node.matrix.copy(nominal);
    body.ghost.matrix.copy(ghost);
    body.node.matrixWorldNeedsUpdate = true;
    body.ghost.matrixWorldNeedsUpdate = true;
  }

  poseOf(name: string, which: "nominal" | "ghost" = "nominal"): number[] | null {
    const body = name === "b" ? this.bed : this.bodies.find((b) => b.name === name);
    if (!body) return null;
    const node: Object3D = which === "ghost" ? body.ghost : body.node;
    node.updateWorldMatrix(true, false);
    const e = node.matrixWorld.elements;
    return [0, 4, 8, 1, 5, 9, 2, 6, 10, 12, 13, 14].map((i) => e[i] as number);
  }

  boxOf(name: string): number[] | null {
    const body = name === "b" ? this.bed : this.bodies.find((b) => b.name === name);
    if (!body) return null;
    const box = new Box3();
    for (const mesh of body.meshes) box.union(new Box3().setFromBufferAttribute(mesh.geometry.getAttribute("position") as never).applyMatrix4(mesh.matrix));
    return [...box.min.toArray(), ...box.max.toArray()];
  }

  /** The tool tip in the workpiece frame, mm, from the scene graph. */
  nominalTip(): [number, number, number] | null {
    const links = this.machine?.links ?? [];
    const w = this.bodies[links.findIndex((l) => l.kind === "workpiece")];
    const t = this.bodies[links.findIndex((l) => l.kind === "tool")];
    if (!w || !t || !this.machine) return null;
    w.node.updateWorldMatrix(true, false);
    t.node.updateWorldMatrix(true, false);
    const tip = new Vector3(...(this.machine.tool.tip_mm ?? [0, 0, -this.machine.tool.length_mm]));
    tip.applyMatrix4(t.node.matrixWorld).applyMatrix4(w.node.matrixWorld.clone().invert());
    return [tip.x, tip.y, tip.z];
  }

  // ---- layers in the workpiece ----

  private attachLayers(): void {
    this.layers.removeFromParent();
    const w = this.machine?.links.findIndex((l) => l.kind === "workpiece") ?? -1;
    (this.bodies[w]?.node ?? this.scene).add(this.layers);
  }

  /** More points of a path than this are not drawn. */
  get mostPathPoints(): number {
    return this.pace?.most_points ?? 1000;
  }

  /** Draws a tool path in the workpiece; null takes it away. `bar` is its colour bar. */
  setPath(data: PathData | null, bar?: Omit<ColourBarSpec, "range" | "map">): void {
    if (this.path) this.layers.remove(this.path.group);
    this.path?.dispose();
    this.path = data ? new PathLayer(data, { dim: cssColour("--muted"), ghost: cssColour("--scene-ghost") }, this.mostPathPoints) : null;
    this.showStandIn();
    if (this.path) {
      this.path.setExaggeration(this.k);
      this.path.setGhostVisible(this.ghost_wanted);
      this.layers.add(this.path.group);
    }
    this.showBar(this.path && data && bar ? { ...bar, range: this.path.range, map: data.map } : null);
    this.requestRender();
  }

  /** The block that stands in for an unknown workpiece would hide the path. */
  private showStandIn(): void {
    const w = this.machine?.links.findIndex((l) => l.kind === "workpiece") ?? -1;
    const body = this.bodies[w];
    for (const node of [...(body?.node.children ?? []), ...(body?.ghost.children ?? [])]) if (node.name === STAND_IN) node.visible = this.path === null;
  }

  /** Other values on the same path. */
  setPathValues(values: Float32Array, bar: Omit<ColourBarSpec, "range" | "map">, options: Pick<PathData, "map" | "range"> = {}): void {
    if (!this.path) return;
    this.path.setValues(values, options.map, options.range);
    this.showBar({ ...bar, range: this.path.range, map: options.map });
    this.requestRender();
  }

  /** How many points of the path are done. */
  setPathProgress(n: number): void {
    this.path?.setProgress(n);
    this.requestRender();
  }

  setSurface(data: SurfaceData | null, bar?: Omit<ColourBarSpec, "range" | "map">): void {
    if (this.surface) this.layers.remove(this.surface.group);
    this.surface?.dispose();
    this.surface = data ? new SurfaceLayer(data) : null;
    if (this.surface) {
      this.surface.setExaggeration(this.k);
      this.layers.add(this.surface.group);
    }
    this.showBar(this.surface && data && bar ? { ...bar, range: this.surface.range, map: data.map } : null);
    this.requestRender();
  }

  /** Something of the caller's own in the workpiece frame (poses, arrows of residuals). */
  addToWorkpiece(object: Object3D): void {
    this.layers.add(object);
    this.requestRender();
  }

  showBar(spec: ColourBarSpec | null): void {
    this.overlay.legend.replaceChildren(...(spec ? [colourBar(spec)] : []));
  }

  // ---- camera ----

  setView(name: ViewName): void {
    const box = this.bounds();
    const centre = box.getCenter(new Vector3());
    const from = new Vector3(...VIEWS[name].from).normalize();
    this.frame(centre, from, box);
  }

  fit(): void {
    const box = this.bounds();
    const from = this.camera.position.clone().sub(this.controls?.target ?? new Vector3()).normalize();
    this.frame(box.getCenter(new Vector3()), from, box);
  }

  /** The whole tool path fills the picture, with the tool above it. */
  fitPath(): void {
    if (!this.path) return;
    this.scene.updateMatrixWorld(true);
    const box = this.path.extent().applyMatrix4(this.path.group.matrixWorld);
    box.expandByScalar(0.15 * box.getSize(new Vector3()).length() + 1);
    const from = this.camera.position.clone().sub(this.controls?.target ?? new Vector3()).normalize();
    this.frame(box.getCenter(new Vector3()), from, box);
  }

  /** Looks at the workpiece from where the camera stands: `radius` mm around a point of its frame. */
  lookAtWorkpiece(point: readonly [number, number, number], radius: number): void {
    this.scene.updateMatrixWorld(true);
    const centre = new Vector3(...point).applyMatrix4(this.layers.matrixWorld);
    const from = this.camera.position.clone().sub(this.controls?.target ?? new Vector3()).normalize();
    this.frame(centre, from, new Box3(centre.clone().addScalar(-radius), centre.clone().addScalar(radius)));
  }

  /** Puts both cameras so that `box` fills the picture, seen from `from`. */
  private frame(centre: Vector3, from: Vector3, box: Box3): void {
    const aspect = this.size.width / this.size.height;
    const right = new Vector3(0, 0, 1).cross(from).normalize();
    const up = from.clone().cross(right);
    const tangent = Math.tan((this.perspective.fov * Math.PI) / 360);
    let [half, distance] = [0, 0];
    for (let i = 0; i < 8; i++) {
      const corner = new Vector3(i & 1 ? box.max.x : box.min.x, i & 2 ? box.max.y : box.min.y, i & 4 ? box.max.z : box.min.z).sub(centre);
      const seen = 1.08 * Math.max(Math.abs(corner.dot(up)), Math.abs(corner.dot(right)) / aspect);
      half = Math.max(half, seen);
      distance = Math.max(distance, corner.dot(from) + seen / tangent);
    }
    for (const camera of [this.perspective, this.orthographic]) {
      camera.position.copy(centre).addScaledVector(from, distance);
      camera.near = Math.max(1, distance / 200);
      camera.far = distance * 20;
    }
    this.orthographic.userData["half"] = half;
    this.orthographic.zoom = 1;
    this.controls?.target.copy(centre);
    this.resize();
    this.controls?.update();
  }

  setOrthographic(on: boolean): void {
    const [from, to] = on ? [this.perspective, this.orthographic] : [this.orthographic, this.perspective];
    const target = this.controls?.target ?? new Vector3();
    const sight = from.position.clone().sub(target);
    const tangent = Math.tan((this.perspective.fov * Math.PI) / 360);
    if (on) {
      to.position.copy(from.position);
      this.orthographic.userData["half"] = sight.length() * tangent;
      this.orthographic.zoom = 1;
    } else {
      const half = (this.orthographic.userData["half"] as number) / this.orthographic.zoom;
      to.position.copy(target).addScaledVector(sight.normalize(), half / tangent);
    }
    to.near = from.near;
    to.far = from.far;
    this.camera = to;
    if (this.controls) this.controls.object = to;
    this.projection.setAttribute("aria-pressed", String(on));
    this.resize();
    this.controls?.update();
  }

  private key(event: KeyboardEvent): void {
    const view = ({ "0": "iso", "1": "x", "2": "y", "3": "z" } as Record<string, ViewName>)[event.key];
    const turn = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] }[event.key];
    if (view) this.setView(view);
    else if (event.key === "4") this.fit();
    else if (event.key === "5") this.setOrthographic(this.camera === this.perspective);
    else if (event.key === "+" || event.key === "=") this.zoom(0.85);
    else if (event.key === "-") this.zoom(1 / 0.85);
    else if (turn) (event.shiftKey ? this.pan(turn[0] as number, turn[1] as number) : this.turn(turn[0] as number, turn[1] as number));
    else return;
    event.preventDefault();
  }

  private turn(x: number, y: number): void {
    const target = this.controls?.target ?? new Vector3();
    const arm = this.camera.position.clone().sub(target);
    const polar = Math.min(3.1, Math.max(0.04, arm.angleTo(new Vector3(0, 0, 1)) + 0.08 * y));
    const azimuth = Math.atan2(arm.y, arm.x) + 0.1 * x;
    const r = arm.length();
    this.camera.position.copy(target).add(new Vector3(Math.sin(polar) * Math.cos(azimuth), Math.sin(polar) * Math.sin(azimuth), Math.cos(polar)).multiplyScalar(r));
    this.controls?.update();
    this.requestRender();
  }

  private pan(x: number, y: number): void {
    const by = new Vector3(-x, y, 0).applyQuaternion(this.camera.quaternion).multiplyScalar(0.05 * this.camera.position.distanceTo(this.controls?.target ?? new Vector3()));
    this.camera.position.add(by);
    this.controls?.target.add(by);
    this.controls?.update();
    this.requestRender();
  }

  private zoom(by: number): void {
    if (this.camera === this.orthographic) this.orthographic.zoom /= by;
    else {
      const target = this.controls?.target ?? new Vector3();
      this.camera.position.sub(target).multiplyScalar(by).add(target);
    }
    this.camera.updateProjectionMatrix();
    this.controls?.update();
    this.requestRender();
  }

  private resize(): void {
    const { clientWidth, clientHeight } = this.element;
    if (clientWidth === 0 || clientHeight === 0) return;
    const first = this.size.width === 1;
    this.size.width = clientWidth;
    this.size.height = clientHeight;
    this.renderer?.setSize(clientWidth, clientHeight);
    const aspect = clientWidth / clientHeight;
    this.perspective.aspect = aspect;
    this.perspective.updateProjectionMatrix();
    const half = (this.orthographic.userData["half"] as number | undefined) ?? 1000;
    Object.assign(this.orthographic, { left: -half * aspect, right: half * aspect, top: half, bottom: -half });
    this.orthographic.updateProjectionMatrix();
    if (first && this.machine) this.setView("iso");
    this.requestRender();
  }

  // ---- drawing ----

  /** Draws at the next frame, once. */
  requestRender(): void {
    this.pace?.moved();
    this.schedule();
  }

  private schedule(): void {
    if (this.scheduled) return;
    this.scheduled = true;
    requestAnimationFrame(() => {
      this.scheduled = false;
      this.render();
    });
  }

  private render(): void {
    if (this.size.width <= 1 || !this.element.isConnected) return;
    this.scene.updateMatrixWorld();
    this.camera.updateMatrixWorld();
    const canvas = this.renderer?.domElement;
    if (canvas) this.path?.setPicture(canvas.width, canvas.height, !this.pace?.hurries);
    this.renderer?.render(this.scene, this.camera);
    this.overlay.update(this.camera, this.size.width, this.size.height);
    this.drawn += 1;
  }

  /** The picture with its words as a PNG file. */
  savePng(name: string): void {
    if (!this.renderer) return;
    this.render();
    const from = this.renderer.domElement;
    const canvas = h("canvas", { width: from.width, height: from.height });
    const paint = canvas.getContext("2d");
    if (!paint) return;
    const sky = paint.createLinearGradient(0, 0, 0, from.height);
    sky.addColorStop(0, cssColour("--scene-top"));
    sky.addColorStop(1, cssColour("--scene-bottom"));
    paint.fillStyle = sky;
    paint.fillRect(0, 0, from.width, from.height);
    paint.drawImage(from, 0, 0);
    const scale = from.width / this.size.width;
    paint.scale(scale, scale);
    paint.font = "600 12px system-ui, sans-serif";
    paint.textAlign = "center";
    paint.textBaseline = "middle";
    paint.fillStyle = cssColour("--ink");
    for (const { text, x, y } of this.overlay.texts()) paint.fillText(text, x, y);
    canvas.toBlob((blob) => blob && download(`${name}.png`, blob));
  }

  dispose(): void {
    this.watch.disconnect();
    this.stop_theme();
    this.pace?.stop();
    this.setPath(null);
    this.setSurface(null);
    this.clearMachine();
    for (const material of Object.values(this.materials)) material.dispose();
    this.controls?.dispose();
    this.renderer?.dispose();
    this.element.remove();
    delete window.trueaxisScene;
  }
}
