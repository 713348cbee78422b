/** A machine of one's own by a few questions: chain, travels, signs. */

import { tr } from "../../words/index.ts";
import type { App } from "../../app.ts";
import { fill, h, s } from "../../dom.ts";
import { FileDialog, type FileForm } from "../../filedialog.ts";
import { machineRequest, wrongAnswers, type AxisAnswer, type MachineAnswers } from "./answers.ts";

interface Kind {
  key: string;
  title: string;
  /** Such as. */
  such: string;
  tilting: "A" | "B" | null;
  workpiece: readonly string[];
  /** Rotary axes that carry the workpiece. */
  table: readonly string[];
  /** Parts of its picture: x, y, width, height. */
  boxes: readonly (readonly [x: number, y: number, width: number, height: number, of: "table" | "tool" | "bed"])[];
  /** Its arrows of rotation: centre. */
  turns: readonly (readonly [x: number, y: number, of: "table" | "tool"])[];
}

const KINDS: readonly Kind[] = [
  {
    key: "three-axis",
    title: tr`X, Y and Z alone`,
    such: tr`milling machines, milling tables`,
    tilting: null,
    workpiece: ["X", "Y"],
    table: [],
    boxes: [
      [8, 60, 84, 8, "bed"],
      [80, 10, 12, 50, "bed"],
      [22, 48, 46, 8, "table"],
      [38, 12, 14, 22, "tool"],
      [43, 34, 4, 9, "tool"],
    ],
    turns: [],
  },
  {
    key: "table-table",
    title: tr`Both rotary axes carry the workpiece`,
    such: tr`tilting rotary table, trunnion`,
    tilting: "A",
    workpiece: [],
    table: ["tilting", "C"],
    boxes: [
      [8, 60, 84, 8, "bed"],
      [80, 10, 12, 50, "bed"],
      [14, 40, 6, 20, "bed"],
      [70, 40, 6, 20, "bed"],
      [20, 48, 50, 7, "table"],
      [38, 12, 14, 20, "tool"],
      [43, 32, 4, 8, "tool"],
    ],
    turns: [
      [45, 47, "table"],
      [17, 48, "table"],
    ],
  },
  {
    key: "head-head",
    title: tr`Both carry the tool`,
    such: tr`fork head, gantries`,
    tilting: "A",
    workpiece: [],
    table: [],
    boxes: [
      [8, 62, 84, 6, "bed"],
      [8, 6, 6, 56, "bed"],
      [86, 6, 6, 56, "bed"],
      [8, 6, 84, 6, "bed"],
      [24, 54, 52, 6, "table"],
      [42, 12, 16, 16, "tool"],
      [45, 28, 10, 12, "tool"],
      [48, 40, 4, 8, "tool"],
    ],
    turns: [
      [50, 26, "tool"],
      [60, 34, "tool"],
    ],
  },
  {
    key: "head-table",
    title: tr`One each`,
    such: tr`rotary table and swivelling head`,
    tilting: "B",
    workpiece: [],
    table: ["C"],
    boxes: [
      [8, 60, 84, 8, "bed"],
      [80, 10, 12, 50, "bed"],
      [22, 50, 46, 8, "table"],
      [52, 16, 28, 10, "tool"],
      [40, 14, 13, 22, "tool"],
      [44, 36, 4, 8, "tool"],
    ],
    turns: [
      [45, 48, "table"],
      [46, 24, "tool"],
    ],
  },
];

function picture(kind: Kind): SVGElement {
  const turn = ([x, y, of]: Kind["turns"][number]): SVGElement =>
    s("path", {
      class: `turn ${of}`,
      d: `M ${x - 7} ${y} a 7 3.2 0 1 1 14 0 m -3 -3 l 3 3.4 l 3.4 -2.6`,
      fill: "none",
    });
  return s(
    "svg",
    { class: "machine-kind", viewBox: "0 0 100 72", role: "img", "aria-label": kind.title },
    kind.boxes.map(([x, y, width, height, of]) => s("rect", { class: of, x, y, width, height, rx: 1 })),
    kind.turns.map(turn),
  );
}

const USUAL: Record<string, AxisAnswer> = {
  X: { from: "-300", to: "300", unlimited: false, reversed: false },
  Y: { from: "-200", to: "200", unlimited: false, reversed: false },
  Z: { from: "-480", to: "2", unlimited: false, reversed: false },
  A: { from: "-110", to: "110", unlimited: false, reversed: false },
  B: { from: "-110", to: "110", unlimited: false, reversed: false },
  C: { from: "-360", to: "360", unlimited: true, reversed: false },
};

class Questions implements FileForm {
  readonly element = h("div", { class: "new-machine" });
  private readonly app: App;
  private kind = KINDS[1] as Kind;
  readonly answers: MachineAnswers;
  private readonly more = h("div", {});
  private readonly wrong = h("p", {
    class: "columns-wrong",
    role: "status",
    tabindex: "-1",
    dataTest: "new-machine-wrong",
  });

  constructor(app: App) {
    this.app = app;
    const axes = Object.fromEntries(Object.entries(USUAL).map(([axis, usual]) => [axis, { ...usual }]));
    this.answers = {
      kind: this.kind.key,
      name: "my machine",
      workpiece: [],
      tilting: this.kind.tilting,
      height: "",
      axes,
    };
    fill(this.element, this.kinds(), this.more, this.wrong);
    this.draw();
  }

  /** Below the project folder. */
  path(): string {
    const plain = this.answers.name
      .trim()
      .toLowerCase()
      .replace(/[^\p{L}\p{N}]+/gu, "-")
      .replace(/^-|-$/g, "");
    return `machines/${plain || "machine"}/machine.toml`;
  }

  async text(): Promise<string> {
    return (await this.app.api.ask("new-machine", machineRequest(this.answers, this.names()))).text;
  }

  /** The axes of the kind, linear ones first. */
  private names(): string[] {
    const { tilting } = this.answers;
    return ["X", "Y", "Z", ...(tilting ? ["C", tilting] : [])];
  }

  private kinds(): HTMLElement {
    return h(
      "fieldset",
      {},
      h("legend", {}, tr`What do the rotary axes carry?`),
      h(
        "div",
        { class: "machine-kinds" },
        KINDS.map((kind) => {
          const box = h("input", {
            type: "radio",
            name: "machine-kind",
            value: kind.key,
            checked: kind === this.kind,
            onchange: () => this.choose(kind),
          });
          return h(
            "label",
            { class: "machine-kind-card" },
            box,
            picture(kind),
            h("strong", {}, kind.title),
            h("span", { class: "muted" }, kind.such),
          );
        }),
      ),
    );
  }

  private choose(kind: Kind): void {
    this.kind = kind;
    Object.assign(this.answers, { kind: kind.key, tilting: kind.tilting, workpiece: [...kind.workpiece] });
    // The cables of a fork head wind up.
    const { C } = this.answers.axes;
    if (C) C.unlimited = kind.key !== "head-head";
    this.draw();
  }

  private check(): void {
    const wrong = wrongAnswers(this.answers, this.names());
    this.wrong.textContent = wrong ?? "";
    if (wrong) this.wrong.dataset.wrong = wrong;
    else delete this.wrong.dataset.wrong;
  }

  private draw(): void {
    const { answers } = this;
    const text = (
      label: string,
      value: string,
      take: (typed: string) => void,
      size: string,
      name: string,
    ): HTMLElement => {
      const box = h("input", {
        type: "text",
        size,
        value,
        dataField: name,
        oninput: () => {
          take(box.value);
          this.check();
        },
      });
      return h("label", {}, h("span", { class: "muted" }, label), box);
    };
    fill(
      this.more,
      h(
        "fieldset",
        {},
        h("legend", {}, tr`Name, and what moves`),
        h(
          "div",
          { class: "file-dialog-fields" },
          text(tr`Name of the machine`, answers.name, (typed) => (answers.name = typed), "28", "name"),
          this.tilting(),
          text(this.heightLabel(), answers.height, (typed) => (answers.height = typed), "10", "height"),
          this.carried(),
        ),
      ),
      h(
        "fieldset",
        {},
        h("legend", {}, tr`Travels: the software limits of the control; and signs`),
        h(
          "div",
          { class: "machine-axes" },
          this.names().map((axis) => this.axis(axis)),
        ),
        h(
          "p",
          { class: "muted" },
          tr`Signs: jog each axis to plus and look at the machine. By ISO 841 the tool moves to plus as seen from the workpiece; a table that carries the workpiece therefore moves to minus, and a rotary table turns clockwise, seen from above.`,
        ),
      ),
    );
    this.check();
  }

  /** What the template measures Z from. */
  private heightLabel(): string {
    const { tilting } = this.answers;
    if (!tilting) return tr`Spindle gauge line above the table at Z = 0, mm`;
    return this.kind.table.includes("tilting")
      ? tr`Spindle gauge line above the place where ${tilting} and C meet at Z = 0, mm`
      : tr`Axis of ${tilting} above the table at Z = 0, mm`;
  }

  private tilting(): HTMLElement | null {
    const { answers } = this;
    if (!this.kind.tilting) return null;
    const select = h(
      "select",
      {
        dataField: "tilting",
        onchange: () => {
          answers.tilting = select.value as "A" | "B";
          this.draw();
        },
      },
      h("option", { value: "A" }, tr`A, about X`),
      h("option", { value: "B" }, tr`B, about Y`),
    );
    select.value = answers.tilting ?? this.kind.tilting;
    return h("label", {}, h("span", { class: "muted" }, tr`The axis that tilts`), select);
  }

  private carried(): HTMLElement {
    const { answers } = this;
    return h(
      "div",
      { role: "group", ariaLabel: tr`Linear axes that move the table` },
      h("span", { class: "muted" }, tr`Linear axes that move the table`),
      h(
        "div",
        { class: "row" },
        ["X", "Y", "Z"].map((axis) => {
          const box = h("input", {
            type: "checkbox",
            checked: answers.workpiece.includes(axis),
            dataField: `workpiece-${axis}`,
            onchange: () => {
              answers.workpiece = answers.workpiece.filter((other) => other !== axis);
              if (box.checked) answers.workpiece.push(axis);
              this.draw();
            },
          });
          return h("label", {}, box, ` ${axis}`);
        }),
      ),
    );
  }

  private axis(name: string): HTMLElement {
    const answer = this.answers.axes[name] as AxisAnswer;
    const is_rotary = !"XYZ".includes(name);
    const ends = (["from", "to"] as const).map((end) => {
      const box = h("input", {
        type: "text",
        inputmode: "decimal",
        size: "7",
        value: answer[end],
        disabled: answer.unlimited,
        ariaLabel: end === "from" ? tr`${name} from` : tr`${name} to`,
        dataField: `${name}-${end}`,
        oninput: () => {
          answer[end] = box.value;
          this.check();
        },
      });
      return box;
    });
    const around = h("input", {
      type: "checkbox",
      checked: answer.unlimited,
      dataField: `${name}-unlimited`,
      onchange: () => {
        answer.unlimited = around.checked;
        for (const box of ends) box.disabled = answer.unlimited;
        this.check();
      },
    });
    const sign = h(
      "select",
      {
        ariaLabel: tr`Sign of ${name}`,
        dataField: `${name}-sign`,
        onchange: () => (answer.reversed = sign.value === "other"),
      },
      h("option", { value: "iso" }, this.plus(name, false)),
      h("option", { value: "other" }, this.plus(name, true)),
    );
    sign.value = answer.reversed ? "other" : "iso";
    return h(
      "div",
      { class: "machine-axis" },
      h("strong", {}, name),
      h("span", {}, ends[0], tr` to `, ends[1], is_rotary ? " deg" : " mm"),
      h("span", {}, is_rotary ? h("label", {}, around, tr` unlimited`) : null),
      h("label", {}, h("span", { class: "muted" }, `+${name}: `), sign),
    );
  }

  /** What plus does, seen on the machine. */
  private plus(axis: string, other: boolean): string {
    const tilting = axis === this.answers.tilting;
    const on_table = this.answers.workpiece.includes(axis) || this.kind.table.includes(tilting ? "tilting" : axis);
    const words = "XYZ".includes(axis) ? slides(axis, on_table, on_table === other) : turns(axis, on_table, other);
    return other ? words : `${words} (ISO 841)`;
  }
}

function slides(axis: string, table: boolean, plus: boolean): string {
  if (table) return plus ? tr`the table moves to plus ${axis}` : tr`the table moves to minus ${axis}`;
  return plus ? tr`the tool moves to plus ${axis}` : tr`the tool moves to minus ${axis}`;
}

function turns(axis: string, table: boolean, other: boolean): string {
  const about = axis === "C" ? "Z" : axis === "A" ? "X" : "Y";
  if (table)
    return other
      ? tr`the table turns counter-clockwise, seen from +${about}`
      : tr`the table turns clockwise, seen from +${about}`;
  return other
    ? tr`the tool turns clockwise, seen from +${about}`
    : tr`the tool turns counter-clockwise, seen from +${about}`;
}

/** Asks, saves, and shows the new machine. */
export function newMachine(app: App): void {
  const dialog = new FileDialog(app, "new-machine", tr`A machine of my own`, tr`Save and show`);
  const questions = new Questions(app);
  dialog.element.addEventListener("close", () => dialog.element.remove());
  void dialog.open({
    title: tr`A machine of my own`,
    path: () => questions.path(),
    form: () => questions,
    saved: (path) => app.go("describe", { machine: path }),
  });
}
