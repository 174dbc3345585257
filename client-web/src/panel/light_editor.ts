// The panel's part for placed lights: the chosen one's values, and sets as files.

import type GUI from 'lil-gui';
import type { Controller } from 'lil-gui';

import { tidy } from '../core/format';
import { displayColor, linearColor } from '../core/srgb';
import { LightKind } from '../gen/froxel/v1/common_pb';
import { findLight, kLightKinds, sameLight, type PlacedLight, type PlacedLights } from '../settings/placed_lights';
import type { HandleActions } from '../steering/light_handles';
import type { Mark } from './mark';

export interface LightActions extends HandleActions {
  addLight(): void;
  loadLights(file: File): Promise<void>;
  saveLights(): Promise<void>;
  showHandles(visible: boolean): void;
}

const kNone = 'none';
/** Values that not every kind of light has. */
const kKindsWith: Readonly<Record<string, readonly LightKind[]>> = {
  innerConeDeg: [LightKind.SPOT],
  outerConeDeg: [LightKind.SPOT],
  directionX: [LightKind.SPOT, LightKind.AREA],
  directionY: [LightKind.SPOT, LightKind.AREA],
  directionZ: [LightKind.SPOT, LightKind.AREA],
  widthM: [LightKind.AREA],
  heightM: [LightKind.AREA],
  rollDeg: [LightKind.AREA],
};

interface Model {
  chosen: string;
  handles: boolean;
  kind: LightKind;
  color: string;
  intensity: number;
  radius: number;
  x: number;
  y: number;
  z: number;
  innerConeDeg: number;
  outerConeDeg: number;
  directionX: number;
  directionY: number;
  directionZ: number;
  widthM: number;
  heightM: number;
  rollDeg: number;
}

export class LightEditor {
  private readonly model: Model = {
    chosen: kNone,
    handles: true,
    kind: LightKind.POINT,
    color: '#ffffff',
    intensity: 1,
    radius: 2,
    x: 0,
    y: 0,
    z: 0,
    innerConeDeg: 30,
    outerConeDeg: 45,
    directionX: 0,
    directionY: -1,
    directionZ: 0,
    widthM: 1,
    heightM: 1,
    rollDeg: 0,
  };
  private readonly folder: GUI;
  private chooser: Controller;
  private readonly values: Controller[] = [];
  private readonly ofKinds = new Map<Controller, readonly LightKind[]>();
  private readonly remove: Controller;
  private ids = '';
  private shown: PlacedLight | null = null;

  constructor(
    parent: GUI,
    private readonly actions: LightActions,
    private readonly mark: Mark,
  ) {
    this.folder = parent.addFolder('Placed lights');
    const folder = this.folder;
    this.button('add', 'Add a light', 'Places a new light in front of the camera; it costs as much as a moving one. A double click in the picture picks a light', () =>
      actions.addLight(),
    );
    this.chooser = this.addChooser([]);
    this.addValues();
    this.remove = this.button('remove', 'Delete this light', 'Removes the selected light, like the Delete key at its ring; a picked light returns to its original', () => {
      if (this.shown) actions.removeLight(this.shown.id);
    });
    const handles = folder.add(this.model, 'handles');
    handles.onChange((visible: boolean) => actions.showHandles(visible));
    this.describe(handles, 'handles', 'Rings over lights', 'Shows rings over the picture that select and drag placed lights');
    this.button('load', 'Load a light set…', 'Replaces the placed lights by those of a JSON file', () =>
      this.load(),
    );
    this.button('save', 'Save the light set', 'Saves the placed lights as a JSON file, for this page and for --light-set', () =>
      void actions.saveLights(),
    );
    this.fill(null);
    folder.close();
  }

  private addValues(): void {
    const kind = this.folder.add(
      this.model,
      'kind',
      Object.fromEntries(kLightKinds.map(({ name, value }) => [name, value])),
    );
    this.value(kind, 'kind', 'Light kind', 'Kind of the selected light. A spot’s cone costs a little in each pixel, a rectangle as much as ten points', () => ({
      kind: this.model.kind,
    }));
    const color = this.folder.addColor(this.model, 'color');
    this.value(color, 'color', 'Light colour', 'Colour of the selected light as the screen shows it', () => ({
      color: linearColor(this.model.color),
    }));
    this.number('intensity', 'Light intensity', 'Factor on the colour of the selected light', () => ({
      intensity: this.model.intensity,
    }));
    this.number('radius', 'Light reach, m', 'Distance at which the selected light ends; its cost grows with the pixels within', () => ({
      radius: this.model.radius,
    }));
    for (const axis of ['x', 'y', 'z'] as const) {
      this.number(axis, `Light at ${axis}, m`, `Position of the selected light along ${axis} of the world`, () => ({
        position: { x: this.model.x, y: this.model.y, z: this.model.z },
      }));
    }
    this.number('innerConeDeg', 'Inner cone, deg', 'Half angle of the cone with full brightness of the selected spot light', () => ({
      innerConeDeg: this.model.innerConeDeg,
    }));
    this.number('outerConeDeg', 'Outer cone, deg', 'Half angle of the cone at which the selected spot light ends', () => ({
      outerConeDeg: this.model.outerConeDeg,
    }));
    for (const key of ['directionX', 'directionY', 'directionZ'] as const) {
      this.number(key, `Light towards ${key.slice(-1).toLowerCase()}`, 'Direction of the selected light', () => ({
        direction: {
          x: this.model.directionX,
          y: this.model.directionY,
          z: this.model.directionZ,
        },
      }));
    }
    for (const [key, label, tip] of [
      ['widthM', 'Light width, m', 'Width of the selected rectangle; a larger one is softer, not brighter'],
      ['heightM', 'Light height, m', 'Height of the selected rectangle; a larger one is softer, not brighter'],
      ['rollDeg', 'Light roll, deg', 'Rotation of the selected rectangle about its direction'],
    ] as const) {
      this.number(key, label, tip, () => ({ [key]: this.model[key] }));
    }
  }

  show(lights: PlacedLights, chosen: number | null): void {
    const ids = lights.map(({ id }) => String(id)).join();
    const light = findLight(lights, chosen);
    if (ids !== this.ids) {
      this.ids = ids;
      this.chooser = this.addChooser(lights);
    }
    this.model.chosen = light ? String(light.id) : kNone;
    this.chooser.updateDisplay();
    if (light !== this.shown && !(light && this.shown && sameLight(light, this.shown))) {
      this.fill(light);
    }
  }

  private fill(light: PlacedLight | null): void {
    this.shown = light;
    if (light) {
      const { position, direction, color, kind, intensity, radius } = light;
      Object.assign(this.model, {
        kind,
        color: displayColor(color),
        intensity: tidy(intensity),
        radius: tidy(radius),
        x: tidy(position.x),
        y: tidy(position.y),
        z: tidy(position.z),
        innerConeDeg: tidy(light.innerConeDeg),
        outerConeDeg: tidy(light.outerConeDeg),
        directionX: tidy(direction.x),
        directionY: tidy(direction.y),
        directionZ: tidy(direction.z),
        widthM: tidy(light.widthM),
        heightM: tidy(light.heightM),
        rollDeg: tidy(light.rollDeg),
      });
    }
    for (const controller of [...this.values, this.remove]) {
      controller.show(light !== null);
      controller.updateDisplay();
    }
    for (const [controller, kinds] of this.ofKinds) {
      controller.show(light !== null && kinds.includes(light.kind));
    }
  }

  /** lil-gui makes a new controller for new options; it is put where the old one was. */
  private addChooser(lights: PlacedLights): Controller {
    const options = [kNone, ...lights.map(({ id }) => String(id))];
    const before = this.chooser as Controller | undefined;
    const chooser = before ? before.options(options) : this.folder.add(this.model, 'chosen', options);
    chooser.onChange((id: string) => this.actions.chooseLight(id === kNone ? null : Number(id)));
    this.describe(chooser, 'chosen', 'Chosen light', 'Placed light whose values are shown below; its ring selects it, too');
    return chooser;
  }

  private number(
    key: keyof Model,
    label: string,
    tip: string,
    patch: () => Partial<PlacedLight>,
  ): void {
    const controller = this.folder.add(this.model, key);
    this.value(controller, key, label, tip, patch);
    const kinds = kKindsWith[key];
    if (kinds) this.ofKinds.set(controller, kinds);
  }

  private value(
    controller: Controller,
    key: string,
    label: string,
    tip: string,
    patch: () => Partial<PlacedLight>,
  ): void {
    this.describe(controller, key, label, tip);
    const edit = (): void => {
      if (this.shown) this.actions.editLight(this.shown.id, patch());
    };
    if (key === 'color') controller.onChange(edit);
    else controller.onFinishChange(edit);
    this.values.push(controller);
  }

  private button(key: string, label: string, tip: string, action: () => void): Controller {
    const controller = this.folder.add({ action }, 'action');
    this.describe(controller, key, label, tip);
    return controller;
  }

  private describe(controller: Controller, key: string, label: string, tip: string): void {
    this.mark(controller, `placed_light.${key}`, label, tip);
  }

  private load(): void {
    const input = document.createElement('input');
    input.type = 'file';
    input.accept = 'application/json,.json';
    input.addEventListener('change', () => {
      const [file] = input.files ?? [];
      if (file) void this.actions.loadLights(file);
    });
    input.click();
  }
}
