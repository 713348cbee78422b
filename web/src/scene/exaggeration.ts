/** How much larger deviations are drawn: a slider ×1 … ×50 000 with the factor always printed, and the ghost on or off. */

import { tr } from "../words/index.ts";
import { h } from "../dom.ts";
import { factor } from "../format.ts";
import type { MachineView } from "./view.ts";

const MOST = 50_000;

/** The factor at 0 … 100 of the slider, with two significant digits. */
export function factorOf(slider: number): number {
  const k = Math.exp((slider / 100) * Math.log(MOST));
  const power = 10 ** Math.floor(Math.log10(k) - 1 + 1e-9);
  return Math.max(1, power < 1 ? Math.round(k) : Math.round(k / power) * power);
}

export const sliderOf = (k: number): number => (100 * Math.log(k)) / Math.log(MOST);

/** The control of one picture; it sets the picture at once. */
export class Exaggeration {
  readonly element: HTMLElement;
  private readonly view: MachineView;
  private readonly start: number;
  private k: number;
  private readonly text = h("output", { class: "factor" });
  private readonly slider: HTMLInputElement;
  private readonly ghost: HTMLInputElement;

  /** `changed`: the user moved it. */
  constructor(view: MachineView, changed: () => void = () => {}, start = 1000) {
    this.view = view;
    this.k = this.start = start;
    this.slider = h("input", {
      type: "range",
      min: "0",
      max: "100",
      step: "0.5",
      class: "exaggeration",
      ariaLabel: tr`Exaggeration of the deviations`,
      oninput: () => {
        this.set(factorOf(Number(this.slider.value)));
        changed();
      },
    });
    this.ghost = h("input", {
      type: "checkbox",
      checked: true,
      onchange: () => {
        view.setGhostVisible(this.ghost.checked);
        changed();
      },
    });
    this.element = h(
      "div",
      { class: "scene-control" },
      h("label", { class: "check" }, this.ghost, tr`actual machine`),
      this.slider,
      this.text,
    );
    this.set(start);
  }

  private set(k: number): void {
    this.k = k;
    this.slider.value = String(sliderOf(k));
    this.slider.setAttribute("aria-valuetext", factor(k));
    this.text.textContent = factor(k);
    this.view.setExaggeration(k);
  }

  /** For the address; what is as at the beginning is left out. */
  get state(): { k: string | null; actual: string | null } {
    return { k: this.k === this.start ? null : String(this.k), actual: this.ghost.checked ? null : "off" };
  }

  /** As an address says; what it does not name stays. */
  take({ k, actual }: Readonly<Record<string, string>>): void {
    const wanted = Number(k);
    if (wanted >= 1) this.set(Math.min(MOST, wanted));
    if (actual === undefined || (actual !== "off") === this.ghost.checked) return;
    this.ghost.checked = actual !== "off";
    this.view.setGhostVisible(this.ghost.checked);
  }
}
