// Keeps the secret by which a lost session is taken up again, for this tab and this room; it
// outlives a reload.

/** The part of sessionStorage that is used. */
export type Shelf = Pick<Storage, 'getItem' | 'removeItem' | 'setItem'>;

/** A question, whose a token is, or the answer. */
export interface Word {
  readonly whose?: string;
  readonly mine?: string;
}

/** The part of BroadcastChannel that is used, among all tabs of this page. */
export interface Tabs {
  post(word: Word): void;
  listen(heard: (word: Word) => void): void;
}

export class Resume {
  private readonly key: string;

  /**
   * `shelf` is null where the browser forbids storage: then a reload starts anew. `tabs` is null
   * where tabs cannot speak to one another.
   */
  constructor(
    private readonly shelf: Shelf | null,
    room: string,
    private readonly tabs: Tabs | null = null,
  ) {
    this.key = `froxel.resume.${room}`;
    tabs?.listen((word) => this.hear(word));
  }

  private kept = '';
  private claimed: (() => void) | null = null; // while claim() waits

  /**
   * Finds out whether the token is another tab's: a tab that was duplicated begins with a copy of
   * what the first one kept, and would take its session. A reloaded one has nobody to answer.
   */
  async claim(waitMs: number): Promise<void> {
    const { token, tabs } = this;
    if (token === '' || !tabs) return;
    await new Promise<void>((resolve) => {
      this.claimed = resolve;
      setTimeout(resolve, waitMs);
      tabs.post({ whose: token });
    });
    this.claimed = null;
  }

  private hear({ whose, mine }: Word): void {
    if (whose && whose === this.kept) this.tabs?.post({ mine: whose });
    if (mine && mine === this.token && this.claimed) {
      this.keep('');
      this.claimed();
    }
  }

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

/** Null where the browser has none. */
export function tabsChannel(): Tabs | null {
  try {
    const channel = new BroadcastChannel('froxel.tabs');
    return {
      post: (word) => channel.postMessage(word),
      listen: (heard) => channel.addEventListener('message', (event: MessageEvent<Word>) => heard(event.data)),
    };
  } catch {
    return null;
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
