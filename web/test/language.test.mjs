// The frame in German and Chinese: chosen in the bar, said in `lang`, the same place after the change.
import assert from "node:assert/strict";
import { test } from "node:test";
import { findings } from "./axe.mjs";
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
  // What the tabs say is English, and said to be.
  assert.equal(await page.getAttribute("main", "lang"), "en");
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
