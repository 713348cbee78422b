// A stand-in for the server while the page is made: `project` and `describe` from fixtures, `pose`
// by the trueaxis program. Usage: TRUEAXIS=… node dev/mock.mjs FOLDER_OF_THE_BUILT_PAGE [PORT]
import { createHash } from "node:crypto";
import { execFile } from "node:child_process";
import { existsSync, readdirSync, readFileSync } from "node:fs";
import { createServer } from "node:http";
import { dirname, extname, join, normalize } from "node:path";
import { fileURLToPath } from "node:url";

const here = dirname(fileURLToPath(import.meta.url));
const root = join(here, "..", "..");
const [page = join(here, "..", "dist"), port = "8931"] = process.argv.slice(2);
const program = process.env.TRUEAXIS ?? join(root, "target", "release", "trueaxis");
const machines = readdirSync(join(here, "fixtures")).map((f) => f.replace(".json", ""));
const CSP =
  "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' data: blob:; connect-src 'self' ws: wss:; font-src 'self'; frame-src 'self' blob:; worker-src 'self'; base-uri 'none'; form-action 'none'";
const TYPES = { ".html": "text/html; charset=utf-8", ".js": "text/javascript; charset=utf-8", ".css": "text/css; charset=utf-8" };
const pad8 = (n) => (n + 7) & ~7;

/** @param {Record<string, unknown>} header @param {Record<string, Float64Array>} arrays */
function frame(header, arrays) {
  const list = Object.entries(arrays).map(([name, a]) => ({ name, type: "f64", count: a.length }));
  const text = Buffer.from(JSON.stringify({ ...header, arrays: list }));
  const parts = [Buffer.alloc(4), text, Buffer.alloc(pad8(4 + text.length) - 4 - text.length)];
  parts[0].writeUInt32LE(text.length);
  for (const a of Object.values(arrays)) parts.push(Buffer.from(a.buffer));
  return Buffer.concat(parts);
}

function project() {
  const title = { "i5-engraver": "Engraver with a tilting table", xkas2525: "Gantry with a fork head", "three-axis-mill": "Three-axis mill", "nutating-head": "Nutating head" };
  const examples = Object.entries(title).map(([m, t]) => ({ tab: "describe", title: t, what: JSON.parse(readFileSync(join(here, "fixtures", `${m}.json`), "utf8")).check.chain, path: `machines/${m}/machine.toml`, machine: `machines/${m}/machine.toml` }));
  const files = [];
  const walk = (dir) => {
    for (const e of readdirSync(join(root, dir), { withFileTypes: true })) {
      const path = `${dir}/${e.name}`;
      if (e.isDirectory()) walk(path);
      else files.push({ path, bytes: readFileSync(join(root, path)).length, kind: e.name === "machine.toml" ? "machine" : /\.setup\.toml$/.test(e.name) ? "setup" : /\.(nc|mpf)$/.test(e.name) ? "program" : /\.csv$/.test(e.name) ? "readings" : /\.cls$/.test(e.name) ? "cl" : "other" });
    }
  };
  walk("machines");
  walk("examples");
  return { folder: "/home/me/my-machines", version: "0.0", examples, files };
}

function pose(body) {
  const at = Object.entries(body.at).map(([k, v]) => `${k}=${v}`).join(" ");
  return new Promise((resolve, reject) => {
    execFile(program, ["pose", join(root, body.machine), "--at", at, "--bodies", "--format", "json"], (error, out, problem) => {
      if (!out) return reject({ code: "pose", message: problem.split("\n")[0] || String(error), hint: "keep the axes within their travel" });
      const { bodies, ...doc } = JSON.parse(out);
      const flat = (which) => Float64Array.from(bodies.flatMap((b) => [...b[which].rotation.flat(), ...b[which].origin_mm]));
      resolve({ header: { pose: doc, bodies: bodies.map((b) => b.body) }, arrays: { nominal: flat("nominal"), actual: flat("actual") } });
    });
  });
}

async function answer(name, body) {
  if (name === "project") return { reply: project() };
  if (name === "describe") {
    const machine = machines.find((m) => body.machine === `machines/${m}/machine.toml`);
    if (!machine) throw { code: "not-found", message: `there is no ${body.machine}`, hint: "choose a file of the list" };
    const doc = JSON.parse(readFileSync(join(here, "fixtures", `${machine}.json`), "utf8"));
    // For looking at the schematic of a machine that has models.
    if (process.env.NO_MODELS) doc.models = [];
    return { reply: doc };
  }
  if (name === "pose") return pose(body);
  throw { code: "unknown-name", message: `the mock does not answer ${name}`, hint: "run trueaxis serve" };
}

const server = createServer((request, response) => {
  const path = normalize(new URL(request.url ?? "/", "http://x").pathname).replace(/^\/$/, "/index.html");
  const file = join(page, path);
  if (!file.startsWith(page) || !existsSync(file)) return response.writeHead(404).end();
  response.writeHead(200, { "content-type": TYPES[extname(file)] ?? "application/octet-stream", "content-security-policy": CSP });
  response.end(readFileSync(file));
});

server.on("upgrade", (request, socket) => {
  const key = createHash("sha1").update(`${request.headers["sec-websocket-key"]}258EAFA5-E914-47DA-95CA-C5AB0DC85B11`).digest("base64");
  const chosen = request.headers["sec-websocket-protocol"] ? "Sec-WebSocket-Protocol: trueaxis\r\n" : "";
  socket.write(`HTTP/1.1 101 Switching Protocols\r\nUpgrade: websocket\r\nConnection: Upgrade\r\nSec-WebSocket-Accept: ${key}\r\n${chosen}\r\n`);
  const send = (data) => {
    const payload = Buffer.from(data);
    const size = payload.length < 126 ? 2 : payload.length < 65_536 ? 4 : 10;
    const head = Buffer.alloc(size);
    head[0] = typeof data === "string" ? 0x81 : 0x82;
    head[1] = size === 2 ? payload.length : size === 4 ? 126 : 127;
    if (size === 4) head.writeUInt16BE(payload.length, 2);
    if (size === 10) head.writeBigUInt64BE(BigInt(payload.length), 2);
    socket.write(Buffer.concat([head, payload]));
  };
  const receive = async (text) => {
    const { id, ask, body } = JSON.parse(text);
    try {
      const out = await answer(ask, body);
      send("reply" in out ? JSON.stringify({ id, reply: out.reply }) : frame({ id, ...out.header }, out.arrays));
    } catch (error) {
      send(JSON.stringify({ id, error: error.code ? error : { code: "mock", message: String(error) } }));
    }
  };
  let rest = Buffer.alloc(0);
  socket.on("data", (chunk) => {
    rest = Buffer.concat([rest, chunk]);
    while (rest.length >= 6) {
      let [length, at] = [rest[1] & 127, 2];
      if (length === 126) [length, at] = [rest.readUInt16BE(2), 4];
      if (rest.length < at + 4 + length) return;
      const opcode = rest[0] & 15;
      const mask = rest.subarray(at, at + 4);
      const data = Buffer.from(rest.subarray(at + 4, at + 4 + length)).map((b, i) => b ^ mask[i % 4]);
      rest = rest.subarray(at + 4 + length);
      if (opcode === 8) return socket.end();
      if (opcode === 1) void receive(data.toString());
    }
  });
  socket.on("error", () => {});
});

server.listen(Number(port), "127.0.0.1", () => console.log(`http://127.0.0.1:${port}/`));
