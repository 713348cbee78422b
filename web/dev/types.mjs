// types.d.ts from docs/schemas: the documents, requests and answers of the server as TypeScript types.
//
//     npm run types              writes it
//     npm run types -- --check   fails if it is stale

import { readdirSync, readFileSync, writeFileSync } from "node:fs";
import path from "node:path";
import { fileURLToPath } from "node:url";
import { compile } from "json-schema-to-typescript";

const web = path.resolve(path.dirname(fileURLToPath(import.meta.url)), "..");
const folder = path.join(web, "../docs/schemas");
const file = path.join(web, "types.d.ts");

const PREFIX = "#/$defs/";

/** `serve-what-if` → `ServeWhatIf`. */
const pascal = (name) => name.replace(/(^|[-_])(\w)/g, (_, __, letter) => letter.toUpperCase());

/** The same schema with `change` applied to every object in it, from the inside. */
function mapped(schema, change) {
  if (Array.isArray(schema)) return schema.map((item) => mapped(item, change));
  if (schema === null || typeof schema !== "object") return schema;
  return change(Object.fromEntries(Object.entries(schema).map(([key, value]) => [key, mapped(value, change)])));
}

/** What a definition says when everything it refers to is written out; the same text, the same type. */
function writtenOut(name, defs, seen = []) {
  if (seen.includes(name)) return name;
  const whole = mapped(defs[name], (schema) =>
    schema.$ref ? { ...schema, $ref: writtenOut(schema.$ref.slice(PREFIX.length), defs, [...seen, name]) } : schema,
  );
  return JSON.stringify(whole);
}

/** The same schema in the form that the compiler understands: tuples in `items`, references and choices alone. */
function plain({ prefixItems, $ref, description, ...schema }) {
  if (prefixItems) Object.assign(schema, { items: prefixItems, additionalItems: false });
  const described = description === undefined ? {} : { description };
  if ($ref) {
    const rest = Object.keys(schema).length > 0 ? [schema] : [];
    return description === undefined && rest.length === 0 ? { $ref } : { ...described, allOf: [{ $ref }, ...rest] };
  }
  const { anyOf, oneOf, ...rest } = schema;
  const choice = anyOf ? { anyOf } : oneOf ? { oneOf } : null;
  return choice && rest.properties ? { ...described, allOf: [rest, choice] } : { ...described, ...schema };
}

/** All documents in one schema. Types of one name that differ between documents get that of the document, too. */
function merged() {
  const all = {};
  const texts = new Map();
  const documents = {};
  const roots = [];
  for (const entry of readdirSync(folder).sort()) {
    if (!entry.endsWith(".json")) continue;
    const document = entry.slice(0, -".json".length);
    const { $defs = {}, $schema, title, ...root } = JSON.parse(readFileSync(path.join(folder, entry), "utf8"));
    const names = new Map();
    for (const name of Object.keys($defs)) {
      const text = writtenOut(name, $defs);
      let own = pascal(name);
      if (texts.has(own) && texts.get(own) !== text) own = pascal(document) + own;
      texts.set(own, text);
      names.set(PREFIX + name, own);
    }
    const renamed = (schema) =>
      mapped(schema, (part) =>
        plain(typeof part.$ref === "string" ? { ...part, $ref: PREFIX + names.get(part.$ref) } : part),
      );
    for (const [name, schema] of Object.entries($defs)) {
      const own = names.get(PREFIX + name);
      all[own] = { ...renamed(schema), title: own };
    }
    roots.push([document, renamed(root)]);
  }
  for (const [document, root] of roots) {
    const own = texts.has(pascal(document)) ? `${pascal(document)}Document` : pascal(document);
    all[own] = { ...root, title: own };
    documents[document] = { $ref: PREFIX + own };
  }
  return {
    title: "Documents",
    description: "All documents by name.",
    type: "object",
    properties: documents,
    required: Object.keys(documents),
    $defs: all,
  };
}

const text = await compile(merged(), "Documents", {
  additionalProperties: false,
  bannerComment: "// Made by `npm run types` from docs/schemas; not edited by hand.",
  style: { printWidth: 120 },
});
if (process.argv.includes("--check")) {
  let there = "";
  try {
    there = readFileSync(file, "utf8");
  } catch {
    // Not made yet: stale.
  }
  if (there !== text) {
    console.error("types.d.ts is stale: npm run types");
    process.exit(1);
  }
} else {
  writeFileSync(file, text);
}
