/** The frame of the page in English: bar, status line, messages, keys. Other languages have the same keys. */

export const en = {
  /** As the choice names it. */
  name: "English",
  tabs: {
    start: "Start",
    describe: "Describe",
    simulate: "Simulate",
    predict: "Predict",
    plan: "Plan",
    measure: "Measure",
    identify: "Identify",
    compensate: "Compensate",
    verify: "Verify",
    standards: "Standards",
    live: "Live",
    report: "Report",
  } as Record<string, string>,
  verbs: "Verbs",
  language: "Language",
  theme: "Light or dark",
  themes: { auto: "System", light: "Light", dark: "Dark" },
  progress: "Progress",
  connecting: "connecting …",
  lost: "no connection – trying again",
  close: "Close",
  close_message: "Close this message",
  more: (n: number): string => `and ${n} more`,
  changed_on_disk: (path: string): string => `${path} has changed on the disk`,
  saved_elsewhere: (path: string): string => `${path} was saved in another window`,
  unsaved: (n: number): string => (n === 1 ? "1 file not saved" : `${n} files not saved`),
  keys: "Keys",
  single_keys: "Keys without Ctrl act on the page",
  key_groups: [
    {
      title: "Everywhere",
      keys: [
        ["?", "this list"],
        ["E", "names of errors, each with a drawing"],
        ["Tab, Shift+Tab", "to the next and the previous control"],
        ["← → Home End", "on the tabs and on pages of a tab: move; Enter opens"],
        ["← → ↑ ↓", "on the divider: resize the picture"],
        ["Esc", "close a dialog"],
      ],
    },
    {
      title: "Simulate",
      keys: [
        ["Space", "play, pause"],
        ["← →", "a block back, a block on"],
        ["Home, End", "to the start, to the end"],
        ["G", "go to a line"],
        ["/", "find in the program; Enter the next place, Shift+Enter the one before"],
        ["N, Shift+N", "the next and the previous issue: collisions, over-travel; where there is none, remarks"],
        ["↑ ↓ Page Up, Page Down", "in the source: move the mark; Enter goes to its line"],
      ],
    },
    {
      title: "Describe",
      keys: [
        ["Ctrl+S", "save the machine file"],
        ["Ctrl+Z, Ctrl+Shift+Z", "undo, redo"],
        ["Enter, Esc", "in the field of an error: keep, restore"],
      ],
    },
    {
      title: "Machine in three dimensions",
      keys: [
        ["← → ↑ ↓", "turn; with Shift move"],
        ["+ −", "nearer, farther"],
        ["0 1 2 3", "views: iso, along X, Y, Z"],
        ["4", "show everything"],
        ["5", "parallel projection"],
      ],
    },
    {
      title: "Figures",
      keys: [
        ["← →", "on a curve: read it point by point"],
        ["← → ↑ ↓", "on a matrix: read it cell by cell"],
        ["Enter", "on a curve over time: go to that time; on a bar, a hole or a row: choose it"],
        ["+ −", "on a curve over time: look closer, show all"],
      ],
    },
  ] as { title: string; keys: [string, string][] }[],
};

export type Words = typeof en;
