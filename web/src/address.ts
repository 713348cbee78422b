/** What a tab shows, in the address: a copied link, reload and back show the same. */

export type Params = Readonly<Record<string, string>>;
export type Change = Record<string, string | null | undefined>;

/** Browsers refuse more than some hundred changes in half a minute. */
const EVERY_MS = 300;

/** "#simulate?machine=…&t=12.5", readable where the address allows it. */
export function hashOf(tab: string, params: Change): string {
  const query = new URLSearchParams();
  for (const [key, value] of Object.entries(params)) if (value) query.set(key, value);
  const text = query.toString().replace(/%2F|%2C|%3A|%3D/g, (code) => decodeURIComponent(code));
  return `#${tab}${text ? `?${text}` : ""}`;
}

export function readHash(): { tab: string; params: Params } {
  const [tab = "", query = ""] = location.hash.replace(/^#/, "").split("?", 2);
  return { tab, params: Object.fromEntries(new URLSearchParams(query)) };
}

/** Replaces parts of the address while something moves, a few times a second. */
export class Address {
  private waiting: { on: string; change: Change } | null = null;
  private timer: ReturnType<typeof setTimeout> | undefined;
  /** What each tab last showed. */
  private readonly last = new Map<string, Params>();

  constructor() {
    addEventListener("pagehide", () => this.flush());
  }

  /** null takes a parameter away. Only the tab that is shown has a say. */
  keep(tab: string, change: Change): void {
    if (readHash().tab !== tab) return;
    if (this.waiting?.on !== location.hash) this.waiting = { on: location.hash, change: {} };
    Object.assign(this.waiting.change, change);
    this.timer ??= setTimeout(() => this.flush(), EVERY_MS);
  }

  /** Writes what waits; before the address becomes another one. */
  flush(): void {
    clearTimeout(this.timer);
    this.timer = undefined;
    const { waiting } = this;
    this.waiting = null;
    // The user went elsewhere meanwhile: that was of the address before.
    if (!waiting || waiting.on !== location.hash) return;
    const { tab, params } = readHash();
    const hash = hashOf(tab, { ...params, ...waiting.change });
    if (hash !== location.hash) history.replaceState(history.state, "", hash);
    this.last.set(tab, readHash().params);
  }

  opened(tab: string, params: Params): void {
    this.last.set(tab, params);
  }

  /** What the tab showed when it was left; of another machine, nothing. */
  lastOf(tab: string, machine: string | null): Params {
    const last = this.last.get(tab) ?? {};
    return machine && last.machine && last.machine !== machine ? {} : last;
  }
}

/** A number for the address: as many digits as are needed, at most `digits` after the point. */
export const short = (value: number, digits: number): string => String(Number(value.toFixed(digits)));

/** A number of the address; null if there is none. */
export function numberIn(text: string | undefined): number | null {
  const value = Number(text);
  return text === undefined || text.trim() === "" || !Number.isFinite(value) ? null : value;
}
