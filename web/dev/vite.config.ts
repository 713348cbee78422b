import { defineConfig } from "vite";

// `npm run dev`: the page as it is being written, answered by a running `trueaxis serve --port 7841 --no-token`
// (or SERVER=http://127.0.0.1:PORT). The server asks for its own origin, so the proxy names that.
const server = process.env.SERVER ?? "http://127.0.0.1:7841";
const answered = {
  target: server,
  ws: true,
  changeOrigin: true,
  headers: { origin: server },
};

export default defineConfig({
  root: new URL("..", import.meta.url).pathname,
  server: { fs: { allow: [".."] }, proxy: { "/api": answered, "/report": answered, "/made": answered } },
});
