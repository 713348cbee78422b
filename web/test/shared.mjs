// One server on the project and one browser for all tests of a file. Each file runs in a process of its own.

import { after, before } from "node:test";
import { browse, serve } from "./served.mjs";

export let server;
export let browser;

before(async () => {
  server = await serve();
  browser = await browse();
});

after(async () => {
  await browser?.close();
  await server?.stop();
});
