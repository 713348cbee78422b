// Measure: stations, typed and dropped readings, repeatability, saving; a virtual machine as `trueaxis measure` has it.
import assert from "node:assert/strict";
import { execFileSync, spawnSync } from "node:child_process";
import { cpSync, existsSync, mkdirSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import path from "node:path";
import { test } from "node:test";
import { cli, open, picture, program, root, serve } from "./served.mjs";
import { browser, server } from "./shared.mjs";
import { downloaded, drop, shown, table } from "./measured.mjs";

const campaign = "examples/04_plan/probe-ball.toml";
const address = (base, hash) => new URL(`#${hash}`, base).href;
const done = (page) => page.textContent('#tab-measure [data-test="done"]');

/** The virtual readings of the command line. */
function readings(file, table, ...options) {
  const folder = mkdtempSync(path.join(tmpdir(), "trueaxis-measure-"));
  execFileSync(program, ["measure", file, "-o", folder, ...options], { cwd: root, stdio: "ignore" });
  const text = readFileSync(path.join(folder, table), "utf8");
  rmSync(folder, { recursive: true });
  return text;
}

/** The standard deviation of readings of one target from one side, from all of them. */
function pooled(text) {
  const [head, ...lines] = text.split("\n").filter((line) => line && !line.startsWith("#"));
  const names = head.split(",");
  const at = (cells, name) => Number(cells[names.indexOf(name)]);
  const places = new Map();
  for (const line of lines) {
    const cells = line.split(",");
    const place = `${at(cells, "X")} ${at(cells, "X_approach")}`;
    places.set(place, [...(places.get(place) ?? []), at(cells, "deviation_um")]);
  }
  let [square, freedom] = [0, 0];
  for (const values of places.values()) {
    const mean = values.reduce((sum, v) => sum + v, 0) / values.length;
    square += values.reduce((sum, v) => sum + (v - mean) ** 2, 0);
    freedom += values.length - 1;
  }
  return Math.sqrt(square / freedom);
}

/** A project with the campaign and its machine. */
function project() {
  const folder = mkdtempSync(path.join(tmpdir(), "trueaxis-measure-"));
  mkdirSync(path.join(folder, "examples/04_plan"), { recursive: true });
  cpSync(path.join(root, "machines/lei-hsu-mill"), path.join(folder, "machines/lei-hsu-mill"), { recursive: true });
  const text = readFileSync(path.join(root, campaign), "utf8");
  writeFileSync(path.join(folder, campaign), text.replace('noise = "1 um"', 'noise = "1 um"\nreadings = "ball.csv"'));
  return folder;
}

async function type(page, row, values) {
  const cells = page.locator(`#tab-measure [data-row="${row}"] input`);
  for (const [i, value] of values.entries()) await cells.nth(i).fill(value);
}

test("typed readings: progress, repeatability, a cell that is no number", async () => {
  const { page, context, complaints } = await open(browser, server.address);
  await page.click(`.verb[data-verb="measure"] [data-example="${campaign}"]`);
  await page.waitForSelector('#tab-measure [data-test="done"]');
  const plan = await cli("plan", campaign);
  const stations = plan.paths.reduce((sum, one) => sum + one.stations, 0);
  assert.equal(await done(page), `0 of ${stations} readings`);
  assert.equal(await page.locator("#tab-measure [data-row]").count(), stations);
  assert.deepEqual(
    await page.$$eval("#tab-measure .path-row", (rows) => rows.map((row) => row.textContent)),
    plan.paths.map((one) => `Path ${one.name}`),
  );
  // With a comma, a point, a real minus sign.
  await type(page, 0, ["1,5", "−2.25", "+0.5"]);
  assert.equal(await done(page), `1 of ${stations} readings`);
  await page.locator("#tab-measure .result ~ div", { hasText: "No place has been read twice" }).waitFor();
  await page.getByRole("button", { name: "Repeat row 1", exact: true }).click();
  await type(page, 1, ["3.5", "-1.25", "0.5"]);
  await page.waitForSelector('#tab-measure [data-sheet="repeats"]');
  assert.equal(await done(page), `2 of ${stations + 1} readings`);
  // Two readings: s = |difference| / √2.
  const rows = await table(page, "repeats");
  assert.deepEqual(
    rows.map((row) => row.slice(0, 4)),
    [
      ["x", shown(2 / Math.SQRT2, 3), "1", "2.000"],
      ["y", shown(1 / Math.SQRT2, 3), "1", "1.000"],
      ["z", "0.000", "1", "0.000"],
    ],
  );
  await type(page, 2, ["abc", "1", "2"]);
  await page.locator("#tab-measure .bad-cells", { hasText: "row 3: x_um “abc” is no number" }).waitFor();
  const wrong = page.locator('#tab-measure [data-row="2"] input').first();
  assert.equal(await wrong.getAttribute("aria-invalid"), "true");
  await page.click('#tab-measure [data-test="save"]');
  await page.locator('#tab-measure [data-test="saved"]', { hasText: "row 3: x_um" }).waitFor();
  await picture(page, "measure");
  // Typed readings outlive a reload.
  await page.reload();
  await page.waitForSelector('#tab-measure [data-sheet="repeats"]');
  assert.equal(await page.locator("#tab-measure [data-row='1'] input").first().inputValue(), "3.5");
  page.once("dialog", (dialog) => dialog.accept());
  await page.click('#tab-measure [data-test="clear"]');
  assert.equal(await done(page), `0 of ${stations} readings`);
  assert.deepEqual(complaints, []);
  await context.close();
});

test("dropped readings with commas are saved as identify reads them; a file that is there stays", async () => {
  const folder = project();
  const own = await serve(folder);
  const { page, context, complaints } = await open(browser, own.address);
  try {
    await page.goto(address(own.address, `measure?campaign=${campaign}`));
    await page.waitForSelector('#tab-measure [data-test="done"]');
    const text = readings(campaign, "probe.csv", "--seed", "7");
    const german = text
      .split("\n")
      .map((line) => (line.startsWith("#") ? line : line.replaceAll(",", ";").replaceAll(".", ",")))
      .join("\n");
    await drop(page, "#tab-measure", "ball.csv", german);
    const count = text.split("\n").filter((line) => /^[-\d]/.test(line)).length;
    await page.waitForFunction(
      (n) => document.querySelector('#tab-measure [data-test="done"]')?.textContent === `${n} of ${n} readings`,
      count,
    );
    const file = path.join(folder, "examples/04_plan/ball.csv");
    assert.equal(await page.inputValue('#tab-measure [data-test="save-name"]'), "examples/04_plan/ball.csv");
    const said = page.locator('#tab-measure [data-test="saved"]');
    // A person's file stays.
    writeFileSync(file, "mine\n");
    await page.click('#tab-measure [data-test="save"]');
    await said.filter({ hasText: "ball.csv is there already" }).waitFor();
    assert.equal(readFileSync(file, "utf8"), "mine\n");
    rmSync(file);
    await page.click('#tab-measure [data-test="save"]');
    await said.filter({ hasText: `${count} readings saved` }).waitFor();
    assert.ok(existsSync(file));
    // Once more: this window has written it.
    await page.click('#tab-measure [data-test="save"]');
    await said.filter({ hasText: `${count} readings saved` }).waitFor();
    // The command line identifies the same from the file as from that of `trueaxis measure`.
    const identify = () => {
      const { stdout } = spawnSync(program, ["identify", campaign, "--format", "json"], { cwd: folder });
      return JSON.parse(stdout);
    };
    const saved = identify();
    writeFileSync(file, text);
    const measured = identify();
    assert.deepEqual(saved.errors, measured.errors);
    await page.click('#tab-measure [data-test="identify"]');
    await page.waitForSelector('#tab-identify [data-test="verdict"]');
    const values = await table(page, "values");
    const [first] = saved.errors;
    assert.deepEqual(values[0].slice(0, 2), [first.name, shown(first.value_um ?? first.value_urad, 3)]);
    assert.deepEqual(complaints, []);
  } finally {
    await context.close();
    await own.stop();
    rmSync(folder, { recursive: true });
  }
});

test("a virtual machine: figures and readings of the command line, put into the sheet", async () => {
  const { page, context, complaints } = await open(browser, server.address, { dark: true, width: 1280, height: 720 });
  await page.goto(address(server.address, `measure?campaign=${campaign}&seed=7`));
  await page.click('#tab-measure [data-test="virtual"]');
  await page.waitForSelector('#tab-measure [data-test="put"]');
  const document = await cli("measure", campaign, "--seed", "7");
  const text = await page.textContent("#tab-measure .split-right");
  assert.ok(text.includes(document.name));
  const rms = document.channels.map((one) => one.rms_um.toFixed(2));
  for (const one of rms) assert.ok(text.includes(one), one);
  const { text: file } = await downloaded(page, () => page.getByRole("button", { name: "Download probe.csv" }).click());
  assert.equal(file, readings(campaign, "probe.csv", "--seed", "7"));
  await page.click('#tab-measure [data-test="put"]');
  await page.waitForFunction(
    (n) => document.querySelector('#tab-measure [data-test="done"]')?.textContent === `${n} of ${n} readings`,
    document.readings,
  );
  await picture(page, "measure-dark");
  assert.deepEqual(complaints, []);
  await context.close();
});

test("a touch probe reads the axes; feeds go with the readings; each instrument has a sheet", async () => {
  const { page, context, complaints } = await open(browser, server.address);
  const heads = () => page.$$eval("#tab-measure .readings-sheet thead th", (all) => all.map((one) => one.textContent));
  // The poses of the plan are chosen among candidates; the probe triggers where X, Y and Z stand then.
  await page.goto(address(server.address, "measure?campaign=examples/04_plan/touch-probe-5-minutes.toml"));
  await page.waitForSelector('#tab-measure [data-test="done"]', { timeout: 60_000 });
  assert.deepEqual(await heads(), ["No.", "C", "A", "X", "Y", "Z"]);
  assert.equal(await page.locator('#tab-measure [data-row="0"] input').count(), 3);
  // What the virtual machine reads fits into the sheet, with its feeds.
  await page.goto(address(server.address, "measure?campaign=examples/05_identify/probe-ball-two-feeds.toml"));
  await page.locator("#tab-measure .readings-sheet th", { hasText: "feed, mm/min" }).waitFor();
  await page.click('#tab-measure [data-test="virtual"]');
  await page.click('#tab-measure [data-test="put"]');
  const said = page.locator(".status-note", { hasText: "rows" });
  await said.waitFor();
  assert.doesNotMatch(await said.textContent(), /not used/);
  page.on("dialog", (dialog) => dialog.accept());
  await page.click('#tab-measure [data-test="clear"]');
  // Every run of a laser repeats its targets; another instrument has another sheet, and a reload keeps it.
  const lasers = "examples/07_verify/laser-before-after-x.toml";
  await page.goto(address(server.address, `measure?campaign=${lasers}`));
  await page.waitForSelector('#tab-measure [data-test="instrument"]');
  await page.click('#tab-measure [data-test="virtual"]');
  await page.click('#tab-measure [data-test="put"]');
  await page.waitForSelector('#tab-measure [data-sheet="repeats"]');
  const [row] = await table(page, "repeats");
  // 11 targets from two sides, five runs each.
  assert.deepEqual([row[0], row[2]], ["deviation", String(22 * 4)]);
  assert.equal(row[1], shown(pooled(readings(lasers, "laser.csv")), 3));
  await page.selectOption('#tab-measure [data-test="instrument"]', "laser-workpiece");
  await page.waitForFunction(() => location.hash.includes("instrument=laser-workpiece"));
  await page.locator('#tab-measure [data-test="done"]', { hasText: "0 of 110 readings" }).waitFor();
  await page.reload();
  await page.locator('#tab-measure [data-test="done"]', { hasText: "0 of 110 readings" }).waitFor();
  assert.equal(await page.inputValue('#tab-measure [data-test="instrument"]'), "laser-workpiece");
  await picture(page, "measure-lasers");
  assert.deepEqual(complaints, []);
  await context.close();
});

test("a campaign without stations, a missing one, readings of another instrument", async () => {
  const folder = project();
  const text = readFileSync(path.join(folder, campaign), "utf8");
  writeFileSync(path.join(folder, "examples/04_plan/empty.toml"), text.slice(0, text.indexOf("[[path]]")));
  const own = await serve(folder);
  const { page, context, complaints } = await open(browser, own.address);
  try {
    const refused = (words) => page.locator("#tab-measure .refused", { hasText: words }).waitFor();
    await page.goto(address(own.address, "measure?campaign=examples/04_plan/empty.toml"));
    await refused("the campaign has no stations");
    await refused("Open it in Identify");
    await page.goto(address(own.address, "measure?campaign=examples/04_plan/none.toml"));
    await refused("none.toml");
    await page.goto(address(own.address, `measure?campaign=${campaign}`));
    await page.waitForSelector('#tab-measure [data-test="done"]');
    await drop(page, "#tab-measure", "laser.csv", "X,deviation_um\n0,1.5\n");
    await page.locator(".toast", { hasText: "laser.csv has no column x_um, y_um, z_um" }).waitFor();
    assert.deepEqual(complaints, []);
  } finally {
    await context.close();
    await own.stop();
    rmSync(folder, { recursive: true });
  }
});
