/** The residuals of the readings at every place, before and after: arrows to turn and to magnify. */

import { tr } from "../../words/index.ts";
import { fill, h } from "../../dom.ts";
import { fairMagnification, vectors, type Figure, type VectorSpec } from "../../figure/index.ts";
import { factor } from "../../format.ts";
import type { Frame } from "../../frame.ts";

/** ×10 … ×1 000 000 on a slider of 0 … 100. */
const [LEAST, MOST] = [10, 1e6];
const factorOf = (slider: number): number => {
  const k = LEAST * (MOST / LEAST) ** (slider / 100);
  const power = 10 ** Math.floor(Math.log10(k) - 1 + 1e-9);
  return Math.round(k / power) * power;
};
const sliderOf = (k: number): number => (100 * Math.log(k / LEAST)) / Math.log(MOST / LEAST);

const SIDES: readonly [string, number, number, string][] = [
  ["3-D", -60, 24, tr`From the front, left, above`],
  ["XY", -90, 90, tr`From above`],
  ["XZ", -90, 0, tr`From the front`],
  ["YZ", 0, 0, tr`From the right`],
];

export class Residuals {
  private readonly slider: HTMLInputElement;
  private readonly factor_text = h("output", { class: "factor" });
  private readonly before = h("input", { type: "checkbox", checked: true, onchange: () => this.draw() });
  private readonly after = h("input", { type: "checkbox", checked: true, onchange: () => this.draw() });
  private readonly sides: HTMLElement;
  private readonly panel = h("section", { class: "panel vectors" });
  private readonly drawing = h("div");
  private figure: Figure<VectorSpec> | null = null;
  private spec: VectorSpec | null = null;
  private sets: VectorSpec["sets"] = [];

  constructor(host: HTMLElement) {
    this.slider = h("input", {
      type: "range",
      min: "0",
      max: "100",
      step: "0.5",
      class: "exaggeration",
      ariaLabel: tr`Magnification of the residuals`,
      oninput: () => this.turn({ magnification: factorOf(Number(this.slider.value)) }),
    });
    this.sides = h(
      "div",
      { class: "group", role: "group", ariaLabel: tr`View` },
      SIDES.map(([name, azimuth, elevation, title]) =>
        h("button", { title, onclick: () => this.turn({ azimuth, elevation }) }, name),
      ),
    );
    const check = (box: HTMLInputElement, text: string): HTMLElement => h("label", { class: "check" }, box, text);
    fill(
      this.panel,
      h(
        "div",
        { class: "vectors-tools" },
        this.sides,
        check(this.before, tr`before`),
        check(this.after, tr`after`),
        this.slider,
        this.factor_text,
      ),
      this.drawing,
    );
    host.append(this.panel);
    this.drawing.addEventListener("pointerdown", (down) => this.drag(down));
    this.drawing.addEventListener("keydown", (event) => this.key(event));
  }

  show(frame: Frame<unknown>): void {
    const at_mm = frame.f64("at_mm");
    this.panel.hidden = at_mm.length === 0;
    this.sets = [
      { name: tr`before: without the errors found`, um: frame.f32("before_um"), colour: "var(--series-2)" },
      { name: tr`after: residual`, um: frame.f32("after_um"), colour: "var(--series-1)" },
    ];
    const [, azimuth, elevation] = SIDES[0] as (typeof SIDES)[number];
    const kept = this.spec ?? { azimuth, elevation };
    this.turn({
      title: tr`Residuals where the machine stood`,
      at_mm,
      sets: this.sets,
      azimuth: kept.azimuth,
      elevation: kept.elevation,
      magnification: fairMagnification(at_mm, frame.f32("before_um")),
    });
  }

  clear(): void {
    this.panel.hidden = true;
  }

  private turn(change: Partial<VectorSpec>): void {
    this.spec = { ...(this.spec as VectorSpec), ...change };
    this.slider.value = String(sliderOf(this.spec.magnification));
    this.factor_text.textContent = factor(this.spec.magnification);
    this.slider.setAttribute("aria-valuetext", factor(this.spec.magnification));
    SIDES.forEach(([, azimuth, elevation], i) =>
      this.sides.children[i]?.setAttribute(
        "aria-pressed",
        String(this.spec?.azimuth === azimuth && this.spec.elevation === elevation),
      ),
    );
    this.draw();
  }

  private draw(): void {
    if (!this.spec) return;
    const shown = { ...this.spec, sets: this.sets.filter((_, i) => (i === 0 ? this.before : this.after).checked) };
    if (this.figure) this.figure.update(shown);
    else this.figure = vectors(this.drawing, shown);
  }

  private drag(down: PointerEvent): void {
    const from = this.spec;
    if (!from || !(down.target as Element).closest("svg")) return;
    const move = (event: PointerEvent): void =>
      this.turn({
        azimuth: from.azimuth - 0.5 * (event.clientX - down.clientX),
        elevation: Math.max(-90, Math.min(90, from.elevation + 0.5 * (event.clientY - down.clientY))),
      });
    window.addEventListener("pointermove", move);
    window.addEventListener("pointerup", () => window.removeEventListener("pointermove", move), { once: true });
  }

  private key(event: KeyboardEvent): void {
    const step = (
      { ArrowLeft: [-6, 0], ArrowRight: [6, 0], ArrowUp: [0, 6], ArrowDown: [0, -6] } as Record<
        string,
        [number, number]
      >
    )[event.key];
    if (!step || !this.spec) return;
    event.preventDefault();
    this.turn({
      azimuth: this.spec.azimuth + step[0],
      elevation: Math.max(-90, Math.min(90, this.spec.elevation + step[1])),
    });
  }
}
