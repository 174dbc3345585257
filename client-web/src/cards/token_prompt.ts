// Asks for the token of a server that lets nobody else in. It stays in this tab, outlives a reload,
// and goes nowhere but into Hello.

import { element } from '../core/dom';
import type { Shelf } from '../protocol/resume';

const kKey = 'froxel.token';

export class TokenPrompt {
  private readonly dialog = element('token', HTMLDialogElement);
  private readonly said = element('token-said', HTMLElement);
  private readonly input = element('token-input', HTMLInputElement);
  private kept: string;

  /** `shelf` is null where the browser forbids storage: then a reload asks again. */
  constructor(
    private readonly shelf: Shelf | null,
    entered: () => void,
  ) {
    this.kept = shelf?.getItem(kKey) ?? '';
    element('token-form', HTMLFormElement).addEventListener('submit', () => {
      this.keep(this.input.value.trim());
      this.input.value = '';
      entered();
    });
  }

  /** Empty: none is known. */
  get value(): string {
    return this.kept;
  }

  /** The one that is kept, if any, was refused. */
  ask(): void {
    this.said.textContent = this.kept === '' ? '' : 'The server does not know this token.';
    this.keep('');
    if (!this.dialog.open) this.dialog.showModal();
  }

  private keep(token: string): void {
    this.kept = token;
    try {
      if (token === '') this.shelf?.removeItem(kKey);
      else this.shelf?.setItem(kKey, token);
    } catch {
      // Full or forbidden: it is kept in this page, at least.
    }
  }
}
