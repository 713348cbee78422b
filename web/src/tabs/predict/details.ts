/** Everything else that the prediction says. */

import { tr, trText } from "../../words/index.ts";
import { diagnosticList } from "../../app.ts";
import { fill, h } from "../../dom.ts";
import { lineChart, type ChartSpec } from "../../figure/chart.ts";
import type { Figure } from "../../figure/figure.ts";
import { number } from "../../format.ts";
import { indicesOf, partOf, titleOf, type PieceDocument, type PieceFrame } from "./types.ts";

const micro = (value_mm: number | undefined, digits = 1): string =>
  number(value_mm === undefined ? null : 1e3 * value_mm, digits);
const th = (text: string, numeric = true): HTMLElement => h("th", { class: numeric ? "number" : "" }, text);
const td = (text: string): HTMLElement => h("td", { class: "number" }, text);
/** Of the axes where the zero is set. */
const UNITS = "   mm, °";

export class Details {
  private readonly chart_place = h("div", { class: "panel" });
  private readonly motion_place = h("div", { class: "panel motions" });
  private readonly tables = h("div");
  private chart: Figure<ChartSpec> | null = null;
  private motions: Figure<ChartSpec>[] = [];

  constructor(host: HTMLElement) {
    host.append(this.chart_place, this.tables, this.motion_place);
  }

  show(frame: PieceFrame, before: PieceDocument | null): void {
    const { document } = frame.header;
    this.showChart(frame);
    fill(
      this.tables,
      warnings(frame),
      monteCarlo(document),
      variants(document, before),
      positions(document),
      setting(document),
    );
    this.showMotions(frame);
  }

  private showChart(frame: PieceFrame): void {
    const { sections } = frame.header;
    const degrees = (i: number): Float64Array =>
      Float64Array.from(partOf(frame.f32("azimuth_rad"), sections, i), (a) => (a * 180) / Math.PI);
    const spec: ChartSpec = {
      title: tr`Error along the azimuth, positive: material left`,
      x: { label: tr`azimuth`, unit: "°", digits: 0 },
      y: { label: tr`error`, unit: "µm", digits: 1 },
      series: sections.map((section, i) => ({
        name: tr`position ${i + 1}, z = ${number(section.z_mm, 0)} mm`,
        x: degrees(i),
        y: partOf(frame.f32("error_um"), sections, i),
      })),
    };
    if (this.chart) this.chart.update(spec);
    else this.chart = lineChart(this.chart_place, spec);
  }

  private showMotions(frame: PieceFrame): void {
    const { document, sections, rotary } = frame.header;
    const azimuth = Float64Array.from(partOf(frame.f32("azimuth_rad"), sections, 0), (a) => (a * 180) / Math.PI);
    const names = Object.keys(document.commands[0] ?? {});
    const specs = names.map(
      (name): ChartSpec => ({
        title: tr`Motion of ${name}`,
        x: { label: tr`azimuth`, unit: "°", digits: 0 },
        y: { label: name, unit: rotary.includes(name) ? "°" : "mm", digits: 3 },
        series: [{ name, x: azimuth, y: document.commands.map((command) => command[name] ?? NaN) }],
        height: 190,
      }),
    );
    if (this.motions.length === specs.length) specs.forEach((spec, i) => this.motions[i]?.update(spec));
    else {
      for (const old of this.motions) old.dispose();
      this.motions = specs.map((spec) => lineChart(this.motion_place, spec));
    }
  }
}

function warnings(frame: PieceFrame): HTMLElement | null {
  const { document, diagnostics } = frame.header;
  if (document.warnings.length + diagnostics.length === 0) return null;
  return h(
    "section",
    { class: "panel" },
    h("h2", {}, tr`Warnings`),
    h(
      "ul",
      { class: "warnings" },
      document.warnings.map((text) => h("li", { lang: trText(text) === text ? "en" : null }, trText(text))),
    ),
    diagnostics.length > 0 ? diagnosticList(diagnostics) : null,
  );
}

function monteCarlo(document: PieceDocument): HTMLElement | null {
  const sampled = document.monte_carlo;
  if (!sampled) return null;
  const rows = [...indicesOf(document.indices)].filter(([, value]) => value.monte_carlo);
  if (rows.length === 0) return null;
  return h(
    "section",
    { class: "panel", dataTest: "monte-carlo" },
    h(
      "div",
      { class: "panel-head" },
      h("h2", {}, tr`Monte Carlo, µm`),
      h("span", { class: "muted" }, tr`JCGM 101, ${sampled.samples} samples, seed ${sampled.seed}`),
    ),
    h(
      "table",
      {},
      h(
        "thead",
        {},
        h("tr", {}, th(tr`index`, false), th(tr`mean`), th("u"), th(tr`u, linear`), th(tr`95 % interval`)),
      ),
      h(
        "tbody",
        {},
        rows.map(([key, { monte_carlo: spread, u_mm }]) =>
          h(
            "tr",
            { dataIndex: key },
            h("td", {}, titleOf(key)),
            td(micro(spread?.mean_mm)),
            td(micro(spread?.u_mm, 2)),
            td(micro(u_mm, 2)),
            td(`${micro(spread?.interval_95_mm[0])} … ${micro(spread?.interval_95_mm[1])}`),
          ),
        ),
      ),
    ),
  );
}

/** The same part set up otherwise, as the study compares it. */
function variants(document: PieceDocument, before: PieceDocument | null): HTMLElement | null {
  if (document.variants.length === 0) return null;
  const keys = document.judgements.map((j) => j.index);
  const own = indicesOf(document.indices);
  return h(
    "section",
    { class: "panel" },
    h("h2", {}, tr`Compared, µm`),
    h(
      "table",
      {},
      h(
        "thead",
        {},
        h(
          "tr",
          {},
          th(tr`set up`, false),
          keys.map((key) => th(titleOf(key))),
        ),
      ),
      h(
        "tbody",
        {},
        h(
          "tr",
          {},
          h("td", {}, before ? tr`as changed` : tr`as in the study`),
          keys.map((key) => td(micro(own.get(key)?.value))),
        ),
        document.variants.map((v) =>
          h(
            "tr",
            {},
            h("td", {}, v.name),
            keys.map((key) => td(micro(v.indices_mm[key]))),
          ),
        ),
      ),
    ),
  );
}

function positions(document: PieceDocument): HTMLElement {
  const first = document.positions[0];
  const keys = first ? [...indicesOf(first).keys()].filter((key) => /^(roundness|coaxiality)/.test(key)) : [];
  return h(
    "section",
    { class: "panel" },
    h("h2", {}, tr`At every position, µm`),
    h(
      "table",
      {},
      h(
        "thead",
        {},
        h(
          "tr",
          {},
          th(tr`index`, false),
          document.positions.map((p) => th(`z = ${number(p.z_mm, 0)} mm`)),
        ),
      ),
      h(
        "tbody",
        {},
        keys.map((key) =>
          h(
            "tr",
            {},
            h("td", {}, titleOf(key)),
            document.positions.map((p) => td(micro(indicesOf(p).get(key)?.value))),
          ),
        ),
      ),
    ),
  );
}

function setting(document: PieceDocument): HTMLElement {
  const at = Object.entries(document.setting_command).map(([name, value]) => `${name} ${number(value, 4)}`);
  return h(
    "section",
    { class: "panel" },
    h("h2", {}, tr`Part zero is set at`),
    h("p", { class: "numbers" }, at.join("   "), h("span", { class: "muted" }, UNITS)),
    document.temperature_log ? h("p", {}, tr`temperatures of `, h("code", {}, document.temperature_log)) : null,
  );
}
