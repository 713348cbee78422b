// The same control as server.py, by another implementation (npm node-opcua-server): axes that stand with their offsets, a heartbeat.
//
//     node server.mjs PORT FOLDER PACKAGES      PACKAGES: the folder that has node_modules
//
// Writes what it saw into FOLDER/seen.json when it ends by SIGTERM.
import { writeFileSync } from "node:fs";
import { createRequire } from "node:module";
import path from "node:path";

const [port, folder, packages] = process.argv.slice(2);
const require = createRequire(path.join(packages, "package.json"));
const { OPCUAServer } = require("node-opcua-server");
const { Variant, DataType } = require("node-opcua-variant");
const { StatusCodes } = require("node-opcua-status-code");
const { OPCUACertificateManager } = require("node-opcua-certificate-manager");
const { MessageSecurityMode, SecurityPolicy } = require("node-opcua-secure-channel");

const at = { X: 3500, Y: 2300, Z: 400 };
const values = { offsetX: 0, offsetY: 0, mode: 2, beat: 0 };
const flags = { referenced: true, running: true, inhibit: false, emergency: false, tripped: false, hold: false };
const kinds = { mode: DataType.Int16, beat: DataType.Byte };
const seen = { largest_mm: [0, 0], largest_step_mm: 0, beats: 0, offsets: [0, 0] };

function look(name, before, now) {
  const axis = ["offsetX", "offsetY"].indexOf(name);
  if (axis >= 0) {
    seen.largest_step_mm = Math.max(seen.largest_step_mm, Math.abs(now - before));
    seen.largest_mm[axis] = Math.max(seen.largest_mm[axis], Math.abs(now));
    seen.offsets[axis] = now;
  } else if (name === "beat") {
    seen.beats += Number(now !== before);
  }
}

const certificates = new OPCUACertificateManager({ rootFolder: path.join(folder, "server-pki"), automaticallyAcceptUnknownCertificate: true });
await certificates.initialize();
// Its own one names no address, and a client that looks refuses it.
const certificateFile = path.join(folder, "server.pem");
await certificates.createSelfSignedCertificate({
  applicationUri: "urn:trueaxis:test:node",
  dns: ["localhost"],
  ip: ["127.0.0.1"],
  outputFile: certificateFile,
  startDate: new Date(),
  subject: "/CN=control",
  validity: 365,
});
const server = new OPCUAServer({
  certificateFile,
  privateKeyFile: certificates.privateKey,
  port: Number(port),
  hostname: "127.0.0.1",
  serverInfo: { applicationUri: "urn:trueaxis:test:node" },
  buildInfo: { manufacturerName: "Maker", productName: "Control", softwareVersion: "1.0", buildNumber: "1", buildDate: new Date(0) },
  securityPolicies: [SecurityPolicy.None, SecurityPolicy.Basic256Sha256],
  securityModes: [MessageSecurityMode.None, MessageSecurityMode.Sign, MessageSecurityMode.SignAndEncrypt],
  serverCertificateManager: certificates,
  allowAnonymous: true,
  userManager: { isValidUser: (user, password) => user === "trueaxis" && password === "a secret" },
});
await server.initialize();
const space = server.engine.addressSpace.getOwnNamespace();

function add(name, dataType, get, set) {
  const value = { get: () => new Variant({ dataType, value: get() }) };
  if (set) {
    value.set = (variant) => {
      set(variant.value);
      return StatusCodes.Good;
    };
  }
  space.addVariable({ organizedBy: server.engine.addressSpace.rootFolder.objects, nodeId: `s=${name}`, browseName: name, dataType, value, minimumSamplingInterval: 10 });
}

for (const axis of Object.keys(at)) {
  add(axis, DataType.Double, () => at[axis] + (values[`offset${axis}`] ?? 0));
}
for (const name of Object.keys(values)) {
  const set = (now) => {
    look(name, values[name], now);
    values[name] = now;
  };
  add(name, kinds[name] ?? DataType.Double, () => values[name], set);
}
for (const name of Object.keys(flags)) {
  add(name, DataType.Boolean, () => flags[name], (now) => { flags[name] = now; });
}
await server.start();
console.log(`ready ${space.index}`);
process.on("SIGTERM", async () => {
  writeFileSync(path.join(folder, "seen.json"), JSON.stringify(seen));
  await server.shutdown(10);
  process.exit(0);
});
