// Holds the state, runs the reducer and tells the listeners; actions dispatched by a listener run
// after the present one. What goes out to the server waits until no action is left.

import { kInitialState, reduce, type Action, type AppState } from './app_state';

export type Listener = (state: AppState, before: AppState) => void;

export class Store {
  private current = kInitialState;
  private readonly listeners: Listener[] = [];
  private readonly settledListeners: ((state: AppState) => void)[] = [];
  private readonly queue: Action[] = [];
  private running = false;

  get state(): AppState {
    return this.current;
  }

  /** After each action that changed something. */
  listen(listener: Listener): void {
    this.listeners.push(listener);
  }

  /** When no action is left: of changes that follow from one another, the last state alone. */
  listenSettled(listener: (state: AppState) => void): void {
    this.settledListeners.push(listener);
  }

  dispatch(action: Action): void {
    this.queue.push(action);
    if (this.running) return;
    this.running = true;
    try {
      do {
        this.runQueue();
        for (const listener of this.settledListeners) listener(this.current);
      } while (this.queue.length > 0);
    } finally {
      this.running = false;
    }
  }

  private runQueue(): void {
    for (let next = this.queue.shift(); next; next = this.queue.shift()) {
      const before = this.current;
      this.current = reduce(before, next);
      if (this.current === before) continue;
      for (const listener of this.listeners) listener(this.current, before);
    }
  }
}
