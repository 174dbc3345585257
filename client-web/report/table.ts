// Tables whose numbers line up, and command lines that one click copies.

import { make } from '../src/core/dom';

export interface Column<R> {
  readonly head: string;
  readonly title?: string; // of the head, for the pointer
  readonly text: (row: R) => string;
  readonly number?: boolean;
  readonly hint?: (row: R) => string | null; // of the cell, for the pointer
  readonly state?: (row: R) => 'good' | 'bad' | 'faint' | null;
}

async function copy(text: string, button: HTMLButtonElement): Promise<void> {
  const usual = button.textContent;
  try {
    await navigator.clipboard.writeText(text);
    button.textContent = 'copied';
  } catch {
    // A browser may refuse; the text below the table can be copied by hand.
    button.textContent = 'refused';
  }
  setTimeout(() => (button.textContent = usual), 1500);
}

export function copyButton(command: string): HTMLButtonElement {
  const button = make('button', 'copy', 'copy');
  button.type = 'button';
  button.title = command;
  button.addEventListener('click', () => void copy(command, button));
  return button;
}

function cellOf<R>(column: Column<R>, row: R): HTMLTableCellElement {
  const cell = make('td', column.text(row), column.number ? 'number' : '');
  const hint = column.hint?.(row);
  if (hint) cell.title = hint;
  const state = column.state?.(row);
  if (state) cell.classList.add(state);
  return cell;
}

/** A table that scrolls sideways in its frame; `command` adds a column of copy buttons. */
export function table<R>(
  rows: readonly R[],
  columns: readonly Column<R>[],
  command?: (row: R) => string,
): HTMLElement {
  const frame = make('div', '', 'table');
  const made = make('table');
  const head = made.createTHead().insertRow();
  for (const { head: text, title, number } of columns) {
    const cell = make('th', text, number ? 'number' : '');
    cell.scope = 'col';
    if (title) cell.title = title;
    head.append(cell);
  }
  if (command) head.append(make('th'));
  const body = made.createTBody();
  for (const row of rows) {
    const line = body.insertRow();
    line.append(...columns.map((column) => cellOf(column, row)));
    if (command) {
      const cell = make('td');
      cell.append(copyButton(command(row)));
      line.append(cell);
    }
  }
  frame.append(made);
  return frame;
}

/** Every command line as text, folded away. */
export function commandLines(lines: readonly { label: string; command: string }[]): HTMLElement {
  const fold = make('details');
  fold.append(make('summary', `Command lines that draw these frames (${lines.length})`));
  const text = lines.map(({ label, command }) => `# ${label}\n${command}`).join('\n');
  fold.append(make('pre', text, 'commands'));
  return fold;
}

export interface LegendEntry {
  readonly name: string;
  readonly colour: string;
  readonly symbol?: string; // an SVG path around the origin, about 5 px in radius
  readonly hollow?: boolean;
}

export function legend(entries: readonly LegendEntry[]): HTMLElement {
  const list = make('ul', '', 'legend');
  for (const { name, colour, symbol, hollow } of entries) {
    const entry = make('li', name);
    const svg = document.createElementNS('http://www.w3.org/2000/svg', 'svg');
    svg.setAttribute('viewBox', '-7 -7 14 14');
    const mark = document.createElementNS('http://www.w3.org/2000/svg', 'path');
    mark.setAttribute('d', symbol ?? 'M-5,-5H5V5H-5Z');
    mark.style.fill = hollow ? 'none' : colour;
    mark.style.stroke = hollow ? colour : 'none';
    svg.append(mark);
    entry.prepend(svg);
    list.append(entry);
  }
  return list;
}
