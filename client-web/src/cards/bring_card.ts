// A scene that a person brings: which of the files it is, what it lacks, how far it is, and who can see
// it then. Names of files are set as text, never as HTML.

import { element, make } from '../core/dom';
import type { Dropped } from '../core/drop';
import { bytes } from '../core/format';
import { broughtScene, keepBrought, type BroughtScene } from '../core/kept';
import type { ServerFiles } from '../protocol/server_files';
import { chosenFiles, droppedFiles, type BroughtFile } from '../uploads/dropped';
import { scenesIn, sceneFiles, type SceneFiles } from '../uploads/scene_files';
import { removeScene, sendScene, type Transport } from '../uploads/sender';

export interface BringActions {
  selectScene(id: string): void;
  copyLink(): void;
}

interface Button {
  readonly text: string;
  readonly run: () => void;
}

const kMostNamed = 12;

export class BringCard {
  private readonly card = element('bring', HTMLElement);
  private readonly text = element('bring-text', HTMLElement);
  private readonly bar = element('bring-bar', HTMLProgressElement);
  private readonly list = element('bring-list', HTMLElement);
  private readonly buttons = element('bring-buttons', HTMLElement);
  private sending: AbortController | null = null;

  constructor(
    private readonly actions: BringActions,
    private readonly files: ServerFiles,
    private readonly transport: Transport,
  ) {}

  dropped(dropped: Dropped): void {
    void this.take(droppedFiles(dropped));
  }

  chosen(list: FileList): void {
    void this.take(chosenFiles(list));
  }

  /** Of one that this browser brought; others are passed over. */
  tellOf(id: string): void {
    const scene = this.sending ? null : broughtScene(id);
    if (scene) void this.tell(scene);
  }

  private async take(coming: Promise<readonly BroughtFile[]>): Promise<void> {
    if (this.sending) {
      this.say('A scene is on its way already. Cancel it first.', [this.cancel()]);
      return;
    }
    try {
      const files = await coming;
      const scenes = scenesIn(files);
      const [only] = scenes;
      if (!only) {
        this.say('There is no scene among these files. Drop a glTF, GLB, OBJ, PLY, STL or 3MF file, with its folder if it has one.', [this.close()]);
      } else if (scenes.length === 1) {
        await this.choose(only, files);
      } else {
        const choices = scenes.slice(0, kMostNamed).map((scene) => {
          const choice = make('button', scene.path);
          choice.type = 'button';
          choice.addEventListener('click', () => void this.choose(scene, files));
          return choice;
        });
        this.say(`There are ${scenes.length} scenes. Which one is to be opened?`, [this.close()], choices);
      }
    } catch (error) {
      this.say(textOf(error), [this.close()]);
    }
  }

  private async choose(scene: BroughtFile, all: readonly BroughtFile[]): Promise<void> {
    const found = await sceneFiles(scene, all);
    const name = found.files[0]?.path ?? '';
    if (found.missing.length === 0) {
      await this.send(name, found);
      return;
    }
    const named = found.missing.slice(0, kMostNamed).map((path) => make('code', path));
    const more = found.missing.length - named.length;
    if (more > 0) named.push(make('code', `and ${more} more`));
    const files = found.missing.length === 1 ? 'a file that is' : `${found.missing.length} files that are`;
    this.say(
      `${name} needs ${files} not among these. Drop its whole folder, or open it without.`,
      [{ text: 'Open without', run: () => void this.send(name, found) }, this.close()],
      named,
    );
  }

  private async send(name: string, scene: SceneFiles): Promise<void> {
    const all = scene.files.reduce((sum, { blob }) => sum + blob.size, 0);
    const sending = new AbortController();
    this.sending = sending;
    this.say('', [this.cancel()]);
    const told = (gone: number): void => {
      this.text.textContent = `Sending ${name}: ${bytes(Math.min(gone, all))} of ${bytes(all)}`;
      this.bar.value = all > 0 ? gone / all : 0;
    };
    this.bar.hidden = false;
    told(0);
    try {
      const sent = await sendScene(scene.files, this.transport, sending.signal, told);
      const brought = { ...sent, name };
      keepBrought(sent.id, brought);
      this.actions.selectScene(sent.id);
      await this.tell(brought);
    } catch (error) {
      if (sending.signal.aborted) this.card.hidden = true;
      else this.say(textOf(error), [{ text: 'Try again', run: () => void this.send(name, scene) }, this.close()]);
    } finally {
      this.sending = null;
    }
  }

  private async tell(scene: BroughtScene): Promise<void> {
    const answer = await this.files.get(`api/v1/scenes/${scene.id}`).catch(() => null);
    if (answer?.status === 404) keepBrought(scene.id, null);
    if (!answer?.ok) return;
    const { expires } = (await answer.json()) as { readonly expires?: string };
    const until = expires === undefined ? '' : new Date(expires).toLocaleString(undefined, { dateStyle: 'medium', timeStyle: 'short' });
    this.say(`Everybody who has the link can see ${scene.name}. The server deletes it at ${until}, if nobody opens it before.`, [
      { text: 'Copy link', run: () => this.actions.copyLink() },
      { text: 'Delete now', run: () => void this.remove(scene) },
      this.close(),
    ]);
  }

  private async remove(scene: BroughtScene): Promise<void> {
    const gone = await removeScene(scene, this.transport).catch(() => false);
    if (gone) keepBrought(scene.id, null);
    this.say(
      gone ? `${scene.name} is deleted. It stays on screen until another scene is opened.` : 'The server could not be reached.',
      gone ? [this.close()] : [{ text: 'Try again', run: () => void this.remove(scene) }, this.close()],
    );
  }

  private say(text: string, buttons: readonly Button[], list: readonly HTMLElement[] = []): void {
    this.text.textContent = text;
    this.bar.hidden = true;
    this.list.replaceChildren(...list.map((item) => {
      const row = make('li');
      row.append(item);
      return row;
    }));
    this.buttons.replaceChildren(...buttons.map(({ text: label, run }) => {
      const button = make('button', label);
      button.type = 'button';
      button.addEventListener('click', run);
      return button;
    }));
    this.card.hidden = false;
  }

  private close(): Button {
    return { text: 'Close', run: () => (this.card.hidden = true) };
  }

  private cancel(): Button {
    return { text: 'Cancel', run: () => this.sending?.abort(new Error('Cancelled.')) };
  }
}

const textOf = (error: unknown): string => (error instanceof Error ? error.message : String(error));
