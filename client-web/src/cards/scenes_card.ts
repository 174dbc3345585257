// The server's scenes to choose from. What it says of them is set as text, never as HTML.

import { folded } from '../core/entries';
import { closeBeside, element, make } from '../core/dom';
import { bytes, messageOf } from '../core/format';
import type { ServerFiles } from '../protocol/server_files';

export interface SceneActions {
  selectScene(id: string): void;
  /** Of the one that is shown. */
  sceneId(): string;
}

/** As the server lists it: protocol/README.md, Scenes over HTTP. */
interface Row {
  readonly id: string;
  readonly name: string;
  readonly path: string;
  readonly kind: string;
  readonly bytes: number;
  readonly state: string;
  readonly thumb: string; // path of its picture
  readonly modified?: number; // seconds since 1970; absent: it is no file
  readonly holds?: Readonly<Record<'file_bytes' | 'triangles' | 'lights' | 'animations', number>>;
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
  private readonly order = element('scenes-order', HTMLSelectElement);
  private rows: readonly Row[] = [];
  /** Pictures and facts are fetched of what is in sight: a picture may need the scene loaded. */
  private readonly seen = new IntersectionObserver((entries) => {
    for (const { target, isIntersecting } of entries) {
      if (!isIntersecting) continue;
      this.seen.unobserve(target);
      const item = this.items.get(target);
      if (item) void this.picture(item);
    }
  });
  private readonly items = new Map<Element, Item>();

  constructor(
    private readonly actions: SceneActions,
    private readonly files: ServerFiles,
  ) {
    closeBeside(this.dialog);
    this.search.addEventListener('input', () => this.show());
    this.order.addEventListener('change', () => this.show());
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
      const why = messageOf(error);
      this.said.textContent = `The scenes could not be fetched: ${why}`;
    }
  }

  private async page(after: string): Promise<Listing> {
    const query = new URLSearchParams({ limit: String(kPageSize), ...(after !== '' && { after }) });
    const answer = await this.files.get(`api/v1/scenes?${query.toString()}`);
    const body = (await answer.json()) as Listing & { message?: string };
    if (!answer.ok) throw new Error(body.message ?? `HTTP ${answer.status}`);
    return body;
  }

  private show(): void {
    this.search.hidden = this.order.hidden = this.rows.length < kSearchFrom;
    const words = folded(this.search.value).split(/\s+/);
    const found = this.rows.filter(({ name, path }) => {
      const text = folded(`${name} ${path}`);
      return words.every((word) => text.includes(word));
    });
    this.said.textContent = this.rows.length > 0 && found.length === 0 ? 'No scene matches.' : '';
    this.seen.disconnect();
    this.items.clear();
    found.sort(this.order.value === 'newest' ? byTime : byName);
    this.list.replaceChildren(...found.map((row) => this.itemOf(row)));
  }

  private async picture({ row, image, doing, facts }: Item): Promise<void> {
    doing.textContent = 'drawing…';
    const picture = await this.files.picture(row.thumb);
    doing.textContent = picture === null ? 'no picture' : ''; // a file may be broken
    if (picture === null) return;
    image.src = picture;
    if (row.holds) return;
    const answer = await this.files.get(`api/v1/scenes/${row.id}`).catch(() => null);
    if (answer?.ok) facts.textContent = factsOf((await answer.json()) as Row);
  }

  private itemOf(row: Row): HTMLElement {
    const item = make('li');
    const choose = make('button');
    choose.type = 'button';
    choose.title = row.path;
    const image = make('img');
    image.alt = '';
    const doing = make('em');
    const facts = make('small', factsOf(row));
    choose.append(image, doing, make('span', row.name), facts);
    this.items.set(item, { row, image, doing, facts });
    this.seen.observe(item);
    if (row.id === this.actions.sceneId()) choose.setAttribute('aria-current', 'true');
    choose.addEventListener('click', () => {
      this.dialog.close();
      this.actions.selectScene(row.id);
    });
    item.append(choose);
    return item;
  }
}

interface Item {
  readonly row: Row;
  readonly image: HTMLImageElement;
  readonly doing: HTMLElement; // what is being done for its picture, over its place
  readonly facts: HTMLElement;
}

const byName = (a: Row, b: Row): number => a.name.localeCompare(b.name);
const byTime = (a: Row, b: Row): number => (b.modified ?? 0) - (a.modified ?? 0);

const counted = (count: number, what: string): string[] =>
  count === 0 ? [] : [`${count.toLocaleString('en')} ${what}${count === 1 ? '' : 's'}`];

/** "GLTF, 1.2 MB, 2,340 triangles, 1 light", with what is known. */
function factsOf({ kind, bytes: size, holds }: Row): string {
  // A glTF is little without its buffers and textures, whose size is known once it was read.
  const known = holds?.file_bytes ?? (kind === 'glb' ? size : 0);
  const parts = kind === 'builtin' ? ['built in'] : [kind.toUpperCase(), ...(known > 0 ? [bytes(known)] : [])];
  if (holds) {
    parts.push(
      ...counted(holds.triangles, 'triangle'),
      ...counted(holds.lights, 'light'),
      ...counted(holds.animations, 'animation'),
    );
  }
  return parts.join(', ');
}
