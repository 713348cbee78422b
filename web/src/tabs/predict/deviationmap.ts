/** The part as it will be: each point of its surfaces with its deviation and what made it so. */

import { tr } from "../../words/index.ts";
import {
  Color,
  DoubleSide,
  DynamicDrawUsage,
  InstancedMesh,
  Matrix4,
  MeshBasicMaterial,
  PlaneGeometry,
  Quaternion,
  SRGBColorSpace,
  Vector3,
} from "three";
import { download, fill, h } from "../../dom.ts";
import { diverging, divergingDark } from "../../figure/colours.ts";
import { csvOf, finelyRounded, roundNumber } from "../../figure/figure.ts";
import { number } from "../../format.ts";
import type { Frame } from "../../frame.ts";
import { MachineView } from "../../scene/view.ts";
import { isDark, onTheme } from "../../theme.ts";
import { Magnifier } from "./magnifier.ts";
import type { DrawingHeader } from "./types.ts";

/** Errors that the server names for each point. */
const EFFECTS = 4;
/** Where the slider of the magnification stands at first, %. */
const AT_FIRST = 70;
/** Points are drawn with a gap, so that the shape is seen. */
const FILLED = 0.92;
/** A press that moves farther turns the picture. Unit: px. */
const STILL_PX = 4;

export class DeviationMap {
  private readonly view: MachineView;
  private readonly point = h("div", { class: "panel map-point", dataTest: "point", role: "status" });
  readonly magnifier = new Magnifier(AT_FIRST, () => this.magnified());
  private mesh: InstancedMesh | null = null;
  private frame: Frame<DrawingHeader> | null = null;
  /** The number of the feature of each point. */
  private owner = new Uint32Array();
  private marked: ReadonlySet<number> | null = null;
  /** The point that is explained. */
  private picked = 0;
  private range = 1;

  constructor(host: HTMLElement) {
    const scene = h("div", { class: "predict-scene" });
    host.append(scene, this.point);
    this.view = new MachineView(scene);
    const save = h(
      "button",
      {
        class: "figure-save",
        ariaLabel: tr`Save the deviations as CSV`,
        onclick: () => this.frame && download("deviations.csv", csv(this.frame, this.owner), "text/csv"),
      },
      "CSV",
    );
    scene.append(
      h(
        "div",
        { class: "scene-bottom" },
        h(
          "div",
          { class: "scene-control" },
          h(
            "span",
            { class: "group", role: "group", ariaLabel: tr`Points, the largest deviation first` },
            h(
              "button",
              {
                ariaLabel: tr`Larger deviation`,
                title: tr`The point before, of larger deviation`,
                onclick: () => this.step(-1),
              },
              "‹",
            ),
            h(
              "button",
              {
                ariaLabel: tr`Smaller deviation`,
                title: tr`The next point, of smaller deviation`,
                onclick: () => this.step(1),
              },
              "›",
            ),
          ),
          tr`deviations`,
          this.magnifier.slider,
          this.magnifier.text,
          save,
        ),
      ),
    );
    this.pickByPress();
    onTheme(() => this.colour());
  }

  show(frame: Frame<DrawingHeader>): void {
    const { features } = frame.header.document;
    this.frame = frame;
    this.marked = null;
    this.owner = Uint32Array.from(features.flatMap((f, i) => Array.from({ length: f.points }, () => i)));
    const deviations = frame.f32("deviation_um");
    const worst = this.worst();
    const most = Math.max(1e-6, Math.abs(deviations[worst] ?? 0));
    this.range = finelyRounded(most);
    // At the end of the slider the greatest deviation is a tenth of the part.
    this.build(deviations.length);
    this.magnifier.begin(Math.max(1, roundNumber((0.1 * extent(frame.f32("places_mm"))) / (most / 1e3))));
    // The camera is set when the part is there.
    this.view.setMachine({ links: [], models: [], tool: { length_mm: 0, diameter_mm: null } });
    this.pick(worst);
  }

  /** Shows some features in their full size, the others small, and picks their worst point. */
  mark(features: readonly number[]): void {
    this.marked = new Set(features);
    this.place();
    this.pick(this.worst());
  }

  /** The point of the marked features, or of all, with the greatest deviation. */
  private worst(): number {
    const deviations = this.frame?.f32("deviation_um") ?? new Float32Array();
    const size = (i: number): number =>
      this.marked === null || this.marked.has(this.owner[i] ?? 0) ? Math.abs(deviations[i] ?? 0) : -1;
    return deviations.reduce((w, _, i) => (size(i) > size(w) ? i : w), 0);
  }

  private build(count: number): void {
    this.mesh?.removeFromParent();
    this.mesh?.dispose();
    const material = new MeshBasicMaterial({ side: DoubleSide });
    this.mesh = new InstancedMesh(new PlaneGeometry(1, 1), material, count);
    this.mesh.instanceMatrix.setUsage(DynamicDrawUsage);
    this.mesh.frustumCulled = false;
    this.view.addToWorkpiece(this.mesh);
    this.colour();
  }

  private colour(): void {
    const { mesh, frame } = this;
    if (!mesh || !frame) return;
    const map = isDark() ? divergingDark : diverging;
    const colour = new Color();
    frame.f32("deviation_um").forEach((d, i) => {
      const [r, g, b] = map(0.5 + (0.5 * d) / this.range);
      mesh.setColorAt(i, colour.setRGB(r, g, b, SRGBColorSpace));
    });
    if (mesh.instanceColor) mesh.instanceColor.needsUpdate = true;
    this.view.showScale({ title: tr`deviation`, unit: "µm", range: [-this.range, this.range], map });
    this.view.requestRender();
  }

  private magnified(): void {
    this.view.overlay.note("factor", this.magnifier.words, "actual");
    this.view.overlay.note("sign", tr`positive: material is left; press a point for its causes`);
    this.place();
  }

  /** Where a point is drawn. */
  private at(i: number): Vector3 {
    const [places, normals] = [this.frame?.f32("places_mm"), this.frame?.f32("normals")];
    const off = (this.magnifier.k * (this.frame?.f32("deviation_um")[i] ?? 0)) / 1e3;
    const along = (k: number): number => (places?.[3 * i + k] ?? 0) + off * (normals?.[3 * i + k] ?? 0);
    return new Vector3(along(0), along(1), along(2));
  }

  private place(): void {
    const { mesh, frame } = this;
    if (!mesh || !frame) return;
    const normals = frame.f32("normals");
    const { features } = frame.header.document;
    const [front, normal] = [new Vector3(0, 0, 1), new Vector3()];
    const [turn, size, matrix] = [new Quaternion(), new Vector3(), new Matrix4()];
    for (let i = 0; i < mesh.count; i++) {
      const owner = this.owner[i] ?? 0;
      const small = this.marked !== null && !this.marked.has(owner) ? 0.35 : FILLED;
      turn.setFromUnitVectors(front, normal.fromArray(normals, 3 * i));
      size.setScalar(small * (features[owner]?.spacing_mm ?? 1));
      mesh.setMatrixAt(i, matrix.compose(this.at(i), turn, size));
    }
    mesh.instanceMatrix.needsUpdate = true;
    mesh.computeBoundingSphere();
    mesh.computeBoundingBox();
    this.view.requestRender();
  }

  private pickByPress(): void {
    const { element } = this.view;
    let from: [number, number] | null = null;
    element.addEventListener("pointerdown", (event) => (from = [event.clientX, event.clientY]));
    element.addEventListener("pointerup", (event) => {
      const still = from && Math.hypot(event.clientX - from[0], event.clientY - from[1]) < STILL_PX;
      from = null;
      const found = still && this.mesh ? this.view.instanceAt(this.mesh, event.clientX, event.clientY) : null;
      if (typeof found === "number") this.pick(found);
    });
  }

  /** The next point in the order of the deviations, of what is marked: the way to every point without a mouse. */
  private step(by: 1 | -1): void {
    const deviations = this.frame?.f32("deviation_um") ?? new Float32Array();
    const size = (i: number): number => Math.abs(deviations[i] ?? 0);
    const there = Array.from(deviations.keys()).filter(
      (i) => this.marked === null || this.marked.has(this.owner[i] ?? 0),
    );
    const order = there.sort((a, b) => size(b) - size(a) || a - b);
    const next = order[Math.max(0, Math.min(order.length - 1, order.indexOf(this.picked) + by))];
    if (next !== undefined) this.pick(next);
  }

  /** Says of a point how it is and why. */
  pick(i: number): void {
    const { frame } = this;
    if (!frame) return;
    this.picked = i;
    const { document, programs, error_names } = frame.header;
    const places = frame.f32("places_mm").subarray(3 * i, 3 * i + 3);
    const um = (name: string): string => number(frame.f32(name)[i] ?? 0, 2);
    const u32 = (name: string): number => frame.u32(name)[i] ?? 0;
    const feature = document.features[this.owner[i] ?? 0]?.name ?? "";
    const causes = Array.from({ length: EFFECTS }, (_, k) => EFFECTS * i + k).flatMap((at) => {
      const name = error_names[frame.u32("error")[at] ?? error_names.length];
      return name ? [`${name} ${number(frame.f32("part_um")[at] ?? 0, 2)}`] : [];
    });
    const program = programs[u32("program")] ?? "";
    fill(
      this.point,
      h("strong", { dataTest: "point-deviation" }, `${feature}: ${um("deviation_um")} µm`),
      h("span", {}, tr` at ${[...places].map((c, k) => `${"XYZ"[k]} ${c.toFixed(2)}`).join(" ")} mm; `),
      h("span", { class: "muted" }, tr`program alone ${um("by_program_um")} µm; `),
      h(
        "span",
        { dataTest: "block" },
        tr`T${u32("tool")}, ${program} line ${u32("line")}, ${number(frame.f32("time_s")[i] ?? 0, 1)} s. `,
      ),
      h(
        "span",
        { dataTest: "causes" },
        causes.length > 0 ? tr`Errors, in µm: ${causes.join(", ")}` : tr`No error moves it.`,
      ),
    );
    this.view.overlay.label("point", `${um("deviation_um")} µm`, () => this.at(i));
    this.view.requestRender();
  }
}

/** The diagonal of the box around places. */
function extent(places: Float32Array): number {
  const low = [Infinity, Infinity, Infinity];
  const high = [-Infinity, -Infinity, -Infinity];
  places.forEach((c, i) => {
    low[i % 3] = Math.min(low[i % 3] as number, c);
    high[i % 3] = Math.max(high[i % 3] as number, c);
  });
  return Math.hypot(...high.map((c, k) => c - (low[k] as number)));
}

function csv(frame: Frame<DrawingHeader>, owner: Uint32Array): string {
  const { features } = frame.header.document;
  const coordinate = (name: string, k: number): Float32Array => frame.f32(name).filter((_, i) => i % 3 === k);
  const axes = ["x", "y", "z"];
  return csvOf([
    { heading: "feature", values: Array.from(owner, (i) => features[i]?.name ?? "") },
    ...axes.map((axis, k) => ({ heading: `${axis}_mm`, values: coordinate("places_mm", k) })),
    ...axes.map((axis, k) => ({ heading: `n${axis}`, values: coordinate("normals", k) })),
    { heading: "deviation_um", values: frame.f32("deviation_um") },
    { heading: "by_program_um", values: frame.f32("by_program_um") },
    { heading: "tool", values: frame.u32("tool") },
    { heading: "line", values: frame.u32("line") },
    { heading: "time_s", values: frame.f32("time_s") },
  ]);
}
