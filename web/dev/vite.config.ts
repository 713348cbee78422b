import { defineConfig } from "vite";

// The pages for looking at figures and scene without a server: `npm run dev`, then /figures.html.
export default defineConfig({
  root: import.meta.dirname,
  build: { rolldownOptions: { input: ["dev/figures.html"] }, modulePreload: false },
});
