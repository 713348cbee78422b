// Checks of what needs no browser: number formats and the binary frame. `node test/unit.mjs`
import assert from "node:assert/strict";
import { createServer } from "vite";

const vite = await createServer({
  server: { middlewareMode: true, hmr: false, ws: false },
  appType: "custom",
  logLevel: "error",
});
const format = await vite.ssrLoadModule("/src/format.ts");
const { decodeFrame, encodeFrame } = await vite.ssrLoadModule("/src/frame.ts");
const { thinned } = await vite.ssrLoadModule("/src/scene/layers.ts");

// As Rust prints: format!("{:.1}", 0.25) is 0.2, ("{:.0}", 2.5) is 2, ("{:.0}", 3.5) is 4, ("{:.2}", 1.005) is 1.00.
for (const [value, digits, text] of [
  [0.25, 1, "0.2"],
  [0.35, 1, "0.3"],
  [0.75, 1, "0.8"],
  [2.5, 0, "2"],
  [3.5, 0, "4"],
  [-2.5, 0, "-2"],
  [1.005, 2, "1.00"],
  [-0.04, 1, "0.0"],
  [29.1234, 1, "29.1"],
  [1234567.5, 0, "1234568"],
]) {
  assert.equal(format.fixed(value, digits), text, `${value} to ${digits}`);
}
assert.equal(format.um(29.1234), "29.1\u202fµm");
assert.equal(format.um(-3.25), "\u22123.2\u202fµm");
assert.equal(format.um(Number.NaN), "–");
assert.equal(format.withUncertainty(12, 1, 1, "µm"), "12.0\u202f±\u202f1.0\u202fµm");
assert.equal(format.factor(50_000), "×50\u202f000");
assert.equal(format.clock(125.34), "2:05.3");
assert.equal(format.clock(15718.88), "4\u202fh 21\u202fmin 58.9\u202fs");
assert.equal(format.clock(3599.94), "59:59.9");
assert.equal(format.clock(3599.96), "1\u202fh 0\u202fmin 0.0\u202fs");
assert.equal(format.clockUnit(15718.88), "");
assert.equal(format.clockUnit(59), " min:s");
assert.equal(format.duration(313.6), "5\u202fmin 13.6\u202fs");

const sent = { a: Float64Array.of(1 / 3, -2), b: Uint8Array.of(1, 2, 3), c: Float32Array.of(0.5) };
const frame = decodeFrame(encodeFrame({ id: 7, what: "x" }, sent));
assert.equal(frame.header.id, 7);
assert.deepEqual(frame.f64("a"), sent.a);
assert.deepEqual(frame.u8("b"), sent.b);
assert.deepEqual(frame.f32("c"), sent.c);
assert.throws(() => frame.f64("b"), /no Float64Array "b"/);
assert.throws(() => decodeFrame(new ArrayBuffer(2)), /shorter/);
assert.throws(() => decodeFrame(encodeFrame({}, sent).slice(0, -16)), /cut off/);

const n = 100_000;
const circle = new Float32Array(3 * n).map((_, i) =>
  i % 3 === 0 ? Math.cos(i / n) : i % 3 === 1 ? Math.sin(i / n) : 0,
);
const kept = thinned(circle, new Float32Array(n), undefined, [0, 0], 5000);
assert.ok(kept.length > 500 && kept.length <= 5000 && kept[0] === 0 && kept.at(-1) === n - 1, `${kept.length} kept`);

const { Lines } = await vite.ssrLoadModule("/src/tabs/simulate/lines.ts");
for (const [text, lines] of [
  ["", []],
  ["a", ["a"]],
  ["a\r\n\nb\n", ["a", "", "b"]],
  ["\n", [""]],
]) {
  const read = new Lines(text);
  assert.deepEqual(
    Array.from({ length: read.count }, (_, i) => read.line(i + 1)),
    lines,
    JSON.stringify(text),
  );
}
const found = new Lines("G0 X1\nG1 x2\n\nM30\n");
for (const [words, from, step, line] of [
  ["x", 1, 1, 2],
  ["x", 2, 1, 1],
  ["X", 1, -1, 2],
  ["x1", 4, -1, 1],
  ["m30", 1, 1, 4],
  ["m30", 4, 1, 4],
  ["y", 1, 1, null],
  ["", 1, 1, null],
])
  assert.equal(found.find(words, from, step), line, `${words} from ${from}`);
const many = new Lines(Array.from({ length: 100_000 }, (_, i) => `N${i}`).join("\n"));
assert.equal(many.count, 100_000);
assert.equal(many.line(99_999), "N99998");
assert.equal(many.line(100_001), "");
const { Draft } = await vite.ssrLoadModule("/src/tabs/describe/draft.ts");
const draft = new Draft("m.toml", "a", "1");
assert.ok(draft.edit("b") && draft.edit("c") && !draft.edit("c") && draft.dirty);
assert.ok(draft.undo() && draft.text === "b" && draft.redo() && draft.text === "c" && !draft.redo());
draft.adopt("theirs", "2");
assert.ok(!draft.dirty && draft.version === "2" && draft.undo() && draft.text === "c" && draft.dirty);
assert.ok(
  draft.edit("d") &&
    !draft.canRedo &&
    draft.undo() &&
    draft.undo() &&
    draft.undo() &&
    !draft.undo() &&
    draft.text === "a",
);

const { errorWords } = await vite.ssrLoadModule("/src/tabs/describe/words.ts");
const links = [
  ["w", "workpiece", [0, 0, 1]],
  ["X", "linear", [1, 0, 0]],
  ["C", "rotary", [0, 0, 1]],
  ["B", "rotary", [0, 0.6, 0.8]],
].map(([name, kind, direction]) => ({ name, kind, direction }));
for (const [name, body, kind, words] of [
  ["EXX", 1, "motion", "positioning of X"],
  ["EYX", 1, "motion", "straightness in Y of X"],
  ["EAX", 1, "motion", "roll of X"],
  ["ECX", 1, "motion", "tilt about Z of X"],
  ["EXC", 2, "motion", "radial error motion in X of C"],
  ["EZC", 2, "motion", "axial error motion of C"],
  ["ECC", 2, "motion", "angular positioning of C"],
  ["EAB", 3, "motion", "error motion about X of B"],
  ["EC0X", 1, "location", "orientation of X about Z"],
  ["EX0w", 0, "location", "position of workpiece in X"],
])
  assert.equal(errorWords({ name, body, kind }, links), words);

const { nameBeside } = await vite.ssrLoadModule("/src/tabs/describe/head.ts");
assert.equal(nameBeside("a/m.toml", new Set(["a/m.toml", "a/m-2.toml"])), "a/m-3.toml");
const words = await vite.ssrLoadModule("/src/tabs/measure/words.ts");
for (const [value, text] of [
  [0.9196, "0.920"],
  [1.268, "1.27"],
  [10.00004, "10.0"],
  [313.4, "313"],
  [0, "0.00"],
  [-24.26, "\u221224.3"],
  [null, "–"],
])
  assert.equal(words.significant(value), text, `${value}`);
for (const [time_s, text] of [
  [31, "31.0\u202fs"],
  [59.96, "1\u202fmin 0.0\u202fs"],
  [313.63, "5\u202fmin 13.6\u202fs"],
])
  assert.equal(words.duration(time_s), text);

const { setUpText, wrongNumber } = await vite.ssrLoadModule("/src/tabs/simulate/setuptext.ts");
const nothing = { value: "", unit: "mm" };
const form = {
  program: 'a "b".nc',
  control: "fanuc",
  offset: "G55",
  positions: { X: { value: "1,5", unit: "mm" }, C: { value: "-90", unit: "deg" }, Z: nothing },
  start: { Z: nothing },
  tools: [
    { number: "3", name: "end mill", length: "90", diameter: "6", holder_diameter: "32", holder_length: "30" },
    { number: "", name: "", length: "", diameter: "", holder_diameter: "", holder_length: "" },
  ],
  stock: { edges: ["10", "20", "30"], centre: ["", "", "-15"] },
  fixtures: [{ file: "", placement: "" }],
};
const text = setUpText(form);
for (const line of [
  'name = "a \\"b\\".nc"',
  'workpiece_at = "G55"',
  'X = "1.5 mm"',
  'C = "-90 deg"',
  "[tool.3]",
  'shape = [["6 mm", "60 mm"], ["32 mm", "30 mm"]]',
  'box = "10 20 30 mm"',
  'placement = "0 0 -15 mm"',
])
  assert.ok(text.split("\n").includes(line), `${line} in\n${text}`);
assert.ok(!/Z =|start|fixture|\[tool\.\]/.test(text), text);
assert.equal(wrongNumber("9o"), '"9o" is not a number');
assert.equal(wrongNumber("0", 0), "must be greater than 0");
assert.equal(wrongNumber(""), null);
// Readings with a comma or a point, a real minus sign, in any order of columns; what is no number is named.
const { Sheet, plainNumber } = await vite.ssrLoadModule("/src/tabs/measure/sheet.ts");
for (const [text, plain] of [
  ["1,5", "1.5"],
  [" \u22122.25 ", "-2.25"],
  ["+.5e-1", "+.5e-1"],
  ["1.000,5", null],
  ["abc", null],
  ["", null],
])
  assert.equal(plainNumber(text), plain, text);
const column = (name, read) => ({ name, read });
const sheet = new Sheet({
  instrument: "laser",
  kind: "laser-line",
  file: "l.csv",
  named: false,
  there: false,
  columns: [column("X", false), column("deviation_um", true), column("group", false)],
  rows: [
    ["0", "", "0"],
    ["100", "", "1"],
  ],
  paths: [{ name: "X", stations: 2 }],
});
sheet.rows[1].cells[1] = "2,5";
sheet.repeat(1);
assert.deepEqual(sheet.rows[2].cells, ["100", "", "1"]);
assert.equal(sheet.csv(), "X,deviation_um,group\n100,2.5,1\n");
sheet.rows[0].cells[1] = "x";
assert.deepEqual(
  sheet.bad().map((cell) => cell.words),
  ["row 1: deviation_um \u201cx\u201d is no number"],
);
assert.deepEqual(sheet.take("a.csv", "# note\ndeviation_um;X;T\n1,5;0;20\n-2,5;50,5;20\n"), ["not used: T"]);
assert.equal(sheet.csv(), "# note\nX,deviation_um\n0,1.5\n50.5,-2.5\n");
// Without positions: one row for each station.
assert.deepEqual(sheet.take("b.csv", "deviation_um\n1\n2\n"), []);
assert.equal(sheet.csv(), "X,deviation_um,group\n0,1,0\n100,2,1\n");
assert.deepEqual(
  sheet.rows.map((row) => row.path),
  ["X", "X"],
);
assert.throws(() => sheet.take("c.csv", "deviation_um\n1\n"), /1 rows without positions, and there are 2 stations/);
assert.throws(() => sheet.take("d.csv", "X,angle_urad\n1,2\n"), /no column deviation_um/);

// A mapping file from what was chosen: a heading that stands twice is named by its number, runs are numbered.
const { mappingText, roles, wrongColumns } = await vite.ssrLoadModule("/src/tabs/standards/mappingtext.ts");
const chosen = (heading, role, unit = "", more = {}) => ({ heading, role, unit, negate: false, words: [], ...more });
const columns = [
  chosen("Pos", "target", "mm"),
  chosen("d", "up", "um"),
  chosen("d", "up", "um", { negate: true }),
  chosen("R", "direction", "", {
    words: [
      ["V", "up"],
      ['"Z"', "down"],
      ["?", ""],
    ],
  }),
  chosen("x", ""),
];
const names = roles(columns, ["up", "down"]);
assert.deepEqual(names, ["target", "up_1", "up_2", "direction", ""]);
assert.equal(wrongColumns(columns, names), null);
assert.match(wrongColumns(columns, ["target", "target", "", "", ""]), /Two columns are "target"/);
assert.match(wrongColumns([], []), /at least two columns/);
assert.equal(
  mappingText(
    "a/b.csv",
    { separator: "\t", decimal: ",", heading_line: 3, first_line: 3, rows_below_headings: 1, until: "Mean ", columns },
    names,
  ),
  `# What the columns of b.csv are.
separator = "tab"
decimal = ","
rows_below_headings = 1
skip_rows = 2
until = "Mean"

[columns.target]
column = "Pos"
unit = "mm"

[columns.up_1]
column = 2
unit = "um"

[columns.up_2]
column = 3
unit = "um"
sign = -1

[columns.direction]
column = "R"
words = { up = ["V"], down = ["\\"Z\\""] }
`,
);
const { tomlOf } = await vite.ssrLoadModule("/src/toml.ts");
const field = (section, key, kind) => ({ section, key, label: key, example: "", kind });
assert.equal(
  tomlOf("Heading", [field("", "name"), field("r", "date", "date"), field("r.i[]", "s", "texts"), field("e", "x")], {
    name: ' a "b" ',
    "r.date": "2026-11-28",
    "r.i[].s": "one, two",
  }),
  '# Heading\nname = "a \\"b\\""\n\n[r]\ndate = 2026-11-28\n\n[[r.i]]\ns = ["one", "two"]\n',
);

// What the server says, in another language: the rules of crates/trueaxis-words, with the cases of its tests.
const { entriesOf, lookupOf } = await vite.ssrLoadModule("/src/words/sentences.ts");
const file = `# figures
"{0n} of {1n} points" = "{0} von {1} Punkten"  # with a remark
"{0} of {1}" = "{0} von {1}"
"{1} before {0}" = "{0} nach {1}"
"a \\"quoted\\" text" = "„so“"
error = "Fehler"
"tool {0n}" = "Werkzeug {0}"
"{0}.nc on {1}" = "{0}.nc auf {1}"
"All is well." = "Alles ist gut."
"There remain {0n}." = "Es bleiben {0}."`;
const german = lookupOf(entriesOf(file));
for (const [text, said] of [
  ["3 of 5 points", "3 von 5 Punkten"],
  ["−3 of 5 points", "−3 von 5 Punkten"],
  ["all of 5 points", "all von 5 points"],
  ["error of EXX", "Fehler von EXX"],
  ["X before Y", "Y nach X"],
  ['a "quoted" text', "„so“"],
  ["EXX", undefined],
  ["2.5 µm", undefined],
  ["constructor", undefined],
  ["tool 5", "Werkzeug 5"],
  ["tool 5.nc", undefined],
  ["tool 5.nc on mill", "tool 5.nc auf mill"],
  ["All is well. There remain 5 µm.", "Alles ist gut. Es bleiben 5 µm."],
  ["All is well. Who knows.", undefined],
]) {
  assert.equal(german(text), said, text);
}
assert.equal(entriesOf(file).length, 9);

// A server that is busy is asked again, until the question is given up; an answer has the files that it was made from.
const { Api, filesOf } = await vite.ssrLoadModule("/src/api.ts");
const { Reads } = await vite.ssrLoadModule("/src/reads.ts");
const answers = [];
const questions = [];
class FakeSocket {
  static OPEN = 1;
  readyState = 1;
  constructor() {
    setTimeout(() => this.onopen());
  }
  send(words) {
    const { id, stop } = JSON.parse(words);
    if (stop) return;
    questions.push(id);
    setTimeout(() => this.onmessage({ data: JSON.stringify({ id, ...answers.shift() }) }));
  }
}
Object.assign(globalThis, { WebSocket: FakeSocket, location: { href: "http://127.0.0.1:1/", protocol: "http:" } });
const busy = { error: { code: "busy", message: "too much", hint: "", diagnostics: [] } };
const api = new Api();
answers.push(busy, busy, { reply: { text: "x" }, files_read: ["a.toml", "b.csv"] });
const reply = await api.ask("open", { path: "a.toml" });
assert.deepEqual([reply.text, questions.length, filesOf(reply)], ["x", 3, ["a.toml", "b.csv"]]);
answers.push({ ...busy, error: { ...busy.error, code: "conflict" } });
await assert.rejects(api.ask("open", { path: "a.toml" }), { code: "conflict" });
answers.push(busy);
const stopping = new AbortController();
const stopped = api.ask("open", { path: "a.toml" }, { signal: stopping.signal });
setTimeout(() => stopping.abort(), 60);
await assert.rejects(stopped, { name: "AbortError" });
assert.equal(questions.length, 5);

let asked_again = 0;
const reads = new Reads(() => (asked_again += 1));
const reading = reads.of(Promise.resolve(reply));
// Before the answer it is not known whether it has read the file; at its end it is.
assert.deepEqual([reads.isChangedBy("b.csv"), reads.isChangedBy("c.csv")], [false, false]);
await reading;
await new Promise((done) => setTimeout(done, 5));
assert.equal(asked_again, 1);
assert.deepEqual(
  ["a.toml", "c.csv", null].map((path) => reads.isChangedBy(path)),
  [true, false, true],
);
// A lost connection says nothing of files.
await assert.rejects(reads.of(Promise.reject(new Error("lost"))));
assert.equal(reads.isChangedBy("b.csv"), true);

await vite.close();
console.log("unit checks passed");
