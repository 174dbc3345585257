// Keeps the secret by which a lost session is taken up again, for this tab and this room; it
// outlives a reload.

/** The part of sessionStorage that is used. */
export type Shelf = Pick<Storage, 'getItem' | 'removeItem' | 'setItem'>;

export class Resume {
  private readonly key: string;

  /** `shelf` is null where the browser forbids storage: then a reload starts anew. */
  constructor(
    private readonly shelf: Shelf | null,
    room: string,
  ) {
    this.key = `froxel.resume.${room}`;
  }

  private kept = '';

  /** Empty: nothing to resume. */
  get token(): string {
    return this.kept !== '' ? this.kept : (this.shelf?.getItem(this.key) ?? '');
  }

  /** What Welcome said; empty where the server keeps no lost session. */
  keep(token: string): void {
    this.kept = token;
    try {
      if (token === '') this.shelf?.removeItem(this.key);
      else this.shelf?.setItem(this.key, token);
    } catch {
      // Full or forbidden: it is kept in this page, at least.
    }
  }
}

/** sessionStorage, where the browser allows it. */
export function tabShelf(): Shelf | null {
  try {
    return window.sessionStorage;
  } catch {
    return null;
  }
}
