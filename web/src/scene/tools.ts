/** Over the picture: how each body is drawn, a section, the distance of two points; a press on a body picks it. */

import { tr } from "../words/index.ts";
import { BufferGeometry, Line, LineBasicMaterial, type Mesh, Plane, Raycaster, Vector2, Vector3 } from "three";
import { fill, h } from "../dom.ts";
import { fixed, NARROW_SPACE } from "../format.ts";
import { cssColour } from "../theme.ts";
import type { Bodies, Look } from "./bodies.ts";
import type { Overlay } from "./overlay.ts";
import { SavedViews, type ViewParts } from "./savedviews.ts";
import type { MachineView } from "./view.ts";

const LOOKS: readonly [Look, string][] = [
  ["solid", tr`solid`],
  ["glass", tr`see-through`],
  ["hidden", tr`hidden`],
];
const AXES = ["X", "Y", "Z"] as const;
/** A press that moved less is no turn of the picture, pixels. */
const STILL_PX = 4;
/** A corner of a body attracts a point within so many pixels. */
const SNAP_PX = 12;

/** What a press in the picture met. */
interface Hit {
  body: string;
  /** In the machine frame, mm. */
  point: Vector3;
}

export class SceneTools {
  readonly element: HTMLElement;
  /** A body was pressed. */
  onPick: ((body: string) => void) | null = null;
  private readonly view: MachineView;
  private readonly bodies: Bodies;
  private readonly overlay: Overlay;
  private readonly list = h("div", { class: "scene-bodies" });
  private readonly measure = h(
    "button",
    {
      type: "button",
      ariaPressed: "false",
      dataTest: "measure-distance",
      onclick: () => this.setMeasuring(!this.measuring),
    },
    tr`Distance of two points`,
  );
  private readonly result = h("output", { class: "scene-distance", dataTest: "distance" });
  private readonly axis = h(
    "select",
    { ariaLabel: tr`Section across`, dataTest: "section", onchange: () => this.section() },
    h("option", { value: "" }, tr`no section`),
    AXES.map((name) => h("option", { value: name }, tr`section across ${name}`)),
  );
  private readonly place = h("input", {
    type: "range",
    min: "0",
    max: "1000",
    value: "500",
    ariaLabel: tr`Place of the section`,
    oninput: () => this.section(),
  });
  private readonly other = h("input", { type: "checkbox", onchange: () => this.section() });
  private readonly views = new SavedViews({
    capture: () => this.capture(),
    apply: (parts) => this.apply(parts),
  });
  private measuring = false;
  private points: Vector3[] = [];
  private line: Line | null = null;
  /** What is cut away lies below it. */
  private plane: Plane | null = null;

  constructor(view: MachineView, bodies: Bodies, overlay: Overlay) {
    this.view = view;
    this.bodies = bodies;
    this.overlay = overlay;
    const details = h(
      "details",
      { class: "scene-panel" },
      h("summary", {}, tr`Bodies, section, distance, views`),
      this.list,
      h("div", { class: "row" }, this.axis, this.place, h("label", { class: "check" }, this.other, tr`other side`)),
      h("div", { class: "row" }, this.measure, this.result),
      this.views.element,
    );
    details.addEventListener("toggle", () => details.open && this.draw());
    this.element = details;
    this.place.disabled = true;
    // A picture without bodies has none of this.
    this.element.hidden = true;
  }

  /** Another machine is shown; saved views are kept by what it is. */
  clear(machine: string): void {
    this.element.hidden = this.bodies.names.length === 0;
    this.setMeasuring(false);
    this.axis.value = "";
    this.section();
    this.draw();
    this.views.show(machine);
  }

  // ---- saved views ----

  private capture(): ViewParts {
    return {
      camera: this.view.viewWords(),
      section: { axis: this.axis.value, place: this.place.value, other: this.other.checked },
      looks: Object.fromEntries(this.bodies.names.map((name) => [name, this.bodies.lookOf(name)])),
    };
  }

  private apply({ camera, section, looks }: ViewParts): void {
    this.axis.value = AXES.some((name) => name === section.axis) ? section.axis : "";
    this.place.value = section.place;
    this.other.checked = section.other;
    for (const name of this.bodies.names) {
      const look = LOOKS.find(([known]) => known === looks[name])?.[0];
      if (look) this.bodies.setLook(name, look);
    }
    this.section();
    this.draw();
    this.view.setView(camera);
    this.view.onView(camera);
  }

  /** Presses on the picture that do not turn it. */
  attach(canvas: HTMLCanvasElement): void {
    let down: [number, number] | null = null;
    canvas.addEventListener("pointerdown", (event) => {
      down = event.button === 0 && event.isPrimary ? [event.clientX, event.clientY] : null;
    });
    canvas.addEventListener("pointerup", (event) => {
      const from = down;
      down = null;
      if (!from || Math.hypot(event.clientX - from[0], event.clientY - from[1]) > STILL_PX) return;
      this.press(event.clientX, event.clientY);
    });
    canvas.addEventListener("keydown", (event) => event.key === "Escape" && this.setMeasuring(false));
  }

  private press(x: number, y: number): void {
    if (!this.measuring && !this.onPick) return;
    const hit = this.hitAt(x, y);
    if (!hit) return;
    if (this.measuring) this.addPoint(hit.point);
    else this.onPick?.(hit.body);
  }

  private hitAt(x: number, y: number): Hit | null {
    const { box, camera } = this.view.seen();
    const at = new Vector2((2 * (x - box.left)) / box.width - 1, 1 - (2 * (y - box.top)) / box.height);
    const ray = new Raycaster();
    ray.setFromCamera(at, camera);
    const solids = this.bodies.solids().filter((solid) => solid.visible);
    const met = ray.intersectObjects(solids, false);
    const hit = met.find(({ point }) => !this.plane || this.plane.distanceToPoint(point) >= 0);
    const body = hit && this.bodies.ownerOf(hit.object);
    if (!hit || !body) return null;
    const corners = (hit.face ? [hit.face.a, hit.face.b, hit.face.c] : []).map((index) =>
      new Vector3()
        .fromBufferAttribute((hit.object as Mesh).geometry.getAttribute("position") as never, index)
        .applyMatrix4(hit.object.matrixWorld),
    );
    const pixels = (point: Vector3): number => {
      const p = point.clone().project(camera);
      return Math.hypot(((p.x - at.x) * box.width) / 2, ((p.y - at.y) * box.height) / 2);
    };
    const seen = (corner: Vector3): boolean => !this.plane || this.plane.distanceToPoint(corner) >= 0;
    const near = corners
      .filter((corner) => seen(corner) && pixels(corner) < SNAP_PX)
      .sort((a, b) => pixels(a) - pixels(b));
    return { body, point: near[0] ?? hit.point };
  }

  // ---- distance ----

  private setMeasuring(on: boolean): void {
    this.measuring = on;
    this.measure.setAttribute("aria-pressed", String(on));
    this.points = [];
    this.drawLine();
    this.result.textContent = on ? tr`Press on two points; a corner attracts. Esc ends.` : "";
  }

  private addPoint(point: Vector3): void {
    if (this.points.length === 2) this.points = [];
    this.points.push(point);
    this.drawLine();
    const [from, to] = this.points;
    if (!from || !to) {
      this.result.textContent = tr`the second point …`;
      return;
    }
    const by = to.clone().sub(from);
    const parts = AXES.map((name, i) => `Δ${name} ${fixed(by.getComponent(i), 3)}`).join(", ");
    this.result.textContent = tr`${fixed(by.length(), 3)}${NARROW_SPACE}mm (${parts}; machine frame)`;
  }

  private drawLine(): void {
    this.line?.removeFromParent();
    this.line?.geometry.dispose();
    (this.line?.material as LineBasicMaterial | undefined)?.dispose();
    this.line = null;
    const [from, to] = this.points;
    for (const [i, key] of ["from", "to"].entries()) {
      const point = this.points[i];
      this.overlay.label(`measured ${key}`, point ? "✕" : null, () => point?.clone() ?? new Vector3(), "measured");
    }
    if (from && to) {
      const material = new LineBasicMaterial({ color: cssColour("--scene-arrow"), depthTest: false });
      this.line = new Line(new BufferGeometry().setFromPoints([from, to]), material);
      this.line.renderOrder = 20;
    }
    this.view.showLine(this.line);
  }

  // ---- section ----

  private section(): void {
    const i = AXES.indexOf(this.axis.value as (typeof AXES)[number]);
    this.place.disabled = this.other.disabled = i < 0;
    this.plane = null;
    if (i >= 0) {
      const { min, max } = this.view.extent();
      const share = Number(this.place.value) / 1000;
      const at = min.getComponent(i) + share * (max.getComponent(i) - min.getComponent(i));
      const sign = this.other.checked ? -1 : 1;
      this.plane = new Plane(new Vector3().setComponent(i, sign), -sign * at);
      const text = `${this.axis.value} = ${fixed(at, 1)} mm`;
      this.place.setAttribute("aria-valuetext", text);
      this.place.title = text;
    }
    this.view.cut(this.plane);
  }

  // ---- bodies ----

  private draw(): void {
    fill(
      this.list,
      this.bodies.names.map((name) => {
        const look = h(
          "select",
          {
            ariaLabel: tr`How ${titleOf(name)} is drawn`,
            dataBody: name,
            onchange: () => {
              this.bodies.setLook(name, look.value as Look);
              this.view.requestRender();
            },
          },
          LOOKS.map(([value, text]) => h("option", { value }, text)),
        );
        look.value = this.bodies.lookOf(name);
        return h("label", { class: "scene-body" }, h("span", {}, titleOf(name)), look);
      }),
    );
  }
}

function titleOf(name: string): string {
  return { b: tr`bed`, w: tr`workpiece`, t: tr`tool` }[name] ?? tr`axis ${name}`;
}
