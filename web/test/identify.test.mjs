// Identify: what the tab shows is what `trueaxis identify` says; dropped readings take the place of an instrument's.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import path from "node:path";
import { test } from "node:test";
import { cli, open, picture, root } from "./served.mjs";
import { browser, server } from "./shared.mjs";
import { downloaded, drop, exports, shown, table } from "./measured.mjs";

const single = "examples/05_identify/probe-ball.toml";
const mixed = "examples/05_identify/mixed-instruments.toml";

async function openCampaign(page, campaign) {
  await page.click(`[data-example="${campaign}"]`);
  await page.waitForSelector('#tab-identify [data-test="verdict"]');
}

/** Every unknown with value, uncertainty, unit and z, as the document has them. */
function values(document) {
  return [...document.errors, ...document.setup].map((one) => {
    const angle = "value_urad" in one;
    return [
      one.name,
      shown(angle ? one.value_urad : one.value_um, 3),
      shown(one.u, 3),
      angle ? "µrad" : "µm",
      shown(one.z, 1),
    ];
  });
}

/** Seen from above: every arrow before is as long as its data say, by the arrow of the scale below. */
async function arrowsAreToScale(page) {
  const { text } = await downloaded(page, () =>
    page.locator("#tab-identify .vectors").getByRole("button", { name: "Save as CSV" }).click(),
  );
  const rows = text
    .trim()
    .split("\n")
    .slice(1)
    .map((line) => line.split(",").map(Number));
  const { scale, words, paths } = await page.$eval("#tab-identify .vectors svg", (svg) => ({
    paths: [...svg.querySelectorAll("g")].map((group) => group.querySelector("path")?.getAttribute("d") ?? ""),
    scale: svg.querySelector(":scope > path").getAttribute("d"),
    words: [...svg.querySelectorAll(":scope > text")].at(-1).textContent,
  }));
  const pixels = (path) => {
    const [x, y, to_x, to_y] = path.match(/-?[\d.]+/g).map(Number);
    return Math.hypot(to_x - x, to_y - y);
  };
  const per_um = pixels(scale) / Number.parseFloat(words);
  assert.equal(paths.length, rows.length);
  const far = rows.map((row, i) => ({ um: Math.hypot(row[3], row[4]), path: paths[i] })).filter(({ um }) => um > 5);
  assert.ok(far.length > 20, `${far.length} arrows above 5 µm`);
  for (const { um, path: drawn } of far)
    assert.ok(Math.abs(pixels(drawn) - um * per_um) < 0.02 * um * per_um + 0.3, `${um} µm is ${pixels(drawn)} px`);
}

test("verdict, scores, errors with uncertainty, residuals, correlation", async () => {
  const { page, context, complaints } = await open(browser, server.address);
  await openCampaign(page, mixed);
  const document = await cli("identify", mixed);
  const verdict = await page.textContent('#tab-identify [data-test="verdict"]');
  assert.ok(verdict.includes(document.verdict.words), verdict);
  assert.ok(verdict.startsWith(document.verdict.good ? "Good" : "Not good"), verdict);
  for (const [key, score] of Object.entries(document.rms)) {
    const row = await page.textContent(`#tab-identify [data-score="${key}"]`);
    assert.ok(row.includes(shown(score.um, 3)) && row.includes(shown(score.times_noise, 2)), `${key}: ${row}`);
  }
  assert.deepEqual(await table(page, "values"), values(document));
  const bars = await page.textContent("#tab-identify .split-right");
  for (const one of document.errors) {
    const value = one.value_um ?? one.value_urad;
    const unit = "value_urad" in one ? "µrad" : "µm";
    assert.ok(bars.includes(`${shown(value, 1)}\u202f±\u202f${shown(one.u, 1)}\u202f${unit}`), one.name);
  }
  assert.match(bars, /All unknowns are observable/);
  assert.match(
    await page.textContent("#tab-identify .pictures"),
    /EY0A and EA0Z \(\+0\.97\d\): their difference is better known than each/,
  );
  // The arrows are magnified by the factor that is written next to them.
  const factor = await page.textContent("#tab-identify .vectors .factor");
  assert.ok((await page.textContent("#tab-identify .vectors svg")).includes(`arrows ${factor}`));
  await page.getByRole("button", { name: "XY", exact: true }).click();
  assert.match(await page.textContent("#tab-identify .vectors svg"), /X −\d+ … \d+\u202fmm/);
  await arrowsAreToScale(page);
  await page.getByRole("button", { name: "3-D" }).click();
  await exports(page, "#tab-identify .vectors");
  await picture(page, "identify");
  assert.deepEqual(complaints, []);
  await context.close();
});

test("what is not observable is said in words, and the machine can be saved", async () => {
  const { page, context, complaints } = await open(browser, server.address);
  await openCampaign(page, single);
  const document = await cli("identify", single);
  const text = await page.textContent('#tab-identify [data-test="confounded"]');
  assert.equal(document.unobservable.length, 3);
  for (const one of document.unobservable)
    assert.ok(text.includes(one.words) && text.includes(one.resolve_with), one.combination);
  assert.deepEqual(await table(page, "values"), values(document));
  const { name, text: machine } = await downloaded(page, () => page.click('[data-test="save-machine"]'));
  assert.equal(name, "machine-identified.toml");
  assert.match(machine, /\[machine\]/);
  const found = document.errors.find((one) => one.name === "EY0C");
  const line = machine.split("\n").find((one) => /^EY0C\b/.test(one.trim()));
  const [written] = line.match(/-?\d+(\.\d+)?/g).slice(1);
  assert.ok(Math.abs(Number(written) - found.value_um) < 0.01, line);
  assert.deepEqual(complaints, []);
  await context.close();
});

test("dropped readings give the same as the file; of several instruments one is asked for", async () => {
  const { page, context, complaints } = await open(browser, server.address);
  await openCampaign(page, single);
  const from_file = await table(page, "values");
  await drop(
    page,
    "#tab-identify",
    "again.csv",
    readFileSync(path.join(root, "examples/05_identify/probe-ball.csv"), "utf8"),
  );
  await page.waitForFunction(
    () =>
      /again\.csv/.test(document.querySelector("#tab-identify .form")?.textContent ?? "") &&
      document.querySelector('#tab-identify [data-sheet="influence"]')?.textContent.includes("again.csv:"),
  );
  assert.deepEqual(await table(page, "values"), from_file);
  await page.evaluate((hash) => {
    location.hash = hash;
  }, `#identify?campaign=${mixed}`);
  await page.waitForFunction(() =>
    document.querySelector("#tab-identify .result h1")?.textContent.startsWith("ball-bar, R-test"),
  );
  const of_three = await table(page, "values");
  await drop(page, "#tab-identify", "r.csv", readFileSync(path.join(root, "examples/05_identify/r-test.csv"), "utf8"));
  await page.selectOption('#tab-identify [data-test="instrument"]', "r-test");
  await page.waitForSelector('#tab-identify [data-sheet="values"]');
  assert.deepEqual(await table(page, "values"), of_three);
  assert.deepEqual(complaints, []);
  await context.close();
});

test("a bad cell of dropped readings is named with its line", async () => {
  const { page, context, complaints } = await open(browser, server.address);
  await openCampaign(page, single);
  const lines = readFileSync(path.join(root, "examples/05_identify/probe-ball.csv"), "utf8").split("\n");
  const row = lines.findIndex((line) => /^[-\d]/.test(line));
  lines[row] = lines[row].replace(/^[^,]*/, "abc");
  await drop(page, "#tab-identify", "bad.csv", lines.join("\n"));
  const refused = await page.waitForSelector("#tab-identify .refused");
  const text = await refused.textContent();
  assert.ok(text.includes(`bad.csv:${row + 1}:`), text);
  assert.match(text, /abc/);
  await page.getByRole("button", { name: "Readings of the campaign" }).click();
  await page.waitForSelector('#tab-identify [data-test="verdict"]');
  assert.deepEqual(complaints, []);
  await context.close();
});
