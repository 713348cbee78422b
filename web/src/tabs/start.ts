/** The first page: what is shipped, one click each, and what the folder holds. */

import { tr, trText } from "../words/index.ts";
import type { App, Tab, TabHandle } from "../app.ts";
import { Refusal, type Example, type FileKind, type Project, type ProjectFile } from "../api.ts";
import { hashOf } from "../address.ts";
import { fill, h } from "../dom.ts";
import { keptFiles, MOST_BYTES, MOST_FILES, removeFile } from "../files.ts";
import { bytes } from "../format.ts";
import { readText, type TextFile } from "./measure/drop.ts";
import { newMachine } from "./start/newmachine.ts";

const VERBS: readonly [string, string, string][] = [
  ["describe", tr`Describe`, tr`What the machine is, and where its tool really is`],
  ["simulate", tr`Simulate`, tr`What it does with a program`],
  ["predict", tr`Predict`, tr`Whether the part will be good`],
  ["plan", tr`Plan`, tr`What to measure, and with what uncertainty`],
  ["measure", tr`Measure`, tr`Readings, station by station, and how well they repeat`],
  ["identify", tr`Identify`, tr`What the machine is like, from readings`],
  ["compensate", tr`Compensate`, tr`What the control has to add`],
  ["verify", tr`Verify`, tr`Whether it is as promised, and what has changed`],
  ["standards", tr`Standards`, tr`Readings judged by ISO 230`],
  ["live", tr`Live`, tr`What the correction in the control is doing`],
];

const KINDS: readonly [FileKind, string, string | null, string][] = [
  ["machine", tr`Machines`, "describe", "machine"],
  ["program", tr`Programs`, "simulate", "program"],
  ["study", tr`Studies`, "predict", "study"],
  ["campaign", tr`Campaigns`, "plan", "campaign"],
  ["readings", tr`Readings`, "standards", "path"],
  ["comparison", tr`Comparisons`, "verify", "file"],
  ["certificate", tr`Certificates`, "verify", "file"],
  ["measured", tr`Measured parts`, "verify", "file"],
  ["blank", tr`Paths on measured blanks`, "compensate", "study"],
  ["live", tr`Live runs`, "live", "plan"],
  ["setup", tr`Set-ups`, null, ""],
  ["cl", tr`Cutter locations`, null, ""],
];

/** Where an example of a tab keeps its path in the address. */
const PARAMETER: Record<string, string> = {
  describe: "machine",
  simulate: "program",
  predict: "study",
  plan: "campaign",
  measure: "campaign",
  identify: "campaign",
  compensate: "program",
  verify: "file",
  standards: "path",
  live: "plan",
};

function openExample(app: App, example: Example): void {
  const params: Record<string, string | null | undefined> = {
    machine: example.machine,
    standard: example.standard,
  };
  params[PARAMETER[example.tab] ?? "path"] ??= example.path;
  app.go(example.tab, params);
}

function cards(app: App, project: Project): HTMLElement[] {
  const groups: HTMLElement[] = [];
  for (const [tab, title, what] of VERBS) {
    const examples = project.examples.filter((example) => example.tab === tab);
    if (examples.length === 0 || !app.has(tab)) continue;
    groups.push(
      h(
        "section",
        { class: "verb", dataVerb: tab },
        h("div", { class: "verb-head" }, h("h2", {}, title), h("p", { class: "muted" }, what)),
        h(
          "ul",
          { class: "cards" },
          examples.map((example) =>
            h(
              "li",
              {},
              h(
                "button",
                { class: "card", dataExample: example.path, onclick: () => openExample(app, example) },
                h("strong", {}, trText(example.title)),
                h("span", {}, trText(example.what)),
              ),
            ),
          ),
        ),
      ),
    );
  }
  return groups;
}

function fileRow(app: App, file: ProjectFile, tab: string | null, parameter: string): HTMLElement {
  const name =
    tab && app.has(tab)
      ? h(
          "a",
          { href: `#${tab}?${new URLSearchParams({ [parameter]: file.path }).toString().replaceAll("%2F", "/")}` },
          file.path,
        )
      : h("span", {}, file.path);
  return h("tr", {}, h("td", {}, name), h("td", { class: "number muted" }, bytes(file.bytes)));
}

function files(app: App, project: Project): HTMLElement[] {
  return KINDS.flatMap(([kind, title, tab, parameter]) => {
    const rows = project.files.filter((file) => file.kind === kind);
    if (rows.length === 0) return [];
    return [
      h(
        "details",
        { class: "files", open: rows.length <= 12 },
        h("summary", {}, title, h("span", { class: "muted" }, ` ${rows.length}`)),
        h(
          "table",
          {},
          h(
            "tbody",
            {},
            rows.map((file) => fileRow(app, file, tab, parameter)),
          ),
        ),
      ),
    ];
  });
}

/** Which tab reads a dropped file, by its ending. Tabs that take it find it in `droppedFile()`. */
const ENDINGS: readonly [RegExp, string][] = [
  [/\.(nc|mpf|ngc|tap|gcode|h|spf|cnc|iso)$/i, "simulate"],
  [/\.(csv|txt|tsv|dat|rtl|rta|qif|md)$/i, "standards"],
];

let dropped: TextFile | null = null;

/** The file that was dropped on the first page, once. */
export function takeDropped(): TextFile | null {
  const file = dropped;
  dropped = null;
  return file;
}

async function take(app: App, file: File | undefined): Promise<void> {
  if (!file) return;
  const tab = ENDINGS.find(([ending]) => ending.test(file.name))?.[1];
  if (!tab || !app.has(tab)) {
    app.fail(
      new Refusal(
        "dropped-file",
        tr`${file.name} is not a file that this page opens by dropping`,
        tr`Drop an NC program or a CSV of readings; machine files and studies belong into the project folder.`,
      ),
    );
    return;
  }
  try {
    // Programs of old controls are not UTF-8: only remarks of them have other letters.
    dropped = tab === "standards" ? await readText(app, file) : { name: file.name, text: await file.text() };
    app.go(tab, { dropped: file.name });
  } catch (error) {
    app.fail(error);
  }
}

/** The dropped files that this browser keeps, each with a button that removes it. */
async function showKept(app: App, place: HTMLElement): Promise<void> {
  const { folder = "" } = app.state.project ?? {};
  const files = await keptFiles(folder);
  place.hidden = files.length === 0;
  const row = ({ name, bytes: size }: (typeof files)[number]): HTMLElement => {
    // What was stated of readings goes with them.
    const tab = ENDINGS.find(([ending]) => ending.test(name))?.[1] ?? (/\.toml$/i.test(name) ? null : "simulate");
    const remove = async (): Promise<void> => {
      await removeFile(folder, name);
      // What was stated of readings goes with them.
      if (tab) for (const ending of [".map.toml", ".toml"]) await removeFile(folder, name.replace(/\.[^.]*$/, ending));
      await showKept(app, place);
    };
    return h(
      "tr",
      {},
      h("td", {}, tab ? h("a", { href: hashOf(tab, { dropped: name }) }, name) : name),
      h("td", { class: "number muted" }, bytes(size)),
      h(
        "td",
        { class: "number" },
        h("button", { ariaLabel: tr`Remove ${name}`, onclick: () => void remove() }, tr`Remove`),
      ),
    );
  };
  fill(
    place,
    h("h3", {}, tr`Dropped files`),
    h(
      "p",
      { class: "muted" },
      tr`Kept by this browser for a reload, at most ${MOST_FILES} files and ${bytes(MOST_BYTES)}; the oldest go first.`,
    ),
    h("table", {}, h("tbody", {}, files.map(row))),
  );
}

function dropZone(app: App): HTMLElement {
  const input = h("input", {
    type: "file",
    class: "drop-input",
    ariaLabel: tr`Open a file of this computer`,
    onchange: () => void take(app, input.files?.[0]),
  });
  const zone = h(
    "label",
    { class: "drop" },
    h("strong", {}, tr`Drop a program or readings here`),
    h(
      "span",
      { class: "muted" },
      tr`NC programs open in Simulate, CSV readings in Standards. Nothing leaves this computer.`,
    ),
    input,
  );
  const over = (event: DragEvent, on: boolean): void => {
    event.preventDefault();
    zone.classList.toggle("over", on);
  };
  zone.addEventListener("dragover", (event) => over(event, true));
  zone.addEventListener("dragleave", (event) => over(event, false));
  zone.addEventListener("drop", (event) => {
    over(event, false);
    void take(app, event.dataTransfer?.files[0]);
  });
  return zone;
}

export const start: Tab = {
  title: tr`Start`,
  mount(host: HTMLElement, app: App): TabHandle {
    let shown: Project | null = null;
    const kept = h("section", { class: "kept-files", dataTest: "kept", hidden: true });
    const left = h("div", { class: "start-examples" });
    const right = h("div", { class: "start-files" });
    fill(host, h("div", { class: "start" }, left, right));
    app.subscribe(({ project }) => {
      if (project === shown || !project) return;
      shown = project;
      fill(
        left,
        h(
          "div",
          { class: "start-head" },
          h("h1", {}, tr`Where is the tool really, and is the part good?`),
          h("p", { class: "muted" }, tr`Open an example, or a file of this folder.`),
        ),
        cards(app, project),
      );
      fill(
        right,
        h("h2", {}, tr`Files of this folder`),
        h("p", { class: "muted path" }, project.folder),
        app.has("describe")
          ? h("button", { dataTest: "new-machine", onclick: () => newMachine(app) }, tr`A machine of my own …`)
          : null,
        dropZone(app),
        kept,
        files(app, project),
      );
      void showKept(app, kept);
    });
    return { open: () => void showKept(app, kept) };
  },
};
