// Settings in the page's address, as its fragment, so that a link reproduces a view. Values outside
// the server's ranges are not judged here: the server refuses them and says why.

import { vec, type Vec } from '../core/vec3';
import { isUint32, type Field } from '../settings/field';
import { choicesFor, isGridSide, kAllFields, patchFor } from '../settings/fields';
import { lightSetLine } from '../settings/placed_lights';
import { valueOf, type Bounds, type Ramp, type Settings, type Value } from '../settings/settings';
import type { SizeMode } from './size_policy';

export interface Address {
  readonly settings: Partial<Settings>;
  readonly size: SizeMode | null; // null: the address does not say
  readonly scene: string | null; // its id; null: whatever the server shows
  readonly lightSet: string | null; // of placed lights, as light_set.ts reads it
  readonly path: string | null; // of the camera, as path_file.ts reads it
  /** One line for each key or value that makes no sense; they have no effect. */
  readonly problems: readonly string[];
}

type Writable<T> = { -readonly [Key in keyof T]: T[Key] };

/** Names in addresses of earlier days: read, never written. */
const kFormerNames: ReadonlyMap<string, string> = new Map([
  ['gbuffer.normal', 'gbuffer_normal'],
  ['gbuffer.position', 'gbuffer_position'],
  ['light_seed', 'seed'],
  ['light_animate', 'animate'],
  ['grid.law', 'grid_law'],
]);

const kScene = 'scene';
const kPlacedLights = 'placed_lights';
const kPath = 'path';
const kVectors = ['eye', 'target', 'up'] as const;
const kRamps = { toon_fragment: 'toonFragment', toon_compute: 'toonCompute' } as const;

type Texts = ReadonlyMap<string, string>;

/** All that an address says of these settings, by name. */
function textsOf(settings: Settings): Texts {
  const texts = new Map<string, string>();
  for (const field of kAllFields) {
    if (field.key === 'fovDeg' && settings.orthographic) continue;
    if (isGridSide(field) && settings.gridAutomatic) continue;
    texts.set(field.name, formatField(field, settings));
  }
  if (settings.orthographic) texts.set('half_height', short(settings.halfHeight));
  // To the last bit: two pages of a scene that stands still show the same picture.
  if (settings.lightTime !== null) texts.set('light_time', String(settings.lightTime));
  if (settings.animationTime !== null) texts.set('animation_time', String(settings.animationTime));
  for (const name of kVectors) texts.set(name, formatVec(settings[name]));
  texts.set('compare', settings.compare);
  if (settings.compare !== '') {
    texts.set('compare_split', short(settings.compareSplit));
    texts.set('compare_show', settings.compareHeatMap ? 'heat_map' : 'sides');
  }
  if (settings.lightBox) {
    texts.set('light_box', `${formatVec(settings.lightBox.min)};${formatVec(settings.lightBox.max)}`);
  }
  for (const [name, key] of Object.entries(kRamps)) texts.set(name, formatRamp(settings[key]));
  texts.set(kPlacedLights, encodeURIComponent(lightSetLine(settings.placedLights)));
  return texts;
}

const join = (texts: Iterable<readonly [string, string]>): string =>
  [...texts].map(([name, text]) => `${name}=${text}`).join('&');

/**
 * The fragment, without '#', that turns `initial` into these settings. `size` null: it follows the
 * window as usual. An empty `scene`: the server has no other. `path`: of the camera, as path_file.ts writes it.
 */
export function formatAddress(settings: Settings, size: SizeMode | null, initial: Settings, scene = '', path = ''): string {
  const before = textsOf(initial);
  const texts = new Map<string, string>(scene === '' ? [] : [[kScene, encodeURIComponent(scene)]]);
  for (const [name, text] of textsOf(settings)) if (before.get(name) !== text) texts.set(name, text);
  if (size?.kind === 'auto') texts.set('size', `auto@${short(size.scale)}`);
  if (size?.kind === 'fixed') texts.set('size', `${settings.width}x${settings.height}`);
  if (path !== '') texts.set(kPath, encodeURIComponent(path));
  return join(texts);
}

/** The fragment of those settings that `names` has. */
export const formatOnly = (settings: Settings, names: ReadonlySet<string>): string =>
  join([...textsOf(settings)].filter(([name]) => names.has(name)));

/**
 * What is sent to others for the page at `href`, whose files are at `base`: it leads there, and tells
 * programs that show links a picture of the view (server/net/link_preview.h), who get no fragment.
 */
export function linkTo(href: string, base: string): string {
  const { hash, search } = new URL(href);
  const link = new URL('view', base);
  const room = new URLSearchParams(search).get('room');
  link.search = hash.slice(1);
  if (room !== null) link.searchParams.append('room', room);
  return link.href;
}

/** What is sent to others for a room. */
export function roomLink(room: string, base: string): string {
  const link = new URL(base);
  link.hash = link.search = '';
  link.searchParams.set('room', room);
  return link.href;
}

/** Whether a host's name leads every computer to itself. */
export const isLoopback = (hostname: string): boolean =>
  hostname === 'localhost' || hostname.endsWith('.localhost') || hostname === '[::1]' || hostname.startsWith('127.');

/** What `render?` takes for a picture of this view, with `over`, an address with a size, over it. */
export function stillAddress(settings: Settings, scene: string, over: string): string {
  const query = new URLSearchParams(join(textsOf(settings)));
  if (scene !== '') query.set(kScene, scene);
  for (const [name, text] of new URLSearchParams(over)) query.set(name, text);
  return query.toString();
}

/** What others add to links that pass through them, to follow who clicks: nobody typed it. */
const kStrangers = /^(utm_|mc_|igsh|(\w*clk?id|_g[al]|srsltid|ref|si)$)/;

/** Reads a fragment with or without its '#'. Never throws. */
export function parseAddress(fragment: string): Address {
  const settings: Partial<Writable<Settings>> = {};
  const problems: string[] = [];
  let size: SizeMode | null = null;
  let scene: string | null = null;
  let lightSet: string | null = null;
  let path: string | null = null;
  for (const [name, text] of new URLSearchParams(fragment.replace(/^#/, ''))) {
    if (name === kScene) {
      scene = text === '' ? null : text;
      continue;
    }
    if (name === kPlacedLights) {
      lightSet = text;
      continue;
    }
    if (name === kPath) {
      path = text;
      continue;
    }
    if (kStrangers.test(name)) continue;
    const found = parseEntry(kFormerNames.get(name) ?? name, text);
    if (found === null) {
      problems.push(`link: ${name.slice(0, 30)}=${text.slice(0, 60)} is not understood`);
    } else {
      Object.assign(settings, found.settings);
      size = found.size ?? size;
    }
  }
  return { settings, size, scene, lightSet, path, problems };
}

interface Entry {
  readonly settings: Partial<Settings>;
  readonly size?: SizeMode;
}

function parseEntry(name: string, text: string): Entry | null {
  const field = kAllFields.find((candidate) => candidate.name === name);
  if (field) return parseField(field, text);
  if (name === 'size') return parseSize(text);
  if (name === 'half_height') {
    const halfHeight = parseNumber(text);
    return halfHeight === null ? null : { settings: { halfHeight, orthographic: true } };
  }
  if (name === 'light_time') {
    const lightTime = parseNumber(text);
    return lightTime === null ? null : { settings: { lightTime } };
  }
  if (name === 'animation_time') {
    const animationTime = parseNumber(text);
    return animationTime === null ? null : { settings: { animationTime } };
  }
  if (name === 'compare') return { settings: { compare: text } };
  if (name === 'compare_split') {
    const compareSplit = parseNumber(text);
    return compareSplit === null ? null : { settings: { compareSplit } };
  }
  if (name === 'compare_show') {
    return text === 'sides' || text === 'heat_map' ? { settings: { compareHeatMap: text === 'heat_map' } } : null;
  }
  if (name === 'light_box') {
    const lightBox = parseBox(text);
    return lightBox && { settings: { lightBox } };
  }
  const vector = kVectors.find((candidate) => candidate === name);
  if (vector) {
    const value = parseVec(text);
    return value && { settings: { [vector]: value } };
  }
  if (name === 'toon_fragment' || name === 'toon_compute') {
    const ramp = parseRamp(text);
    return ramp && { settings: { [kRamps[name]]: ramp } };
  }
  return null;
}

function formatField(field: Field, settings: Settings): string {
  if (field.kind === 'boolean') return valueOf(settings, field) ? '1' : '0';
  if (field.kind === 'number') return short(valueOf(settings, field));
  if (field.kind === 'color') return formatVec(valueOf(settings, field));
  const value = valueOf(settings, field);
  return choicesFor(field).find((choice) => choice.value === value)?.name ?? String(value);
}

function parseField(field: Field, text: string): Entry | null {
  const value = parseValue(field, text);
  return value === null ? null : { settings: patchFor(field, value) };
}

function parseValue(field: Field, text: string): Value | null {
  if (field.kind === 'boolean') return text === '0' || text === '1' ? text === '1' : null;
  if (field.kind === 'color') return parseVec(text);
  if (field.kind === 'choice') {
    return choicesFor(field).find(({ name }) => name === text)?.value ?? null;
  }
  const value = parseNumber(text);
  return value === null || (field.integer && !isUint32(value)) ? null : value;
}

function parseSize(text: string): Entry | null {
  const auto = /^auto@(.+)$/.exec(text);
  if (auto) {
    const factor = parseNumber(auto[1] ?? '');
    if (factor === null || factor <= 0) return null;
    return { settings: {}, size: { kind: 'auto', scale: factor } };
  }
  const [width, height] = text.split('x').map(parseNumber);
  if (width == null || height == null || !isUint32(width) || !isUint32(height)) return null;
  return { settings: { width, height }, size: { kind: 'fixed' } };
}

function parseBox(text: string): Bounds | null {
  const [min, max, ...rest] = text.split(';').map(parseVec);
  return min && max && rest.length === 0 ? { min, max } : null;
}

function formatRamp(ramp: Ramp): string {
  return ramp.map((point) => [point.x, point.y, point.slope].map(short).join(',')).join(';');
}

function parseRamp(text: string): Ramp | null {
  const points = text.split(';').map(parseVec);
  const ramp = points.flatMap((p) => (p ? [{ x: p.x, y: p.y, slope: p.z }] : []));
  return ramp.length === points.length ? ramp : null;
}

const formatVec = (v: Vec): string => [v.x, v.y, v.z].map(short).join(',');

function parseVec(text: string): Vec | null {
  const [x, y, z, ...rest] = text.split(',').map(parseNumber);
  return x == null || y == null || z == null || rest.length > 0 ? null : vec(x, y, z);
}

function parseNumber(text: string): number | null {
  const value = Number(text);
  return text.trim() !== '' && Number.isFinite(value) ? value : null;
}

/**
 * The server's 32-bit floats by their shortest text ("0.1", not "0.10000000149"); others, such as
 * positions, with twelve digits: a micrometre at 1,000 km.
 */
function short(value: number): string {
  if (Number.isInteger(value)) return String(value);
  if (Math.fround(value) !== value) return String(Number(value.toPrecision(12)));
  for (let digits = 6; digits < 9; digits += 1) {
    const rounded = Number(value.toPrecision(digits));
    if (Math.fround(rounded) === value) return String(rounded);
  }
  return String(Number(value.toPrecision(9)));
}
