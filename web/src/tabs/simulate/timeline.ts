/** The time line: drag to scrub, marks of collisions, over-travel and other issues jump there. */

import { tr, trText } from "../../words/index.ts";
import { fill, h } from "../../dom.ts";
import { clock, clockUnit, duration } from "../../format.ts";
import type { Mark } from "./answers.ts";

/** Marks closer than this share of the line are one mark with a number. */
const APART = 1 / 220;

interface Cluster {
  marks: Mark[];
  critical: boolean;
}

export class Timeline {
  readonly element: HTMLElement;
  /** For the mouse; the list of issues and the keys N and Shift+N lead to the same places. */
  private readonly marks = h("div", { class: "timeline-marks", ariaHidden: "true" });
  private readonly spans = h("div", { class: "timeline-spans" });
  private readonly window_part = h("div", { class: "timeline-window", hidden: true });
  private readonly done = h("div", { class: "timeline-done" });
  private readonly thumb = h("div", { class: "timeline-thumb" });
  private readonly track = h("div", {
    class: "timeline-track",
    role: "slider",
    tabindex: "0",
    ariaLabel: tr`Time in the program`,
    ariaValuemin: "0",
    ariaValuemax: "0",
    ariaValuenow: "0",
  });
  private duration_s = 0;
  private readonly seek: (time_s: number) => void;

  constructor(seek: (time_s: number) => void) {
    this.seek = seek;
    this.track.append(this.window_part, this.done, this.spans, this.thumb);
    this.element = h("div", { class: "timeline" }, this.marks, this.track);
    this.track.addEventListener("pointerdown", (event) => this.drag(event));
  }

  setProgram(duration_s: number, marks: readonly Mark[]): void {
    this.duration_s = duration_s;
    this.track.setAttribute("aria-valuemax", String(duration_s));
    fill(
      this.marks,
      clusters(marks, duration_s).map((cluster) => this.button(cluster)),
    );
    fill(
      this.spans,
      marks.filter((m) => m.grave && m.until_s !== null).map((m) => this.span(m)),
    );
    this.setWindow(null);
    this.setTime(0);
  }

  setTime(time_s: number): void {
    const share = this.share(time_s);
    this.done.style.width = this.thumb.style.left = share;
    this.track.setAttribute("aria-valuenow", String(time_s));
    this.track.setAttribute("aria-valuetext", tr`${duration(time_s)} of ${duration(this.duration_s)}`);
  }

  /** The part of the time that the plots show. */
  setWindow(window_s: [number, number] | null): void {
    this.window_part.hidden = window_s === null;
    if (!window_s) return;
    this.window_part.style.left = this.share(window_s[0]);
    this.window_part.style.width = `calc(${this.share(window_s[1])} - ${this.share(window_s[0])})`;
  }

  private share(time_s: number): string {
    return `${(this.duration_s > 0 ? (100 * Math.min(this.duration_s, Math.max(0, time_s))) / this.duration_s : 0).toFixed(4)}%`;
  }

  private button({ marks, critical }: Cluster): HTMLElement {
    const first = marks[0] as Mark;
    const words =
      marks.length === 1
        ? tr`${trText(first.text)}, line ${first.line}, ${clock(first.time_s)}${clockUnit(first.time_s)}`
        : tr`${marks.length} places from ${clock(first.time_s)}${clockUnit(first.time_s)}, the first in line ${first.line}: ${trText(first.text)}`;
    const button = h("span", {
      class: `timeline-mark ${critical ? "critical" : ""}`,
      dataKind: first.kind,
      dataTime: first.time_s,
      title: words,
      onclick: () => this.seek(first.time_s),
    });
    button.style.left = this.share(first.time_s);
    return button;
  }

  private span({ time_s, until_s }: Mark): HTMLElement {
    const part = h("div", { class: "timeline-span" });
    part.style.left = this.share(time_s);
    part.style.width = `calc(${this.share(until_s ?? time_s)} - ${this.share(time_s)})`;
    return part;
  }

  private drag(down: PointerEvent): void {
    if (!(this.duration_s > 0)) return;
    const go = (event: PointerEvent): void => {
      const box = this.track.getBoundingClientRect();
      this.seek(Math.min(1, Math.max(0, (event.clientX - box.left) / box.width)) * this.duration_s);
    };
    this.track.setPointerCapture(down.pointerId);
    this.track.addEventListener("pointermove", go);
    this.track.addEventListener("pointerup", () => this.track.removeEventListener("pointermove", go), { once: true });
    go(down);
  }
}

/** Neighbours of the same severity become one; the critical ones are drawn last, on top. */
function clusters(marks: readonly Mark[], duration_s: number): Cluster[] {
  const all: Cluster[] = [];
  for (const critical of [false, true]) {
    let open: Cluster | null = null;
    for (const mark of marks.filter((m) => m.grave === critical).sort((a, b) => a.time_s - b.time_s)) {
      if (open && mark.time_s - (open.marks[0] as Mark).time_s < APART * duration_s) open.marks.push(mark);
      else {
        open = { marks: [mark], critical };
        all.push(open);
      }
    }
  }
  return all;
}
