/** A dropped file of readings as files of the project, with what was stated of it. */

import { tr } from "../../words/index.ts";
import type { App } from "../../app.ts";
import { Refusal } from "../../api.ts";
import { FileDialog, type FileForm } from "../../filedialog.ts";
import { h } from "../../dom.ts";
import type { TextFile } from "../measure/drop.ts";

/** Asks for a name and saves; its path, or null if nothing was saved. Nothing is replaced. */
export function keepInProject(
  app: App,
  readings: TextFile,
  stated: { mapping: string | null; stated: string | null },
): Promise<string | null> {
  const dialog = new FileDialog(app, "keep", tr`Save the readings in the project`, tr`Save`);
  const plain = readings.name.replace(/\.[^.]*$/, "").replace(/[^\p{L}\p{N}._-]+/gu, "-");
  let path = `${plain || "readings"}.csv`;
  const form: FileForm = {
    element: h(
      "div",
      { class: "file-dialog-fields" },
      h(
        "label",
        {},
        h("span", { class: "muted" }, tr`Name of the file, below the project folder`),
        nameBox(path, (typed) => (path = typed)),
      ),
    ),
    text: () => path,
  };
  const save = (name: string, text: string): Promise<unknown> =>
    app.api.ask("save", { path: name, text, version: null, make_folder: true, window: app.api.window });
  return new Promise((resolve) => {
    let done: string | null = null;
    dialog.element.addEventListener("close", () => {
      dialog.element.remove();
      resolve(done);
    });
    void dialog.open({
      title: tr`Save the readings in the project`,
      path,
      form: () => form,
      kept: {
        text: null,
        where: tr`with the columns and conditions that were stated; nothing is replaced`,
        keep: async () => {
          const beside = path.replace(/\.csv$/i, "");
          // All or nothing: a file of this name beside the readings would count for them.
          for (const ending of [".csv", ".map.toml", ".toml"]) {
            const name = ending === ".csv" ? path : `${beside}${ending}`;
            if (await isThere(app, name))
              throw new Refusal(
                "conflict",
                tr`${name} is there already`,
                tr`save under another name: nothing is replaced`,
              );
          }
          // The readings are saved as UTF-8, whatever they were.
          const mapping = stated.mapping?.replace(/^encoding\s*=.*$/m, "") ?? null;
          // The readings come last: an interrupted save leaves no table without its columns.
          if (mapping !== null) await save(`${beside}.map.toml`, mapping);
          if (stated.stated !== null) await save(`${beside}.toml`, stated.stated);
          await save(path, readings.text);
          await app.loadProject();
          done = path;
        },
      },
      saved: () => undefined,
    });
  });
}

async function isThere(app: App, path: string): Promise<boolean> {
  try {
    await app.api.ask("open", { path });
    return true;
  } catch (error) {
    if (error instanceof Refusal && error.code === "unreadable-file") return false;
    throw error;
  }
}

function nameBox(value: string, take: (typed: string) => void): HTMLInputElement {
  const box = h("input", {
    type: "text",
    size: "48",
    value,
    dataField: "name",
    oninput: () => {
      const isCsv = /\.csv$/i.test(box.value.trim());
      if (isCsv) delete box.dataset.wrong;
      else box.dataset.wrong = tr`the name ends in .csv`;
      take(box.value.trim());
    },
  });
  return box;
}
