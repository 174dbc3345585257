import { describe, expect, it } from 'vitest';

import {
  Antialiasing,
  BloomKind,
  DebugView,
  GridLaw,
  LightingStage,
  LightLoop,
  NormalEncoding,
  PositionSource,
  Renderer,
  ShadingModel,
  Transparency,
} from '../../src/gen/froxel/v1/common_pb';
import { formatAddress, isLoopback, linkTo, parseAddress, roomLink, stillAddress } from '../../src/state/address';
import { lightSetOf } from '../../src/settings/light_set';
import { kNewLight, type PlacedLights } from '../../src/settings/placed_lights';
import type { SizeMode } from '../../src/state/size_policy';
import { kBounds, sampleSettings } from '../sample';

const kAuto: SizeMode = { kind: 'auto', scale: 0.75 };
const initial = sampleSettings();

describe('links', () => {
  const base = 'https://froxel.example/below/';

  it('HaveTheViewWhereServersSeeIt', () => {
    expect(linkTo(`${base}#eye=1,2,3&size=auto@1`, base)).toBe(`${base}view?eye=1,2,3&size=auto@1`);
  });

  it('KeepTheRoom_AndNothingElseOfTheQuery', () => {
    const link = new URL(linkTo(`${base}index.html?room=us&x=y#scene=a%20b`, base));
    expect(link.pathname).toBe('/below/view');
    expect([...link.searchParams]).toEqual([
      ['scene', 'a b'],
      ['room', 'us'],
    ]);
  });
});

describe('links to rooms', () => {
  it('HaveTheRoomAlone', () => {
    expect(roomLink('us', 'https://froxel.example/below/')).toBe('https://froxel.example/below/?room=us');
  });
});

describe('isLoopback', () => {
  it('OfHostsThatLeadToEachComputerItself', () => {
    expect(['localhost', 'a.localhost', '127.0.0.1', '127.9.0.1', '[::1]'].filter(isLoopback)).toHaveLength(5);
    expect(['froxel.example', '10.0.0.1', '[::2]', 'localhost.example'].filter(isLoopback)).toEqual([]);
  });
});

describe('stills', () => {
  it('HaveWhatIsOver_OverTheView_AndNothingTwice', () => {
    const query = new URLSearchParams(stillAddress(initial, 'a b', 'lights=7&bloom=none&size=64x36'));
    expect(query.get('lights')).toBe('7');
    expect(query.get('bloom')).toBe('none');
    expect(query.get('scene')).toBe('a b');
    expect(query.get('size')).toBe('64x36');
    expect(query.get('eye')).toBe([initial.eye.x, initial.eye.y, initial.eye.z].join(','));
    expect(new Set(query.keys()).size).toBe([...query.keys()].length);
  });
});

describe('addresses', () => {
  it('RoundTrip_OfEverything_IsTheSameView', () => {
    const settings = sampleSettings({
      eye: { x: 1.5, y: -2, z: 1e6 },
      renderer: Renderer.TOON_COMPUTE,
      lighting: LightingStage.FRAGMENT,
      lights: 31_000,
      lightRadius: 0.125,
      animate: false,
      lightBox: kBounds,
      gridAutomatic: false,
      gridZ: 64,
      gridLaw: GridLaw.HYPERBOLIC,
      lightLoop: LightLoop.ALL_LIGHTS,
      countPairs: true,
      debugView: DebugView.CLUSTER_WIRES,
      debugScaleMax: 12.5,
      debugFrozen: true,
      lightTime: 0.1 + 0.2,
      animation: 2,
      animationTime: 0.3 + 0.6,
      materialVariant: 3,
      shading: ShadingModel.BLINN_PHONG,
      bloom: BloomKind.A_TROUS,
      bloomRadius: 0.02,
      antialiasing: Antialiasing.FXAA,
      transparency: Transparency.PEELED,
      peelLayers: 9,
      shadowLights: 6,
      shadowSize: 384,
      outlineStrength: 0.75,
      fogDensity: 0.05,
      fogBaseHeight: -2.5,
      fogHalfRate: true,
      fogAlbedo: { x: 1, y: 0.25, z: 0 },
      gbufferNormal: NormalEncoding.SPHEREMAP16,
      gbufferPosition: PositionSource.STORED_DEPTH,
      lensShiftX: -0.5,
      lensShiftY: 1,
      toonFragment: [
        { x: 0, y: 0, slope: 0.5 },
        { x: 1, y: 1, slope: -3 },
      ],
      width: 333,
      height: 77,
      compare: 'renderer:naive,list_cap:16',
      compareSplit: 0.25,
      compareHeatMap: true,
    });
    const address = parseAddress(`#${formatAddress(settings, { kind: 'fixed' }, initial)}`);
    expect(address.problems).toEqual([]);
    expect(address.size).toEqual({ kind: 'fixed' });
    expect({ ...initial, ...address.settings }).toEqual(settings);
  });

  it('RoundTrip_OfAnOrthographicView_KeepsItsHeight', () => {
    const settings = sampleSettings({ orthographic: true, halfHeight: 3.5 });
    const written = formatAddress(settings, kAuto, initial);
    const address = parseAddress(written);
    expect({ ...initial, ...address.settings }).toEqual(settings);
    expect(written).not.toContain('fov');
    const back = formatAddress({ ...settings, orthographic: false }, kAuto, settings);
    expect(back).toContain('fov');
    expect(parseAddress(back).settings.orthographic).toBe(false);
  });

  it('Scene_IsInTheAddressWhereThereAreSeveral', () => {
    const written = formatAddress(initial, kAuto, initial, 'a b&c');
    expect(parseAddress(written)).toMatchObject({ scene: 'a b&c', problems: [] });
    expect(formatAddress(initial, kAuto, initial)).not.toContain('scene=');
    expect(parseAddress('scene=&lights=5').scene).toBeNull();
  });

  it('WhatOthersAddToLinks_IsPassedOver_AndATypoIsNot', () => {
    const { settings, problems } = parseAddress('#lights=7&fbclid=IwAR0&utm_source=mail&&gclid=1');
    expect(settings).toEqual({ lights: 7 });
    expect(problems).toEqual([]);
    expect(parseAddress('#ligths=7').problems).toHaveLength(1);
  });

  it('RampsAsTheyWere_AreNotInTheAddress', () => {
    expect(formatAddress(initial, kAuto, initial)).not.toMatch(/toon_(fragment|compute)=/);
  });

  it('WhatIsAsAtFirst_IsNotInTheAddress', () => {
    expect(formatAddress(initial, null, initial)).toBe('');
    expect(formatAddress(sampleSettings({ lights: 5 }), null, initial)).toBe('lights=5');
    expect(formatAddress(initial, kAuto, initial)).toBe('size=auto@0.75');
  });

  it('PlacedLights_AreInTheAddress_AndWhereAllWereRemoved', () => {
    const light = { ...kNewLight, id: 3, position: { x: 0.1, y: 2, z: -3 }, color: { x: 1, y: 0.5, z: 0 } };
    const placed = sampleSettings({ placedLights: [light] });
    const written = formatAddress(placed, null, initial);
    expect(parseAddress(written).problems).toEqual([]);
    const lightsOf = (address: string): PlacedLights => lightSetOf(parseAddress(address).lightSet ?? '');
    expect(lightsOf(written)).toEqual([light]);
    expect(lightsOf(formatAddress(initial, null, placed))).toEqual([]);
    expect(written.length).toBeLessThan(200);
  });

  it('AutomaticGrid_HasNoSizeInTheAddress', () => {
    const text = formatAddress(initial, kAuto, sampleSettings({ gridAutomatic: false, gridX: 5 }));
    expect(text).toContain('grid.auto=1');
    expect(text).not.toContain('grid.x');
  });

  it('GridSize_InAnOldAddress_IsOneByHand', () => {
    expect(parseAddress('grid.x=5').settings).toEqual({ gridX: 5, gridAutomatic: false });
  });

  it('FormerNames_AreReadAndNotWritten', () => {
    const old =
      'gbuffer.normal=oct8&gbuffer.position=fp32&light_seed=7&light_animate=0&grid.law=linear';
    const address = parseAddress(old);
    expect(address.problems).toEqual([]);
    expect(address.settings).toEqual({
      gbufferNormal: NormalEncoding.OCT8,
      gbufferPosition: PositionSource.FP32,
      seed: 7,
      animate: false,
      gridLaw: GridLaw.LINEAR,
    });
    const written = new URLSearchParams(formatAddress({ ...initial, ...address.settings }, kAuto, initial));
    for (const [name] of new URLSearchParams(old)) expect(written.has(name)).toBe(false);
    expect(written.get('grid_law')).toBe('linear');
  });

  it('LightTime_WhileTheLightsMove_IsNotInTheAddress', () => {
    expect(formatAddress(initial, kAuto, initial)).not.toContain('light_time');
  });

  it('AutomaticSize_IsItsScaleAndNoPixels', () => {
    const text = formatAddress(initial, kAuto, initial);
    expect(text).toContain('size=auto@0.75');
    expect(parseAddress(text).settings.width).toBeUndefined();
    expect(parseAddress(text).size).toEqual(kAuto);
  });

  it('Numbers_ReadAsPeopleWriteThem', () => {
    const float = Math.fround(0.1);
    expect(formatAddress(sampleSettings({ exposure: float }), kAuto, initial)).toContain('exposure=0.1&');
  });

  it.each([2_147_483_648, 4_294_967_295, 16_777_217])('WholeNumber_%i_StaysExact', (seed) => {
    const address = parseAddress(formatAddress(sampleSettings({ seed }), kAuto, initial));
    expect(address.settings).toMatchObject({ seed });
  });

  it('CameraPath_IsKeptAsItIs_AndItsReaderJudgesIt', () => {
    const path = '{"seconds":2,"keys":[{"eye":[0,1,2],"target":[0,0,0]}]}';
    const text = formatAddress(initial, kAuto, initial, '', path);
    expect(parseAddress(`#${text}`)).toMatchObject({ path, problems: [] });
    expect(formatAddress(initial, kAuto, initial)).not.toContain('path');
    expect(parseAddress('#path=nonsense').path).toBe('nonsense');
  });

  it('NothingAfterTheHash_IsNothing', () => {
    expect(parseAddress('')).toEqual({ settings: {}, size: null, scene: null, lightSet: null, path: null, problems: [] });
    expect(parseAddress('#')).toEqual({ settings: {}, size: null, scene: null, lightSet: null, path: null, problems: [] });
  });

  it.each([
    'lights=many',
    'lights=1.5',
    'lights=-1',
    'lights=99999999999',
    'light_radius=NaN',
    'exposure=Infinity',
    'exposure=',
    'renderer=fastest',
    'chroma=422',
    'animate=yes',
    'light_animate=yes',
    'eye=1,2',
    'eye=1,2,3,4',
    'light_box=1,2,3',
    'light_box=1,2,3;4,5,x',
    'size=auto@0',
    'size=100',
    'size=10x-1',
    'toon_fragment=0,1',
    'half_height=x',
    'light_time=noon',
    'gbuffer_normal=oct7',
    'fog_albedo=1,2',
    'constructor=1',
    'grid.auto=maybe',
    'colour=red',
  ])('Nonsense_%s_IsNamedAndHasNoEffect', (entry) => {
    const address = parseAddress(`#${entry}&quality=7`);
    expect(address.problems).toEqual([`link: ${entry} is not understood`]);
    expect(address.settings).toEqual({ quality: 7 });
  });

  it('ValueOutOfTheServersRange_IsLeftToTheServer', () => {
    expect(parseAddress('#lights=4000000000').settings).toEqual({ lights: 4_000_000_000 });
  });
});
