// One colour a series and one a part of a bar, the same in every plot (report.css has them for light and
// dark), and the shapes of marks.

const kRenderers = ['naive', 'forward_plus', 'clustered_deferred', 'toon_fragment', 'toon_compute'];
const kColourCount = 12;

/**
 * Renderers have their own colours, and so has the first way of one (`naive, compute`); a second way is
 * paler. Others take the rest in their order.
 */
export function seriesColours(names: readonly string[]): Map<string, string> {
  const colours = new Map<string, string>();
  const ways = new Map<number, number>(); // seen of each renderer
  let next = kRenderers.length;
  for (const name of new Set(names)) {
    const renderer = kRenderers.indexOf(name.split(',')[0] ?? '');
    if (renderer < 0) {
      colours.set(name, `var(--c${next++ % kColourCount})`);
      continue;
    }
    const way = name.includes(',') ? (ways.get(renderer) ?? 0) : 0;
    if (name.includes(',')) ways.set(renderer, way + 1);
    colours.set(name, `var(--c${renderer}${way === 0 ? '' : 'b'})`);
  }
  return colours;
}

/** Passes and purposes of memory, in the order of their first use. */
export function partColours(names: Iterable<string>): Map<string, string> {
  const colours = new Map<string, string>();
  for (const name of names) {
    if (!colours.has(name)) colours.set(name, `var(--p${colours.size % kColourCount})`);
  }
  return colours;
}

type Corners = readonly (readonly [number, number])[];

const polygon = (count: number, radius: number, turn = 0): Corners =>
  Array.from({ length: count }, (_, index) => {
    const angle = (2 * Math.PI * index) / count + turn;
    return [radius * Math.sin(angle), -radius * Math.cos(angle)];
  });

const spiked = (count: number, outer: number, inner: number): Corners =>
  polygon(2 * count, 1).map(([x, y], index) => {
    const radius = index % 2 === 0 ? outer : inner;
    return [x * radius, y * radius];
  });

/** Corners of marks about 5 px in radius, y down, those that differ most first. */
const kShapes: readonly Corners[] = [
  polygon(24, 5),
  polygon(4, 6, Math.PI / 4),
  polygon(3, 6.4),
  spiked(5, 6.6, 2.7),
  polygon(4, 6.2),
  polygon(3, 6.4, Math.PI),
  spiked(4, 6.6, 2.2),
  polygon(6, 5.6),
  polygon(3, 6.4, Math.PI / 2),
  spiked(3, 6.8, 2),
  [
    [-6, -5],
    [6, 5],
    [6, -5],
    [-6, 5],
  ], // an hourglass on its side
  [
    [-6, -2.2],
    [6, -2.2],
    [6, 2.2],
    [-6, 2.2],
  ],
];

/** A mark that plots draw and legends show as a path. */
export interface Shape {
  readonly path: string;
  readonly draw: (
    context: {
      moveTo(x: number, y: number): void;
      lineTo(x: number, y: number): void;
      closePath(): void;
    },
    size: number,
  ) => void;
}

const shapeOf = (corners: Corners): Shape => ({
  path: `M${corners.map((corner) => corner.map((at) => at.toFixed(2)).join(',')).join('L')}Z`,
  draw: (context, size) => {
    const scale = Math.sqrt(size / Math.PI) / 5; // `size` is an area
    for (const [index, [x, y]] of corners.entries()) {
      if (index === 0) context.moveTo(x * scale, y * scale);
      else context.lineTo(x * scale, y * scale);
    }
    context.closePath();
  },
});

export const kDot = shapeOf(polygon(24, 5));

/** A shape for each name, in their order; beyond a dozen they repeat. */
export function shapesOf(names: readonly string[]): Map<string, Shape> {
  const shapes = kShapes.map(shapeOf);
  return new Map(
    [...new Set(names)].map((name, index) => [name, shapes[index % shapes.length] ?? kDot]),
  );
}
