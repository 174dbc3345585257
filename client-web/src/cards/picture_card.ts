// Saves the picture: as it is shown, or drawn anew in a size of one's own.

import { messageOf } from '../core/format';
import { closeBeside, element, make } from '../core/dom';
import { sizeText, type Size } from '../core/size';
import { download } from '../core/download';
import { reasonOf, type ServerFiles } from '../protocol/server_files';

export interface PictureActions {
  /** Of the picture that is shown; null: there is none. */
  pictureSize(): Size | null;
  saveShown(): Promise<void>;
  /** Whether the browser lets that be saved; else the server draws it again. */
  isReadable(): boolean;
  /** Path of a still of this view in that size, and the name of its file. */
  still(size: Size): { readonly path: string; readonly file: string };
}

const kHeights: readonly number[] = [720, 1080, 1440, 2160];

/** Even numbers of pixels, in the shape of the picture that is shown. */
export const sizesOf = ({ width, height }: Size): Size[] =>
  kHeights.map((rows) => ({ width: 2 * Math.round((rows * width) / height / 2), height: rows }));

export class PictureCard {
  private readonly dialog = element('pictures', HTMLDialogElement);
  private readonly list = element('pictures-list', HTMLElement);
  private readonly said = element('pictures-said', HTMLElement);

  constructor(
    private readonly actions: PictureActions,
    private readonly files: ServerFiles,
  ) {
    closeBeside(this.dialog);
    element('pictures-close', HTMLButtonElement).addEventListener('click', () => this.dialog.close());
  }

  toggle(): void {
    if (this.dialog.open) {
      this.dialog.close();
      return;
    }
    const shown = this.actions.pictureSize();
    this.said.textContent = shown ? '' : 'There is no picture to save yet.';
    this.list.replaceChildren(...(shown ? this.items(shown) : []));
    this.dialog.showModal();
  }

  private items(shown: Size): HTMLElement[] {
    const asShown = this.item(`As shown, ${sizeText(shown)}`, async () => {
      if (!this.actions.isReadable()) {
        await this.draw(shown);
        return;
      }
      await this.actions.saveShown();
      this.dialog.close();
    });
    return [asShown, ...sizesOf(shown).map((size) => this.item(sizeText(size), () => this.draw(size)))];
  }

  private item(text: string, run: () => Promise<void>): HTMLElement {
    const item = make('li');
    const choose = make('button', text);
    choose.type = 'button';
    choose.addEventListener('click', () => void run());
    item.append(choose);
    return item;
  }

  /** By the server, which says why where it does not. */
  private async draw(size: Size): Promise<void> {
    this.said.textContent = `The server draws ${sizeText(size)}…`;
    const { path, file } = this.actions.still(size);
    try {
      const answer = await this.files.get(path);
      if (!answer.ok) throw new Error(await reasonOf(answer));
      download(await answer.blob(), file);
      this.dialog.close();
    } catch (error) {
      const why = messageOf(error);
      this.said.textContent = `${sizeText(size)} was not drawn: ${why}`;
    }
  }
}
