/** Files that an answer made: shown, downloaded, saved in the project. Nothing is on a disk before that. */

import { tr } from "../../words/index.ts";
import type { ServeCompensateTables } from "../../../types.d.ts";
import type { App } from "../../app.ts";
import { Refusal } from "../../api.ts";
import { download, fill, h } from "../../dom.ts";
import { bytes } from "../../format.ts";
import { refusalWords } from "./words.ts";

export type Made = ServeCompensateTables["made"];
export type MadeFile = Made["files"][number];

export function baseName(path: string): string {
  return path.replace(/^.*\//, "");
}

/** The file as the server made it, byte for byte. */
export async function fetchMade(made: Made, index: number): Promise<Blob> {
  const response = await fetch(`made/${made.number}/${index}`);
  if (!response.ok)
    throw new Refusal("gone", tr`this file is not kept any more`, tr`Ask for it again: the last few files are kept.`);
  return response.blob();
}

export function downloadButton(app: App, made: Made, index: number): HTMLElement {
  const file = made.files[index];
  const name = baseName(file?.name ?? "");
  const give = (): void => {
    fetchMade(made, index).then(
      (blob) => download(name, blob),
      (error: unknown) => app.fail(error),
    );
  };
  return h("button", { ariaLabel: tr`Download ${name}`, onclick: give }, tr`Download`);
}

/** Name and button by which a file goes into the project folder; what is there already is not replaced. */
export function saveForm(app: App, made: Made, index: number, saved: (path: string) => void): HTMLElement {
  const file = made.files[index];
  const said = h("p", { class: "note", role: "status", dataTest: "saved" });
  const name = h("input", {
    type: "text",
    class: "short",
    value: file?.name ?? "",
    ariaLabel: tr`Name of the file in the project folder`,
    dataTest: "save-name",
  });
  const save = async (): Promise<void> => {
    const path = name.value.trim();
    try {
      await app.api.ask("save-made", { made: made.number, file: index, path, window: app.api.window });
      fill(said, tr`Saved as ${path}.`);
      said.classList.remove("unsound");
      await app.loadProject();
      saved(path);
    } catch (error) {
      const refusal = Refusal.from(error);
      fill(said, refusalWords(refusal));
      said.classList.add("unsound");
    }
  };
  return h(
    "form",
    {
      class: "save-form",
      onsubmit: (event: Event) => {
        event.preventDefault();
        void save();
      },
    },
    h("label", { class: "field grow" }, h("span", {}, tr`Name`), name),
    h("button", { type: "submit", dataTest: "save" }, tr`Save in the project`),
    said,
  );
}

/** Every file with its beginning. */
export function filesPanel(app: App, made: Made, title: string, words: string): HTMLElement {
  const line = (file: MadeFile, i: number): HTMLElement =>
    h(
      "div",
      { class: "program-line", dataMade: file.name },
      h(
        "details",
        {},
        h("summary", {}, h("code", {}, baseName(file.name)), h("span", { class: "muted" }, `  ${bytes(file.bytes)}`)),
        h("pre", { class: "program", tabindex: "0" }, file.beginning),
        file.whole ? null : h("p", { class: "muted note" }, tr`The beginning; the download has all of it.`),
      ),
      downloadButton(app, made, i),
    );
  return h("section", { class: "panel" }, h("h2", {}, title), h("p", { class: "muted" }, words), made.files.map(line));
}
