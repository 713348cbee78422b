/** Views by a name of the user's own: from where, which section, how bodies are drawn. This browser keeps them for each machine. */

import { tr } from "../words/index.ts";
import { fill, h } from "../dom.ts";
import type { Look } from "./bodies.ts";
import type { ViewState } from "./camera.ts";

/** What a view consists of. */
export interface ViewParts {
  camera: ViewState;
  /** Axis across which is cut, share of the extent, whether the other side stays; without a section the axis is "". */
  section: { axis: string; place: string; other: boolean };
  looks: Record<string, Look>;
}

interface SavedView extends ViewParts {
  name: string;
}

interface Picture {
  capture(): ViewParts;
  apply(parts: ViewParts): void;
}

const KEPT = "trueaxis-views";
/** Of one machine. */
const MOST_VIEWS = 40;

export class SavedViews {
  readonly element: HTMLElement;
  private readonly picture: Picture;
  /** Of which machine: views of another would look past it. */
  private machine = "";
  private readonly choice = h("select", {
    ariaLabel: tr`Saved views`,
    dataTest: "saved-views",
    onchange: () => this.go(),
  });
  private readonly name = h("input", {
    type: "text",
    maxlength: "60",
    ariaLabel: tr`Name of the view`,
    placeholder: tr`name of the view`,
    oninput: () => (this.save.disabled = this.name.value.trim() === ""),
  });
  private readonly save = h("button", { type: "submit", disabled: true }, tr`Save view`);
  private readonly remove = h(
    "button",
    { type: "button", disabled: true, onclick: () => this.removeChosen() },
    tr`Remove`,
  );

  /** Again, after the picture was turned: the choice alone does not change then. */
  private readonly again = h("button", { type: "button", disabled: true, onclick: () => this.go() }, tr`Show`);

  constructor(picture: Picture) {
    this.picture = picture;
    const form = h("form", { class: "row" }, this.name, this.save);
    form.addEventListener("submit", (event) => {
      event.preventDefault();
      this.add();
    });
    this.element = h(
      "div",
      { class: "scene-views" },
      h("div", { class: "row" }, this.choice, this.again, this.remove),
      form,
    );
  }

  /** Shows the views of a machine. */
  show(machine: string): void {
    this.machine = machine;
    this.list("");
  }

  private views(): SavedView[] {
    return all()[this.machine] ?? [];
  }

  private keep(views: SavedView[]): void {
    localStorage.setItem(KEPT, JSON.stringify({ ...all(), [this.machine]: views }));
  }

  private list(chosen: string): void {
    const views = this.views();
    fill(
      this.choice,
      h("option", { value: "" }, views.length === 0 ? tr`no saved views` : tr`saved views …`),
      views.map(({ name }) => h("option", { value: name }, name)),
    );
    this.choice.value = chosen;
    this.choice.disabled = views.length === 0;
    this.again.disabled = this.remove.disabled = this.choice.value === "";
  }

  private go(): void {
    const view = this.views().find(({ name }) => name === this.choice.value);
    this.again.disabled = this.remove.disabled = view === undefined;
    if (view) this.picture.apply(view);
  }

  /** One of the same name is replaced: that is how a view is changed. */
  private add(): void {
    const name = this.name.value.trim();
    if (name === "") return;
    const others = this.views().filter((view) => view.name !== name);
    this.keep([...others, { name, ...this.picture.capture() }].slice(-MOST_VIEWS));
    this.name.value = "";
    this.save.disabled = true;
    this.list(name);
  }

  private removeChosen(): void {
    this.keep(this.views().filter(({ name }) => name !== this.choice.value));
    this.list("");
  }
}

/** All that this browser keeps; what cannot be read is none. */
function all(): Record<string, SavedView[]> {
  try {
    const kept: unknown = JSON.parse(localStorage.getItem(KEPT) ?? "{}");
    const entries = Object.entries(kept as object).filter(([, views]) => Array.isArray(views) && views.every(isView));
    return Object.fromEntries(entries) as Record<string, SavedView[]>;
  } catch {
    return {};
  }
}

function isView(view: unknown): view is SavedView {
  const { name, camera, section, looks } = (view ?? {}) as Partial<SavedView>;
  return typeof name === "string" && typeof camera === "string" && Boolean(section) && Boolean(looks);
}
