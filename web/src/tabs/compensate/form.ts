/** What is compensated, for which machine, with which options. */

import { tr, trText } from "../../words/index.ts";
import type { App } from "../../app.ts";
import type { FileKind } from "../../api.ts";
import { h, type Child } from "../../dom.ts";
import { fileSelect } from "../measure/ask.ts";
import { CONTROLS } from "../../controls.ts";
import { KINDS, type Choice, type Of } from "./documents.ts";

export interface Target {
  key: string;
  title: string;
}

interface Option {
  key: string;
  of: readonly Of[];
  words: string;
  hint: string;
}

const OPTIONS: readonly Option[] = [
  {
    key: "flat",
    of: ["program"],
    words: tr`unroll loops and subprograms first`,
    hint: tr`--flat: loops, subprograms, repeated parts and computed numbers become one flat program`,
  },
  {
    key: "position-only",
    of: ["program"],
    words: tr`tip only`,
    hint: tr`--position-only: only the tip is corrected, with the linear axes`,
  },
  {
    key: "keep-unproved",
    of: ["program"],
    words: tr`also a program that is not proved`,
    hint: tr`--keep-unproved: it is marked in its heading, and has another name`,
  },
  {
    key: "no-kinematics",
    of: ["tables"],
    words: tr`tables only, no kinematic parameters`,
    hint: tr`--no-kinematics: rotary centres and tilts are left to the tables`,
  },
  {
    key: "machine-only",
    of: ["program", "tables", "values"],
    words: tr`machine alone, without a part`,
    hint: tr`--machine-only: although the workpiece grows and its temperature is not given`,
  },
];

function select(
  label: string,
  test: string,
  options: readonly (readonly [string, string])[],
  now: string,
  choose: (value: string) => void,
): HTMLElement {
  const element = h(
    "select",
    { ariaLabel: label, dataTest: test, onchange: () => choose(element.value) },
    options.map(([value, text]) => h("option", { value }, text)),
  );
  element.value = now;
  return h("label", { class: "field" }, h("span", {}, label), element);
}

function input(
  label: string,
  test: string,
  now: string,
  placeholder: string,
  choose: (value: string) => void,
): HTMLElement {
  const element = h("input", {
    type: "text",
    class: "short",
    value: now,
    placeholder,
    ariaLabel: label,
    dataTest: test,
    onchange: () => choose(element.value.trim()),
  });
  return h("label", { class: "field" }, h("span", {}, label), element);
}

/** A file of a kind, with its label before it. */
function file(
  app: App,
  label: string,
  test: string,
  kinds: readonly FileKind[],
  now: string | null,
  choose: (path: string) => void,
): HTMLElement {
  const element = fileSelect(app, label, "none", (one) => kinds.includes(one.kind), now, choose);
  element.dataset.test = test;
  return h("label", { class: "field grow" }, h("span", {}, label), element);
}

function optionBoxes(choice: Choice, go: (change: Partial<Choice>) => void): HTMLElement {
  const toggled = (key: string): string[] =>
    choice.options.includes(key) ? choice.options.filter((one) => one !== key) : [...choice.options, key];
  const shown = OPTIONS.filter((option) => option.of.includes(choice.of));
  return h(
    "div",
    { class: "row compensate-options" },
    shown.map(({ key, words, hint }) =>
      h(
        "label",
        { class: "check", title: hint },
        h("input", {
          type: "checkbox",
          checked: choice.options.includes(key),
          dataOption: key,
          onchange: () => go({ options: toggled(key) }),
        }),
        words,
      ),
    ),
  );
}

function programFields(app: App, choice: Choice, go: (change: Partial<Choice>) => void): Child {
  const setups = (app.state.project?.files ?? []).filter((one) => one.kind === "setup").map((one) => one.path);
  const setup = [...new Set([...(choice.setup ? [choice.setup] : []), ...setups])];
  return [
    h(
      "div",
      { class: "row" },
      // The set-up and the control of one program are not those of another.
      file(app, tr`Program`, "program", ["program"], choice.program, (program) =>
        go({ program, setup: null, control: null }),
      ),
    ),
    h(
      "div",
      { class: "row" },
      select(
        tr`Set-up`,
        "setup",
        [["", tr`beside the program`], ...setup.map((path): [string, string] => [path, path])],
        choice.setup ?? "",
        (value) => go({ setup: value || null }),
      ),
      select(tr`Control`, "control", [["", tr`automatic`], ...CONTROLS], choice.control ?? "", (value) =>
        go({ control: value || null }),
      ),
      input(tr`Residual`, "residual", choice.residual, "1 um", (residual) => go({ residual })),
    ),
  ];
}

function tablesFields(targets: readonly Target[], choice: Choice, go: (change: Partial<Choice>) => void): Child {
  return h(
    "div",
    { class: "row" },
    select(
      tr`Control`,
      "target",
      targets.map(({ key, title }): [string, string] => [key, trText(title)]),
      choice.target,
      (target) => go({ target }),
    ),
    input(tr`Other axes at`, "at", choice.at, tr`middle of the travels`, (at) => go({ at })),
  );
}

function valuesFields(axes: readonly string[], choice: Choice, go: (change: Partial<Choice>) => void): Child {
  return h(
    "div",
    { class: "row" },
    select(
      tr`Axis`,
      "axis",
      axes.map((name): [string, string] => [name, name]),
      choice.axis,
      (axis) => go({ axis, step: "" }),
    ),
    input(tr`Step, mm or °`, "step", choice.step, tr`100 mm or 10°`, (step) => go({ step })),
    input(tr`Other axes at`, "at", choice.at, "0", (at) => go({ at })),
  );
}

/** The form; every change goes into the address. */
export function formRows(
  app: App,
  choice: Choice,
  known: { targets: readonly Target[]; axes: readonly string[] },
  go: (change: Partial<Choice>) => void,
): HTMLElement[] {
  const kinds = h(
    "div",
    { class: "group", role: "group", ariaLabel: tr`What is compensated` },
    KINDS.map(([of, title]) =>
      h("button", { ariaPressed: String(choice.of === of), dataOf: of, onclick: () => go({ of }) }, title),
    ),
  );
  const rows: Child[] = [h("div", { class: "row" }, kinds)];
  if (choice.of === "blank")
    rows.push(
      h(
        "div",
        { class: "row" },
        file(app, tr`Study`, "study", ["blank"], choice.study, (study) => go({ study })),
        select(tr`Program for`, "control", [["", tr`no program`], ...CONTROLS], choice.control ?? "", (value) =>
          go({ control: value || null }),
        ),
      ),
    );
  else {
    rows.push(
      h(
        "div",
        { class: "row" },
        // Axes and positions of one machine are not those of another.
        file(app, tr`Machine`, "machine", ["machine"], choice.machine, (machine) =>
          go({ machine, at: "", axis: "", step: "" }),
        ),
      ),
    );
    if (choice.of === "program") rows.push(programFields(app, choice, go));
    if (choice.of === "tables") rows.push(tablesFields(known.targets, choice, go));
    if (choice.of === "values") rows.push(valuesFields(known.axes, choice, go));
    rows.push(
      h(
        "div",
        { class: "row" },
        input(
          tr`Temperatures`,
          "temperature",
          choice.temperature,
          tr`scale_x=30.5 workpiece=30.5, in °C`,
          (temperature) => go({ temperature }),
        ),
      ),
      optionBoxes(choice, go),
    );
  }
  return [h("div", { class: "compensate-form" }, rows)];
}
