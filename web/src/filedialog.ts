/** A small TOML file that is stated in a form, and edited as text from then on. */

import { tr } from "./words/index.ts";
import { refusedWith } from "./words/told.ts";
import type { App } from "./app.ts";
import { Refusal } from "./api.ts";
import { fill, h, type Child } from "./dom.ts";
import { FileText } from "./tabs/describe/file.ts";

/** A form that makes a text. A wrong field has `data-wrong` with the reason. */
export interface FileForm {
  readonly element: HTMLElement;
  text(): string | Promise<string>;
}

/** What is stated. */
export interface Stated {
  title: Child;
  /** Its name below the project folder; one that the form changes is asked for when it is saved. */
  path: string | (() => string);
  /** The form, given the text that is there; null where only the text can be edited. */
  form(text: string | null): FileForm | null | Promise<FileForm | null>;
  /** Of what is kept elsewhere than in the project: the text so far, and where it goes. */
  kept?: { text: string | null; keep: (text: string) => void | Promise<void>; where: string };
  /** After it was saved. */
  saved(path: string): void;
}

const pathOf = ({ path }: Stated): string => (typeof path === "string" ? path : path());

export class FileDialog {
  readonly element: HTMLDialogElement;
  private readonly app: App;
  private stated: Stated | null = null;
  /** The file that is shown, and its version. */
  private opened: { path: string; version: string } | null = null;
  private typed = "";
  private form: FileForm | null = null;
  private readonly note: HTMLElement;
  private readonly save: HTMLButtonElement;
  private readonly text = new FileText((text) => (this.typed = text));

  /** `name` is in the classes and in the places for tests. */
  constructor(app: App, name: string, label: string, button: string) {
    this.app = app;
    this.element = h("dialog", {
      class: `file-dialog ${name}-dialog`,
      ariaLabel: label,
      oninput: () => (this.note.textContent = ""),
    });
    this.note = h("p", { class: "file-dialog-note", role: "status", dataTest: `${name}-note` });
    this.save = h(
      "button",
      { class: "primary", type: "button", dataTest: `${name}-save`, onclick: () => void this.keep() },
      button,
    );
  }

  /** Shows the form, or the file as it is. */
  async open(stated: Stated): Promise<void> {
    this.stated = stated;
    this.note.textContent = "";
    try {
      const { path, kept } = stated;
      this.opened = null;
      // A name that the form changes is that of a new file.
      const text = kept ? kept.text : typeof path === "string" ? await this.onDisk(path) : null;
      const form = await stated.form(text);
      // Another dialog was asked for meanwhile.
      if (this.stated !== stated) return;
      this.form = form;
      if (!this.form) {
        this.typed = text ?? "";
        this.text.show(this.typed);
      }
      this.draw();
      if (!this.element.isConnected) document.body.append(this.element);
      if (!this.element.open) this.element.showModal();
    } catch (error) {
      this.app.fail(error);
    }
  }

  private async onDisk(path: string): Promise<string | null> {
    if (!this.app.state.project?.files.some((file) => file.path === path)) return null;
    const file = await this.app.api.ask("open", { path });
    this.opened = { path, version: file.version };
    return file.text;
  }

  private draw(): void {
    const { stated } = this;
    if (!stated) return;
    const close = h("button", { type: "button", onclick: () => this.element.close() }, tr`Cancel`);
    fill(
      this.element,
      h("h2", {}, stated.title),
      this.form?.element ?? this.text.element,
      this.note,
      h(
        "p",
        { class: "row" },
        this.save,
        close,
        h(
          "span",
          { class: "muted" },
          stated.kept?.where ?? (typeof stated.path === "string" ? tr`saved as ${stated.path}` : ""),
        ),
      ),
    );
  }

  private async keep(): Promise<void> {
    const { stated } = this;
    if (!stated) return;
    this.text.flush();
    const wrong = this.form ? this.element.querySelector<HTMLElement>("[data-wrong]") : null;
    if (wrong) {
      this.note.textContent = wrong.dataset.wrong ?? "";
      wrong.focus();
      return;
    }
    this.save.disabled = true;
    try {
      const text = this.form ? await this.form.text() : this.typed;
      if (stated.kept) await stated.kept.keep(text);
      else await this.onto(pathOf(stated), text);
      this.element.close();
      stated.saved(pathOf(stated));
    } catch (error) {
      const refusal = Refusal.from(error);
      fill(
        this.note,
        refusedWith("span", {}, refusal, refusal.message),
        refusal.hint ? [": ", refusedWith("span", {}, refusal, refusal.hint)] : null,
      );
    } finally {
      this.save.disabled = false;
    }
  }

  private async onto(path: string, text: string): Promise<void> {
    const version = this.opened?.path === path ? this.opened.version : null;
    const body = { path, text, version, make_folder: true, window: this.app.api.window };
    this.opened = { path, version: (await this.app.api.ask("save", body)).version };
    await this.app.loadProject();
  }
}
