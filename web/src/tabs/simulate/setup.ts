/** Work offset, tools, stock of a program: stated in a form, kept as `PROGRAM.setup.toml`, edited as text from then on. */

import { tr } from "../../words/index.ts";
import type { App } from "../../app.ts";
import { CONTROLS } from "../../controls.ts";
import { fill, h } from "../../dom.ts";
import { FileDialog, type FileForm } from "../../filedialog.ts";
import type { SimulatedAxis } from "./answers.ts";
import { plain, setUpText, wrongNumber, type SetUpForm, type ToolForm } from "./setuptext.ts";

/** What is known of the program. */
export interface SetUpOf {
  /** The program, a file of the project. */
  program: string;
  /** The set-up file that was chosen; null for the one beside the program. */
  setup: string | null;
  control: string | null;
  axes: readonly Pick<SimulatedAxis, "name" | "unit">[];
  /** Numbers of the tools that the program calls. */
  tools: readonly number[];
}

const NAMES = ["", ...CONTROLS.map(([name]) => name)];
const OFFSETS = ["G54", "G55", "G56", "G57", "G58", "G59"];

/** The file beside a program that is read with it. */
export const besideOf = (program: string): string => `${program.replace(/\.[^./\\]*$/, "")}.setup.toml`;

export class SetUpDialog {
  private readonly dialog: FileDialog;
  private readonly saved: (path: string) => void;

  constructor(app: App, saved: (path: string) => void) {
    this.dialog = new FileDialog(app, "set-up", tr`Set-up`, tr`Save and simulate`);
    this.saved = saved;
  }

  get element(): HTMLElement {
    return this.dialog.element;
  }

  /** Shows the file as it is, or a form for a new one. */
  async open(of: SetUpOf): Promise<void> {
    await this.dialog.open({
      title: [tr`Set-up of `, h("code", {}, of.program.replace(/^.*[\\/]/, ""))],
      path: of.setup ?? besideOf(of.program),
      form: (text) => (text === null ? setUpForm(of) : null),
      saved: this.saved,
    });
  }
}

function setUpForm(of: SetUpOf): FileForm {
  const empty = (): Record<string, { value: string; unit: string }> =>
    Object.fromEntries(of.axes.map(({ name, unit }) => [name, { value: "", unit }]));
  const form: SetUpForm = {
    program: of.program.replace(/^.*[\\/]/, ""),
    control: of.control ?? "",
    offset: "G54",
    positions: empty(),
    start: empty(),
    tools: (of.tools.length > 0 ? of.tools : [1]).map((number) => newTool(String(number))),
    stock: { edges: ["", "", ""], centre: ["", "", ""] },
    fixtures: [{ file: "", placement: "" }],
  };
  const element = h("div", {});
  const draw = (): void =>
    fill(
      element,
      h(
        "p",
        { class: "muted" },
        tr`What is not known may stay empty: it counts as 0. Lengths in mm, angles in degrees.`,
      ),
      h("div", { class: "file-dialog-fields" }, choice(tr`Control`, NAMES, form, "control", tr`automatic`)),
      h(
        "fieldset",
        {},
        h("legend", {}, tr`Program zero: machine coordinates of the spindle gauge line there, rotary axes at 0`),
        choice(tr`Work offset`, OFFSETS, form, "offset", ""),
        axisFields(form.positions, (axis) => tr`${axis} at program zero`),
      ),
      h(
        "fieldset",
        {},
        h("legend", {}, tr`Tools`),
        toolTable(form.tools),
        h(
          "button",
          {
            type: "button",
            onclick: () => {
              form.tools.push(newTool(String(form.tools.length + 1)));
              draw();
            },
          },
          tr`Add a tool`,
        ),
      ),
      h(
        "details",
        {},
        h("summary", {}, tr`Stock, fixture, start`),
        h(
          "fieldset",
          {},
          h("legend", {}, tr`Stock: a box in the workpiece frame`),
          triple(form.stock.edges, [tr`length X`, tr`width Y`, tr`height Z`], 0),
          triple(form.stock.centre, [tr`centre X`, tr`centre Y`, tr`centre Z`]),
        ),
        h(
          "fieldset",
          {},
          h("legend", {}, tr`Fixture`),
          form.fixtures.map((fixture) => [
            field(tr`STL file beside the program`, fixture.file, (v) => (fixture.file = v), "vice.stl"),
            field(tr`placed at x y z, mm`, fixture.placement, (v) => (fixture.placement = v), "0 0 -40"),
          ]),
        ),
        h(
          "fieldset",
          {},
          h("legend", {}, tr`Where the axes stand before the program`),
          axisFields(form.start, (axis) => tr`${axis} start`),
        ),
      ),
    );
  draw();
  return { element, text: () => setUpText(form) };
}

function choice(
  title: string,
  options: readonly string[],
  form: SetUpForm,
  key: "control" | "offset",
  none: string,
): HTMLElement {
  const select = h(
    "select",
    { onchange: () => (form[key] = select.value) },
    options.map((value) => h("option", { value }, value || none)),
  );
  select.value = form[key];
  return h("label", {}, h("span", { class: "muted" }, title), select);
}

const newTool = (number: string): ToolForm => ({
  number,
  name: "",
  length: "",
  diameter: "",
  holder_diameter: "",
  holder_length: "",
});

/** A field that says what is wrong with its number. */
function numberInput(title: string, value: string, take: (value: string) => void, at_least?: number): HTMLInputElement {
  const input = h("input", {
    type: "text",
    inputmode: "decimal",
    size: "7",
    value,
    ariaLabel: title,
    oninput: () => {
      const wrong = wrongNumber(input.value, at_least);
      input.setCustomValidity(wrong ?? "");
      if (wrong) input.dataset.wrong = `${title}: ${wrong}`;
      else delete input.dataset.wrong;
      input.setAttribute("aria-invalid", String(wrong !== null));
      take(plain(input.value));
    },
  });
  return input;
}

function field(title: string, value: string, take: (value: string) => void, example: string): HTMLElement {
  const input = h("input", { type: "text", value, placeholder: example, oninput: () => take(input.value) });
  return h("label", {}, h("span", { class: "muted" }, title), input);
}

function axisFields(values: SetUpForm["positions"], title: (axis: string) => string): HTMLElement {
  return h(
    "div",
    { class: "file-dialog-fields" },
    Object.entries(values).map(([axis, entry]) =>
      h(
        "label",
        {},
        h("span", { class: "muted" }, `${axis}, ${entry.unit}`),
        numberInput(title(axis), entry.value, (value) => (entry.value = value)),
      ),
    ),
  );
}

function triple(values: [string, string, string], titles: readonly string[], at_least?: number): HTMLElement {
  return h(
    "div",
    { class: "file-dialog-fields" },
    titles.map((title, i) =>
      h(
        "label",
        {},
        h("span", { class: "muted" }, tr`${title}, mm`),
        numberInput(title, values[i] ?? "", (value) => (values[i] = value), at_least),
      ),
    ),
  );
}

const COLUMNS: readonly [keyof ToolForm, string, number | undefined][] = [
  ["length", tr`length, mm`, 0],
  ["diameter", tr`diameter, mm`, 0],
  ["holder_diameter", tr`holder diameter, mm`, 0],
  ["holder_length", tr`holder length, mm`, 0],
];

function toolTable(tools: ToolForm[]): HTMLElement {
  return h(
    "table",
    { class: "set-up-tools" },
    h(
      "thead",
      {},
      h(
        "tr",
        {},
        h("th", {}, "T"),
        h("th", {}, tr`name`),
        COLUMNS.map(([, title]) => h("th", {}, title)),
      ),
    ),
    h(
      "tbody",
      {},
      tools.map((tool) => {
        const name = h("input", {
          type: "text",
          size: "14",
          value: tool.name,
          ariaLabel: tr`Name of T${tool.number}`,
          oninput: () => (tool.name = name.value),
        });
        return h(
          "tr",
          {},
          h(
            "td",
            {},
            numberInput(tr`Number of the tool`, tool.number, (value) => (tool.number = value), -1),
          ),
          h("td", {}, name),
          COLUMNS.map(([key, title, at_least]) =>
            h(
              "td",
              {},
              numberInput(`T${tool.number} ${title}`, tool[key], (value) => (tool[key] = value), at_least),
            ),
          ),
        );
      }),
    ),
  );
}
