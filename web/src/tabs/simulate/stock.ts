/** The stock in the picture: as the program leaves it, or as it is at the time that is shown. */

import { h } from "../../dom.ts";
import { withUnit } from "../../format.ts";
import type { Frame } from "../../frame.ts";
import { modelsOf } from "../../scene/models.ts";
import type { MachineView } from "../../scene/view.ts";
import { tr } from "../../words/index.ts";
import type { Simulation, StockHeader } from "./answers.ts";

export class StockInTime {
  readonly control: HTMLElement;
  private readonly view: MachineView;
  private readonly removed = h("output", { class: "number", dataTest: "stock-removed" });
  private readonly box: HTMLInputElement;
  private simulation: Simulation | null = null;
  private time_s = 0;
  /** The question under way: the stock at one time after the other, until it is that of the time shown. */
  private asking: AbortController | null = null;
  private readonly failed: (error: unknown) => void;

  /** `changed`: the user chose the other. */
  constructor(view: MachineView, failed: (error: unknown) => void, changed: () => void) {
    this.view = view;
    this.failed = failed;
    this.box = h("input", {
      type: "checkbox",
      dataTest: "stock-in-time",
      onchange: () => {
        this.choose(this.box.checked);
        changed();
      },
    });
    this.control = h(
      "div",
      { class: "scene-control", hidden: true },
      h(
        "label",
        { class: "check", title: tr`Otherwise it is drawn as the program leaves it` },
        this.box,
        tr`stock as it is at this time`,
      ),
      this.removed,
    );
  }

  setSimulation(simulation: Simulation | null): void {
    this.asking?.abort();
    this.asking = null;
    this.simulation = simulation;
    this.time_s = 0;
    this.control.hidden = !simulation?.header.document.stock;
    if (simulation) this.showLeft(simulation);
    this.show();
  }

  setTime(time_s: number): void {
    if (time_s === this.time_s) return;
    this.time_s = time_s;
    this.show();
  }

  /** For the address; what is as at the beginning is left out. */
  get state(): { stock: string | null } {
    return { stock: this.isOn ? "now" : null };
  }

  /** As an address says; what it does not name stays. */
  take({ stock }: Readonly<Record<string, string>>): void {
    if (stock === undefined || (stock === "now") === this.box.checked) return;
    this.choose(stock === "now");
  }

  private get isOn(): boolean {
    return this.box.checked && !this.control.hidden;
  }

  private choose(on: boolean): void {
    this.box.checked = on;
    this.asking?.abort();
    this.asking = null;
    if (!on && this.simulation) this.showLeft(this.simulation);
    this.show();
  }

  private show(): void {
    if (this.simulation && this.isOn && !this.asking) void this.ask(this.simulation);
  }

  private showLeft(simulation: Simulation): void {
    this.removed.textContent = "";
    this.control.removeAttribute("aria-busy");
    this.view.setOnWorkpiece(simulation.on_workpiece);
  }

  private async ask(simulation: Simulation): Promise<void> {
    const asking = new AbortController();
    this.asking = asking;
    // What is drawn meanwhile belongs to another time.
    this.control.setAttribute("aria-busy", "true");
    try {
      for (let drawn_s = NaN; drawn_s !== this.time_s; ) {
        const time_s = this.time_s;
        const frame = await simulation.stock(time_s, asking.signal);
        if (asking.signal.aborted) return;
        this.draw(frame);
        drawn_s = time_s;
      }
      this.asking = null;
      this.control.removeAttribute("aria-busy");
    } catch (error) {
      if (asking.signal.aborted) return;
      this.choose(false);
      this.failed(error);
    }
  }

  private draw(frame: Frame<StockHeader>): void {
    const { on_workpiece, removed_mm3 } = frame.header;
    this.view.setOnWorkpiece(modelsOf(on_workpiece, frame.f32("corners_mm")));
    this.removed.textContent = tr`${withUnit(removed_mm3 / 1e3, 2, "cm³")} removed`;
  }
}
