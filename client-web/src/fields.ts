// The table of scalar settings: the panel builds its controls from it and the URL its keys.
// `name` is the protocol's name, under which Welcome.ranges tells what the server accepts.

import {
  BloomKind,
  ChromaSchema,
  Codec,
  CodecSchema,
  DebugViewSchema,
  GridLawSchema,
  LightingStageSchema,
  LightLoopSchema,
  NormalEncodingSchema,
  PositionSourceSchema,
  RefineSchema,
  RendererSchema,
  ShadingModelSchema,
  ToneMapSchema,
  Transparency,
} from './gen/froxel/v1/common_pb';
import { kEffectFields } from './effect_fields';
import { choice, number, toggle, type ChoiceField, type Field, type Section } from './field';
import { choicesOf, type Choice } from './schema_names';
import { isDeferred, isToon, type Settings } from './settings';

export const kFields: Readonly<Record<Section, readonly Field[]>> = {
  camera: [
    number('fovDeg', 'fov_deg', 'Field of view °', 'linear', false, 'Full vertical angle'),
    number(
      'lensShiftX',
      'lens_shift.x',
      'Lens shift →',
      'none',
      false,
      'Moves the picture’s middle right of the view axis, in half widths',
    ),
    number(
      'lensShiftY',
      'lens_shift.y',
      'Lens shift ↑',
      'none',
      false,
      'Moves the picture’s middle above the view axis, in half heights: straight verticals',
    ),
  ],
  rendering: [
    choice('renderer', 'renderer', 'Renderer', RendererSchema, 'How the scene is lit'),
    choice(
      'lighting',
      'lighting',
      'Lighting stage',
      LightingStageSchema,
      'Where lights are added up. auto: compute; fragment for the forward renderers on a CPU device',
    ),
    choice(
      'shading',
      'shading',
      'Shading',
      ShadingModelSchema,
      'pbr: metallic-roughness; lambert: its diffuse part alone, a third of a light’s cost; blinn_phong: another highlight, as dear as pbr',
    ),
    choice(
      'gbufferNormal',
      'gbuffer.normal',
      'G-buffer normal',
      NormalEncodingSchema,
      'How the deferred renderers keep normals: octahedral with bits a component, or three others',
    ),
    choice(
      'gbufferPosition',
      'gbuffer.position',
      'G-buffer place',
      PositionSourceSchema,
      'Where deferred lighting takes a pixel’s position from',
    ),
    number('exposure', 'exposure', 'Exposure', 'log', false, 'Multiplies light before the tone map'),
    choice('toneMap', 'tone_map', 'Tone map', ToneMapSchema, 'From scene light to display colours'),
  ],
  effects: kEffectFields,
  lights: [
    number('lights', 'lights', 'Count', 'log', true, 'Moving point lights'),
    number(
      'lightRadius',
      'light_radius',
      'Radius m',
      'log',
      false,
      "Where a light's contribution reaches exactly zero",
    ),
    number('lightIntensity', 'light_intensity', 'Intensity', 'log', false, 'Scales every moving light'),
    number(
      'lightCutoff',
      'light_cutoff',
      'Cut-off',
      'log',
      false,
      'A light ends where its irradiance would fall to this: faster, darker. 0: at its radius',
    ),
    toggle(
      'lightCutoffCompensated',
      'light_cutoff_compensated',
      'Give back',
      'Lights that end early are brighter by what they lost; costs nothing',
    ),
    number('lightSpeed', 'light_speed', 'Speed', 'log', false, "Scales the animation's clock"),
    number('lightSeed', 'light_seed', 'Seed', 'none', true, 'Places, paths and colours of the lights'),
    toggle('lightAnimate', 'light_animate', 'Animate', 'Off: time stands still'),
    number('ambient', 'ambient', 'Ambient', 'log', false, 'Scales the light that comes from everywhere'),
    toggle('sceneLights', 'scene_lights', 'Scene lights', "The scene's own lights"),
  ],
  clusters: [
    choice(
      'lightLoop',
      'light_loop',
      'Light loop',
      LightLoopSchema,
      'Which lights a pixel loops over. auto: all of them where lists cannot pay',
    ),
    number(
      'listCap',
      'list_cap',
      'List cap',
      'linear',
      true,
      'Lights that a list keeps at most, those that can add most: faster, darker; assigned on the host. 0: all',
    ),
    toggle(
      'countPairs',
      'count_pairs',
      'Count pairs',
      'Evaluated and contributing (light, pixel) pairs, in the figures; costs time',
    ),
    toggle(
      'gridAutomatic',
      'grid.auto',
      'Automatic',
      'The server chooses the grid; off: the size below',
    ),
    choice('gridLaw', 'grid.law', 'Slices', GridLawSchema, 'How slices divide depth'),
    number('gridX', 'grid.x', 'Tiles across', 'linear', true, 'Clusters along the width'),
    number('gridY', 'grid.y', 'Tiles down', 'linear', true, 'Clusters along the height'),
    number('gridZ', 'grid.z', 'Depth slices', 'linear', true, 'Clusters along the depth'),
  ],
  debug: [
    choice(
      'debugView',
      'debug_view',
      'Show',
      DebugViewSchema,
      'A value of each pixel instead of the lit picture: saves the lighting, costs one pass; spheres and wires: lines over it, one pass more',
    ),
    number(
      'debugScaleMax',
      'debug_scale_max',
      'Scale’s end',
      'none',
      false,
      'Where a heat map ends, in its unit; 0: chosen. Costs nothing',
    ),
    toggle(
      'debugFrozen',
      'debug_frozen',
      'Freeze clusters',
      'Keeps this camera’s cluster grid for the cluster wires while the view moves on; costs the host a second grid',
    ),
  ],
  stream: [
    choice(
      'codec',
      'codec',
      'Codec',
      CodecSchema,
      'jpeg: each picture by itself; vp9: video, a few times fewer bits for more work',
    ),
    number(
      'videoKbps',
      'video_kbps',
      'Video kbit/s',
      'log',
      true,
      'What the video codec aims at; higher: sharper, more bytes',
    ),
    number('quality', 'quality', 'JPEG quality', 'linear', true, 'Higher: sharper, more bytes'),
    choice(
      'chroma',
      'chroma',
      'Chroma',
      ChromaSchema,
      '444 keeps full colour resolution, 420 sends fewer bytes',
    ),
    toggle(
      'adaptive',
      'adaptive',
      'Adaptive',
      'Quality, then resolution give way to a slow link; off: frames come late instead',
    ),
    number(
      'targetFps',
      'target_fps',
      'Target rate',
      'linear',
      false,
      'Frames a second that a moving view keeps at the expense of its resolution. 0: none',
    ),
    choice(
      'refine',
      'refine',
      'At rest',
      RefineSchema,
      'How far a resting picture is refined: as asked for, at high quality, or without loss',
    ),
  ],
};

export const kAllFields: readonly Field[] = Object.values(kFields).flat();

const kPng: number = Codec.PNG;
const kNoBloom = BloomKind.NONE;
const kPeeled = Transparency.PEELED;

/** The values that a viewer may choose; PNG is the server's own choice, for a resting picture. */
export const choicesFor = ({ key, schema }: ChoiceField): Choice[] =>
  choicesOf(schema).filter(({ value }) => key !== 'codec' || value !== kPng);

const kGridSides: readonly string[] = ['gridX', 'gridY', 'gridZ'];

/** Whether a field is one of the grid's sides, which count only while it is not automatic. */
export const isGridSide = ({ key }: Field): boolean => kGridSides.includes(key);

/** Whether a field changes anything as the other settings are. */
export function isInUse(field: Field, settings: Settings): boolean {
  if (isGridSide(field)) return !settings.gridAutomatic;
  if (field.name.startsWith('gbuffer.')) return isDeferred(settings);
  if (field.name.startsWith('outline_')) return isToon(settings);
  if (field.name.startsWith('fog_') && field.key !== 'fogDensity') return settings.fogDensity > 0;
  if (field.name === 'shadow_size') return settings.shadowLights > 0;
  if (field.name.startsWith('bloom_')) return settings.bloom !== kNoBloom;
  if (field.name === 'peel_layers') return settings.transparency === kPeeled;
  return true;
}

/**
 * The edit that sets a field; an angle of view makes the projection perspective, and a side of the
 * grid makes it one by hand.
 */
export function patchFor(field: Field, value: number | boolean): Partial<Settings> {
  return {
    [field.key]: value,
    ...(field.key === 'fovDeg' && { orthographic: false }),
    ...(isGridSide(field) && { gridAutomatic: false }),
  };
}
