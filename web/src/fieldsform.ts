/** A form of text fields in groups, for a small TOML file. */

import { h, type Child } from "./dom.ts";
import type { FileForm } from "./filedialog.ts";
import { nameOf, tomlOf, wrongField, type Field, type Values } from "./toml.ts";

export interface Group {
  title: string;
  fields: readonly Field[];
}

/** `values` are filled in; `comment` is the first line of the file. */
export function fieldsForm(comment: string, note: Child, groups: readonly Group[], values: Values = {}): FileForm {
  const typed: Values = { ...values };
  const input = (field: Field): HTMLElement => {
    const name = nameOf(field);
    const box = h("input", {
      type: "text",
      value: typed[name] ?? "",
      placeholder: field.example,
      dataField: name,
      oninput: () => {
        typed[name] = box.value;
        check();
        box.setAttribute("aria-invalid", String(box.dataset.wrong !== undefined));
      },
    });
    const check = (): void => {
      const wrong = wrongField(field, box.value);
      if (wrong) box.dataset.wrong = wrong;
      else delete box.dataset.wrong;
    };
    check();
    return h("label", {}, h("span", { class: "muted" }, field.label), box);
  };
  return {
    element: h(
      "div",
      {},
      h("p", { class: "muted" }, note),
      groups.map(({ title, fields }) =>
        h("fieldset", {}, h("legend", {}, title), h("div", { class: "file-dialog-fields" }, fields.map(input))),
      ),
    ),
    text: () =>
      tomlOf(
        comment,
        groups.flatMap((group) => group.fields),
        typed,
      ),
  };
}
