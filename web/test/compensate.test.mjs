// Compensate: what the tab shows is what `trueaxis compensate` says; files are those of the command line, byte for byte.
import assert from "node:assert/strict";
import { cpSync, existsSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import path from "node:path";
import { test } from "node:test";
import { cli, open, picture, root, serve } from "./served.mjs";
import { browser, server } from "./shared.mjs";
import { downloaded, exports, shown, table } from "./measured.mjs";

const machine = "machines/xkas2525/machine.toml";
const frustum = "examples/06_compensate/frustum.mpf";
const address = (base, hash) => new URL(`#${hash}`, base).href;

/** The verdict of the tab, once it is there. */
async function verdict(page) {
  await page.waitForSelector('#tab-compensate [data-test="verdict"]', { timeout: 60_000 });
  return page.textContent('#tab-compensate [data-test="verdict"]');
}

/** What the command line makes of the same question, with the files that it writes. */
async function byCommand(...words) {
  const folder = mkdtempSync(path.join(tmpdir(), "trueaxis-compensate-"));
  try {
    const document = await cli("compensate", ...words.map((word) => word.replace("OUT", folder)));
    const name = words[words.indexOf("-o") + 1].replace("OUT", folder);
    const read = (file) => readFileSync(file ? path.join(name, file) : name, "utf8");
    const files = document.files ? document.files.map((file) => path.basename(file)) : [null];
    return { document, texts: Object.fromEntries(files.map((file) => [file ?? path.basename(name), read(file)])) };
  } finally {
    rmSync(folder, { recursive: true });
  }
}

/** A project with the gantry and the frustum. */
function project() {
  const folder = mkdtempSync(path.join(tmpdir(), "trueaxis-compensate-"));
  cpSync(path.join(root, "machines/xkas2525"), path.join(folder, "gantry"), { recursive: true });
  cpSync(path.join(root, frustum), path.join(folder, "part.mpf"));
  return folder;
}

test("a program: verdict, deviations before and after, changed lines, the file", async () => {
  const { page, context, complaints } = await open(browser, server.address);
  await page.click(`.verb[data-verb="compensate"] [data-example="${frustum}"]`);
  const words = await verdict(page);
  const { document, texts } = await byCommand("program", machine, frustum, "-o", "OUT/frustum-comp.mpf");
  assert.equal(document.proved, true);
  assert.ok(words.startsWith("Proved"), words);
  assert.ok(words.includes(`up to ${document.after.tip_at_ends_um.value.toFixed(3)} µm instead of`), words);
  const rows = await table(page, "deviations");
  const { before, after } = document;
  const largest = (key) => [
    shown(before[key].value, 3),
    String(before[key].line),
    shown(after[key].value, 3),
    String(after[key].line),
  ];
  const rms = (key) => [shown(before[key], 3), "–", shown(after[key], 3), "–"];
  assert.deepEqual(
    rows.map((row) => row.slice(2)),
    [
      largest("tip_at_ends_um"),
      rms("tip_at_ends_rms_um"),
      largest("tip_between_um"),
      largest("axis_at_ends_urad"),
      rms("axis_at_ends_rms_urad"),
      largest("axis_between_urad"),
    ],
  );
  // The largest of the curves is that of the table.
  const figure = page.locator("#tab-compensate .figure", { hasText: "Tip, before and after" }).first();
  const { text: csv } = await downloaded(page, () => figure.getByRole("button", { name: "Save as CSV" }).click());
  const numbers = csv.trim().split("\n").slice(1);
  const column = (j) => Math.max(...numbers.map((line) => Number(line.split(",")[j])));
  const most = (of) => Math.max(of.tip_at_ends_um.value, of.tip_between_um.value);
  assert.ok(Math.abs(column(1) - most(before)) < 1e-9 && Math.abs(column(3) - most(after)) < 1e-9);
  // Every changed line is one of the old program and stands in the new one.
  const [was, is] = [readFileSync(path.join(root, frustum), "utf8"), texts["frustum-comp.mpf"]].map((text) =>
    text.split(/\r?\n/),
  );
  const changes = await page.$$eval("#tab-compensate .changes tbody tr", (all) =>
    all.map((row) => [Number(row.cells[0].textContent), row.cells[1].textContent, row.cells[2].textContent]),
  );
  assert.ok(changes.length > 20);
  for (const [line, old, now] of changes) {
    assert.equal(old, was[line - 1]);
    for (const one of now.split("\n")) assert.ok(is.includes(one), one);
  }
  const { name, text } = await downloaded(page, () =>
    page.getByRole("button", { name: "Download frustum-comp.mpf" }).click(),
  );
  assert.equal(name, "frustum-comp.mpf");
  assert.equal(text, texts["frustum-comp.mpf"]);
  await exports(page, "#tab-compensate .pictures");
  await picture(page, "compensate");
  assert.deepEqual(complaints, []);
  await context.close();
});

test("the program is saved in the project and simulated; what is there is not replaced", async () => {
  const folder = project();
  const own = await serve(folder);
  const { page, context, complaints } = await open(browser, own.address);
  try {
    await page.goto(address(own.address, "compensate?of=program&machine=gantry/machine.toml&program=part.mpf"));
    await verdict(page);
    const said = page.locator('#tab-compensate [data-test="saved"]');
    const save = async (name, words) => {
      await page.fill('#tab-compensate [data-test="save-name"]', name);
      await page.click('#tab-compensate [data-test="save"]');
      await said.filter({ hasText: words }).waitFor();
    };
    // The program itself, another kind of file, a file of a person, a place outside.
    const was = readFileSync(path.join(folder, "part.mpf"), "utf8");
    await save("part.mpf", "part.mpf is what it was made from");
    await save("gantry/machine.toml", "has another ending");
    writeFileSync(path.join(folder, "mine.mpf"), "M30\n");
    await save("mine.mpf", "was not written by this program");
    await save("../outside.mpf", "names no file of the project");
    assert.equal(readFileSync(path.join(folder, "part.mpf"), "utf8"), was);
    assert.equal(readFileSync(path.join(folder, "mine.mpf"), "utf8"), "M30\n");
    assert.equal(existsSync(path.join(folder, "../outside.mpf")), false);
    // Twice: it is ours.
    await save("part-comp.mpf", "Saved as part-comp.mpf");
    await save("part-comp.mpf", "Saved as part-comp.mpf");
    assert.match(readFileSync(path.join(folder, "part-comp.mpf"), "utf8"), /BY TRUEAXIS/);
    await page.click('#tab-compensate [data-test="simulate"]');
    await page.waitForFunction(() => location.hash.includes("program=part-comp.mpf"));
    await page.waitForFunction(() =>
      document.querySelector("#tab-simulate .source-head")?.textContent.includes("part-comp"),
    );
    // Back: the answer is still there, and nothing is asked again.
    await page.goBack();
    assert.match(await page.textContent('#tab-compensate [data-test="saved"]'), /Saved as part-comp.mpf/);
    // The machine file is edited on the disk: the page sees it, and makes the program from it anew.
    const file = path.join(folder, "gantry/machine.toml");
    writeFileSync(file, `${readFileSync(file, "utf8")}\n# edited\n`);
    await page.waitForFunction(
      () => !document.querySelector('#tab-compensate [data-test="saved"]')?.textContent.includes("part-comp"),
    );
    await verdict(page);
    await save("later.mpf", "Saved as later.mpf");
    // Its first line names the machine file by its content.
    const first = (name) => readFileSync(path.join(folder, name), "utf8").match(/FILE ([0-9a-f]+)/)[1];
    assert.notEqual(first("later.mpf"), first("part-comp.mpf"));
    // Compensated already: said where the result would stand.
    await page.goto(address(own.address, "compensate?of=program&machine=gantry/machine.toml&program=part-comp.mpf"));
    const refused = await page.waitForSelector("#tab-compensate .refused");
    assert.match(await refused.textContent(), /compensated already/);
    assert.deepEqual(complaints, []);
  } finally {
    await context.close();
    await own.stop();
    rmSync(folder, { recursive: true });
  }
});

test("tables of a control: what is left, what they cannot hold, every file", async () => {
  const { page, context, complaints } = await open(browser, server.address, { dark: true, width: 1280, height: 720 });
  await page.goto(address(server.address, `compensate?of=tables&machine=${machine}&target=heidenhain`));
  await page.waitForSelector('#tab-compensate [data-sheet="left"]', { timeout: 60_000 });
  await page.selectOption('#tab-compensate [data-test="target"]', "sinumerik");
  await page.locator('#tab-compensate [data-made$="AX_EEC.INI"]').waitFor();
  const { document, texts } = await byCommand(
    "tables",
    machine,
    "--target",
    "sinumerik",
    "-o",
    "OUT/xkas2525-sinumerik",
  );
  const rows = await table(page, "left");
  const row = (of) => [shown(of.max, 3), shown(of.rms, 3), shown(of.axis_urad, 3)];
  assert.deepEqual(
    rows.map((cells) => cells.slice(1, 4)),
    [document.before_um, document.left_um, document.left_zero_set_um, document.wrong_sign_um].map(row),
  );
  const cannot = document.cannot.map((one) => [one.error, shown(one.before_um, 3), shown(one.left_um, 3), one.instead]);
  assert.ok(cannot.length > 0);
  assert.deepEqual(await table(page, "cannot"), cannot);
  for (const [name, expected] of Object.entries(texts)) {
    const { text } = await downloaded(page, () => page.getByRole("button", { name: `Download ${name}` }).click());
    assert.equal(text, expected, name);
  }
  await picture(page, "compensate-tables-dark");
  assert.deepEqual(complaints, []);
  await context.close();
});

test("values of an axis with their uncertainty; a warm workpiece needs its temperature", async () => {
  const { page, context, complaints } = await open(browser, server.address);
  const gantry = "machines/gantry-001/machine.toml";
  await page.goto(address(server.address, `compensate?of=values&machine=${gantry}&axis=X&step=350`));
  const refused = await page.waitForSelector("#tab-compensate .refused");
  assert.match(await refused.textContent(), /temperature of the workpiece is not given.*State the temperatures above/s);
  const warm = "scale_x=30.5 workpiece=30.5";
  await page.fill('#tab-compensate [data-test="temperature"]', warm);
  await page.press('#tab-compensate [data-test="temperature"]', "Enter");
  const figure = page.locator("#tab-compensate .figure", { hasText: "Values to be added to X" }).first();
  await figure.waitFor();
  const { text: csv } = await downloaded(page, () => figure.getByRole("button", { name: "Save as CSV" }).click());
  const document = await cli("compensate", "values", gantry, "--axis", "X", "--step", "350", "--temperature", warm);
  const numbers = csv.trim().split("\n").slice(1);
  assert.deepEqual(
    numbers.map((line) => line.split(",").slice(0, 2).map(Number)),
    document.axes[0].positions.map((one) => [one.position_mm, one.value_um]),
  );
  await picture(page, "compensate-values");
  assert.deepEqual(complaints, []);
  await context.close();
});

test("a path on a measured blank: wall, verdict, program", async () => {
  const { page, context, complaints } = await open(browser, server.address);
  const study = "examples/06_compensate/bangle-adapt.toml";
  await page.goto(address(server.address, `compensate?of=blank&study=${study}&control=fanuc`));
  const words = await verdict(page);
  const document = await cli("compensate", "adapt", study);
  assert.equal(document.verdict, "good");
  assert.ok(/good|may be cut/i.test(words), words);
  const text = await page.textContent("#tab-compensate .result");
  assert.ok(text.includes(document.wall.after.min_mm.toFixed(3)));
  assert.equal(await page.locator("#tab-compensate [data-made]").count(), 2);
  await picture(page, "compensate-blank");
  assert.deepEqual(complaints, []);
  await context.close();
});

test("only the last choice is shown; a reload and a return keep it; a wrong file is said", async () => {
  const { page, context, complaints } = await open(browser, server.address);
  const i5 = "machines/i5-engraver/machine.toml";
  const everyday = "examples/06_compensate/everyday-fanuc.nc";
  const title = (words) =>
    page.locator("#tab-compensate .shown-title", { hasText: words }).waitFor({ timeout: 60_000 });
  await page.goto(address(server.address, `compensate?of=program&machine=${machine}&program=${frustum}`));
  // While the first is worked out another machine and program are chosen.
  await page.evaluate((hash) => {
    location.hash = hash;
  }, `#compensate?of=program&machine=${i5}&program=${everyday}`);
  await title("everyday-fanuc.nc compensated for i5");
  await page.waitForTimeout(1500);
  await title("everyday-fanuc.nc compensated for i5");
  // It was unrolled: its lines are other ones.
  assert.match(await page.textContent('#tab-compensate [data-test="new-text"]'), /unrolled.*BY TRUEAXIS/s);
  await picture(page, "compensate-unrolled");
  await page.reload();
  await title("everyday-fanuc.nc compensated for i5");
  await page.evaluate(() => {
    document.querySelector("#tab-compensate .shown-title").dataset.seen = "yes";
  });
  await page.click('.tab-link[data-tab="describe"]');
  await page.waitForSelector("#tab-describe:not([hidden])");
  await page.click('.tab-link[data-tab="compensate"]');
  await page.waitForSelector("#tab-compensate:not([hidden])");
  assert.equal(await page.locator("#tab-compensate .shown-title[data-seen]").count(), 1);
  await page.goto(address(server.address, `compensate?of=program&machine=machines/none.toml&program=${frustum}`));
  await page.locator("#tab-compensate .refused", { hasText: "none.toml" }).waitFor();
  assert.deepEqual(complaints, []);
  await context.close();
});
