/** The stock in the picture: as the program leaves it, or as it is at the time that is shown. */

import { latestOnly } from "../../api.ts";
import { h } from "../../dom.ts";
import { withUnit } from "../../format.ts";
import type { Frame } from "../../frame.ts";
import { modelsOf } from "../../scene/models.ts";
import type { MachineView } from "../../scene/view.ts";
import { tr } from "../../words/index.ts";
import type { Simulation, StockHeader } from "./answers.ts";

interface Asked {
  simulation: Simulation;
  time_s: number;
}

export class StockInTime {
  readonly control: HTMLElement;
  private readonly view: MachineView;
  private readonly removed = h("output", { class: "number", dataTest: "stock-removed" });
  private readonly box: HTMLInputElement;
  private simulation: Simulation | null = null;
  private time_s = 0;
  private readonly ask = latestOnly<Asked, Frame<StockHeader>>(
    ({ simulation, time_s }) => simulation.stock(time_s),
    (frame, asked) => this.answered(frame, asked),
    (error) => this.failed(error),
  );
  private readonly failed: (error: unknown) => void;

  /** `changed`: the user chose the other. */
  constructor(view: MachineView, failed: (error: unknown) => void, changed: () => void) {
    this.view = view;
    this.failed = failed;
    this.box = h("input", {
      type: "checkbox",
      dataTest: "stock-in-time",
      onchange: () => {
        this.show();
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
    this.simulation = simulation;
    this.time_s = 0;
    this.control.hidden = !simulation?.header.document.stock;
    this.show();
  }

  setTime(time_s: number): void {
    if (time_s === this.time_s) return;
    this.time_s = time_s;
    if (this.box.checked) this.show();
  }

  /** For the address; what is as at the beginning is left out. */
  get state(): { stock: string | null } {
    return { stock: this.box.checked ? "now" : null };
  }

  /** As an address says; what it does not name stays. */
  take({ stock }: Readonly<Record<string, string>>): void {
    if (stock === undefined || (stock === "now") === this.box.checked) return;
    this.box.checked = stock === "now";
    this.show();
  }

  private show(): void {
    const { simulation, time_s } = this;
    if (simulation && this.box.checked && !this.control.hidden) {
      this.ask({ simulation, time_s });
      return;
    }
    this.removed.textContent = "";
    if (simulation) this.view.setOnWorkpiece(simulation.on_workpiece);
  }

  private answered(frame: Frame<StockHeader>, { simulation }: Asked): void {
    if (simulation !== this.simulation || !this.box.checked) return;
    const { on_workpiece, removed_mm3 } = frame.header;
    this.view.setOnWorkpiece(modelsOf(on_workpiece, frame.f32("corners_mm")));
    this.removed.textContent = tr`${withUnit(removed_mm3 / 1e3, 2, "cm³")} removed`;
  }
}
