/** Every axis with its travel, a slider and a field for its position. */

import { tr } from "../../words/index.ts";
import type { Link } from "../../api.ts";
import { fill, h } from "../../dom.ts";
import { travelText } from "../../figure/chain.ts";
import { digitsOfStep } from "../../format.ts";

export type Positions = Record<string, number>;

/** "X=10,C=45" of the address. */
export function positionsOf(text: string): Positions {
  const pairs = text.split(/[ ,]+/).map((part) => part.split("="));
  return Object.fromEntries(
    pairs.filter(([, value]) => value && Number.isFinite(Number(value))).map(([name, value]) => [name, Number(value)]),
  );
}

/** The positions for the address; null where all axes stand where they begin. */
export function positionsText(at: Positions, links: readonly Link[]): string | null {
  const moved = Object.entries(startPositions(links)).some(([name, value]) => (at[name] ?? value) !== value);
  if (!moved) return null;
  return Object.entries(at)
    .map(([name, value]) => `${name}=${value}`)
    .join(",");
}

/** 0, or the end of the travel next to it. */
function startPositions(links: readonly Link[]): Positions {
  const positions: Positions = {};
  for (const link of links) {
    if (link.kind !== "linear" && link.kind !== "rotary") continue;
    const [from, to] = Array.isArray(link.travel) ? link.travel : [-Infinity, Infinity];
    positions[link.name] = Math.min(to, Math.max(from, 0));
  }
  return positions;
}

/** Where the positions of axes that stay are kept. */
export function keptPositions(links: readonly Link[], before: Positions): Positions {
  const fresh = startPositions(links);
  return Object.fromEntries(Object.entries(fresh).map(([name, value]) => [name, before[name] ?? value]));
}

export interface AxesActions {
  moved(at: Positions): void;
  hovered(name: string | null): void;
}

export class Axes {
  readonly element = h("section", { class: "panel" });
  at: Positions = {};
  private readonly actions: AxesActions;

  constructor(actions: AxesActions) {
    this.actions = actions;
  }

  show(links: readonly Link[], at: Positions): void {
    this.at = { ...at };
    const rows = links.filter((l) => l.kind === "linear" || l.kind === "rotary").map((link) => this.row(link));
    const home = h("button", { onclick: () => this.home(links) }, tr`All to 0`);
    const heads = h(
      "tr",
      {},
      h("th", {}, tr`Axis`),
      h("th", {}, tr`Travel`),
      h("th", {}, h("span", { class: "visually-hidden" }, tr`Slider`)),
      h("th", { class: "number" }, tr`Position`),
    );
    fill(
      this.element,
      h("div", { class: "panel-head" }, h("h2", {}, tr`Axes`), home),
      h("table", { class: "axes" }, h("thead", {}, heads), h("tbody", {}, rows)),
    );
  }

  private home(links: readonly Link[]): void {
    this.show(links, startPositions(links));
    this.actions.moved({ ...this.at });
  }

  private move(name: string, value: number): void {
    this.at[name] = value;
    this.actions.moved({ ...this.at });
  }

  private row(link: Link): HTMLElement {
    const [from, to] = Array.isArray(link.travel) ? link.travel : link.kind === "rotary" ? [-360, 360] : [-500, 500];
    const [unit, spoken] = link.kind === "linear" ? ["mm", tr`millimetres`] : ["°", tr`degrees`];
    const step = to - from > 2000 ? 1 : to - from > 100 ? 0.1 : 0.01;
    const name = `${link.name}${link.carries === "workpiece" ? "\u2032" : ""}`;
    const value = this.at[link.name] ?? 0;
    const slider = h("input", {
      type: "range",
      min: from,
      max: to,
      step,
      value: String(value),
      dataAxis: link.name,
      ariaLabel: tr`Axis ${name}, ${spoken}`,
    });
    const box = h("input", {
      type: "number",
      step: "any",
      value: String(value),
      class: "position",
      dataPosition: link.name,
      ariaLabel: tr`Position of ${name} in ${spoken}`,
    });
    const travel = h("td", { class: "muted travel" });
    // The machine cannot go there, but the numbers are computed all the same.
    const judge = (q: number): void => {
      const outside = Array.isArray(link.travel) && (q < from || q > to);
      travel.classList.toggle("outside", outside);
      travel.textContent = outside ? tr`outside ${travelText(link)}` : travelText(link);
      if (outside) box.setAttribute("aria-invalid", "true");
      else box.removeAttribute("aria-invalid");
    };
    judge(value);
    slider.addEventListener("input", () => {
      box.value = Number(slider.value).toFixed(digitsOfStep(step));
      judge(Number(slider.value));
      this.move(link.name, Number(slider.value));
    });
    box.addEventListener("change", () => {
      const typed = Number(box.value);
      if (box.value.trim() === "" || !Number.isFinite(typed)) {
        box.value = String(this.at[link.name] ?? 0);
        return;
      }
      slider.value = box.value;
      judge(typed);
      this.move(link.name, typed);
    });
    const row = h(
      "tr",
      {},
      h("td", { class: "axis-name" }, name),
      travel,
      h("td", { class: "axis-slider" }, slider),
      h("td", { class: "number" }, box, h("span", { class: "unit" }, unit)),
    );
    row.addEventListener("pointerenter", () => this.actions.hovered(link.name));
    row.addEventListener("pointerleave", () => this.actions.hovered(null));
    return row;
  }
}
