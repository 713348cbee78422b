import "./style/base.css";
import "./style/layout.css";
import "./style/controls.css";
import "./style/figure.css";
import "./style/scene.css";
import "./style/tabs.css";
import "./style/describe.css";
import "./style/measure.css";
import "./style/predict.css";
import "./style/simulate.css";
import "./style/simulate-source.css";
import "./style/simulate-time.css";
import "./style/live.css";
import { App } from "./app.ts";
import { startTheme } from "./theme.ts";

startTheme();
const root = document.getElementById("app");
if (root) void new App(root).start();
