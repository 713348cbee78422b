// The Report tab: one HTML file per verb, shown, saved, printed.

import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { test } from "node:test";
import { cli, open, picture } from "./served.mjs";
import { browser, server } from "./shared.mjs";

const FAILING = "examples/03_predict/nas979-head-out-of-square.toml";
const LASER = "examples/07_verify/x-axis-laser.csv";

const made = (page) =>
  page.waitForFunction(() => document.querySelector("[data-test=report-note]")?.textContent?.includes(".html"));

test("the report of a prediction: from its tab, with the verdict, as a file that needs nothing else", async () => {
  const expected = await cli("predict", FAILING, "--no-report");
  const { page, complaints } = await open(browser, server.address);
  await page.click(`[data-example="${FAILING}"]`);
  await page.click(".predict-page:not([hidden]) .predict-choice button");
  await made(page);
  assert.match(page.url(), /#report\?verb=predict&file=examples\/03_predict/);
  const frame = page.frameLocator(".report-frame");
  const text = await frame.locator("body").textContent();
  assert.ok(text.includes(expected.study));
  assert.match(text, new RegExp(expected.verdict.toUpperCase()));
  const coaxiality = (1e3 * expected.indices.iso.coaxiality_lsc_mm.value).toFixed(2);
  assert.ok(text.includes(coaxiality), `${coaxiality} stands in the report`);
  await picture(page, "report");

  const [download] = await Promise.all([page.waitForEvent("download"), page.click("text=Save HTML")]);
  assert.equal(download.suggestedFilename(), "nas979-head-out-of-square-predict.html");
  const file = readFileSync(await download.path(), "utf8");
  assert.match(file, /^<!DOCTYPE html>/);
  assert.doesNotMatch(file, /<(script|link|iframe)\b|(src|href)="(?!data:|#)/);
  assert.ok(file.includes(coaxiality));
  assert.deepEqual(complaints, []);
});

test("print prints the report, not the page", async () => {
  const { page, complaints } = await open(browser, server.address);
  await page.goto(new URL(`#report?verb=predict&file=${FAILING}`, server.address).href);
  await made(page);
  const print = page.locator("text=Print or PDF");
  await print.waitFor();
  await page.waitForFunction(() => document.querySelector(".report-frame").contentDocument?.readyState === "complete");
  const printed = await page.evaluate(async () => {
    const inside = document.querySelector(".report-frame").contentWindow;
    const done = new Promise((resolve) => inside.addEventListener("beforeprint", () => resolve("report")));
    window.addEventListener("beforeprint", () => document.body.append("the page was printed"));
    [...document.querySelectorAll("button")].find((b) => b.textContent === "Print or PDF").click();
    return Promise.race([done, new Promise((resolve) => setTimeout(() => resolve("nothing"), 3000))]);
  });
  assert.equal(printed, "report");
  assert.deepEqual(complaints, []);
});

test("readings by a standard; what cannot be reported says why", async () => {
  const { page, complaints } = await open(browser, server.address);
  await page.goto(new URL(`#report?verb=evaluate&file=${LASER}&standard=iso230-2`, server.address).href);
  await made(page);
  assert.match(await page.frameLocator(".report-frame").locator("body").textContent(), /ISO 230-2/);

  await page.goto(new URL(`#report?verb=predict&file=examples/03_predict/none.toml`, server.address).href);
  const toast = page.locator(".toast");
  await toast.waitFor();
  assert.match(await toast.textContent(), /none\.toml/);
  assert.equal(await page.locator(".report-frame").count(), 0);
  assert.deepEqual(complaints, []);
});

test("a heading stands above the report, and a build with PDF saves one", async () => {
  const { page, complaints } = await open(browser, server.address);
  await page.goto(new URL(`#report?verb=evaluate&file=${LASER}&standard=iso230-2`, server.address).href);
  await made(page);
  await page.getByLabel("Heading to be filed and signed").selectOption("examples/07_verify/report-heading.toml");
  await page.click("text=Make the report");
  await page.waitForFunction(() =>
    document.querySelector(".report-frame")?.contentDocument?.body?.textContent?.includes("Example Turbines"),
  );
  const text = await page.frameLocator(".report-frame").locator("body").textContent();
  for (const words of ["2026-117", "K 2026-0042", "measured: name, date, signature", "made by trueaxis"])
    assert.ok(text.includes(words), words);
  const pdf = page.locator('[data-test="save-pdf"]');
  if (await pdf.isEnabled()) {
    const [download] = await Promise.all([page.waitForEvent("download"), pdf.click()]);
    assert.equal(download.suggestedFilename(), "x-axis-laser-evaluate.pdf");
    assert.match(readFileSync(await download.path(), "latin1"), /^%PDF-1\.[\s\S]*%%EOF\s*$/);
  } else {
    assert.match(await pdf.getAttribute("title"), /writes no PDF/);
  }
  assert.deepEqual(complaints, []);
});

test("a compensation: Report in Compensate takes what was chosen there; in German; also after a reload", async () => {
  const { page, context, complaints } = await open(browser, server.address);
  await page.selectOption(".language", "de");
  await page.waitForFunction(() => document.documentElement.lang === "de");
  await page.waitForSelector(".card");
  const program = "examples/06_compensate/everyday-fanuc.nc";
  const at = `#compensate?of=program&machine=machines/i5-engraver/machine.toml&program=${program}&options=position-only`;
  await page.goto(new URL(at, server.address).href);
  await page.waitForSelector("#tab-compensate .figure-svg");
  await page.click("#tab-compensate .report-link");
  await made(page);
  const text = () => page.frameLocator(".report-frame").locator("body").textContent();
  assert.match(await text(), /everyday-fanuc\.nc, kompensiert für i5 engraving centre/);
  assert.match(await text(), /nur die Position wird kompensiert/);
  assert.match(page.url(), /verb=compensate-program.*position_only/);
  await page.reload();
  await made(page);
  assert.match(await text(), /nur die Position wird kompensiert/);
  // Tables of another control than the first, chosen here.
  await page.selectOption('[aria-label="Art des Berichts"]', "compensate-tables");
  await page.selectOption('[data-test="report-file"]', "machines/three-axis-mill/machine.toml");
  await page.selectOption('.report [aria-label="Steuerung"]', "linuxcnc");
  await page.click(".report-head .primary");
  await made(page);
  await page.waitForFunction(() => document.querySelector("[data-test=report-note]").textContent.includes("tables"));
  assert.match(await text(), /Tabellen für linuxcnc/);
  // From Compensate with another control than the first, and again after a reload.
  const tables = "#compensate?of=tables&machine=machines/three-axis-mill/machine.toml&target=fanuc";
  await page.goto(new URL(tables, server.address).href);
  await page.waitForSelector("#tab-compensate table td");
  await page.click("#tab-compensate .report-link");
  await made(page);
  assert.match(await text(), /Tabellen für fanuc/);
  await page.reload();
  await made(page);
  assert.match(await text(), /Tabellen für fanuc/);
  assert.deepEqual(complaints, []);
  await context.close();
});
