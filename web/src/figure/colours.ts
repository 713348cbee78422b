/**
 * Colour maps, computed in OKLCH so that lightness rises evenly (readable in grey and by
 * colour-blind people). Oklab: B. Ottosson 2020, "A perceptual color space for image processing".
 */

export type Rgb = [number, number, number];
export type ColourMap = (t: number) => Rgb;

const gamma = (x: number): number => (x <= 0.0031308 ? 12.92 * x : 1.055 * Math.max(0, x) ** (1 / 2.4) - 0.055);
// What is not a number becomes 0, not NaN.
const clamp01 = (x: number): number => (x > 1 ? 1 : x > 0 ? x : 0);

/** Lightness 0…1, chroma, hue in degrees -> sRGB 0…1. */
export function oklch(lightness: number, chroma: number, hue_deg: number): Rgb {
  const a = chroma * Math.cos((hue_deg * Math.PI) / 180);
  const b = chroma * Math.sin((hue_deg * Math.PI) / 180);
  const l = (lightness + 0.3963377774 * a + 0.2158037573 * b) ** 3;
  const m = (lightness - 0.1055613458 * a - 0.0638541728 * b) ** 3;
  const s = (lightness - 0.0894841775 * a - 1.291485548 * b) ** 3;
  return [
    clamp01(gamma(4.0767416621 * l - 3.3077115913 * m + 0.2309699292 * s)),
    clamp01(gamma(-1.2684380046 * l + 2.6097574011 * m - 0.3413193965 * s)),
    clamp01(gamma(-0.0041960863 * l - 0.7034186147 * m + 1.707614701 * s)),
  ];
}

/** Low to high: violet, blue, green, yellow. */
export const sequential: ColourMap = (t) => {
  const x = clamp01(t);
  return oklch(0.32 + 0.58 * x, 0.13 + 0.04 * Math.sin(Math.PI * x), 305 - 200 * x);
};

/** Negative blue, zero neutral, positive orange; t = 0.5 is zero. */
export const diverging: ColourMap = (t) => {
  const x = 2 * clamp01(t) - 1;
  const strength = Math.abs(x);
  return oklch(0.93 - 0.4 * strength, 0.15 * strength, x < 0 ? 250 : 50);
};

/** `diverging` for dark pages: zero is dark. */
export const divergingDark: ColourMap = (t) => {
  const x = 2 * clamp01(t) - 1;
  const strength = Math.abs(x);
  return oklch(0.3 + 0.45 * strength, 0.14 * strength, x < 0 ? 250 : 50);
};

export function css([r, g, b]: Rgb): string {
  const hex = (x: number): string =>
    Math.round(255 * clamp01(x))
      .toString(16)
      .padStart(2, "0");
  return `#${hex(r)}${hex(g)}${hex(b)}`;
}

const linear = (x: number): number => (x <= 0.04045 ? x / 12.92 : ((x + 0.055) / 1.055) ** 2.4);

/** 256 colours as linear-light bytes, as vertex colours of the 3-D scene want them. */
export function colourTable(map: ColourMap): Uint8Array {
  const table = new Uint8Array(256 * 3);
  for (let i = 0; i < 256; i++) map(i / 255).forEach((c, j) => (table[3 * i + j] = Math.round(255 * linear(c))));
  return table;
}

/** The range of finite values; `[0, 1]` if there are none. */
export function rangeOf(values: ArrayLike<number>): [number, number] {
  let low = Infinity;
  let high = -Infinity;
  for (let i = 0; i < values.length; i++) {
    const v = values[i] as number;
    if (v < low) low = v;
    if (v > high) high = v;
  }
  return low <= high ? [low, high] : [0, 1];
}

/** Series colours as CSS variables, in order. */
export function seriesColour(index: number): string {
  return `var(--series-${(index % 7) + 1})`;
}
