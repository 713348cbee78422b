/** One section of the test piece, magnified, with the circle that is fitted to it. */

import { tr, trText } from "../../words/index.ts";
import { fill, h } from "../../dom.ts";
import type { Figure } from "../../figure/figure.ts";
import { polar, type PolarCircle, type PolarSeries, type PolarSpec } from "../../figure/polar.ts";
import { mm, number, um } from "../../format.ts";
import { partOf, type FittedCircle, type PieceFrame, type Section } from "./types.ts";

/** The answer's names, with the letters of ISO 12181-1 and a colour of its own for each. */
const FITS: readonly [string, string, string][] = [
  ["minimum zone", "MZC", "var(--series-3)"],
  ["least squares", "LSC", "var(--series-2)"],
  ["maximum inscribed", "MIC", "var(--series-4)"],
  ["minimum circumscribed", "MCC", "var(--series-5)"],
];

export class Sections {
  private readonly position = h("select", { ariaLabel: tr`Section of the test piece`, onchange: () => this.draw() });
  private readonly fit = h(
    "select",
    { ariaLabel: tr`Fitted circle`, onchange: () => this.draw() },
    FITS.map(([name, letters]) => h("option", { value: name }, `${trText(name)} (${letters})`)),
    h("option", { value: "all" }, tr`all four`),
  );
  private readonly centred = h("input", { type: "checkbox", onchange: () => this.draw() });
  private readonly place = h("div", { class: "predict-polar" });
  private readonly words = h("p", { class: "fit-words", dataTest: "fit" });
  private frame: PieceFrame | null = null;
  private before: PieceFrame | null = null;
  private figure: Figure<PolarSpec> | null = null;

  /** `onpick`: another section is shown now. */
  constructor(host: HTMLElement, onpick: (index: number) => void) {
    this.position.addEventListener("change", () => onpick(Number(this.position.value)));
    host.append(
      h(
        "div",
        { class: "panel-head" },
        h("h2", {}, tr`Section`),
        this.position,
        this.fit,
        h(
          "label",
          { class: "check", title: tr`Deviations from the fitted circle: the form, without eccentricity and size` },
          this.centred,
          tr`from this circle`,
        ),
      ),
      this.words,
      this.place,
    );
  }

  show(frame: PieceFrame, before: PieceFrame | null, fresh: boolean): void {
    this.frame = frame;
    this.before = before;
    if (fresh) {
      const { sections } = frame.header;
      fill(
        this.position,
        sections.map((section, i) =>
          h("option", { value: String(i) }, tr`position ${i + 1}, z = ${number(section.z_mm, 0)} mm`),
        ),
      );
      this.position.value = String(firstShown(sections));
    }
    this.draw();
  }

  private draw(): void {
    const { frame } = this;
    const index = Number(this.position.value);
    const section = frame?.header.sections[index];
    if (!frame || !section) return;
    const fit = this.fit.value;
    this.centred.disabled = fit === "all";
    const about = this.centred.checked && fit !== "all" ? fit : null;
    const series = [profile(frame, index, about, this.before ? tr`with the changes` : tr`profile`, "var(--series-1)")];
    if (this.before)
      series.push({ ...profile(this.before, index, about, tr`as in the file`, "var(--muted)"), dash: "3 3" });
    const chosen = section.circles.filter((c) => fit === "all" || c.name === fit);
    const spec: PolarSpec = {
      title: tr`z = ${number(section.z_mm, 0)} mm, radius ${mm(section.radius_mm, 3)}`,
      unit: "µm",
      radius_mm: section.radius_mm,
      series,
      circles: chosen.flatMap((c) => circlesOf(c, section, about !== null)),
      axes: ["X", "Y"],
      height: Math.max(220, Math.min(350, 0.34 * innerHeight)),
    };
    if (this.figure) this.figure.update(spec);
    else this.figure = polar(this.place, spec);
    fill(
      this.words,
      chosen.map((c, i) => [i > 0 ? h("br") : null, wordsOf(c)]),
    );
  }
}

/** The second from below, where there is one: the test pieces judge roundness there. */
export const firstShown = (sections: readonly Section[]): number => Math.min(1, sections.length - 1);

/** The points of a section as deviations from the nominal circle, or from that of a fit. */
function profile(frame: PieceFrame, index: number, about: string | null, name: string, colour: string): PolarSeries {
  const { sections } = frame.header;
  const fit = sections[index]?.circles.find((c) => c.name === about);
  const [cx, cy] = fit?.centre_mm ?? [0, 0];
  const radius = (fit ?? sections[index])?.radius_mm ?? 0;
  const points = partOf(frame.f64("profile_mm"), sections, index, 2);
  const n = points.length / 2;
  const at = (j: number): [number, number] => [(points[2 * j] as number) - cx, (points[2 * j + 1] as number) - cy];
  return {
    name,
    colour,
    closed: true,
    angle_rad: Float64Array.from({ length: n }, (_, j) => Math.atan2(at(j)[1], at(j)[0])),
    deviation: Float64Array.from({ length: n }, (_, j) => 1e3 * (Math.hypot(...at(j)) - radius)),
  };
}

/** The zone has two circles; the others one. */
function circlesOf(fit: FittedCircle, section: Section, centred: boolean): PolarCircle[] {
  const from_mm = centred ? fit.radius_mm : section.radius_mm;
  const [, letters = "", colour = ""] = FITS.find(([name]) => name === fit.name) ?? [];
  const circle = (radius_mm: number, name: string, dash?: string): PolarCircle => ({
    name,
    colour,
    x: centred ? 0 : 1e3 * fit.centre_mm[0],
    y: centred ? 0 : 1e3 * fit.centre_mm[1],
    radius: 1e3 * (radius_mm - from_mm),
    ...(dash ? { dash } : {}),
  });
  if (fit.name === "minimum zone")
    return [circle(fit.inner_mm, tr`${letters} inner`, "2 2"), circle(fit.outer_mm, tr`${letters} outer`)];
  if (fit.name === "maximum inscribed") return [circle(fit.inner_mm, letters)];
  if (fit.name === "minimum circumscribed") return [circle(fit.outer_mm, letters)];
  return [circle(fit.radius_mm, letters)];
}

function wordsOf(fit: FittedCircle): string {
  const [x, y] = fit.centre_mm;
  return tr`${trText(fit.name)}: roundness ${um(1e3 * (fit.outer_mm - fit.inner_mm))}, centre X ${um(1e3 * x)}, Y ${um(1e3 * y)}`;
}
