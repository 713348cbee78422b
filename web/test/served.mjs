// One server and one browser for a file of tests; what the page shows is compared with the command line.
//
// The program is that of TRUEAXIS, or target/release/trueaxis; the browser is CHROMIUM, or /usr/bin/chromium.

import { execFile, spawn } from "node:child_process";
import { existsSync, mkdirSync } from "node:fs";
import path from "node:path";
import { fileURLToPath } from "node:url";
import { promisify } from "node:util";
import { chromium } from "playwright-core";

export const root = path.resolve(path.dirname(fileURLToPath(import.meta.url)), "../..");
export const program = process.env.TRUEAXIS ?? path.join(root, "target/release/trueaxis");
const browserPath = process.env.CHROMIUM ?? "/usr/bin/chromium";
const pictures = process.env.PICTURES ?? path.join(root, "target/screenshots");

/** Runs the command line; its JSON. A verdict "no" (status 1) is an answer too. */
export async function cli(...words) {
  const run = promisify(execFile);
  const options = { cwd: root, maxBuffer: 1 << 28 };
  const done = await run(program, [...words, "--format", "json"], options).catch((error) => {
    if (error.code === 1) return error;
    throw error;
  });
  return JSON.parse(done.stdout);
}

/** The page as it is being written in front of a server; for the folders that tests write into. */
async function live(server) {
  const { createServer } = await import("vite");
  process.env.SERVER = new URL(server).origin;
  const configFile = path.join(root, "web/dev/vite.config.ts");
  const vite = await createServer({ configFile, logLevel: "error", server: { port: 5290, hmr: false } });
  await vite.listen();
  return vite;
}

/**
 * Starts `trueaxis serve` on a folder; `stop` ends it. ADDRESS names one that runs already (`npm run dev`): then
 * the pages of other folders come from the sources, too. Without a token, as every window of a test has cookies of its
 * own; OPTIONS without --no-token gives the link with one.
 */
export async function serve(folder = root, options = ["--no-token"]) {
  if (process.env.ADDRESS && folder === root) return { address: process.env.ADDRESS, stop: () => {} };
  if (!existsSync(program)) throw new Error(`${program} is not there: cargo build --release`);
  const port = options.includes("--port") ? [] : ["--port", "0"];
  const child = spawn(program, ["serve", folder, ...port, ...options], { stdio: ["ignore", "pipe", "inherit"] });
  const address = await new Promise((found, failed) => {
    let text = "";
    child.stdout.on("data", (piece) => {
      text += piece;
      if (text.includes("\n")) found(text.trim());
    });
    child.on("exit", (status) => failed(new Error(`trueaxis serve ended with ${status}`)));
  });
  // After a test that failed nothing stops it: the tests end all the same, and it with them.
  child.unref();
  child.stdout.unref();
  process.once("exit", () => child.kill());
  if (!process.env.ADDRESS) return { address, stop: () => child.kill() };
  const vite = await live(address);
  const stop = () => vite.close().finally(() => child.kill());
  return { address: vite.resolvedUrls.local[0], stop };
}

/** Starts the browser, with software rendering. */
async function start() {
  return chromium.launch({
    executablePath: browserPath,
    args: [
      "--headless",
      "--no-sandbox",
      "--disable-gpu",
      "--use-angle=swiftshader",
      "--enable-unsafe-swiftshader",
      "--disable-quic",
      "--no-first-run",
      "--disable-background-networking",
      "--disable-component-update",
      "--disable-sync",
    ],
  });
}

/** A browser. Chromium sometimes ends while it starts: said, tried three times. */
export async function browse() {
  if (!existsSync(browserPath)) throw new Error(`${browserPath} is not there: install chromium, or set CHROMIUM`);
  for (let attempt = 1; ; attempt += 1) {
    try {
      return await start();
    } catch (error) {
      if (attempt === 3) throw error;
      console.log(`# Chromium did not start, tried again: ${error.message.split("\n", 1)[0]}`);
    }
  }
}

/**
 * A window that remembers every complaint: console errors and warnings, requests that leave the origin.
 * `complaints` must be empty at the end of a test.
 */
export async function open(browser, address, { dark = false, width = 1400, height = 900, locale = "en-US" } = {}) {
  const context = await browser.newContext({
    viewport: { width, height },
    colorScheme: dark ? "dark" : "light",
    acceptDownloads: true,
    locale,
  });
  const page = await context.newPage();
  const complaints = [];
  const harmless = /GPU stall due to ReadPixels|Automatic fallback to software WebGL/;
  page.on("console", (message) => {
    const loud = ["error", "warning"].includes(message.type());
    if (loud && !harmless.test(message.text())) complaints.push(`${message.type()}: ${message.text()}`);
  });
  page.on("pageerror", (error) => complaints.push(`error: ${error.message}`));
  page.on("request", (request) => {
    const url = request.url();
    const own = url.startsWith(`${new URL(address).origin}/`) || url.startsWith("data:") || url.startsWith("blob:");
    if (!own) complaints.push(`request to ${url}`);
  });
  page.setDefaultTimeout(Number(process.env.PATIENCE ?? 30_000));
  await page.goto(address);
  // The page is made after its language is loaded.
  await page.waitForFunction(() => !document.getElementById("app") || document.querySelector(".tab-link"));
  return { page, context, complaints };
}

/** Keeps a picture of the window as a test artefact. */
export async function picture(page, name) {
  mkdirSync(pictures, { recursive: true });
  await page.screenshot({ path: path.join(pictures, `${name}.png`) });
}
