// The server's scenes to choose from. What it says of them is set as text, never as HTML.

import { closeBeside, element, make } from '../core/dom';
import { bytes } from '../core/format';

export interface SceneActions {
  selectScene(id: string): void;
  /** Of the one that is shown. */
  sceneId(): string;
  /** That the server asks for; empty: none. */
  token(): string;
}

/** As the server lists it: protocol/README.md, Scenes over HTTP. */
interface Row {
  readonly id: string;
  readonly name: string;
  readonly path: string;
  readonly kind: string;
  readonly bytes: number;
  readonly state: string;
}

interface Listing {
  readonly scenes: readonly Row[];
  readonly next?: string;
}

const kPageSize = 200;
const kSearchFrom = 12; // scenes

export class ScenesCard {
  private readonly dialog = element('scenes', HTMLDialogElement);
  private readonly list = element('scenes-list', HTMLElement);
  private readonly search = element('scenes-search', HTMLInputElement);
  private readonly said = element('scenes-said', HTMLElement);
  private rows: readonly Row[] = [];

  constructor(private readonly actions: SceneActions) {
    closeBeside(this.dialog);
    this.search.addEventListener('input', () => this.show());
    element('scenes-close', HTMLButtonElement).addEventListener('click', () => this.dialog.close());
  }

  toggle(): void {
    if (this.dialog.open) {
      this.dialog.close();
      return;
    }
    this.search.value = '';
    this.show();
    this.dialog.showModal();
    void this.fetch();
  }

  private async fetch(): Promise<void> {
    const rows: Row[] = [];
    try {
      let after: string | undefined = '';
      while (after !== undefined) {
        const listing: Listing = await this.page(after);
        rows.push(...listing.scenes);
        after = listing.next;
      }
      this.rows = rows;
      this.show();
      if (!this.search.hidden) this.search.focus();
    } catch (error) {
      const why = error instanceof Error ? error.message : '';
      this.said.textContent = `The scenes could not be fetched: ${why}`;
    }
  }

  private async page(after: string): Promise<Listing> {
    const query = new URLSearchParams({ limit: String(kPageSize), ...(after !== '' && { after }) });
    const token = this.actions.token();
    const headers: HeadersInit = token === '' ? {} : { Authorization: `Bearer ${token}` };
    const answer = await fetch(new URL(`api/v1/scenes?${query.toString()}`, document.baseURI), { headers });
    const body = (await answer.json()) as Listing & { message?: string };
    if (!answer.ok) throw new Error(body.message ?? `HTTP ${answer.status}`);
    return body;
  }

  private show(): void {
    this.search.hidden = this.rows.length < kSearchFrom;
    const words = this.search.value.toLowerCase().split(/\s+/);
    const found = this.rows.filter(({ name, path }) => {
      const text = `${name} ${path}`.toLowerCase();
      return words.every((word) => text.includes(word));
    });
    this.said.textContent = this.rows.length > 0 && found.length === 0 ? 'No scene has that in its name.' : '';
    this.list.replaceChildren(...found.map((row) => this.itemOf(row)));
  }

  private itemOf(row: Row): HTMLElement {
    const item = make('li');
    const choose = make('button');
    choose.type = 'button';
    choose.title = row.path;
    choose.append(make('span', row.name), make('small', factsOf(row)));
    if (row.id === this.actions.sceneId()) choose.setAttribute('aria-current', 'true');
    choose.addEventListener('click', () => {
      this.dialog.close();
      this.actions.selectScene(row.id);
    });
    item.append(choose);
    return item;
  }
}

/** "GLB, 1.2 MB, ready" */
function factsOf({ kind, bytes: size, state }: Row): string {
  const parts = kind === 'builtin' ? ['built in'] : [kind.toUpperCase(), bytes(size)];
  return [...parts, ...(state === 'offered' ? [] : [state])].join(', ');
}
