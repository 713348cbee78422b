/** Which machine, program, set-up and control; a program may also be dropped anywhere on the tab. */

import { tr } from "../../words/index.ts";
import type { App } from "../../app.ts";
import { Refusal, type FileKind } from "../../api.ts";
import { CONTROLS } from "../../controls.ts";
import { fill, h } from "../../dom.ts";

export interface Dropped {
  name: string;
  text: string;
}

/** What stands in the address. */
export interface Choice {
  machine: string | null;
  /** A file of the project; null with `dropped`, or where none is chosen. */
  program: string | null;
  setup: string | null;
  control: string | null;
  /** "off": blocks with `/` are left out. */
  optional: string | null;
}

/** The set-up and control of one program are not those of another. */
const OF_PROGRAM = { setup: null, control: null, optional: null };

export const NOTHING_CHOSEN: Choice = { machine: null, program: null, setup: null, control: null, optional: null };

/** The server takes 64 MiB at once; line ends become longer on the way. */
const MOST_BYTES = 60e6;

export class Choices {
  readonly element = h("section", { class: "panel simulate-choices", ariaLabel: tr`What is simulated` });
  private readonly app: App;
  private choice: Choice = NOTHING_CHOSEN;
  private dropped: Dropped | null = null;
  private readonly pick: (choice: Choice, dropped: Dropped | null) => void;
  private readonly edit: () => void;

  /** `edit`: opens the set-up of the program. */
  constructor(app: App, pick: (choice: Choice, dropped: Dropped | null) => void, edit: () => void) {
    this.app = app;
    this.pick = pick;
    this.edit = edit;
  }

  show(choice: Choice, dropped: Dropped | null): void {
    this.choice = choice;
    this.dropped = dropped;
    const input = h("input", {
      type: "file",
      class: "drop-input",
      ariaLabel: tr`Open a program of this computer`,
      onchange: () => void this.take(input.files?.[0]),
    });
    fill(
      this.element,
      this.labelled(
        tr`Machine`,
        this.select("machine", this.files("machine", choice.machine), tr`choose a machine`, choice.machine),
      ),
      this.labelled(
        tr`Program`,
        this.program(),
        h("label", { class: "button", title: tr`Or drop it anywhere on this page` }, tr`Open …`, input),
      ),
      this.labelled(
        tr`Set-up`,
        this.select(
          "setup",
          this.files("setup", choice.setup),
          // The title has the whole: the file beside the program.
          dropped ? tr`none` : tr`auto`,
          choice.setup,
        ),
        h(
          "button",
          { dataTest: "edit-set-up", title: tr`Work offset, tools, stock`, onclick: () => this.edit() },
          tr`Edit …`,
        ),
      ),
      this.labelled(
        tr`Control`,
        this.select("control", CONTROLS, tr`automatic`, choice.control),
        // In one row with it, so that the readout stays in sight on small screens.
        this.select("optional", [["off", tr`skip / blocks`]], tr`run / blocks`, choice.optional),
      ),
    );
  }

  /** Reads a file of this computer. */
  async take(file: File | undefined): Promise<void> {
    if (!file) return;
    if (file.size > MOST_BYTES) {
      this.app.fail(
        new Refusal(
          "dropped-file",
          tr`${file.name} is larger than 60 MB`,
          tr`Put it into the project folder and choose it there, or simulate it with \`trueaxis simulate\`.`,
        ),
      );
      return;
    }
    const text = await file.text();
    if (text.includes("\0")) {
      this.app.fail(
        new Refusal(
          "dropped-file",
          tr`${file.name} is not a text`,
          tr`Drop an NC program as the control reads it (SINUMERIK, FANUC, LinuxCNC or HEIDENHAIN Klartext).`,
        ),
      );
      return;
    }
    // The same file again may be a later text of it.
    const fresh = this.dropped?.name === file.name ? {} : OF_PROGRAM;
    this.pick({ ...this.choice, ...fresh, program: null }, { name: file.name, text });
  }

  private labelled(title: string, ...parts: HTMLElement[]): HTMLElement {
    return h("div", { class: "choice" }, h("span", { class: "muted" }, title), parts);
  }

  private files(kind: FileKind, chosen: string | null): [string, string][] {
    const paths = this.app.state.project?.files.filter((f) => f.kind === kind).map((f) => f.path) ?? [];
    return [...new Set([...(chosen ? [chosen] : []), ...paths])].map((path) => [path, shortName(path)]);
  }

  private program(): HTMLElement {
    const files = this.files("program", this.choice.program);
    if (!this.dropped) return this.select("program", files, tr`choose a program`, this.choice.program);
    return this.select("program", files, tr`${this.dropped.name} (of this computer)`, null);
  }

  private select(
    key: keyof Choice,
    options: readonly (readonly [string, string])[],
    none: string,
    value: string | null,
  ): HTMLElement {
    const titles: Record<keyof Choice, string> = {
      machine: tr`Machine file`,
      program: tr`NC program`,
      setup: tr`Set-up: work offsets, tools, stock; auto: the file of the same name beside the program`,
      control: tr`Whose program it is`,
      optional: tr`Optional blocks, which begin with /: executed, or left out as by the switch of the control`,
    };
    const select = h(
      "select",
      {
        ariaLabel: titles[key],
        title: titles[key],
        dataChoice: key,
        onchange: () => this.changed(key, select.value || null),
      },
      h("option", { value: "", disabled: key === "machine" || key === "program" }, none),
      options.map(([path, word]) => h("option", { value: path }, word)),
    );
    select.value = value ?? "";
    return select;
  }

  private changed(key: keyof Choice, value: string | null): void {
    const fresh = key === "program" ? OF_PROGRAM : {};
    this.pick({ ...this.choice, ...fresh, [key]: value }, key === "program" ? null : this.dropped);
  }
}

/** What tells files apart comes first: machine files are all named alike, programs are not. */
function shortName(path: string): string {
  const [file = path, folder = "", ...rest] = path.split("/").reverse();
  if (file === "machine.toml" && folder) return `${folder}/${file}`;
  const where = [...rest.reverse(), folder].filter(Boolean).join("/");
  return where ? `${file}  –  ${where}` : file;
}

/** The whole tab takes a dropped program. */
export function dropTarget(host: HTMLElement, take: (file: File | undefined) => void): void {
  let depth = 0;
  const over = (on: boolean): void => void host.classList.toggle("drop-here", on);
  host.addEventListener("dragenter", (event) => {
    event.preventDefault();
    depth += 1;
    over(true);
  });
  host.addEventListener("dragover", (event) => event.preventDefault());
  host.addEventListener("dragleave", () => {
    depth -= 1;
    if (depth <= 0) over(false);
  });
  host.addEventListener("drop", (event) => {
    event.preventDefault();
    depth = 0;
    over(false);
    take(event.dataTransfer?.files[0]);
  });
}
