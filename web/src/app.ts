/** The frame of the page: tabs, the open project and machine, status line, messages. */

import { Address, hashOf, readHash, type Change as Kept } from "./address.ts";
import { Api, Refusal, type Change, type ConnectionState, type Diagnostic, type Project } from "./api.ts";
import { fill, h } from "./dom.ts";
import { withErrorNames } from "./glossary/glossary.ts";
import { keysButton } from "./keys.ts";
import { TABS } from "./tabs/index.ts";
import { chooseTheme, themeChoice, type ThemeChoice } from "./theme.ts";
import { chooseLanguage, codeWords, language, languages, severityWord, tr } from "./words/index.ts";
import { refusedWith } from "./words/told.ts";

export interface TabHandle {
  /** The tab is shown with these parameters of the address (`machine=…&program=…`). */
  open?(params: Readonly<Record<string, string>>): void;
  /** Another tab is shown now: stop playing, stop asking. */
  hide?(): void;
  /** A file of the project was saved by another window or tab; null: any may have been. */
  changed?(path: string | null, version: string | null): void;
}

export interface Tab {
  title: string;
  mount(host: HTMLElement, app: App): TabHandle;
}

/** One line of the registry: the module is loaded when the tab is first opened. */
export interface TabEntry {
  name: string;
  title: string;
  load: () => Promise<Tab>;
}

export interface State {
  project: Project | null;
  /** Path of the open machine file, shared by the tabs. */
  machine: string | null;
  tab: string;
  connection: ConnectionState;
}

export interface Progress {
  report(share: number, note?: string): void;
  done(): void;
}

interface Mounted {
  host: HTMLElement;
  handle: TabHandle | null;
  /** The module could not be fetched; when the tab is opened again, it is tried again. */
  failed: boolean;
  /** Its module is loaded. */
  ready: Promise<void>;
}

export class App {
  readonly api = new Api();
  private state_: State = { project: null, machine: null, tab: "start", connection: "connecting" };
  private readonly address = new Address();
  private readonly listeners = new Set<(state: Readonly<State>) => void>();
  private readonly mounted = new Map<string, Mounted>();
  /** How often the address has changed. */
  private turns = 0;
  private readonly bar = h("header", { class: "bar" });
  private readonly main = h("main", { class: "main", id: "main", tabindex: "-1" });
  private readonly tabs = h("nav", { class: "tabs", role: "tablist", ariaLabel: tr`Verbs` });
  private readonly folder = h("span", { class: "folder" });
  private readonly unsaved_link = h("a", { class: "unsaved", dataTest: "unsaved", hidden: true });
  private readonly note = h("span", { class: "status-note", role: "status" });
  private readonly link = h("span", { class: "status-link" });
  private readonly meter = h("progress", {
    class: "status-meter",
    max: "1",
    value: 0,
    hidden: true,
    ariaLabel: tr`Progress`,
  });
  private readonly toasts = h("div", { class: "toasts", ariaLive: "polite" });

  constructor(root: HTMLElement) {
    this.buildBar();
    fill(root, this.bar, this.main, h("footer", { class: "status" }, this.note, this.meter, this.link), this.toasts);
    this.api.onState = (connection) => this.set({ connection });
    this.api.onChange = (change) => this.tellChange(change);
    this.subscribe((state) => this.showState(state));
    window.addEventListener("hashchange", () => void this.route());
    window.addEventListener("beforeunload", (event) => {
      if (!this.unsaved_link.hidden) event.preventDefault();
    });
  }

  // ---- store ----

  get state(): Readonly<State> {
    return this.state_;
  }

  set(change: Partial<State>): void {
    this.state_ = { ...this.state_, ...change };
    for (const listener of this.listeners) listener(this.state_);
  }

  /** Called at once and at every change; returns the way to stop. */
  subscribe(listener: (state: Readonly<State>) => void): () => void {
    this.listeners.add(listener);
    listener(this.state_);
    return () => this.listeners.delete(listener);
  }

  // ---- routing ----

  /** Opens a tab; the parameters stand in the address, so that reload and back work. */
  go(tab: string, params: Record<string, string | null | undefined> = {}): void {
    this.address.flush();
    const hash = hashOf(tab, params);
    if (location.hash === hash) void this.route();
    else location.hash = hash;
  }

  /** Parts of the address of a tab that follow what the user does; back does not stop at each of them. */
  keep(tab: string, change: Kept): void {
    this.address.keep(tab, change);
  }

  has(tab: string): boolean {
    return TABS.some((entry) => entry.name === tab);
  }

  async start(): Promise<void> {
    await this.loadProject();
    await this.route();
  }

  async loadProject(): Promise<void> {
    try {
      this.set({ project: await this.api.ask("project", {}) });
    } catch (error) {
      this.fail(error);
    }
  }

  /** Tells the tabs; the one that saved in this window knows. */
  private tellChange({ path, version, window: from }: Change): void {
    const own = from === this.api.window;
    for (const [name, { handle }] of this.mounted)
      if (!own || name !== this.state_.tab) handle?.changed?.(path ?? null, version ?? null);
    if (!own && path) this.say(from ? tr`${path} was saved in another window` : tr`${path} has changed on the disk`);
    // A new file, or one that is gone.
    if (!version || !this.state_.project?.files.some((file) => file.path === path)) void this.loadProject();
  }

  private async route(): Promise<void> {
    const { tab: name, params } = readHash();
    const entry = TABS.find((tab) => tab.name === name) ?? TABS[0];
    if (!entry) return;
    this.address.opened(entry.name, params);
    const turn = ++this.turns;
    const before = this.mounted.get(this.state_.tab);
    if (this.state_.tab !== entry.name) before?.handle?.hide?.();
    this.set({ tab: entry.name, ...(params.machine ? { machine: params.machine } : {}) });
    document.title = `${entry.title} – TrueAxis`;
    try {
      const now = await this.mountTab(entry);
      for (const [key, { host }] of this.mounted) host.hidden = key !== this.state_.tab;
      // While its module was loaded the address may have changed again.
      if (turn === this.turns) now.handle?.open?.(params);
    } catch (error) {
      this.fail(error);
    }
  }

  private async mountTab(entry: TabEntry): Promise<Mounted> {
    const there = this.mounted.get(entry.name);
    if (there && !there.failed) {
      await there.ready;
      return there;
    }
    there?.host.remove();
    const host = h("section", {
      class: `tab tab-${entry.name}`,
      id: `tab-${entry.name}`,
      role: "tabpanel",
      "aria-labelledby": `tab-link-${entry.name}`,
    });
    const load = async (): Promise<void> => {
      const tab = await entry.load().catch((error: unknown) => {
        console.info(error);
        fresh.failed = true;
        this.sayNotLoaded(host, entry.title);
      });
      if (!tab) return;
      fresh.handle = tab.mount(host, this);
      host.prepend(h("h1", { class: "visually-hidden" }, entry.title));
    };
    const fresh: Mounted = { host, handle: null, failed: false, ready: Promise.resolve() };
    this.mounted.set(entry.name, fresh);
    this.main.append(host);
    this.tabs.querySelector(`[data-tab="${entry.name}"]`)?.setAttribute("aria-controls", host.id);
    fresh.ready = load();
    await fresh.ready;
    return fresh;
  }

  /** Where a tab would stand: its module comes from the server, too. */
  private sayNotLoaded(host: HTMLElement, title: string): void {
    fill(
      host,
      h(
        "section",
        { class: "panel refused", role: "alert" },
        h("h2", {}, tr`${title} could not be loaded`),
        h("p", { class: "hint" }, this.api.lostHint()),
        h("button", { onclick: () => location.reload() }, tr`Load the page again`),
      ),
    );
  }

  // ---- status and messages ----

  /** Files with edits that are not saved, said on every tab; the link leads to the first. */
  unsaved(tab: string, paths: readonly string[]): void {
    const [first] = paths;
    this.unsaved_link.hidden = first === undefined;
    if (first === undefined) return;
    this.unsaved_link.href = hashOf(tab, { machine: first });
    this.unsaved_link.title = paths.join("\n");
    this.unsaved_link.textContent = paths.length === 1 ? tr`1 file not saved` : tr`${paths.length} files not saved`;
  }

  /** One line below; replaces the last. */
  say(text: string): void {
    this.note.textContent = text;
  }

  /** A running job in the status line. */
  progress(text: string): Progress {
    this.say(text);
    this.meter.hidden = false;
    this.meter.value = 0;
    return {
      report: (share, note) => {
        this.meter.value = share;
        if (note) this.say(note);
      },
      done: () => {
        this.meter.hidden = true;
        this.say("");
      },
    };
  }

  /** Shows an error with its hint and the places it names. Aborted requests are not errors. */
  fail(error: unknown): void {
    if (error instanceof DOMException && error.name === "AbortError") return;
    const refusal = Refusal.from(error);
    const same = [...this.toasts.children].find((t) => (t as HTMLElement).dataset.message === refusal.message);
    same?.remove();
    const toast = h(
      "div",
      { class: "toast", role: "alert", dataMessage: refusal.message },
      refusedWith("strong", {}, refusal, refusal.message),
      refusal.hint ? refusedWith("p", { class: "hint" }, refusal, refusal.hint) : null,
      refusal.diagnostics.length > 0 ? diagnosticList(refusal.diagnostics.slice(0, 6)) : null,
      refusal.diagnostics.length > 6
        ? h("p", { class: "muted" }, tr`and ${refusal.diagnostics.length - 6} more`)
        : null,
      h("button", { class: "toast-close", ariaLabel: tr`Close this message`, onclick: () => toast.remove() }, "×"),
    );
    this.toasts.append(toast);
    while (this.toasts.children.length > 4) this.toasts.firstElementChild?.remove();
  }

  // ---- bar ----

  private buildBar(): void {
    for (const entry of TABS) {
      const { name } = entry;
      this.tabs.append(
        h(
          "a",
          {
            class: "tab-link",
            role: "tab",
            id: `tab-link-${name}`,
            href: `#${name}`,
            dataTab: name,
            onclick: (event: MouseEvent) => this.keepMachine(event, name),
          },
          entry.title,
        ),
      );
    }
    this.tabs.addEventListener("keydown", (event) => this.moveFocus(event));
    const theme = h(
      "select",
      { class: "theme", ariaLabel: tr`Light or dark`, onchange: () => chooseTheme(theme.value as ThemeChoice) },
      h("option", { value: "auto" }, tr`System`),
      h("option", { value: "light" }, tr`Light`),
      h("option", { value: "dark" }, tr`Dark`),
    );
    theme.value = themeChoice();
    const tongue = h(
      "select",
      { class: "language", ariaLabel: tr`Language`, onchange: () => chooseLanguage(tongue.value) },
      languages.map(({ code, name }) => h("option", { value: code, lang: code }, name)),
    );
    tongue.value = language();
    fill(
      this.bar,
      h("span", { class: "name" }, "TrueAxis"),
      this.tabs,
      this.folder,
      this.unsaved_link,
      keysButton(),
      tongue,
      theme,
    );
  }

  /** A click on a tab keeps the open machine, and what the tab showed of it. */
  private keepMachine(event: MouseEvent, name: string): void {
    if (event.ctrlKey || event.metaKey || event.shiftKey) return;
    event.preventDefault();
    this.address.flush();
    const { machine } = this.state_;
    this.go(name, name === "start" ? {} : { ...this.address.lastOf(name, machine), machine });
  }

  private moveFocus(event: KeyboardEvent): void {
    const links = [...this.tabs.querySelectorAll("a")];
    const at = links.indexOf(document.activeElement as HTMLAnchorElement);
    const to = { ArrowRight: at + 1, ArrowLeft: at - 1, Home: 0, End: links.length - 1 }[event.key];
    if (at < 0) return;
    if (event.key === " ") links[at]?.click();
    else if (to !== undefined) links[(to + links.length) % links.length]?.focus();
    else return;
    event.preventDefault();
  }

  /** Where the bar is too narrow for all tabs. (`scrollIntoView` would also move where the Tab key goes on.) */
  private bringIntoSight(link: HTMLElement): void {
    const [bar, box] = [this.tabs.getBoundingClientRect(), link.getBoundingClientRect()];
    if (box.left < bar.left) this.tabs.scrollLeft -= bar.left - box.left;
    else if (box.right > bar.right) this.tabs.scrollLeft += box.right - bar.right;
  }

  private showState(state: Readonly<State>): void {
    for (const link of this.tabs.querySelectorAll("a")) {
      const here = link.dataset.tab === state.tab;
      link.setAttribute("aria-selected", String(here));
      // One stop of the Tab key; the arrow keys reach the others.
      link.tabIndex = here ? 0 : -1;
      if (here) this.bringIntoSight(link);
    }
    const folder = state.project?.folder ?? "";
    this.folder.textContent = folder.replace(/^.*\/(?=[^/]+\/?$)/, "");
    this.folder.title = folder;
    this.link.dataset.state = state.connection;
    const version = state.project ? ` ${state.project.version}` : "";
    this.link.textContent = {
      connecting: tr`connecting …`,
      open: `TrueAxis${version}`,
      lost: tr`no connection – trying again`,
      strange: this.api.lostHint(),
    }[state.connection];
  }
}

/** What a code means, where the page is not in English: the message has the details. */
function codeTitle(code: string): HTMLElement | null {
  const title = codeWords(code);
  return title === null ? null : h("strong", {}, title);
}

/** "machine.toml:41:8  message  hint", one line each. */
export function diagnosticList(diagnostics: readonly Diagnostic[]): HTMLElement {
  return h(
    "ul",
    { class: "diagnostics" },
    diagnostics.map((d) => {
      const place = d.file
        ? `${d.file}${d.line ? `:${d.line}${d.column ? `:${d.column}` : ""}` : ""}`
        : d.line
          ? tr`line ${d.line}`
          : "";
      return h(
        "li",
        { class: `diagnostic ${d.severity}` },
        h("span", { class: "diagnostic-severity" }, severityWord(d.severity)),
        place ? h("code", {}, place) : null,
        codeTitle(d.code),
        h("span", { lang: "en" }, withErrorNames(d.message)),
        d.hint ? h("span", { class: "hint", lang: "en" }, d.hint) : null,
      );
    }),
  );
}

/** Two parts with a divider that mouse and arrow keys move; above each other on narrow windows. */
export function split(host: HTMLElement, key: string, share = 0.6): { left: HTMLElement; right: HTMLElement } {
  const left = h("div", { class: "split-left" });
  const right = h("div", { class: "split-right" });
  const divider = h("div", {
    class: "split-divider",
    role: "separator",
    tabindex: "0",
    ariaLabel: tr`Resize the picture`,
    ariaOrientation: "vertical",
    ariaValuemin: "20",
    ariaValuemax: "80",
  });
  const pane = h("div", { class: "split" }, left, divider, right);
  const set = (value: number): void => {
    const now = Math.min(0.8, Math.max(0.2, value));
    pane.style.setProperty("--share", String(now));
    divider.setAttribute("aria-valuenow", String(Math.round(100 * now)));
    sessionStorage.setItem(`split-${key}`, String(now));
  };
  const current = (): number => Number(pane.style.getPropertyValue("--share"));
  const kept = Number(sessionStorage.getItem(`split-${key}`));
  set(kept > 0 ? kept : share);
  divider.addEventListener("pointerdown", (down) => {
    divider.setPointerCapture(down.pointerId);
    const move = (event: PointerEvent): void => {
      const box = pane.getBoundingClientRect();
      const stacked = getComputedStyle(pane).flexDirection === "column";
      set(stacked ? (event.clientY - box.top) / box.height : (event.clientX - box.left) / box.width);
    };
    divider.addEventListener("pointermove", move);
    divider.addEventListener("pointerup", () => divider.removeEventListener("pointermove", move), { once: true });
  });
  divider.addEventListener("keydown", (event) => {
    const step = { ArrowLeft: -0.02, ArrowUp: -0.02, ArrowRight: 0.02, ArrowDown: 0.02 }[event.key];
    if (step === undefined) return;
    event.preventDefault();
    set(current() + step);
  });
  host.append(pane);
  return { left, right };
}
