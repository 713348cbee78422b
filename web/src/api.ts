/** The server's answers, typed, over one WebSocket that reconnects by itself. */

import { decodeFrame, type Frame } from "./frame.ts";

export { latestOnly } from "./latest.ts";

// ---- documents -------------------------------------------------------------------------------

export type Vector = [number, number, number];
export type FileKind = "machine" | "study" | "campaign" | "program" | "readings" | "setup" | "cl" | "other";

export interface Diagnostic {
  code: string;
  severity: "error" | "warning" | "notice" | string;
  file?: string | null;
  line?: number | null;
  column?: number | null;
  message: string;
  hint?: string | null;
}

export interface Example {
  tab: string;
  title: string;
  what: string;
  path: string;
  machine?: string | null;
  program?: string | null;
  standard?: string | null;
}

export interface ProjectFile {
  path: string;
  kind: FileKind;
  bytes: number;
}

export interface Project {
  folder: string;
  version: string;
  examples: Example[];
  files: ProjectFile[];
}

export interface OpenFile {
  path: string;
  text: string;
  version: string;
}

/** `[from, to]` in mm or deg; "unlimited"; null where the machine file states none. */
export type Travel = [number, number] | "unlimited" | null;

/** One link of the chain, in chain order without the bed: w, axes, t. */
export interface Link {
  name: string;
  kind: "workpiece" | "linear" | "rotary" | "tool";
  carries: "workpiece" | "tool";
  direction: Vector;
  /** +1: a positive command moves the body in `direction`; default by ISO 841: −1 if it carries the workpiece. */
  sense?: number | null;
  /** Index in `links`; null is the bed. */
  parent: number | null;
  /** Rotation row by row, then origin mm: parent_from_body with the axis at 0. */
  placement: number[];
  travel: Travel;
}

export type Shape =
  | { box: Vector }
  | { cone: { base_diameter_mm: number; top_diameter_mm: number; length_mm: number } }
  | { prism: { outline_mm: [number, number][]; length_mm: number } }
  /** Its surface comes with `models` (scene/models.ts). */
  | { stl: { path: string; unit_mm: number } }
  | { mesh: ArrayLike<number> };

export interface Model {
  name: string;
  /** Index in `links`; null is the bed. */
  body: number | null;
  placement: number[];
  shape: Shape;
}

export interface ToolShape {
  length_mm: number;
  diameter_mm: number | null;
  /** The tip in the body t; without it straight below, at the length. */
  tip_mm?: Vector | null;
  /** Diameter and length of its cylinders, from the tip upwards, if they are known. */
  segments_mm?: readonly [number, number][];
}

/** A surface as its triangles: the answer has their corners one after the other, model after model. */
export interface SurfaceModel {
  name: string;
  /** Index in `links`; null is the bed. */
  body: number | null;
  placement: number[];
  triangles: number;
}

/** What the 3-D scene needs of a machine. */
export interface MachineDescription {
  links: Link[];
  models: Model[];
  tool: ToolShape;
}

export interface AxisDocument {
  name: string;
  carries: "workpiece" | "tool";
  direction: Vector;
  sense: number;
  travel_mm?: Travel;
  travel_deg?: Travel;
}

export interface CheckDocument {
  schema: string;
  usable: boolean;
  diagnostics: Diagnostic[];
  /** What follows stands there of a usable machine only. */
  name?: string;
  chain?: string;
  source?: string | null;
  axes?: AxisDocument[];
  errors?: string[];
  lacks?: string[];
  [more: string]: unknown;
}

/** An error motion over the travel of its axis, in the unit of its error. */
export interface ErrorCurve {
  at: number[];
  at_unit: "mm" | "deg";
  /** The mean of both directions. */
  values: number[];
  reversal: number[] | null;
  /** Standard uncertainty. */
  u: number[] | null;
}

/** One error that the machine has or could have. */
export interface ErrorEntry {
  name: string;
  /** Index in `links`. */
  body: number;
  kind: "location" | "motion";
  unit: "um" | "urad";
  stated: boolean;
  shape: "constant" | "polynomial" | "fourier" | "table" | null;
  /** As people write it, if it has an entry of its own. */
  text: string | null;
  line: number | null;
  /** The table of its axis, if it stands in that. */
  table: string | null;
  /** The value if it is the same everywhere. */
  value: number | null;
  /** Standard uncertainty; the greatest of a curve. */
  u: number | null;
  curve: ErrorCurve | null;
  measured: { instrument: string | null; date: string | null; temperature_celsius: number | null } | null;
}

export interface Sensor {
  name: string;
  /** What it tells of: "scale of X", "EZ0t", "workpiece". */
  drives: string[];
}

/** A tool assembly of the machine file. */
export interface ToolEntry {
  name: string;
  length_mm: number;
  diameter_mm: number | null;
  [more: string]: unknown;
}

export interface Description extends MachineDescription {
  check: CheckDocument;
  version: string;
  text: string;
  errors: ErrorEntry[];
  sensors: Sensor[];
  tools: ToolEntry[];
}

export interface PoseBudgetEntry {
  error: string;
  tip_um: Vector;
  axis_urad: Vector;
}

/** The document of `trueaxis pose --format json`. */
export interface PoseDocument {
  schema: string;
  nominal: { tip_mm: Vector; axis: Vector };
  actual: { tip_mm: Vector; axis: Vector };
  deviation: { tip_um: Vector; axis_urad: Vector };
  budget: PoseBudgetEntry[];
  [more: string]: unknown;
}

export interface PoseHeader {
  pose: PoseDocument;
  bodies: string[];
  diagnostics: Diagnostic[];
}

/** With `corners_mm`: nine numbers per triangle, model after model. */
export interface ModelsHeader {
  models: SurfaceModel[];
  diagnostics: Diagnostic[];
}

/** Names whose replies have a type; every other name may be asked with a type of the caller. */
export interface Replies {
  project: Project;
  open: OpenFile;
  save: { path: string; version: string };
  describe: Description;
  "set-error": { text: string; diagnostics: Diagnostic[] };
  pose: Frame<PoseHeader>;
  models: Frame<ModelsHeader>;
}

// ---- errors ----------------------------------------------------------------------------------

/** The server (or the connection) said no. */
export class Refusal extends Error {
  readonly code: string;
  readonly hint: string;
  readonly diagnostics: Diagnostic[];

  constructor(code: string, message: string, hint = "", diagnostics: Diagnostic[] = []) {
    super(message);
    this.name = "Refusal";
    this.code = code;
    this.hint = hint;
    this.diagnostics = diagnostics;
  }

  static from(error: unknown): Refusal {
    if (error instanceof Refusal) return error;
    return new Refusal("page", error instanceof Error ? error.message : String(error));
  }
}

interface RefusalDocument {
  code?: string;
  message?: string;
  hint?: string | null;
  diagnostics?: Diagnostic[];
}

function refusal(doc: RefusalDocument | undefined): Refusal {
  return new Refusal(
    doc?.code ?? "unknown",
    doc?.message ?? "the server refused",
    doc?.hint ?? "",
    doc?.diagnostics ?? [],
  );
}

// ---- connection ------------------------------------------------------------------------------

export interface AskOptions {
  onProgress?: (share: number, note: string) => void;
  signal?: AbortSignal;
}

/** A file was saved. Without a path some news was missed: any file may have changed. */
export interface Change {
  path?: string;
  version?: string;
  /** The window that saved it. */
  window?: string | null;
}

interface Pending {
  resolve: (value: unknown) => void;
  reject: (error: Refusal) => void;
  onProgress?: ((share: number, note: string) => void) | undefined;
}

export type ConnectionState = "connecting" | "open" | "lost";

/** Some characters that no other window has (`crypto.randomUUID` is not there beyond loopback). */
const windowName = (): string =>
  [...crypto.getRandomValues(new Uint8Array(8))].map((byte) => byte.toString(16).padStart(2, "0")).join("");

export class Api {
  onState: (state: ConnectionState) => void = () => {};
  onChange: (change: Change) => void = () => {};
  private socket: WebSocket | null = null;
  private opening: Promise<WebSocket> | null = null;
  private readonly pending = new Map<number, Pending>();
  private next_id = 1;
  private retry_ms = 250;
  private retry: ReturnType<typeof setTimeout> | undefined;
  private was_lost = false;
  /** Goes with every save, so that this window knows its own. */
  readonly window = windowName();

  /** Asks `name`; resolves with the reply, or with a `Frame` where the reply is binary. */
  ask<N extends keyof Replies>(name: N, body: object, options?: AskOptions): Promise<Replies[N]>;
  ask<T>(name: string, body: object, options?: AskOptions): Promise<T>;
  async ask(name: string, body: object, options: AskOptions = {}): Promise<unknown> {
    options.signal?.throwIfAborted();
    const socket = await this.connect();
    const id = this.next_id++;
    return new Promise((resolve, reject) => {
      this.pending.set(id, { resolve, reject, onProgress: options.onProgress });
      options.signal?.addEventListener("abort", () => {
        if (!this.pending.delete(id)) return;
        if (socket.readyState === WebSocket.OPEN) socket.send(JSON.stringify({ id, stop: true }));
        reject(new DOMException("aborted", "AbortError"));
      });
      socket.send(JSON.stringify({ id, ask: name, body }));
    });
  }

  /** The same over `POST`, for what the browser keeps as a file (reports). */
  async post(name: string, body: object): Promise<Blob> {
    const response = await fetch(`api/${name}`, {
      method: "POST",
      headers: { "content-type": "application/json" },
      body: JSON.stringify(body),
    });
    if (!response.ok) {
      const doc = (await response.json().catch(() => ({}))) as { error?: RefusalDocument };
      throw refusal(doc.error ?? { code: String(response.status), message: response.statusText });
    }
    return response.blob();
  }

  connect(): Promise<WebSocket> {
    if (this.socket?.readyState === WebSocket.OPEN) return Promise.resolve(this.socket);
    this.opening ??= this.open().finally(() => (this.opening = null));
    return this.opening;
  }

  private open(): Promise<WebSocket> {
    this.onState("connecting");
    const url = new URL("api/socket", location.href);
    url.protocol = location.protocol === "https:" ? "wss:" : "ws:";
    url.search = url.hash = "";
    const socket = new WebSocket(url);
    socket.binaryType = "arraybuffer";
    return new Promise((resolve, reject) => {
      socket.onopen = () => {
        this.socket = socket;
        this.retry_ms = 250;
        this.onState("open");
        resolve(socket);
        // What others saved while the connection was gone was not told.
        if (this.was_lost) this.onChange({});
        this.was_lost = false;
      };
      socket.onmessage = (event) => this.receive(event.data as string | ArrayBuffer);
      socket.onclose = () => {
        const lost = new Refusal(
          "connection",
          "no connection to TrueAxis",
          "Is `trueaxis serve` still running? The page reconnects by itself.",
        );
        reject(lost);
        if (this.socket === socket || this.socket === null) this.lose(lost);
      };
    });
  }

  private lose(lost: Refusal): void {
    this.socket = null;
    this.was_lost = true;
    for (const waiting of this.pending.values()) waiting.reject(lost);
    this.pending.clear();
    this.onState("lost");
    clearTimeout(this.retry);
    this.retry = setTimeout(() => void this.connect().catch(() => undefined), this.retry_ms);
    this.retry_ms = Math.min(8000, this.retry_ms * 2);
  }

  private receive(data: string | ArrayBuffer): void {
    if (typeof data !== "string") {
      const frame = decodeFrame(data);
      this.settle(frame.header.id, (waiting) => waiting.resolve(frame));
      return;
    }
    const message = JSON.parse(data) as {
      id?: number;
      progress?: number;
      note?: string;
      reply?: unknown;
      error?: RefusalDocument;
      changed?: Change;
    };
    if (message.changed) this.onChange(message.changed);
    else if (message.progress !== undefined)
      this.pending.get(message.id ?? -1)?.onProgress?.(message.progress, message.note ?? "");
    else if (message.error) this.settle(message.id, (waiting) => waiting.reject(refusal(message.error)));
    else this.settle(message.id, (waiting) => waiting.resolve(message.reply));
  }

  private settle(id: number | undefined, how: (waiting: Pending) => void): void {
    const waiting = id === undefined ? undefined : this.pending.get(id);
    if (!waiting || id === undefined) return;
    this.pending.delete(id);
    how(waiting);
  }
}
