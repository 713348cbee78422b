/** How much the deviations are drawn larger than they are: ×1 … ×50 000 on a slider, by its logarithm. */

import { h } from "../../dom.ts";
import { factor } from "../../format.ts";
import type { MachineView } from "../../scene/view.ts";

const MOST = 50_000;

/** A slider of 0 … 100 to a factor of two digits. */
function factorOf(slider: number): number {
  const k = Math.exp((slider / 100) * Math.log(MOST));
  const power = 10 ** Math.floor(Math.log10(k) - 1 + 1e-9);
  return Math.max(1, power < 1 ? Math.round(k) : Math.round(k / power) * power);
}

const sliderOf = (k: number): number => (100 * Math.log(k)) / Math.log(MOST);

/** The controls below the picture. */
export function exaggerationBar(view: MachineView): HTMLElement {
  const text = h("output", { class: "factor" });
  const ghost = h("input", { type: "checkbox", checked: true, onchange: () => view.setGhostVisible(ghost.checked) });
  const slider = h("input", { type: "range", min: "0", max: "100", step: "0.5", class: "exaggeration", ariaLabel: "Exaggeration of the deviations", oninput: () => set(factorOf(Number(slider.value))) });
  const set = (k: number): void => {
    slider.value = String(sliderOf(k));
    slider.setAttribute("aria-valuetext", factor(k));
    text.textContent = factor(k);
    view.setExaggeration(k);
  };
  set(1000);
  return h("div", { class: "scene-bottom" }, h("div", { class: "scene-control" }, h("label", { class: "check" }, ghost, "actual machine"), slider, text));
}
