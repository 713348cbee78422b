/** The picture with its words as a PNG file. */

import { download, h } from "../dom.ts";
import { cssColour } from "../theme.ts";
import type { Overlay } from "./overlay.ts";

/** `from` has just been drawn; `width` is that of the picture in CSS points. */
export function savePng(name: string, from: HTMLCanvasElement, width: number, overlay: Overlay): void {
  const canvas = h("canvas", { width: from.width, height: from.height });
  const paint = canvas.getContext("2d");
  if (!paint) return;
  const sky = paint.createLinearGradient(0, 0, 0, from.height);
  sky.addColorStop(0, cssColour("--scene-top"));
  sky.addColorStop(1, cssColour("--scene-bottom"));
  paint.fillStyle = sky;
  paint.fillRect(0, 0, from.width, from.height);
  paint.drawImage(from, 0, 0);
  const scale = from.width / width;
  paint.scale(scale, scale);
  paint.font = "600 12px system-ui, sans-serif";
  paint.textAlign = "center";
  paint.textBaseline = "middle";
  paint.fillStyle = cssColour("--ink");
  for (const { text, x, y } of overlay.texts()) paint.fillText(text, x, y);
  canvas.toBlob((blob) => blob && download(`${name}.png`, blob));
}
