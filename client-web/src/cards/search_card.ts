// The search over all that one can do and set.

import { closeBeside, element, make } from '../core/dom';
import { keyText, searched, type Entry } from '../core/entries';

const kShown = 12;

export class SearchCard {
  private readonly dialog = element('search', HTMLDialogElement);
  private readonly input = element('search-text', HTMLInputElement);
  private readonly list = element('search-list', HTMLElement);
  private found: readonly Entry[] = [];
  private chosen = 0;

  /** `entries` is asked each time that the search opens. */
  constructor(private readonly entries: () => readonly Entry[]) {
    this.input.addEventListener('input', () => this.search());
    this.input.addEventListener('keydown', (event) => this.key(event));
    closeBeside(this.dialog);
  }

  toggle(): void {
    if (this.dialog.open) {
      this.dialog.close();
      return;
    }
    this.input.value = '';
    this.search();
    this.dialog.showModal();
  }

  /** There may be more entries than when it opened, or more is known of them. */
  refresh(): void {
    if (this.dialog.open) this.search();
  }

  private search(): void {
    this.found = searched(this.entries(), this.input.value).slice(0, kShown);
    this.chosen = 0;
    this.list.replaceChildren(
      ...this.found.map((entry, index) => {
        const item = make('li');
        item.id = `search-${index}`;
        item.setAttribute('role', 'option');
        item.append(make('b', entry.title), make('span', entry.help));
        if (entry.key !== '') item.append(make('kbd', keyText(entry)));
        item.addEventListener('click', () => this.run(index));
        return item;
      }),
    );
    if (this.found.length === 0) this.list.append(make('li', 'Nothing matches'));
    this.mark();
  }

  private mark(): void {
    [...this.list.children].forEach((item, index) => {
      item.setAttribute('aria-selected', String(index === this.chosen && this.found.length > 0));
    });
    const item = this.list.children[this.chosen];
    this.input.setAttribute('aria-activedescendant', item?.id ?? '');
    item?.scrollIntoView({ block: 'nearest' });
  }

  private key(event: KeyboardEvent): void {
    if (event.isComposing) return; // Enter takes a word of an input method
    const count = Math.max(1, this.found.length);
    if (event.key === 'ArrowDown') this.chosen = (this.chosen + 1) % count;
    else if (event.key === 'ArrowUp') this.chosen = (this.chosen + count - 1) % count;
    else if (event.key === 'Enter') this.run(this.chosen);
    else return;
    event.preventDefault();
    this.mark();
  }

  private run(index: number): void {
    const entry = this.found[index];
    if (!entry) return;
    this.dialog.close();
    entry.run();
  }
}
