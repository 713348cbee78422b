/** A drawing of any error by its name: the nominal body dashed, the actual one where the error has moved it. */

import { s } from "../dom.ts";
import { handed, third, type ErrorName, type Letter } from "./names.ts";

const [WIDTH, HEIGHT] = [320, 190];
const [X0, Y0] = [176, 96];
/** How far a body is displaced, px, and turned, degrees. */
const SHIFT = 26;
const TURN = 11;

type Shape = "carriage" | "section" | "rail" | "line" | "disc" | "disc from the side" | "body";

interface Sketch {
  /** To the right, upwards. */
  right: Letter;
  up: Letter;
  shape: Shape;
}

const after: Record<Letter, Letter> = { X: "Y", Y: "Z", Z: "X" };
const beside: Record<Letter, Letter> = { X: "Z", Y: "Z", Z: "X" };
/** The axis points to who looks. */
const along = (own: Letter): { right: Letter; up: Letter } => ({ right: after[own], up: after[after[own]] });

/** From where the error is seen best. */
function sketchOf({ kind, how, direction, body, own }: ErrorName): Sketch {
  if (own === null)
    return how === "about"
      ? { ...along(direction), shape: "body" }
      : { right: "X", up: direction === "Y" ? "Y" : "Z", shape: "body" };
  const is_own = direction === own;
  if (body === "rotary") {
    if (is_own === (how === "along"))
      return { right: is_own ? after[own] : third(own, direction), up: own, shape: "disc from the side" };
    return { ...along(own), shape: "disc" };
  }
  if (how === "along")
    return { right: own, up: is_own ? beside[own] : direction, shape: kind === "motion" ? "carriage" : "rail" };
  if (is_own) return { ...along(own), shape: "section" };
  return kind === "motion"
    ? { right: own, up: third(own, direction), shape: "carriage" }
    : { right: third(own, direction), up: own, shape: "line" };
}

const still = { fill: "none", stroke: "var(--line-strong)", "stroke-width": 1.6 };
const text = (x: number, y: number, words: string, more: Record<string, string | number> = {}): SVGElement =>
  s("text", { x, y, fill: "var(--ink)", "font-size": 12, "text-anchor": "middle", ...more }, words);

/** What does not move: the guideway, the datum axis, the nominal centre. */
function ground(shape: Shape, { right }: Sketch, axis: string): SVGElement[] {
  if (shape === "carriage")
    return [
      s("rect", { x: 66, y: Y0 + 24, width: 224, height: 14, fill: "var(--raised)", stroke: "var(--line-strong)" }),
      text(303, Y0 + 35, axis, { fill: "var(--muted)" }),
    ];
  if (shape === "section")
    return [
      s("path", {
        d: `M${X0 - 34} ${Y0 + 46}V${Y0 + 30}h14v-8h40v8h14v16Z`,
        fill: "var(--raised)",
        stroke: "var(--line-strong)",
      }),
    ];
  if (shape === "line")
    return [s("line", { x1: X0 - 90, x2: X0 + 44, y1: Y0 + 56, y2: Y0 + 56, ...still }), text(X0 + 54, Y0 + 60, right)];
  if (shape === "disc")
    return [
      s("path", {
        d: `M${X0 - 66} ${Y0}H${X0 + 66}M${X0} ${Y0 - 66}V${Y0 + 66}`,
        ...still,
        "stroke-dasharray": "9 3 2 3",
      }),
    ];
  if (shape === "disc from the side") return [s("path", { d: `M${X0 - 60} ${Y0 + 66}H${X0 + 60}`, ...still })];
  return [];
}

/** The body itself; the same shape is drawn as it should be and as it is. */
function outline(shape: Shape, axis: string): SVGElement[] {
  if (shape === "carriage") return [s("rect", { x: X0 - 40, y: Y0 - 16, width: 80, height: 40, rx: 2 })];
  if (shape === "section")
    return [
      s("path", {
        d: `M${X0 - 48} ${Y0 + 34}V${Y0 - 10}H${X0 + 48}V${Y0 + 34}H${X0 + 30}V${Y0 + 14}H${X0 - 30}V${Y0 + 34}Z`,
      }),
    ];
  if (shape === "rail")
    return [
      s("rect", { x: X0 - 92, y: Y0 - 8, width: 184, height: 16 }),
      s("path", { d: `M${X0} ${Y0 - 18}V${Y0 + 18}` }),
      text(X0, Y0 + 30, "0", { "font-size": 11, "stroke-width": 0, "fill-opacity": 1 }),
    ];
  if (shape === "line")
    return [
      s("path", { d: `M${X0} ${Y0 + 56}V${Y0 - 62}M${X0 - 4} ${Y0 - 54}L${X0} ${Y0 - 63}L${X0 + 4} ${Y0 - 54}` }),
      text(X0 + 12, Y0 - 54, axis, { "stroke-width": 0, "fill-opacity": 1 }),
    ];
  if (shape === "disc")
    return [
      s("circle", { cx: X0, cy: Y0, r: 46 }),
      s("path", { d: `M${X0} ${Y0}L${X0 + 46} ${Y0}M${X0 + 52} ${Y0 - 5}L${X0 + 46} ${Y0}L${X0 + 52} ${Y0 + 5}` }),
    ];
  if (shape === "disc from the side")
    return [
      s("rect", { x: X0 - 52, y: Y0 - 6, width: 104, height: 18, rx: 2 }),
      s("path", { d: `M${X0} ${Y0 + 66}V${Y0 - 66}`, "stroke-dasharray": "9 3 2 3" }),
    ];
  return [
    s("rect", { x: X0 - 40, y: Y0 - 30, width: 80, height: 60, rx: 2 }),
    s("path", { d: `M${X0 - 30} ${Y0 + 20}h26M${X0 - 30} ${Y0 + 20}v-26` }),
  ];
}

/** An arrow with its head, along a path that ends at (x, y) in a direction (degrees, SVG). */
function arrow(path: string, x: number, y: number, degrees: number): SVGElement[] {
  const at = { stroke: "var(--accent)", "stroke-width": 2.2, fill: "none" };
  return [
    s("path", { d: path, ...at }),
    s("path", { d: "M-8 -5L0 0L-8 5", ...at, transform: `translate(${x} ${y}) rotate(${degrees})` }),
  ];
}

/** The directions of the machine, at the lower left; the third one towards or away from who looks. */
function triad({ right, up }: Sketch): SVGElement[] {
  const [x, y] = [20, HEIGHT - 22];
  const line = { stroke: "var(--muted)", "stroke-width": 1.3, fill: "none" };
  const towards = handed(right, up) > 0;
  return [
    s("path", { d: `M${x} ${y}h26m-5 -3.5l5 3.5l-5 3.5M${x} ${y}v-26m-3.5 5l3.5 -5l3.5 5`, ...line }),
    s("circle", { cx: x, cy: y, r: 4.5, fill: "var(--surface)", stroke: "var(--muted)" }),
    towards
      ? s("circle", { cx: x, cy: y, r: 1.6, fill: "var(--muted)" })
      : s("path", { d: `M${x - 3} ${y - 3}l6 6m0 -6l-6 6`, ...line }),
    text(x + 35, y + 4, right, { fill: "var(--muted)" }),
    text(x, y - 32, up, { fill: "var(--muted)" }),
    text(x - 11, y + 14, third(right, up), { fill: "var(--muted)" }),
  ];
}

/** Beside the body. */
const labelAt = (shape: Shape, right: boolean): [number, number] =>
  !right ? [X0 + 76, Y0 - 46] : shape === "rail" ? [X0 + 62, Y0 - 26] : [X0 + 100, Y0 + 5];

/** A function of the position, or the same everywhere: a curve, or a level line, at the lower right. */
function course({ kind, axis }: ErrorName): SVGElement[] {
  const [x, y] = [WIDTH - 84, HEIGHT - 18];
  const wave = `M${x} ${y - 8}c8 -14 16 -14 24 -4s16 12 22 2s10 -10 14 -6`;
  return [
    s("path", { d: `M${x} ${y - 22}V${y}H${x + 66}`, stroke: "var(--muted)", fill: "none" }),
    s("path", {
      d: kind === "motion" ? wave : `M${x} ${y - 12}h62`,
      stroke: "var(--actual)",
      "stroke-width": 1.6,
      fill: "none",
    }),
    text(x + 74, y + 4, axis, { fill: "var(--muted)" }),
  ];
}

/** Where the foot of a leaning axis stays. */
const pivot = (shape: Shape): [number, number] =>
  shape === "line" ? [X0, Y0 + 56] : shape === "carriage" ? [X0, Y0 + 4] : [X0, Y0];

export function errorDrawing(error: ErrorName, label: string): SVGSVGElement {
  const sketch = sketchOf(error);
  const { shape, right, up } = sketch;
  const [px, py] = pivot(shape);
  let transform: string;
  let sign: SVGElement[];
  if (error.how === "along") {
    const [dx, dy] = error.direction === right ? [SHIFT, 0] : [0, -SHIFT];
    transform = `translate(${dx} ${dy})`;
    const [x, y] = [X0 + dx * 1.9, Y0 + dy * 1.9];
    sign = [
      ...arrow(`M${X0} ${Y0}L${x} ${y}`, x, y, dx ? 0 : -90),
      text(...labelAt(shape, dx > 0), error.name, { fill: "var(--accent)", "font-weight": 600 }),
    ];
  } else {
    // A positive rotation about what points to the reader goes from right to up: against the clock.
    const clockwise = handed(right, up) < 0;
    transform = `rotate(${clockwise ? TURN : -TURN} ${px} ${py})`;
    const r = shape === "line" ? 96 : 66;
    const [from, to] = shape === "line" ? (clockwise ? [-104, -66] : [-76, -114]) : clockwise ? [-40, 10] : [-20, -62];
    const point = (degrees: number): [number, number] => [
      px + r * Math.cos((degrees * Math.PI) / 180),
      py + r * Math.sin((degrees * Math.PI) / 180),
    ];
    const [a, b] = [point(from), point(to)];
    const path = `M${a[0]} ${a[1]}A${r} ${r} 0 0 ${clockwise ? 1 : 0} ${b[0]} ${b[1]}`;
    sign = [
      ...arrow(path, b[0], b[1], to + (clockwise ? 90 : -90)),
      text(shape === "line" ? px + (clockwise ? 74 : -74) : px + 92, shape === "line" ? py - 92 : py - 34, error.name, {
        fill: "var(--accent)",
        "font-weight": 600,
      }),
    ];
  }
  const nominal = { fill: "none", stroke: "var(--nominal)", "stroke-width": 1.2, "stroke-dasharray": "4 3" };
  const actual = { fill: "var(--actual)", "fill-opacity": 0.16, stroke: "var(--actual)", "stroke-width": 1.8 };
  return s(
    "svg",
    {
      viewBox: `0 0 ${WIDTH} ${HEIGHT}`,
      width: WIDTH,
      height: HEIGHT,
      role: "img",
      "aria-label": label,
      class: "error-drawing",
    },
    ground(shape, sketch, error.axis),
    s(
      "g",
      nominal,
      outline(shape, error.axis).filter((one) => one.tagName !== "text"),
    ),
    s("g", { ...actual, transform }, outline(shape, error.axis)),
    sign,
    triad(sketch),
    error.own === null ? [] : course(error),
  );
}
