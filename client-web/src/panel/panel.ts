// The settings panel: every command of the protocol, with ranges as the server tells them. Fetched
// when it is first opened or searched.

import GUI, { type Controller } from 'lil-gui';

import type { Entry } from '../core/entries';
import { gridText, numberedName, tidy } from '../core/format';
import { keepOpen, wasOpen } from '../core/kept';
import { displayColor, linearColor } from '../core/srgb';
import type { Codec } from '../gen/froxel/v1/common_pb';
import type { FrameGrid } from '../gen/froxel/v1/server_pb';
import type { ColorField, Field, NumberField } from '../settings/field';
import { choicesFor, fieldsOf, isInUse, type Section } from '../settings/fields';
import { valueOf, type Settings, type Value } from '../settings/settings';
import type { AppState, ServerInfo } from '../state/app_state';
import { BoxEditor } from './box_editor';
import { LightEditor, type LightActions } from './light_editor';
import { scaleFor } from './range_scale';
import type { Mark } from './mark';
import { SizeEditor, type SizeActions } from './size_editor';
import { attachSlider } from './slider';
import { ToonEditor } from './toon_editor';
import { labelOf, tipOf, type WordBook } from './words';

export interface PanelActions extends SizeActions, LightActions {
  edit(patch: Partial<Settings>): void;
  set(field: Field, value: Value): void;
  selectCamera(name: string): void;
  resetAll(): void;
}

type Show = (settings: Settings) => void;
type Say = (words: WordBook) => void;

const kTitles: Readonly<Record<Section, string>> = {
  camera: 'Camera',
  lights: 'Lights',
  exposure: 'Exposure and colour',
  environment: 'Environment',
  animation: 'Animation',
  materials: 'Materials',
  effects: 'Effects',
  rendering: 'Rendering',
  clusters: 'Clusters and light lists',
  debug: 'Debug view',
  stream: 'Stream',
};


export class Panel {
  private readonly gui: GUI;
  private shows: Show[] = [];
  private says: Say[] = [];
  private words: WordBook = new Map();
  private builtFor: ServerInfo | null = null;
  private shown: Settings | null = null;
  private sizeEditor: SizeEditor | null = null;
  private lightEditor: LightEditor | null = null;
  private gridInUse: Controller | null = null;
  private readonly controls = new Map<string, { title: string; help: string; at: Controller }>();

  /** `onToggle` hears whether it is open. */
  constructor(
    private readonly parent: HTMLElement,
    private readonly actions: PanelActions,
    private readonly onToggle: (open: boolean) => void,
    private readonly codecs: readonly Codec[], // that this browser decodes
  ) {
    this.gui = this.makeGui();
  }

  toggle(): void {
    this.gui.open(this.gui._closed);
  }

  /** Every control that is of use, by its label; running one opens the panel there. */
  entries(): Entry[] {
    const shown = [...this.controls].filter(([, { at }]) => !at._hidden);
    return shown.map(([name, { title, help, at }]) => ({
      title,
      help,
      key: '',
      words: name.replaceAll('_', ' '),
      run: () => this.reveal(at),
    }));
  }

  private reveal(control: Controller): void {
    this.gui.open();
    for (let folder = control.parent; folder !== this.gui; folder = folder.parent) folder.open();
    control.domElement.scrollIntoView({ block: 'center' });
    control.domElement.querySelector<HTMLElement>('input, select, button')?.focus();
  }

  show({ server, settings, sizeMode, chosenLight }: AppState): void {
    if (!server || !settings) return;
    if (!this.builtFor || !sameControls(server, this.builtFor)) this.build(server);
    this.builtFor = server;
    if (settings !== this.shown) for (const show of this.shows) show(settings);
    this.shown = settings;
    this.sizeEditor?.show(settings, sizeMode);
    this.lightEditor?.show(settings.placedLights, chosenLight);
  }

  /** The server's words, which come when they come. */
  tell(words: WordBook): void {
    this.words = words;
    for (const say of this.says) say(words);
  }

  /** The grid of the picture that is shown; none where no light is assigned to clusters. */
  showGrid(grid: FrameGrid | undefined): void {
    if (!this.gridInUse) return;
    const text = grid ? gridText(grid) : 'none';
    if (this.gridInUse.getValue() !== text) this.gridInUse.setValue(text);
    this.gridInUse.domElement.title = grid?.why ?? 'No light is assigned to clusters';
  }

  private makeGui(): GUI {
    const gui = new GUI({ container: this.parent, title: 'Settings', injectStyles: false });
    const tell = (open: boolean): void => {
      this.parent.hidden = !open;
      this.onToggle(open);
    };
    gui.open(wasOpen('settings'));
    tell(!gui._closed);
    gui.onOpenClose((changed) => {
      if (changed !== gui) return; // a folder
      tell(!gui._closed);
      keepOpen('settings', !gui._closed);
    });
    return gui;
  }

  private build(server: ServerInfo): void {
    for (const child of [...this.gui.children]) child.destroy();
    this.shows = [];
    this.says = [];
    this.shown = null;
    this.controls.clear();
    const lights = this.section('lights', server);
    this.addBox(lights, server);
    this.lightEditor = new LightEditor(lights, this.actions, this.mark);
    this.addSceneCameras(this.section('camera', server), server);
    this.section('exposure', server);
    this.section('environment', server);
    if (hasAnimations(server)) this.section('animation', server);
    if (variantsOf(server).length > 0) this.section('materials', server);
    this.section('effects', server);
    for (const folder of this.gui.folders.slice(1)) folder.close();
    this.addExpert(server);
    this.gui
      .add({ reset: () => this.actions.resetAll() }, 'reset')
      .name('Back to the server’s defaults');
  }

  private addExpert(server: ServerInfo): void {
    const expert = this.gui.addFolder('Expert settings');
    this.section('rendering', server, expert);
    this.addGridInUse(this.section('clusters', server, expert));
    this.section('debug', server, expert);
    this.addToon(expert);
    const stream = this.section('stream', server, expert);
    this.sizeEditor = new SizeEditor(stream, server, this.actions, this.mark);
    for (const folder of [expert, ...expert.folders]) folder.close();
  }

  private section(section: Section, server: ServerInfo, parent = this.gui): GUI {
    const folder = parent.addFolder(kTitles[section]);
    for (const field of fieldsOf(section)) this.addField(folder, field, server);
    return folder;
  }

  private addField(folder: GUI, field: Field, server: ServerInfo): void {
    if (field.name === 'geometry_error' && !hasDetailLevels(server)) return;
    if (field.name === 'material_variant') {
      this.addVariants(folder, field, server);
      return;
    }
    if (field.kind === 'number') {
      this.addNumber(folder, field, server);
      return;
    }
    if (field.kind === 'color') {
      this.addColor(folder, field, server);
      return;
    }
    const model = { value: valueOf(server.initial, field) };
    const choices = field.kind === 'choice' ? choicesFor(field) : [];
    const decoded = choices.filter(({ value }) => field.name !== 'codec' || this.codecs.includes(value));
    const options =
      field.kind === 'choice'
        ? Object.fromEntries(decoded.map(({ name, value }) => [name.replaceAll('_', ' '), value]))
        : undefined;
    const limits =
      decoded.length < choices.length ? 'This browser cannot decode video here: video needs WebCodecs, which need https' : '';
    const controller = options ? folder.add(model, 'value', options) : folder.add(model, 'value');
    controller.onChange((value: number | boolean) => this.actions.set(field, value));
    this.finish(controller, field, limits, (settings) => {
      model.value = valueOf(settings, field);
      controller.updateDisplay();
    });
  }

  private addNumber(folder: GUI, field: NumberField, server: ServerInfo): void {
    const initial = valueOf(server.initial, field);
    const model = { value: tidy(initial) };
    const controller = folder.add(model, 'value');
    controller.onFinishChange((value: number) => this.actions.set(field, value));
    const range = server.ranges.get(field.name);
    const scale = range ? scaleFor(range, field, initial) : null;
    const slide = scale
      ? attachSlider(controller, scale, (value) => this.actions.set(field, value))
      : null;
    const limits = range ? `${range.min} to ${range.max}` : '';
    this.finish(controller, field, limits, (settings) => {
      const value = tidy(valueOf(settings, field));
      // Left alone while equal: the viewer may be typing another one.
      if (this.shown && tidy(valueOf(this.shown, field)) === value) return;
      model.value = value;
      controller.updateDisplay();
      slide?.(value);
    });
  }

  private addVariants(folder: GUI, field: Field, server: ServerInfo): void {
    const names = ['none', ...variantsOf(server).map(numberedName)];
    const model = { value: 0 };
    const options = Object.fromEntries(names.map((name, number) => [name, number]));
    const controller = folder.add(model, 'value', options);
    controller.onChange((value: number) => this.actions.set(field, value));
    this.finish(controller, field, '', ({ materialVariant }) => {
      model.value = materialVariant;
      controller.updateDisplay();
    });
  }

  private addColor(folder: GUI, field: ColorField, server: ServerInfo): void {
    const model = { color: displayColor(valueOf(server.initial, field)) };
    const controller = folder.addColor(model, 'color');
    controller.onChange((color: string) => this.actions.set(field, linearColor(color)));
    this.finish(controller, field, '', (settings) => {
      model.color = displayColor(valueOf(settings, field));
      controller.updateDisplay();
    });
  }

  private finish(controller: Controller, field: Field, limits: string, show: Show): void {
    const say: Say = (words) => {
      const title = labelOf(field.name, words);
      const help = tipOf(field.name, words, limits);
      this.mark(controller, field.name, title, help);
    };
    say(this.words);
    this.says.push(say);
    this.shows.push((settings) => {
      controller.enable(isInUse(field, settings));
      show(settings);
    });
  }

  private readonly mark: Mark = (control, field, title, help) => {
    control.name(title);
    control.domElement.title = help;
    control.domElement.dataset.field = field;
    this.controls.set(field, { title, help, at: control });
  };

  private addSceneCameras(folder: GUI, server: ServerInfo): void {
    const names = server.scene?.cameras ?? [];
    if (names.length === 0) return;
    const scene = Object.fromEntries(names.map((name) => [name, name]));
    const choices: Record<string, string> = { 'choose…': '', ...scene };
    const model = { camera: '' };
    const controller = folder.add(model, 'camera', choices);
    controller.onChange((name: string) => {
      model.camera = ''; // a way to go to, not a state to be in
      controller.updateDisplay();
      if (name !== '') this.actions.selectCamera(name);
    });
    this.mark(controller, 'scene_camera', 'Go to', "One of the scene's own cameras (keys 1 to 9)");
  }

  private addGridInUse(folder: GUI): void {
    this.gridInUse = folder.add({ text: '–' }, 'text').disable();
    this.mark(this.gridInUse, 'grid.in_use', 'In use', 'The cluster grid of the picture that is shown');
  }

  private addBox(folder: GUI, server: ServerInfo): void {
    const onEdit = (lightBox: Settings['lightBox']): void => this.actions.edit({ lightBox });
    const editor = new BoxEditor(folder, server.bounds, onEdit, this.mark);
    this.shows.push((settings) => editor.show(settings.lightBox));
  }

  private addToon(parent: GUI): void {
    const folder = parent.addFolder('Toon ramps');
    const editors = [
      ['toonFragment', 'toon fragment: each light’s n·l'],
      ['toonCompute', 'toon compute: brightness of the sum'],
    ] as const;
    for (const [key, caption] of editors) {
      const editor = new ToonEditor(folder.$children, caption, (ramp) =>
        this.actions.edit({ [key]: ramp }),
      );
      this.shows.push((settings) => editor.show(settings[key]));
    }
  }
}

const hasAnimations = ({ scene }: ServerInfo): boolean => (scene?.animations.length ?? 0) > 0;

const hasDetailLevels = ({ scene }: ServerInfo): boolean => scene?.detailLevels ?? false;

const variantsOf = ({ scene }: ServerInfo): readonly string[] => scene?.materialVariants ?? [];

/** Whether a panel built for one server fits another, as after most reconnects. */
function sameControls(a: ServerInfo, b: ServerInfo): boolean {
  const shape = ({ scene, bounds, ranges }: ServerInfo): string =>
    JSON.stringify([
      scene?.cameras,
      scene?.animations.length,
      scene?.materialVariants,
      scene?.detailLevels,
      bounds,
      [...ranges.values()],
    ]);
  return shape(a) === shape(b);
}
