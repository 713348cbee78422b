// Plan: what the tab shows is what `trueaxis plan` says; a station puts the machine there.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { mkdtempSync, readFileSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import path from "node:path";
import { test } from "node:test";
import { cli, open, picture, root } from "./served.mjs";
import { browser, server } from "./shared.mjs";
import { downloaded, drop, exports, shown, table } from "./measured.mjs";

const probe = "examples/04_plan/probe-ball.toml";
const touch = "examples/04_plan/touch-probe-5-minutes.toml";

async function openCampaign(page, campaign) {
  await page.click(`[data-example="${campaign}"]`);
  await page.waitForSelector('#tab-plan [data-test="summary"]', { timeout: 60_000 });
}

/** Every bar of U (k = 2) stands there with its value. */
async function expected(page, document) {
  const text = await page.textContent("#tab-plan .result");
  for (const one of document.expected) {
    const unit = one.unit === "um" ? "µm" : "µrad";
    const value = one.expanded_k2 === null ? "–" : `${shown(one.expanded_k2, 2)}\u202f${unit}`;
    assert.ok(text.includes(`${one.name}: ${value}`), `${one.name}: ${value}`);
  }
}

test("paths, expected uncertainty, confounded combinations, what each path sees", async () => {
  const { page, context, complaints } = await open(browser, server.address);
  await openCampaign(page, probe);
  const document = await cli("plan", probe);
  const rows = await page.$$eval("#tab-plan .paths tbody tr", (all) =>
    all.map((row) => [...row.cells].map((cell) => cell.textContent)),
  );
  assert.equal(rows.length, document.paths.length);
  document.paths.forEach((one, i) => {
    assert.ok(rows[i][0].startsWith(one.name));
    assert.equal(rows[i][1], String(one.stations));
    assert.equal(rows[i][2], `${shown(one.program.duration_s, 1)}\u202fs`);
    assert.ok(rows[i][3].startsWith(one.program.sound ? "sound" : "not sound"));
  });
  assert.match(
    await page.textContent('#tab-plan [data-test="summary"]'),
    new RegExp(`${document.rank} of ${document.expected.length} combinations observable`),
  );
  await expected(page, document);
  const words = await page.textContent('#tab-plan [data-test="confounded"]');
  for (const one of document.unobservable)
    assert.ok(words.includes(one.words) && words.includes(one.resolve_with), one.combination);
  // The data of the heat map are the numbers of the document.
  const map = page.locator("#tab-plan .figure", { hasText: "What each path sees" });
  const { text: csv } = await downloaded(page, () => map.getByRole("button", { name: "Save as CSV" }).click());
  const [heading, first] = csv.split("\n").map((line) => line.split(","));
  const seen = document.paths.flatMap((one) => one.seen_of_10_um_or_urad[0].largest);
  assert.deepEqual(
    heading.slice(1),
    document.paths.flatMap((one) => one.channels.map((channel) => `${one.name} ${channel}`)),
  );
  assert.deepEqual(
    first.slice(1),
    seen.map((v) => (v < 1e-6 ? "" : String(v))),
  );
  await exports(page, "#tab-plan .result");
  await picture(page, "plan");
  assert.deepEqual(complaints, []);
  await context.close();
});

test("a click on a station puts the machine there", async () => {
  const { page, context, complaints } = await open(browser, server.address);
  await openCampaign(page, probe);
  await page.click('#tab-plan [data-path="C"]');
  await page.click('#tab-plan [data-station="5"]');
  const cells = await page.$$eval('#tab-plan [data-station="5"] td', (all) =>
    all.map((cell) => cell.textContent.replace("−", "-")),
  );
  const axes = await page.$$eval("#tab-plan .stations th", (all) => all.map((cell) => cell.textContent.split(",")[0]));
  const at = axes
    .slice(1)
    .map((name, i) => `${name}=${cells[i + 1]}`)
    .join(" ");
  const pose = await cli("pose", "machines/lei-hsu-mill/machine.toml", "--at", at);
  await page.waitForFunction((wanted) => {
    const tip = window.trueaxisScene?.nominalTip();
    return tip?.every((v, i) => Math.abs(v - wanted[i]) < 2e-3);
  }, pose.nominal.tip_mm);
  assert.match(await page.textContent("#tab-plan .station-now"), /^6 of 36: /);
  assert.deepEqual(complaints, []);
  await context.close();
});

test("programs of every control can be saved", async () => {
  const { page, context, complaints } = await open(browser, server.address);
  await openCampaign(page, probe);
  await page.selectOption('#tab-plan [data-test="dialect"]', "heidenhain");
  const save = page.getByRole("button", { name: "Save 01-a.h" });
  await save.waitFor();
  const { name, text } = await downloaded(page, () => save.click());
  assert.equal(name, "01-a.h");
  assert.match(text, /^BEGIN PGM|^0 BEGIN PGM/m);
  assert.deepEqual(complaints, []);
  await context.close();
});

test("the chosen poses of the five minutes stand against a grid", async () => {
  const { page, context, complaints } = await open(browser, server.address);
  await openCampaign(page, touch);
  const document = await cli("plan", touch);
  const { chosen } = document;
  const words = await page.textContent('#tab-plan [data-test="chosen"]');
  assert.ok(words.startsWith(`${chosen.poses} of ${chosen.candidates} poses, ${chosen.readings} readings`), words);
  const rows = await table(page, "chosen");
  chosen.expected.forEach((one, i) =>
    assert.deepEqual(rows[i], [
      one.name,
      shown(one.expanded_k2, 2),
      shown(chosen.grid.expected[i].expanded_k2, 2),
      one.unit === "um" ? "µm" : "µrad",
    ]),
  );
  await expected(page, document);
  assert.equal(await page.locator("#tab-plan [data-station]").count(), chosen.readings);
  assert.deepEqual(complaints, []);
  await context.close();
});

test("readings dropped on a plan are identified with its campaign", async () => {
  const folder = mkdtempSync(path.join(tmpdir(), "trueaxis-plan-"));
  const binary = process.env.TRUEAXIS ?? path.join(root, "target/release/trueaxis");
  execFileSync(binary, ["measure", probe, "-o", folder], { cwd: root });
  const { page, context, complaints } = await open(browser, server.address);
  await openCampaign(page, probe);
  await drop(page, "#tab-plan", "probe.csv", readFileSync(path.join(folder, "probe.csv"), "utf8"));
  await page.waitForSelector('#tab-identify [data-test="verdict"]');
  // The bars of this campaign are of the errors that were planned for, and what was not observable still is not.
  const document = await cli("plan", probe);
  const text = await page.textContent('#tab-identify [data-test="confounded"]');
  for (const one of document.unobservable) assert.ok(text.includes(one.combination), one.combination);
  assert.equal((await table(page, "values")).length, document.expected.length);
  assert.deepEqual(complaints, []);
  await context.close();
  rmSync(folder, { recursive: true });
});
