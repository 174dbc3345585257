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
    help: 'Evaluates every light for every pixel. The picture is the same. It is slow from some hundred lights on, and shows the gain of light lists.',
  },
  {
    renderer: Renderer.TOON_FRAGMENT,
    label: 'Toon, light by light',
    help: 'Cel shading: the light of each lamp has steps.',
  },
  {
    renderer: Renderer.TOON_COMPUTE,
    label: 'Toon, brightness in steps',
    help: 'Cel shading: the sum of all light has steps, with outlines.',
  },
];

export const rendererLabel = (renderer: Renderer): string =>
  kRenderers.find((words) => words.renderer === renderer)?.label ?? 'another renderer';
