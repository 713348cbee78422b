// What the tests of Plan, Identify and Standards share: tables of the page, numbers as it writes them, dropped files.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";

/** A number as the page writes it: fixed digits, a real minus sign, a dash for none. (Ties do not occur in the examples.) */
export function shown(value, digits) {
  if (value === null || value === undefined) return "–";
  const text = Math.abs(value).toFixed(digits);
  return value < 0 && /[1-9]/.test(text) ? `−${text}` : text;
}

/** The cells of a table of results, as text. */
export function table(page, key) {
  return page.$$eval(`.tab:not([hidden]) [data-sheet="${key}"] tbody tr`, (rows) =>
    rows.map((row) => [...row.cells].map((cell) => cell.textContent.trim())),
  );
}

/** Drops a file onto the middle of a tab, as a mouse would. */
export async function drop(page, selector, name, content) {
  const bytes = [...(typeof content === "string" ? Buffer.from(content) : content)];
  const data = await page.evaluateHandle(
    ([file, all]) => {
      const transfer = new DataTransfer();
      transfer.items.add(new File([Uint8Array.from(all)], file, { type: "text/csv" }));
      return transfer;
    },
    [name, bytes],
  );
  for (const type of ["dragover", "drop"])
    await page.dispatchEvent(`${selector} .result`, type, { dataTransfer: data });
}

/** The text of a file that a click gives. */
export async function downloaded(page, click) {
  const [download] = await Promise.all([page.waitForEvent("download"), click()]);
  return { name: download.suggestedFilename(), text: readFileSync(await download.path(), "utf8") };
}

/** The first figure under a selector is saved as SVG, PNG and CSV. */
export async function exports(page, selector) {
  const menu = page.locator(`${selector} .figure-menu`).first();
  for (const [label, mark] of [
    ["SVG", "<svg"],
    ["CSV", ","],
    ["PNG", "PNG"],
  ]) {
    const { text } = await downloaded(page, () => menu.getByRole("button", { name: `Save as ${label}` }).click());
    assert.ok(text.includes(mark), `${label} of ${selector}`);
  }
}
