// The looks as pictures to choose from, and those that this browser keeps.

import { closeBeside, element, make } from '../core/dom';
import { ms } from '../core/format';
import type { Look } from '../state/looks';

export interface LookActions {
  looks(): readonly Look[];
  applyLook(look: Look): void;
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

  constructor(
    private readonly actions: LookActions,
    private readonly costs: KnownCosts,
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
      this.list.replaceChildren(...this.actions.looks().map((look) => this.itemOf(look)));
    }
  }

  private itemOf(look: Look): HTMLElement {
    const item = make('li');
    const choose = make('button');
    choose.type = 'button';
    choose.title = look.help;
    if (!look.own) {
      const picture = make('img');
      picture.src = `looks/${look.name}.jpg`;
      picture.alt = '';
      picture.addEventListener('error', () => picture.remove()); // another server's look
      choose.append(picture);
    }
    choose.append(make('span', look.label));
    const cost = this.costs.ofMs(look.name);
    if (cost !== undefined) {
      const text = make('small', `${ms(cost)} ms`);
      text.title = 'What a frame of it took on the device when it was last seen here';
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
