// Standards: what the tab shows is what `trueaxis evaluate` says; a dropped CSV gives the same; a bad cell is named.
import assert from "node:assert/strict";
import { copyFileSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import path from "node:path";
import { test } from "node:test";
import { cli, open, picture, root, serve } from "./served.mjs";
import { browser, server } from "./shared.mjs";
import { findings } from "./axe.mjs";
import { drop, exports, shown, table } from "./measured.mjs";

const laser = "examples/07_verify/x-axis-laser.csv";

/** Rows of the table of figures, as text. */
const figures = (page) => table(page, "figures");

async function openStandard(page, file) {
  await page.click(`[data-example="${file}"]`);
  await page.waitForSelector('#tab-standards [data-sheet="figures"]');
}

test("ISO 230-2: figures with uncertainty, charts, every target", async () => {
  const { page, context, complaints } = await open(browser, server.address);
  await openStandard(page, laser);
  const document = await cli("evaluate", "iso230-2", laser);
  const keys = ["A", "A_up", "A_down", "R", "R_up", "R_down", "E", "E_up", "E_down", "M", "B", "B_mean"];
  const rows = await figures(page);
  assert.deepEqual(
    rows.map((row) => row[0]),
    ["A", "A↑", "A↓", "R", "R↑", "R↓", "E", "E↑", "E↓", "M", "B", "B̄"],
  );
  rows.forEach((row, i) => {
    assert.equal(row[2], shown(document[`${keys[i]}_um`], 2), keys[i]);
    assert.equal(row[3], shown(document.U_um[keys[i]], 2), `U of ${keys[i]}`);
  });
  for (const key of ["A", "R", "E", "M", "B"]) {
    const tile = await page.textContent(`#tab-standards [data-tile="${key}"]`);
    assert.ok(tile.includes(shown(document[`${key}_um`], 2)), tile);
    assert.ok(tile.includes(`U ${shown(document.U_um[key], 2)}`), tile);
  }
  const targets = await table(page, "targets");
  assert.equal(targets.length, document.positions.length);
  targets.forEach((row, i) => {
    const p = document.positions[i];
    const values = [
      p.mean_up_um,
      p.mean_down_um,
      p.mean_um,
      p.s_up_um,
      p.s_down_um,
      p.B_um,
      p.R_up_um,
      p.R_down_um,
      p.R_um,
    ];
    assert.deepEqual(row, [shown(p.target_mm, 1), String(p.n_up), String(p.n_down), ...values.map((v) => shown(v, 2))]);
  });
  assert.match(await page.textContent('#tab-standards [data-test="conditions"]'), /x-axis-laser\.toml/);
  assert.match(
    await page.textContent('#tab-standards [data-test="circumstances"]'),
    /three-axis mill · axis X .* 21\.9 ± 0\.2 °C/,
  );
  assert.equal(await page.locator("#tab-standards .picture .figure-svg").count(), 2);
  await exports(page, "#tab-standards .picture");
  await picture(page, "standards");
  assert.deepEqual(complaints, []);
  await context.close();
});

test("the other standards show their figures", async () => {
  const { page, context, complaints } = await open(browser, server.address);
  const cases = [
    [
      "iso230-4",
      "examples/07_verify/circle-xy.csv",
      (d) => [
        [2, d.G_ccw_um],
        [2, d.F_ccw_max_um],
        [2, d.F_ccw_min_um],
        [2, d.G_cw_um],
      ],
    ],
    [
      "iso230-6",
      "examples/07_verify/body-diagonals.csv",
      (d) => ["E_d", "E_d_up", "E_d_down", "R_d", "B_d", "A_d"].map((key) => [2, d[`${key}_um`]]),
    ],
    [
      "iso230-3",
      "examples/07_verify/spindle-drift.csv",
      (d) => d.channels.map((c) => [2, c.range_um ?? c.range_urad ?? c.range_degC]),
    ],
    ["iso230-7", "examples/07_verify/spindle-motion.csv", (d) => d.motions.map((m) => [1, m.total_um])],
    // The tables of the report, as they stand there.
    ["iso230-1", "examples/07_verify/squareness-xy.csv", () => []],
    ["iso230-10", "examples/07_verify/probe-performance.csv", () => []],
  ];
  for (const [standard, file, values] of cases) {
    // Without a standard in the address the headings of the table say which one it is.
    await page.evaluate(
      (hash) => {
        location.hash = hash;
      },
      `#standards?path=${file}${/iso230-10?$/.test(standard) ? `&standard=${standard}` : ""}`,
    );
    await page.waitForFunction(
      (name) => document.querySelector("#tab-standards .result p.muted")?.textContent.includes(name),
      file,
    );
    assert.equal(await page.inputValue('[data-test="standard"]'), standard);
    const rows = await figures(page);
    assert.ok(rows.length > 0, `${standard} has figures`);
    const document = await cli("evaluate", standard, file);
    values(document).forEach(([column, value], i) =>
      assert.equal(rows[i][column], shown(value, 2), `${standard} row ${i}`),
    );
    assert.ok((await page.locator("#tab-standards .picture .figure-svg").count()) > 0);
  }
  assert.deepEqual(complaints, []);
  await context.close();
});

test("a dropped CSV gives the same figures, and says that no conditions are known", async () => {
  const { page, context, complaints } = await open(browser, server.address);
  await openStandard(page, laser);
  const from_file = await figures(page);
  await drop(page, "#tab-standards", "mine.csv", readFileSync(path.join(root, laser), "utf8"));
  await page.waitForFunction(() => document.querySelector("#tab-standards .result h1")?.textContent === "mine.csv");
  const from_drop = await figures(page);
  assert.deepEqual(
    from_drop.map((row) => row.slice(0, 3)),
    from_file.map((row) => row.slice(0, 3)),
  );
  assert.ok(
    from_drop.every((row) => row[3] === "–"),
    "no instrument is known, so no U",
  );
  assert.match(await page.textContent('#tab-standards [data-test="conditions"]'), /No conditions file/);
  await page.selectOption(
    '#tab-standards [aria-label="Conditions of the test"]',
    "examples/07_verify/x-axis-laser.toml",
  );
  await page.waitForFunction(() =>
    /x-axis-laser\.toml/.test(document.querySelector('#tab-standards [data-test="conditions"]')?.textContent ?? ""),
  );
  assert.deepEqual(await figures(page), from_file);
  assert.deepEqual(complaints, []);
  await context.close();
});

test("a dropped CSV on the first page opens here; a bad cell is named with its line", async () => {
  const { page, context, complaints } = await open(browser, server.address);
  await page.waitForSelector(".drop-input");
  await page.setInputFiles(".drop-input", {
    name: "bad.csv",
    mimeType: "text/csv",
    buffer: Buffer.from("target_mm,run,direction,deviation_um\n0,1,up,0.5\n100,1,up,abc\n"),
  });
  const refused = await page.waitForSelector("#tab-standards .refused");
  const text = await refused.textContent();
  assert.match(text, /bad\.csv:3:/);
  assert.match(text, /abc.*is not a finite number/);
  assert.match(text, /write a number such as/);
  assert.equal(await page.locator("#tab-standards .picture").count(), 0, "no charts of an earlier answer");
  await drop(
    page,
    "#tab-standards",
    "picture.csv",
    Uint8Array.of(0x89, 0x50, 0x4e, 0x47, 0x0d, 0x0a, 0x1a, 0x0a, 0, 0),
  );

  assert.match(await page.textContent(".toast"), /the file is not a text file/);
  assert.deepEqual(complaints, []);
  await context.close();
});

/** The readings of the example as a spreadsheet in German writes them. */
function spreadsheet(headings, { forwards = "vorwärts", back = "rückwärts" } = {}) {
  const rows = readFileSync(path.join(root, laser), "utf8")
    .split("\n")
    .filter((line) => /^-?\d/.test(line))
    .map((line) => line.split(","))
    .map(([target, run, direction, deviation]) =>
      [target, run, direction === "up" ? forwards : back, deviation].join(";").replaceAll(".", ","),
    );
  return ["Maschine;Fräse 7", "", headings, ...rows].join("\r\n");
}

test("a laser table of a German spreadsheet: chart, conditions and verdict from a cold start", async () => {
  const { page, context, complaints } = await open(browser, server.address);
  await page.waitForSelector(".drop-input");
  const text = spreadsheet("Sollposition [mm];Lauf;Richtung;Abweichung [µm]");
  // 1: the file. Windows-1252, as Excel saves it.
  await page.setInputFiles(".drop-input", {
    name: "laser.csv",
    mimeType: "text/csv",
    buffer: Buffer.from(text, "latin1"),
  });
  await page.waitForSelector('#tab-standards [data-sheet="figures"]');
  const document = await cli("evaluate", "iso230-2", laser, "--tolerance", "A=16 um", "--tolerance", "R=8 um");
  const rows = await figures(page);
  assert.equal(rows[0][2], shown(document.A_um, 2));
  assert.equal(rows[3][2], shown(document.R_um, 2));
  assert.equal(await page.locator("#tab-standards .picture .figure-svg").count(), 2);
  assert.match(await page.textContent('#tab-standards [data-test="conditions"]'), /Read as windows-1252/);
  // 2 to 5: conditions in a form, with a mistake in it.
  await page.click('[data-test="state-conditions"]');
  const fill = (name, value) => page.fill(`.conditions-dialog [data-field="${name}"]`, value);
  await fill("axis", "X");
  await fill("date", "21.11.2026");
  await fill("temperature", "21.9 ± 0.2 degC");
  await fill("uncertainty.device_expanded", "0.5 um/m");
  await fill("uncertainty.misalignment_range", "1 mm");
  await fill("uncertainty.expansion", "11.5 ± 1 um/(m·K)");
  await fill("uncertainty.eve_range", "0.6 um");
  await page.click('[data-test="conditions-save"]');
  assert.match(await page.textContent('[data-test="conditions-note"]'), /Date: a date is written 2026-11-28/);
  await fill("date", "2026-11-21");
  await picture(page, "standards-conditions");
  assert.deepEqual(await findings(page), []);
  await page.click('[data-test="conditions-save"]');
  await page.waitForFunction(
    (u) => document.querySelector('#tab-standards [data-sheet="figures"] tbody tr td:nth-child(4)')?.textContent === u,
    shown(document.U_um.A, 2),
  );
  // 6: tolerances.
  await page.fill('#tab-standards [data-field="tolerances"]', "A=16 um; R=8 um");
  await page.press('#tab-standards [data-field="tolerances"]', "Enter");
  const decision = await page.waitForSelector('[data-test="decision"]');
  assert.equal(await decision.textContent(), `${document.decisions.decision}by ISO 14253-1`);
  const judged = await table(page, "tolerances");
  assert.deepEqual(
    judged.map((row) => [row[0], row.at(-1)]),
    document.decisions.figures.map((one) => [one.figure, one.decision]),
  );
  await picture(page, "standards-tolerances");
  // What was dropped and stated is there after a reload, and listed on the first page.
  await page.reload();
  await page.waitForSelector('[data-test="decision"]');
  assert.deepEqual(await table(page, "tolerances"), judged);
  assert.match(await page.textContent('#tab-standards [data-test="conditions"]'), /Read as windows-1252/);
  await page.click('[data-tab="start"]');
  await page.waitForSelector('[data-test="kept"] td');
  const kept = await page
    .locator('[data-test="kept"] tr td:first-child')
    .evaluateAll((cells) => cells.map((cell) => [cell.textContent, cell.querySelector("a") !== null]));
  assert.deepEqual(kept, [
    ["laser.toml", false],
    ["laser.csv", true],
  ]);
  assert.deepEqual(complaints, []);
  await context.close();
});

test("any table: what its columns are is chosen, saved with it, and read by the command line", async () => {
  const folder = mkdtempSync(path.join(tmpdir(), "trueaxis-standards-"));
  const own = await serve(folder);
  try {
    const { page, context, complaints } = await open(browser, own.address);
    await page.waitForSelector(".drop-input");
    const text = spreadsheet("Pos;Nr;R;Wert", { forwards: "V", back: "Z" });
    await page.setInputFiles(".drop-input", {
      name: "Messung 7.txt",
      mimeType: "text/plain",
      buffer: Buffer.from(text),
    });
    await page.waitForSelector("#tab-standards .refused");
    await page.click('#tab-standards .refused [data-test="columns"]');
    const cell = (column, what) => page.locator(`.columns-dialog [data-column="${column}"] ${what}`);
    await page.waitForSelector('.columns-dialog [data-column="4"]');
    assert.match(await page.textContent('[data-test="columns-wrong"]'), /two columns/);
    for (const [column, role] of [
      [1, "target"],
      [2, "run"],
      [3, "direction"],
      [4, "target"],
    ])
      await cell(column, "td:nth-child(3) select").selectOption(role);
    assert.match(await page.textContent('[data-test="columns-wrong"]'), /Two columns are "target"/);
    await cell(4, "td:nth-child(3) select").selectOption("deviation");
    assert.match(await page.textContent('[data-test="columns-wrong"]'), /unit of "Pos" is not stated/);
    await cell(1, "td:nth-child(4) select").selectOption("mm");
    await cell(4, "td:nth-child(4) select").selectOption("um");
    for (const [word, ours] of [
      ["V", "up"],
      ["Z", "down"],
    ])
      await page.selectOption(`.columns-dialog [aria-label="Meaning of ${word} in R"]`, ours);
    assert.equal(await page.textContent('[data-test="columns-wrong"]'), "");
    await picture(page, "standards-columns");
    assert.deepEqual(await findings(page), []);
    await page.click('[data-test="columns-save"]');
    await page.waitForSelector('#tab-standards [data-sheet="figures"]');
    const document = await cli("evaluate", "iso230-2", laser);
    const of = (rows) => rows.map((row) => row[2]);
    const found = of(await figures(page));
    assert.equal(found[0], shown(document.A_um, 2));
    // The other way round: a sign is changed.
    const mean = async () => (await table(page, "targets"))[0][3];
    const before = await mean();
    const negated = before.startsWith("−") ? before.slice(1) : `−${before}`;
    for (const [change, then] of [
      ["check", negated],
      ["uncheck", before],
    ]) {
      await page.click('[data-test="columns"]');
      await page.waitForSelector('.columns-dialog [data-column="4"]');
      await cell(4, 'input[type="checkbox"]')[change]();
      await page.click('[data-test="columns-save"]');
      await page.waitForFunction(
        (text) =>
          document.querySelector('#tab-standards [data-sheet="targets"] tbody tr td:nth-child(4)')?.textContent ===
          text,
        then,
      );
    }
    // Into the project: the command line reads the same, with the mapping file beside it.
    await page.click('[data-test="keep-readings"]');
    assert.equal(await page.inputValue('.keep-dialog [data-field="name"]'), "Messung-7.csv");
    await page.click('[data-test="keep-save"]');
    await page.waitForFunction(() => location.hash.includes("path=Messung-7.csv"));
    await page.waitForSelector('#tab-standards [data-sheet="figures"]');
    assert.deepEqual(of(await figures(page)), found);
    const saved = await cli("evaluate", "iso230-2", path.join(folder, "Messung-7.csv"));
    assert.equal(saved.A_um, document.A_um);
    // Nothing is replaced.
    await page.setInputFiles("#tab-standards .drop-input", {
      name: "Messung 7.txt",
      mimeType: "text/plain",
      buffer: Buffer.from(text),
    });
    await page.click('[data-test="keep-readings"]');
    await page.click('[data-test="keep-save"]');
    await page.waitForFunction(() =>
      /is there already/.test(document.querySelector('[data-test="keep-note"]').textContent),
    );
    // A report with a heading that is stated in a form.
    await page.click(".keep-dialog button:not(.primary)");
    await page.evaluate(() => {
      location.hash = "#standards?path=Messung-7.csv&tolerances=A%3D1%20um&simple=1";
    });
    await page.waitForFunction(() =>
      /not conforming/.test(document.querySelector('[data-test="decision"]')?.textContent ?? ""),
    );
    await page.click("#tab-standards .report-link");
    await page.waitForSelector(".report-frame");
    await page.click('[data-test="state-heading"]');
    await page.click('[data-test="heading-save"]');
    assert.match(await page.textContent('[data-test="heading-note"]'), /Number: it is needed/);
    await page.fill('.heading-dialog [data-field="report.number"]', "2026-118");
    await page.fill('.heading-dialog [data-field="report.customer"]', "Example Turbines");
    await page.click('[data-test="heading-save"]');
    const frame = page.frameLocator(".report-frame");
    await frame.getByText("2026-118").first().waitFor();
    assert.match(await frame.locator("body").textContent(), /not conforming/);
    assert.deepEqual(complaints, []);
    await context.close();
  } finally {
    await own.stop();
    rmSync(folder, { recursive: true });
  }
});

test("the budget of a rotary axis is in µrad, as the command has it", async () => {
  const folder = mkdtempSync(path.join(tmpdir(), "trueaxis-budget-"));
  copyFileSync(path.join(root, "examples/07_verify/c-axis-polygon.csv"), path.join(folder, "c.csv"));
  writeFileSync(path.join(folder, "c.toml"), 'name = "C"\naxis = "C"\n[uncertainty]\ndevice_expanded = "1 arcsec"\n');
  const own = await serve(folder);
  const { page, context, complaints } = await open(browser, own.address);
  await page.goto(new URL("#standards?path=c.csv&standard=iso230-2", own.address).href);
  await page.waitForSelector('#tab-standards [data-sheet="budget"]');
  const heading = await page.textContent('#tab-standards [data-sheet="budget"] thead');
  assert.match(heading, /standard uncertainty, µrad/);
  const { budget } = await cli("evaluate", "iso230-2", path.join(folder, "c.csv"));
  // By hand: U = 1″ with k = 2 is u = 0.5″ = 2.42 µrad.
  assert.equal(shown(budget.device_u_urad, 2), "2.42");
  assert.deepEqual((await table(page, "budget")).find(([name]) => name === "device")?.[1], "2.42");
  assert.deepEqual(complaints, []);
  await context.close();
  await own.stop();
  rmSync(folder, { recursive: true });
});
