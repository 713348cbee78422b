/** The parts of the Live tab that show one moment. */

import { tr, trText } from "../../words/index.ts";
import type { LiveAxisEntry, LiveEventEntry, LiveState } from "../../../types.d.ts";
import { h } from "../../dom.ts";
import { NARROW_SPACE, NO_NUMBER, number, withUnit } from "../../format.ts";
import { ago, eventWord, unitOf } from "./words.ts";

export type Tone = "good" | "warn" | "bad" | "off";

const TONES: Record<string, Tone> = {
  run: "good",
  hold: "warn",
  "ramp-down": "warn",
  latched: "bad",
  arm: "warn",
  off: "off",
};
const WORDS: Record<string, string> = {
  run: tr`Run`,
  hold: tr`Hold`,
  "ramp-down": tr`Ramp down`,
  latched: tr`Latched`,
  arm: tr`Arm`,
  off: tr`Off`,
};

export const stateWord = (state: string): string => WORDS[state] ?? state;

/** The state in large letters; what is over is shown as such, whatever its last state was. */
export function stateOf(last: LiveState, running: boolean): { tone: Tone; word: string } {
  const word = stateWord(last.state);
  if (!running)
    return { tone: last.axes.some((axis) => axis.own !== 0) ? "bad" : "off", word: tr`Not running (${word})` };
  const alarm = last.near_limit || last.lagging || last.outside_travel;
  const tone = TONES[last.state] ?? "warn";
  return { tone: tone === "good" && alarm ? "warn" : tone, word };
}

/** What wants a person's eye, and what was counted. */
export function tilesOf(last: LiveState): HTMLElement {
  const alarms = [
    last.near_limit ? tr`an offset is near its limit` : null,
    last.lagging ? tr`an offset is late: feed less` : null,
    last.outside_travel ? tr`an axis is outside the travel of the plan` : null,
  ].filter((text) => text !== null);
  const tile = (key: string, title: string, value: string, tone = ""): HTMLElement =>
    h("div", { class: `tile ${tone}`, dataTile: key }, h("dt", {}, title), h("dd", {}, h("strong", {}, value)));
  return h(
    "div",
    {},
    alarms.map((text) => h("p", { class: "verdict warn", role: "alert" }, text)),
    h(
      "dl",
      { class: "tiles" },
      tile("feed", tr`feed`, last.feed_mm_per_min === null ? NO_NUMBER : withUnit(last.feed_mm_per_min, 0, "mm/min")),
      last.setup == null ? null : tile("setup", tr`setup`, number(last.setup, 0)),
      tile("cycles", tr`cycles`, number(last.cycles, 0)),
      tile("periods missed", tr`periods missed`, number(last.missed, 0)),
      tile("writes", tr`writes`, number(last.writes, 0)),
      tile("failed writes", tr`failed writes`, number(last.failed_writes, 0), last.failed_writes > 0 ? "bad" : ""),
    ),
  );
}

/** The offset between minus and plus its limit. */
function bar(axis: LiveAxisEntry): HTMLElement {
  const share = (value: number): number => Math.max(-1, Math.min(1, axis.limit > 0 ? value / axis.limit : 0));
  const own = share(axis.own);
  const left = own < 0 ? 50 + 50 * own : 50;
  const near = Math.abs(own) >= 0.8;
  const text = tr`${number(axis.own, 1)} of ±${number(axis.limit, 0)}${NARROW_SPACE}${unitOf(axis.unit)}`;
  return h(
    "div",
    { class: "live-bar", role: "img", ariaLabel: text, title: text },
    h("span", {
      class: `live-fill${near ? " near" : ""}`,
      style: { left: `${left}%`, width: `${50 * Math.abs(own)}%` },
    }),
    axis.target === null
      ? null
      : h("span", { class: "live-target", title: tr`target`, style: { left: `${50 + 50 * share(axis.target)}%` } }),
  );
}

export function axesPanel(last: LiveState): HTMLElement {
  const heads = [
    tr`axis`,
    tr`position`,
    tr`offset`,
    tr`acts`,
    tr`target`,
    tr`late by`,
    tr`its share of the limit`,
    tr`limit`,
  ];
  const datum = last.axes.some((axis) => axis.datum !== null && axis.datum !== undefined);
  return h(
    "section",
    { class: "panel sheet", dataSheet: "live-axes" },
    h("h2", {}, tr`Offsets`),
    h(
      "div",
      { class: "sheet-scroll" },
      h(
        "table",
        {},
        h(
          "thead",
          {},
          h(
            "tr",
            {},
            heads.map((text, i) => h("th", { class: i === 0 || i === 6 ? "" : "number" }, text)),
          ),
        ),
        h(
          "tbody",
          {},
          last.axes.map((axis) => {
            const unit = unitOf(axis.unit);
            const cell = (value: number | null | undefined, digits = 1, of = unit): HTMLElement =>
              h("td", { class: "number" }, withUnit(value, digits, of));
            return h(
              "tr",
              { dataAxis: axis.axis },
              h("td", {}, axis.axis),
              cell(axis.position, 3, axis.unit === "um" ? "mm" : "°"),
              cell(axis.offset),
              cell(axis.acting),
              cell(axis.target),
              cell(axis.lag),
              h("td", {}, bar(axis)),
              cell(axis.limit, 0),
            );
          }),
        ),
      ),
    ),
    datum
      ? h(
          "p",
          { class: "note", dataTest: "datum" },
          tr`Subtracted, as the zero of the part was touched with it: `,
          last.axes.map((axis) => `${axis.axis} ${withUnit(axis.datum, 1, unitOf(axis.unit))}`).join(", "),
        )
      : null,
    h(
      "p",
      { class: "muted note" },
      tr`Offset: what the control holds. Bar: the part that this program has written, between minus and plus the limit; the line in it is the target.`,
    ),
  );
}

export function sensorsPanel(last: LiveState): HTMLElement | null {
  if (last.sensors.length === 0) return null;
  return h(
    "section",
    { class: "panel sheet", dataSheet: "live-sensors" },
    h("h2", {}, tr`Sensors`),
    h(
      "table",
      {},
      h(
        "thead",
        {},
        h(
          "tr",
          {},
          h("th", {}, tr`sensor`),
          h("th", { class: "number" }, tr`temperature`),
          h("th", { class: "number" }, tr`age`),
          h("th", {}, h("span", { class: "visually-hidden" }, tr`fault`)),
        ),
      ),
      h(
        "tbody",
        {},
        last.sensors.map((sensor) =>
          h(
            "tr",
            { class: sensor.fault ? "live-fault" : "", dataSensor: sensor.sensor },
            h("td", {}, sensor.sensor),
            h("td", { class: "number" }, withUnit(sensor.celsius, 2, "°C")),
            h("td", { class: "number" }, withUnit(sensor.age_s, 1, "s")),
            h("td", {}, sensor.fault ? trText(sensor.fault) : sensor.instead ? tr`${sensor.instead} stands in` : ""),
          ),
        ),
      ),
    ),
  );
}

export function eventsPanel(events: readonly LiveEventEntry[], now_s: number): HTMLElement | null {
  if (events.length === 0) return null;
  return h(
    "section",
    { class: "panel sheet", dataSheet: "live-events" },
    h("h2", {}, tr`Events`),
    h(
      "table",
      {},
      h(
        "tbody",
        {},
        [...events]
          .reverse()
          .map((event) =>
            h(
              "tr",
              {},
              h(
                "td",
                { class: "muted", title: new Date(1000 * event.date_s).toISOString() },
                ago(now_s - event.date_s),
              ),
              h("td", {}, eventWord(event.state)),
              h("td", {}, trText(event.reason)),
            ),
          ),
      ),
    ),
  );
}
