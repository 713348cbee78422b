/** The stations of a path on the machine: tool points and tool axes, and the machine at one of them. */

import {
  BufferAttribute,
  BufferGeometry,
  Group,
  Line,
  LineBasicMaterial,
  LineSegments,
  Points,
  PointsMaterial,
} from "three";
import { rangeOf } from "../../figure/colours.ts";
import { cssColour, onTheme } from "../../theme.ts";
import type { MachineView } from "../../scene/view.ts";

/** 6 per station: point in mm, unit vector of the tool axis, both in the workpiece frame. */
export class StationLayer {
  private readonly view: MachineView;
  private readonly group = new Group();
  private tools: ArrayLike<number> = [];
  private at = 0;
  /** Length of the strokes and size of the whole, mm. */
  private stroke = 40;
  private middle: [number, number, number] = [0, 0, 0];
  private extent = 0;

  constructor(view: MachineView) {
    this.view = view;
    onTheme(() => this.draw());
  }

  /** `tool_mm`: the length of the tool, so that strokes from one and the same point are seen. */
  show(tools: ArrayLike<number>, at: number, tool_mm: number): void {
    this.tools = tools;
    this.at = at;
    const ranges = [0, 1, 2].map((j) =>
      rangeOf(Array.from({ length: Math.floor(tools.length / 6) }, (_, i) => tools[6 * i + j] as number)),
    );
    this.middle = ranges.map(([low, high]) => (low + high) / 2) as [number, number, number];
    this.extent = Math.max(...ranges.map(([low, high]) => high - low));
    this.stroke = Math.max(20, 0.2 * this.extent, 0.4 * tool_mm);
    this.draw();
  }

  /** Brings all stations close. */
  closeUp(): void {
    this.view.lookAtWorkpiece(this.middle, this.extent / 2 + 2.6 * this.stroke);
  }

  mark(at: number): void {
    this.at = at;
    this.draw();
  }

  private clear(): void {
    for (const child of this.group.children as (Line | Points)[]) {
      child.geometry.dispose();
      (child.material as LineBasicMaterial).dispose();
    }
    this.group.clear();
  }

  private draw(): void {
    this.clear();
    const n = Math.floor(this.tools.length / 6);
    if (n === 0) return;
    const point = (i: number, along = 0): number[] =>
      [0, 1, 2].map((j) => (this.tools[6 * i + j] as number) + along * (this.tools[6 * i + 3 + j] as number));
    const every = Array.from({ length: n }, (_, i) => i);
    const { stroke } = this;
    this.add(
      new Line(
        geometry(every.flatMap((i) => point(i))),
        new LineBasicMaterial({ color: cssColour("--muted"), transparent: true, opacity: 0.5, depthTest: false }),
      ),
    );
    this.add(
      new LineSegments(
        geometry(every.flatMap((i) => [...point(i), ...point(i, stroke)])),
        new LineBasicMaterial({ color: cssColour("--series-1"), transparent: true, opacity: 0.75, depthTest: false }),
      ),
    );
    this.add(
      new Points(
        geometry(every.flatMap((i) => point(i))),
        new PointsMaterial({
          color: cssColour("--series-1"),
          size: 5,
          sizeAttenuation: false,
          depthTest: false,
          transparent: true,
        }),
      ),
    );
    if (this.at < n) {
      this.add(
        new LineSegments(
          geometry([...point(this.at), ...point(this.at, 1.6 * stroke)]),
          new LineBasicMaterial({ color: cssColour("--actual"), depthTest: false, transparent: true }),
        ),
      );
      this.add(
        new Points(
          geometry(point(this.at)),
          new PointsMaterial({
            color: cssColour("--actual"),
            size: 11,
            sizeAttenuation: false,
            depthTest: false,
            transparent: true,
          }),
        ),
      );
    }
    this.view.addToWorkpiece(this.group);
  }

  private add(object: Line | Points): void {
    object.frustumCulled = false;
    object.renderOrder = 8;
    this.group.add(object);
  }
}

function geometry(positions: number[]): BufferGeometry {
  return new BufferGeometry().setAttribute("position", new BufferAttribute(Float32Array.from(positions), 3));
}
