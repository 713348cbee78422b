/** The machine in three dimensions: nominal solid, actual as a ghost, drawn only when something changed. */

import { tr } from "../words/index.ts";
import {
  AxesHelper,
  Box3,
  type Camera,
  type Group,
  type InstancedMesh,
  type Line,
  type Mesh,
  type MeshBasicMaterial,
  type Object3D,
  type Plane,
  Raycaster,
  Scene,
  Vector2,
  Vector3,
  WebGLRenderer,
} from "three";
import type { MachineDescription, Model, ToolShape } from "../api.ts";
import { h } from "../dom.ts";
import type { ColourBarSpec } from "../figure/colourbar.ts";
import { factor } from "../format.ts";
import { cssColour, onTheme } from "../theme.ts";
import { axisArrow } from "./arrows.ts";
import { Bodies, type DrawnPart } from "./bodies.ts";
import { ViewCamera } from "./camera.ts";
import { type Grid, gridUnder, lights } from "./floor.ts";
import type { PathData, SurfaceData } from "./layers.ts";
import { Overlay } from "./overlay.ts";
import { drawnByProcessor, Pace } from "./pace.ts";
import { savePng } from "./picture.ts";
import { probeOf } from "./probe.ts";
import { schematic, unitOf } from "./schematic.ts";
import { cornersOf, geometryOf, matrixOf } from "./shapes.ts";
import { SceneTools } from "./tools.ts";
import { toolParts, workpieceBlock } from "./tool.ts";
import { type BarWords, WorkpieceLayers } from "./workpiece.ts";

export class MachineView {
  readonly element = h("div", { class: "scene" });
  readonly overlay = new Overlay();
  private readonly scene = new Scene();
  private readonly renderer: WebGLRenderer | null;
  private pace: Pace | null = null;
  private readonly camera = new ViewCamera({
    corners: () => this.corners(),
    moved: () => this.requestRender(),
    chosen: () => this.onView(this.camera.state),
  });
  /** The user chose another view. */
  onView: (state: string) => void = () => {};
  /** A view that was asked for before there was room for a picture. */
  private wanted_view: string | null = null;
  private readonly bodies = new Bodies();
  readonly tools = new SceneTools(this, this.bodies, this.overlay);
  private readonly layers = new WorkpieceLayers(this.overlay.legend);
  private machine: MachineDescription | null = null;
  private tool: DrawnPart[] = [];
  /** The block that is drawn where no workpiece is known. */
  private block: DrawnPart | null = null;
  private on_workpiece: DrawnPart[] = [];
  private arrows: Group[] = [];
  private arrow_mm = 0;
  private show_arrows = true;
  private grid: Grid | null = null;
  private poses: { nominal: Float64Array; actual: Float64Array } | null = null;
  private k = 1;
  private show_ghost = true;
  private readonly size = { width: 1, height: 1 };
  private scheduled = false;
  private drawn = 0;

  constructor(host: HTMLElement) {
    host.append(this.element);
    this.renderer = this.makeRenderer();
    this.camera.buttons.append(
      h("button", { title: tr`Save the picture as PNG`, onclick: () => this.savePng() }, "PNG"),
    );
    this.element.append(this.overlay.element, this.camera.buttons, this.tools.element);
    this.scene.add(this.bodies.root, this.bodies.ghost_root, lights());
    new ResizeObserver(() => this.resize()).observe(this.element);
    onTheme(() => this.repaint());
    window.trueaxisScene = probeOf(
      this.bodies,
      () => this.machine?.tool ?? null,
      () => this.drawn,
      () => this.seen(),
    );
  }

  private makeRenderer(): WebGLRenderer | null {
    try {
      const slow = drawnByProcessor();
      const renderer = new WebGLRenderer({ antialias: !slow, alpha: true });
      this.pace = new Pace(renderer, slow, () => this.schedule());
      this.element.append(renderer.domElement);
      this.camera.attach(renderer.domElement);
      this.tools.attach(renderer.domElement);
      return renderer;
    } catch {
      this.element.append(
        h(
          "p",
          { class: "scene-failed" },
          tr`This browser cannot draw in three dimensions (WebGL is off). All figures and tables work without it.`,
        ),
      );
      return null;
    }
  }

  // ---- the machine ----

  /** Builds the bodies of the chain; models where the machine file has them, else a schematic. */
  setMachine(machine: MachineDescription, keep_view = false): void {
    this.clearMachine();
    this.machine = machine;
    this.bodies.build(machine.links);
    for (const model of machine.models) if (!("stl" in model.shape)) this.addModel(model);
    for (const part of schematic(machine)) this.bodies.add(part);
    this.drawTool();
    this.addBlock();
    (this.bodies.nodeAt(this.bodies.indexOf("workpiece")) ?? this.scene).add(this.layers.group);
    this.addArrows();
    this.layGrid();
    this.showBlock();
    this.showGhost();
    this.tools.clear(identityOf(machine));
    if (!keep_view) {
      this.wanted_view = null;
      this.camera.setView("iso");
    }
    this.requestRender();
  }

  private clearMachine(): void {
    this.layers.group.removeFromParent();
    this.bodies.clear();
    this.tool = [];
    this.block = null;
    this.on_workpiece = [];
    this.arrows = [];
    this.poses = null;
    this.overlay.clearLabels();
  }

  private addModel({ body, name, shape, placement }: Model): void {
    this.bodies.add({ body, name, geometry: geometryOf(shape), matrix: matrixOf(placement) });
  }

  private hasModels(body: number): boolean {
    return this.machine?.models.some((model) => model.body === body) ?? false;
  }

  /** Another tool on the same machine. */
  setTool(tool: ToolShape): void {
    if (!this.machine) return;
    this.machine = { ...this.machine, tool };
    this.drawTool();
    this.requestRender();
  }

  /** A model of the machine file shows the tool, too, unless the tool itself is known. */
  private drawTool(): void {
    for (const part of this.tool) this.bodies.remove(part);
    this.tool = [];
    const tool = this.machine?.tool;
    if (!tool || (!tool.segments_mm?.length && this.hasModels(this.bodies.indexOf("tool")))) return;
    this.tool = toolParts(this.bodies, tool).map((part) => this.bodies.add(part));
  }

  /** What stands where the workpiece is (stock, part, fixtures), seen through. */
  setOnWorkpiece(models: readonly Model[]): void {
    for (const part of this.on_workpiece) this.bodies.remove(part);
    this.on_workpiece = models.map(({ body, name, shape, placement }) =>
      this.bodies.add({ body, name, geometry: geometryOf(shape), matrix: matrixOf(placement), role: "stock" }),
    );
    // As lines alone: two bodies that are seen through, one in the other, are a muddle.
    for (const { ghost } of this.on_workpiece) ghost.visible = false;
    this.showBlock();
    this.requestRender();
  }

  private addBlock(): void {
    const w = this.bodies.indexOf("workpiece");
    const part = this.hasModels(w) ? null : workpieceBlock(this.bodies);
    if (!part) return;
    this.block = this.bodies.add(part);
    const axes = new AxesHelper(0.5 * unitOf(this.bodies.links));
    axes.renderOrder = 9;
    this.bodies.nodeAt(w)?.add(axes);
  }

  /** An invented block would hide a path, and contradict a stated workpiece. */
  private showBlock(): void {
    if (!this.block) return;
    const { solid, edges, ghost, ghost_edges } = this.block;
    for (const node of [solid, edges, ghost, ghost_edges])
      node.visible = this.layers.path === null && this.on_workpiece.length === 0;
  }

  private addArrows(): void {
    const size = 0.085 * this.bounds().getSize(new Vector3()).length();
    this.arrow_mm = size;
    for (const link of this.bodies.links) {
      const body = this.bodies.named(link.name);
      if (!body || (link.kind !== "linear" && link.kind !== "rotary")) continue;
      const box = this.bodies.boxOf(body);
      if (box.isEmpty()) box.setFromCenterAndSize(new Vector3(), new Vector3(size, size, size));
      const arrow = axisArrow(link, box, body.node.matrix, size, cssColour("--scene-arrow"));
      body.node.add(arrow.group);
      this.arrows.push(arrow.group);
      this.overlay.label(`axis ${link.name}`, arrow.text, () =>
        arrow.label_at.clone().applyMatrix4(body.node.matrixWorld),
      );
    }
  }

  private layGrid(): void {
    this.grid?.helper.removeFromParent();
    this.grid?.helper.dispose();
    this.grid = gridUnder(this.bounds());
    this.scene.add(this.grid.helper);
    this.overlay.note("grid", tr`grid ${this.grid.step_mm} mm`);
  }

  /** What the whole picture has to show. */
  private corners(): Vector3[] {
    this.scene.updateMatrixWorld(true);
    const corners = this.bodies.corners();
    if (corners.length > 0) return corners;
    // Without a machine, the part alone is the picture.
    const box = new Box3().expandByObject(this.layers.group);
    return cornersOf(box.isEmpty() ? box.setFromCenterAndSize(new Vector3(), new Vector3(500, 500, 500)) : box);
  }

  private bounds(): Box3 {
    return new Box3().setFromPoints(this.corners());
  }

  // ---- how it looks ----

  /** New colours after a change of theme. */
  private repaint(): void {
    this.bodies.repaint();
    for (const arrow of this.arrows)
      for (const child of arrow.children)
        ((child as Mesh).material as MeshBasicMaterial).color.set(cssColour("--scene-arrow"));
    if (this.machine) this.layGrid();
    this.requestRender();
  }

  /** Marks one body (an axis row under the mouse); null marks none. */
  highlight(name: string | null): void {
    this.bodies.highlight(name);
    this.requestRender();
  }

  setArrowsVisible(visible: boolean): void {
    this.show_arrows = visible;
    this.requestRender();
  }

  /** The arrows of positive motion are in the way of close looks. */
  private showArrows(): void {
    if (this.arrows.length === 0) return;
    const visible = this.show_arrows && this.arrow_mm < 0.22 * this.camera.height();
    for (const arrow of this.arrows) arrow.visible = visible;
    this.overlay.element.classList.toggle("without-labels", !visible);
  }

  /** Looks from where the words of an address say; nothing else changes that until another machine is shown. */
  setView(state: string): void {
    this.wanted_view = state;
    if (this.size.width > 1) this.camera.state = state;
  }

  /** From where it is seen, in words. */
  viewWords(): string {
    return this.camera.state;
  }

  // ---- poses and deviations ----

  /** 12 numbers per body, in the order of `links`: bed_from_body. */
  setPoses(nominal: Float64Array, actual: Float64Array): void {
    this.poses = { nominal, actual };
    this.bodies.setPoses(nominal, actual, this.k);
    this.showGhost();
  }

  /** How much larger deviations are drawn than they are; 1 is true. */
  setExaggeration(k: number): void {
    this.k = k;
    this.layers.setExaggeration(k);
    if (this.poses) this.bodies.setPoses(this.poses.nominal, this.poses.actual, k);
    this.showGhost();
  }

  setGhostVisible(visible: boolean): void {
    this.show_ghost = visible;
    this.layers.setGhostVisible(visible);
    this.showGhost();
  }

  private showGhost(): void {
    const seen = this.show_ghost && this.poses !== null;
    this.bodies.ghost_root.visible = seen;
    const text = this.k === 1 ? tr`Actual machine: true size (×1)` : tr`Actual machine: deviations ${factor(this.k)}`;
    this.overlay.note("ghost", seen ? text : null, "actual");
    this.requestRender();
  }

  // ---- layers on the workpiece ----

  /** More points of a path than this are not drawn. */
  get mostPathPoints(): number {
    return this.pace?.most_points ?? 1000;
  }

  /** Draws a tool path in the workpiece; null takes it away. `bar` is its colour bar. */
  setPath(data: PathData | null, bar?: BarWords): void {
    this.layers.setPath(data, this.mostPathPoints, bar);
    this.showBlock();
    this.requestRender();
  }

  /** How many points of the path are done. */
  setPathProgress(n: number): void {
    this.layers.path?.setProgress(n);
    this.requestRender();
  }

  setSurface(data: SurfaceData | null, bar?: BarWords): void {
    this.layers.setSurface(data, bar);
    this.requestRender();
  }

  /** The colour bar of something of the caller's own. */
  showScale(bar: ColourBarSpec): void {
    this.layers.showBar(bar);
  }

  /** For a press at a place of the page: where the picture is, and from where it is seen. */
  seen(): { box: DOMRect; camera: Camera } {
    this.scene.updateMatrixWorld(true);
    this.camera.camera.updateMatrixWorld();
    return { box: this.element.getBoundingClientRect(), camera: this.camera.camera };
  }

  /** Box around all that is shown, in the machine frame, mm. */
  extent(): Box3 {
    return this.bounds();
  }

  /** Cuts away what lies below a plane; null cuts nothing. */
  cut(plane: Plane | null): void {
    if (this.renderer) this.renderer.clippingPlanes = plane ? [plane] : [];
    this.requestRender();
  }

  /** One line in the machine frame, or none. */
  showLine(line: Line | null): void {
    if (line) this.scene.add(line);
    this.requestRender();
  }

  /** Which instance of a mesh is seen at a place of the page; null: none. */
  instanceAt(mesh: InstancedMesh, x: number, y: number): number | null {
    const box = this.element.getBoundingClientRect();
    const at = new Vector2((2 * (x - box.left)) / box.width - 1, 1 - (2 * (y - box.top)) / box.height);
    const ray = new Raycaster();
    this.scene.updateMatrixWorld(true);
    ray.setFromCamera(at, this.camera.camera);
    return ray.intersectObject(mesh)[0]?.instanceId ?? null;
  }

  /** Something of the caller's own in the workpiece frame (poses, arrows of residuals). */
  addToWorkpiece(object: Object3D): void {
    this.layers.add(object);
    this.requestRender();
  }

  /** The whole tool path fills the picture, seen from the side to which the workpiece is tilted. */
  fitPath(): void {
    const { path } = this.layers;
    if (!path) return;
    this.scene.updateMatrixWorld(true);
    const box = path.extent().applyMatrix4(path.group.matrixWorld);
    const up = new Vector3(0, 0, 1).transformDirection(path.group.matrixWorld);
    this.camera.show(cornersOf(box.expandByScalar(0.15 * box.getSize(new Vector3()).length() + 1)), up);
  }

  /** Looks at the workpiece from where the camera stands: `radius` mm around a point of its frame. */
  lookAtWorkpiece(point: readonly [number, number, number], radius: number): void {
    this.scene.updateMatrixWorld(true);
    const centre = new Vector3(...point).applyMatrix4(this.layers.group.matrixWorld);
    this.camera.show(cornersOf(new Box3(centre.clone().addScalar(-radius), centre.clone().addScalar(radius))));
  }

  // ---- drawing ----

  private resize(): void {
    const { clientWidth, clientHeight } = this.element;
    if (clientWidth === 0 || clientHeight === 0) return;
    const first = this.size.width === 1;
    Object.assign(this.size, { width: clientWidth, height: clientHeight });
    this.renderer?.setSize(clientWidth, clientHeight);
    this.camera.resize(clientWidth, clientHeight);
    if (!first || !this.machine) return;
    this.camera.setView("iso");
    if (this.wanted_view) this.camera.state = this.wanted_view;
  }

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
    const { camera } = this.camera;
    this.showArrows();
    this.scene.updateMatrixWorld();
    camera.updateMatrixWorld();
    const canvas = this.renderer?.domElement;
    if (canvas) this.layers.path?.setPicture(canvas.width, canvas.height, !this.pace?.hurries);
    this.renderer?.render(this.scene, camera);
    this.overlay.update(camera, this.size.width, this.size.height);
    this.drawn += 1;
  }

  private savePng(): void {
    if (!this.renderer) return;
    this.render();
    savePng("machine", this.renderer.domElement, this.size.width, this.overlay);
  }
}

/** Tells machines apart: the chain with its travels. */
const identityOf = ({ links }: MachineDescription): string =>
  JSON.stringify(links.map((l) => [l.name, l.travel ?? null]));
