/** All errors of the machine: search, filter by body, sort, edit in place. */

import { tr } from "../../words/index.ts";
import type { ErrorEntry, Link, PoseDocument } from "../../api.ts";
import type { Params } from "../../address.ts";
import { fill, h } from "../../dom.ts";
import type { Positions } from "./axes.ts";
import { ErrorRow, sizeOf, type RowActions } from "./row.ts";
import { errorWords } from "./words.ts";

type Key = "chain" | "value" | "u" | "share";

const HEADS: readonly { key: Key | null; title: string; hint: string; class?: string }[] = [
  { key: "chain", title: tr`Error`, hint: tr`Sort in the order of the chain` },
  { key: null, title: "", hint: "", class: "error-words" },
  {
    key: "value",
    title: tr`Value`,
    hint: tr`Sort by the greatest amount; of a curve its least and greatest value`,
    class: "number",
  },
  {
    key: "u",
    title: "u",
    hint: tr`Standard uncertainty, the greatest of a curve. U = 2u (k = 2)`,
    class: "number error-u",
  },
  { key: null, title: tr`Over travel`, hint: "" },
  {
    key: "share",
    title: tr`Share now`,
    hint: tr`What it moves the tool tip by at the present position (length). Sort by it`,
    class: "number",
  },
  { key: null, title: tr`In the file`, hint: "" },
];

export class ErrorTable {
  readonly element = h("section", { class: "panel errors-panel" });
  private rows: ErrorRow[] = [];
  private links: readonly Link[] = [];
  private key: Key = "chain";
  private readonly body = h("tbody", {});
  private readonly heads = h("tr", {});
  private readonly search = h("input", {
    type: "text",
    class: "error-search",
    placeholder: tr`Search: EC0Y, tilt, Z …`,
    ariaLabel: tr`Search errors`,
    oninput: () => this.filterAnew(),
  });
  private readonly of_body = h("select", { ariaLabel: tr`Errors of`, onchange: () => this.filterAnew() });
  private readonly all = h("input", { type: "checkbox", onchange: () => this.filterAnew() });
  private readonly count = h("span", { class: "muted" });
  private readonly actions: RowActions;
  /** The user filters or sorts otherwise. */
  private readonly changed: () => void;
  /** What an address asks for before the errors are there. */
  private wanted: Params | null = null;
  private chosen = "";

  constructor(actions: RowActions, changed: () => void) {
    this.actions = { ...actions, chosen: (error) => this.choose(error, () => actions.chosen(error)) };
    this.changed = changed;
    fill(
      this.element,
      h(
        "div",
        { class: "row errors-tools" },
        this.search,
        this.of_body,
        h("label", { class: "check" }, this.all, tr`also not stated`),
        this.count,
      ),
      h("table", { class: "errors" }, h("thead", {}, this.heads), this.body),
      h(
        "p",
        { class: "hint errors-hint" },
        tr`A value with its unit, ± its standard uncertainty: 12 ± 1 urad. Empty takes the error out of the file. Enter keeps, Escape restores.`,
      ),
    );
    this.showHeads();
  }

  /** Rows that hold what the machine file does not take. */
  get invalid(): string[] {
    return this.rows.filter((row) => row.isInvalid).map((row) => row.error.name);
  }

  show(errors: readonly ErrorEntry[], links: readonly Link[]): void {
    const same = errors.length === this.rows.length && errors.every((e, i) => this.rows[i]?.error.name === e.name);
    if (!same) {
      this.rows = errors.map((error) => new ErrorRow(error, this.actions));
      fill(
        this.of_body,
        h("option", { value: "" }, tr`all bodies`),
        links.map((l) =>
          h(
            "option",
            { value: l.name },
            l.kind === "workpiece" ? tr`workpiece w` : l.kind === "tool" ? tr`tool t` : tr`axis ${l.name}`,
          ),
        ),
      );
    }
    this.links = links;
    errors.forEach((error, i) => this.rows[i]?.update(error, links));
    if (!same) this.sort();
    const { wanted } = this;
    this.wanted = null;
    if (wanted) this.take(wanted, false);
    else this.filter();
  }

  /** The errors of one body; false if it has none. */
  showBody(body: string): boolean {
    if (![...this.of_body.options].some((option) => option.value === body)) return false;
    this.search.value = "";
    this.of_body.value = body;
    this.filterAnew();
    return true;
  }

  private filterAnew(): void {
    this.filter();
    this.changed();
  }

  private choose(error: string, then: () => void): void {
    if (error === this.chosen) return;
    this.chosen = error;
    this.showChosen();
    then();
  }

  private showChosen(): void {
    for (const row of this.rows) row.element.classList.toggle("chosen", row.error.name === this.chosen);
  }

  /** For the address: what is searched, of which body, in which order, and the error that is worked on. */
  get state(): Record<string, string | null> {
    return {
      find: this.search.value || null,
      of: this.of_body.value || null,
      all: this.all.checked ? "true" : null,
      sort: this.key === "chain" ? null : this.key,
      error: this.chosen || null,
    };
  }

  /** As an address says; what it does not name is as at the beginning. `later`: of a machine that is on its way. */
  take(wanted: Params, later: boolean): void {
    if (later || this.rows.length === 0) {
      this.wanted = wanted;
      return;
    }
    this.search.value = wanted.find ?? "";
    this.of_body.value = this.links.some((link) => link.name === wanted.of) ? (wanted.of as string) : "";
    this.all.checked = wanted.all === "true";
    const key = HEADS.find((head) => head.key !== null && head.key === wanted.sort)?.key ?? "chain";
    if (key !== this.key) {
      this.key = key;
      this.sort();
    }
    this.chosen = wanted.error ?? "";
    this.showChosen();
    this.filter();
    this.rows.find((row) => row.error.name === this.chosen)?.element.scrollIntoView({ block: "center" });
  }

  /** What every error does at the present position, and where that is on its curve. */
  showPose(pose: PoseDocument | null, at: Positions): void {
    const shares = new Map(pose?.budget.map((entry) => [entry.error, Math.hypot(...entry.tip_um)]));
    for (const row of this.rows) {
      row.setShare(pose && row.error.stated ? (shares.get(row.error.name) ?? 0) : null);
      row.markPosition(at[this.links[row.error.body]?.name ?? ""] ?? null);
    }
  }

  private filter(): void {
    const words = this.search.value.toLowerCase().split(/\s+/).filter(Boolean);
    let shown = 0;
    for (const row of this.rows) {
      const { error } = row;
      const text =
        `${error.name} ${errorWords(error, this.links)} ${error.kind} ${error.text ?? ""} ${error.table ?? ""}`.toLowerCase();
      const there =
        (error.stated || this.all.checked || row.isInvalid) &&
        (this.of_body.value === "" || this.links[error.body]?.name === this.of_body.value) &&
        words.every((word) => text.includes(word));
      row.element.hidden = !there;
      if (there) shown += 1;
    }
    const stated = this.rows.filter((row) => row.error.stated).length;
    this.count.textContent = tr`${shown} shown, ${stated} stated of ${this.rows.length}`;
  }

  private sort(): void {
    const size: Record<Exclude<Key, "chain">, (row: ErrorRow) => number> = {
      value: (r) => sizeOf(r.error),
      u: (r) => r.error.u ?? -1,
      share: (r) => r.share,
    };
    const key = this.key;
    const order = key === "chain" ? this.rows : [...this.rows].sort((a, b) => size[key](b) - size[key](a));
    fill(
      this.body,
      order.map((row) => row.element),
    );
    this.showHeads();
  }

  private showHeads(): void {
    fill(
      this.heads,
      HEADS.map(({ key, title, hint, class: style }) => {
        if (key === null) return h("th", { class: style ?? null }, title);
        const by = (): void => {
          this.key = key;
          this.sort();
          this.changed();
        };
        return h(
          "th",
          { class: style ?? null, ariaSort: key === this.key ? (key === "chain" ? "ascending" : "descending") : null },
          h("button", { class: "sort", title: hint, onclick: by }, title),
        );
      }),
    );
  }
}
