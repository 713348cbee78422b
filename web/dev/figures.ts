/** Every figure once, with made-up data: to look at, not in the build. */

import "../src/style/base.css";
import "../src/style/layout.css";
import "../src/style/controls.css";
import "../src/style/figure.css";
import "../src/style/scene.css";
import "../src/style/tabs.css";
import fixture from "./fixtures/i5-engraver.json";
import type { MachineDescription } from "../src/api.ts";
import { h } from "../src/dom.ts";
import { bars, diverging, heatmap, lineChart, polar, scatter, sparkline } from "../src/figure/index.ts";
import { timePlot } from "../src/plot/timeplot.ts";
import { MachineView } from "../src/scene/view.ts";
import { startTheme } from "../src/theme.ts";

startTheme();
const grid = h("div", { style: { display: "grid", gridTemplateColumns: "repeat(auto-fit, minmax(380px, 1fr))", gap: "18px", padding: "16px", background: "var(--surface)" } });
document.body.append(grid);
const cell = (): HTMLElement => grid.appendChild(h("div"));
const range = (n: number): number[] => Array.from({ length: n }, (_, i) => i);

lineChart(cell(), {
  title: "Positioning deviation of X",
  x: { label: "position", unit: "mm", digits: 0 },
  y: { label: "deviation", unit: "µm", digits: 1 },
  series: [
    { name: "up", x: range(21).map((i) => 100 * i), y: range(21).map((i) => 3 * Math.sin(i / 4) + 0.3 * i), u: range(21).map(() => 0.6), points: true },
    { name: "down", x: range(21).map((i) => 100 * i), y: range(21).map((i) => 3 * Math.sin(i / 4) + 0.3 * i - 1.4), dash: "5 3" },
  ],
  limits: [{ value: 9, label: "tolerance 9 µm" }],
});
scatter(cell(), { title: "Residuals", x: { label: "x", unit: "mm" }, y: { label: "y", unit: "mm" }, equal: true, series: [{ name: "before", x: range(80).map((i) => 40 * Math.cos(i)), y: range(80).map((i) => 30 * Math.sin(1.7 * i)) }] });
const angles = range(361).map((i) => (i * Math.PI) / 180);
polar(cell(), {
  title: "Roundness at section 3",
  unit: "µm",
  radius_mm: 60,
  axes: ["X", "Y"],
  series: [{ name: "predicted", angle_rad: angles, deviation: angles.map((a) => 6 * Math.cos(2 * a) + 3 * Math.sin(a) + (a > 3.1 && a < 3.2 ? 4 : 0)) }],
  circles: [{ name: "least squares", x: 0.2, y: 3, radius: 0.5 }],
});
bars(cell(), { title: "Who is to blame", unit: "µm", bars: [{ name: "EC0Y", value: 12.3, u: 1.1 }, { name: "EXX", value: -7.25, u: 0.4, colour: "var(--series-2)" }, { name: "EA0C", value: 3.1 }, { name: "EZZ", value: -0.4 }], limit: { value: 10, label: "10 µm" } });
const names = ["EX0C", "EY0C", "EA0C", "EB0C", "EX0A", "EY0A", "EB0A", "EC0A"];
heatmap(cell(), { title: "Correlation", rows: names, columns: names, values: range(64).map((i) => { const [a, b] = [Math.floor(i / 8), i % 8]; return a === b ? 1 : Math.sin(a * b + a + b) * 0.8; }) });
cell().append(h("p", {}, "sparkline ", sparkline({ x: range(40), y: range(40).map((i) => Math.sin(i / 5)), label: "EXX over X", at: 12 })));
const n = 20_000;
const time = Float64Array.from({ length: n }, (_, i) => i * 0.01);
const curve = (k: number): Float64Array => time.map((t) => 40 * Math.sin(k * t) + 4 * Math.sin(40 * t));
const wide = grid.appendChild(h("div", { style: { gridColumn: "1 / -1" } }));
for (const [i, name] of ["X", "C"].entries()) timePlot(wide, { title: `Velocity of ${name}`, unit: i ? "deg/s" : "mm/s", time_s: time, series: [{ name, values: curve(0.1 + 0.1 * i), low: curve(0.1 + 0.1 * i).map((v) => v - 5), high: curve(0.1 + 0.1 * i).map((v) => v + 5), colour: i }], limits: [{ value: 48, label: "limit 48" }], marks: [{ time_s: 60, label: "over-travel", kind: "error" }] }, { group: "demo" }).setTime(90);

const scene = grid.appendChild(h("div", { style: { position: "relative", height: "520px" } }));
const view = new MachineView(scene);
view.setMachine(fixture as unknown as MachineDescription);
const count = Number(new URLSearchParams(location.search).get("points") ?? 100_000);
const positions = new Float32Array(3 * count);
const values = new Float32Array(count);
for (let i = 0; i < count; i++) {
  const a = (i / count) * 400;
  positions.set([60 * Math.cos(a) * (1 - i / count), 60 * Math.sin(a) * (1 - i / count), 60 * (i / count)], 3 * i);
  values[i] = 10 * Math.sin(a / 20) + 10;
}
view.setPath({ positions, origin: [0, 0, 0], values, deviations: positions.map((v) => v * 1e-4) }, { title: "deviation", unit: "µm" });
view.setPathProgress(0.7 * count);

const scene2 = grid.appendChild(h("div", { style: { position: "relative", height: "520px" } }));
const cone = new MachineView(scene2);
cone.setMachine({ ...(fixture as unknown as MachineDescription), models: [], links: [] });
const [rings, m] = [24, 72];
const points = new Float32Array(3 * rings * m);
const moved = new Float32Array(3 * rings * m);
const error = new Float32Array(rings * m);
for (let r = 0; r < rings; r++)
  for (let j = 0; j < m; j++) {
    const k = r * m + j;
    const a = (2 * Math.PI * j) / m;
    const radius = 180 - 3 * r;
    points.set([radius * Math.cos(a), radius * Math.sin(a), 12 * r], 3 * k);
    const e = 6 * Math.cos(2 * a) + r / 6;
    error[k] = e;
    moved.set([(e / 1000) * Math.cos(a), (e / 1000) * Math.sin(a), 0], 3 * k);
  }
cone.setSurface({ positions: points, rings, points_per_ring: m, closed: true, displacements: moved, values: error, map: diverging, range: [-10, 10] }, { title: "normal", unit: "µm" });
cone.setExaggeration(3000);

/** Frames per second while the picture turns, for the note. */
(window as unknown as { measureFrames: () => Promise<number> }).measureFrames = async () => {
  const started = performance.now();
  let frames = 0;
  while (performance.now() - started < 4000) {
    view.setPathProgress(count * (0.5 + 0.5 * Math.sin(frames / 10)));
    await new Promise((resolve) => requestAnimationFrame(resolve));
    frames += 1;
  }
  return (1000 * frames) / (performance.now() - started);
};

/** Milliseconds of one drawn frame, until its pixels are there. */
(window as unknown as { measureDraw: () => number[] }).measureDraw = () => {
  const canvas = view.element.querySelector("canvas");
  const gl = canvas?.getContext("webgl2");
  return [1, 0.5, 0.5].map((share) => {
    view.setPathProgress(count * share);
    const started = performance.now();
    (view as unknown as { render: () => void }).render();
    gl?.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, new Uint8Array(4));
    return performance.now() - started;
  });
};
