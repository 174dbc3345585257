// Keys that act at once; flying keys are CanvasInput's. By letter, as the help says them.

export interface ShortcutActions {
  screenshot(): void;
  copyLink(): void;
  record(): void;
  toggleStats(): void;
  togglePanel(): void;
  toggleHelp(): void;
  toggleLights(): void;
  togglePlaying(): void;
  nextRenderer(): void;
  sceneCamera(index: number): void;
}

/** Runs the action of a key; false when the key has none. */
export function runShortcut(key: string, actions: ShortcutActions): boolean {
  if (/^[1-9]$/.test(key)) {
    actions.sceneCamera(Number(key) - 1);
    return true;
  }
  switch (key.toLowerCase()) {
    case 'p':
      actions.screenshot();
      return true;
    case 'l':
      actions.copyLink();
      return true;
    case 'x':
      actions.record();
      return true;
    case 'f':
      actions.toggleStats();
      return true;
    case 'c':
      actions.togglePanel();
      return true;
    case 'h':
      actions.toggleHelp();
      return true;
    case 'r':
      actions.nextRenderer();
      return true;
    case ' ':
      actions.toggleLights();
      return true;
    case 'k':
      actions.togglePlaying();
      return true;
    default:
      return false;
  }
}

/** Whether a key goes to a control that takes text or choices rather than to the page. */
export function isForControl(target: EventTarget | null): boolean {
  return (
    target instanceof Element &&
    target.closest('input, select, textarea, button, dialog, [contenteditable]') !== null
  );
}
