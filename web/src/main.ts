import "./style/base.css";
import "./style/layout.css";
import "./style/controls.css";
import "./style/figure.css";
import "./style/scene.css";
import "./style/tabs.css";
import "./style/describe.css";
import "./style/measure.css";
import "./style/compensate.css";
import "./style/predict.css";
import "./style/simulate.css";
import "./style/simulate-source.css";
import "./style/file-dialog.css";
import "./style/set-up.css";
import "./style/simulate-time.css";
import "./style/live.css";
import "./style/dialog.css";
import { startTheme } from "./theme.ts";
import { language, loadLanguage } from "./words/index.ts";

startTheme();
document.documentElement.lang = language();
// Without its dictionary the page is English.
await loadLanguage().catch(console.error);
// Only now, as constants of its modules hold texts.
const { App } = await import("./app.ts");
const root = document.getElementById("app");
if (root) void new App(root).start();
