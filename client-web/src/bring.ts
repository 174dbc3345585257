// Scenes of one's own: what is dropped on the page or chosen. Fetched after the first picture.

import type { BringCard } from './cards/bring_card';
import { element } from './core/dom';
import { holdsFiles, takeDropped } from './core/drop';
import { broughtScene } from './core/kept';
import { Later } from './core/later';
import type { ServerFiles } from './protocol/server_files';

export interface Bringing {
  readonly files: ServerFiles;
  readonly token: () => string;
  readonly selectScene: (id: string) => void;
  readonly copyLink: () => void;
  readonly tell: (text: string) => void;
  readonly partMissing: () => void;
}

export class Bring {
  private readonly input = element('bring-input', HTMLInputElement);
  private readonly hint = element('drop-hint', HTMLElement);
  private readonly card: Later<BringCard>;
  private takes = false; // until the server has said

  constructor(private readonly does: Bringing) {
    this.card = new Later(() => this.makeCard(), does.partMissing);
    void does.files.takesUploads().then((takes) => {
      this.takes = takes;
      element('tool-open', HTMLButtonElement).hidden = !takes;
      if (takes) this.card.ahead();
    });
    this.input.addEventListener('change', () => {
      const { files: list } = this.input;
      if (!list?.length) return;
      void this.card.want().then((card) => {
        card?.chosen(list);
        this.input.value = ''; // the same file may be chosen again
      });
    });
    window.addEventListener('dragover', (event) => {
      if (!holdsFiles(event.dataTransfer)) return;
      event.preventDefault(); // else the browser would open the file in place of the page
      this.hint.hidden = !this.takes;
    });
    window.addEventListener('dragleave', ({ relatedTarget }) => (this.hint.hidden ||= relatedTarget === null));
    window.addEventListener('drop', (event) => this.drop(event));
  }

  open(): void {
    if (this.takes) this.input.click();
    else this.refuse();
  }

  /** Of one that was brought from here, it is told who sees it. */
  sceneShown(id: string): void {
    if (id !== '' && broughtScene(id)) void this.card.want().then((card) => card?.tellOf(id));
  }

  private drop(event: DragEvent): void {
    this.hint.hidden = true;
    if (!holdsFiles(event.dataTransfer) || !event.dataTransfer) return;
    event.preventDefault();
    const dropped = takeDropped(event.dataTransfer.items);
    if (this.takes) void this.card.want().then((card) => card?.dropped(dropped));
    else this.refuse();
  }

  private refuse(): void {
    this.does.tell('This server accepts no scenes from here (froxel serve --uploads).');
  }

  private async makeCard(): Promise<BringCard> {
    const [{ BringCard }, { XhrTransport }] = await Promise.all([
      import('./cards/bring_card'),
      import('./uploads/xhr_transport'),
      import('./style/bring.css'),
    ]);
    return new BringCard(this.does, this.does.files, new XhrTransport(this.does.token));
  }
}
