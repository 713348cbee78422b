/** A dropped file of readings as files of the project, with what was stated of it. */

import type { App } from "../../app.ts";
import { FileDialog, type FileForm } from "../../filedialog.ts";
import { h } from "../../dom.ts";
import type { TextFile } from "../measure/drop.ts";

/** Asks for a name and saves; its path, or null if nothing was saved. Nothing is replaced. */
export function keepInProject(
  app: App,
  readings: TextFile,
  stated: { mapping: string | null; stated: string | null },
): Promise<string | null> {
  const dialog = new FileDialog(app, "keep", "Save the readings in the project", "Save");
  const plain = readings.name.replace(/\.[^.]*$/, "").replace(/[^\p{L}\p{N}._-]+/gu, "-");
  let path = `${plain || "readings"}.csv`;
  const form: FileForm = {
    element: h(
      "div",
      { class: "file-dialog-fields" },
      h(
        "label",
        {},
        h("span", { class: "muted" }, "Name of the file, below the project folder"),
        nameBox(path, (typed) => (path = typed)),
      ),
    ),
    text: () => path,
  };
  const save = (name: string, text: string): Promise<unknown> =>
    app.api.ask("save", { path: name, text, version: null, window: app.api.window });
  return new Promise((resolve) => {
    let done: string | null = null;
    dialog.element.addEventListener("close", () => {
      dialog.element.remove();
      resolve(done);
    });
    void dialog.open({
      title: "Save the readings in the project",
      path,
      form: () => form,
      kept: {
        text: null,
        where: "with the columns and conditions that were stated; nothing is replaced",
        keep: async () => {
          const beside = path.replace(/\.csv$/i, "");
          // The readings come last: an interrupted save leaves no table without its columns.
          if (stated.mapping !== null) await save(`${beside}.map.toml`, stated.mapping);
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

function nameBox(value: string, take: (typed: string) => void): HTMLInputElement {
  const box = h("input", {
    type: "text",
    size: "48",
    value,
    dataField: "name",
    oninput: () => {
      const isCsv = /\.csv$/i.test(box.value.trim());
      if (isCsv) delete box.dataset.wrong;
      else box.dataset.wrong = "the name ends in .csv";
      take(box.value.trim());
    },
  });
  return box;
}
