/** What stands over the picture as text: labels, axis triad, the factor, colour bar, buttons. */

import { tr } from "../words/index.ts";
import { Matrix4, Vector3, type Camera } from "three";
import { h, s } from "../dom.ts";

interface Label {
  element: HTMLElement;
  at: () => Vector3;
  /** Width and height in pixels, once it was drawn. */
  size: [number, number] | null;
}

/** Where labels are put: one that would lie over an earlier one goes below it, none leaves the picture sideways. */
class Places {
  private readonly taken: { x: number; y: number; w: number; h: number }[] = [];

  put(x: number, y: number, [w, h]: [number, number], width: number): [number, number] {
    const place = { x: Math.max(w / 2, Math.min(width - w / 2, x)), y, w, h };
    // From above: each move down ends at the next free place.
    for (const other of this.taken.toSorted((a, b) => a.y - b.y))
      if (Math.abs(place.x - other.x) < (w + other.w) / 2 && Math.abs(place.y - other.y) < (h + other.h) / 2)
        place.y = other.y + (h + other.h) / 2;
    this.taken.push(place);
    return [place.x, place.y];
  }
}

export class Overlay {
  readonly element = h("div", { class: "scene-overlay" });
  private readonly labels = new Map<string, Label>();
  private readonly layer = h("div", { class: "scene-labels", ariaHidden: "true" });
  private readonly triad = s("svg", {
    class: "scene-triad",
    viewBox: "-40 -40 80 80",
    width: 84,
    height: 84,
    "aria-label": tr`Directions of the machine axes`,
    role: "img",
  });
  private readonly notes = h("div", { class: "scene-notes" });
  private readonly note_lines = new Map<string, HTMLElement>();
  readonly legend = h("div", { class: "scene-legend" });

  constructor() {
    this.element.append(this.layer, this.notes, this.legend, this.triad);
  }

  /** A label that stays at a place of the scene; null takes it away. */
  label(key: string, text: string | null, at: () => Vector3 = () => new Vector3(), kind = ""): void {
    this.labels.get(key)?.element.remove();
    this.labels.delete(key);
    if (text === null) return;
    const element = h("span", { class: `scene-label ${kind}` }, text);
    this.layer.append(element);
    this.labels.set(key, { element, at, size: null });
  }

  clearLabels(): void {
    this.labels.clear();
    this.layer.replaceChildren();
  }

  /** One line at the upper left, by key; null takes it away. */
  note(key: string, text: string | null, kind = ""): void {
    let line = this.note_lines.get(key);
    if (text === null) {
      line?.remove();
      this.note_lines.delete(key);
      return;
    }
    if (!line) {
      line = h("span", { class: `scene-note ${kind}` });
      this.note_lines.set(key, line);
      this.notes.append(line);
    }
    line.textContent = text;
  }

  update(camera: Camera, width: number, height: number): void {
    const places = new Places();
    for (const label of this.labels.values()) {
      const { element } = label;
      const p = label.at().project(camera);
      element.hidden = p.z > 1 || Math.abs(p.x) > 1.1 || Math.abs(p.y) > 1.1;
      if (element.hidden) continue;
      label.size ??= element.offsetWidth > 0 ? [element.offsetWidth, element.offsetHeight] : null;
      const [x, y] = places.put(((p.x + 1) / 2) * width, ((1 - p.y) / 2) * height, label.size ?? [0, 0], width);
      element.style.transform = `translate(-50%, -50%) translate(${x.toFixed(1)}px, ${y.toFixed(1)}px)`;
    }
    this.drawTriad(camera);
  }

  /** Words of everything that is written over the picture, for its export. */
  texts(): { text: string; x: number; y: number }[] {
    const origin = this.element.getBoundingClientRect();
    const spans = this.element.querySelectorAll<HTMLElement>(".scene-label:not([hidden]), .scene-note");
    return [...spans].map((span) => {
      const box = span.getBoundingClientRect();
      return {
        text: span.textContent ?? "",
        x: box.left + box.width / 2 - origin.left,
        y: box.top + box.height / 2 - origin.top,
      };
    });
  }

  private drawTriad(camera: Camera): void {
    const view = new Matrix4().extractRotation(camera.matrixWorldInverse);
    const axes = (["X", "Y", "Z"] as const).map((name, i) => ({
      name,
      v: new Vector3().setComponent(i, 1).applyMatrix4(view),
    }));
    axes.sort((a, b) => a.v.z - b.v.z);
    this.triad.replaceChildren(
      ...axes.flatMap(({ name, v }) => {
        const [x, y] = [24 * v.x, -24 * v.y];
        const faint = Math.hypot(v.x, v.y) < 0.12;
        return [
          s("line", { x1: 0, y1: 0, x2: x, y2: y, class: "triad-line" }),
          s("circle", { cx: x, cy: y, r: 2.2, class: "triad-tip" }),
          s(
            "text",
            { x: x * 1.4 + (faint ? 8 : 0), y: y * 1.4 + 4, "text-anchor": "middle", class: "triad-text" },
            name,
          ),
        ];
      }),
    );
  }
}
