// The renderers in the words of the page.

import { Renderer } from '../gen/froxel/v1/common_pb';

interface Words {
  readonly renderer: Renderer;
  readonly label: string;
  readonly help: string;
}

export const kRenderers: readonly Words[] = [
  {
    renderer: Renderer.CLUSTERED_DEFERRED,
    label: 'Clustered deferred',
    help: 'Draws all surfaces first, then lights each pixel once with the lights near it. Fast where surfaces overlap.',
  },
  {
    renderer: Renderer.FORWARD_PLUS,
    label: 'Forward+ (clustered forward)',
    help: 'Lights each surface as it is drawn, with the lights near it. Needs less memory.',
  },
  {
    renderer: Renderer.NAIVE,
    label: 'Naive',
    help: 'Asks every light for every pixel. The same picture, slow from some hundred lights on: it shows what lists of lights save.',
  },
  {
    renderer: Renderer.TOON_FRAGMENT,
    label: 'Toon, light by light',
    help: 'Cel shading: the light of each lamp comes in steps.',
  },
  {
    renderer: Renderer.TOON_COMPUTE,
    label: 'Toon, brightness in steps',
    help: 'Cel shading: the sum of all light comes in steps, with outlines.',
  },
];

export const rendererLabel = (renderer: Renderer): string =>
  kRenderers.find((words) => words.renderer === renderer)?.label ?? 'another renderer';
