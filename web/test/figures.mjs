// How heavy and how fast the page is: `npm run figures`. The page is the one in the binary (served.mjs: TRUEAXIS).
//
// Sizes of its files, the time to the first picture of the shipped example, and how fluid a program of 10⁶ blocks
// plays with software rendering.

import { cpSync, mkdtempSync, rmSync, writeFileSync } from "node:fs";
import os from "node:os";
import path from "node:path";
import { gzipSync } from "node:zlib";
import { browse, open, root, serve } from "./served.mjs";

const ENGRAVER = "machines/i5-engraver";
const FIRST = "describe?machine=machines/xkas2525/machine.toml";
const BLOCKS = 1_000_000;

/** Every file of the page, found from its first one. */
async function sizes(address) {
  const names = [""];
  const rows = [];
  for (const name of names) {
    const answer = await fetch(new URL(name, address));
    if (!answer.ok) throw new Error(`${name}: ${answer.status}`);
    const content = Buffer.from(await answer.arrayBuffer());
    rows.push([name || "index.html", content.length, gzipSync(content).length]);
    const text = content.toString();
    for (const [, found] of text.matchAll(/["'`]\.\/([\w.-]+\.(?:js|css|svg))["'`]/g))
      if (!names.includes(found)) names.push(found);
  }
  const sum = (column) => rows.reduce((total, row) => total + row[column], 0);
  for (const [name, bytes, gzip] of [...rows, ["together", sum(1), sum(2)]]) {
    console.log(`${name.padEnd(16)} ${String(bytes).padStart(9)} bytes ${String(gzip).padStart(9)} gzip`);
  }
}

/** From the request to the machine drawn with its actual pose, ms; the median of three fresh windows. */
async function firstPicture(browser, address) {
  const times = [];
  for (let i = 0; i < 3; i++) {
    const { page, context } = await open(browser, "about:blank");
    await page.goto(new URL(`#${FIRST}`, address).href, { waitUntil: "commit" });
    const time = await page.waitForFunction(
      () => {
        const frames = document.querySelector(".scene-note.actual") ? globalThis.trueaxisScene.frames() : 0;
        globalThis.posed ??= frames || undefined;
        return globalThis.posed && frames > globalThis.posed ? performance.now() : false;
      },
      null,
      { polling: "raf" },
    );
    times.push(await time.jsonValue());
    await context.close();
  }
  console.log(
    `first picture of xkas2525 with actual pose after ${times.sort((a, b) => a - b)[1].toFixed(0)} ms (median of 3 fresh windows)`,
  );
}

/** A spiral of many short moves on the engraver, and its frames a second while it plays. */
async function fluid(browser) {
  const folder = mkdtempSync(path.join(os.tmpdir(), "trueaxis-fluid-"));
  cpSync(path.join(root, ENGRAVER), path.join(folder, "machine"), { recursive: true });
  const lines = ["G21 G17 G40 G90 G94", "G1 X0 Y0 Z60 F3000"];
  for (let i = 0; i < BLOCKS; i++) {
    const [angle, radius] = [i / 200, 20 + i / 50_000];
    lines.push(
      `X${(radius * Math.cos(angle)).toFixed(4)} Y${(radius * Math.sin(angle)).toFixed(4)} Z${(60 + i / 100_000).toFixed(4)}`,
    );
  }
  writeFileSync(path.join(folder, "long.nc"), [...lines, "M30", ""].join("\n"));
  const own = await serve(folder);
  try {
    const { page } = await open(browser, own.address);
    await page.addInitScript(() => {
      globalThis.longest_ms = 0;
      const seen = (list) => {
        for (const { duration } of list.getEntries()) globalThis.longest_ms = Math.max(globalThis.longest_ms, duration);
      };
      new PerformanceObserver(seen).observe({ type: "longtask", buffered: true });
    });
    await page.reload();
    const longest = async (what) =>
      console.log(
        `longest task ${what}: ${(await page.evaluate(() => globalThis.longest_ms)).toFixed(0)} ms (below 50: 0)`,
      );
    const started = Date.now();
    await page.goto(new URL("#simulate?machine=machine/machine.toml&program=long.nc", own.address).href);
    await page.waitForSelector('.tab-simulate.simulated [data-test="place"]:not(:empty)', { timeout: 600_000 });
    console.log(`10⁶ blocks simulated and shown after ${((Date.now() - started) / 1000).toFixed(1)} s`);
    await page.waitForSelector(".source-line");
    await longest("until it is shown");
    await page.click('[data-test="look-at-path"]');
    await page.selectOption('[data-test="factor"]', "100");
    await page.click('[data-act="play"]');
    await page.waitForTimeout(2000);
    await longest("while it plays");
    const frames = await page.evaluate(async () => {
      const [from, began] = [globalThis.trueaxisScene.frames(), performance.now()];
      await new Promise((done) => setTimeout(done, 5000));
      return (1000 * (globalThis.trueaxisScene.frames() - from)) / (performance.now() - began);
    });
    console.log(
      `${frames.toFixed(1)} frames/s while it plays, software rendering, 1400 × 900; ${await page.locator(".source-line").count()} lines of the source in the page`,
    );
  } finally {
    await own.stop();
    rmSync(folder, { recursive: true, force: true });
  }
}

if (process.env.ADDRESS)
  throw new Error("the figures are those of the built page: unset ADDRESS, and name the binary by TRUEAXIS");
const server = await serve();
const browser = await browse();
try {
  await sizes(server.address);
  await firstPicture(browser, server.address);
  await fluid(browser);
} finally {
  await browser.close();
  await server.stop();
}
