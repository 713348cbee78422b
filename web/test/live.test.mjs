// Live: what the tab shows of a run on the mock is what `trueaxis live status` says, while it runs and after it.
import assert from "node:assert/strict";
import { spawn } from "node:child_process";
import { mkdtempSync, rmSync } from "node:fs";
import os from "node:os";
import path from "node:path";
import { after, test } from "node:test";
import { cli, open, picture, program, root, serve } from "./served.mjs";
import { browser } from "./shared.mjs";
import { shown } from "./measured.mjs";

const plan = "examples/08_live/gantry-mock.toml";
// Command and server look into a folder of this test for the journal of the run.
const state = mkdtempSync(path.join(os.tmpdir(), "trueaxis-live-"));
process.env.XDG_STATE_HOME = state;
const server = await serve();

after(() => {
  server.stop();
  rmSync(state, { recursive: true, force: true });
});

const said = (page, name) => page.textContent(`#tab-live [data-test="${name}"]`);

async function openLive() {
  const opened = await open(browser, server.address);
  await opened.page.click(`[data-example="${plan}"]`);
  await opened.page.waitForSelector('#tab-live [data-test="state"]');
  return opened;
}

test("a plan that never ran, a run, its end", async () => {
  const { page, context, complaints } = await openLive();
  assert.equal(await said(page, "state"), "It has not run here");
  const run = spawn(program, ["live", plan, "--for", "25s"], { cwd: root, stdio: "ignore" });
  const ended = new Promise((done) => run.on("exit", done));
  await page.waitForSelector('#tab-live [data-state="run"]');
  assert.equal(await said(page, "state"), "Run");
  assert.equal(await said(page, "reason"), "follows its target");
  for (const axis of ["X", "Y"]) await page.waitForSelector(`#tab-live [data-axis="${axis}"] .live-bar`);
  await page.waitForSelector('#tab-live [data-quantity="X"] canvas');
  await picture(page, "live-run");
  assert.equal(await ended, 0);
  await page.waitForFunction(
    () => document.querySelector('#tab-live [data-test="state"]')?.textContent === "Not running (Off)",
  );
  const status = await cli("live", "status", plan, "--last", "8h");
  for (const axis of status.last.axes) {
    const cells = await page.locator(`#tab-live [data-axis="${axis.axis}"] td`).allTextContents();
    const um = (value) => `${shown(value, 1)}\u202fµm`;
    assert.deepEqual(cells.slice(2, 5), [
      um(axis.offset),
      um(axis.acting),
      axis.target === null ? "–" : um(axis.target),
    ]);
    assert.equal(cells[7], `${shown(axis.limit, 0)}\u202fµm`);
  }
  for (const sensor of status.last.sensors) {
    const cells = await page.locator(`#tab-live [data-sensor="${sensor.sensor}"] td`).allTextContents();
    assert.equal(cells[1], `${shown(sensor.celsius, 2)}\u202f°C`);
  }
  const events = await page.locator('#tab-live [data-sheet="live-events"] tr').count();
  assert.equal(events, status.events.length);
  // The history is asked for each ten seconds: opened again it is that of the command.
  await page.reload();
  await page.waitForSelector('#tab-live [data-quantity="X"] canvas');
  for (const axis of status.history.axes) {
    const title = await page.textContent(`#tab-live [data-quantity="${axis.axis}"] .figure-title`);
    for (const value of [axis.before_max, axis.before_rms, axis.left_max, axis.left_rms])
      assert.ok(title.includes(shown(value, 1)), `${title}: ${value}`);
  }
  assert.deepEqual(complaints, []);
  await context.close();
});

test("a plan that cannot be read says where", async () => {
  const { page, context, complaints } = await openLive();
  await page.goto(`${server.address}#live?plan=machines/xkas2525/machine.toml`);
  await page.waitForSelector("#tab-live .refused");
  assert.match(await page.textContent("#tab-live .refused"), /machine\.toml/);
  // A plan that can be read is shown again.
  await page.goto(`${server.address}#live?plan=${plan}`);
  await page.waitForSelector('#tab-live [data-test="state"]');
  assert.deepEqual(complaints, []);
  await context.close();
});
