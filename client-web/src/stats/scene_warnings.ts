// The fold of the statistics card that says what of the scene's file is not shown as it says.

import { element, make } from '../core/dom';
import { Severity, type SceneInfo, type SceneWarning } from '../gen/froxel/v1/server_pb';

/** What the fold is called: what the picture lacks goes before mere remarks. */
export function warningsTitle(scene: SceneInfo): string {
  const lacking = scene.warnings.filter(({ severity }) => severity === Severity.WARNING).length;
  const counted = (count: number, word: string): string => `${count} ${word}${count === 1 ? '' : 's'}`;
  const parts = [
    lacking > 0 ? counted(lacking, 'warning') : '',
    scene.warnings.length > lacking ? counted(scene.warnings.length - lacking, 'remark') : '',
    scene.warningsLeftOut > 0n ? `${scene.warningsLeftOut} more` : '',
  ].filter((part) => part !== '');
  return `The scene's file: ${parts.join(', ')}`;
}

/** Where it is and which kind, for who repairs the file. */
export function warningTip({ code, pointer }: SceneWarning): string {
  return pointer === '' ? code : `${code} at ${pointer}`;
}

export class SceneWarnings {
  private readonly fold = element('scene-warnings', HTMLDetailsElement);
  private readonly title = element('scene-warnings-title', HTMLElement);
  private readonly list = element('scene-warnings-list', HTMLUListElement);

  show(scene: SceneInfo | null): void {
    this.fold.hidden = !scene || scene.warnings.length === 0;
    if (!scene) return;
    this.title.textContent = warningsTitle(scene);
    const rows = scene.warnings.map((warning) => {
      const row = make('li', warning.message);
      row.title = warningTip(warning);
      return row;
    });
    this.list.replaceChildren(...rows);
  }
}
