/** The slider of the magnification of deviations: from 1 to the most that the picture takes, by its logarithm. */

import { tr } from "../../words/index.ts";
import { h } from "../../dom.ts";
import { roundNumber } from "../../figure/figure.ts";
import { factor } from "../../format.ts";

export class Magnifier {
  readonly slider: HTMLInputElement;
  readonly text = h("output", { class: "factor" });
  /** How much the deviations are magnified. */
  k = 1;
  private most = 1;
  private readonly at_first: number;
  private readonly round: (k: number) => number;
  private readonly changed: () => void;

  /** `at_first`: where the slider begins, %; `changed`: what is drawn again. */
  constructor(at_first: number, changed: () => void, round: (k: number) => number = roundNumber) {
    this.at_first = at_first;
    this.round = round;
    this.changed = changed;
    this.slider = h("input", {
      type: "range",
      min: "0",
      max: "100",
      step: "1",
      class: "exaggeration",
      ariaLabel: tr`Magnification of the deviations`,
      oninput: () => {
        this.apply();
        this.onMoved(this.state);
      },
    });
  }

  /** The user moved the slider. */
  onMoved: (state: string | null) => void = () => {};

  /** Begins with the most for another picture. */
  begin(most: number): void {
    this.most = most;
    this.slider.value = String(this.at_first);
    this.apply();
  }

  /** Where the slider stands, for the address; null where it began. */
  get state(): string | null {
    return Number(this.slider.value) === this.at_first ? null : this.slider.value;
  }

  /** As an address says. */
  take(state: string | undefined): void {
    if (state === undefined || state === this.slider.value || !(Number(state) >= 0)) return;
    this.slider.value = state;
    this.apply();
  }

  /** What a picture says of it. */
  get words(): string {
    return this.k === 1 ? tr`true size (×1)` : tr`deviations ${factor(this.k)}`;
  }

  private apply(): void {
    const at = Number(this.slider.value);
    this.k = at === 0 ? 1 : Math.max(1, this.round(this.most ** (at / 100)));
    this.text.textContent = factor(this.k);
    this.slider.setAttribute("aria-valuetext", factor(this.k));
    this.changed();
  }
}
