// Parts of the page that are fetched when they are first wanted, so that the picture comes first.

export const kMissing = 'A part of this page could not be fetched. Reload the page when the server is reachable.';

export class Later<T> {
  private part: T | null = null;
  private coming: Promise<T | null> | null = null;

  /** `failed` hears of each time that it was wanted in vain. */
  constructor(
    private readonly get: () => Promise<T>,
    private readonly failed: () => void,
  ) {}

  /** Null: it is not there yet. */
  get here(): T | null {
    return this.part;
  }

  /** Null: it could not be fetched, and whoever is to be told was. */
  async want(): Promise<T | null> {
    const part = await this.fetched();
    if (part === null) this.failed();
    return part;
  }

  /** So that it is there when it is wanted; in vain, it is tried again then. */
  ahead(): void {
    void this.fetched();
  }

  private fetched(): Promise<T | null> {
    this.coming ??= this.get().then(
      (part) => (this.part = part),
      () => (this.coming = null),
    );
    return this.coming;
  }
}
