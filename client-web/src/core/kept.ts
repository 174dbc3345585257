// Small choices that this browser keeps for the next visit; where it forbids that, they are forgotten.

const kPrefix = 'froxel.';

export function kept(name: string): string | null {
  try {
    return localStorage.getItem(kPrefix + name);
  } catch {
    return null;
  }
}

export function keep(name: string, value: string): void {
  try {
    localStorage.setItem(kPrefix + name, value);
  } catch {
    // forbidden or full
  }
}
