// The texts of the page: what `tr` and `count` say in src, against the dictionaries in src/words.
//
//     npm run texts              prints the texts that a dictionary lacks, by file, as lines to translate
//     npm run texts -- --check   fails if one lacks, if a text has other values in a dictionary, stands in it twice or
//                                is used no more, and if an English text is shown without `tr`

import { readdirSync, readFileSync } from "node:fs";
import path from "node:path";
import { fileURLToPath } from "node:url";
import { parseAst } from "vite";

const web = path.resolve(path.dirname(fileURLToPath(import.meta.url)), "..");
const source = path.join(web, "src");
const LANGUAGES = ["de", "zh"];

/** Units, names and signs that are written the same in every language. */
const SAME = /\b(mm|µm|µrad|deg|rad|min|TrueAxis|trueaxis|live|CSV|PNG|SVG|LinuxCNC|Haas|Esc|VDI|DGQ)\b/g;
/** Properties that a person reads. */
const SHOWN = new Set(["ariaLabel", "title", "placeholder", "label", "hint", "note", "words"]);

const files = readdirSync(source, { recursive: true })
  .filter((name) => name.endsWith(".ts") && !name.startsWith("words"))
  .map((name) => path.join(source, name));

/** Every node of a tree, with those around it. */
function* nodes(node, around = []) {
  if (Array.isArray(node)) {
    for (const one of node) yield* nodes(one, around);
    return;
  }
  if (node === null || typeof node !== "object") return;
  if (typeof node.type === "string") yield [node, around];
  const inner = typeof node.type === "string" ? [...around, node] : around;
  for (const [key, value] of Object.entries(node)) if (key !== "type") yield* nodes(value, inner);
}

const keyOf = (template) =>
  template.quasis.map(({ value }, i) => value.cooked + (i < template.expressions.length ? `{${i}}` : "")).join("");
const textOf = (node) => (node.type === "TemplateLiteral" ? keyOf(node) : node.value);
const isText = (node) => node.type === "TemplateLiteral" || (node.type === "Literal" && typeof node.value === "string");
/** Two letters together that are no value, unit or name. */
const hasWords = (text) => /[A-Za-z]{2}/.test(text.replace(/\{\d+\}/g, "").replace(SAME, ""));

/** Whether a text is shown as it stands: a child of an element, or a property that is read. */
function isShown(node, around) {
  let inner = node;
  for (const outer of [...around].reverse()) {
    if (outer.type === "ConditionalExpression" && outer.test !== inner) inner = outer;
    else if (outer.type === "ArrayExpression" || outer.type === "TemplateLiteral") inner = outer;
    else if (outer.type === "LogicalExpression") inner = outer;
    else if (outer.type === "Property") return outer.value === inner && SHOWN.has(outer.key.name ?? outer.key.value);
    else if (outer.type === "AssignmentExpression")
      return outer.right === inner && ["textContent", "title"].includes(outer.left.property?.name);
    else if (outer.type === "CallExpression") {
      const at = outer.arguments.indexOf(inner);
      const first = { h: 2, s: 2, fill: 1 }[outer.callee.name];
      return first !== undefined && at >= first;
    } else return false;
  }
  return false;
}

/** Texts of one file: key → line, and the texts that are shown without `tr`. */
function textsOf(file) {
  const code = readFileSync(file, "utf8");
  const line = (node) => code.slice(0, node.start).split("\n").length;
  const texts = new Map();
  const bare = [];
  for (const [node, around] of nodes(parseAst(code, { lang: "ts" }))) {
    if (node.type === "TaggedTemplateExpression" && node.tag.name === "tr") texts.set(keyOf(node.quasi), line(node));
    if (node.type === "CallExpression" && node.callee.name === "count") {
      const [one, many] = node.arguments.slice(1).map((word) => word.value);
      for (const word of [one, many ?? `${one}s`]) texts.set(word, line(node));
    }
    const tagged = around.at(-1)?.type === "TaggedTemplateExpression";
    if (isText(node) && !tagged && isShown(node, around) && hasWords(textOf(node)))
      bare.push(`${path.relative(web, file)}:${line(node)}: ${JSON.stringify(textOf(node))} is shown without tr`);
  }
  return { texts, bare };
}

/** Entries of a dictionary in order, from all its files. */
function dictionary(language) {
  const folder = path.join(source, "words", language);
  const entries = [];
  for (const name of readdirSync(folder).filter((name) => name !== "index.ts")) {
    const tree = parseAst(readFileSync(path.join(folder, name), "utf8"), { lang: "ts" });
    for (const [node, around] of nodes(tree)) {
      if (node.type !== "Property") continue;
      const part = around.find((outer) => outer.type === "VariableDeclarator").id.name;
      entries.push({ key: node.key.value ?? node.key.name, text: node.value.value, file: name, part });
    }
  }
  return entries;
}

const values = (text) => [...new Set(text.match(/\{\d+\}/g) ?? [])].sort().join(" ");

function problemsOf(language, used) {
  const problems = [];
  const seen = new Map();
  const said = new Map();
  for (const { key, text, file, part } of dictionary(language)) {
    const at = `src/words/${language}/${file}: ${JSON.stringify(key)}`;
    const others = part === "texts" ? seen : said;
    // The server may say the same in two rooms, but not with two translations.
    if (others.has(key) && (part === "texts" || others.get(key)[1] !== text))
      problems.push(`${at} stands in ${others.get(key)[0]} too`);
    others.set(key, [file, text]);
    // What the server says is not in the sources of the page.
    if (part === "texts" && !used.has(key)) problems.push(`${at} is used no more`);
    if (values(key) !== values(text)) problems.push(`${at} has other values: ${JSON.stringify(text)}`);
  }
  for (const [key, place] of used)
    if (!seen.has(key)) problems.push(`${place}: ${JSON.stringify(key)} has no ${language}`);
  return problems;
}

const used = new Map();
const bare = [];
for (const file of files) {
  const found = textsOf(file);
  for (const [key, line] of found.texts) if (!used.has(key)) used.set(key, `${path.relative(web, file)}:${line}`);
  bare.push(...found.bare);
}

if (process.argv.includes("--check")) {
  const problems = [...bare, ...LANGUAGES.flatMap((language) => problemsOf(language, used))];
  for (const problem of problems) console.error(problem);
  if (problems.length > 0) process.exit(1);
} else {
  for (const language of LANGUAGES) {
    const texts = dictionary(language).filter(({ part }) => part === "texts");
    const known = new Set(texts.map(({ key }) => key));
    for (const [key, place] of used) if (!known.has(key)) console.log(`${language} ${place} ${JSON.stringify(key)}`);
  }
  for (const problem of bare) console.log(problem);
}
