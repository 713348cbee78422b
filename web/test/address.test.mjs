// What is shown stands in the address: a copied link, reload and back show the same.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import path from "node:path";
import { test } from "node:test";
import { drop } from "./measured.mjs";
import { open, root } from "./served.mjs";
import { browser, server } from "./shared.mjs";

const engraver = "machines/i5-engraver/machine.toml";
const machine = "machines/xkas2525/machine.toml";
const ring = "examples/02_simulate/ring-fanuc.nc";
const nas = "examples/03_predict/nas979-head-out-of-square.toml";

const at = (hash) => new URL(`#${hash}`, server.address).href;
const params = (page) =>
  page.evaluate(() => Object.fromEntries(new URLSearchParams(location.hash.slice(location.hash.indexOf("?") + 1))));
const says = (page, key, value) =>
  page.waitForFunction(
    ([k, v]) => new URLSearchParams(location.hash.slice(location.hash.indexOf("?") + 1)).get(k) === v,
    [key, value],
  );
const length = (page) => page.evaluate(() => history.length);
const simulated = (page) =>
  page.waitForSelector('.tab-simulate.simulated [data-test="place"]:not(:empty)', { state: "attached" });

/** Opens the address of a window in another one. */
async function copied(page) {
  // What moves is written a few times a second.
  await page.waitForTimeout(500);
  const other = await open(browser, page.url());
  return other;
}

test("Simulate: time, view, exaggeration, colour and curves", async () => {
  const { page, context, complaints } = await open(browser, at(`simulate?machine=${engraver}&program=${ring}`));
  await simulated(page);
  const steps = await length(page);
  await page.click('[data-test="to-largest"]');
  await page.locator("#tab-simulate .exaggeration").fill("80");
  const factor = await page.locator("#tab-simulate .factor").textContent();
  await page.click('[data-colour="feed"]');
  await page.click('#tab-simulate [data-key="Z"]');
  await page.getByRole("button", { name: "Z: look along Z" }).click();
  await says(page, "view", "z");
  const time_s = await page.evaluate(() => globalThis.trueaxisScene.moment().time_s);
  await says(page, "t", String(Number(time_s.toFixed(4))));
  assert.equal(await length(page), steps, "nothing was added to the history");

  const other = await copied(page);
  await simulated(other.page);
  await other.page.waitForFunction((t) => Math.abs(globalThis.trueaxisScene.moment()?.time_s - t) < 1e-3, time_s);
  assert.equal(await other.page.locator("#tab-simulate .factor").textContent(), factor);
  await other.page.waitForSelector('[data-colour="feed"][aria-pressed="true"]');
  await other.page.waitForSelector('#tab-simulate [data-key="Z"][aria-pressed="true"]');
  assert.equal((await params(other.page)).view, "z");
  // Turned by hand: the view in numbers, which a reload takes again.
  await other.page.locator("#tab-simulate canvas").first().focus();
  await other.page.keyboard.press("ArrowLeft");
  await other.page.waitForFunction(() => /view=-?[\d.]+,/.test(location.hash));
  await other.page.keyboard.press("ArrowDown");
  await other.page.waitForTimeout(500);
  const { view } = await params(other.page);
  await other.page.reload();
  await simulated(other.page);
  await other.page.locator("#tab-simulate canvas").first().focus();
  // There and back again: the same numbers.
  await other.page.keyboard.press("ArrowRight");
  await other.page.keyboard.press("ArrowLeft");
  await other.page.waitForTimeout(500);
  const again = (await params(other.page)).view;
  view.split(",").forEach((v, i) => assert.ok(Math.abs(v - again.split(",")[i]) < 0.25, `${view} and ${again}`));
  // Another tab and back: as it was left.
  await other.page.click('.tab-link[data-tab="report"]');
  await other.page.goBack();
  await says(other.page, "t", String(Number(time_s.toFixed(4))));
  assert.deepEqual([...complaints, ...other.complaints], []);
  await context.close();
  await other.context.close();
});

test("Describe: page, search, the chosen error, positions, exaggeration", async () => {
  const { page, context, complaints } = await open(browser, at(`describe?machine=${machine}`));
  await page.locator(".scene-note.actual").waitFor();
  await page.fill('[data-position="X"]', "1200");
  await page.keyboard.press("Enter");
  await page.click('[data-page="errors"]');
  await page.fill(".error-search", "EC0");
  const first = page.locator(".errors tbody tr:not([hidden]) .error-text").first();
  await first.focus();
  const error = await first.getAttribute("data-error");
  await says(page, "error", error);
  const other = await copied(page);
  await other.page.locator(".scene-note.actual").waitFor();
  await other.page.waitForSelector(`.errors tr.chosen[data-row="${error}"]`);
  assert.equal(await other.page.locator(".error-search").inputValue(), "EC0");
  assert.equal(await other.page.locator('[data-position="X"]').inputValue(), "1200");
  assert.deepEqual([...complaints, ...other.complaints], []);
  await context.close();
  await other.context.close();
});

test("Predict: what if, the page below, the magnification", async () => {
  const { page, context, complaints } = await open(browser, at(`predict?study=${nas}`));
  await page.locator('.predict-page:not([hidden]) [data-test="verdict"]').waitFor();
  await page.click('[data-show="what-if"]');
  const row = page.locator(".what-if-errors tbody tr").first();
  const error = await row.getAttribute("data-error");
  await row.locator('input[type="checkbox"]').uncheck();
  await page.locator(".what-if-errors tbody tr").nth(1).locator('input[type="range"]').fill("1.5");
  await page.locator("#tab-predict .exaggeration").first().fill("60");
  await says(page, "k", "60");
  const other = await copied(page);
  await other.page.waitForFunction(() => document.querySelector('[data-test="what-if-time"]')?.textContent);
  // The answers of both windows have come by now; that of the second change was the last here.
  await other.page.waitForFunction(
    (text) => document.querySelector(".verdict-worst")?.textContent === text,
    await page.textContent(".verdict-worst"),
  );
  assert.equal(await other.page.locator('[data-test="changes"]').textContent(), "2 changes");
  assert.equal(
    await other.page.locator(`.what-if-errors [data-error="${error}"] input[type=checkbox]`).isChecked(),
    false,
  );
  assert.ok(await other.page.locator('[data-show="what-if"][aria-pressed="true"]').isVisible());
  assert.equal(await other.page.locator("#tab-predict .exaggeration").first().inputValue(), "60");
  assert.deepEqual([...complaints, ...other.complaints], []);
  await context.close();
  await other.context.close();
});

test("Plan: the path and the station", async () => {
  const { page, context, complaints } = await open(browser, at("plan?campaign=examples/04_plan/probe-ball.toml"));
  await page.click('#tab-plan [data-path="C"]');
  await page.click('#tab-plan [data-station="5"]');
  await says(page, "station", "6");
  const other = await copied(page);
  await other.page.waitForFunction(() => document.querySelector(".station-now")?.textContent.startsWith("6 of 36: "));
  assert.deepEqual([...complaints, ...other.complaints], []);
  await context.close();
  await other.context.close();
});

test("dropped files survive a reload, are listed on the first page, and can be removed", async () => {
  const { page, context, complaints } = await open(browser, at(`simulate?machine=${engraver}`));
  await page.waitForSelector('[data-choice="program"]');
  await page.click('.tab-link[data-tab="start"]');
  const buffer = Buffer.from("G21 G90 G94\nG1 X1 Y2 F100\nM30\n");
  await page.setInputFiles("#tab-start .drop-input", { name: "mine.nc", mimeType: "text/plain", buffer });
  await simulated(page);
  await page.reload();
  await simulated(page);
  assert.match(await page.textContent("#tab-simulate .source-head"), /mine\.nc/);

  await page.goto(at("standards"));
  await page.waitForSelector("#tab-standards .result");
  const csv = readFileSync(path.join(root, "examples/07_verify/x-axis-laser.csv"), "utf8");
  await drop(page, "#tab-standards", "mine.csv", csv);
  await page.waitForFunction(() => location.hash.includes("dropped=mine.csv"));
  await page.waitForFunction(() => document.querySelector("#tab-standards .result")?.textContent.length > 40);
  const text = await page.textContent("#tab-standards .result");
  await page.reload();
  await page.waitForFunction((said) => document.querySelector("#tab-standards .result")?.textContent === said, text);

  await page.goto(at("start"));
  const kept = page.locator('[data-test="kept"]');
  await kept.getByText("mine.csv").waitFor();
  assert.match(await kept.textContent(), /at most 8 files and 100\.0\u202fMB/);
  await kept.getByRole("button", { name: "Remove mine.csv" }).click();
  await kept.getByText("mine.csv").waitFor({ state: "detached" });
  await kept.getByRole("button", { name: "Remove mine.nc" }).click();
  await kept.waitFor({ state: "hidden" });
  assert.deepEqual(complaints, []);
  await context.close();
});

test("edits that are not saved are said on every tab, and before leaving", async () => {
  const { page, context, complaints } = await open(browser, at(`describe?machine=${machine}`));
  await page.locator(".scene-note.actual").waitFor();
  await page.click('[data-page="errors"]');
  const box = page.locator('[data-error="EC0Y"]');
  await box.fill("3 ± 1 urad");
  await box.press("Enter");
  const said = page.locator('[data-test="unsaved"]');
  await said.waitFor();
  assert.equal(await said.textContent(), "1 file not saved");
  await page.click('.tab-link[data-tab="report"]');
  assert.ok(await said.isVisible());
  let asked = "";
  page.once("dialog", (dialog) => {
    asked = dialog.type();
    void dialog.accept();
  });
  await page.reload();
  assert.equal(asked, "beforeunload");
  await page.goto(at(`describe?machine=${machine}`));
  await page.locator(".scene-note.actual").waitFor();
  assert.equal(await said.isVisible(), false);
  assert.deepEqual(complaints, []);
  await context.close();
});
