/** A tiny element helper: no framework, no inline style text (the page's CSP forbids it). */

export type Child = Node | string | number | null | undefined | false | Child[];
type Value = string | number | boolean | null | undefined | ((event: never) => void);
export type Props = Record<string, Value | Partial<CSSStyleDeclaration> | Record<string, string>>;

const SVG = "http://www.w3.org/2000/svg";

function append(parent: Node, children: Child[]): void {
  for (const child of children) {
    if (child === null || child === undefined || child === false) continue;
    if (Array.isArray(child)) append(parent, child);
    else parent.appendChild(child instanceof Node ? child : document.createTextNode(String(child)));
  }
}

/** `ariaLabel` -> `aria-label`, `dataTab` -> `data-tab`. */
function attributeName(key: string): string {
  return /^(aria|data)[A-Z]/.test(key) ? key.replace(/[A-Z]/g, (c) => `-${c.toLowerCase()}`) : key;
}

function apply(element: HTMLElement | SVGElement, props: Props): void {
  for (const [key, value] of Object.entries(props)) {
    if (value === null || value === undefined || value === false) continue;
    if (typeof value === "function") {
      element.addEventListener(key.replace(/^on/, "").toLowerCase(), value as EventListener);
    } else if (key === "style") {
      for (const [name, text] of Object.entries(value as Record<string, string>)) {
        if (name.includes("-")) element.style.setProperty(name, text);
        else (element.style as unknown as Record<string, string>)[name] = text;
      }
    } else if (key === "class") {
      element.setAttribute("class", String(value));
    } else if ((key === "value" || key === "checked" || key === "disabled") && key in element) {
      (element as unknown as Record<string, unknown>)[key] = value;
    } else {
      element.setAttribute(attributeName(key), value === true ? "" : String(value));
    }
  }
}

/** `h("button", { class: "primary", onclick: run, ariaLabel: "Run" }, "Run")`. */
export function h<K extends keyof HTMLElementTagNameMap>(
  tag: K,
  props: Props = {},
  ...children: Child[]
): HTMLElementTagNameMap[K] {
  const element = document.createElement(tag);
  apply(element, props);
  append(element, children);
  return element;
}

/** The same for SVG. Attribute names are taken as written (`stroke-width`). */
export function s<K extends keyof SVGElementTagNameMap>(
  tag: K,
  props: Props = {},
  ...children: Child[]
): SVGElementTagNameMap[K] {
  const element = document.createElementNS(SVG, tag) as SVGElementTagNameMap[K];
  apply(element, props);
  append(element, children);
  return element;
}

/** Replaces everything in `host`. */
export function fill(host: Element, ...children: Child[]): void {
  host.replaceChildren();
  append(host, children);
}

/** Gives the user a file. */
export function download(name: string, content: Blob | string, type = "text/plain"): void {
  const blob = content instanceof Blob ? content : new Blob([content], { type });
  const url = URL.createObjectURL(blob);
  const link = h("a", { href: url, download: name });
  link.click();
  setTimeout(() => URL.revokeObjectURL(url), 10_000);
}

/** Calls `run` at most once per frame, with the latest arguments. */
export function perFrame<A extends unknown[]>(run: (...args: A) => void): (...args: A) => void {
  let latest: A | null = null;
  return (...args: A) => {
    const waiting = latest !== null;
    latest = args;
    if (waiting) return;
    requestAnimationFrame(() => {
      const now = latest;
      latest = null;
      if (now) run(...now);
    });
  };
}
