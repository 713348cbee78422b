/** Under which conditions the pose is taken: the tool in the spindle, and what the sensors say. */

import { tr, trText } from "../../words/index.ts";
import type { Sensor, ToolEntry, ToolShape } from "../../api.ts";
import { numberIn, type Params } from "../../address.ts";
import { fill, h } from "../../dom.ts";
import { positionsOf } from "./axes.ts";

export interface Conditions {
  /** null: the tool of the machine file. */
  tool_length_mm: number | null;
  /** °C by sensor, of those that say something. */
  celsius: Record<string, number>;
}

/** As the command line's `--temperature`: "scale_x=30.5 workpiece=31". */
export function temperatureText({ celsius }: Conditions): string | undefined {
  const words = Object.entries(celsius).map(([name, value]) => `${name}=${value}`);
  return words.length > 0 ? words.join(" ") : undefined;
}

/** A field may be empty; null if it holds no number. */
function numberOf(input: HTMLInputElement): number | null {
  const value = Number(input.value);
  return input.value.trim() !== "" && Number.isFinite(value) ? value : null;
}

export class ConditionFields {
  readonly element = h("section", { class: "panel conditions" });
  readonly now: Conditions = { tool_length_mm: null, celsius: {} };
  private readonly changed: () => void;
  private shown = "";

  constructor(changed: () => void) {
    this.changed = changed;
  }

  /** For the address: "X=10,C=45" of the command line, but of sensors; and the tool. */
  get state(): { tool: string | null; celsius: string | null } {
    const { tool_length_mm, celsius } = this.now;
    const words = Object.entries(celsius).map(([name, value]) => `${name}=${value}`);
    return { tool: tool_length_mm === null ? null : String(tool_length_mm), celsius: words.join(",") || null };
  }

  /** As an address says, before the fields are shown. */
  take({ tool, celsius }: Params): void {
    this.now.tool_length_mm = numberIn(tool);
    this.now.celsius = positionsOf(celsius ?? "");
  }

  /** Another machine: nothing is set. */
  reset(): void {
    this.now.tool_length_mm = null;
    this.now.celsius = {};
    this.shown = "";
  }

  show(tool: ToolShape, tools: readonly ToolEntry[], sensors: readonly Sensor[]): void {
    // The fields stay as they are while an error is edited.
    const key = JSON.stringify([tool, tools, sensors]);
    if (key === this.shown) return;
    this.shown = key;
    const names = new Set(sensors.map((s) => s.name));
    for (const name of Object.keys(this.now.celsius)) if (!names.has(name)) delete this.now.celsius[name];
    fill(this.element, this.toolRow(tool, tools), sensors.length > 0 ? this.sensorTable(sensors) : null);
  }

  private toolRow(tool: ToolShape, tools: readonly ToolEntry[]): HTMLElement {
    const box = h("input", {
      type: "number",
      min: 0,
      step: "any",
      class: "position",
      placeholder: String(tool.length_mm),
      value: this.now.tool_length_mm === null ? "" : String(this.now.tool_length_mm),
      dataTest: "tool-length",
      ariaLabel: tr`Tool length in millimetres; empty: that of the machine file`,
    });
    const set = (): void => {
      this.now.tool_length_mm = numberOf(box);
      this.changed();
    };
    box.addEventListener("change", set);
    const pick = h(
      "select",
      {
        ariaLabel: tr`Tool of the machine file`,
        onchange: () => {
          box.value = pick.value;
          set();
        },
      },
      h("option", { value: "" }, tr`tool of the file`),
      tools.map((t) => h("option", { value: String(t.length_mm) }, t.name)),
    );
    return h(
      "div",
      { class: "row" },
      h("h2", {}, tr`Tool length`),
      h("span", {}, box, h("span", { class: "unit" }, "mm")),
      tools.length > 0 ? pick : null,
    );
  }

  private sensorTable(sensors: readonly Sensor[]): HTMLElement {
    const clear = h(
      "button",
      {
        onclick: () => {
          this.now.celsius = {};
          for (const box of this.element.querySelectorAll<HTMLInputElement>("input[data-sensor]")) box.value = "";
          this.changed();
        },
      },
      tr`None`,
    );
    const rows = sensors.map((sensor) => {
      const box = h("input", {
        type: "number",
        step: "any",
        class: "position",
        placeholder: "–",
        value: String(this.now.celsius[sensor.name] ?? ""),
        dataSensor: sensor.name,
        ariaLabel: tr`Temperature of ${sensor.name} in degrees Celsius`,
      });
      box.addEventListener("change", () => {
        const value = numberOf(box);
        if (value === null) delete this.now.celsius[sensor.name];
        else this.now.celsius[sensor.name] = value;
        this.changed();
      });
      return h(
        "tr",
        {},
        h("td", {}, h("code", {}, sensor.name)),
        h("td", { class: "muted" }, sensor.drives.map(trText).join(", ")),
        h("td", { class: "number" }, box, h("span", { class: "unit" }, "°C")),
      );
    });
    return h(
      "div",
      { class: "sensors" },
      h("div", { class: "panel-head" }, h("h2", {}, tr`Temperatures by sensor`), clear),
      h("table", {}, h("tbody", {}, rows)),
      h(
        "p",
        { class: "hint" },
        tr`With temperatures the deviation is machine − workpiece: what the part has at 20 °C. A sensor without one stands at the temperature of its error table, the workpiece at 20 °C.`,
      ),
    );
  }
}
