// The first page: every example opens its tab, every machine file is there, a dropped file is not sent anywhere.

import assert from "node:assert/strict";
import { mkdtempSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import path from "node:path";
import { test } from "node:test";
import { findings } from "./axe.mjs";
import { cli, open, picture, root, serve } from "./served.mjs";
import { browser, server } from "./shared.mjs";

/** What the server says of its folder. */
async function project(page) {
  return page.evaluate(async () => {
    const answer = await fetch("api/project", {
      method: "POST",
      headers: { "content-type": "application/json" },
      body: "{}",
    });
    return answer.json();
  });
}

test("every example of a tab that is there opens with one click", async () => {
  const { page, context, complaints } = await open(browser, server.address);
  await page.waitForSelector(".card");
  const { examples, files } = await project(page);
  const tabs = await page.locator(".tab-link").evaluateAll((links) => links.map((l) => l.dataset.tab));
  const due = examples.filter((e) => tabs.includes(e.tab));
  assert.ok(due.length >= 3);
  assert.equal(await page.locator(".card").count(), due.length);
  for (const { tab, path, title, what } of due) {
    const card = page.locator(`.verb[data-verb="${tab}"] [data-example="${path}"]`, { hasText: title });
    assert.ok((await card.textContent()).includes(what));
  }
  await picture(page, "start");

  // One example of each tab: its address names the file, and back leads here again.
  for (const tab of new Set(due.map((e) => e.tab))) {
    const { path } = due.find((e) => e.tab === tab);
    await page.click(`.verb[data-verb="${tab}"] [data-example="${path}"]`);
    await page.waitForFunction((name) => location.hash.startsWith(`#${name}?`), tab);
    assert.ok(decodeURIComponent(await page.evaluate(() => location.hash)).includes(path));
    await page.locator(`#tab-${tab}`).waitFor({ state: "visible" });
    assert.equal(await page.locator('.tab-link[aria-selected="true"]').getAttribute("data-tab"), tab);
    await page.goBack();
    await page.locator(".card").first().waitFor({ state: "visible" });
  }

  // Every file of a kind is listed under it.
  for (const [kind, heading] of [
    ["machine", "Machines"],
    ["program", "Programs"],
    ["study", "Studies"],
    ["campaign", "Campaigns"],
  ]) {
    const group = page.locator("details.files", { has: page.locator("summary", { hasText: heading }) });
    const paths = files.filter((f) => f.kind === kind).map((f) => f.path);
    assert.deepEqual((await group.locator("td:first-child").allTextContents()).sort(), paths.sort());
  }
  assert.deepEqual(complaints, []);
  await context.close();
});

test("a file that no tab opens is named, and nothing is sent", async () => {
  const { page, context, complaints } = await open(browser, server.address, { dark: true, width: 1024, height: 768 });
  await page.waitForSelector(".card");
  await page.setInputFiles(".drop-input", { name: "holiday.jpg", mimeType: "image/jpeg", buffer: Buffer.from("x") });
  await page.locator(".toast", { hasText: "holiday.jpg" }).waitFor();
  await page.click(".toast-close");
  await picture(page, "start-dark");
  assert.deepEqual(complaints, []);
  await context.close();
});

test("the arrow keys reach every tab, and an unknown address is the first page", async () => {
  const { page, context, complaints } = await open(browser, server.address);
  await page.waitForSelector(".card");
  const links = page.locator(".tab-link");
  const count = await links.count();
  await links.first().focus();
  for (let i = 1; i < count; i++) await page.keyboard.press("ArrowRight");
  assert.equal(
    await page.evaluate(() => document.activeElement.dataset.tab),
    await links.last().getAttribute("data-tab"),
  );
  await page.goto(`${server.address.replace(/\/$/, "")}/#nowhere?x=1`);
  await page.locator(".card").first().waitFor({ state: "visible" });
  assert.deepEqual(complaints, []);
  await context.close();
});

test("the printed link with its token opens the page; its requests and its socket carry the cookie", async (t) => {
  if (process.env.ADDRESS) return t.skip("the page that is being written is served without a token");
  const served = await serve(root, []);
  try {
    assert.match(served.address, /\/\?token=[0-9a-f]{32}$/);
    const { page, context, complaints } = await open(browser, served.address);
    await page.waitForSelector(".card");
    assert.equal(page.url().includes("token"), false);
    assert.ok((await project(page)).files.length > 10);
    // The examples on the page came over the socket.
    assert.ok((await page.locator(".card").count()) > 3);
    const [cookie] = await context.cookies();
    assert.equal(cookie.name, `trueaxis_token_${new URL(served.address).port}`);
    assert.deepEqual([cookie.httpOnly, cookie.sameSite], [true, "Strict"]);
    assert.deepEqual(complaints, []);
    await context.close();
    const without = await browser.newContext();
    const refused = await (await without.newPage()).goto(new URL("/", served.address).href);
    assert.equal(refused.status(), 401);
    assert.match(await refused.text(), /needs its token/);
    await without.close();
  } finally {
    await served.stop();
  }
});

test("a machine of one's own by questions, with a mistake, is drawn, moves, and is read by the command line", async () => {
  const folder = mkdtempSync(path.join(tmpdir(), "trueaxis-start-"));
  const own = await serve(folder);
  try {
    const { page, context, complaints } = await open(browser, own.address);
    await page.click('[data-test="new-machine"]');
    const field = (name) => page.locator(`.new-machine-dialog [data-field="${name}"]`);
    await field("name").fill("Mill 7");
    await field("workpiece-Y").check();
    await field("tilting").selectOption("B");
    await field("X-from").fill("850");
    await field("X-to").fill("0");
    assert.match(await page.textContent('[data-test="new-machine-wrong"]'), /X goes from the smaller/);
    await page.click('[data-test="new-machine-save"]');
    assert.match(await page.textContent('[data-test="new-machine-note"]'), /X goes from the smaller/);
    await field("X-from").fill("0");
    await field("X-to").fill("850,5");
    await field("C-sign").selectOption("other");
    assert.match(await field("Y-sign").textContent(), /the table moves to minus Y \(ISO 841\)/);
    assert.match(await field("C-sign").textContent(), /the table turns clockwise, seen from \+Z \(ISO 841\)/);
    await picture(page, "start-new-machine");
    assert.deepEqual(await findings(page), []);
    await page.click('[data-test="new-machine-save"]');
    await page.waitForFunction(() =>
      decodeURIComponent(location.hash).includes("machine=machines/mill-7/machine.toml"),
    );
    await page.waitForFunction(
      () => document.querySelector("#tab-describe .describe-head h1")?.textContent === "Mill 7",
    );
    const machine = path.join(folder, "machines/mill-7/machine.toml");
    const document = await cli("check", machine);
    assert.equal(document.chain, "w C' B' Y' b X Z t");
    const x = document.axes.find((axis) => axis.name === "X");
    assert.deepEqual(x.travel_mm, [0, 850.5]);
    // Signs by moving it: with the other sense +90° of C is −90° of ISO 841.
    const pose = await cli("pose", machine, "--at", "X=100 C=90");
    assert.ok(Math.abs(pose.nominal.tip_mm[1] + 100) < 1e-9, JSON.stringify(pose.nominal));
    await picture(page, "describe-new-machine");
    // The name is taken: nothing is replaced.
    await page.goto(own.address);
    await page.click('[data-test="new-machine"]');
    await field("name").fill("mill 7");
    await page.click('[data-test="new-machine-save"]');
    await page.waitForFunction(() =>
      /is there already/.test(document.querySelector('[data-test="new-machine-note"]').textContent),
    );
    assert.deepEqual(complaints, []);
    await context.close();
  } finally {
    await own.stop();
    rmSync(folder, { recursive: true });
  }
});
