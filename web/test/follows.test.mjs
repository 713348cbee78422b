// What is shown follows its files, and a server that was started again.

import assert from "node:assert/strict";
import { cpSync, mkdirSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import os from "node:os";
import path from "node:path";
import { test } from "node:test";
import { cli, open, root, serve } from "./served.mjs";
import { browser, server } from "./shared.mjs";

const mill = "machines/three-axis-mill/machine.toml";
const clock = (s) => `${Math.floor(s / 60)}:${(s - 60 * Math.floor(s / 60)).toFixed(1).padStart(4, "0")}`;
const shown = (page, key) => page.locator(`[data-test="${key}"]`).textContent();
const begins = (page, key, text) =>
  page.waitForFunction(
    ([name, words]) => document.querySelector(`[data-test="${name}"]`)?.textContent.startsWith(words),
    [key, text],
  );

/** A folder of its own with these files of the project, and a server on it while RUN runs. */
async function inFolder(files, run, options) {
  const folder = mkdtempSync(path.join(os.tmpdir(), "trueaxis-follows-"));
  for (const file of files) {
    mkdirSync(path.dirname(path.join(folder, file)), { recursive: true });
    cpSync(path.join(root, file), path.join(folder, file), { recursive: true });
  }
  const own = await serve(folder, options);
  try {
    await run(own, folder);
  } finally {
    await own.stop();
    rmSync(folder, { recursive: true, force: true });
  }
}

/** Changes the text of a file. */
function edit(file, from, to) {
  const before = readFileSync(file, "utf8");
  const after = before.replace(from, to);
  assert.notEqual(after, before, `${file} has no ${from}`);
  writeFileSync(file, after);
}

test("Simulate follows the set-up that comes beside its program, and the machine", () =>
  inFolder([path.dirname(mill)], async (own, folder) => {
    const program = path.join(folder, "part.nc");
    writeFileSync(program, "G21 G90 G94\nT1 M6\nG1 X100. F900\nG1 X20.\nM30\n");
    const asked = () => cli("simulate", path.join(folder, mill), program, "--control", "fanuc", "--no-report");
    const { page, complaints, context } = await open(browser, own.address);
    await page.goto(`${own.address}#simulate?machine=${mill}&program=part.nc&control=fanuc`);
    await begins(page, "time", clock((await asked()).time_s));
    const before = await shown(page, "verdict");
    // It was looked for in vain.
    writeFileSync(
      path.join(folder, "part.setup.toml"),
      'control = "fanuc"\n[work_offset.G54]\nX = "300 mm"\nY = "200 mm"\nZ = "100 mm"\n[tool.1]\nlength = "80 mm"\n',
    );
    await page.waitForFunction((words) => {
      const verdict = document.querySelector('[data-test="verdict"]')?.textContent;
      return verdict && verdict !== words;
    }, before);
    const fast = await asked();
    edit(path.join(folder, mill), /max_velocity = "[^"]*"/g, 'max_velocity = "5 mm/s"');
    const slow = await asked();
    assert.ok(slow.time_s > fast.time_s + 1, `${slow.time_s} s after ${fast.time_s} s`);
    await begins(page, "time", clock(slow.time_s));
    assert.deepEqual(complaints, []);
    await context.close();
  }));

test("a tab that is not shown asks again when it is shown", () =>
  inFolder([path.dirname(mill)], async (own, folder) => {
    const program = path.join(folder, "part.nc");
    writeFileSync(program, "G21 G90 G94\nG1 X100. F900\nM30\n");
    const { page, complaints, context } = await open(browser, own.address);
    await page.goto(`${own.address}#simulate?machine=${mill}&program=part.nc&control=fanuc`);
    const asked = () => cli("simulate", path.join(folder, mill), program, "--control", "fanuc", "--no-report");
    await begins(page, "time", clock((await asked()).time_s));
    await page.click('.tab-link[data-tab="start"]');
    writeFileSync(program, "G21 G90 G94\nG1 X300. F900\nM30\n");
    await page.waitForTimeout(2000);
    await page.click('.tab-link[data-tab="simulate"]');
    await begins(page, "time", clock((await asked()).time_s));
    assert.deepEqual(complaints, []);
    await context.close();
  }));

const study = "examples/03_predict/cone-on-i5.toml";

test("a report of before a restart is made again, and is never that of another window", async (t) => {
  if (process.env.ADDRESS) return t.skip("the page that is being written has a server of its own");
  const files = [study, "examples/03_predict/torque-arm.toml", "machines", "testpieces"];
  const port = String(20_000 + (process.pid % 20_000));
  const options = ["--no-token", "--port", port];
  await inFolder(
    files,
    async (first, folder) => {
      const { page, context } = await open(browser, first.address);
      await page.goto(`${first.address}#report?verb=predict&file=${study}`);
      const heading = page.frameLocator("iframe.report-frame").locator("h1");
      const own = await heading.first().textContent();
      const link = await page.getAttribute("iframe.report-frame", "src");
      await first.stop();
      await page.waitForSelector('.status-link[data-state="lost"]');
      const second = await serve(folder, options);
      try {
        const other = await open(browser, second.address);
        await other.page.goto(`${second.address}#report?verb=predict&file=${files[1]}`);
        const theirs = await other.page.frameLocator("iframe.report-frame").locator("h1").first().textContent();
        assert.notEqual(theirs, own);
        // What the old tab names is gone, not the report of the new one.
        const gone = await fetch(new URL(link, second.address));
        assert.deepEqual([gone.status, (await gone.json()).error.code], [404, "no-report"]);
        await page.waitForFunction(
          (before) => document.querySelector("iframe.report-frame")?.getAttribute("src") !== before,
          link,
        );
        assert.equal(await heading.first().textContent(), own);
        await other.context.close();
      } finally {
        await second.stop();
      }
      await context.close();
    },
    options,
  );
});

test("a restart with another token: the page says to open the new link, a tab that cannot be loaded says so", async (t) => {
  if (process.env.ADDRESS) return t.skip("the page that is being written is served without a token");
  const port = String(40_000 + (process.pid % 20_000));
  const folder = mkdtempSync(path.join(os.tmpdir(), "trueaxis-token-"));
  const first = await serve(folder, ["--port", port]);
  const { page, context } = await open(browser, first.address);
  await page.waitForSelector('.status-link[data-state="open"]');
  await first.stop();
  const second = await serve(folder, ["--port", port]);
  try {
    await page.waitForSelector('.status-link[data-state="strange"]');
    assert.match(await page.locator(".status-link").textContent(), /open the new link that it printed/);
    await page.click('.tab-link[data-tab="predict"]');
    const refused = page.locator(".tab-predict .refused");
    assert.match(await refused.textContent(), /Predict could not be loaded.*open the new link/);
    assert.equal(await page.locator(".tab-start").isVisible(), false);
    assert.equal(await page.locator(".toasts").textContent(), "");
    // The new link in another tab of the browser: the old one goes on.
    const other = await context.newPage();
    await other.goto(second.address);
    await page.waitForSelector('.status-link[data-state="open"]');
    await context.close();
  } finally {
    await second.stop();
    rmSync(folder, { recursive: true, force: true });
  }
});

test("Standards: back, before the answer has come, leads back", async () => {
  const [first, second] = ["x-axis-laser", "circle-xy"].map((name) => `examples/07_verify/${name}.csv`);
  const { page, complaints, context } = await open(browser, server.address);
  await page.goto(`${server.address}#standards?path=${first}`);
  const heading = page.locator(".tab-standards .result h1");
  const own = await heading.textContent();
  for (const wait_ms of [0, 5, 30]) {
    await page.selectOption(".tab-standards .file-select", second);
    await page.waitForTimeout(wait_ms);
    await page.goBack();
    await page.waitForTimeout(2000);
    assert.equal(await heading.textContent(), own, `${wait_ms} ms`);
    assert.equal(await page.locator(".tab-standards .file-select").first().inputValue(), first);
  }
  await page.selectOption(".tab-standards .file-select", second);
  await page.waitForFunction((words) => {
    const now = document.querySelector(".tab-standards .result h1")?.textContent;
    return now && now !== words;
  }, own);
  assert.deepEqual(complaints, []);
  await context.close();
});

test("a dropped program has no set-up, control or switch of the one before; every control can be chosen", async () => {
  const { page, complaints, context } = await open(browser, server.address);
  const program = "examples/02_simulate/square-g41.nc";
  const choice = (key) => page.locator(`[data-choice="${key}"]`).inputValue();
  const setup = program.replace(/nc$/, "setup.toml");
  await page.goto(
    `${server.address}#simulate?machine=${mill}&program=${program}&setup=${setup}&control=fanuc&optional=OFF`,
  );
  await page.waitForSelector(".tab-simulate.simulated");
  assert.deepEqual([await choice("setup"), await choice("control"), await choice("optional")], [setup, "fanuc", "off"]);
  const file = { name: "dropped.nc", mimeType: "text/plain", buffer: Buffer.from("G21 G90 G94\nG1 X5. F800\nM30\n") };
  await page.setInputFiles(".simulate-choices .drop-input", file);
  await page.waitForFunction(() => location.hash.includes("dropped=dropped.nc"));
  await page.waitForSelector('[data-choice="program"] option:checked:text-matches("dropped")', { state: "attached" });
  assert.deepEqual([await choice("setup"), await choice("control"), await choice("optional")], ["", "", ""]);
  assert.doesNotMatch(page.url(), /setup=|control=|optional=/);
  // What the command reads is what can be chosen, in every tab.
  const refused = await cli("simulate", mill, program, "--control", "none").catch((error) => JSON.parse(error.stdout));
  const known = refused.diagnostics[0].hint.split(/, | or /);
  const values = (where) => page.locator(`${where} option`).evaluateAll((all) => all.map((one) => one.value));
  assert.deepEqual((await values('[data-choice="control"]')).filter(Boolean), known);
  await page.goto(`${server.address}#plan?campaign=examples/04_plan/probe-ball.toml`);
  await page.waitForSelector('[data-test="dialect"]');
  assert.deepEqual(await values('[data-test="dialect"]'), known);
  assert.deepEqual(complaints, []);
  await context.close();
});

test("Simulate and Predict on a phone and at 200 %, in German, too", async () => {
  const places = [
    ["simulate", `machine=machines/i5-engraver/machine.toml&program=examples/02_simulate/ring-fanuc.nc`],
    ["predict", `study=${study}`],
  ];
  for (const locale of ["en", "de"]) {
    const { page, context } = await open(browser, server.address, { locale });
    for (const [tab, query] of places) {
      await page.goto(`${server.address}#${tab}?${query}`);
      await page.waitForSelector(tab === "simulate" ? ".tab-simulate.simulated" : ".tab-predict .predict-scene canvas");
      for (const [width, height] of [
        [640, 360],
        [390, 844],
      ]) {
        await page.setViewportSize({ width, height });
        await page.waitForTimeout(200);
        const found = await page.evaluate((name) => {
          const host = document.querySelector(`.tab-${name}`);
          const canvas = host.querySelector("canvas").getBoundingClientRect();
          const out = [...host.querySelectorAll("select, button, input")].filter((one) => {
            const box = one.getBoundingClientRect();
            return one.checkVisibility() && box.width > 0 && (box.right > innerWidth + 1 || box.left < -1);
          });
          const names = out.map((one) => one.ariaLabel || one.textContent);
          return { high: canvas.height, wide: host.scrollWidth - host.clientWidth, out: names };
        }, tab);
        const boxes = await page.locator(`.tab-${tab} .scene-label:visible`).evaluateAll((all) =>
          all.map((one) => {
            const { left, right, top, bottom } = one.getBoundingClientRect();
            return { text: one.textContent, left, right, top, bottom };
          }),
        );
        for (const [i, a] of boxes.entries())
          for (const b of boxes.slice(i + 1)) {
            const apart =
              a.right <= b.left + 1 || b.right <= a.left + 1 || a.bottom <= b.top + 1 || b.bottom <= a.top + 1;
            assert.ok(apart, `${tab}: ${a.text} lies over ${b.text}`);
          }
        assert.ok(found.high >= 200, `${tab} ${locale} ${width}: the picture is ${found.high} px high`);
        assert.deepEqual([found.wide, found.out], [0, []], `${tab} ${locale} ${width}`);
      }
    }
    await context.close();
  }
});
