// What users come for, from a cold start of an empty browser, by clicks and typing alone; the clicks are counted. An own machine with a mistake
// is in start.test.mjs, a laser table in standards.test.mjs.
import assert from "node:assert/strict";
import { cpSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import path from "node:path";
import { test } from "node:test";
import { cli, open, root, serve } from "./served.mjs";
import { browser } from "./shared.mjs";
import { downloaded } from "./measured.mjs";

const MACHINE = "i5/machine.toml";
const LINES = 100_000;

/** A ring that is engraved by a tilted table, in lines of 0.3 mm. */
function* ring(lines) {
  for (let i = 0; i < lines; i++) {
    const angle = (i * 0.3) / 30;
    const [x, y] = [30 * Math.cos(angle), 30 * Math.sin(angle)];
    const z = 14 + 0.5 * Math.sin(7 * angle);
    yield [x.toFixed(4), y.toFixed(4), z.toFixed(4), (90 + (angle * 180) / Math.PI).toFixed(4)];
  }
}

/** Head, line and end of a program of each control. */
const CONTROLS = {
  fanuc: [
    "ring.nc",
    "%\nO1\nG21 G17 G40 G80 G90 G94\nT1 M6\nG54 S18000 M3\nG43.4 H1 Z60.\n",
    ([x, y, z, c]) => `G1 X${x} Y${y} Z${z} A65. C${c} F1500.`,
    "G49\nM30\n%\n",
  ],
  sinumerik: [
    "ring.mpf",
    "G71 G90 G94 G17\nT1 M6\nG54 S18000 M3 D1\nTRAORI\n",
    ([x, y, z, c]) => `G1 X${x} Y${y} Z${z} A=65 C=${c} F1500`,
    "TRAFOOF\nM30\n",
  ],
  heidenhain: [
    "ring.h",
    "BEGIN PGM RING MM\nTOOL CALL 1 Z S18000\nM128\n",
    ([x, y, z, c]) => `L X${sign(x)} Y${sign(y)} Z${sign(z)} A+65 C+${c} F1500`,
    "M129\nM30\nEND PGM RING MM\n",
  ],
  linuxcnc: [
    "ring.ngc",
    "G21 G17 G40 G80 G90 G94\nT1 M6\nG54 S18000 M3\nG43 H1\n",
    ([x, y, z, c]) => `G1 X${x} Y${y} Z${z} A65 C${c} F1500`,
    "M2\n",
  ],
};
const sign = (number) => (number.startsWith("-") ? number : `+${number}`);

/** A project with the engraver and one program. */
function project(control, lines) {
  const folder = mkdtempSync(path.join(tmpdir(), "trueaxis-tasks-"));
  cpSync(path.join(root, "machines/i5-engraver"), path.join(folder, "i5"), { recursive: true });
  const [name, head, line, end] = CONTROLS[control];
  writeFileSync(path.join(folder, name), `${head}${[...ring(lines)].map(line).join("\n")}\n${end}`);
  writeFileSync(
    path.join(folder, name.replace(/\.[^.]*$/, ".setup.toml")),
    `name = "ring"\ncontrol = "${control}"\nworkpiece_at = "G54"\n[work_offset.G54]\nX = "0 mm"\nY = "0 mm"\nZ = "-55 mm"\n` +
      `[tool.1]\nlength = "90 mm"\ndiameter = "3 mm"\n[start]\nZ = "100 mm"\n`,
  );
  return { folder, name };
}

/** A window on a project that counts its clicks. */
async function begin(folder) {
  const own = await serve(folder);
  const window = await open(browser, own.address);
  let clicks = 0;
  const click = async (selector) => {
    clicks++;
    await window.page.click(selector);
  };
  const end = async (most) => {
    assert.ok(clicks <= most, `${clicks} clicks, at most ${most}`);
    assert.deepEqual(window.complaints, []);
    await window.context.close();
    await own.stop();
    rmSync(folder, { recursive: true });
  };
  return { page: window.page, click, end };
}

for (const control of Object.keys(CONTROLS))
  test(`a program of ${LINES} lines for ${control}: its largest deviation, and why`, async () => {
    const { folder, name } = project(control, LINES);
    const { page, click, end } = await begin(folder);
    await click(`a[href*="program=${name}"]`);
    await page.waitForSelector('[data-test="to-largest"]');
    const document = await cli("simulate", path.join(folder, MACHINE), path.join(folder, name));
    assert.ok(document.moves >= LINES, `${document.moves} moves`);
    assert.equal(
      await page.textContent('[data-test="largest"]'),
      `${document.deviation.tip_um.value.toFixed(1)}\u202fµm`,
    );
    await click('[data-test="to-largest"]');
    await click('[data-test="why-here"]');
    await page.waitForSelector(".why-here table");
    // The heading names the block: no table of another one is shown.
    const why = await page.textContent(".why-here");
    assert.ok(why.includes(`Line ${document.deviation.tip_um.line}`), why.slice(0, 80));
    await end(3);
  });

test("a program of 10⁶ lines leaves the page below 150 MB; a place chosen while its source is loading stays", async () => {
  const { folder, name } = project("fanuc", 1_000_000);
  const { page, click, end } = await begin(folder);
  await click(`a[href*="program=${name}"]`);
  const largest = page.locator('[data-test="to-largest"]');
  await largest.waitFor({ timeout: 300_000 });
  const line = (await largest.textContent()).match(/\d+/)[0];
  assert.ok(Number(line) > 1000, line);
  await click('[data-test="to-largest"]');
  const current = page.locator(".source-line[aria-current=true]");
  await current.waitFor();
  assert.equal(await current.getAttribute("id"), `source-line-${line}`);
  // Its block is read out as soon as the source is here.
  await page.waitForFunction(() => /C\d/.test(document.querySelector(`[data-test="block"]`)?.textContent ?? ""));
  const session = await page.context().newCDPSession(page);
  await session.send("HeapProfiler.collectGarbage");
  const heap = await session.send("Runtime.getHeapUsage");
  // Objects, what the browser keeps for the document, and arrays of numbers.
  const megabytes = (heap.usedSize + heap.embedderHeapUsedSize + heap.backingStorageSize) / 1e6;
  assert.ok(megabytes > 30 && megabytes <= 150, `${megabytes} MB`);
  await end(2);
});

test("a program is compensated, downloaded, and simulated again", async () => {
  const { folder, name } = project("fanuc", 2_000);
  const { page, click, end } = await begin(folder);
  const before = await cli("simulate", path.join(folder, MACHINE), path.join(folder, name));
  await click('[data-tab="compensate"]');
  await page.waitForSelector('#tab-compensate [data-test="verdict"]');
  assert.match(await page.textContent('#tab-compensate [data-test="verdict"]'), /^Proved/);
  const saved = await downloaded(page, () => click('#tab-compensate [aria-label^="Download"]'));
  assert.match(saved.text, /BY TRUEAXIS/);
  await click('#tab-compensate [data-test="save"]');
  await page.waitForSelector('#tab-compensate [data-test="simulate"]');
  await click('#tab-compensate [data-test="simulate"]');
  await page.waitForFunction(() =>
    /comp/.test(document.querySelector("#tab-simulate .source-head")?.textContent ?? ""),
  );
  await page.waitForSelector('#tab-simulate [data-test="largest"]');
  const made = decodeURIComponent(await page.evaluate(() => location.hash)).match(/program=([^&]*)/)[1];
  assert.equal(readFileSync(path.join(folder, made), "utf8"), saved.text);
  const after = Number.parseFloat(await page.textContent('#tab-simulate [data-test="largest"]'));
  assert.ok(before.deviation.tip_um.value > 20 && after > 0, `${before.deviation.tip_um.value} ${after}`);
  await end(4);
});

test("two calibrations are compared, and the report of it is saved", async () => {
  const folder = mkdtempSync(path.join(tmpdir(), "trueaxis-tasks-"));
  for (const year of ["2025", "2026"])
    cpSync(path.join(root, "machines/i5-engraver"), path.join(folder, year), { recursive: true });
  const later = path.join(folder, "2026/machine.toml");
  const text = readFileSync(later, "utf8");
  const [line, value] = text.match(/^EC0Y = "(-?[\d.]+)/m);
  writeFileSync(later, text.replace(line, `EC0Y = "${Number(value) + 30}`));
  const { page, click, end } = await begin(folder);
  await click('[data-tab="verify"]');
  await click('#tab-verify [data-what="diff"]');
  await page.selectOption('#tab-verify [data-test="file"]', "2025/machine.toml");
  await page.selectOption('#tab-verify [data-test="new"]', "2026/machine.toml");
  await page.waitForSelector('#tab-verify [data-test="verdict"]');
  const { errors } = await cli("verify", "--diff", path.join(folder, "2025/machine.toml"), later);
  const change = errors.find(({ error }) => error === "EC0Y").change;
  assert.ok(Math.abs(change - 30) < 1e-6, String(change));
  assert.match(await page.textContent("#tab-verify"), /EC0Y/);
  await click("#tab-verify .report-link");
  await page.waitForSelector(".report-frame");
  const pdf = await page.isEnabled('[data-test="save-pdf"]');
  const report = await downloaded(page, () => click(pdf ? '[data-test="save-pdf"]' : 'text="Save HTML"'));
  assert.match(report.name, pdf ? /\.pdf$/ : /\.html$/);
  assert.ok(report.text.startsWith(pdf ? "%PDF-" : "<!"), report.text.slice(0, 20));
  await end(4);
});
