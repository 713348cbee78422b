/** The server's answers, typed, over one WebSocket that reconnects by itself. */

import { tr } from "./words/index.ts";
import type {
  CheckDocument,
  DiagnosticEntry,
  Documents,
  LinkEntry,
  ModelEntry,
  MountedToolEntry,
  ServeDescribe,
  ServePose,
  ServeProject,
  ServeRefused,
  ServeSocket,
  SurfaceEntry,
} from "../types.d.ts";
import { decodeFrame, type Frame } from "./frame.ts";

export { latestOnly } from "./latest.ts";

// ---- documents: the types of the server, by the names of the page ------------------------------

export type Vector = [number, number, number];
export type Diagnostic = DiagnosticEntry;
export type Project = ServeProject;
export type Example = ServeProject["examples"][number];
export type ProjectFile = ServeProject["files"][number];
export type FileKind = ProjectFile["kind"];
/** `[from, to]` in mm or deg; "unlimited"; null where the machine file states none. */
export type Travel = LinkEntry["travel"];
export type Link = Pick<
  LinkEntry,
  "name" | "kind" | "carries" | "direction" | "sense" | "parent" | "placement" | "travel"
>;
/** Also the surfaces that come with `models` (scene/models.ts). */
export type Shape = ModelEntry["shape"] | { mesh: ArrayLike<number> };
export type Model = Omit<ModelEntry, "shape"> & { shape: Shape };
export type SurfaceModel = SurfaceEntry;
export type ToolShape = Omit<MountedToolEntry, "tip_mm"> & {
  tip_mm?: Vector | null;
  /** Diameter and length of its cylinders, from the tip upwards, if they are known. */
  segments_mm?: readonly [number, number][];
};

/** What the 3-D scene needs of a machine. */
export interface MachineDescription {
  links: Link[];
  models: Model[];
  /** Absent where the machine cannot be used. */
  tool?: ToolShape | null;
}

export type { CheckDocument };
export type AxisDocument = NonNullable<CheckDocument["axes"]>[number];
export type ErrorEntry = ServeDescribe["errors"][number];
export type ErrorCurve = NonNullable<ErrorEntry["curve"]>;
export type Sensor = ServeDescribe["sensors"][number];
export type ToolEntry = ServeDescribe["tools"][number];
export type Description = ServeDescribe;
export type PoseHeader = ServePose;
export type PoseDocument = ServePose["pose"];
export type PoseBudgetEntry = PoseDocument["budget"][number];

type Named<K> = K extends `serve-${infer Name}-request` ? Exclude<Name, "socket"> : never;
/** What can be asked. */
export type Question = Named<keyof Documents>;
export type Request<N extends Question> = Documents[`serve-${N}-request`];
export type Answer<N extends Question> = Documents[`serve-${N}` & keyof Documents];
/** Questions whose answers have arrays. */
type WithArrays =
  | "models"
  | "pose"
  | "predict"
  | "what-if"
  | "plan"
  | "identify"
  | "compensate-program"
  | "evaluate"
  | "simulate"
  | "simulation-at"
  | "simulation-stock"
  | "simulation-path"
  | "simulation-curves";
export type Reply<N extends Question> = N extends WithArrays ? Frame<Answer<N>> : Answer<N>;

// ---- errors ----------------------------------------------------------------------------------

/** The server (or the connection) said no. */
export class Refusal extends Error {
  readonly code: string;
  readonly hint: string;
  readonly diagnostics: Diagnostic[];
  /** Message and hint are those of the server, in English. */
  readonly of_server: boolean;

  constructor(code: string, message: string, hint = "", diagnostics: Diagnostic[] = [], of_server = false) {
    super(message);
    this.name = "Refusal";
    this.code = code;
    this.hint = hint;
    this.diagnostics = diagnostics;
    this.of_server = of_server;
  }

  static from(error: unknown): Refusal {
    if (error instanceof Refusal) return error;
    return new Refusal("page", error instanceof Error ? error.message : String(error));
  }
}

type RefusalDocument = Partial<ServeRefused["error"]>;

/** What is made of an answer has its files. */
export const sameFiles = <T>(made: T, answer: object): T => madeFrom(made, filesOf(answer));

const made_from = new WeakMap<object, readonly string[]>();

/** The files of the project that an answer or a refusal was made from; those that were looked for in vain, too. */
export const filesOf = (answer: unknown): readonly string[] =>
  (typeof answer === "object" && answer !== null && made_from.get(answer)) || [];

/** Notes them; what is no object has none. */
function madeFrom<T>(answer: T, files: readonly string[] | undefined): T {
  if (files && typeof answer === "object" && answer !== null) made_from.set(answer, files);
  return answer;
}

function refusal(doc: RefusalDocument | undefined): Refusal {
  return new Refusal(
    doc?.code ?? "unknown",
    doc?.message ?? tr`the server refused`,
    doc?.hint ?? "",
    doc?.diagnostics ?? [],
    Boolean(doc?.message),
  );
}

// ---- connection ------------------------------------------------------------------------------

export interface AskOptions {
  onProgress?: (share: number, note: string) => void;
  signal?: AbortSignal;
}

/** A file was saved. Without a path some changes were missed: any file may have changed. */
export type Change = Extract<ServeSocket, { changed: unknown }>["changed"];

interface Pending {
  resolve: (value: unknown) => void;
  reject: (error: Refusal) => void;
  onProgress?: ((share: number, note: string) => void) | undefined;
}

/** "strange": a server answers, and knows another token than this page. */
export type ConnectionState = "connecting" | "open" | "lost" | "strange";

/** Some characters that no other window has (`crypto.randomUUID` is not there beyond loopback). */
const windowName = (): string =>
  [...crypto.getRandomValues(new Uint8Array(8))].map((byte) => byte.toString(16).padStart(2, "0")).join("");

/** So long a server may be busy with what was given up. */
const BUSY_MS = 60_000;

function pause(ms: number, signal: AbortSignal | undefined): Promise<void> {
  return new Promise((resolve, reject) => {
    const aborted = (): void => {
      clearTimeout(timer);
      reject(new DOMException("aborted", "AbortError"));
    };
    const timer = setTimeout(() => {
      signal?.removeEventListener("abort", aborted);
      resolve();
    }, ms);
    if (signal?.aborted) aborted();
    else signal?.addEventListener("abort", aborted, { once: true });
  });
}

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
  private is_strange = false;
  /** Goes with every save, so that this window knows its own. */
  readonly window = windowName();

  /** Asks `name`; resolves with the reply, or with a `Frame` where the reply is binary. A server that is busy is asked again. */
  async ask<N extends Question>(name: N, body: Request<N>, options: AskOptions = {}): Promise<Reply<N>> {
    const until = Date.now() + BUSY_MS;
    for (let wait_ms = 200; ; wait_ms = Math.min(2000, 2 * wait_ms)) {
      try {
        return await this.askOnce(name, body, options);
      } catch (error) {
        if (!(error instanceof Refusal) || error.code !== "busy" || Date.now() + wait_ms > until) throw error;
      }
      await pause(wait_ms, options.signal);
    }
  }

  private async askOnce<N extends Question>(name: N, body: Request<N>, options: AskOptions = {}): Promise<Reply<N>> {
    options.signal?.throwIfAborted();
    const socket = await this.connect();
    const id = this.next_id++;
    return new Promise((resolve, reject) => {
      this.pending.set(id, { resolve: resolve as (reply: unknown) => void, reject, onProgress: options.onProgress });
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
    if (!this.is_strange) this.onState("connecting");
    const url = new URL("api/socket", location.href);
    url.protocol = location.protocol === "https:" ? "wss:" : "ws:";
    url.search = url.hash = "";
    const socket = new WebSocket(url);
    socket.binaryType = "arraybuffer";
    return new Promise((resolve, reject) => {
      socket.onopen = () => {
        this.socket = socket;
        this.retry_ms = 250;
        this.is_strange = false;
        this.onState("open");
        resolve(socket);
        // What others saved while the connection was lost was not reported.
        if (this.was_lost) this.onChange({});
        this.was_lost = false;
      };
      socket.onmessage = (event) => this.receive(event.data as string | ArrayBuffer);
      socket.onclose = () => {
        const lost = new Refusal("connection", tr`no connection to TrueAxis`, this.lostHint());
        reject(lost);
        if (this.socket === socket || this.socket === null) this.lose(lost);
      };
    });
  }

  /** What to do where there is no connection. */
  lostHint(): string {
    return this.is_strange
      ? tr`\`trueaxis serve\` was started again: open the new link that it printed.`
      : tr`Is \`trueaxis serve\` still running? The page reconnects by itself.`;
  }

  /** A browser does not say why there is no socket; the page itself does. */
  private async askWhy(): Promise<void> {
    const status = await fetch("./", { method: "HEAD", cache: "no-store" }).then(
      (response) => response.status,
      () => null,
    );
    if (this.socket) return;
    this.is_strange = status === 401;
    this.onState(this.is_strange ? "strange" : "lost");
  }

  private lose(lost: Refusal): void {
    this.socket = null;
    this.was_lost = true;
    for (const waiting of this.pending.values()) waiting.reject(lost);
    this.pending.clear();
    if (!this.is_strange) this.onState("lost");
    void this.askWhy();
    clearTimeout(this.retry);
    this.retry = setTimeout(() => void this.connect().catch(() => undefined), this.retry_ms);
    this.retry_ms = Math.min(8000, this.retry_ms * 2);
  }

  private receive(data: string | ArrayBuffer): void {
    if (typeof data !== "string") {
      const frame = decodeFrame<{ files_read?: string[] }>(data);
      madeFrom(frame, frame.header.files_read);
      this.settle(frame.header.id, (waiting) => waiting.resolve(frame));
      return;
    }
    const message = JSON.parse(data) as {
      id?: number;
      progress?: number;
      note?: string;
      reply?: unknown;
      error?: RefusalDocument;
      files_read?: string[];
      changed?: Change;
    };
    const { files_read } = message;
    if (message.changed) this.onChange(message.changed);
    else if (message.progress !== undefined)
      this.pending.get(message.id ?? -1)?.onProgress?.(message.progress, message.note ?? "");
    else if (message.error)
      this.settle(message.id, (waiting) => waiting.reject(madeFrom(refusal(message.error), files_read)));
    else this.settle(message.id, (waiting) => waiting.resolve(madeFrom(message.reply, files_read)));
  }

  private settle(id: number | undefined, how: (waiting: Pending) => void): void {
    const waiting = id === undefined ? undefined : this.pending.get(id);
    if (!waiting || id === undefined) return;
    this.pending.delete(id);
    how(waiting);
  }
}
