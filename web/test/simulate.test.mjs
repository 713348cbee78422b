// The Simulate tab against `trueaxis simulate` and `trueaxis pose`.

import assert from "node:assert/strict";
import { cpSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import os from "node:os";
import path from "node:path";
import { test } from "node:test";
import { cli, open, picture, root, serve } from "./served.mjs";
import { browser, server } from "./shared.mjs";

const engraver = "machines/i5-engraver/machine.toml";
const gantry = "machines/wyxzcat-gantry/machine.toml";
const impeller = "examples/02_simulate/impeller-840d.mpf";
const ring = "examples/02_simulate/ring-fanuc.nc";
const collision = "examples/02_simulate/collision-fanuc.nc";

const clock = (s) => `${Math.floor(s / 60)}:${(s - 60 * Math.floor(s / 60)).toFixed(1).padStart(4, "0")}`;
const um = (v) => `${v.toFixed(1)}\u202fµm`.replace("-", "\u2212");
const shown = (page, key) => page.locator(`[data-test="${key}"]`).textContent();
const moment = (page) => page.evaluate(() => globalThis.trueaxisScene.moment());
const simulated = (page) =>
  page.waitForSelector(
    '.tab-simulate.simulated .readout-block:not(:empty), .tab-simulate.simulated [data-test="place"]:not(:empty)',
    { state: "attached" },
  );

/** Waits until the page shows this time. */
async function shows(page, time_s) {
  await page.waitForFunction((t) => Math.abs((globalThis.trueaxisScene.moment()?.time_s ?? -1) - t) < 1e-6, time_s);
}

async function example(name, machine) {
  const window = await open(browser, server.address);
  await window.page.click(`[data-example="${name}"]`);
  await simulated(window.page);
  return { ...window, document: await cli("simulate", machine, name, "--no-report") };
}

async function summaryIsThatOf(page, document) {
  assert.ok((await shown(page, "time")).startsWith(clock(document.time_s)), `machining time ${clock(document.time_s)}`);
  assert.equal(await shown(page, "largest"), um(document.deviation.tip_um.value));
}

/**
 * Every body of the picture stands where `trueaxis pose` puts it at the axis positions shown: the
 * solid one nominally, the ghost, at ×1, as the errors have it.
 */
async function posesAreThoseOf(page, machine) {
  const { axes, approach } = await moment(page);
  const at = Object.entries(axes)
    .map(([name, value]) => `${name}=${value}`)
    .join(" ");
  const sides = Object.entries(approach)
    .filter(([, side]) => side !== 0)
    .map(([name, side]) => `${name}=${side > 0 ? "+" : "-"}`)
    .join(" ");
  const { bodies } = await cli("pose", machine, "--at", at, ...(sides ? ["--approach", sides] : []), "--bodies");
  assert.ok(bodies.length > 2);
  await page.locator(".exaggeration").fill("0");
  assert.equal(await page.locator(".factor").textContent(), "×1");
  for (const { body, nominal, actual } of bodies) {
    for (const [which, { rotation, origin_mm }] of [
      ["nominal", nominal],
      ["ghost", actual],
    ]) {
      const drawn = await page.evaluate(([name, of]) => globalThis.trueaxisScene.poseOf(name, of), [body, which]);
      const wanted = [...rotation.flat(), ...origin_mm];
      wanted.forEach((value, i) =>
        assert.ok(Math.abs(value - drawn[i]) < 1e-6, `${which} ${body}[${i}]: ${drawn[i]} instead of ${value}`),
      );
    }
  }
}

test("the impeller: summary, a click on a line, poses", async () => {
  const { page, complaints, context, document } = await example(impeller, gantry);
  await summaryIsThatOf(page, document);
  // Only the lines in sight are in the page.
  await page.locator(".source-scroll").press("PageDown");
  await page.click('.source-line[data-line="15"]');
  await page.waitForSelector('.source-line[data-line="15"][aria-current="true"]');
  assert.match(await shown(page, "block"), /^N130 G1 X24\.9632/);
  await posesAreThoseOf(page, gantry);
  await picture(page, "simulate");
  assert.deepEqual(complaints, []);
  await context.close();
});

test("the bangle: largest deviation, the moment, colours, keys, playing", async () => {
  const { page, complaints, context, document } = await example(ring, engraver);
  await summaryIsThatOf(page, document);
  const worst = document.deviation.tip_um;
  await page.click('[data-test="to-largest"]');
  await shows(page, worst.time_s);
  await page.waitForFunction(
    (text) => document.querySelector('[data-test="dev-length"]').textContent === text,
    worst.value.toFixed(1),
  );
  assert.ok((await shown(page, "place")).startsWith(`line ${worst.line}`));
  await posesAreThoseOf(page, engraver);

  for (const colour of ["feed", "load", "deviation"]) {
    await page.click(`[data-colour="${colour}"]`);
    await page.waitForSelector(`[data-colour="${colour}"][aria-pressed="true"]`);
  }

  await page.locator(".timeline-track").focus();
  const before = await moment(page);
  await page.keyboard.press("ArrowRight");
  await page.waitForFunction((t) => globalThis.trueaxisScene.moment().time_s > t, before.time_s);
  await page.keyboard.press("ArrowLeft");
  await page.keyboard.press("Home");
  await shows(page, 0);
  await page.keyboard.press(" ");
  await page.waitForFunction(() => globalThis.trueaxisScene.moment().time_s > 0.5);
  await page.keyboard.press(" ");
  await page.keyboard.press("End");
  await shows(page, document.time_s);
  assert.equal(await shown(page, "clock"), clock(document.time_s));
  assert.deepEqual(complaints, []);
  await context.close();
});

test("the curves: a click picks the time, a drag looks closer", async () => {
  const { page, complaints, context, document } = await example(ring, engraver);
  const plot = page.locator('.timeplot[data-quantity="tip"] .u-over');
  await plot.waitFor();
  const { width, height } = await plot.boundingBox();
  await plot.click({ position: { x: width / 2, y: height / 2 } });
  await page.waitForFunction(
    (t) => Math.abs(globalThis.trueaxisScene.moment().time_s - t) < 0.05 * t,
    document.time_s / 2,
  );
  await plot.hover({ position: { x: 0.25 * width, y: height / 2 } });
  await page.mouse.down();
  await plot.hover({ position: { x: 0.5 * width, y: height / 2 } });
  await page.mouse.up();
  await page.waitForSelector(".timeline-window:not([hidden])");
  await page.waitForFunction(() => /path from/.test(document.querySelector(".scene-notes").textContent));
  await plot.dblclick();
  await page.waitForSelector(".timeline-window", { state: "hidden" });
  assert.deepEqual(complaints, []);
  await context.close();
});

test("the stock: what was removed, what remains, feed in the air", async () => {
  const { page, complaints, document } = await example(ring, engraver);
  const { stock } = document;
  const cm3 = (v) => `${(v / 1e3).toFixed(2)}\u202fcm³`;
  assert.equal(await shown(page, "removed"), cm3(stock.removed_mm3));
  assert.equal(await shown(page, "remains"), cm3(stock.left_mm3));
  const air = (100 * stock.air_s) / (stock.air_s + stock.cutting_s);
  assert.equal(await shown(page, "air"), `${air.toFixed(0)} %`);
  assert.equal(await page.locator('[data-test="gouged"]').count(), 0);
  await picture(page, "simulate-stock");
  assert.deepEqual(complaints, []);
});

test("the stock as it is at a time: by the address, by the button, and back to what the program leaves", async () => {
  const { page, complaints, document } = await example(ring, engraver);
  const { stock } = document;
  const removed = () => page.textContent('[data-test="stock-removed"]');
  const is = (text) =>
    page.waitForFunction((t) => document.querySelector('[data-test="stock-removed"]').textContent === t, text);
  assert.equal(await removed(), "");
  await page.click('[data-test="stock-in-time"]');
  await is("0.00\u202fcm³ removed");
  await page.locator(".timeline-track").focus();
  await page.keyboard.press("End");
  await is(`${(stock.removed_mm3 / 1e3).toFixed(2)}\u202fcm³ removed`);
  // Half way there is less; the address keeps it.
  const half = await page.evaluate(() => globalThis.trueaxisScene.moment().time_s / 2);
  const address = new URL(await page.evaluate(() => location.href));
  assert.match(address.hash, /stock=now/);
  address.hash = address.hash.replace(/([&?])t=[^&]*/, `$1t=${half.toFixed(3)}`);
  await page.goto("about:blank");
  await page.goto(address.href);
  await page.waitForFunction((most) => {
    const mm3 = 1e3 * Number.parseFloat(document.querySelector('[data-test="stock-removed"]')?.textContent ?? "");
    return mm3 > 0.2 * most && mm3 < 0.8 * most;
  }, stock.removed_mm3);
  await page.click('[data-test="look-at-path"]');
  await picture(page, "simulate-stock-at-a-time");
  await page.click('[data-test="stock-in-time"]');
  await is("");
  assert.deepEqual(complaints, []);
});

test("a collision is a mark that jumps to it", async () => {
  const { page, complaints, context, document } = await example(collision, engraver);
  const issue = document.troubles.find((t) => t.grave);
  assert.match(await shown(page, "verdict"), /collision/);
  await page.click(".timeline-mark.critical");
  await shows(page, issue.from_s);
  await page.waitForSelector(`.source-line[data-line="${issue.line}"][aria-current="true"] .source-mark.error`);
  assert.deepEqual(complaints, []);
  await context.close();
});

test("tool and stock of the set-up are in the picture", async () => {
  const folder = mkdtempSync(path.join(os.tmpdir(), "trueaxis-setup-"));
  cpSync(path.join(root, path.dirname(engraver)), path.join(folder, "machine"), { recursive: true });
  cpSync(path.join(root, collision), path.join(folder, "short.nc"));
  const setup = readFileSync(path.join(root, collision.replace(".nc", ".setup.toml")), "utf8");
  const stock =
    '[stock]\nbox = "70 60 20 mm"\nplacement = "0 0 15 mm"\n\n[[fixture]]\nname = "vice"\nbox = "90 12 20 mm"\nplacement = "0 45 5 mm"\n';
  writeFileSync(path.join(folder, "short.setup.toml"), `${setup}\n${stock}`);
  const own = await serve(folder);
  try {
    const { page, complaints } = await open(browser, own.address);
    await page.goto(`${own.address}#simulate?machine=machine/machine.toml&program=short.nc`);
    await simulated(page);
    const seen = (what, body) => page.evaluate(([key, name]) => globalThis.trueaxisScene[key](name), [what, body]);
    assert.deepEqual(await seen("partsOf", "w"), ["stock", "vice"]);
    // The box of both: x ± 45, y from −30 to 51, z from −5 to 25 mm.
    assert.deepEqual(await seen("boxOf", "w"), [-45, -30, -5, 45, 51, 25]);
    await page.click(".timeline-track");
    // A holder of 32 mm, 90 mm from tip to gauge line; before that moment the machine file's own tool is there.
    await page.waitForFunction(() => {
      const [x, , tip, , , top] = globalThis.trueaxisScene.boxOf("t").map(Math.round);
      return x === -16 && tip === -90 && top === 0;
    });
    assert.ok((await seen("partsOf", "t")).includes("tool holder"));
    assert.deepEqual(complaints, []);
  } finally {
    await own.stop();
    rmSync(folder, { recursive: true, force: true });
  }
});

test("why here: the contributions are those of `trueaxis trace`", async () => {
  const { page, complaints, context, document } = await example(ring, engraver);
  const worst = document.deviation.tip_um;
  await page.click('[data-test="to-largest"]');
  await shows(page, worst.time_s);
  await page.click('[data-test="why-here"]');
  await page.waitForSelector(".why-here table");
  // The command takes the number N of a block.
  const block = readFileSync(path.join(root, ring), "utf8")
    .split("\n")
    [worst.line - 1].match(/^N(\d+)/)[1];
  const { budget, deviation, line } = await cli("trace", engraver, ring, "--block", block);
  assert.equal(line, worst.line);
  const length = (v) => Math.hypot(...v);
  const largest = [...budget].sort((a, b) => length(b.tip_um) - length(a.tip_um))[0];
  const row = await page.locator(".why-here tbody tr").first().locator("th, td").allTextContents();
  const number = (v) => v.toFixed(2).replace("-", "\u2212");
  assert.deepEqual(row.slice(0, 5), [largest.error, ...largest.tip_um.map(number), number(length(largest.tip_um))]);
  assert.ok((await shown(page, "why-deviation")).includes(um(length(deviation.tip_um))));
  await picture(page, "simulate-why");
  assert.deepEqual(complaints, []);
  await context.close();
});

test("a missing set-up is said first and is one form away", async () => {
  const folder = mkdtempSync(path.join(os.tmpdir(), "trueaxis-no-setup-"));
  cpSync(path.join(root, path.dirname(engraver)), path.join(folder, "machine"), { recursive: true });
  writeFileSync(
    path.join(folder, "plate.nc"),
    "G21 G90 G94\nT7 M6\nG54 G0 X0 Y0\nG43 H7 Z30.\nG1 Z5. F500\nG1 X20. F800\nG0 Z30.\nM30\n",
  );
  const own = await serve(folder);
  try {
    const { page, complaints } = await open(browser, own.address);
    await page.goto(`${own.address}#simulate?machine=machine/machine.toml&program=plate.nc&control=fanuc`);
    await simulated(page);
    const machine = path.join(folder, "machine/machine.toml");
    const plate = path.join(folder, "plate.nc");
    const before = await cli("simulate", machine, plate, "--control", "fanuc");
    assert.equal(before.set_up_given, false);
    assert.ok((await shown(page, "verdict")).startsWith(before.verdict.word));
    await page.click('[data-test="no-set-up"] button');
    const length = page.getByLabel("T7 length, mm");
    await length.fill("9o");
    await page.click('[data-test="set-up-save"]');
    assert.match(await shown(page, "set-up-note"), /T7 length, mm: "9o" is not a number/);
    await length.fill("90,5");
    await page.getByLabel("T7 diameter, mm", { exact: true }).fill("6");
    await page.getByLabel("Z at program zero").fill("-100");
    await picture(page, "simulate-set-up");
    await page.click('[data-test="set-up-save"]');
    await page.waitForSelector('[data-test="no-set-up"]', { state: "detached" });
    await simulated(page);
    const file = path.join(folder, "plate.setup.toml");
    assert.match(readFileSync(file, "utf8"), /\[tool\.7\]\nlength = "90\.5 mm"\ndiameter = "6 mm"/);
    const after = await cli("simulate", machine, plate, "--control", "fanuc");
    assert.equal(after.set_up_given, true);
    assert.ok((await shown(page, "verdict")).startsWith(after.verdict.word));
    await summaryIsThatOf(page, after);
    // From then on its text is edited; one that has changed on the disk is not overwritten.
    await page.click('[data-test="edit-set-up"]');
    const text = page.locator(".set-up-dialog textarea");
    assert.match(await text.inputValue(), /90\.5 mm/);
    writeFileSync(file, `${readFileSync(file, "utf8")}# mine\n`);
    await text.fill((await text.inputValue()).replace("90.5", "91"));
    await page.click('[data-test="set-up-save"]');
    await page.waitForFunction(() =>
      /changed elsewhere/.test(document.querySelector(`[data-test="set-up-note"]`).textContent),
    );
    assert.match(readFileSync(file, "utf8"), /90\.5 mm[\s\S]*# mine/);
    assert.deepEqual(complaints, []);
  } finally {
    await own.stop();
    rmSync(folder, { recursive: true, force: true });
  }
});

test("what changes on the disk is seen: the program is simulated again, a new one is listed", async () => {
  const folder = mkdtempSync(path.join(os.tmpdir(), "trueaxis-disk-"));
  cpSync(path.join(root, path.dirname(engraver)), path.join(folder, "machine"), { recursive: true });
  const plate = path.join(folder, "plate.nc");
  const program = (x) => `G21 G90 G94\nG1 X${x}. F800\nM30\n`;
  writeFileSync(plate, program(20));
  const own = await serve(folder);
  try {
    const { page, complaints } = await open(browser, own.address);
    await page.goto(`${own.address}#simulate?machine=machine/machine.toml&program=plate.nc&control=fanuc`);
    await simulated(page);
    const machine = path.join(folder, "machine/machine.toml");
    const before = await cli("simulate", machine, plate, "--control", "fanuc");
    await summaryIsThatOf(page, before);
    writeFileSync(plate, program(90));
    const after = await cli("simulate", machine, plate, "--control", "fanuc");
    assert.ok(after.time_s > before.time_s + 1);
    await page.waitForFunction(
      (text) => document.querySelector('[data-test="time"]')?.textContent.startsWith(text),
      clock(after.time_s),
    );
    writeFileSync(path.join(folder, "other.nc"), program(10));
    await page.waitForSelector('[data-choice="program"] option[value="other.nc"]', { state: "attached" });
    assert.deepEqual(complaints, []);
  } finally {
    await own.stop();
    rmSync(folder, { recursive: true, force: true });
  }
});

/** As if a user dropped the file on the page. */
async function drop(page, name, text) {
  await page.evaluate(
    ([file, words]) => {
      const data = new DataTransfer();
      data.items.add(new File([words], file));
      document
        .querySelector(".tab-simulate")
        .dispatchEvent(new DragEvent("drop", { dataTransfer: data, bubbles: true, cancelable: true }));
    },
    [name, text],
  );
}

test("optional blocks: executed at first, left out by choice, as the command line does", async () => {
  const { page, complaints, context } = await open(browser, server.address);
  await page.goto(`${server.address}#simulate?machine=${engraver}`);
  await page.waitForSelector('[data-choice="program"]');
  const folder = mkdtempSync(path.join(os.tmpdir(), "trueaxis-optional-"));
  const file = path.join(folder, "marked.nc");
  const text = "G21 G90 G94\nG1 X5. F800\n/ G1 Y60.\nG1 X20.\nM30\n";
  writeFileSync(file, text);
  const [all, part] = await Promise.all(
    [[], ["--without-optional"]].map((words) => cli("simulate", engraver, file, "--control", "fanuc", ...words)),
  );
  assert.ok(all.time_s > part.time_s + 1);
  await drop(page, "marked.nc", text);
  await simulated(page);
  await summaryIsThatOf(page, all);
  await page.selectOption('[data-choice="optional"]', "off");
  await page.waitForFunction(
    (words) => document.querySelector('[data-test="time"]')?.textContent.startsWith(words),
    clock(part.time_s),
  );
  await summaryIsThatOf(page, part);
  assert.match(page.url(), /optional=off/);
  rmSync(folder, { recursive: true, force: true });
  assert.deepEqual(complaints, []);
  await context.close();
});

test("a dropped program: its errors underlined, then a good one", async () => {
  const { page, complaints, context } = await open(browser, server.address);
  await page.goto(`${server.address}#simulate?machine=${engraver}`);
  await page.waitForSelector('[data-choice="program"]');
  await drop(page, "wrong.nc", "G21 G90\nG1 X1 Y@ F100\nM30\n");
  const mark = page.locator('.source-line[data-line="2"] .source-mark.error');
  await mark.waitFor();
  assert.equal(await mark.textContent(), "@");
  await mark.focus();
  assert.match(await page.locator(".source-tip").textContent(), /value is missing/);
  assert.match(await shown(page, "verdict"), /one error/);
  await drop(page, "right.nc", "G21 G90 G94\nG1 X1 Y2 F100\nM30\n");
  await simulated(page);
  assert.match(await shown(page, "verdict"), /^(NO ISSUES|SLOWER)/);
  assert.deepEqual(complaints, []);
  await context.close();
});
