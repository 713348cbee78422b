/** Runs through the program in true time, a multiple of it, or block by block without waiting. */

/** Every block once, as fast as it can be shown. */
export const NO_WAITING = Infinity;

export interface PlayerSource {
  /** Fetches and shows a time; resolves once it is shown. */
  show(time_s: number): Promise<void>;
  /** When the next or the previous block begins. */
  step(from_s: number, step: "next" | "previous"): Promise<number>;
  failed(error: unknown): void;
  /** Playing began or ended. */
  changed(playing: boolean): void;
}

export class Player {
  duration_s = 0;
  playing = false;
  private time_s = 0;
  private factor = 1;
  private busy = false;
  /** A time to show once the one under way is shown. */
  private wanted: number | null = null;
  private last_ms = 0;
  /** Counts what was asked for; older answers do not move anything any more. */
  private turn = 0;
  /** Counts the plays: the frames of an earlier one end. */
  private run = 0;
  private steps: Promise<void> = Promise.resolve();
  private readonly source: PlayerSource;

  constructor(source: PlayerSource) {
    this.source = source;
  }

  reset(duration_s: number): void {
    this.pause();
    this.turn += 1;
    this.duration_s = duration_s;
    this.time_s = 0;
    this.wanted = null;
  }

  setFactor(factor: number): void {
    this.factor = factor;
  }

  toggle(): void {
    if (this.playing) this.pause();
    else this.play();
  }

  play(): void {
    if (this.playing || !(this.duration_s > 0)) return;
    if (this.time_s >= this.duration_s) this.time_s = 0;
    this.turn += 1;
    this.playing = true;
    this.last_ms = performance.now();
    this.source.changed(true);
    this.run += 1;
    this.nextFrame(this.run);
  }

  pause(): void {
    if (!this.playing) return;
    this.playing = false;
    this.source.changed(false);
    // While an answer was under way, the time went on: what is shown is where playing goes on.
    void this.show(this.time_s);
  }

  /** Goes to a time; playing goes on from there. */
  seek(time_s: number): void {
    this.turn += 1;
    this.moveTo(time_s);
  }

  stepBlock(step: "next" | "previous"): void {
    this.goWhere(() => this.source.step(this.time_s, step));
  }

  /** Goes where an answer says, one after the other, unless another place is asked for before it comes. */
  goWhere(find: () => Promise<number>): void {
    this.pause();
    const turn = this.turn;
    this.steps = this.steps.then(async () => {
      if (turn !== this.turn) return;
      try {
        const time_s = await find();
        if (turn === this.turn) this.moveTo(time_s);
      } catch (error) {
        this.source.failed(error);
      }
    });
  }

  private moveTo(time_s: number): void {
    this.time_s = Math.min(this.duration_s, Math.max(0, time_s));
    void this.show(this.time_s);
  }

  /** One request under way at a time; the latest wish follows it. */
  private async show(time_s: number): Promise<void> {
    if (this.busy) {
      this.wanted = time_s;
      return;
    }
    this.busy = true;
    try {
      for (let next: number | null = time_s; next !== null; next = this.wanted) {
        this.wanted = null;
        await this.source.show(next);
      }
    } catch (error) {
      this.wanted = null;
      this.pause();
      this.source.failed(error);
    } finally {
      this.busy = false;
    }
  }

  private nextFrame(run: number): void {
    requestAnimationFrame((ms) => this.tick(ms, run));
  }

  private tick(ms: number, run: number): void {
    if (!this.playing || run !== this.run) return;
    // A window that was out of sight does not jump.
    const passed_s = Math.min(0.25, Math.max(0, (ms - this.last_ms) / 1000));
    this.last_ms = ms;
    if (this.busy) {
      if (this.factor !== NO_WAITING) this.time_s = Math.min(this.duration_s, this.time_s + passed_s * this.factor);
      this.nextFrame(run);
      return;
    }
    void this.advance(passed_s).then(() => this.nextFrame(run));
  }

  private async advance(passed_s: number): Promise<void> {
    if (this.factor === NO_WAITING) {
      const turn = this.turn;
      try {
        const next = await this.source.step(this.time_s, "next");
        if (turn !== this.turn || !this.playing) return;
        this.time_s = next > this.time_s ? next : this.duration_s;
      } catch (error) {
        this.pause();
        this.source.failed(error);
        return;
      }
    } else this.time_s = Math.min(this.duration_s, this.time_s + passed_s * this.factor);
    const shown = this.show(this.time_s);
    if (this.factor === NO_WAITING) await shown;
    if (this.time_s >= this.duration_s) this.pause();
  }
}
