// The picture's size: as the window times a scale, a preset, or any.

import type GUI from 'lil-gui';
import type { Controller } from 'lil-gui';

import type { Settings } from '../settings/settings';
import type { ServerInfo } from '../state/app_state';
import type { SizeMode } from '../state/size_policy';
import type { Mark } from './mark';
import { linearScale } from './range_scale';
import { attachSlider } from './slider';

export interface SizeActions {
  setSizeMode(mode: SizeMode): void;
  setSize(width: number, height: number): void;
}

/** Of the window: small enough for a slow device, and twice as fine as the screen. */
const kScaleRange = { min: 0.1, max: 2 };
const kPresets = ['640×360', '1280×720', '1920×1080', '2560×1440', '3840×2160'] as const;
const kAuto = 'window';
const kCustom = 'custom';

export class SizeEditor {
  private readonly model = { mode: kAuto, scale: 1, width: 0, height: 0 };
  private readonly controllers: { mode: Controller; scale: Controller; sides: Controller[] };
  private readonly slide: (value: number) => void;
  private shown = { width: 0, height: 0, scale: 0 };

  constructor(parent: GUI, server: ServerInfo, actions: SizeActions, mark: Mark) {
    const mode = parent
      .add(this.model, 'mode', [kAuto, ...kPresets, kCustom])
      .onChange((name: string) => {
        if (name === kAuto) actions.setSizeMode({ kind: 'auto', scale: this.model.scale });
        else actions.setSizeMode({ kind: 'fixed' });
        const [width, height] = name.split('×').map(Number);
        if (width && height) actions.setSize(width, height);
      });
    mark(mode, 'size', 'Picture size', 'Size of the picture in pixels: the window\'s size, a preset, or any other');

    const setScale = (scale: number): void => actions.setSizeMode({ kind: 'auto', scale });
    const scale = parent.add(this.model, 'scale');
    scale.onFinishChange((value: number) => {
      if (value > 0) {
        setScale(value);
      } else {
        this.model.scale = this.shown.scale;
        scale.updateDisplay();
      }
    });
    mark(scale, 'size.scale', 'Picture scale', 'Pixels of the picture for each pixel of the screen, along one side');
    this.slide = attachSlider(scale, linearScale(kScaleRange, false), setScale);

    const sides = (['width', 'height'] as const).map((side) => {
      const controller = parent.add(this.model, side);
      controller.onFinishChange(() => actions.setSize(this.model.width, this.model.height));
      const range = server.ranges.get(side);
      const limits = range ? ` · ${range.min} to ${range.max}` : '';
      mark(controller, side, `Picture ${side}`, `Picture’s ${side} in pixels${limits}`);
      return controller;
    });
    this.controllers = { mode, scale, sides };
  }

  show({ width, height }: Settings, mode: SizeMode | null): void {
    const auto = mode?.kind === 'auto';
    const preset = kPresets.find((name) => name === `${width}×${height}`);
    this.model.mode = auto ? kAuto : (preset ?? kCustom);
    const scale = auto ? mode.scale : this.shown.scale;
    // Left alone while equal: the viewer may be typing another one.
    if (this.shown.scale !== scale) this.model.scale = scale;
    if (this.shown.width !== width) this.model.width = width;
    if (this.shown.height !== height) this.model.height = height;
    this.shown = { width, height, scale };
    this.controllers.mode.updateDisplay();
    this.controllers.scale.enable(auto).updateDisplay();
    this.slide(this.model.scale);
    for (const side of this.controllers.sides) side.enable(!auto).updateDisplay();
  }
}
