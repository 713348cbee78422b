// axe-core finds nothing on any tab, in the light and in the dark theme.
import assert from "node:assert/strict";
import { spawn } from "node:child_process";
import { mkdtempSync } from "node:fs";
import os from "node:os";
import path from "node:path";
import { after, test } from "node:test";
import { findings } from "./axe.mjs";
import { go, placesOf } from "./places.mjs";
import { browse, open, program, root, serve } from "./served.mjs";

// A run on the mock, so that Live has something to show; its journal is in a folder of this test.
process.env.XDG_STATE_HOME ??= mkdtempSync(path.join(os.tmpdir(), "trueaxis-accessible-"));
const server = await serve();
const browser = await browse();
const run = spawn(program, ["live", "examples/08_live/gantry-mock.toml", "--for", "300s"], {
  cwd: root,
  stdio: "ignore",
});

after(async () => {
  run.kill();
  await browser.close();
  await server.stop();
});

/** `PLACE=simulate` looks at one tab only. */
const only = process.env.PLACE;

test("every tab in both themes", async (t) => {
  const { page, context, complaints } = await open(browser, server.address);
  await page.waitForSelector(".tab-link");
  for (const place of await placesOf(page)) {
    if (only && !place.name.startsWith(only)) continue;
    await t.test(place.name, async () => {
      await go(page, server.address, place);
      for (const colorScheme of ["light", "dark"]) {
        await page.emulateMedia({ colorScheme });
        await page.waitForFunction((theme) => document.documentElement.dataset.theme === theme, colorScheme);
        const found = await findings(page);
        assert.equal(found.length, 0, `${colorScheme}: ${found.join("\n")}`);
      }
      await page.emulateMedia({ colorScheme: "light" });
      assert.deepEqual(complaints.splice(0), []);
    });
  }
  await context.close();
});

test("the tabs are one stop of the Tab key; arrow keys, Home and End move, Enter opens", async () => {
  const { page, context, complaints } = await open(browser, server.address);
  await page.waitForSelector(".card");
  const stops = await page.locator('.tab-link[tabindex="0"]').evaluateAll((links) => links.map((l) => l.dataset.tab));
  assert.deepEqual(stops, ["start"]);
  const focused = () => page.evaluate(() => document.activeElement?.getAttribute("data-tab"));
  await page.keyboard.press("Tab");
  assert.equal(await focused(), "start");
  await page.keyboard.press("End");
  assert.equal(await focused(), "report");
  await page.keyboard.press("Enter");
  await page.locator("#tab-report").waitFor();
  const panel = await page.locator("#tab-report").getAttribute("aria-labelledby");
  assert.equal(await page.locator(`#${panel}`).textContent(), "Report");
  assert.equal(await page.locator(`#${panel}`).getAttribute("aria-controls"), "tab-report");
  await page.keyboard.press("Home");
  assert.equal(await focused(), "start");
  assert.deepEqual(complaints, []);
  await context.close();
});
