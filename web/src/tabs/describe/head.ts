/** The top of the panel: which machine, is it changed, undo, save – and what to do if another window saved it too. */

import { tr } from "../../words/index.ts";
import type { Vector } from "../../api.ts";
import { fill, h } from "../../dom.ts";
import { um } from "../../format.ts";
import type { Draft } from "./draft.ts";

export interface HeadActions {
  choose(path: string): void;
  undo(): void;
  redo(): void;
  save(): void;
  saveAs(path: string): void;
  /** Takes what is in the file now; the own edits stay one step back. */
  takeTheirs(): void;
}

export interface HeadState {
  name: string;
  draft: Draft;
  usable: boolean;
  /** Machine files of the folder. */
  files: readonly string[];
  /** Files with edits that are not saved. */
  dirty: ReadonlySet<string>;
}

/** "machines/mill/machine.toml" -> "machines/mill/machine-2.toml": next to it, where its tables are. */
export function nameBeside(path: string, taken: ReadonlySet<string>): string {
  const stem = path.replace(/(-\d+)?\.toml$/i, "");
  for (let n = 2; ; n++) if (!taken.has(`${stem}-${n}.toml`)) return `${stem}-${n}.toml`;
}

export class Head {
  readonly element = h("section", { class: "panel describe-head" });
  private readonly name = h("h1", {});
  private readonly file = h("select", {
    class: "machine-file",
    ariaLabel: tr`Machine file`,
    onchange: () => this.actions.choose(this.file.value),
  });
  private readonly state = h("span", { class: "edit-state", role: "status", dataTest: "edit-state" });
  private readonly undo = h(
    "button",
    { title: tr`Undo (Ctrl+Z)`, disabled: true, onclick: () => this.actions.undo() },
    tr`Undo`,
  );
  private readonly redo = h(
    "button",
    { title: tr`Redo (Ctrl+Shift+Z)`, disabled: true, onclick: () => this.actions.redo() },
    tr`Redo`,
  );
  private readonly save = h(
    "button",
    {
      class: "primary",
      title: tr`Save to the machine file (Ctrl+S)`,
      disabled: true,
      onclick: () => this.actions.save(),
    },
    tr`Save`,
  );
  private readonly save_as = h(
    "button",
    { title: tr`Save under another name`, onclick: () => this.askName("") },
    tr`Save as …`,
  );
  private readonly deviation = h("strong", { class: "deviation", dataTest: "tip-length" }, "–");
  private readonly banner = h("div", { class: "banner", role: "alert", hidden: true });
  private readonly actions: HeadActions;
  private now: HeadState | null = null;

  constructor(actions: HeadActions) {
    this.actions = actions;
    fill(
      this.element,
      h("div", { class: "describe-title" }, this.name, this.file),
      h(
        "div",
        { class: "row edit-row" },
        h("div", { class: "group" }, this.undo, this.redo),
        h("div", { class: "group" }, this.save, this.save_as),
        this.state,
        h("span", { class: "tip-now" }, tr`tool tip off by `, this.deviation),
      ),
      this.banner,
    );
  }

  show(now: HeadState): void {
    const { draft } = now;
    if (this.now?.draft !== draft) this.closeBanner();
    this.now = now;
    this.name.textContent = this.name.title = now.name;
    fill(
      this.file,
      [...new Set([draft.path, ...now.files])]
        .sort()
        .map((path) => h("option", { value: path }, now.dirty.has(path) ? tr`${path} (not saved)` : path)),
    );
    this.file.value = draft.path;
    this.undo.disabled = !draft.canUndo;
    this.redo.disabled = !draft.canRedo;
    this.save.disabled = !draft.dirty;
    this.state.dataset.dirty = String(draft.dirty);
    this.state.textContent = draft.dirty
      ? now.usable
        ? tr`changed, not saved`
        : tr`changed, cannot be used yet`
      : now.usable
        ? tr`saved`
        : tr`cannot be used`;
    this.state.title = draft.dirty
      ? tr`The picture and the numbers here follow the edit; the other tabs read the saved file.`
      : "";
  }

  /** How far the tool tip is from where it should be, at the present position. */
  showDeviation(tip_um: Vector | null): void {
    this.deviation.textContent = tip_um ? um(Math.hypot(...tip_um)) : "–";
  }

  /** The file has another text than the one that was edited. Nothing has been overwritten. */
  showConflict(): void {
    const path = this.now?.draft.path ?? "";
    this.showBanner(
      h(
        "p",
        {},
        h("strong", {}, tr`${path} was changed somewhere else since you opened it.`),
        tr` Nothing was overwritten; your edits are still here.`,
      ),
      h(
        "div",
        { class: "row" },
        h("button", { dataTest: "theirs", onclick: () => this.actions.takeTheirs() }, tr`Show theirs`),
        h("button", { dataTest: "keep", onclick: () => this.closeBanner() }, tr`Keep editing`),
        h("button", { dataTest: "other-name", onclick: () => this.askName("") }, tr`Save under another name …`),
      ),
      h(
        "p",
        { class: "hint" },
        tr`“Show theirs” drops your edits; Undo brings them back, and then Save replaces theirs.`,
      ),
    );
  }

  /** Asks for another file name; `problem` says why the last one was not taken. */
  askName(problem: string): void {
    if (!this.now) return;
    const taken = new Set([this.now.draft.path, ...this.now.files]);
    const kept = this.banner.querySelector<HTMLInputElement>("input.save-name")?.value;
    const input = h("input", {
      type: "text",
      class: "save-name",
      value: kept ?? nameBeside(this.now.draft.path, taken),
      ariaLabel: tr`Name of the new machine file`,
      spellcheck: "false",
      ariaInvalid: problem ? "true" : null,
    });
    const form = h(
      "form",
      { class: "row" },
      h("label", { class: "save-label" }, tr`New file`, input),
      h("button", { class: "primary" }, tr`Save`),
      h("button", { type: "button", onclick: () => this.closeBanner() }, tr`Cancel`),
    );
    form.addEventListener("submit", (event) => {
      event.preventDefault();
      this.actions.saveAs(input.value.trim());
    });
    this.showBanner(
      form,
      problem
        ? h("p", { class: "field-problem" }, problem)
        : h("p", { class: "hint" }, tr`In the same folder, tables that the file names are found.`),
    );
    input.focus();
  }

  private showBanner(...children: HTMLElement[]): void {
    fill(this.banner, children);
    this.banner.hidden = false;
  }

  closeBanner(): void {
    this.banner.hidden = true;
    fill(this.banner);
  }
}
