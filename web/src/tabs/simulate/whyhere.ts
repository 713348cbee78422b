/** Why the tool is off at a block: how long it takes, what slowed it, and what each error contributes. */

import { told } from "../../words/told.ts";
import { tr } from "../../words/index.ts";
import type { App } from "../../app.ts";
import type { Answer, Request } from "../../api.ts";
import { fill, h, type Child } from "../../dom.ts";
import { clock, number, um, withUnit } from "../../format.ts";
import type { Mark } from "./answers.ts";

type Asked = Omit<Request<"trace">, "line">;
/** The document of `trueaxis trace`. */
type Traced = Answer<"trace">;

/** Contributions below this share of the largest are put together. */
const SMALL = 0.02;

export class WhyHere {
  readonly element = h("section", { class: "panel why-here", ariaLabel: tr`Why here`, hidden: true });
  private readonly app: App;
  private stop = new AbortController();

  constructor(app: App) {
    this.app = app;
  }

  clear(): void {
    this.stop.abort();
    this.element.hidden = true;
    fill(this.element);
  }

  /** Asks for the block at this line; `marks`: the issues of the simulation. */
  async show(asked: Asked, line: number, marks: readonly Mark[]): Promise<void> {
    this.clear();
    const stop = new AbortController();
    this.stop = stop;
    const progress = this.app.progress(tr`line ${line} through every stage`);
    try {
      const found = await this.app.api.ask("trace", { ...asked, line }, { signal: stop.signal });
      if (stop.signal.aborted) return;
      this.fill(found, marks);
    } catch (error) {
      if (!stop.signal.aborted) this.app.fail(error);
    } finally {
      progress.done();
    }
  }

  private fill(found: Traced, marks: readonly Mark[]): void {
    const { line, text, time, deviation, budget } = found;
    const during = time ? marks.filter((m) => m.time_s <= time.to_s && (m.until_s ?? m.time_s) >= time.from_s) : [];
    this.element.hidden = false;
    fill(
      this.element,
      h(
        "div",
        { class: "panel-head" },
        h("h2", {}, tr`Why here? Line ${line}`),
        h("button", { type: "button", onclick: () => this.clear() }, tr`Close`),
      ),
      h("code", { class: "readout-block", title: text }, text),
      facts(found),
      time
        ? h(
            "p",
            {},
            tr`${clock(time.from_s)} to ${clock(time.to_s)}, ${withUnit(time.speed_mm_per_min, 0, "mm/min")} at its end`,
            during.length === 0 ? tr`; nothing slowed it.` : ":",
          )
        : h("p", {}, tr`It moves nothing.`),
      during.length > 0
        ? h(
            "ul",
            {},
            during.map((m) => told("li", { class: m.grave ? "bad" : null }, m.text)),
          )
        : null,
      deviation
        ? h(
            "p",
            { dataTest: "why-deviation" },
            tr`At its end the tip is off by ${um(Math.hypot(...deviation.tip_um))}`,
            deviation.normal_um === null || deviation.normal_um === undefined
              ? "."
              : tr`: ${um(deviation.feed_um ?? 0)} along the feed, ${um(deviation.normal_um)} along the normal, ${um(deviation.binormal_um ?? 0)} along the binormal.`,
          )
        : null,
      budget && budget.length > 0
        ? shares(budget)
        : deviation
          ? h("p", {}, tr`The machine file states no errors.`)
          : null,
    );
    this.element.scrollIntoView({ block: "nearest" });
  }
}

function facts({ executions, programmed }: Traced): Child {
  if (!programmed) return null;
  // What the block does besides is in the words of the server.
  const words: Child[] = [
    `T${programmed.tool}`,
    programmed.tool_centre ? tr`tool-centre point on` : tr`tool-centre point off`,
    programmed.tilted_plane ? tr`tilted plane` : null,
    ...programmed.events.map(event),
    executions === 1 ? null : tr`runs ${executions} times: the first is shown`,
  ];
  const said = words.filter(Boolean);
  return h(
    "p",
    { class: "muted" },
    said.map((word, i) => (i === 0 ? word : ["; ", word])),
  );
}

function event(text: string): Child {
  return told("span", {}, text);
}

/** What each error contributes, the largest first, with a bar. */
function shares(budget: NonNullable<Traced["budget"]>): HTMLElement {
  const sorted = budget
    .map((share) => ({ ...share, length: Math.hypot(...share.tip_um) }))
    .sort((a, b) => b.length - a.length);
  const largest = sorted[0]?.length ?? 0;
  const shown = sorted.filter((share) => share.length >= SMALL * largest);
  const rest = sorted.length - shown.length;
  const row = (share: (typeof sorted)[number]): HTMLElement =>
    h(
      "tr",
      {},
      h("th", { scope: "row" }, share.error),
      share.tip_um.map((v) => h("td", { class: "number" }, number(v, 2))),
      h("td", { class: "number" }, number(share.length, 2)),
      h(
        "td",
        { class: "why-bar" },
        h("meter", {
          min: "0",
          max: String(largest || 1),
          value: share.length,
          ariaLabel: tr`share of ${share.error}`,
        }),
      ),
    );
  return h(
    "div",
    { class: "why-shares" },
    h(
      "table",
      {},
      h("caption", {}, tr`What each error contributes to the tip at the end of the block (µm)`),
      h(
        "thead",
        {},
        h(
          "tr",
          {},
          h("th", { scope: "col" }, tr`error`),
          ["X", "Y", "Z", tr`length`].map((word) => h("th", { scope: "col", class: "number" }, word)),
          h("td", {}),
        ),
      ),
      h("tbody", {}, shown.map(row)),
    ),
    rest > 0 ? h("p", { class: "muted" }, tr`and ${rest} of less than ${100 * SMALL} % of the largest`) : null,
  );
}
