/** The binary frame of the server: a JSON header, then typed arrays, each on a multiple of 8 bytes. */

export type NumberArray = Float64Array | Float32Array | Uint32Array | Uint8Array;
export type ElementType = "f64" | "f32" | "u32" | "u8";

export interface ArrayHeader {
  name: string;
  type: ElementType;
  count: number;
}

const SIZE: Record<ElementType, number> = { f64: 8, f32: 4, u32: 4, u8: 1 };
const pad8 = (n: number): number => (n + 7) & ~7;

export class FrameError extends Error {}

/** A decoded frame: `header` as sent, arrays as views on the buffer (no copies). */
export class Frame<H = Record<string, unknown>> {
  readonly header: H & { id?: number; arrays: ArrayHeader[] };
  readonly arrays: ReadonlyMap<string, NumberArray>;

  constructor(header: H & { id?: number; arrays: ArrayHeader[] }, arrays: Map<string, NumberArray>) {
    this.header = header;
    this.arrays = arrays;
  }

  private take<T extends NumberArray>(name: string, type: { new (n: number): T; name: string }): T {
    const array = this.arrays.get(name);
    if (!(array instanceof type)) throw new FrameError(`the frame has no ${type.name} "${name}"`);
    return array;
  }

  f64(name: string): Float64Array {
    return this.take(name, Float64Array);
  }
  f32(name: string): Float32Array {
    return this.take(name, Float32Array);
  }
  u32(name: string): Uint32Array {
    return this.take(name, Uint32Array);
  }
  u8(name: string): Uint8Array {
    return this.take(name, Uint8Array);
  }
  has(name: string): boolean {
    return this.arrays.has(name);
  }
}

function view(buffer: ArrayBuffer, type: ElementType, offset: number, count: number): NumberArray {
  switch (type) {
    case "f64":
      return new Float64Array(buffer, offset, count);
    case "f32":
      return new Float32Array(buffer, offset, count);
    case "u32":
      return new Uint32Array(buffer, offset, count);
    case "u8":
      return new Uint8Array(buffer, offset, count);
  }
}

/** Decodes a frame; throws a `FrameError` that says what is wrong with it. */
export function decodeFrame<H = Record<string, unknown>>(buffer: ArrayBuffer): Frame<H> {
  if (buffer.byteLength < 4) throw new FrameError("the frame is shorter than its length field");
  const length = new DataView(buffer).getUint32(0, true);
  if (4 + length > buffer.byteLength) throw new FrameError(`the header of ${length} bytes is cut off`);
  const header = JSON.parse(new TextDecoder().decode(new Uint8Array(buffer, 4, length))) as H & {
    arrays: ArrayHeader[];
  };
  const arrays = new Map<string, NumberArray>();
  let offset = pad8(4 + length);
  for (const { name, type, count } of header.arrays ?? []) {
    const size = SIZE[type];
    if (size === undefined) throw new FrameError(`array "${name}" has the unknown type "${type}"`);
    if (offset + count * size > buffer.byteLength) throw new FrameError(`array "${name}" is cut off`);
    arrays.set(name, view(buffer, type, offset, count));
    offset = pad8(offset + count * size);
  }
  return new Frame<H>(header, arrays);
}

/** The other direction, for tests. */
export function encodeFrame(header: Record<string, unknown>, arrays: Record<string, NumberArray>): ArrayBuffer {
  const kinds = new Map<unknown, ElementType>([
    [Float64Array, "f64"],
    [Float32Array, "f32"],
    [Uint32Array, "u32"],
    [Uint8Array, "u8"],
  ]);
  const list = Object.entries(arrays).map(([name, a]) => ({
    name,
    type: kinds.get(a.constructor) as ElementType,
    count: a.length,
  }));
  const text = new TextEncoder().encode(JSON.stringify({ ...header, arrays: list }));
  let size = pad8(4 + text.length);
  for (const a of Object.values(arrays)) size += pad8(a.byteLength);
  const buffer = new ArrayBuffer(size);
  new DataView(buffer).setUint32(0, text.length, true);
  new Uint8Array(buffer, 4).set(text);
  let offset = pad8(4 + text.length);
  for (const a of Object.values(arrays)) {
    new Uint8Array(buffer, offset, a.byteLength).set(new Uint8Array(a.buffer, a.byteOffset, a.byteLength));
    offset += pad8(a.byteLength);
  }
  return buffer;
}
