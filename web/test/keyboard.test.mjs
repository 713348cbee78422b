// Without a mouse: the list of keys, those of Simulate, and a visible focus on every tab.
import assert from "node:assert/strict";
import { test } from "node:test";
import { findings } from "./axe.mjs";
import { downloaded } from "./measured.mjs";
import { go, placesOf } from "./places.mjs";
import { cli, open } from "./served.mjs";
import { browser, server } from "./shared.mjs";

const engraver = "machines/i5-engraver/machine.toml";
const collision = "examples/02_simulate/collision-fanuc.nc";
const ring = "examples/02_simulate/ring-fanuc.nc";

const time = (page) => page.evaluate(() => globalThis.trueaxisScene.moment()?.time_s);
const line = (page) => page.evaluate(() => globalThis.trueaxisScene.moment()?.line);
const isOpen = (page) => page.evaluate(() => document.querySelector("dialog[open]") !== null);

async function simulated(program) {
  const window = await open(browser, server.address);
  await window.page.goto(new URL(`#simulate?machine=${engraver}&program=${program}`, server.address).href);
  await window.page.waitForSelector('.tab-simulate.simulated [data-test="place"]:not(:empty)', { state: "attached" });
  return window;
}

test("the list of keys opens with ? and by its button, closes with Escape, and gives the focus back", async () => {
  const { page, context, complaints } = await open(browser, server.address);
  await page.locator(".card").first().focus();
  await page.keyboard.press("?");
  await page.waitForSelector("dialog[open] kbd");
  assert.deepEqual(await findings(page), []);
  await page.keyboard.press("Escape");
  await page.waitForFunction(() => document.activeElement?.classList.contains("card"));
  await page.click(".keys-button");
  // Keys without Ctrl can be switched off.
  await page.locator("dialog[open] input[type=checkbox]").uncheck();
  await page.keyboard.press("Escape");
  await page.waitForFunction(() => document.activeElement?.classList.contains("keys-button"));
  await page.keyboard.press("?");
  assert.equal(await isOpen(page), false);
  await page.keyboard.press("Enter");
  await page.locator("dialog[open] input[type=checkbox]").check();
  // Closed and at once opened again, before the page hears that it was closed: it stays.
  await page.evaluate(async () => {
    document.querySelector("dialog[open]").close();
    document.querySelector(".keys-button").click();
    await new Promise((heard) => setTimeout(heard, 200));
  });
  assert.equal(await isOpen(page), true);
  await page.click(".dialog-close");
  assert.equal(await isOpen(page), false);
  await page.waitForFunction(() => document.activeElement?.classList.contains("keys-button"));
  // In a field a question mark is a question mark.
  await page.goto(new URL("#describe?machine=machines/xkas2525/machine.toml", server.address).href);
  await page.waitForSelector(".scene-note.actual");
  await page.click('[data-page="errors"]');
  await page.locator(".error-search").focus();
  await page.keyboard.press("?");
  assert.equal(await page.locator(".error-search").inputValue(), "?");
  assert.equal(await isOpen(page), false);
  assert.deepEqual(complaints, []);
  await context.close();
});

test("Simulate: go to a line, find, the marked line, the next issue", async () => {
  const { page, context, complaints } = await simulated(collision);
  const { troubles } = await cli("simulate", engraver, collision, "--no-report");
  const grave = troubles.filter((t) => t.grave).map((t) => t.from_s);
  await page.locator(".timeline-track").focus();
  await page.keyboard.press("n");
  await page.waitForFunction((t) => Math.abs(globalThis.trueaxisScene.moment().time_s - t) < 1e-6, grave[0]);
  assert.match(await page.textContent(".status-note"), new RegExp(`^1 of ${grave.length}: collision`));
  await page.keyboard.press("Shift+N");
  const before = grave.at(-1);
  await page.waitForFunction((t) => Math.abs(globalThis.trueaxisScene.moment().time_s - t) < 1e-6, before);

  await page.keyboard.press("/");
  await page.keyboard.type("m30");
  await page.keyboard.press("Enter");
  const marked = page.locator(".source-line.marked");
  await marked.waitFor();
  assert.match(await marked.textContent(), /M30/);
  await page.keyboard.type("no such word");
  await page.keyboard.press("Enter");
  assert.equal(await page.textContent('[data-test="found"]'), "not in this program");
  await page.keyboard.press("Escape");
  assert.equal(await page.evaluate(() => document.activeElement?.className), "source-scroll");
  const last = Number(await marked.getAttribute("data-line"));
  await page.keyboard.press("ArrowUp");
  await page.waitForSelector(`.source-line.marked[data-line="${last - 1}"]`);
  const at = await time(page);
  await page.keyboard.press("Enter");
  await page.waitForFunction((t) => globalThis.trueaxisScene.moment().time_s !== t, at);
  await page.keyboard.press("Home");
  await page.waitForFunction(() => globalThis.trueaxisScene.moment().time_s === 0);
  assert.deepEqual(complaints, []);
  await context.close();
});

test("Simulate: G goes to the line that is typed, with its time", async () => {
  const { page, context, complaints } = await simulated(ring);
  await page.keyboard.press("g");
  await page.keyboard.type("40");
  await page.keyboard.press("Enter");
  await page.waitForFunction(() => globalThis.trueaxisScene.moment().line >= 40);
  assert.ok((await line(page)) < 60);
  assert.equal(await page.locator(".find").isVisible(), false);
  assert.deepEqual(complaints, []);
  await context.close();
});

test("a figure as a table, and every point of a part", async () => {
  const { page, context, complaints } = await open(browser, server.address);
  const places = await placesOf(page);
  await go(
    page,
    server.address,
    places.find(({ name }) => name === "standards"),
  );
  const figure = page.locator("#tab-standards figure").first();
  const csv = await downloaded(page, () => figure.getByRole("button", { name: "Save as CSV" }).click());
  await figure.getByRole("button", { name: "Table" }).focus();
  await page.keyboard.press("Enter");
  const rows = await page.locator("dialog[open] tbody tr").count();
  assert.equal(rows, csv.text.trim().split("\n").length - 1);
  assert.deepEqual(await findings(page), []);
  await page.keyboard.press("Escape");
  assert.equal(await page.evaluate(() => document.activeElement?.textContent), "Table");

  await go(
    page,
    server.address,
    places.find(({ name }) => name === "predict part"),
  );
  const point = page.locator('[data-test="point-deviation"]');
  const first = await point.textContent();
  await page.getByRole("button", { name: "Smaller deviation" }).focus();
  await page.keyboard.press("Enter");
  assert.notEqual(await point.textContent(), first);
  await page.getByRole("button", { name: "Larger deviation" }).focus();
  await page.keyboard.press("Enter");
  assert.equal(await point.textContent(), first);
  assert.deepEqual(complaints, []);
  await context.close();
});

test("the Tab key goes through every tab, and where it is can be seen", async (t) => {
  const { page, context, complaints } = await open(browser, server.address);
  await page.waitForSelector(".tab-link");
  for (const place of await placesOf(page)) {
    await t.test(place.name, async () => {
      await go(page, server.address, place);
      const seen = new Set();
      for (let i = 0; i < 40; i++) {
        await page.keyboard.press("Tab");
        const { key, visible } = await page.evaluate(() => {
          const at = document.activeElement;
          // The frame of a report shows the focus inside.
          if (!at || at === document.body || at.tagName === "IFRAME") return { key: "page", visible: true };
          const drawn = (one) => getComputedStyle(one).outlineStyle !== "none";
          const visible = drawn(at) || at.matches(".split-divider") || drawn(at.closest("label") ?? at);
          return { key: at.outerHTML.slice(0, 200), visible };
        });
        assert.ok(visible, `no focus to be seen on ${key}`);
        seen.add(key);
      }
      assert.ok(seen.size > 5, `${seen.size} controls in ${place.name}`);
    });
  }
  assert.deepEqual(complaints, []);
  await context.close();
});
