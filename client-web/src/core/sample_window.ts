// The last samples of something, and what share of them does not exceed a value.

export class SampleWindow {
  private readonly samples: number[] = [];
  private next = 0;

  constructor(private readonly capacity: number) {}

  push(value: number): void {
    this.samples[this.next] = value;
    this.next = (this.next + 1) % this.capacity;
  }

  get count(): number {
    return this.samples.length;
  }

  /** The value that `fraction` of the samples do not exceed (nearest rank); null without samples. */
  percentile(fraction: number): number | null {
    if (this.samples.length === 0) return null;
    const sorted = [...this.samples].sort((a, b) => a - b);
    const rank = Math.ceil(fraction * sorted.length) - 1;
    return sorted[Math.max(0, Math.min(sorted.length - 1, rank))] ?? null;
  }

  clear(): void {
    this.samples.length = 0;
    this.next = 0;
  }
}
