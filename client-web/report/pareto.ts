// Which points are worth having: no other is both as fast and as exact.

export interface Point {
  readonly x: number;
  readonly y: number;
}

/**
 * The points that no other beats in x and y, both the less the better, by ascending x and descending y.
 * Of equal points the first stays.
 */
export function paretoFront<P extends Point>(points: readonly P[]): P[] {
  const front: P[] = [];
  let least = Infinity;
  const ordered = points
    .filter(({ x, y }) => !Number.isNaN(x) && !Number.isNaN(y))
    .sort((a, b) => a.x - b.x || a.y - b.y);
  for (const point of ordered) {
    if (point.y < least) {
      front.push(point);
      least = point.y;
    }
  }
  return front;
}
