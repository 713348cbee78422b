// The pictures of README.md, taken from the page: `npm run pictures`.
//
// Each is 1000 points wide, in at most 256 colours and 90 kB. The page is that of TRUEAXIS or ADDRESS (served.mjs);
// making pictures smaller takes python3 with Pillow.

import { execFileSync, spawn } from "node:child_process";
import { mkdirSync, mkdtempSync, rmSync } from "node:fs";
import os from "node:os";
import path from "node:path";
import { browse, open, program, root, serve } from "./served.mjs";

const WIDTH = 1000;
const MOST_BYTES = 90_000;
/** Until a scene drawn by the processor is smooth, and figures have their sizes. */
const REST_MS = 2500;
/** How long the run on the mock goes before its picture is taken. */
const LIVE_MS = 150_000;

const SMALLER = `
import os, sys
from PIL import Image
source, target, width, most = sys.argv[1], sys.argv[2], int(sys.argv[3]), int(sys.argv[4])
picture = Image.open(source).convert("RGB")
picture = picture.resize((width, round(picture.height * width / picture.width)), Image.LANCZOS)
# One half of the palette for what covers most of the picture, one for what is rare: a thin coloured line.
for half in (128, 64, 32, 16):
    both = [colour for method in (Image.MEDIANCUT, Image.MAXCOVERAGE) for colour in picture.quantize(half, method).getpalette()[:3 * half]]
    palette = Image.new("P", (1, 1))
    palette.putpalette(both)
    picture.quantize(palette=palette, dither=Image.Dither.NONE).save(target, optimize=True)
    if os.path.getsize(target) <= most:
        break
else:
    sys.exit(f"{target} has {os.path.getsize(target)} bytes, at most {most} are wanted")
print(f"{target}: {os.path.getsize(target)} bytes, at most {2 * half} colours")
`;

/** What each picture shows: where, and what is done there. */
const PICTURES = {
  describe: {
    at: "describe?machine=machines/xkas2525/machine.toml",
    async act(page) {
      await page.locator(".scene-note.actual").waitFor();
      for (const [axis, mm] of [
        ["X", 3100],
        ["Y", 1250],
        ["Z", -500],
      ])
        await page.fill(`[data-position="${axis}"]`, String(mm));
      await page.click('[data-page="errors"]');
    },
  },
  simulate: {
    at: "simulate?machine=machines/i5-engraver/machine.toml&program=examples/02_simulate/ring-fanuc.nc",
    async act(page) {
      await page.click('[data-test="to-largest"]');
      await page.waitForFunction(() => globalThis.trueaxisScene.moment()?.time_s > 0);
      await page.click('[data-test="look-at-path"]');
    },
  },
  predict: {
    at: "predict?study=examples/03_predict/nas979-head-out-of-square.toml",
    act: (page) => page.locator('.predict-page:not([hidden]) [data-test="verdict"]').waitFor(),
  },
  identify: {
    at: "identify?campaign=examples/05_identify/mixed-instruments.toml",
    act: (page) => page.locator('#tab-identify [data-test="verdict"]').waitFor(),
  },
  standards: {
    at: "standards?path=examples/07_verify/x-axis-laser.csv&standard=iso230-2",
    act: (page) => page.locator("#tab-standards .picture .figure-svg").first().waitFor(),
  },
  report: {
    at: "report?verb=predict&file=examples/03_predict/nas979-head-out-of-square.toml",
    act: (page) =>
      page.waitForFunction(() => document.querySelector("[data-test=report-note]")?.textContent?.includes(".html")),
  },
  compensate: {
    at: "compensate?of=program&machine=machines/xkas2525/machine.toml&program=examples/06_compensate/frustum.mpf",
    act: (page) => page.locator('#tab-compensate [data-test="verdict"]').waitFor({ timeout: 60_000 }),
  },
  live: {
    at: "live?plan=examples/08_live/gantry-mock.toml",
    async act(page) {
      // The run began with the first picture: its curves are there when some lines are.
      await page.waitForSelector('#tab-live [data-quantity="X"] canvas', { timeout: 60_000 });
      await page.waitForTimeout(LIVE_MS);
      await page.reload();
      await page.waitForSelector('#tab-live [data-quantity="X"] canvas');
    },
  },
};

const target = path.join(root, "docs/pictures");
const raw = mkdtempSync(path.join(os.tmpdir(), "trueaxis-pictures-"));
mkdirSync(target, { recursive: true });
process.env.XDG_STATE_HOME = raw;
const run = spawn(program, ["live", "examples/08_live/gantry-mock.toml"], { cwd: root, stdio: "ignore" });
const server = await serve();
const browser = await browse();
try {
  for (const [name, { at, act }] of Object.entries(PICTURES)) {
    const { page, context } = await open(browser, server.address);
    await page.goto(new URL(`#${at}`, server.address).href);
    await act(page);
    await page.mouse.move(0, 0);
    await page.waitForTimeout(REST_MS);
    const taken = path.join(raw, `${name}.png`);
    await page.screenshot({ path: taken });
    const words = ["-c", SMALLER, taken, path.join(target, `${name}.png`), String(WIDTH), String(MOST_BYTES)];
    process.stdout.write(execFileSync("python3", words));
    await context.close();
  }
} finally {
  run.kill("SIGKILL");
  await browser.close();
  await server.stop();
  rmSync(raw, { recursive: true, force: true });
}
