/** How much larger deviations are drawn: a slider ×1 … ×50 000 with the factor always printed, and the ghost on or off. */

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
export function exaggerationControl(view: MachineView, start = 1000): HTMLElement {
  const text = h("output", { class: "factor" });
  const slider = h("input", {
    type: "range",
    min: "0",
    max: "100",
    step: "0.5",
    class: "exaggeration",
    ariaLabel: "Exaggeration of the deviations",
    oninput: () => set(factorOf(Number(slider.value))),
  });
  const ghost = h("input", { type: "checkbox", checked: true, onchange: () => view.setGhostVisible(ghost.checked) });
  const set = (k: number): void => {
    slider.value = String(sliderOf(k));
    slider.setAttribute("aria-valuetext", factor(k));
    text.textContent = factor(k);
    view.setExaggeration(k);
  };
  set(start);
  return h("div", { class: "scene-control" }, h("label", { class: "check" }, ghost, "actual machine"), slider, text);
}
