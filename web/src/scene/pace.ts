/** How much is drawn: all of it with a graphics processor, less where the processor has to draw. */

import type { WebGLRenderer } from "three";

/** Points per CSS point of a moving picture without a graphics processor, and of one at rest. */
const HURRIED = 0.75;
const AT_REST = 2;
const REST_MS = 250;

/** Asked before the real context is made: it is made without smoothing where that is slow. */
export function drawnByProcessor(): boolean {
  const gl = document.createElement("canvas").getContext("webgl2");
  const info = gl?.getExtension("WEBGL_debug_renderer_info");
  const name = gl && info ? String(gl.getParameter(info.UNMASKED_RENDERER_WEBGL)) : "";
  gl?.getExtension("WEBGL_lose_context")?.loseContext();
  return /swiftshader|llvmpipe|software|basic render/i.test(name);
}

export class Pace {
  /** Most points of a path that are drawn. */
  readonly most_points: number;
  hurries = false;
  private readonly slow: boolean;
  private readonly renderer: WebGLRenderer;
  private readonly draw: () => void;
  private rest: ReturnType<typeof setTimeout> | undefined;

  constructor(renderer: WebGLRenderer, slow: boolean, draw: () => void) {
    this.renderer = renderer;
    this.slow = slow;
    this.draw = draw;
    this.most_points = slow ? 20_000 : 2_000_000;
    renderer.setPixelRatio(Math.min(2, devicePixelRatio));
  }

  /** Something moved: few points now, a smooth picture once it rests. */
  moved(): void {
    if (!this.slow) return;
    if (!this.hurries) this.renderer.setPixelRatio(HURRIED);
    this.hurries = true;
    clearTimeout(this.rest);
    this.rest = setTimeout(() => {
      this.hurries = false;
      this.renderer.setPixelRatio(AT_REST);
      this.draw();
    }, REST_MS);
  }
}
