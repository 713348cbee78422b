/** Play, pause, step, how fast, and the keys for it. */

import { tr } from "../../words/index.ts";
import { h, s } from "../../dom.ts";
import { clock, clockUnit } from "../../format.ts";
import { tabKey } from "../../keys.ts";
import { NO_WAITING, type Player } from "./player.ts";

const FACTORS = [0.1, 0.2, 0.5, 1, 2, 5, 10, 20, 50, 100, 200, 500, 1000];
const PLAY = "M4 2.5 L13 8 L4 13.5 Z";
const PAUSE = "M4 3 H7 V13 H4 Z M9 3 H12 V13 H9 Z";
const NEXT = "M3 3 L9 8 L3 13 Z M10 3 H12 V13 H10 Z";
const PREVIOUS = "M13 3 L7 8 L13 13 Z M4 3 H6 V13 H4 Z";
const END = "M2 3 L7 8 L2 13 Z M7 3 L12 8 L7 13 Z M12 3 H14 V13 H12 Z";
const HOME = "M14 3 L9 8 L14 13 Z M9 3 L4 8 L9 13 Z M2 3 H4 V13 H2 Z";

/** `name`: for tests; `key`: does the same. */
function button(name: string, [title, key]: [string, string], path: string, act: () => void): HTMLButtonElement {
  return h(
    "button",
    {
      class: "transport-button",
      title: `${title} (${key})`,
      ariaLabel: title,
      dataAct: name,
      onclick: act,
    },
    s(
      "svg",
      { viewBox: "0 0 16 16", width: 14, height: 14, "aria-hidden": "true" },
      s("path", { d: path, fill: "currentColor" }),
    ),
  );
}

export class Transport {
  readonly element: HTMLElement;
  private readonly play_button: HTMLButtonElement;
  private readonly clock_text = h("output", { class: "transport-clock", dataTest: "clock" });
  private readonly total = h("span", { class: "muted" });
  private readonly player: Player;

  constructor(player: Player) {
    this.player = player;
    this.play_button = button("play", [tr`Play`, tr`space`], PLAY, () => player.toggle());
    const speed = h(
      "select",
      {
        ariaLabel: tr`Speed`,
        dataTest: "factor",
        onchange: () => player.setFactor(speed.value === "all" ? NO_WAITING : Number(speed.value)),
      },
      FACTORS.map((k) => h("option", { value: k }, k === 1 ? tr`×1 true time` : `×${k}`)),
      h("option", { value: "all" }, tr`as fast as it can`),
    );
    speed.value = "1";
    speed.title = tr`How fast the time runs; as fast as it can: every block once, without waiting`;
    this.element = h(
      "div",
      { class: "transport" },
      h(
        "div",
        { class: "group", role: "group", ariaLabel: tr`Run through the program` },
        button("to the start", [tr`To the start`, tr`Home`], HOME, () => player.seek(0)),
        button("block back", [tr`Block back`, "←"], PREVIOUS, () => player.stepBlock("previous")),
        this.play_button,
        button("block on", [tr`Block on`, "→"], NEXT, () => player.stepBlock("next")),
        button("to the end", [tr`To the end`, tr`End`], END, () => player.seek(player.duration_s)),
      ),
      speed,
      h("span", { class: "transport-time" }, this.clock_text, this.total),
    );
  }

  setTime(time_s: number): void {
    this.clock_text.textContent = clock(time_s);
    this.total.textContent = ` / ${clock(this.player.duration_s)}${clockUnit(this.player.duration_s)}`;
  }

  setPlaying(playing: boolean): void {
    const title = playing ? tr`Pause` : tr`Play`;
    this.play_button.ariaLabel = title;
    this.play_button.title = `${title} (${tr`space`})`;
    this.play_button.querySelector("path")?.setAttribute("d", playing ? PAUSE : PLAY);
  }

  /** The keys of the player; the picture, plots and fields keep theirs. True if this was one. */
  key(event: KeyboardEvent): boolean {
    const key = tabKey(event);
    const at = event.target as HTMLElement;
    if (key === null || at.matches("input, canvas, [role=separator], [role=tab]")) return false;
    if (key === " ") {
      if (at.matches("button, a, summary, label")) return false;
      this.player.toggle();
    } else if (key === "ArrowRight") this.player.stepBlock("next");
    else if (key === "ArrowLeft") this.player.stepBlock("previous");
    else if (key === "Home") this.player.seek(0);
    else if (key === "End") this.player.seek(this.player.duration_s);
    else return false;
    return true;
  }
}
