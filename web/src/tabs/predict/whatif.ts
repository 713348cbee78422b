/** The panel of changes: switch errors off or drag them, set the part up otherwise. */

import { tr } from "../../words/index.ts";
import { refusedWith } from "../../words/told.ts";
import type { Request } from "../../api.ts";
import type { Refusal } from "../../api.ts";
import { fill, h } from "../../dom.ts";
import { deg, mm, number } from "../../format.ts";
import { ErrorRow } from "./errorrow.ts";
import type { PieceDocument, PieceHeader } from "./types.ts";

/** The body of `what-if` without the study. */
export type Changes = Omit<Request<"what-if">, "study">;

/** Rows that are shown before all are asked for. */
const SHOWN = 10;

interface Setting {
  element: HTMLElement;
  /** null: as in the file. */
  value: number | null;
  reset(): void;
  /** As an address says; without `onchange`. */
  take(value: number): void;
}

export class WhatIf {
  private readonly onchange: (changes: Changes | null) => void;
  private readonly title = h("span", { class: "muted", dataTest: "changes" });
  private readonly time = h("span", { class: "muted", dataTest: "what-if-time", role: "status" });
  private readonly refused = h("p", { class: "what-if-refused", role: "alert", hidden: true });
  private readonly reset_button = h("button", { dataTest: "reset", onclick: () => this.reset() }, tr`As in the file`);
  private readonly search = h("input", {
    type: "text",
    class: "what-if-search",
    placeholder: tr`find an error, such as EC0Y`,
    ariaLabel: tr`Find an error`,
    oninput: () => this.filter(),
  });
  private readonly all_button = h("button", { ariaPressed: "false", onclick: () => this.toggleAll() });
  private readonly rows_place = h("tbody");
  private readonly settings_place = h("div", { class: "panel" });
  private rows: ErrorRow[] = [];
  private rotary = new Map<string, Setting>();
  private sensors = new Map<string, Setting>();
  private tool: Setting | null = null;
  private all = false;

  constructor(host: HTMLElement, onchange: (changes: Changes | null) => void) {
    this.onchange = onchange;
    host.append(
      h(
        "div",
        { class: "panel" },
        h("div", { class: "row what-if-head" }, this.reset_button, this.title, this.time),
        this.refused,
        h("div", { class: "row what-if-find" }, this.search, this.all_button),
        h(
          "table",
          { class: "what-if-errors" },
          h(
            "thead",
            {},
            h(
              "tr",
              {},
              h("th", {}, tr`on`),
              h("th", {}, tr`error`),
              h("th", {}, tr`times, −2 … +2`),
              h("th", { class: "number" }, tr`factor`),
              h("th", { class: "number" }, tr`added`),
            ),
          ),
          this.rows_place,
        ),
      ),
      this.settings_place,
    );
  }

  /** Builds the rows for a study; the errors that matter most come first. */
  open(header: PieceHeader): void {
    const rank = weights(header.document);
    const errors = [...header.errors].sort((a, b) => (rank.get(b.name) ?? 0) - (rank.get(a.name) ?? 0));
    this.rows = errors.map((error) => new ErrorRow(error.name, error.unit, () => this.changed()));
    fill(
      this.rows_place,
      this.rows.map((row) => row.element),
    );
    this.search.value = "";
    this.openSettings(header);
    this.filter();
    this.showState();
    this.time.textContent = "";
  }

  private openSettings(header: PieceHeader): void {
    const set = (name: string, from: number, to: number, step: number, unit: string, known: number | null): Setting =>
      this.setting(name, { from, to, step, unit, known });
    this.rotary = new Map(
      header.rotary.map((name) => [name, set(name, -180, 180, 1, "°", header.document.setting_command[name] ?? null)]),
    );
    const known = header.tool_length_mm;
    const reach = { from: 0, to: Math.max(100, 2 * known), step: 1, unit: "mm", known };
    this.tool = this.setting("tool length", reach, tr`tool length`);
    this.sensors = new Map(header.sensors.map((name) => [name, set(name, 0, 50, 0.1, "°C", null)]));
    const table = (title: string, what: string, settings: Iterable<Setting>): HTMLElement =>
      h(
        "div",
        { class: "settings" },
        h("h2", {}, title),
        h("p", { class: "muted" }, what),
        h(
          "table",
          {},
          h(
            "tbody",
            {},
            [...settings].map((one) => one.element),
          ),
        ),
      );
    fill(
      this.settings_place,
      table(
        tr`Where the part zero is touched`,
        tr`Position of the rotary axes when the zero is set`,
        this.rotary.values(),
      ),
      table(tr`Tool`, tr`From the holder to the tip`, [this.tool]),
      this.sensors.size > 0
        ? table(tr`Temperatures`, tr`What the sensors of the machine say`, this.sensors.values())
        : null,
    );
  }

  private setting(
    name: string,
    scale: { from: number; to: number; step: number; unit: string; known: number | null },
    shown = name,
  ): Setting {
    const { from, to, step, unit, known } = scale;
    const words =
      unit === "°"
        ? tr`${shown} in degrees`
        : unit === "mm"
          ? tr`${shown} in millimetres`
          : tr`${shown} in degrees Celsius`;
    const slider = h("input", {
      type: "range",
      min: from,
      max: to,
      step,
      value: String(known ?? 20),
      ariaLabel: words,
      dataSetting: name,
    });
    const box = h("input", {
      type: "number",
      step: "any",
      value: known === null ? "" : String(rounded(known)),
      placeholder: tr`in file`,
      ariaLabel: tr`${words}, exactly`,
      dataSettingBox: name,
    });
    const text = known === null ? "" : tr`in the file ${unit === "°" ? deg(known) : mm(known, 1)}`;
    const element = h(
      "tr",
      {},
      h("td", { class: "axis-name" }, shown),
      h("td", { class: "axis-slider" }, slider),
      h("td", { class: "number" }, box, h("span", { class: "unit" }, unit)),
      h("td", { class: "muted" }, text),
    );
    const one: Setting = {
      element,
      value: null,
      reset: () => {
        one.value = null;
        slider.value = String(known ?? 20);
        box.value = known === null ? "" : String(rounded(known));
        element.classList.remove("changed");
      },
      take: (value) => {
        slider.value = box.value = String(value);
        mark(value);
      },
    };
    const mark = (value: number | null): void => {
      one.value = value === null || value === known ? null : value;
      element.classList.toggle("changed", one.value !== null);
    };
    const take = (value: number | null): void => {
      mark(value);
      this.changed();
    };
    slider.addEventListener("input", () => {
      box.value = slider.value;
      take(Number(slider.value));
    });
    box.addEventListener("change", () => {
      const empty = box.value.trim() === "";
      if (empty) one.reset();
      else slider.value = box.value;
      take(empty ? null : Number(box.value));
    });
    return one;
  }

  // ---- changes ----

  /** null: nothing is changed. */
  changes(): Changes | null {
    const errors = this.rows.flatMap((row) => (row.change ? [[row.name, row.change] as const] : []));
    const given = (settings: Map<string, Setting>): [string, number][] =>
      [...settings].flatMap(([name, { value }]) => (value === null ? [] : [[name, value] as [string, number]]));
    const setting = given(this.rotary);
    const temperature = given(this.sensors);
    const changes: Changes = {
      ...(errors.length > 0 ? { errors: Object.fromEntries(errors) } : {}),
      ...(setting.length > 0 ? { setting_deg: Object.fromEntries(setting) } : {}),
      ...(this.tool?.value != null ? { tool_length_mm: this.tool.value } : {}),
      ...(temperature.length > 0
        ? { temperature: temperature.map(([name, value]) => `${name}=${value}`).join(",") }
        : {}),
    };
    return Object.keys(changes).length > 0 ? changes : null;
  }

  /** Every setting with its name in the address. */
  private named(): [string, Setting][] {
    return [
      ...[...this.rotary].map(([name, one]): [string, Setting] => [`at.${name}`, one]),
      ...(this.tool ? [["tool", this.tool] as [string, Setting]] : []),
      ...[...this.sensors].map(([name, one]): [string, Setting] => [`celsius.${name}`, one]),
    ];
  }

  /** The changes for the address: "EC0Y:off,EXX:x1.5a3,at.C:30"; null: none. */
  get state(): string | null {
    const words = [
      ...this.rows.filter((row) => row.state).map((row) => `${row.name}:${row.state}`),
      ...this.named().flatMap(([name, { value }]) => (value === null ? [] : [`${name}:${value}`])),
    ];
    return words.join(",") || null;
  }

  /** The changes that an address names, instead of those here. */
  take(state: string | null): void {
    if (state === this.state) return;
    for (const one of [...this.rows, ...this.settings()]) one.reset();
    const settings = new Map(this.named());
    for (const part of (state ?? "").split(",")) {
      const [name = "", words = ""] = part.split(":");
      const value = Number(words);
      this.rows.find((row) => row.name === name)?.take(words);
      if (words !== "" && Number.isFinite(value)) settings.get(name)?.take(value);
    }
    this.filter();
    this.changed();
  }

  private changed(): void {
    this.refused.hidden = true;
    this.showState();
    this.onchange(this.changes());
  }

  private reset(): void {
    for (const one of [...this.rows, ...this.settings()]) one.reset();
    this.time.textContent = "";
    this.changed();
    this.filter();
  }

  private settings(): Setting[] {
    return [...this.rotary.values(), ...this.sensors.values(), ...(this.tool ? [this.tool] : [])];
  }

  private showState(): void {
    const count = this.rows.filter((r) => r.change).length + this.settings().filter((s) => s.value !== null).length;
    this.title.textContent = count === 0 ? tr`nothing changed` : count === 1 ? tr`1 change` : tr`${count} changes`;
    this.reset_button.disabled = count === 0;
  }

  /** Switches one error off, and shows it. */
  without(error: string): void {
    const row = this.rows.find((r) => r.name === error);
    row?.switchOff();
    this.showRow(row);
  }

  /** Adds to one error of the file as it is, and shows it; `text` is such as "608.9 urad". */
  correct(error: string, text: string): void {
    for (const one of [...this.rows, ...this.settings()]) one.reset();
    let row = this.rows.find((r) => r.name === error);
    if (!row) {
      // A location error that the machine file does not state is zero.
      row = new ErrorRow(error, text.endsWith("urad") ? "µrad" : "µm", () => this.changed());
      this.rows.push(row);
      this.rows_place.append(row.element);
    }
    row.add(Number.parseFloat(text));
    this.showRow(row);
  }

  private showRow(row: ErrorRow | undefined): void {
    this.filter();
    row?.element.scrollIntoView({ block: "nearest" });
  }

  // ---- what is shown ----

  private toggleAll(): void {
    this.all = !this.all;
    this.filter();
  }

  private filter(): void {
    const wanted = this.search.value.trim().toUpperCase();
    this.rows.forEach((row, i) => {
      row.element.hidden = !(wanted ? row.name.toUpperCase().includes(wanted) : this.all || i < SHOWN || row.change);
    });
    this.all_button.textContent = this.all ? tr`only the ${SHOWN} that matter most` : tr`all ${this.rows.length}`;
    this.all_button.setAttribute("aria-pressed", String(this.all));
  }

  answered(answer_ms: number, drawn_ms: number): void {
    this.time.dataset.answer = String(answer_ms);
    this.time.dataset.drawn = String(drawn_ms);
    this.time.textContent = tr`answered in ${number(answer_ms, 0)} ms, drawn after ${number(drawn_ms, 0)} ms`;
  }

  refuse(refusal: Refusal): void {
    this.time.textContent = "";
    this.refused.hidden = false;
    fill(
      this.refused,
      h("strong", {}, tr`Not computed; the figures are those before. `),
      refusedWith("span", {}, refusal, refusal.message),
      refusal.hint ? ". " : "",
      refusedWith("span", {}, refusal, refusal.hint),
    );
  }
}

const rounded = (value: number): number => Math.round(value * 1e6) / 1e6;

/** What an error does to the judged indices at most. */
function weights(document: PieceDocument): Map<string, number> {
  const judged = new Set(document.judgements.map((j) => j.index));
  const most = new Map<string, number>();
  for (const share of document.blame) {
    if (judged.size > 0 && !judged.has(share.index)) continue;
    most.set(share.error, Math.max(most.get(share.error) ?? 0, share.alone_mm));
  }
  return most;
}
