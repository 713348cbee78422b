// The Predict tab: what it shows is what `trueaxis predict` says, and what-if is what it would say.

import assert from "node:assert/strict";
import { appendFileSync, cpSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import path from "node:path";
import { test } from "node:test";
import { cli, open, picture, root, serve } from "./served.mjs";
import { browser, server } from "./shared.mjs";

const NAS = "examples/03_predict/nas979-on-xkas2525.toml";
const FAILING = "examples/03_predict/nas979-head-out-of-square.toml";
const HOLES = "examples/03_predict/torque-arm.toml";
const DRAWING = "examples/03_predict/housing.toml";

/** µm with one digit, as the page writes it. */
const micro = (mm) =>
  (1e3 * mm)
    .toFixed(1)
    .replace("-", "\u2212")
    .replace(/^\u22120\.0$/, "0.0");
const percent = (ratio) => `${(100 * ratio).toFixed(0)} %`;
const indicesOf = (document) => ({
  ...document.indices.paper,
  ...document.indices.iso,
  volumetric_max_mm: document.indices.volumetric_max_mm,
});

/** Opens an example from the first page. */
async function openExample(example, options) {
  const opened = await open(browser, server.address, options);
  await opened.page.click(`[data-example="${example}"]`);
  await opened.page.waitForSelector(".predict-page:not([hidden]) [data-test=verdict]");
  return opened;
}

/** The table of indices as it stands on the page. */
const shownIndices = (page) =>
  page.$$eval(".predict-indices tbody tr", (rows) =>
    Object.fromEntries(
      rows.map((row) => [
        row.dataset.index,
        Object.fromEntries(
          [...row.querySelectorAll("[data-cell]")].map((cell) => [cell.dataset.cell, cell.textContent]),
        ),
      ]),
    ),
  );

/** Does something and waits until its what-if answer is drawn; its time in ms. */
async function whatIf(page, act) {
  const time = page.locator("[data-test=what-if-time]");
  await time.evaluate((element) => delete element.dataset.drawn);
  await act();
  await page.waitForFunction(() => document.querySelector("[data-test=what-if-time]")?.dataset.drawn);
  return time.evaluate((element) => ({ answer: Number(element.dataset.answer), drawn: Number(element.dataset.drawn) }));
}

function assertIndices(shown, document) {
  const values = indicesOf(document);
  assert.deepEqual(Object.keys(shown).sort(), Object.keys(values).sort());
  for (const [key, { value }] of Object.entries(values)) assert.equal(shown[key].value, micro(value), key);
}

test("verdict, indices, error budget and Monte Carlo are those of the command line", async () => {
  const expected = await cli("predict", NAS, "--no-report");
  const { page, complaints } = await openExample(NAS);
  const shown = await shownIndices(page);
  assertIndices(shown, expected);
  for (const judged of expected.judgements) {
    const row = shown[judged.index];
    assert.equal(row.tolerance, micro(judged.tolerance_mm));
    assert.equal(row.used, percent(judged.used_ratio));
  }
  for (const [key, { u_mm }] of Object.entries(indicesOf(expected)))
    assert.equal(shown[key].U, micro(2 * u_mm), `U of ${key}`);
  assert.equal(await page.textContent(".predict-summary [data-test=verdict]"), expected.verdict.toUpperCase());
  const worst = expected.judgements.filter((j) => j.decisive).sort((a, b) => b.used_ratio - a.used_ratio)[0];
  assert.match(
    await page.textContent(".predict-summary [data-test=worst]"),
    new RegExp(`${micro(worst.value_mm)}.*${percent(worst.used_ratio)} used`),
  );

  const titles = await page.$$eval("[data-page=budget] svg g > title", (all) =>
    all.map((t) => t.textContent.split(",")[0]),
  );
  const gains = expected.blame
    .filter((share) => share.index === worst.index)
    .map((share) => ({ error: share.error, gain: worst.value_mm - share.without_mm }));
  gains.sort((a, b) => Math.abs(b.gain) - Math.abs(a.gain));
  assert.deepEqual(
    titles,
    gains.slice(0, 14).map(({ error, gain }) => `${error}: ${micro(gain)}\u202fµm`),
  );

  const section = expected.positions[1];
  assert.match(
    await page.textContent("[data-test=fit]"),
    new RegExp(`minimum zone: roundness ${micro(section.iso.roundness_mzc_mm.value)}`),
  );
  await picture(page, "predict");

  await page.click("[data-show=numbers]");
  for (const [key, { monte_carlo: spread }] of Object.entries(indicesOf(expected))) {
    const cells = await page.$$eval(`[data-test=monte-carlo] tr[data-index=${key}] td`, (all) =>
      all.map((td) => td.textContent),
    );
    assert.deepEqual(cells.slice(1), [
      micro(spread.mean_mm),
      (1e3 * spread.u_mm).toFixed(2),
      (1e3 * indicesOf(expected)[key].u_mm).toFixed(2),
      spread.interval_95_mm.map(micro).join(" … "),
    ]);
  }

  const [download] = await Promise.all([
    page.waitForEvent("download"),
    page.click('.predict-indices [aria-label="Save the indices as CSV"]'),
  ]);
  const csv = readFileSync(await download.path(), "utf8")
    .trim()
    .split("\n");
  assert.equal(csv.length, 1 + Object.keys(shown).length);
  const row = csv.find((line) => line.startsWith('"roundness, minimum zone"')).split(",");
  assert.equal(Number(row[2]), 1e3 * expected.indices.iso.roundness_mzc_mm.value);
  assert.deepEqual(complaints, []);
});

test("an error that is switched off: as if its machine file said zero", async () => {
  const folder = mkdtempSync(path.join(tmpdir(), "trueaxis-what-if-"));
  try {
    for (const part of ["machines/xkas2525", "testpieces", "examples/03_predict"])
      cpSync(path.join(root, part), path.join(folder, part), { recursive: true });
    const file = path.join(folder, "machines/xkas2525/machine.toml");
    const text = readFileSync(file, "utf8");
    const without = text.replace(/^(EY0A\s*=).*$/m, '$1 "0 um"');
    assert.notEqual(without, text);
    writeFileSync(file, without);
    const expected = await cli("predict", path.join(folder, NAS), "--no-report");
    const original = await cli("predict", NAS, "--no-report");

    const { page, complaints } = await openExample(NAS);
    await whatIf(page, () => page.click('[data-page=budget] svg g[aria-label^="EY0A:"]'));
    assert.equal(await page.isChecked("[data-error=EY0A] input[type=checkbox]"), false);
    const shown = await shownIndices(page);
    assertIndices(shown, expected);
    for (const [key, { value }] of Object.entries(indicesOf(original)))
      assert.equal(shown[key].before, micro(value), `before, ${key}`);
    assert.equal(await page.textContent(".predict-summary [data-test=verdict]"), expected.verdict.toUpperCase());
    await picture(page, "predict-what-if");

    await page.click("[data-test=reset]");
    assertIndices(await shownIndices(page), original);
    assert.equal(await page.textContent("[data-test=changes]"), "nothing changed");
    assert.deepEqual(complaints, []);
  } finally {
    rmSync(folder, { recursive: true });
  }
});

test("dragging, setting, tool: answers come while one drags; without effect nothing changes", async (t) => {
  const original = await cli("predict", NAS, "--no-report");
  const { page, complaints } = await openExample(NAS);
  await page.click("[data-show=what-if]");
  const times = [];
  for (let i = 0; i <= 10; i++)
    times.push(
      await whatIf(page, () => page.locator("[data-error=EB0A] input[type=range]").fill(String((-20 + 2 * i) / 10))),
    );
  const middle = (key) =>
    times
      .map((time) => time[key])
      .sort((a, b) => a - b)[5]
      .toFixed(0);
  t.diagnostic(
    `what-if: answered in ${middle("answer")} ms, drawn after ${middle("drawn")} ms (median of ${times.length})`,
  );
  assert.ok(
    times.every(({ drawn }) => drawn < 2000),
    `slowest ${Math.max(...times.map(({ drawn }) => drawn))} ms`,
  );

  await page.click("[data-test=reset]");
  // An error of the linear axes' zero has no effect on this part: the answer is the prediction.
  await page.click(".what-if-find button");
  await whatIf(page, () => page.locator("[data-error=EX0Y] input[type=checkbox]").uncheck());
  const shown = await shownIndices(page);
  for (const [key, { value, u_mm }] of Object.entries(indicesOf(original)))
    assert.deepEqual([shown[key].value, shown[key].U], [micro(value), micro(2 * u_mm)], key);
  await page.click("[data-test=reset]");

  // The study compares the zero touched along the cone axis: C = 90°, A = 10°.
  const touched = original.variants.find((v) => v.name === "zero touched with the tool along the cone axis");
  await whatIf(page, () => page.locator("[data-setting=C]").fill("90"));
  await whatIf(page, () => page.locator("[data-setting=A]").fill("10"));
  const set = await shownIndices(page);
  for (const [key, value] of Object.entries(touched.indices_mm)) assert.equal(set[key].value, micro(value), key);
  await whatIf(page, async () => {
    await page.locator('[data-setting-box="tool length"]').fill("150");
    await page.keyboard.press("Enter");
  });
  assert.notDeepEqual(await shownIndices(page), set);
  assert.equal(await page.textContent("[data-test=changes]"), "3 changes");
  assert.deepEqual(complaints, []);
});

test("the single correction that saves the part can be tried", async () => {
  const expected = await cli("predict", FAILING, "--no-report");
  const { page, complaints } = await openExample(FAILING);
  assert.equal(await page.textContent(".predict-summary [data-test=verdict]"), "FAIL");
  const [correction] = expected.corrections;
  await whatIf(page, () => page.click(`[data-correction=${correction.error}] button:not(.error-link)`));
  const shown = await shownIndices(page);
  for (const [key, value] of Object.entries(correction.indices_mm)) assert.equal(shown[key].value, micro(value), key);
  assert.deepEqual(complaints, []);
});

test("a sensor that is warmer: as if the study said so", async () => {
  const folder = mkdtempSync(path.join(tmpdir(), "trueaxis-warm-"));
  const scale = '\n[scale.X]\nexpansion = "10.8 um/(m K)"\nfixed_point = "0 mm"\nsensors = { scale_x = "0 mm" }\n';
  let own;
  try {
    for (const part of ["machines/xkas2525", "testpieces", "examples/03_predict"])
      cpSync(path.join(root, part), path.join(folder, part), { recursive: true });
    appendFileSync(path.join(folder, "machines/xkas2525/machine.toml"), scale);
    const warm = "examples/03_predict/warm.toml";
    writeFileSync(
      path.join(folder, warm),
      `${readFileSync(path.join(folder, NAS), "utf8")}\n[temperature]\nscale_x = "31.5 degC"\n`,
    );
    const expected = await cli("predict", path.join(folder, warm), "--no-report");
    const cold = await cli("predict", path.join(folder, NAS), "--no-report");

    own = await serve(folder);
    const { page, complaints } = await open(browser, own.address);
    await page.goto(new URL(`#predict?study=${NAS}`, own.address).href);
    await page.click("[data-show=what-if]");
    assertIndices(await shownIndices(page), cold);
    await whatIf(page, async () => {
      await page.locator("[data-setting-box=scale_x]").fill("31.5");
      await page.keyboard.press("Enter");
    });
    assertIndices(await shownIndices(page), expected);
    assert.deepEqual(complaints, []);
  } finally {
    await own?.stop();
    rmSync(folder, { recursive: true });
  }
});

test("holes, without and with compensation", async () => {
  const expected = await cli("predict", HOLES, "--no-report");
  const { page, complaints } = await openExample(HOLES);
  assert.equal(
    await page.textContent(".predict-page:not([hidden]) [data-test=verdict]"),
    expected.in_tolerance ? "PASS" : "FAIL",
  );
  for (const set of expected.sets) {
    const row = page.locator(`.hole-sets tr[data-set=${set.compensation}]`);
    assert.equal(await row.locator("[data-cell=worst]").textContent(), micro(set.worst_mm));
    assert.equal(await row.locator("[data-cell=U]").textContent(), micro(2 * set.u_worst_mm));
    await page.click(`button[data-set=${set.compensation}]`);
    const shown = await page.$$eval(".predict-holes tbody tr", (rows) =>
      rows.map((r) => ["dX", "dY"].map((cell) => r.querySelector(`[data-cell=${cell}]`).textContent)),
    );
    assert.deepEqual(
      shown,
      set.holes.map(({ error_um: [x, y] }) => [micro(x / 1e3), micro(y / 1e3)]),
    );
  }
  await page.click("button[data-set=none]");
  await picture(page, "predict-holes");
  assert.deepEqual(complaints, []);
});

test("a part by its drawing: characteristics, errors and surfaces", async () => {
  const expected = await cli("predict", DRAWING, "--no-report");
  const { page, complaints } = await openExample(DRAWING);
  const shown = ".predict-page:not([hidden])";
  assert.equal(await page.textContent(`${shown} [data-test=verdict]`), expected.outcome.toUpperCase());
  const two = (mm) =>
    (1e3 * mm)
      .toFixed(2)
      .replace("-", "\u2212")
      .replace(/^\u22120\.00$/, "0.00");
  for (const value of expected.characteristics) {
    const row = page.locator(`${shown} tr[data-set="${value.name}"]`);
    assert.equal(await row.locator("[data-cell=value]").textContent(), two(value.value_mm));
    assert.equal(await row.locator("[data-cell=u]").textContent(), two(value.u_mm));
    await row.locator("button").click();
    const errors = await page.$$eval(`${shown} tr[data-error]`, (rows) => rows.map((r) => r.dataset.error));
    assert.deepEqual(
      errors,
      value.errors.map((e) => e.error),
    );
  }
  const features = await page.$$eval(`${shown} tr[data-feature]`, (rows) => rows.map((r) => r.dataset.feature));
  assert.deepEqual(
    features,
    expected.features.map((f) => f.name),
  );
  // The worst point of the surface that was chosen last, with its block and its causes.
  const last = expected.characteristics.at(-1);
  const feature = expected.features.find((f) => f.name === last.feature);
  const worst = [feature.most, feature.least].reduce((a, b) =>
    Math.abs(a.deviation_mm) >= Math.abs(b.deviation_mm) ? a : b,
  );
  assert.equal(
    await page.textContent(`${shown} [data-test=point-deviation]`),
    `${feature.name}: ${two(worst.deviation_mm)} µm`,
  );
  const block = await page.textContent(`${shown} [data-test=block]`);
  assert.match(block, new RegExp(`^T${worst.tool}, .*housing\\.nc line ${worst.line}, `));
  const causes = worst.errors.map((e) => `${e.error} ${two(e.part_mm)}`).join(", ");
  assert.equal(await page.textContent(`${shown} [data-test=causes]`), `Errors, in µm: ${causes}`);
  // A point that is pressed is another one.
  const scene = await page.locator(`${shown} .predict-scene canvas`).boundingBox();
  const before = await page.textContent(`${shown} [data-test=point]`);
  const pressed = [0.35, 0.4, 0.45, 0.5, 0.55, 0.6, 0.65].flatMap((x) => [0.45, 0.5, 0.55].map((y) => [x, y]));
  for (const [x, y] of pressed) await page.mouse.click(scene.x + x * scene.width, scene.y + y * scene.height);
  assert.notEqual(await page.textContent(`${shown} [data-test=point]`), before);
  assert.equal(
    await page.textContent(`${shown} [data-test=many]`),
    `good on ${(100 * expected.monte_carlo.good_ratio).toFixed(1)} % of machines`,
  );
  const correction = await page.textContent(`${shown} [data-test=correction]`);
  for (const name of expected.sufficient) assert.match(correction, new RegExp(`of ${name} alone`));
  assert.equal(/^No single/.test(correction), expected.sufficient.length === 0);
  await picture(page, "predict-drawing");
  // The same by the compensated program, and back.
  const after = await cli("predict", DRAWING, "--compensated", "--no-report");
  await page.click(`${shown} [data-test=compensate]`);
  await page.waitForSelector(`${shown} [data-test=compensated]`);
  assert.equal(
    await page.textContent(`${shown} [data-test=compensated]`),
    `by the compensated program: ${after.compensated_outcome} with the zero kept, ${after.compensated_zero_set_outcome} with it set again`,
  );
  for (const value of after.characteristics) {
    const row = page.locator(`${shown} tr[data-set="${value.name}"]`);
    assert.equal(await row.locator("[data-cell=value]").textContent(), two(value.value_mm));
    assert.equal(await row.locator("[data-cell=kept]").textContent(), two(value.compensated.value_mm));
    assert.equal(await row.locator("[data-cell=set]").textContent(), two(value.compensated_zero_set.value_mm));
  }
  await picture(page, "predict-drawing-compensated");
  await page.click(`${shown} [data-test=compensate]`);
  await page.waitForSelector(`${shown} [data-test=compensated]`, { state: "detached" });
  assert.deepEqual(complaints, []);
});
