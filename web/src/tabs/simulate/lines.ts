/** A text of up to millions of lines: one string and where each line begins. */
export class Lines {
  readonly text: string;
  readonly count: number;
  private readonly starts: Uint32Array;
  /** The text as it is searched. */
  private folded: string | null = null;

  constructor(text: string) {
    this.text = text;
    let starts = new Uint32Array(1024);
    let count = 0;
    for (let at = 0; at <= text.length; ) {
      if (count === starts.length) {
        const more = new Uint32Array(2 * count);
        more.set(starts);
        starts = more;
      }
      starts[count++] = at;
      const end = text.indexOf("\n", at);
      if (end < 0) break;
      at = end + 1;
    }
    // A last line end begins no line, and nothing is no line.
    this.count = count > 0 && starts[count - 1] === text.length ? count - 1 : count;
    this.starts = starts;
  }

  /** Line numbers count from 1. */
  line(number: number): string {
    if (number < 1 || number > this.count) return "";
    const from = this.starts[number - 1] as number;
    const end = this.text.indexOf("\n", from);
    return this.text.slice(from, end < 0 ? undefined : end).replace(/\r$/, "");
  }

  /** The next or the previous line with these words, around the ends; capital letters do not count. */
  find(words: string, from: number, step: 1 | -1): number | null {
    if (this.folded === null) {
      const folded = this.text.toLowerCase();
      // A few letters become two: then places would not be those of the text.
      this.folded = folded.length === this.text.length ? folded : this.text;
    }
    const wanted = words.toLowerCase();
    const begin = this.starts[Math.min(this.count, Math.max(1, from)) - 1] ?? 0;
    const after = from < this.count ? (this.starts[Math.max(0, from)] as number) : 0;
    let at = -1;
    if (step > 0) at = this.folded.indexOf(wanted, after);
    else if (begin > 0) at = this.folded.lastIndexOf(wanted, begin - 1);
    if (at < 0) at = step > 0 ? this.folded.indexOf(wanted) : this.folded.lastIndexOf(wanted);
    return at < 0 || wanted === "" ? null : this.lineAt(at);
  }

  private lineAt(place: number): number {
    let [first, above] = [0, this.count];
    while (first + 1 < above) {
      const middle = (first + above) >> 1;
      if ((this.starts[middle] as number) <= place) first = middle;
      else above = middle;
    }
    return first + 1;
  }
}
