/** The test piece with its error map. */

import { tr } from "../../words/index.ts";
import {
  BufferAttribute,
  BufferGeometry,
  DoubleSide,
  LineBasicMaterial,
  LineLoop,
  LineSegments,
  Mesh,
  MeshBasicMaterial,
  Vector3,
} from "three";
import { download, h } from "../../dom.ts";
import { diverging, divergingDark } from "../../figure/colours.ts";
import { csvOf, finelyRounded, roundNumber } from "../../figure/figure.ts";
import { deg, number, um } from "../../format.ts";
import { MachineView } from "../../scene/view.ts";
import { cssColour, isDark, onTheme } from "../../theme.ts";
import { Magnifier } from "./magnifier.ts";
import { firstShown } from "./sections.ts";
import { partOf, type PieceFrame } from "./types.ts";

/** Rings drawn from one section to the next; between sections the error is drawn as running straight. */
const BETWEEN = 6;
/** Where the slider of the magnification stands, %. */
const AT_FIRST = 80;

interface Ring {
  nominal: Float32Array;
  moved: Float32Array;
  error: Float32Array;
}

export class PieceView {
  private readonly view: MachineView;
  readonly magnifier = new Magnifier(AT_FIRST, () => this.magnified(), roundTo2);
  private readonly outline = new LineSegments(new BufferGeometry(), new LineBasicMaterial());
  private readonly top = new Mesh(
    new BufferGeometry(),
    new MeshBasicMaterial({ side: DoubleSide, polygonOffset: true, polygonOffsetFactor: 2, polygonOffsetUnits: 2 }),
  );
  private readonly marked = new LineLoop(new BufferGeometry(), new LineBasicMaterial());
  private chosen = 0;
  private frame: PieceFrame | null = null;
  private range = 1;

  constructor(host: HTMLElement) {
    this.view = new MachineView(host);
    const save = h(
      "button",
      {
        class: "figure-save",
        ariaLabel: tr`Save the error map as CSV`,
        onclick: () => this.frame && download("error-map.csv", csv(this.frame), "text/csv"),
      },
      "CSV",
    );
    host.append(
      h(
        "div",
        { class: "scene-bottom" },
        h("div", { class: "scene-control" }, tr`deviations`, this.magnifier.slider, this.magnifier.text, save),
      ),
    );
    for (const object of [this.outline, this.top, this.marked]) object.frustumCulled = false;
    onTheme(() => this.draw());
  }

  /** `fresh`: another study; else the scale and the camera stay, so that changes can be compared. */
  show(frame: PieceFrame, fresh: boolean): void {
    const most = frame.f32("error_um").reduce((m, e) => Math.max(m, Math.abs(e)), 1e-6);
    this.frame = frame;
    if (fresh) {
      this.chosen = firstShown(frame.header.sections);
      const radius = Math.max(...frame.header.sections.map((s) => s.radius_mm));
      this.range = finelyRounded(most);
      // At the end of the slider the greatest error is about half of the radius.
      this.magnifier.begin(roundNumber((radius / (most / 1e3)) * 0.4));
    } else {
      if (most > this.range || most < 0.2 * this.range) this.range = finelyRounded(most);
      this.draw();
      return;
    }
    this.view.setMachine({ links: [], models: [], tool: { length_mm: 0, diameter_mm: null } });
    this.view.addToWorkpiece(this.outline);
    this.view.addToWorkpiece(this.top);
    this.view.addToWorkpiece(this.marked);
    this.magnified();
  }

  private magnified(): void {
    this.view.overlay.note("factor", this.magnifier.words, "actual");
    this.view.overlay.note("sign", tr`error positive: material left; lines: nominal`);
    this.draw();
  }

  private draw(): void {
    const { frame } = this;
    if (!frame) return;
    const rings = ringsOf(frame);
    const m = frame.header.sections[0]?.points ?? 0;
    const join = (pick: (ring: Ring) => Float32Array, width: number): Float32Array => {
      const all = new Float32Array(rings.length * m * width);
      rings.forEach((ring, i) => all.set(pick(ring), i * m * width));
      return all;
    };
    this.view.setExaggeration(this.magnifier.k);
    this.view.setSurface(
      {
        positions: join((r) => r.nominal, 3),
        displacements: join((r) => r.moved, 3),
        values: join((r) => r.error, 1),
        rings: rings.length,
        points_per_ring: m,
        closed: true,
        map: isDark() ? divergingDark : diverging,
        range: [-this.range, this.range],
      },
      { title: tr`error`, unit: "µm" },
    );
    this.drawOutline(rings, m);
    this.drawTop(rings, m);
    this.drawMarked();
    this.markWorst(frame);
    this.view.requestRender();
  }

  /** Where the part is worst. */
  private markWorst(frame: PieceFrame): void {
    const { sections } = frame.header;
    const errors = frame.f32("error_um");
    const worst = errors.reduce((w, e, i) => (Math.abs(e) > Math.abs(errors[w] ?? 0) ? i : w), 0);
    const azimuth = frame.f32("azimuth_rad")[worst] ?? 0;
    const section = sections.find((_, i) => worst < sections.slice(0, i + 1).reduce((sum, s) => sum + s.points, 0));
    if (!section) return;
    const radius = 1.05 * section.radius_mm;
    const at = new Vector3(radius * Math.cos(azimuth), radius * Math.sin(azimuth), section.z_mm);
    this.view.overlay.label(
      "worst",
      tr`greatest ${um(errors[worst])} at ${deg((azimuth * 180) / Math.PI, 0)}`,
      () => at.clone(),
      "faint",
    );
  }

  /** Nominal circles of the sections and lines along the cone. */
  private drawOutline(rings: readonly Ring[], m: number): void {
    const lines: number[] = [];
    const point = (ring: Ring, j: number): number[] => [...ring.nominal.subarray(3 * (j % m), 3 * (j % m) + 3)];
    rings.forEach((ring, i) => {
      if (i % BETWEEN === 0) for (let j = 0; j < m; j++) lines.push(...point(ring, j), ...point(ring, j + 1));
    });
    const [first, last] = [rings[0], rings.at(-1)];
    if (first && last)
      for (let j = 0; j < m; j += Math.max(1, Math.round(m / 12))) lines.push(...point(first, j), ...point(last, j));
    this.outline.geometry.setAttribute("position", new BufferAttribute(Float32Array.from(lines), 3));
    this.outline.material.color.set(cssColour("--nominal"));
  }

  /** The section that the polar plot shows. */
  mark(index: number): void {
    this.chosen = index;
    this.drawMarked();
    this.view.requestRender();
  }

  private drawMarked(): void {
    const section = this.frame?.header.sections[this.chosen];
    const ring = this.frame ? ringsOf(this.frame)[this.chosen * BETWEEN] : undefined;
    if (!section || !ring) return;
    // A little outside, so that the surface does not hide it.
    const points = ring.nominal.map((v, i) =>
      i % 3 === 2 ? v : 1.004 * (v + this.magnifier.k * (ring.moved[i] as number)),
    );
    this.marked.geometry.setAttribute("position", new BufferAttribute(points, 3));
    this.marked.material.color.set(cssColour("--actual"));
    // In front, as the first view sees it.
    const front = new Vector3(-0.527 * section.radius_mm, -0.85 * section.radius_mm, section.z_mm);
    this.view.overlay.label("section", tr`section ${this.chosen + 1}, z = ${number(section.z_mm, 0)} mm`, () =>
      front.clone(),
    );
  }

  /** The face on top, so that the piece is not seen as hollow. */
  private drawTop(rings: readonly Ring[], m: number): void {
    const last = rings.at(-1);
    if (!last) return;
    const points = new Float32Array(3 * (m + 1));
    for (let i = 0; i < 3 * m; i++)
      points[i] = (last.nominal[i] as number) + this.magnifier.k * (last.moved[i] as number);
    for (let i = 0; i < 3 * m; i++)
      points[3 * m + (i % 3)] = (points[3 * m + (i % 3)] as number) + (points[i] as number) / m;
    this.top.geometry.setAttribute("position", new BufferAttribute(points, 3));
    this.top.geometry.setIndex(Array.from({ length: m }, (_, j) => [j, (j + 1) % m, m]).flat());
    this.top.material.color.set(cssColour("--scene-linear"));
  }
}

const roundTo2 = (k: number): number => {
  const power = 10 ** Math.max(0, Math.floor(Math.log10(k)) - 1);
  return Math.round(k / power) * power;
};

function ringsOf(frame: PieceFrame): Ring[] {
  const { sections } = frame.header;
  const of = sections.map((section, i): Ring => {
    const azimuth = partOf(frame.f32("azimuth_rad"), sections, i);
    const profile = partOf(frame.f64("profile_mm"), sections, i, 2);
    const nominal = new Float32Array(3 * section.points);
    const moved = new Float32Array(3 * section.points);
    azimuth.forEach((a, j) => {
      const at = [section.radius_mm * Math.cos(a), section.radius_mm * Math.sin(a)] as const;
      nominal.set([at[0], at[1], section.z_mm], 3 * j);
      moved.set([(profile[2 * j] as number) - at[0], (profile[2 * j + 1] as number) - at[1], 0], 3 * j);
    });
    return { nominal, moved, error: partOf(frame.f32("error_um"), sections, i) };
  });
  const mix = (a: Float32Array, b: Float32Array, t: number): Float32Array =>
    a.map((v, i) => v + t * ((b[i] as number) - v));
  return of.flatMap((ring, i) => {
    const next = of[i + 1];
    if (!next) return [ring];
    return Array.from({ length: BETWEEN }, (_, j) => ({
      nominal: mix(ring.nominal, next.nominal, j / BETWEEN),
      moved: mix(ring.moved, next.moved, j / BETWEEN),
      error: mix(ring.error, next.error, j / BETWEEN),
    }));
  });
}

function csv(frame: PieceFrame): string {
  const { sections } = frame.header;
  const each = <T>(pick: (section: (typeof sections)[number], i: number) => T): T[] =>
    sections.flatMap((section, i) => Array.from({ length: section.points }, () => pick(section, i)));
  const profile = frame.f64("profile_mm");
  const azimuth = frame.f32("azimuth_rad");
  return csvOf([
    { heading: "position", values: each((_, i) => i + 1) },
    { heading: "z (mm)", values: each((section) => section.z_mm) },
    { heading: "azimuth (deg)", values: Array.from(azimuth, (a) => (a * 180) / Math.PI) },
    { heading: "error (um)", values: frame.f32("error_um") },
    { heading: "x (mm)", values: Array.from(azimuth, (_, j) => profile[2 * j] as number) },
    { heading: "y (mm)", values: Array.from(azimuth, (_, j) => profile[2 * j + 1] as number) },
  ]);
}
