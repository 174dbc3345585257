// Parts of the page that are fetched when they are first wanted, so that the picture comes first.

export class Later<T> {
  private part: T | null = null;
  private coming: Promise<T | null> | null = null;

  /** `failed` hears that it could not be fetched, each time that it was wanted in vain. */
  constructor(
    private readonly get: () => Promise<T>,
    private readonly failed: () => void,
  ) {}

  /** Null: it is not there yet. */
  get here(): T | null {
    return this.part;
  }

  /** Null: it could not be fetched. */
  want(): Promise<T | null> {
    this.coming ??= this.get().then(
      (part) => (this.part = part),
      () => {
        this.coming = null; // the next who wants it tries again
        this.failed();
        return null;
      },
    );
    return this.coming;
  }
}
