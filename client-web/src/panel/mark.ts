import type { Controller } from 'lil-gui';

/** Names a control: its field for tests, its label, and its tooltip; the search finds it by these. */
export type Mark = (control: Controller, field: string, label: string, help: string) => void;
