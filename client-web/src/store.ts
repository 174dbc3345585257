// Holds the state, runs the reducer and tells the listeners; actions dispatched by a listener run
// after the present one.

import { kInitialState, reduce, type Action, type AppState } from './app_state';

export type Listener = (state: AppState, before: AppState) => void;

export class Store {
  private current = kInitialState;
  private readonly listeners: Listener[] = [];
  private readonly queue: Action[] = [];
  private running = false;

  get state(): AppState {
    return this.current;
  }

  listen(listener: Listener): void {
    this.listeners.push(listener);
  }

  dispatch(action: Action): void {
    this.queue.push(action);
    if (this.running) return;
    this.running = true;
    try {
      for (let next = this.queue.shift(); next; next = this.queue.shift()) {
        const before = this.current;
        this.current = reduce(before, next);
        if (this.current === before) continue;
        for (const listener of this.listeners) listener(this.current, before);
      }
    } finally {
      this.running = false;
    }
  }
}
