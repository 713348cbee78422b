/** What is drawn in the frame of the workpiece besides its body: tool path, surface, and what a tab adds. */

import { Group, type Object3D } from "three";
import { type ColourBarSpec, colourBar } from "../figure/colourbar.ts";
import { cssColour } from "../theme.ts";
import { type PathData, PathLayer, type SurfaceData, SurfaceLayer } from "./layers.ts";

/** A colour bar; its colours and its range are those of the layer. */
export type BarWords = Omit<ColourBarSpec, "range" | "map">;

export class WorkpieceLayers {
  readonly group = new Group();
  path: PathLayer | null = null;
  private surface: SurfaceLayer | null = null;
  private readonly legend: HTMLElement;
  private k = 1;
  private show_ghost = true;

  constructor(legend: HTMLElement) {
    this.legend = legend;
  }

  add(object: Object3D): void {
    this.group.add(object);
  }

  setPath(data: PathData | null, most_points: number, bar?: BarWords): void {
    this.path?.group.removeFromParent();
    this.path?.dispose();
    this.path = data && new PathLayer(data, cssColour("--scene-ghost"), most_points);
    if (this.path) {
      this.path.setExaggeration(this.k);
      this.path.setGhostVisible(this.show_ghost);
      this.add(this.path.group);
    }
    this.showBar(this.path && data && bar ? { ...bar, range: this.path.range, map: data.map } : null);
  }

  setSurface(data: SurfaceData | null, bar?: BarWords): void {
    this.surface?.group.removeFromParent();
    this.surface?.dispose();
    this.surface = data && new SurfaceLayer(data);
    if (this.surface) {
      this.surface.setExaggeration(this.k);
      this.add(this.surface.group);
    }
    this.showBar(this.surface && data && bar ? { ...bar, range: this.surface.range, map: data.map } : null);
  }

  setExaggeration(k: number): void {
    if (k === this.k) return;
    this.k = k;
    this.path?.setExaggeration(k);
    this.surface?.setExaggeration(k);
  }

  setGhostVisible(visible: boolean): void {
    this.show_ghost = visible;
    this.path?.setGhostVisible(visible);
  }

  showBar(spec: ColourBarSpec | null): void {
    this.legend.replaceChildren(...(spec ? [colourBar(spec)] : []));
  }
}
