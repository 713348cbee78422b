/** Which files an answer was made from: where one of them changes, it is asked for again. */

import { filesOf, Refusal } from "./api.ts";

export class Reads {
  private readonly again: () => void;
  private files: ReadonlySet<string> = new Set();
  private turn = 0;
  /** Files that changed while a question is under way: whether it has read them is known at its end. */
  private meanwhile: string[] | null = null;

  /** `again` asks once more; it is called where a file has changed before its answer came. */
  constructor(again: () => void) {
    this.again = again;
  }

  /** Takes the files of an answer or of a refusal; a newer question drops the older one. */
  async of<T>(asking: Promise<T>): Promise<T> {
    this.turn += 1;
    const { turn } = this;
    this.meanwhile = [];
    try {
      const answer = await asking;
      this.take(turn, filesOf(answer));
      return answer;
    } catch (error) {
      // A lost connection or a question that was stopped says nothing of files.
      this.take(turn, error instanceof Refusal && error.of_server ? filesOf(error) : null);
      throw error;
    }
  }

  private take(turn: number, files: readonly string[] | null): void {
    if (turn !== this.turn) return;
    if (files) this.files = new Set(files);
    const changed = (this.meanwhile ?? []).some((path) => this.files.has(path));
    this.meanwhile = null;
    // After the answer itself.
    if (changed) setTimeout(this.again);
  }

  /** Whether the answer, or the refusal, is of another state of the files; null: any file may have changed. */
  isChangedBy(path: string | null): boolean {
    if (path !== null) this.meanwhile?.push(path);
    return path === null || this.files.has(path);
  }
}
