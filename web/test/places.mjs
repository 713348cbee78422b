// Every tab with something in it, as an address; for the tests that look at all of them.

/** Address, what shows that the answer has come, and what else to press, by the name of the tab. */
const PLACES = {
  start: [{ at: "start", ready: ".card" }],
  describe: [
    { at: "describe?machine=machines/xkas2525/machine.toml", ready: ".scene-note.actual" },
    {
      name: "errors",
      at: "describe?machine=machines/xkas2525/machine.toml",
      ready: ".scene-note.actual",
      press: '[data-page="errors"]',
    },
    {
      name: "file",
      at: "describe?machine=machines/xkas2525/machine.toml",
      ready: ".scene-note.actual",
      press: '[data-page="file"]',
    },
  ],
  simulate: [
    {
      at: "simulate?machine=machines/i5-engraver/machine.toml&program=examples/02_simulate/ring-fanuc.nc",
      ready: '.tab-simulate.simulated [data-test="to-largest"]',
      press: '[data-test="to-largest"]',
    },
    {
      name: "collision",
      at: "simulate?machine=machines/i5-engraver/machine.toml&program=examples/02_simulate/collision-fanuc.nc",
      ready: ".tab-simulate.simulated .timeline-mark.critical",
    },
  ],
  predict: [
    {
      at: "predict?study=examples/03_predict/nas979-head-out-of-square.toml",
      ready: '.predict-page:not([hidden]) [data-test="verdict"]',
    },
    {
      name: "what-if",
      at: "predict?study=examples/03_predict/nas979-head-out-of-square.toml",
      ready: '.predict-page:not([hidden]) [data-test="verdict"]',
      press: '[data-show="what-if"]',
    },
    {
      name: "numbers",
      at: "predict?study=examples/03_predict/nas979-head-out-of-square.toml",
      ready: '.predict-page:not([hidden]) [data-test="verdict"]',
      press: '[data-show="numbers"]',
    },
    { name: "holes", at: "predict?study=examples/03_predict/torque-arm.toml", ready: ".hole-plan .figure-svg" },
    {
      name: "part",
      at: "predict?study=examples/03_predict/housing.toml",
      ready: '.predict-page:not([hidden]) [data-test="verdict"]',
    },
  ],
  plan: [
    { at: "plan?campaign=examples/04_plan/touch-probe-5-minutes.toml", ready: '#tab-plan [data-test="confounded"]' },
  ],
  measure: [{ at: "measure?campaign=examples/04_plan/probe-ball.toml", ready: "#tab-measure table td" }],
  compensate: [
    {
      at: "compensate?of=program&machine=machines/xkas2525/machine.toml&program=examples/06_compensate/frustum.mpf",
      ready: "#tab-compensate table td, #tab-compensate .figure-svg",
    },
    {
      name: "tables",
      at: "compensate?of=tables&machine=machines/xkas2525/machine.toml&target=heidenhain",
      ready: "#tab-compensate table td",
    },
  ],
  verify: [{ at: "verify?file=examples/07_verify/probe-ball.toml", ready: "#tab-verify table td" }],
  identify: [
    {
      at: "identify?campaign=examples/05_identify/mixed-instruments.toml",
      ready: '#tab-identify [data-test="verdict"]',
    },
  ],
  standards: [
    {
      at: "standards?path=examples/07_verify/x-axis-laser.csv&standard=iso230-2",
      ready: "#tab-standards .picture .figure-svg",
    },
  ],
  live: [{ at: "live?plan=examples/08_live/gantry-mock.toml", ready: '#tab-live [data-test="state"]' }],
  report: [
    { at: "report", ready: "#tab-report select" },
    {
      name: "made",
      at: "report?verb=evaluate&file=examples/07_verify/x-axis-laser.csv&standard=iso230-2",
      ready: ".report-frame",
    },
  ],
};

/** Every tab of the bar: its places, or, for one that has none here, its first example or the tab alone. */
export async function placesOf(page) {
  const tabs = await page.locator(".tab-link").evaluateAll((links) => links.map((link) => link.dataset.tab));
  return tabs.flatMap((tab) =>
    (PLACES[tab] ?? [{ at: tab, ready: `#tab-${tab} > *` }]).map(({ name, ...place }) => ({
      name: name ? `${tab} ${name}` : tab,
      tab,
      ...place,
    })),
  );
}

/** Opens a place from a cold start and waits until it stands still. */
export async function go(page, address, { at, ready, press }) {
  await page.goto("about:blank");
  await page.goto(new URL(`#${at}`, address).href);
  await page.locator(ready).first().waitFor({ state: "attached" });
  if (press) await page.locator(press).first().click();
  // Figures follow the size of their place a frame later.
  await page.waitForTimeout(500);
}
