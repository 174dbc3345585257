// Keeps the secret by which a lost session is taken up again, for this tab and this room; it
// outlives a reload.

/** The part of sessionStorage that is used. */
export type Shelf = Pick<Storage, 'getItem' | 'removeItem' | 'setItem'>;

/** The part of BroadcastChannel that is used, among all tabs of this page. */
export interface Tabs {
  post(message: unknown): void;
  listen(heard: (message: unknown) => void): void;
}

interface Word {
  readonly says: 'whose' | 'mine';
  readonly token: string;
}

const isWord = (message: unknown): message is Word =>
  typeof message === 'object' && message !== null && 'says' in message && 'token' in message;

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
    tabs?.listen((message) => this.hear(message));
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
      tabs.post({ says: 'whose', token } satisfies Word);
    });
    this.claimed = null;
  }

  private hear(message: unknown): void {
    if (!isWord(message)) return;
    if (message.says === 'whose') {
      if (this.kept !== '' && message.token === this.kept) this.tabs?.post({ says: 'mine', token: this.kept } satisfies Word);
    } else if (this.claimed && message.token === this.token) {
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
      post: (message) => channel.postMessage(message),
      listen: (heard) => channel.addEventListener('message', (event) => heard(event.data)),
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
