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
  private readonly source: PlayerSource;

  constructor(source: PlayerSource) {
    this.source = source;
  }

  reset(duration_s: number): void {
    this.pause();
    this.duration_s = duration_s;
    this.time_s = 0;
    this.wanted = null;
  }

  get now_s(): number {
    return this.time_s;
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
    this.playing = true;
    this.last_ms = performance.now();
    this.source.changed(true);
    requestAnimationFrame((ms) => this.tick(ms));
  }

  pause(): void {
    if (!this.playing) return;
    this.playing = false;
    this.source.changed(false);
  }

  /** Goes to a time; playing goes on from there. */
  seek(time_s: number): void {
    this.time_s = Math.min(this.duration_s, Math.max(0, time_s));
    void this.show(this.time_s);
  }

  async stepBlock(step: "next" | "previous"): Promise<void> {
    this.pause();
    try {
      this.seek(await this.source.step(this.time_s, step));
    } catch (error) {
      this.source.failed(error);
    }
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

  private tick(ms: number): void {
    if (!this.playing) return;
    // A window that was out of sight does not jump.
    const passed_s = Math.min(0.25, Math.max(0, (ms - this.last_ms) / 1000));
    this.last_ms = ms;
    if (this.busy) {
      if (this.factor !== NO_WAITING) this.time_s = Math.min(this.duration_s, this.time_s + passed_s * this.factor);
      requestAnimationFrame((next) => this.tick(next));
      return;
    }
    void this.advance(passed_s).then(() => requestAnimationFrame((next) => this.tick(next)));
  }

  private async advance(passed_s: number): Promise<void> {
    if (this.factor === NO_WAITING) {
      try {
        const next = await this.source.step(this.time_s, "next");
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
