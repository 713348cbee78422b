// The glossary of error names: reached from every name, with the sign of docs/conventions.md in words and drawing.
import assert from "node:assert/strict";
import { test } from "node:test";
import { findings } from "./axe.mjs";
import { go, placesOf } from "./places.mjs";
import { open } from "./served.mjs";
import { browser, server } from "./shared.mjs";

const title = (page) => page.textContent("dialog[open] h2");

test("from the table of errors: EC0Y in words and as a drawing", async () => {
  const { page, context, complaints } = await open(browser, server.address);
  const place = (await placesOf(page)).find(({ name }) => name === "describe errors");
  await go(page, server.address, place);
  const info = page.getByRole("button", { name: "EC0Y: what it is" }).first();
  await info.click();
  assert.equal(await title(page), "EC0Y: squareness error of Y to X (orientation about Z)");
  const text = await page.textContent("dialog[open] dl");
  // ARCHITECTURE.md: 10 µrad of EC0Y at Y = 500 mm move the tool by −5 µm in X.
  assert.match(text, /leans towards −X: its angle to \+X is larger than 90°/);
  assert.match(text, /µrad/);
  assert.match(text, /ISO 230-4/);
  const top = (selector) =>
    page
      .locator(`dialog[open] .error-drawing ${selector} path`)
      .first()
      .evaluate((path) => {
        const { x, width } = path.getBoundingClientRect();
        return x + width / 2;
      });
  assert.ok((await top("g[transform]")) < (await top("g:not([transform])")), "drawn leaning to −X");
  assert.deepEqual(await findings(page), []);
  await page.keyboard.press("Escape");
  assert.equal(await page.evaluate(() => document.activeElement?.getAttribute("aria-label")), "EC0Y: what it is");
  assert.deepEqual(complaints, []);
  await context.close();
});

test("every name has words, a unit, a sign, instruments and a drawing of its own", async () => {
  const { page, context, complaints } = await open(browser, server.address);
  await page.waitForSelector(".card");
  await page.keyboard.press("e");
  const names = await page.locator('[data-test="glossary-name"] option').allTextContents();
  assert.equal(names.length, 9 * 12 + 2 * 6);
  const seen = new Set();
  for (const name of names) {
    await page.selectOption('[data-test="glossary-name"]', name);
    const { head, terms, drawing, label } = await page.evaluate(() => ({
      head: document.querySelector("dialog[open] h2").textContent,
      terms: [...document.querySelectorAll("dialog[open] dd")].map((one) => one.textContent),
      drawing: document.querySelector(".error-drawing").innerHTML,
      label: document.querySelector(".error-drawing").getAttribute("aria-label"),
    }));
    assert.ok(head.startsWith(`${name}: `) && head.length > name.length + 10, head);
    assert.equal(terms.length, 6);
    for (const term of terms) assert.ok(term.length > 1 && !/undefined|null|NaN/.test(term), `${name}: ${term}`);
    assert.equal(terms[2], /^E[XYZ]/.test(name) ? "µm" : "µrad");
    assert.ok(!/undefined|NaN/.test(drawing) && drawing.includes("transform="), name);
    assert.ok(label.includes(`${name} > 0`), label);
    seen.add(head);
  }
  assert.equal(seen.size, names.length);
  assert.deepEqual(complaints, []);
  await context.close();
});

test("names lead to it from Predict, Plan and Identify", async () => {
  const { page, context, complaints } = await open(browser, server.address);
  const places = await placesOf(page);
  for (const [name, selector] of [
    ["predict what-if", ".what-if-errors .error-link"],
    ["predict", '[data-page="budget"] .error-text-link'],
    ["plan", "#tab-plan .error-text-link"],
    ["identify", '#tab-identify [data-sheet="values"] .error-link'],
  ]) {
    await go(
      page,
      server.address,
      places.find((one) => one.name === name),
    );
    const link = page.locator(selector).first();
    const word = await link.textContent();
    await link.focus();
    await page.keyboard.press("Enter");
    assert.ok((await title(page)).startsWith(`${word}: `), `${word} of ${name}`);
  }
  assert.deepEqual(complaints, []);
  await context.close();
});
