/** Paths, expected uncertainties, what each path sees, programs: the result of a plan. */

import { told } from "../../words/told.ts";
import { tr, trText } from "../../words/index.ts";
import { h, download } from "../../dom.ts";
import { bars, heatmap, type Figure } from "../../figure/index.ts";
import { number } from "../../format.ts";
import { sheetTable } from "../measure/table.ts";
import { count, duration, significant, unitText } from "../measure/words.ts";
import {
  programOf,
  type Chosen,
  type Expected,
  type PathDocument,
  type PlanDocument,
  type PlanHeader,
  type Program,
} from "./documents.ts";

interface Drawn {
  panel: HTMLElement;
  figures: Figure<never>[];
}

/** Where and why a program does not run as it should; nothing if it does. */
function issues(program: Program): string[] {
  return [...program.errors, ...program.grave];
}

export function summaryPanel(doc: PlanDocument): HTMLElement {
  const unsound = doc.paths.filter((path) => programOf(path)?.sound === false).length;
  const seen = doc.expected.length;
  const determined = doc.expected.filter((one) => one.u !== null).length;
  const time_s = doc.paths.reduce((sum, path) => sum + (programOf(path)?.duration_s ?? 0), 0);
  const [state, word] =
    unsound > 0
      ? ["bad", tr`Program errors`]
      : doc.rank < seen
        ? ["warn", tr`Not all observable`]
        : ["", tr`All observable`];
  const words = [
    unsound === 1
      ? tr`1 program would run into something or leave the travel`
      : unsound > 1
        ? tr`${unsound} programs would run into something or leave the travel`
        : null,
    doc.rank < seen
      ? tr`${doc.rank} of ${seen} combinations observable, ${determined} unknowns separately`
      : tr`all unknowns are observable`,
  ].filter(Boolean);
  return h(
    "section",
    { class: "panel" },
    h("h1", { dataOwn: true }, doc.name),
    h("p", { class: "muted" }, `${doc.machine}, `, h("code", { class: "chain-text" }, doc.chain)),
    h(
      "p",
      { class: `verdict ${state}`, role: "status", dataTest: "summary" },
      h("span", { class: "verdict-word" }, word),
      h("span", {}, words.join("; ")),
    ),
    h(
      "p",
      { class: "muted" },
      tr`${count(doc.paths.length, "path")}, ${duration(time_s)} of program together; condition ${significant(doc.condition)}.`,
    ),
  );
}

/** One row for each path; a click shows it on the machine. */
export function pathsPanel({ document, paths }: PlanHeader, now: number, choose: (path: number) => void): HTMLElement {
  const row = (path: PathDocument, i: number): HTMLElement => {
    const program = programOf(path);
    const issue = program ? issues(program) : [];
    const minor = program?.minor ?? [];
    const state = !program
      ? path.program && "missing" in path.program
        ? told("span", { class: "muted" }, path.program.missing)
        : h("span", { class: "muted" }, tr`no program`)
      : h("span", { class: program.sound ? "sound" : "unsound" }, program.sound ? tr`sound` : tr`not sound`);
    const notes = [
      ...issue.map((text) => told("p", { class: "unsound" }, text)),
      minor.length > 0
        ? h(
            "details",
            { onclick: (event: Event) => event.stopPropagation() },
            h("summary", { class: "muted" }, tr`${minor.length} minor`),
            minor.slice(0, 100).map((text) => told("p", { class: "muted" }, text)),
          )
        : null,
    ];
    const how =
      path.feed_mm_per_min !== null
        ? tr`without a stop at ${number(path.feed_mm_per_min, 0)} mm/min`
        : path.dwell_s !== null
          ? tr`standing ${number(path.dwell_s, 2)} s at each`
          : null;
    const kind = [paths[i]?.instrument, trText(paths[i]?.kind ?? ""), how].filter(Boolean).join(", ");
    const cells = [
      h("td", {}, h("strong", {}, path.name), h("p", { class: "muted" }, kind)),
      h("td", { class: "number" }, String(path.stations)),
      h("td", { class: "number" }, program ? duration(program.duration_s) : "–"),
      h("td", {}, state, notes),
    ];
    const element = h(
      "tr",
      {
        tabindex: "0",
        ariaSelected: String(i === now),
        dataPath: path.name,
        onclick: () => choose(i),
        onkeydown: (event: KeyboardEvent) => event.key === "Enter" && choose(i),
      },
      cells,
    );
    return element;
  };
  return h(
    "section",
    { class: "panel" },
    h("h2", {}, tr`Paths and their programs`),
    h(
      "table",
      { class: "paths" },
      h(
        "thead",
        {},
        h(
          "tr",
          {},
          h("th", {}, tr`Path`),
          h("th", { class: "number" }, tr`Stations`),
          h("th", { class: "number" }, tr`Runs`),
          h("th", {}, tr`Issues`),
        ),
      ),
      h("tbody", {}, document.paths.map(row)),
    ),
  );
}

/** An unknown of the set-up is written instrument.name. */
const isSetup = (one: Expected): boolean => one.name.includes(".");

/** Bars of U (k = 2), lengths and angles apart, the unknowns of the set-up in grey. */
export function expectedPanel(doc: PlanDocument): Drawn {
  const panel = h("section", { class: "panel" });
  const figures: Figure<never>[] = [];
  for (const unit of ["um", "urad"]) {
    const own = doc.expected.filter((one) => one.unit === unit).sort((a, b) => Number(isSetup(a)) - Number(isSetup(b)));
    if (own.length === 0) continue;
    const list = own.map((one) => ({
      name: one.name,
      value: one.expanded_k2,
      missing: tr`not observable alone`,
      note: "k = 2",
      ...(isSetup(one) ? { colour: "var(--line-strong)" } : {}),
    }));
    figures.push(
      bars(panel, {
        title:
          unit === "um" ? tr`Expected uncertainty U (k = 2) of lengths` : tr`Expected uncertainty U (k = 2) of angles`,
        unit: unitText(unit),
        digits: 2,
        bars: list,
      }),
    );
  }
  panel.append(
    h(
      "p",
      { class: "muted note" },
      tr`Before anybody measures: from the noise of the instrument and the poses alone. Grey: unknowns of the set-up.`,
    ),
  );
  return { panel, figures };
}

/** Below this a path does not see an error: rounding of the computation. */
const UNSEEN = 1e-6;

export function seenPanel(doc: PlanDocument): Drawn {
  const panel = h("section", { class: "panel" });
  const columns = doc.paths.flatMap((path) =>
    path.channels.map((channel) => (path.channels.length > 1 ? `${path.name} ${channel}` : path.name)),
  );
  const errors = doc.paths[0]?.seen_of_10_um_or_urad.map((one) => one.error) ?? [];
  const values = errors.flatMap((_, i) =>
    doc.paths.flatMap((path) =>
      (path.seen_of_10_um_or_urad[i]?.largest ?? []).map((v) => (Math.abs(v) < UNSEEN ? Number.NaN : v)),
    ),
  );
  const units = [...new Set(doc.paths.map((path) => unitText(path.unit)))].join(tr` or `);
  const figure = heatmap(panel, {
    title: tr`What each path sees of 10 µm or 10 µrad, ${units}`,
    rows: errors,
    columns,
    values,
    range: [0, Math.max(10, ...values.filter(Number.isFinite))],
    digits: 2,
    unit: units,
    blank: tr`not seen`,
  });
  panel.append(
    h(
      "p",
      { class: "muted note" },
      tr`Largest reading along the path, for every channel of its instrument. Grey: not seen at all.`,
    ),
  );
  return { panel, figures: [figure] };
}

/** The poses that were chosen, against a grid of as many. */
export function chosenPanel(chosen: Chosen): HTMLElement {
  const grid_of = chosen.grid?.poses;
  const grid = new Map(chosen.grid?.expected.map((one) => [one.name, one.expanded_k2]));
  const rows = chosen.expected.map((one) => [
    one.name,
    one.expanded_k2,
    ...(chosen.grid ? [grid.get(one.name) ?? null] : []),
    unitText(one.unit),
  ]);
  const words = tr`${chosen.poses} of ${chosen.candidates} poses, ${count(chosen.readings, "reading")}${chosen.time_s !== null ? tr`, ${duration(chosen.time_s)} as the campaign counts touches and poses` : ""}. ${count(chosen.blocked, "pose")} left out, where the tool would run into something.`;
  const sheet = sheetTable({
    key: "chosen",
    title: tr`The chosen poses against a grid of as many`,
    head: (tr) => [tr`unknown`, tr`U (k = 2) chosen`, ...(grid_of ? [tr`grid of ${grid_of}`] : []), tr`unit`],
    rows,
    digits: [undefined, 2, 2],
  });
  sheet.querySelector(".figure-head")?.after(h("p", { dataTest: "chosen" }, words));
  return sheet;
}

/** Lines of a program that are shown; all are saved. */
const SHOWN = 300;

export function programsPanel({ paths }: PlanHeader, dialect: HTMLElement): HTMLElement {
  const line = ({ name, text }: { name: string; text: string }): HTMLElement => {
    const lines = text.split("\n");
    const more = lines.length > SHOWN ? `\n${tr`… ${number(lines.length - SHOWN, 0)} more lines are in the file`}` : "";
    const pre = h("pre", { class: "program", tabindex: "0" });
    const details = h(
      "details",
      { ontoggle: () => (pre.textContent = details.open ? `${lines.slice(0, SHOWN).join("\n")}${more}` : "") },
      h("summary", {}, name, h("span", { class: "muted" }, ` ${tr`${lines.length} lines`}`)),
      pre,
    );
    return h(
      "div",
      { class: "program-line" },
      details,
      h("button", { ariaLabel: tr`Save ${name}`, onclick: () => download(name, text) }, tr`Save`),
    );
  };
  return h(
    "section",
    { class: "panel" },
    h("div", { class: "panel-head" }, h("h2", {}, tr`Programs and tables of poses`), dialect),
    paths.flatMap((path) => path.files.map(line)),
  );
}
