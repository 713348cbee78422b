/** Readings dropped anywhere on a tab, or chosen with a button. The file stays on this computer. */

import { tr } from "../../words/index.ts";
import type { App } from "../../app.ts";
import { Refusal } from "../../api.ts";
import { h } from "../../dom.ts";
import type { TextFile } from "../../files.ts";
import { bytes } from "../../format.ts";

export type { TextFile };

/** Readings are tables of a few thousand rows; what is larger than this is something else. */
const MOST_BYTES = 32e6;

/** The bytes in base64. */
async function base64(file: File): Promise<string> {
  const reader = new FileReader();
  const done = new Promise((resolve, reject) => {
    reader.onload = resolve;
    reader.onerror = () => reject(reader.error);
  });
  reader.readAsDataURL(file);
  await done;
  return String(reader.result).replace(/^[^,]*,/, "");
}

/** The text of readings in any usual encoding; what is not UTF-8 is decoded by the server. */
export async function readText(app: App, file: File): Promise<TextFile> {
  const { name } = file;
  if (file.size > MOST_BYTES)
    throw new Refusal(
      "large-file",
      tr`${name} has ${bytes(file.size)}: too much for readings`,
      tr`Drop a CSV of at most ${bytes(MOST_BYTES)}, or put the file into the project folder.`,
    );
  try {
    const text = new TextDecoder("utf-8", { fatal: true }).decode(await file.arrayBuffer());
    // UTF-16 without a mark is UTF-8 with zeros.
    if (!text.includes("\0")) return { name, text };
  } catch {
    // why: another encoding, see below.
  }
  const { text, encoding, is_assumed } = await app.api.ask("readings-text", { base64: await base64(file) });
  return { name, text, ...(is_assumed ? { encoding } : {}) };
}

/** Makes `host` take a dropped file; returns the button that opens one. */
export function dropOn(host: HTMLElement, app: App, label: string, take: (file: TextFile) => void): HTMLElement {
  const taken = (file: File | undefined): void => {
    if (file) readText(app, file).then(take, (error: unknown) => app.fail(error));
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
  return h("label", { class: "button open-file", title: tr`Or drop the file anywhere on this page` }, label, input);
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
