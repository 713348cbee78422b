// The page in German and Chinese: chosen in the bar, said in `lang`, the same place after the change; no English is left.
import assert from "node:assert/strict";
import { test } from "node:test";
import { findings } from "./axe.mjs";
import { go, placesOf } from "./places.mjs";
import { open } from "./served.mjs";
import { browser, server } from "./shared.mjs";

const campaign = "examples/04_plan/probe-ball.toml";

test("German and Chinese: tabs, bar and keys; the address stays; English again", async () => {
  const { page, context, complaints } = await open(browser, new URL(`#plan?campaign=${campaign}`, server.address).href);
  await page.waitForSelector('#tab-plan [data-test="confounded"]');
  const lang = () => page.evaluate(() => document.documentElement.lang);
  assert.equal(await lang(), "en");
  await page.selectOption(".language", "de");
  await page.waitForFunction(() => document.documentElement.lang === "de");
  await page.waitForSelector('#tab-plan [data-test="confounded"]');
  assert.equal(await page.textContent('.tab-link[aria-selected="true"]'), "Planen");
  assert.equal(await page.title(), "Planen – TrueAxis");
  assert.ok((await page.evaluate(() => location.hash)).includes(campaign));
  assert.deepEqual(await findings(page), []);
  await page.keyboard.press("?");
  assert.equal(await page.textContent("dialog[open] h2"), "Tasten");
  assert.match(await page.textContent("dialog[open]"), /Leertaste/);
  assert.deepEqual(await findings(page), []);
  await page.keyboard.press("Escape");
  // Every tab has a German name, or is called the same.
  const names = await page.locator(".tab-link").allTextContents();
  assert.deepEqual(names.slice(0, 3), ["Start", "Beschreiben", "Simulieren"]);
  await page.selectOption(".language", "zh");
  await page.waitForFunction(() => document.documentElement.lang === "zh");
  await page.waitForSelector('#tab-plan [data-test="confounded"]');
  assert.equal(await page.textContent('.tab-link[aria-selected="true"]'), "规划");
  assert.deepEqual(await findings(page), []);
  await page.selectOption(".language", "en");
  await page.waitForFunction(() => document.documentElement.lang === "en");
  assert.deepEqual(complaints, []);
  await context.close();
});

/** Texts in the window with English words that no name has; what is marked as English, and files, are left out. */
const english = (page) =>
  page.evaluate(() => {
    const words = /(^|\s)(the|of|and|with|without|from|which|are|is|by|than|each|every|between|largest)(\s|$)/i;
    const left = [
      "[lang=en]",
      "code",
      "pre",
      "kbd",
      "textarea",
      "option",
      ".source-list",
      ".status-note",
      "[data-own]",
    ].join(", ");
    const found = [];
    const walker = document.createTreeWalker(document.body, NodeFilter.SHOW_TEXT);
    while (walker.nextNode()) {
      const { parentElement: at, data } = walker.currentNode;
      if (words.test(data) && at.getClientRects().length > 0 && !at.closest(left)) found.push(data.trim());
    }
    for (const at of document.querySelectorAll("[title], [aria-label], [placeholder]")) {
      if (at.getClientRects().length === 0 || at.closest(left)) continue;
      for (const name of ["title", "aria-label", "placeholder"])
        if (words.test(at.getAttribute(name) ?? "")) found.push(`${name}: ${at.getAttribute(name)}`);
    }
    return [...new Set(found)];
  });

for (const [language, report] of [
  ["de", "Bericht"],
  ["zh", "报告"],
])
  test(`every tab is said in ${language}`, async (t) => {
    const { page, context, complaints } = await open(browser, server.address);
    await page.waitForSelector(".tab-link");
    await page.selectOption(".language", language);
    await page.waitForFunction((code) => document.documentElement.lang === code, language);
    await page.waitForSelector(".card");
    assert.equal(await page.textContent('.tab-link[data-tab="report"]'), report);
    for (const place of await placesOf(page)) {
      await t.test(place.name, async () => {
        await go(page, server.address, place);
        assert.deepEqual(await english(page), []);
        assert.deepEqual(complaints.splice(0), []);
      });
    }
    await context.close();
  });
