// Standards: what the tab shows is what `trueaxis evaluate` says; a dropped CSV gives the same; a bad cell is named.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import path from "node:path";
import { test } from "node:test";
import { cli, open, picture, root } from "./served.mjs";
import { browser, server } from "./shared.mjs";
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
  ];
  for (const [standard, file, values] of cases) {
    // Without a standard in the address the headings of the table say which one it is.
    await page.evaluate((hash) => {
      location.hash = hash;
    }, `#standards?path=${file}`);
    await page.waitForFunction(
      (name) => document.querySelector("#tab-standards .result p.muted")?.textContent.includes(name),
      file,
    );
    assert.equal(await page.inputValue('[data-test="standard"]'), standard);
    const rows = await figures(page);
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
  await drop(page, "#tab-standards", "picture.csv", Uint8Array.of(0x89, 0x50, 0xff, 0xfe));
  assert.match(await page.textContent(".toast"), /picture\.csv is not a text file/);
  assert.deepEqual(complaints, []);
  await context.close();
});
