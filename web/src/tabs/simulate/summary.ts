/** What the simulation says in one glance: does it run, how long, how far off; and where the issues are. */

import { refusedWith, told } from "../../words/told.ts";
import { tr, trText } from "../../words/index.ts";
import { diagnosticList } from "../../app.ts";
import type { Diagnostic, Refusal } from "../../api.ts";
import { fill, h, type Child } from "../../dom.ts";
import { clock, clockUnit, mm, number, um, urad, withUnit } from "../../format.ts";
import type { Mark, SimulationDocument, SimulationHeader } from "./answers.ts";

/** Rows of issues in the page; the time line has all. */
const MOST_ROWS = 200;

function fact(title: string, value: Child, key: string, more: Child = null): HTMLElement {
  return h("div", { class: "fact" }, h("span", { class: "muted" }, title), h("strong", { dataTest: key }, value), more);
}

/** Normal or binormal, whichever is larger: what is seen on the part. */
function across({ deviation }: SimulationDocument): number {
  return Math.max(Math.abs(deviation.normal_um.value), Math.abs(deviation.binormal_um.value));
}

/** What became of the stock, where it was cut. */
function stockFacts(stock: SimulationDocument["stock"]): Child {
  if (!stock) return null;
  const muted = (text: string): HTMLElement => h("span", { class: "muted" }, text);
  const feed_s = stock.cutting_s + stock.air_s;
  return h(
    "div",
    { class: "facts" },
    fact(tr`material removed`, cm3(stock.removed_mm3), "removed", muted(tr`of ${cm3(stock.before_mm3)}`)),
    fact(
      tr`stock that remains`,
      cm3(stock.left_mm3),
      "remains",
      muted(tr`± ${cm3(stock.spread_mm3)}, lines ${mm(stock.resolution_mm, 2)} apart`),
    ),
    fact(
      tr`feed in the air`,
      `${number(feed_s > 0 ? (100 * stock.air_s) / feed_s : 0, 0)} %`,
      "air",
      muted(tr`${clock(stock.air_s)} of ${clock(feed_s)}`),
    ),
    stock.gouged_mm3 === null
      ? null
      : fact(
          tr`cut from the part`,
          cm3(stock.gouged_mm3),
          "gouged",
          muted(tr`${cm3(stock.excess_mm3 ?? 0)} remain around it`),
        ),
  );
}

const cm3 = (mm3: number): string => withUnit(mm3 / 1e3, 2, "cm³");

/** The verdict of the report and of the command, and how often what was found. */
function verdict(header: SimulationHeader): HTMLElement {
  const { standing, word, sentence } = header.document.verdict;
  const kinds = new Map<string, number>();
  for (const mark of header.marks.filter((m) => m.grave))
    kinds.set(mark.kind, (kinds.get(mark.kind) ?? 0) + mark.stretches);
  const words = [...kinds].map(([kind, n]) => `${n} × ${trText(kind.replaceAll("-", " "))}`);
  return h(
    "div",
    { class: `runs ${standing}`, role: "status", dataTest: "verdict" },
    h("strong", {}, trText(word)),
    " ",
    told("span", {}, sentence),
    words.length > 0 ? h("span", { class: "muted" }, ` (${words.join(", ")})`) : null,
  );
}

export class Summary {
  readonly element = h("section", { class: "panel simulate-summary", ariaLabel: tr`Result` });
  private readonly seek: (time_s: number) => void;
  private readonly state: () => void;

  /** `state`: opens the set-up, to be stated. */
  constructor(seek: (time_s: number) => void, state: () => void) {
    this.seek = seek;
    this.state = state;
  }

  clear(): void {
    fill(this.element);
  }

  /** `errors`: how many errors the machine file states. */
  show(header: SimulationHeader, errors: number): void {
    const { document: doc } = header;
    const worst = doc.deviation.tip_um;
    const to =
      worst.value > 0
        ? h(
            "button",
            { class: "link", dataTest: "to-largest", onclick: () => this.seek(worst.time_s) },
            tr`line ${worst.line}`,
          )
        : errors === 0
          ? h("span", { class: "muted" }, tr`the machine file states no errors`)
          : null;
    fill(
      this.element,
      doc.set_up_given ? null : this.noSetUp(),
      h("div", { class: "panel-head" }, verdict(header), h("span", { class: "muted" }, doc.control)),
      this.critical(header.marks),
      h(
        "div",
        { class: "facts" },
        fact(
          tr`machining time`,
          [clock(doc.time_s), h("small", {}, clockUnit(doc.time_s))],
          "time",
          h(
            "span",
            { class: "muted" },
            doc.dwell_s > 0
              ? tr`rapid ${clock(doc.rapid_s)}, dwell ${clock(doc.dwell_s)}`
              : tr`rapid ${clock(doc.rapid_s)}`,
          ),
        ),
        fact(tr`largest deviation`, um(worst.value), "largest", to),
        fact(
          tr`across the path`,
          um(across(doc)),
          "across",
          h("span", { class: "muted" }, tr`rms ${um(doc.deviation.tip_rms_um)}`),
        ),
        fact(
          tr`tilt of the tool`,
          urad(doc.deviation.axis_urad.value),
          "tilt",
          h("span", { class: "muted" }, tr`${mm(doc.feed_mm, 0)} in feed`),
        ),
      ),
      stockFacts(doc.stock),
      this.remarks(header),
      header.diagnostics.length > 0
        ? h(
            "details",
            { class: "simulate-said", open: header.diagnostics.some((d) => d.severity === "error") },
            h(
              "summary",
              {},
              header.diagnostics.length === 1
                ? tr`The program reader says one thing`
                : tr`The program reader says ${header.diagnostics.length} things`,
            ),
            diagnosticList(header.diagnostics.slice(0, MOST_ROWS)),
          )
        : null,
    );
  }

  /** The program (or machine) cannot be simulated: what is wrong with it. */
  refuse(refusal: Refusal, again: (() => void) | null): void {
    const errors = refusal.diagnostics.filter((d: Diagnostic) => d.severity === "error");
    fill(
      this.element,
      h(
        "div",
        { class: "panel-head" },
        h(
          "strong",
          { class: "runs bad", dataTest: "verdict" },
          errors.length === 0
            ? refusedWith("span", {}, refusal, refusal.message)
            : errors.length === 1
              ? tr`Cannot be simulated: one error`
              : tr`Cannot be simulated: ${errors.length} errors`,
        ),
      ),
      refusal.diagnostics.length > 0
        ? diagnosticList(refusal.diagnostics.slice(0, MOST_ROWS))
        : refusal.hint
          ? refusedWith("p", { class: "hint" }, refusal, refusal.hint)
          : null,
      again
        ? h(
            "p",
            { class: "row" },
            h("button", { dataTest: "keep-going", onclick: again }, tr`Simulate all the same`),
            h("span", { class: "muted" }, tr`continues after each error`),
          )
        : null,
    );
  }

  private noSetUp(): HTMLElement {
    return h(
      "div",
      { class: "no-set-up", role: "alert", dataTest: "no-set-up" },
      h("span", {}, tr`No set-up: work offsets and tool lengths count as 0.`),
      h("button", { class: "primary", onclick: () => this.state() }, tr`State the set-up …`),
    );
  }

  private critical(marks: readonly Mark[]): Child {
    const critical = marks.filter((m) => m.grave);
    if (critical.length === 0) return null;
    return [
      h(
        "ul",
        { class: "issues critical" },
        critical.slice(0, MOST_ROWS).map((m) => this.issue(m)),
      ),
      more(critical),
    ];
  }

  private remarks({ marks }: SimulationHeader): Child {
    const rest = marks.filter((m) => !m.grave);
    if (rest.length === 0) return null;
    return h(
      "details",
      { class: "simulate-said" },
      h("summary", {}, found(rest) === 1 ? tr`One remark` : tr`${found(rest)} remarks`),
      h(
        "ul",
        { class: "issues" },
        rest.slice(0, MOST_ROWS).map((m) => this.issue(m)),
      ),
      more(rest),
    );
  }

  private issue(mark: Mark): HTMLElement {
    const { time_s, until_s } = mark;
    const when = until_s !== null && until_s > time_s ? tr`${clock(time_s)} to ${clock(until_s)}` : clock(time_s);
    return h(
      "li",
      {},
      h(
        "button",
        { class: "issue", dataKind: mark.kind, onclick: () => this.seek(time_s) },
        h("span", { class: "muted number" }, when),
        h("span", { class: "muted number" }, tr`line ${mark.line}`),
        h(
          "span",
          {},
          told("span", {}, mark.text),
          mark.stretches > 1 ? tr` (${mark.stretches} stretches, the worst of them)` : null,
        ),
      ),
    );
  }
}

/** How many stretches there are. */
const found = (marks: readonly Mark[]): number => marks.reduce((sum, mark) => sum + mark.stretches, 0);

/** What the list does not show. */
function more(marks: readonly Mark[]): Child {
  const rest = found(marks.slice(MOST_ROWS));
  return rest > 0 ? h("p", { class: "muted" }, tr`and ${rest} more of these: the time line has all of them`) : null;
}
