// Verify: what the tab shows is what `trueaxis verify` says, for each of its subjects.
import assert from "node:assert/strict";
import { test } from "node:test";
import { cli, open, picture } from "./served.mjs";
import { browser, server } from "./shared.mjs";
import { downloaded, exports, shown } from "./measured.mjs";

const folder = "examples/07_verify";
const old = "machines/xkas2525/machine.toml";
const after = `${folder}/xkas2525-after-a-year.toml`;
const address = (hash) => new URL(`#${hash}`, server.address).href;

/** The verdict, once it is that of this question. */
async function verdict(page, title) {
  await page.locator("#tab-verify .shown-title", { hasText: title }).waitFor({ timeout: 60_000 });
  return page.textContent('#tab-verify [data-test="verdict"]');
}

/** The data of a figure as rows of cells. */
async function data(page, title) {
  const figure = page.locator("#tab-verify .figure", { hasText: title }).first();
  const { text } = await downloaded(page, () => figure.getByRole("button", { name: "Save as CSV" }).click());
  return text
    .trim()
    .split("\n")
    .slice(1)
    .map((line) => line.split(","));
}

/** The cells of a table of the report. */
function section(page, title) {
  return page.$$eval(`#tab-verify [data-section="${title}"] tbody tr`, (rows) =>
    rows.map((row) => [...row.cells].map((cell) => cell.textContent.replace("−", "-"))),
  );
}

test("readings against the machine file: verdict, every deviation with its U", async () => {
  const { page, context, complaints } = await open(browser, server.address);
  const file = `${folder}/probe-ball.toml`;
  await page.click(`.verb[data-verb="verify"] [data-example="${file}"]`);
  const document = await cli("verify", file);
  const words = await verdict(page, document.name);
  assert.match(words, new RegExp(`^${document.verdict}`, "i"));
  const rows = await data(page, "Measured − expected");
  // Three columns for each channel: line, deviation, half of U.
  const channels = [0, 1, 2].map((c) => document.deviations.filter((one) => one.channel === c));
  channels.forEach((all, c) =>
    all.forEach((one, i) =>
      assert.deepEqual(rows[i].slice(3 * c, 3 * c + 3).map(Number), [one.line, one.deviation_um, one.expanded_um / 2]),
    ),
  );
  assert.equal(rows.length, channels[0].length);
  await exports(page, "#tab-verify .pictures");
  await picture(page, "verify");
  assert.deepEqual(complaints, []);
  await context.close();
});

test("two calibrations: what has moved, with its uncertainty", async () => {
  const { page, context, complaints } = await open(browser, server.address);
  await page.goto(address(`verify?what=diff&file=${old}&new=${after}`));
  const document = await cli("verify", "--diff", old, after);
  await page.waitForSelector('#tab-verify [data-test="verdict"]');
  const words = await page.textContent('#tab-verify [data-test="verdict"]');
  assert.ok(document.moved.length > 0);
  for (const name of document.moved) assert.ok(words.includes(name), `${name}: ${words}`);
  const rows = await data(page, "Change of each error, µm");
  const order = ({ moved }) => ["yes", "perhaps", moved].indexOf(moved);
  const lengths = document.errors
    .filter((one) => one.unit === "um" && one.change !== null)
    .sort((a, b) => order(a) - order(b));
  assert.deepEqual(
    rows.map(([name, value, u]) => [name, Number(value), u === "" ? null : Number(u)]),
    lengths.map((one) => [one.error, one.change, one.u_change]),
  );
  await picture(page, "verify-diff");
  // A machine with another chain is none of its calibrations.
  await page.selectOption('#tab-verify [data-test="new"]', "machines/three-axis-mill/machine.toml");
  const refused = await page.waitForSelector("#tab-verify .refused");
  assert.match(await refused.textContent(), /two machine files of one machine|other/);
  assert.deepEqual(complaints, []);
  await context.close();
});

test("history: the figure over time, its limit, and when it is reached", async () => {
  const { page, context, complaints } = await open(browser, server.address, { width: 1280, height: 720 });
  await page.goto(address(`verify?what=history&file=${folder}/history`));
  await page.waitForSelector('#tab-verify [data-test="verdict"]');
  await page.fill('#tab-verify [data-test="limits"]', "EC0X=40 urad");
  await page.press('#tab-verify [data-test="limits"]', "Enter");
  const document = await cli("verify", "--history", `${folder}/history`, "--limit", "EC0X=40 urad");
  await page.waitForFunction(() => /limit 40/.test(document.querySelector("#tab-verify .pictures")?.textContent ?? ""));
  const one = document.series.find((series) => series.figure === "EC0X");
  const rows = await data(page, "EC0X");
  assert.deepEqual(
    rows.map((row) => Number(row[1])),
    one.points.map((point) => point.value),
  );
  const trends = await section(page, "Trends");
  const row = trends.find(([name]) => name === "EC0X");
  assert.equal(row[4], shown(one.slope_per_year, 2).replace("−", "-"));
  if (one.reached) assert.ok(row.join(" ").includes(one.reached));
  await picture(page, "verify-history");
  await page.fill('#tab-verify [data-test="limits"]', "EC0X=40");
  await page.press('#tab-verify [data-test="limits"]', "Enter");
  await page.waitForSelector("#tab-verify .refused");
  assert.deepEqual(complaints, []);
  await context.close();
});

test("a certificate: poses before and after, the limit, the decision", async () => {
  const { page, context, complaints } = await open(browser, server.address, { dark: true });
  const file = `${folder}/certificate.toml`;
  await page.goto(address(`verify?file=${file}`));
  const document = await cli("verify", "--certificate", file);
  await page.waitForSelector('#tab-verify [data-test="verdict"]', { timeout: 60_000 });
  const words = await page.textContent('#tab-verify [data-test="verdict"]');
  assert.match(words, new RegExp(document.verdict, "i"));
  const rows = await data(page, "without and with the compensation");
  assert.deepEqual(
    rows.map((row) => [Number(row[1]), Number(row[3])]),
    document.validation.poses.map((pose) => [pose.length_before_um, pose.length_after_um]),
  );
  await picture(page, "verify-certificate-dark");
  await page.click("#tab-verify .report-link");
  await page.waitForFunction(() => document.querySelector("[data-test=report-note]")?.textContent?.includes(".html"));
  const body = page.frameLocator(".report-frame").locator("body");
  assert.match(await body.textContent(), /all \d+ poses are within/);
  assert.deepEqual(complaints, []);
  await context.close();
});

test("lasers before and after, and a measured part", async () => {
  const { page, context, complaints } = await open(browser, server.address);
  const campaign = `${folder}/laser-before-after-x.toml`;
  await page.goto(address(`verify?what=laser&file=${campaign}`));
  const document = await cli("verify", "--before-after", campaign);
  const [first] = document.curves;
  await page
    .locator("#tab-verify .figure", { hasText: `${first.laser}, ${first.path}` })
    .first()
    .waitFor();
  const rows = await data(page, `${first.laser}, ${first.path}`);
  assert.deepEqual(
    rows.map((row) => [Number(row[0]), Number(row[1])]),
    first.targets.map((target) => [target.target_mm, target.up_um]),
  );
  await picture(page, "verify-laser");
  const part = `${folder}/nas979-points.toml`;
  await page.goto(address(`verify?file=${part}`));
  const measured = await cli("verify", "--part", part);
  const words = await verdict(page, measured.name ?? "NAS979");
  assert.match(words, new RegExp(measured.verdict ?? "", "i"));
  assert.deepEqual(complaints, []);
  await context.close();
});

test("a missing file is said; only the last choice is shown; a return does not compute again", async () => {
  const { page, context, complaints } = await open(browser, server.address);
  await page.goto(address(`verify?what=readings&file=${folder}/none.toml`));
  const refused = page.locator("#tab-verify .refused", { hasText: "none.toml" });
  await refused.waitFor();
  await page.click('#tab-verify [data-what="diff"]');
  await page.locator("#tab-verify .result", { hasText: "Choose two machine files" }).waitFor();
  // The certificate takes longer than the history.
  await page.click('#tab-verify [data-what="certificate"]');
  await page.click('#tab-verify [data-what="history"]');
  await page.locator("#tab-verify .shown-title", { hasText: "figures over its calibrations" }).waitFor();
  await page.waitForTimeout(2500);
  assert.match(await page.textContent("#tab-verify .shown-title"), /figures over its calibrations/);
  await page.reload();
  await page.locator("#tab-verify .shown-title", { hasText: "figures over its calibrations" }).waitFor();
  await page.evaluate(() => {
    document.querySelector("#tab-verify .shown-title").dataset.seen = "yes";
  });
  await page.click('.tab-link[data-tab="start"]');
  await page.waitForSelector("#tab-start:not([hidden])");
  await page.click('.tab-link[data-tab="verify"]');
  await page.waitForSelector("#tab-verify:not([hidden])");
  assert.equal(await page.locator("#tab-verify .shown-title[data-seen]").count(), 1);
  assert.deepEqual(complaints, []);
  await context.close();
});
