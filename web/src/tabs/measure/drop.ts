/** Readings dropped anywhere on a tab, or chosen with a button. The file stays on this computer. */

import type { App } from "../../app.ts";
import { Refusal } from "../../api.ts";
import { h } from "../../dom.ts";
import { bytes } from "../../format.ts";

export interface TextFile {
  name: string;
  text: string;
}

/** Readings are tables of a few thousand rows; what is larger than this is something else. */
const MOST_BYTES = 32e6;

async function read(file: File): Promise<TextFile> {
  if (file.size > MOST_BYTES)
    throw new Refusal(
      "large-file",
      `${file.name} has ${bytes(file.size)}: too much for readings`,
      `Drop a CSV of at most ${bytes(MOST_BYTES)}, or put the file into the project folder.`,
    );
  try {
    return { name: file.name, text: new TextDecoder("utf-8", { fatal: true }).decode(await file.arrayBuffer()) };
  } catch {
    throw new Refusal(
      "not-text",
      `${file.name} is not a text file (UTF-8)`,
      "Save the readings as CSV UTF-8: one line of headings, each with its unit, then one row for each reading.",
    );
  }
}

/** Makes `host` take a dropped file; returns the button that opens one. */
export function dropOn(host: HTMLElement, app: App, label: string, take: (file: TextFile) => void): HTMLElement {
  const taken = (file: File | undefined): void => {
    if (file) read(file).then(take, (error: unknown) => app.fail(error));
  };
  const input = h("input", {
    type: "file",
    class: "drop-input",
    ariaLabel: label,
    onchange: () => {
      taken(input.files?.[0]);
      input.value = "";
    },
  });
  const over = (event: DragEvent, on: boolean): void => {
    event.preventDefault();
    host.classList.toggle("drop-over", on);
  };
  host.addEventListener("dragover", (event) => over(event, true));
  host.addEventListener("dragleave", (event) => over(event, host.contains(event.relatedTarget as Node | null)));
  host.addEventListener("drop", (event) => {
    over(event, false);
    taken(event.dataTransfer?.files[0]);
  });
  return h("label", { class: "button open-file", title: "Or drop the file anywhere on this page" }, label, input);
}

let handed: TextFile | null = null;

/** Readings that were dropped on another tab, for Identify. */
export function handOver(file: TextFile): void {
  handed = file;
}

/** The readings that were handed over, once. */
export function takeHanded(): TextFile | null {
  const file = handed;
  handed = null;
  return file;
}
