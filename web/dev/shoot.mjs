// Pictures of the page: node dev/shoot.mjs OUT_FOLDER ADDRESS HASH... ; light and dark, two sizes.
// Prints every console message, failed request and page error.
import { chromium } from "playwright-core";

const [out, address, ...hashes] = process.argv.slice(2);
const browser = await chromium.launch({ executablePath: "/usr/bin/chromium", args: ["--use-angle=swiftshader", "--enable-unsafe-swiftshader"] });
const sizes = process.env.SIZES ? process.env.SIZES.split(",") : ["1400x900", "820x1100"];
const themes = process.env.THEMES ? process.env.THEMES.split(",") : ["light", "dark"];
for (const size of sizes) {
  const [width = 1400, height = 900] = size.split("x").map(Number);
  for (const colorScheme of themes) {
    const page = await browser.newPage({ viewport: { width, height }, colorScheme: /** @type {"light"} */ (colorScheme) });
    page.on("console", (m) => console.log(`[${m.type()}] ${m.text()}`));
    page.on("pageerror", (e) => console.log(`[pageerror] ${e.stack}`));
    page.on("requestfailed", (r) => console.log(`[failed] ${r.url()}`));
    for (const hash of hashes) {
      await page.goto(`${address}#${hash}`);
      await page.waitForTimeout(Number(process.env.WAIT ?? 1800));
      await page.screenshot({ path: `${out}/${hash.replace(/[^\w-]+/g, "_")}-${size}-${colorScheme}.png` });
    }
    await page.close();
  }
}
await browser.close();
