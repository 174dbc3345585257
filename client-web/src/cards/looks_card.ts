// The looks as pictures to choose from, and those that this browser keeps.

import { closeBeside, element, make } from '../core/dom';
import { ms } from '../core/format';
import type { ServerFiles } from '../protocol/server_files';
import type { Look } from '../state/looks';

export interface LookActions {
  looks(): readonly Look[];
  applyLook(look: Look): void;
  /** Path of a still of it. */
  lookPicture(look: Look): string;
  /** Whether the view is at it. */
  isLookNow(look: Look): boolean;
  /** Of the commands that set the view. */
  newestSeq(): bigint;
  /** Why not, in words; null: it is kept. */
  keepLook(label: string): string | null;
  dropLook(label: string): string | null;
}

/** What a frame of each look takes on the device. */
export interface KnownCosts {
  /** The view is at these since the command `newestSeq`. */
  note(names: readonly string[], newestSeq: bigint): void;
  /** Undefined: not known. */
  ofMs(name: string): number | undefined;
}

export class LooksCard {
  private readonly dialog = element('looks', HTMLDialogElement);
  private readonly list = element('looks-list', HTMLElement);
  private readonly name = element('looks-name', HTMLInputElement);
  private readonly said = element('looks-said', HTMLElement);
  private pictures: { readonly picture: HTMLImageElement; readonly path: string }[] = [];

  constructor(
    private readonly actions: LookActions,
    private readonly costs: KnownCosts,
    private readonly files: ServerFiles,
  ) {
    closeBeside(this.dialog);
    element('looks-form', HTMLFormElement).addEventListener('submit', (event) => {
      event.preventDefault();
      this.tell(this.actions.keepLook(this.name.value));
    });
    element('looks-close', HTMLButtonElement).addEventListener('click', () => this.dialog.close());
  }

  toggle(): void {
    if (this.dialog.open) {
      this.dialog.close();
      return;
    }
    this.noteCost();
    this.tell(null);
    this.dialog.showModal();
    void this.showPictures();
  }

  /** Of the view as it would be; one after another, since a server draws them beside others' frames. */
  private async showPictures(): Promise<void> {
    const { pictures } = this;
    for (const { picture, path } of pictures) {
      if (pictures !== this.pictures || !this.dialog.open) return; // others are shown by now
      const url = await this.files.picture(path);
      if (url !== null) picture.src = url;
    }
  }

  private noteCost(): void {
    const { actions } = this;
    const now = actions.looks().filter((look) => actions.isLookNow(look));
    this.costs.note(now.map(({ name }) => name), actions.newestSeq());
  }

  private tell(problem: string | null): void {
    this.said.textContent = problem ?? '';
    if (problem === null) {
      this.name.value = '';
      this.pictures = [];
      this.list.replaceChildren(...this.actions.looks().map((look) => this.itemOf(look)));
      if (this.dialog.open) void this.showPictures();
    }
  }

  private itemOf(look: Look): HTMLElement {
    const item = make('li');
    const choose = make('button');
    choose.type = 'button';
    choose.title = look.help;
    const picture = make('img');
    picture.alt = '';
    this.pictures.push({ picture, path: this.actions.lookPicture(look) });
    choose.append(picture, make('span', look.label));
    const cost = this.costs.ofMs(look.name);
    if (cost !== undefined) {
      const text = make('small', `${ms(cost)} ms`);
      text.title = 'Device time of a frame when this look was last shown here';
      choose.append(' ', text);
    }
    if (this.actions.isLookNow(look)) choose.setAttribute('aria-current', 'true');
    choose.addEventListener('click', () => {
      this.noteCost();
      this.dialog.close();
      this.actions.applyLook(look);
    });
    item.append(choose);
    if (look.own) {
      const drop = make('button', '×', 'plain');
      drop.type = 'button';
      drop.setAttribute('aria-label', `Remove the look ${look.label}`);
      drop.addEventListener('click', () => this.tell(this.actions.dropLook(look.label)));
      item.append(drop);
    }
    return item;
  }
}
