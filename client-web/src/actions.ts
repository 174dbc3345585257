// What can be done on the page, each once: tools, keys, the help and the search are made from it.

import type { Entry } from './core/entries';
import type { Look } from './state/looks';

export interface Doings {
  readonly search: () => void;
  readonly panel: () => void;
  readonly looks: () => void;
  readonly scenes: () => void;
  readonly open: () => void;
  readonly renderers: () => void;
  readonly compare: () => void;
  readonly path: () => void;
  readonly pictures: () => void;
  readonly video: () => void;
  readonly room: () => void;
  readonly figures: () => void;
  readonly screenshot: () => void;
  readonly copyLink: () => void;
  readonly fullscreen: () => void;
  readonly help: () => void;
  readonly record: () => void;
  readonly lights: () => void;
  readonly playing: () => void;
  readonly nextRenderer: () => void;
  readonly addLight: () => void;
  readonly home: () => void;
  readonly fit: () => void;
  readonly reset: () => void;
  readonly sceneCamera: (index: number) => void;
  readonly look: (look: Look) => void;
}

const action = (title: string, key: string, run: () => void, help: string, words = ''): Entry => ({
  title,
  help,
  key,
  words,
  run,
});

export function actionsOf(does: Doings): readonly Entry[] {
  return [
    action('Search', '/', does.search, 'Finds any action and any setting (Ctrl K too)', 'find command palette'),
    action('Settings', 'c', does.panel, 'Opens or closes the settings', 'panel options controls'),
    action('Looks', 'v', does.looks, 'Shows the looks, and saves the current one', 'preset style mood theme'),
    action('Scenes', 'g', does.scenes, 'Shows the scenes of this server', 'gallery models files open'),
    action('Open', 'i', does.open, 'Opens a scene of your own; or drop it on the page', 'upload import file bring drop glb gltf zip'),
    action('Figures', 'f', does.figures, 'Shows the time of each part of a frame', 'statistics passes latency fps'),
    action('Renderers', 'n', does.renderers, 'Shows the five renderers', 'forward deferred naive toon clustered'),
    action('Compare', 'b', does.compare, 'Shows two settings of the same frame side by side', 'difference slider split error flip heat map versus'),
    action('Camera path', 'y', does.path, 'Moves the camera through key frames of yours', 'animation film movie fly turntable keyframe record'),
    action('Save picture', 'p', does.screenshot, 'Saves the current picture as a PNG file', 'screenshot image download'),
    action('Save picture in a size', '', does.pictures, 'Asks the server for this view in a size of your choice', 'screenshot image download resolution 4k'),
    action('Record a video', '', does.video, 'Saves the camera path, or the current view, as a WebM file', 'film movie webm screen capture'),
    action('Copy link', 'l', does.copyLink, 'Copies a link to this view', 'share url address'),
    action('Room', 'm', does.room, 'Opens a room that others join by its link, or shows the current room', 'share together control watch'),
    action('Full screen', '', does.fullscreen, 'Fills the screen, or leaves it'),
    action('Help', '?', does.help, 'Explains mouse, touch and keys', 'keys shortcuts about'),
    action('Move or stop lights', ' ', does.lights, 'Moves the lights, or stops them', 'pause animate'),
    action('Play or pause animation', 'k', does.playing, 'Plays the scene’s animation, or pauses it'),
    action('Next renderer', 'r', does.nextRenderer, 'Draws with the next of the five renderers', 'toon deferred forward naive'),
    action('Add a light', '', does.addLight, 'Places a light in front of the camera', 'new place'),
    action('Record commands', 'x', does.record, 'Records what this page sends as a script for froxel load; again to end', 'script load test'),
    action('Home', 'h', does.home, 'Returns to the first view of the scene', 'reset view camera start'),
    action('Fit', 'o', does.fit, 'Moves the camera until the whole scene is in the picture', 'frame all overview zoom everything'),
    action('Back to defaults', '', does.reset, 'Resets everything to the server’s defaults', 'reset settings'),
  ];
}

/** The scene's cameras, of which the first nine have keys. */
export const camerasOf = (names: readonly string[], does: Doings): Entry[] =>
  names.map((name, index) =>
    action(`Camera ${name}`, index < 9 ? String(index + 1) : '', () => does.sceneCamera(index), 'Goes to a camera of the scene', 'view go to'),
  );

/** The server's looks, and those that were kept in this browser. */
export const looksOf = (looks: readonly Look[], does: Doings): Entry[] =>
  looks.map((look) => action(`Look ${look.label}`, '', () => does.look(look), look.help, 'preset style mood'));
