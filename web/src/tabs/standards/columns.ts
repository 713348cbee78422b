/** What the columns of a table are: chosen for each, with its first values in sight. */

import { tr, trText } from "../../words/index.ts";
import type { ServeReadingsColumns, StandardEntry } from "../../../types.d.ts";
import type { App } from "../../app.ts";
import { fill, h } from "../../dom.ts";
import type { FileForm } from "../../filedialog.ts";
import { mappingText, roles, wrongColumns, type MappedColumn, type MappedTable } from "./mappingtext.ts";

type Table = NonNullable<ServeReadingsColumns["table"]>;
type Column = StandardEntry["columns"][number];

/** Where the readings are. */
export interface ReadingsOf {
  name: string;
  /** A file of the project; else `text`. */
  path: string | null;
  text: string | null;
}

const SEPARATORS: readonly [string, string][] = [
  [";", tr`semicolons`],
  [",", tr`commas`],
  ["\t", tr`tabs`],
  ["|", tr`bars`],
  [" ", tr`spaces`],
];
const DECIMALS: readonly [string, string][] = [
  ["", tr`as the numbers show`],
  [".", tr`point: 1.5`],
  [",", tr`comma: 1,5`],
];
const ALL_UNITS = [
  "mm",
  "um",
  "nm",
  "cm",
  "m",
  "in",
  "deg",
  "arcmin",
  "arcsec",
  "rad",
  "mrad",
  "urad",
  "s",
  "ms",
  "min",
  "h",
  "degC",
];
/** So many columns are laid out; further ones have to be named in a file. */
const MOST_COLUMNS = 60;

interface Choice extends MappedColumn {
  unit: string;
  negate: boolean;
  words: [string, string][];
  values: readonly string[];
}

export class ColumnsForm implements FileForm {
  readonly element = h("div", { class: "columns-form" });
  private readonly app: App;
  private readonly of: ReadingsOf;
  private readonly known: readonly Column[];
  private table: Table;
  private choices: Choice[] = [];
  private decimal = "";
  private until = "";
  /** The line of headings that was typed. */
  private heading: number | null = null;
  private asked = 0;
  private readonly wrong = h("p", {
    class: "columns-wrong",
    role: "status",
    tabindex: "-1",
    dataTest: "columns-wrong",
  });

  constructor(app: App, of: ReadingsOf, known: readonly Column[], table: Table) {
    this.app = app;
    this.of = of;
    this.known = known;
    this.table = table;
    this.take(table);
  }

  text(): string {
    return mappingText(this.of.name, this.mapped(), this.names());
  }

  private mapped(): MappedTable {
    const { separator, heading_line, first_line, rows_below_headings } = this.table;
    const { decimal, until, choices } = this;
    return {
      separator,
      decimal,
      until,
      heading_line,
      first_line,
      rows_below_headings,
      columns: choices.map((choice) => ({
        ...choice,
        unit: this.unitsOf(choice.role).length > 0 ? choice.unit || "?" : "",
        // The sign of a number without a unit stays.
        negate: this.unitsOf(choice.role).length > 0 && choice.negate,
        words: this.hasWords(choice.role) ? choice.words : [],
      })),
    };
  }

  private names(): string[] {
    const numbered = this.known.filter((column) => column.is_numbered).map((column) => column.name);
    return roles(this.choices, numbered);
  }

  private columnOf(role: string): Column | undefined {
    return this.known.find((column) => column.name === role);
  }

  private unitsOf(role: string): readonly string[] {
    return this.columnOf(role)?.units ?? [];
  }

  private hasWords(role: string): boolean {
    return (this.columnOf(role)?.words.length ?? 0) > 0;
  }

  /** The role by our name, without the number of a run. */
  private roleOf(role: string | null): string {
    const plain = role?.replace(/_\d+$/, "") ?? "";
    return this.columnOf(role ?? "")?.name ?? this.columnOf(plain)?.name ?? "";
  }

  private take(table: Table): void {
    this.table = table;
    this.decimal = table.decimal ?? this.decimal;
    this.until = table.until ?? this.until;
    this.choices = table.columns.slice(0, MOST_COLUMNS).map(({ heading, role, unit, negate, values, words }) => ({
      heading,
      role: this.roleOf(role),
      unit: unit ?? "",
      negate,
      values,
      words: words.map(([word, ours]) => [word, ours ?? ""]),
    }));
    this.draw();
  }

  /** Another separator or another line of headings: its columns are found again. */
  private async again(separator: string, heading_line: number | null): Promise<void> {
    const { path, text } = this.of;
    const asked = ++this.asked;
    try {
      const from = path ? { path } : { text };
      const line = heading_line === null ? {} : { heading_line };
      const answer = await this.app.api.ask("readings-columns", { ...from, separator, ...line });
      // Only the last choice counts.
      if (asked !== this.asked) return;
      if (answer.table) this.take(answer.table);
      else this.say(tr`No two columns are found that way.`);
    } catch (error) {
      this.app.fail(error);
    }
  }

  private say(text: string | null): void {
    this.wrong.textContent = text ?? "";
    if (text) this.wrong.dataset.wrong = text;
    else delete this.wrong.dataset.wrong;
  }

  private check(): void {
    this.say(wrongColumns(this.mapped().columns, this.names()));
  }

  private draw(): void {
    const { table } = this;
    const separator = select(
      tr`Separator of the columns`,
      SEPARATORS,
      table.separator,
      (value) => void this.again(value, this.heading),
    );
    const decimal = select(tr`Decimal sign`, DECIMALS, this.decimal, (value) => (this.decimal = value));
    const heading = h("input", {
      type: "number",
      min: "0",
      size: "5",
      value: String(table.heading_line ?? 0),
      ariaLabel: tr`Line of the headings; 0 where there are none`,
      onchange: () => {
        this.heading = Number(heading.value);
        void this.again(table.separator, this.heading);
      },
    });
    const below = h("input", {
      type: "number",
      min: "0",
      size: "4",
      value: String(table.rows_below_headings),
      dataField: "below",
      ariaLabel: tr`Rows between the headings and the first reading`,
      oninput: () => (this.table = { ...this.table, rows_below_headings: Math.max(0, Number(below.value) || 0) }),
    });
    const until = h("input", {
      type: "text",
      value: this.until,
      placeholder: tr`nothing: all lines`,
      ariaLabel: tr`Beginning of the line after the last reading`,
      oninput: () => (this.until = until.value),
    });
    fill(
      this.element,
      h(
        "div",
        { class: "file-dialog-fields" },
        labelled(tr`Between columns`, separator),
        labelled(tr`Decimal sign`, decimal),
        labelled(tr`Headings in line (0: none)`, heading),
        labelled(tr`Rows between headings and readings`, below),
        labelled(tr`Readings end before the line that begins with`, until),
      ),
      h("p", { class: "muted" }, tr`${table.readings} rows of readings below line ${table.first_line}.`),
      h(
        "div",
        { class: "columns-table", tabindex: "0", role: "group", ariaLabel: tr`Columns of the file` },
        h(
          "table",
          {},
          h("caption", { class: "visually-hidden" }, tr`Columns of the file`),
          h(
            "thead",
            {},
            h(
              "tr",
              {},
              [tr`column`, tr`first values`, tr`is`, tr`unit`, tr`sign`, tr`words`].map((t) => h("th", {}, t)),
            ),
          ),
          h(
            "tbody",
            {},
            this.choices.map((choice, at) => this.row(choice, at)),
          ),
        ),
      ),
      this.wrong,
    );
    this.check();
  }

  private row(choice: Choice, at: number): HTMLElement {
    const name = choice.heading || tr`column ${at + 1}`;
    const rest = h("td", {});
    const sign = h("td", {});
    const words = h("td", {});
    const unit = (): void => {
      const usual = this.unitsOf(choice.role);
      fill(
        rest,
        usual.length > 0
          ? select(
              tr`Unit of ${name}`,
              [["", "?"], ...[...new Set([...usual, ...ALL_UNITS])].map((u): [string, string] => [u, u])],
              choice.unit,
              (value) => {
                choice.unit = value;
                this.check();
              },
            )
          : null,
      );
      fill(sign, usual.length > 0 ? this.signOf(choice, name) : null);
      fill(words, this.hasWords(choice.role) ? this.wordsOf(choice, name) : null);
    };
    const role = select(
      tr`What ${name} is`,
      [["", tr`not used`], ...this.known.map((column): [string, string] => [column.name, trText(column.title)])],
      choice.role,
      (value) => {
        choice.role = value;
        unit();
        this.check();
      },
    );
    unit();
    return h(
      "tr",
      { dataColumn: String(at + 1) },
      h("td", {}, name),
      h("td", { class: "muted" }, choice.values.join("  ")),
      h("td", {}, role),
      rest,
      sign,
      words,
    );
  }

  private signOf(choice: Choice, name: string): HTMLElement {
    const box = h("input", {
      type: "checkbox",
      checked: choice.negate,
      ariaLabel: tr`Change the sign of ${name}`,
      onchange: () => (choice.negate = box.checked),
    });
    return h("label", { title: tr`The file counts the other way: change the sign` }, box, tr` change`);
  }

  private wordsOf(choice: Choice, name: string): HTMLElement {
    const ours = this.columnOf(choice.role)?.words ?? [];
    return h(
      "div",
      { class: "columns-words" },
      choice.words.map((pair) =>
        h(
          "label",
          {},
          `${pair[0]} = `,
          select(
            tr`Meaning of ${pair[0]} in ${name}`,
            [["", "?"], ...ours.map((o): [string, string] => [o, o])],
            pair[1],
            (v) => {
              pair[1] = v;
            },
          ),
        ),
      ),
    );
  }
}

function select(
  label: string,
  options: readonly (readonly [string, string])[],
  now: string,
  choose: (value: string) => void,
): HTMLSelectElement {
  const element = h(
    "select",
    { ariaLabel: label, onchange: () => choose(element.value) },
    options.map(([value, text]) => h("option", { value }, text)),
  );
  element.value = now;
  return element;
}

function labelled(title: string, control: HTMLElement): HTMLElement {
  return h("label", {}, h("span", { class: "muted" }, title), control);
}
