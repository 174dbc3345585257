// The box that the moving lights keep to; the scene's bounds until a number is changed.

import type GUI from 'lil-gui';
import type { Controller } from 'lil-gui';

import { tidy } from '../core/format';
import { sameBounds, type Bounds } from '../settings/settings';
import type { Mark } from './mark';

const kSides = ['min', 'max'] as const;
const kEnds = { min: 'Lower', max: 'Upper' } as const;
const kAxes = ['x', 'y', 'z'] as const;

export class BoxEditor {
  private readonly model = { min: zero(), max: zero() };
  private readonly numbers: Controller[] = [];
  private readonly whole: Controller;
  private shown: Bounds | null = null;

  constructor(
    parent: GUI,
    private readonly sceneBounds: Bounds | null,
    onEdit: (box: Bounds | null) => void,
    mark: Mark,
  ) {
    const folder = parent.addFolder('Light box').close();
    for (const side of kSides) {
      for (const axis of kAxes) {
        const number = folder.add(this.model[side], axis);
        const title = `${kEnds[side]} ${axis}, m`;
        mark(number, `light_box.${side}.${axis}`, title, `${kEnds[side]} end along ${axis} of the box that moving lights stay in`);
        number.onFinishChange(() => onEdit({ min: { ...this.model.min }, max: { ...this.model.max } }));
        this.numbers.push(number);
      }
    }
    this.whole = folder.add({ clear: () => onEdit(null) }, 'clear');
    mark(this.whole, 'light_box.clear', 'Light box: whole scene', 'Lets the moving lights fill the whole scene');
    this.fill(null);
  }

  show(box: Bounds | null): void {
    if (!sameBounds(box, this.shown)) this.fill(box);
  }

  private fill(box: Bounds | null): void {
    this.shown = box;
    const bounds = box ?? this.sceneBounds;
    for (const side of kSides) {
      for (const axis of kAxes) this.model[side][axis] = tidy(bounds?.[side][axis] ?? 0);
    }
    for (const number of this.numbers) number.updateDisplay();
    this.whole.enable(box !== null);
  }
}

function zero(): { x: number; y: number; z: number } {
  return { x: 0, y: 0, z: 0 };
}
