/** One error in the panel of changes: a switch, a factor to drag, a value to add. */

import { tr } from "../../words/index.ts";
import { h } from "../../dom.ts";
import { number } from "../../format.ts";
import { errorLink } from "../../glossary/glossary.ts";

export interface ErrorChange {
  factor?: number;
  add?: string;
}

export class ErrorRow {
  readonly name: string;
  readonly element: HTMLElement;
  private readonly unit: string;
  private readonly onchange: () => void;
  private readonly on: HTMLInputElement;
  private readonly slider: HTMLInputElement;
  private readonly box: HTMLInputElement;
  private readonly text = h("output", { class: "number" });

  constructor(name: string, unit: string, onchange: () => void) {
    this.name = name;
    this.unit = unit;
    this.onchange = onchange;
    this.on = h("input", {
      type: "checkbox",
      checked: true,
      ariaLabel: tr`${name} on`,
      onchange: () => this.changed(),
    });
    this.slider = h("input", {
      type: "range",
      min: "-2",
      max: "2",
      step: "0.05",
      value: "1",
      ariaLabel: tr`Factor of ${name}`,
      oninput: () => this.changed(true),
    });
    this.box = h("input", {
      type: "number",
      step: "any",
      value: "0",
      ariaLabel: unit === "µm" ? tr`Added to ${name}, micrometres` : tr`Added to ${name}, microradians`,
      oninput: () => this.changed(true),
    });
    this.element = h(
      "tr",
      { dataError: name },
      h("td", {}, this.on),
      h("td", { class: "axis-name" }, errorLink(name)),
      h("td", { class: "axis-slider" }, this.slider),
      h("td", { class: "number" }, this.text),
      h("td", { class: "number" }, this.box, h("span", { class: "unit" }, unit)),
    );
    this.show();
  }

  /** null: as in the file. */
  get change(): ErrorChange | null {
    if (!this.on.checked) return { factor: 0 };
    const times = Number(this.slider.value);
    const added = Number(this.box.value);
    if (times === 1 && added === 0) return null;
    return {
      ...(times === 1 ? {} : { factor: times }),
      ...(added === 0 ? {} : { add: `${added} ${this.unit === "µm" ? "um" : "urad"}` }),
    };
  }

  /** Dragging an error that is off switches it on again. */
  private changed(on = this.on.checked): void {
    this.on.checked = on;
    this.show();
    this.onchange();
  }

  private show(): void {
    const times = Number(this.slider.value);
    this.text.textContent = this.on.checked ? `×${number(times, 2)}` : tr`off`;
    this.element.classList.toggle("changed", this.change !== null);
  }

  /** For the address: "off", "x1.5", "a3", "x1.5a3"; "" as in the file. */
  get state(): string {
    if (!this.on.checked) return "off";
    const [times, added] = [Number(this.slider.value), Number(this.box.value)];
    return `${times === 1 ? "" : `x${times}`}${added === 0 ? "" : `a${added}`}`;
  }

  /** As an address says; without `onchange`. */
  take(words: string): void {
    const found = /^(?:x(-?[\d.]+))?(?:a(-?[\d.]+))?$/.exec(words);
    this.on.checked = words !== "off";
    this.slider.value = found?.[1] ?? "1";
    this.box.value = found?.[2] ?? "0";
    this.show();
  }

  switchOff(): void {
    this.changed(false);
  }

  add(value: number): void {
    this.box.value = String(Math.round(value * 1e4) / 1e4);
    this.changed(true);
  }

  reset(): void {
    this.on.checked = true;
    this.slider.value = "1";
    this.box.value = "0";
    this.show();
  }
}
