/** What a live run is doing: state and reason, offsets against their limits, sensors with their age, the last hours. */

import { tr, trText } from "../words/index.ts";
import type { ServeLive, ServeLiveDiagnosed } from "../../types.d.ts";
import { diagnosticList, type App, type Tab, type TabHandle } from "../app.ts";
import { fill, h } from "../dom.ts";
import { ago, compensated } from "./live/words.ts";
import { axesPanel, eventsPanel, sensorsPanel, stateOf, stateWord, tilesOf } from "./live/panels.ts";
import { Shift } from "./live/shift.ts";
import { fileSelect, showRefusal } from "./measure/ask.ts";

/** The state is asked for so often, ms; the history each so manyth time. */
const EVERY_MS = 1000;
const HISTORY_EACH = 10;

const HOURS = [1, 8, 24, 48];

class LiveTab implements TabHandle {
  private readonly app: App;
  private readonly head = h("section", { class: "panel form" });
  private readonly now = h("div", { class: "live-now" });
  private readonly more = h("div", { class: "live-now" });
  private readonly shift: Shift;
  private plan: string | null = null;
  private hours = 8;
  private timer: number | null = null;
  private asked = 0;
  private busy = false;
  private shown = false;

  constructor(host: HTMLElement, app: App) {
    this.app = app;
    this.shift = new Shift();
    const below = h("div", { class: "live-columns" }, this.more, this.shift.element);
    host.append(h("div", { class: "scroll live" }, this.head, this.now, below));
  }

  open(params: Readonly<Record<string, string>>): void {
    const hours = Number(params.hours);
    const plan = params.plan ?? this.plan;
    this.hours = HOURS.includes(hours) ? hours : this.hours;
    if (plan !== this.plan) this.shift.clear();
    this.plan = plan;
    this.showForm();
    this.begin();
  }

  private begin(): void {
    const { plan } = this;
    this.stopLooking();
    this.shown = true;
    this.asked = 0;
    if (!plan) {
      fill(this.more);
      fill(this.now, h("p", { class: "empty" }, tr`Choose the plan of a live run above. It is started in a terminal.`));
      return;
    }
    void this.look();
    this.timer = window.setInterval(() => void this.look(), EVERY_MS);
  }

  hide(): void {
    this.stopLooking();
    this.shown = false;
  }

  private stopLooking(): void {
    if (this.timer !== null) window.clearInterval(this.timer);
    this.timer = null;
  }

  changed(path: string | null): void {
    if (this.shown && (path === null || path === this.plan)) this.begin();
  }

  private showForm(): void {
    const select = fileSelect(
      this.app,
      tr`Plan of the run`,
      "live",
      (file) => file.kind === "live",
      this.plan,
      (plan) => this.app.go("live", { plan, hours: String(this.hours) }),
    );
    const hours = h(
      "select",
      {
        ariaLabel: tr`Hours that are shown`,
        onchange: () => this.app.go("live", { plan: this.plan, hours: hours.value }),
      },
      HOURS.map((n) => h("option", { value: String(n) }, `${n} h`)),
    );
    hours.value = String(this.hours);
    fill(
      this.head,
      h(
        "div",
        { class: "row" },
        h("label", { class: "field grow" }, h("span", {}, tr`Plan of the run`), select),
        h("label", { class: "field" }, h("span", {}, tr`The last`), hours),
      ),
    );
  }

  private async look(): Promise<void> {
    if (this.busy || !this.plan) return;
    this.busy = true;
    const { plan, hours } = this;
    const withHistory = this.asked % HISTORY_EACH === 0;
    this.asked += 1;
    try {
      const answer = await this.app.api.ask("live", { plan, hours: withHistory ? hours : null });
      if (plan === this.plan) this.show(answer, withHistory);
    } catch (error) {
      if (plan !== this.plan) return;
      // A lost connection comes back by itself; what is wrong with the plan is said once, and again when it is saved.
      if (this.app.state.connection === "open") this.stopLooking();
      this.shift.clear();
      fill(this.more);
      showRefusal(this.now, error);
    } finally {
      this.busy = false;
    }
  }

  private show({ document, now_s }: ServeLive, withHistory: boolean): void {
    const { last, diagnostics } = document;
    fill(
      this.now,
      this.stateBar(document, now_s),
      diagnostics.length > 0 ? h("section", { class: "panel" }, diagnosticList(diagnostics)) : null,
      last ? axesPanel(last) : null,
    );
    fill(this.more, last ? [sensorsPanel(last), eventsPanel(document.events, now_s)] : null);
    if (withHistory) this.shift.show(document.history ?? null);
    this.app.say(
      `${document.name}: ${document.running ? (last ? stateWord(last.state) : tr`starting`) : tr`not running`}`,
    );
  }

  private stateBar(document: ServeLiveDiagnosed, now_s: number): HTMLElement {
    const { last, running, name } = document;
    const command = `trueaxis live ${this.plan}`;
    if (!last)
      return h(
        "section",
        { class: "panel live-state", dataState: "none" },
        h("h1", { dataOwn: "" }, name),
        h("p", { class: "live-word", dataTest: "state" }, tr`It has not run here`),
        h("p", { class: "muted" }, tr`Start it in a terminal: `, h("code", {}, command)),
      );
    const { tone, word } = stateOf(last, running);
    const since = ago(now_s - last.date_s);
    return h(
      "section",
      { class: `panel live-state ${tone}`, dataState: last.state },
      h("h1", { dataOwn: "" }, name),
      h("p", { class: "live-word", dataTest: "state" }, word),
      h("p", { class: "live-reason", dataTest: "reason" }, trText(last.reason)),
      h(
        "p",
        { class: "muted" },
        `${last.control.join(" ")} · ${compensated(last.of)} · ${running ? tr`as of ${since}` : tr`as of ${since}, when it ended`}`,
      ),
      tilesOf(last),
    );
  }
}

export const live: Tab = {
  title: tr`Live`,
  mount: (host, app) => new LiveTab(host, app),
};
