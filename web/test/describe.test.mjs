// The Describe tab against the command line: poses, shares of the errors, the picture, and editing that loses nothing.

import assert from "node:assert/strict";
import { cpSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import path from "node:path";
import { test } from "node:test";
import { cli, open, picture, root, serve } from "./served.mjs";
import { browser, server } from "./shared.mjs";

/** A window on an address within the page. */
async function opened(address, hash, options) {
  const made = await open(browser, address, options);
  await made.page.goto(`${address.replace(/\/$/, "")}/#${hash}`);
  return made;
}

/** A number to the digits that the page shows, whatever its unit and minus sign. */
const shown = (text) => Number(text.replace("\u2212", "-").replace(/[^\d.eE+-]/g, ""));
const near = (text, value, digits, what) =>
  assert.ok(Math.abs(shown(text) - value) <= 0.5 * 10 ** -digits + 1e-9, `${what}: shown ${text}, is ${value}`);

/** Does something to the page and waits until the pose that belongs to it is shown. */
async function settled(page, words) {
  const pose = await cli("pose", ...words);
  await page.waitForFunction(
    (rows) =>
      rows.every(([row, values, most]) => {
        const cells = [...document.querySelectorAll(`[data-test="${row}"] td`)].slice(1, 4);
        const shown = cells.map((c) => Number(c.textContent.replace("\u2212", "-").replace(/[^\d.-]/g, "")));
        return shown.length === 3 && shown.every((v, i) => Math.abs(v - values[i]) <= most);
      }),
    [
      ["nominal", pose.nominal.tip_mm, 5.1e-5],
      ["deviation", pose.deviation.tip_um, 0.0501],
    ],
  );
  return pose;
}

async function comparePose(page, pose) {
  const cells = async (row) => (await page.locator(`[data-test="${row}"] td`).allTextContents()).slice(1, 4);
  const rows = [
    ["nominal", pose.nominal.tip_mm, 4],
    ["actual", pose.actual.tip_mm, 4],
    ["deviation", pose.deviation.tip_um, 1],
    ["axis", pose.nominal.axis, 6],
    ["axis-deviation", pose.deviation.axis_urad, 1],
  ];
  for (const [row, values, digits] of rows) {
    const texts = await cells(row);
    values.forEach((value, i) => near(texts[i], value, digits, `${row} ${"XYZ"[i]}`));
  }
  near(await page.locator('[data-test="tip-length"]').textContent(), Math.hypot(...pose.deviation.tip_um), 1, "length");
}

/** Every bar of every direction: its name, its share, and that the greatest one is there. */
async function compareBudget(page, pose) {
  const shares = [
    ...[0, 1, 2].map((i) => [["X", "Y", "Z"][i], (e) => e.tip_um[i]]),
    ["axis", (e) => Math.hypot(...e.axis_urad)],
  ];
  for (const [direction, share] of shares) {
    await page.click(`[data-direction="${direction}"]`);
    const bars = await page.locator(".budget-total").locator("xpath=../..").locator("svg g > title").allTextContents();
    const greatest = pose.budget.reduce((a, b) => (Math.abs(share(b)) > Math.abs(share(a)) ? b : a));
    if (Math.abs(share(greatest)) > 0.1) assert.equal(bars[0]?.split(": ")[0], greatest.error, direction);
    for (const bar of bars) {
      const [name, text] = bar.split(": ");
      const entry = pose.budget.find((e) => e.error === name);
      assert.ok(entry, `${name} is in the budget`);
      near(text, share(entry), 1, `${name} in ${direction}`);
    }
  }
}

/** The scene graph against the command line: nominal bodies, and the ghost at ×1. */
async function compareScene(page, bodies) {
  await page.locator(".exaggeration").fill("0");
  await page.waitForFunction(() => document.querySelector(".factor").textContent === "×1");
  for (const { body, nominal, actual } of bodies) {
    for (const [which, pose] of [
      ["nominal", nominal],
      ["ghost", actual],
    ]) {
      const is = await page.evaluate(([b, w]) => window.trueaxisScene.poseOf(b, w), [body, which]);
      const due = [...pose.rotation.flat(), ...pose.origin_mm];
      due.forEach((value, i) => {
        const most = i < 9 ? 1e-9 : 1e-6;
        assert.ok(Math.abs(is[i] - value) <= most, `${body} ${which} [${i}]: drawn ${is[i]}, is ${value}`);
      });
    }
  }
  await page.locator(".exaggeration").fill("64");
}

async function typePosition(page, axis, value) {
  await page.fill(`[data-position="${axis}"]`, String(value));
  await page.press(`[data-position="${axis}"]`, "Enter");
}

test("positions, deviations, shares and the picture are those of the command line", async () => {
  const machines = [
    ["machines/xkas2525/machine.toml", { X: 3000, Y: 1200, Z: -700, C: -90, A: 15 }],
    ["machines/i5-engraver/machine.toml", { C: 33.5, A: -40, X: 120, Y: -60.25, Z: 50 }],
  ];
  for (const dark of [false, true]) {
    const [machine, at] = machines[dark ? 1 : 0];
    const { page, context, complaints } = await open(browser, server.address, { dark });
    await page.click(`[data-example="${machine}"]`);
    await page.waitForSelector('[data-test="deviation"]');
    for (const [axis, value] of Object.entries(at)) await typePosition(page, axis, value);
    // The last one by its slider: the arrow keys move it by its step.
    const slider = page.locator(`[data-axis="X"]`);
    await slider.focus();
    await slider.press("ArrowRight");
    at.X = Number(await page.inputValue('[data-position="X"]'));
    assert.notEqual(at.X, machines[dark ? 1 : 0][1].X + 1e-9);
    const words = [
      machine,
      "--at",
      Object.entries(at)
        .map(([a, v]) => `${a}=${v}`)
        .join(" "),
    ];
    const pose = await settled(page, words);
    await comparePose(page, pose);
    await compareBudget(page, pose);
    await compareScene(page, (await cli("pose", ...words, "--bodies")).bodies);
    await page.click('[data-direction="X"]');
    if (!dark) await page.click('[data-page="errors"]');
    await picture(page, dark ? "describe-dark" : "describe");
    assert.deepEqual(complaints, []);
    await context.close();
  }
});

test("a longer tool and warm sensors count as on the command line", async () => {
  const machine = "machines/gantry-001/machine.toml";
  const { page, context, complaints } = await opened(server.address, `describe?machine=${machine}&at=X=3500,Y=900`);
  await page.waitForSelector('[data-test="deviation"]');
  assert.equal(await page.inputValue('[data-position="X"]'), "3500");
  const degrees = { scale_x: 30.5, scale_y: 29, workpiece: 30.5 };
  for (const [sensor, celsius] of Object.entries(degrees)) {
    await page.fill(`[data-sensor="${sensor}"]`, String(celsius));
    await page.press(`[data-sensor="${sensor}"]`, "Enter");
  }
  await page.fill('[data-test="tool-length"]', "250");
  await page.press('[data-test="tool-length"]', "Enter");
  const temperature = Object.entries(degrees)
    .map(([s, c]) => `${s}=${c}`)
    .join(" ");
  const pose = await settled(page, [
    machine,
    "--at",
    "X=3500 Y=900",
    "--tool-length",
    "250",
    "--temperature",
    temperature,
  ]);
  await page.waitForFunction(() =>
    document.querySelector('[data-test="nominal"]').textContent.includes("\u221250.0000"),
  );
  await comparePose(page, pose);
  await compareBudget(page, pose);
  assert.deepEqual(complaints, []);
  await context.close();
});

// ---- editing, in a copy ------------------------------------------------------------------------------

/** A folder with one machine, its server and a window on it. */
async function copied(run) {
  const folder = mkdtempSync(path.join(tmpdir(), "trueaxis-describe-"));
  const file = path.join(folder, "machine.toml");
  cpSync(path.join(root, "machines/i5-engraver/machine.toml"), file);
  const own = await serve(folder);
  const window = async () => {
    const made = await opened(own.address, "describe?machine=machine.toml");
    await made.page.waitForSelector('[data-test="deviation"]');
    await made.page.click('[data-page="errors"]');
    return made;
  };
  try {
    await run({ file, window, text: () => readFileSync(file, "utf8") });
  } finally {
    await own.stop();
    rmSync(folder, { recursive: true });
  }
}

const state = (page) => page.locator('[data-test="edit-state"]');

async function setError(page, error, value) {
  await page.fill(`[data-error="${error}"]`, value);
  await page.press(`[data-error="${error}"]`, "Enter");
}

const says = (page, text) =>
  page.waitForFunction((t) => document.querySelector('[data-test="edit-state"]').textContent === t, text);

test("an error is edited in place, refused with its reason, undone, saved with all comments", () =>
  copied(async ({ file, window, text }) => {
    const { page, context, complaints } = await window();
    const old = text();

    await setError(page, "EC0Y", "12 um");
    const problem = page.locator("#problem-EC0Y");
    await problem.waitFor({ state: "visible" });
    assert.match(await problem.textContent(), /EC0Y.*(unit|angle)/);
    assert.equal(await page.getAttribute('[data-error="EC0Y"]', "aria-invalid"), "true");
    await page.keyboard.press("Control+s");
    await page.locator(".toast", { hasText: "EC0Y" }).waitFor();
    assert.equal(text(), old);
    await page.click(".toast-close");
    await page.press('[data-error="EC0Y"]', "Escape");
    assert.equal(await page.inputValue('[data-error="EC0Y"]'), "18 urad");

    const before = await page.locator('[data-test="tip-length"]').textContent();
    await setError(page, "EC0Y", "120 ± 2 urad");
    await says(page, "changed, not saved");
    await setError(page, "EX0C", "-80 um");
    await page.waitForFunction((b) => document.querySelector('[data-test="tip-length"]').textContent !== b, before);
    assert.equal(text(), old, "nothing is saved yet");
    assert.match(await page.locator('[data-row="EC0Y"] .error-value').textContent(), /^120\.0\sµrad$/);
    assert.match(await page.locator('[data-row="EC0Y"] .error-u').textContent(), /^2\.0\sµrad$/);

    // Back to the text of the file, and forth again.
    for (let i = 0; i < 2; i++) await page.keyboard.press("Control+z");
    await says(page, "saved");
    await page.click('[data-page="file"]');
    assert.equal(await page.inputValue(".file-text"), old);
    for (let i = 0; i < 2; i++) await page.click('button:text("Redo")');
    await says(page, "changed, not saved");
    await page.keyboard.press("Control+s");
    await says(page, "saved");
    const due = old.replace('EC0Y = "18 urad"', 'EC0Y = "120 ± 2 urad"').replace('EX0C = "-12 um"', 'EX0C = "-80 um"');
    assert.equal(text(), due, "all else of the file is as it was");

    await page.click('[data-page="machine"]');
    await comparePose(page, await settled(page, [file, "--at", ""]));
    assert.deepEqual(complaints, []);
    await context.close();
  }));

test("the text of the file is edited with its mistakes by line", () =>
  copied(async ({ window, text }) => {
    const { page, context, complaints } = await window();
    const old = text();
    await page.click('[data-page="file"]');
    await page.fill(".file-text", old.replace('EC0Y = "18 urad"', 'EC0Y = "18 um"'));
    const line = 1 + old.slice(0, old.indexOf("EC0Y =")).split("\n").length - 1;
    await page.locator(".line-link", { hasText: `line ${line}` }).waitFor();
    await says(page, "changed, cannot be used yet");
    await page.fill(".file-text", old.replace('EC0Y = "18 urad"', 'EC0Y = "19 urad" # by hand'));
    await says(page, "changed, not saved");
    await page.click('[data-page="errors"]');
    await page.waitForFunction(() => document.querySelector('[data-error="EC0Y"]').value === "19 urad");

    // An error that was not stated gets an entry, an empty field takes it out again.
    await page.keyboard.press("Control+z");
    await says(page, "changed, cannot be used yet");
    await page.keyboard.press("Control+z");
    await says(page, "saved");
    await page.check('.errors-tools input[type="checkbox"]');
    await setError(page, "EX0X", "4 ± 0.5 um");
    await page.waitForFunction(() =>
      document.querySelector('[data-row="EX0X"] .error-value').textContent.startsWith("4.0"),
    );
    await says(page, "changed, not saved");

    // Leaving now asks.
    const asked = page.waitForEvent("dialog");
    await page.close({ runBeforeUnload: true });
    const dialog = await asked;
    assert.equal(dialog.type(), "beforeunload");
    await dialog.dismiss();
    await setError(page, "EX0X", "");
    await says(page, "saved");
    assert.equal(text(), old);
    assert.deepEqual(complaints, []);
    await context.close();
  }));

test("a body is drawn from its STL file", () =>
  copied(async ({ file, window, text }) => {
    const corners = ["0 0 0", "100 0 0", "0 50 0", "0 0 20"];
    const facet = (list) =>
      `facet normal 0 0 0 outer loop ${list.map((i) => `vertex ${corners[i]}`).join(" ")} endloop endfacet`;
    const facets = [
      [0, 2, 1],
      [0, 1, 3],
      [1, 2, 3],
      [2, 0, 3],
    ].map(facet);
    writeFileSync(file.replace("machine.toml", "ram.stl"), `solid ram\n${facets.join("\n")}\nendsolid ram\n`);
    const [before_models] = text().split("[[model]]");
    writeFileSync(
      file,
      `${before_models}[[model]]\nbody = "Z"\nname = "ram"\nstl = "ram.stl"\nunit = "mm"\nplacement = "1 2 3 mm"\n`,
    );
    const { page, context, complaints } = await window();
    const box = await page.evaluate(() => window.trueaxisScene.boxOf("Z"));
    [1, 2, 3, 101, 52, 23].forEach((value, i) => assert.ok(Math.abs(box[i] - value) < 1e-4, `${box}`));
    await page.click('[data-page="machine"]');
    const pose = await settled(page, [file, "--at", "", "--bodies"]);
    await compareScene(page, pose.bodies);
    assert.deepEqual(complaints, []);
    await context.close();
  }));

test("two windows never overwrite each other in silence", () =>
  copied(async ({ file, window, text }) => {
    const [one, two] = [await window(), await window()];
    await setError(one.page, "EC0Y", "30 urad");
    await setError(two.page, "EA0Z", "40 urad");
    for (const { page } of [one, two]) await says(page, "changed, not saved");
    await one.page.keyboard.press("Control+s");
    await says(one.page, "saved");
    const theirs = text();
    assert.match(theirs, /EC0Y = "30 urad"/);

    // The other window is informed, its edits stay; to save all the same is refused.
    const banner = two.page.locator(".banner");
    await banner.waitFor({ state: "visible" });
    await two.page.click('[data-test="keep"]');
    await two.page.keyboard.press("Control+s");
    await banner.waitFor({ state: "visible" });
    assert.equal(text(), theirs, "nothing was overwritten");
    assert.equal(await two.page.inputValue('[data-error="EA0Z"]'), "40 urad");
    await picture(two.page, "describe-conflict");

    await two.page.click('[data-test="other-name"]');
    await two.page.click(".banner button.primary");
    await two.page.waitForFunction(() => location.hash.includes("machine-2.toml"));
    const mine = readFileSync(file.replace(".toml", "-2.toml"), "utf8");
    assert.match(mine, /EA0Z = "40 urad"/);
    assert.equal(text(), theirs);

    // A window without edits follows; one that takes theirs can still go back to its own.
    await two.page.selectOption(".machine-file", "machine.toml");
    await two.page.waitForFunction(() => document.querySelector('[data-error="EC0Y"]').value === "30 urad");
    await setError(one.page, "EC0Y", "31 urad");
    await says(one.page, "changed, not saved");
    await one.page.keyboard.press("Control+s");
    await two.page.waitForFunction(() => document.querySelector('[data-error="EC0Y"]').value === "31 urad");
    assert.equal(await state(two.page).textContent(), "saved");
    await setError(two.page, "EB0Z", "5 urad");
    await says(two.page, "changed, not saved");
    await setError(one.page, "EC0Y", "32 urad");
    await says(one.page, "changed, not saved");
    await one.page.keyboard.press("Control+s");
    await banner.waitFor({ state: "visible" });
    await two.page.click('[data-test="theirs"]');
    await two.page.waitForFunction(() => document.querySelector('[data-error="EC0Y"]').value === "32 urad");
    await two.page.click('button:text("Undo")');
    await two.page.waitForFunction(() => document.querySelector('[data-error="EB0Z"]').value === "5 urad");

    assert.equal(await one.page.locator(".banner").isVisible(), false, "the window that saved is not informed");
    for (const { context, complaints } of [one, two]) {
      // A refused save is no complaint of the console.
      assert.deepEqual(complaints, []);
      await context.close();
    }
  }));

test("bodies in the picture: picked, hidden, cut, measured", async () => {
  const { page, context, complaints } = await opened(
    server.address,
    "describe?machine=machines/lei-hsu-mill/machine.toml",
  );
  await page.waitForFunction(
    () => (window.trueaxisScene?.boxOf("w")?.length ?? 0) === 6 && window.trueaxisScene.frames() > 0,
  );
  const box = await page.evaluate(() => window.trueaxisScene.boxOf("w"));
  const [x0, y0, , x1, , z1] = box;
  /** A place of the page where a point of the workpiece is seen, a little towards the middle of its face. */
  const seenAt = (x) =>
    page.evaluate(
      ([at, middle]) => {
        const [px, py] = window.trueaxisScene.pixelOf("w", at);
        const [mx, my] = window.trueaxisScene.pixelOf("w", middle);
        const length = Math.hypot(mx - px, my - py);
        return [px + (4 * (mx - px)) / length, py + (4 * (my - py)) / length];
      },
      [
        [x, y0, z1],
        [(x0 + x1) / 2, (y0 + box[4]) / 2, z1],
      ],
    );
  await page.click("#tab-describe .scene-panel summary");
  // The length of an edge of the workpiece, corner to corner; the tool stands before one of them.
  await page.selectOption('#tab-describe [data-body="t"]', "hidden");
  await page.click('#tab-describe [data-test="measure-distance"]');
  for (const x of [x0, x1]) await page.mouse.click(...(await seenAt(x)));
  const distance = await page.textContent('#tab-describe [data-test="distance"]');
  await picture(page, "describe-distance");
  near(distance.split("mm")[0], x1 - x0, 3, "edge of the workpiece");
  await page.click('#tab-describe [data-test="measure-distance"]');
  // A turn of the picture is no press.
  const [px, py] = await page.evaluate((at) => window.trueaxisScene.pixelOf("w", at), [0, y0, z1 - 60]);
  const before = await page.evaluate(() => location.hash);
  assert.ok(!/page=errors/.test(before), before);
  await page.mouse.click(px, py);
  await page.waitForFunction(() => document.querySelector('#tab-describe [aria-label="Errors of"]').value === "w");
  assert.ok(await page.isVisible("#tab-describe .errors-panel"));
  // Hidden, it is not met: what stands behind it is.
  await page.selectOption('#tab-describe [data-body="w"]', "hidden");
  await page.mouse.click(px, py);
  await page.waitForFunction(() => document.querySelector('#tab-describe [aria-label="Errors of"]').value === "C");
  await page.selectOption('#tab-describe [data-body="w"]', "glass");
  await page.mouse.click(px, py);
  await page.waitForFunction(() => document.querySelector('#tab-describe [aria-label="Errors of"]').value === "w");
  // Cut away, it is not met either.
  await page.selectOption('#tab-describe [data-test="section"]', "Y");
  await page.fill('#tab-describe [aria-label="Place of the section"]', "999");
  await page.selectOption('#tab-describe [aria-label="Errors of"]', "");
  await page.mouse.click(px, py);
  assert.equal(await page.inputValue('#tab-describe [aria-label="Errors of"]'), "");
  await page.selectOption('#tab-describe [data-test="section"]', "");
  await page.selectOption('#tab-describe [data-test="section"]', "X");
  await page.fill('#tab-describe [aria-label="Place of the section"]', "500");
  await picture(page, "describe-section");
  // A saved view: camera, section and looks; it is there after a reload, and not for another machine.
  const tools = (rest) => `#tab-describe .scene-panel ${rest}`;
  await page.click('#tab-describe [aria-label^="Z: look along Z"]');
  await page.waitForFunction(() => /view=z/.test(location.hash));
  await page.fill(tools('[aria-label="Name of the view"]'), "table from above");
  await page.click(tools('button[type="submit"]'));
  await page.click('#tab-describe [aria-label^="Iso"]');
  await page.waitForFunction(() => !/view=z/.test(location.hash));
  await page.selectOption(tools('[data-body="w"]'), "solid");
  await page.selectOption(tools('[data-test="section"]'), "");
  await page.reload();
  await page.waitForSelector("#tab-describe .scene-note.actual");
  await page.click(tools("summary"));
  await page.selectOption(tools('[data-test="saved-views"]'), "table from above");
  await page.waitForFunction(() => /view=z/.test(location.hash));
  assert.equal(await page.inputValue(tools('[data-body="w"]')), "glass");
  assert.equal(await page.inputValue(tools('[data-test="section"]')), "X");
  await page.selectOption('#tab-describe [aria-label="Machine file"]', "machines/xkas2525/machine.toml");
  await page.waitForFunction(() => document.querySelector('#tab-describe [data-test="saved-views"]').disabled);
  assert.deepEqual(complaints, []);
  await context.close();
});
