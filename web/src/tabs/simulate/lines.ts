/** A text of up to millions of lines: one string and where each line begins. */
export class Lines {
  readonly text: string;
  readonly count: number;
  private readonly starts: Uint32Array;

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
}
