/** The text of a machine file while it is being edited: what is saved, what was before, what comes again. */

/** Steps back that are kept; a text is some ten thousand characters. */
const MOST_STEPS = 200;

export class Draft {
  readonly path: string;
  text: string;
  /** The text in the file, as far as this window knows, and its version there. */
  saved: string;
  version: string;
  private before: string[] = [];
  private after: string[] = [];

  constructor(path: string, text: string, version: string) {
    this.path = path;
    this.text = this.saved = text;
    this.version = version;
  }

  get dirty(): boolean {
    return this.text !== this.saved;
  }

  get canUndo(): boolean {
    return this.before.length > 0;
  }

  get canRedo(): boolean {
    return this.after.length > 0;
  }

  /** One step; false if nothing changed. */
  edit(text: string): boolean {
    if (text === this.text) return false;
    this.before.push(this.text);
    if (this.before.length > MOST_STEPS) this.before.shift();
    this.after = [];
    this.text = text;
    return true;
  }

  undo(): boolean {
    const text = this.before.pop();
    if (text === undefined) return false;
    this.after.push(this.text);
    this.text = text;
    return true;
  }

  redo(): boolean {
    const text = this.after.pop();
    if (text === undefined) return false;
    this.before.push(this.text);
    this.text = text;
    return true;
  }

  /** What is in the file now is `text`; it may have been edited on meanwhile. */
  wasSaved(text: string, version: string): void {
    this.saved = text;
    this.version = version;
  }

  /** Takes what another window saved. The own edits are one step back, so that they are not lost. */
  adopt(text: string, version: string): void {
    this.edit(text);
    this.wasSaved(text, version);
  }

  /** The same edits as another file. */
  renamed(path: string, version: string): Draft {
    const copy = new Draft(path, this.text, version);
    copy.before = [...this.before];
    return copy;
  }
}
