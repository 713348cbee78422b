// Every tab on the screens that people have: the page never scrolls sideways, and nothing of the bar lies over another part.
import assert from "node:assert/strict";
import { test } from "node:test";
import { go, placesOf } from "./places.mjs";
import { open } from "./served.mjs";
import { browser, server } from "./shared.mjs";

const SIZES = [
  [1280, 720],
  [1440, 900],
  [1920, 1080],
  [1024, 768],
];

/** What does not fit. */
const misfits = (page) =>
  page.evaluate(() => {
    const found = [];
    const root = document.documentElement;
    if (root.scrollWidth > root.clientWidth) found.push(`the page is ${root.scrollWidth} px wide`);
    if (root.scrollHeight > root.clientHeight) found.push(`the page is ${root.scrollHeight} px high`);
    const parts = [...document.querySelector(".bar").children].filter((one) => one.offsetParent !== null);
    const boxes = parts.map((one) => one.getBoundingClientRect());
    for (let i = 1; i < boxes.length; i++)
      if (boxes[i].left < boxes[i - 1].right - 0.5) found.push(`${parts[i].className} over ${parts[i - 1].className}`);
    if (boxes.at(-1).right > root.clientWidth) found.push("the bar is cut off");
    // The numbers of the present moment are in sight without scrolling.
    const side = document.querySelector(".tab:not([hidden]) .simulate-side");
    const row = side?.querySelector(".deviation-row");
    if (row && row.getBoundingClientRect().bottom > side.getBoundingClientRect().bottom + 1)
      found.push("the deviations of the present moment are out of sight");
    return found;
  });

test("every tab fits", async (t) => {
  const { page, context, complaints } = await open(browser, server.address);
  await page.waitForSelector(".tab-link");
  for (const place of await placesOf(page)) {
    await t.test(place.name, async () => {
      await go(page, server.address, place);
      for (const [width, height] of SIZES) {
        await page.setViewportSize({ width, height });
        await page.waitForTimeout(200);
        assert.deepEqual(await misfits(page), [], `${width} × ${height}`);
      }
    });
  }
  assert.deepEqual(complaints, []);
  await context.close();
});
