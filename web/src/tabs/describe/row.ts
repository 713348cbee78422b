/** One error of the machine file in the table: what it says, its curve, a field to edit it in place. */

import { tr, trText } from "../../words/index.ts";
import { refusedWith } from "../../words/told.ts";
import { Refusal, type ErrorEntry, type Link } from "../../api.ts";
import { fill, h } from "../../dom.ts";
import { markedSparkline, type Sparkline } from "../../figure/sparkline.ts";
import { NARROW_SPACE, NO_NUMBER, number, withUnit } from "../../format.ts";
import { explain } from "../../glossary/glossary.ts";
import { errorWords, unitText } from "./words.ts";

export interface RowActions {
  /** Puts the text into the draft; rejects with a `Refusal` that says what is wrong. */
  commit(error: string, text: string): Promise<void>;
  goTo(line: number): void;
  hovered(body: string | null): void;
  /** The user works on this error. */
  chosen(error: string): void;
}

/** "−12.0 µm", or of a curve "−4.0 … 12.0 µm". */
export function valueText(error: ErrorEntry): string {
  if (!error.stated) return NO_NUMBER;
  const unit = unitText(error.unit);
  if (error.value !== null) return withUnit(error.value, 1, unit);
  const values = error.curve?.values ?? [];
  if (values.length === 0) return NO_NUMBER;
  return `${number(Math.min(...values), 1)}${NARROW_SPACE}…${NARROW_SPACE}${withUnit(Math.max(...values), 1, unit)}`;
}

/** The greatest amount, for sorting. */
export const sizeOf = (error: ErrorEntry): number =>
  Math.max(0, Math.abs(error.value ?? 0), ...(error.curve?.values ?? []).map(Math.abs));

export class ErrorRow {
  readonly element = h("tr", {});
  /** µm at the tool tip, at the present position. */
  share = 0;
  error: ErrorEntry;
  private committed = "";
  private refused: string | null = null;
  private curve_key = "";
  private spark: Sparkline | null = null;
  private position: number | null = null;
  private readonly name = h("button", { class: "error-name" });
  private readonly words = h("td", { class: "error-words muted" });
  private readonly value = h("td", { class: "number error-value" });
  private readonly uncertainty = h("td", { class: "number error-u" });
  private readonly curve = h("td", { class: "error-curve" });
  private readonly share_cell = h("td", { class: "number error-share" });
  private readonly box: HTMLInputElement;
  private readonly problem: HTMLElement;
  private readonly actions: RowActions;

  constructor(error: ErrorEntry, actions: RowActions) {
    this.error = error;
    this.actions = actions;
    this.problem = h("div", { class: "field-problem", id: `problem-${error.name}`, hidden: true });
    this.box = h("input", {
      type: "text",
      class: "error-text",
      dataError: error.name,
      spellcheck: "false",
      autocomplete: "off",
      ariaLabel: tr`${error.name} in the machine file`,
      "aria-describedby": `problem-${error.name}`,
    });
    this.box.addEventListener("change", () => void this.commit());
    this.box.addEventListener("keydown", (event) => event.key === "Escape" && this.restore());
    this.name.addEventListener("click", () => this.error.line !== null && this.actions.goTo(this.error.line));
    this.element.dataset.row = error.name;
    this.element.addEventListener("focusin", () => this.actions.chosen(this.error.name));
    fill(
      this.element,
      h(
        "td",
        { class: "error-head" },
        this.name,
        h(
          "button",
          { class: "error-info", ariaLabel: tr`${error.name}: what it is`, onclick: () => explain(error.name) },
          "?",
        ),
      ),
      this.words,
      this.value,
      this.uncertainty,
      this.curve,
      this.share_cell,
      h("td", { class: "error-edit" }, this.box, this.problem),
    );
  }

  get isInvalid(): boolean {
    return this.refused !== null;
  }

  update(error: ErrorEntry, links: readonly Link[]): void {
    const body = links[error.body]?.name ?? null;
    const words = errorWords(error, links);
    this.error = error;
    this.element.onpointerenter = () => this.actions.hovered(body);
    this.element.onpointerleave = () => this.actions.hovered(null);
    this.element.classList.toggle("unstated", !error.stated);
    this.name.textContent = error.name;
    this.name.title = `${words}${error.line === null ? "" : tr` – line ${error.line} of the file`}`;
    this.name.disabled = error.line === null;
    this.words.textContent = words;
    this.value.textContent = valueText(error);
    this.value.title = error.measured?.instrument
      ? [error.measured.instrument, error.measured.date].filter(Boolean).join(", ")
      : "";
    this.uncertainty.textContent = withUnit(error.u, 1, unitText(error.unit));
    this.uncertainty.title =
      error.u === null ? tr`no uncertainty stated` : `U = ${withUnit(2 * error.u, 1, unitText(error.unit))} (k = 2)`;
    this.drawCurve(error);
    this.showText(error);
  }

  private drawCurve({ name, curve, unit, shape }: ErrorEntry): void {
    const key = JSON.stringify(curve);
    if (key === this.curve_key) return;
    this.curve_key = key;
    this.spark = null;
    if (!curve || curve.at.length < 3) {
      fill(this.curve);
      return;
    }
    this.spark = markedSparkline({
      x: curve.at,
      y: curve.values,
      width: 72,
      height: 20,
      label: tr`${name} over the travel, ${valueText(this.error)}`,
      at: this.position,
    });
    const [from, to] = [curve.at[0] as number, curve.at.at(-1) as number];
    fill(
      this.curve,
      h(
        "span",
        {
          title: tr`${trText(shape ?? "")}, ${number(from, 0)} … ${withUnit(to, 0, curve.at_unit === "deg" ? "°" : "mm")}, in ${unitText(unit)}`,
        },
        this.spark.svg,
      ),
    );
  }

  private showText(error: ErrorEntry): void {
    const elsewhere = error.stated && error.text === null;
    const text = error.text ?? "";
    const untouched = this.box.value === this.committed && this.refused === null;
    const arrived = this.box.value.trim() === text;
    this.committed = text;
    // What is being typed stays; so does what was refused, until it is corrected or given up.
    const typing = document.activeElement === this.box || this.refused !== null;
    if (untouched || arrived || !typing) this.restore();
    this.box.readOnly = elsewhere;
    this.box.placeholder = elsewhere
      ? error.table
        ? tr`column of ${error.table}`
        : tr`line ${error.line ?? "–"} of the file`
      : tr`not stated, e.g. 5 ± 1 ${error.unit}`;
    this.box.title = elsewhere ? tr`edit it there` : text;
    this.box.classList.toggle("long", text.length > 24);
  }

  private restore(): void {
    this.box.defaultValue = this.committed;
    this.box.value = this.committed;
    this.refuse(null);
  }

  private refuse(refusal: Refusal | null): void {
    this.refused = refusal?.message ?? null;
    this.problem.hidden = refusal === null;
    if (!refusal) {
      this.box.removeAttribute("aria-invalid");
      fill(this.problem);
      return;
    }
    this.box.setAttribute("aria-invalid", "true");
    const first = refusal.diagnostics.find((d) => d.severity === "error");
    fill(
      this.problem,
      refusedWith("span", {}, refusal, first?.message ?? refusal.message),
      " ",
      refusedWith("span", { class: "hint" }, refusal, first?.hint ?? refusal.hint),
    );
  }

  private async commit(): Promise<void> {
    const typed = this.box.value;
    if (typed.trim() === this.committed) return this.restore();
    try {
      await this.actions.commit(this.error.name, typed);
      this.refuse(null);
      // It is in the draft now: Ctrl+Z is for the draft from here on, also before its description has come.
      if (this.box.value === typed) this.box.defaultValue = typed;
    } catch (error) {
      this.refuse(Refusal.from(error));
    }
  }

  markPosition(at: number | null): void {
    this.position = at;
    this.spark?.mark(at);
  }

  setShare(tip_um: number | null): void {
    this.share = tip_um ?? 0;
    this.share_cell.textContent = withUnit(tip_um, 1, "µm");
  }
}
