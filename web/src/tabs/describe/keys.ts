/** Ctrl+S, Ctrl+Z, Ctrl+Shift+Z, and ⌘ instead of Ctrl. */

export type EditKey = "save" | "undo" | "redo";

/** What a key press asks of the machine file; null where it belongs to another part of the page. */
export function editKey(event: KeyboardEvent): EditKey | null {
  if (!(event.ctrlKey || event.metaKey) || event.altKey) return null;
  const key = event.key.toLowerCase();
  if (key === "s" && !event.shiftKey) return "save";
  if ((key !== "z" && key !== "y") || typing(event.target)) return null;
  return key === "y" || event.shiftKey ? "redo" : "undo";
}

/** Whether Ctrl+Z belongs to a text that is being typed. */
function typing(target: EventTarget | null): boolean {
  if (target instanceof HTMLTextAreaElement) return true;
  if (!(target instanceof HTMLInputElement) || target.readOnly) return false;
  return target.type === "number" || (target.type === "text" && target.value !== target.defaultValue);
}
