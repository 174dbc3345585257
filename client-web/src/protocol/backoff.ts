// Reconnect delays: exponential with full jitter above a floor, so that many pages that lost the
// same server do not return together.

export const kFirstDelayMs = 500;
export const kLongestDelayMs = 10_000;

/**
 * Delay before reconnect number `attempt` (0, 1, …) in ms: uniform between the floor and a ceiling
 * that doubles with each attempt. `random` gives values in [0, 1).
 */
export function backoffMs(attempt: number, random: () => number): number {
  const ceiling = Math.min(kLongestDelayMs, kFirstDelayMs * 2 ** (attempt + 1));
  return Math.round(kFirstDelayMs + random() * (ceiling - kFirstDelayMs));
}
