/** Light and dark: the system's, or the user's choice kept in localStorage. Styles read `data-theme`. */

export type ThemeChoice = "auto" | "light" | "dark";
const KEY = "trueaxis-theme";
const system = matchMedia("(prefers-color-scheme: dark)");
const listeners = new Set<() => void>();

export function themeChoice(): ThemeChoice {
  const kept = localStorage.getItem(KEY);
  return kept === "light" || kept === "dark" ? kept : "auto";
}

export function isDark(): boolean {
  const choice = themeChoice();
  return choice === "auto" ? system.matches : choice === "dark";
}

function applyTheme(): void {
  document.documentElement.dataset.theme = isDark() ? "dark" : "light";
  for (const listener of listeners) listener();
}

export function chooseTheme(choice: ThemeChoice): void {
  if (choice === "auto") localStorage.removeItem(KEY);
  else localStorage.setItem(KEY, choice);
  applyTheme();
}

/** Called after every change; returns the way to stop. */
export function onTheme(listener: () => void): () => void {
  listeners.add(listener);
  return () => listeners.delete(listener);
}

/** The value of a CSS variable (`cssColour("--accent")`), for canvases and exported files. */
export function cssColour(name: string): string {
  return getComputedStyle(document.documentElement).getPropertyValue(name).trim() || "#888888";
}

export function startTheme(): void {
  system.addEventListener("change", applyTheme);
  applyTheme();
}
