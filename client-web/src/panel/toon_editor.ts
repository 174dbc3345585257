// A toon ramp as a curve with points to drag, and the chosen point's numbers below.

import { make } from '../core/dom';
import { sameRamp, type Ramp, type RampPoint } from '../settings/settings';
import { dragged, evaluate, inserted, removed, replaced } from './ramp';

const kSvg = 'http://www.w3.org/2000/svg';
const kWidth = 260;
const kHeight = 96;
const kMargin = 8; // the curve's distance from the edge, so that points at 0 and 1 can be held
const kCurveSteps = 120;

const xOf = (x: number): number => kMargin + x * (kWidth - 2 * kMargin);
const yOf = (y: number): number => kHeight - kMargin - y * (kHeight - 2 * kMargin);

export class ToonEditor {
  private readonly svg = document.createElementNS(kSvg, 'svg');
  private readonly curve = document.createElementNS(kSvg, 'polyline');
  private readonly numbers: Readonly<Record<keyof RampPoint, HTMLInputElement>>;
  private ramp: Ramp = [];
  private chosen = 0;

  constructor(
    parent: HTMLElement,
    caption: string,
    private readonly onEdit: (ramp: Ramp) => void,
  ) {
    const figure = make('figure', '', 'ramp');
    this.svg.setAttribute('viewBox', `0 0 ${kWidth} ${kHeight}`);
    this.svg.setAttribute('preserveAspectRatio', 'none');
    this.svg.append(this.curve);
    this.svg.addEventListener('pointerdown', (event) => this.grab(event));
    this.svg.addEventListener('pointermove', (event) => this.drag(event));

    const row = make('div', '', 'point');
    this.numbers = {
      x: this.numberInput(row, 'x'),
      y: this.numberInput(row, 'y'),
      slope: this.numberInput(row, 'slope'),
    };
    this.button(row, '+', 'Add a point after this one', () => {
      const added = inserted(this.ramp, this.chosen);
      this.chosen = added.index;
      this.onEdit(added.ramp);
    });
    this.button(row, '−', 'Remove this point', () => {
      const rest = removed(this.ramp, this.chosen);
      this.chosen = Math.max(0, this.chosen - 1);
      this.onEdit(rest);
    });
    figure.append(make('figcaption', caption), this.svg, row);
    parent.append(figure);
  }

  show(ramp: Ramp): void {
    if (sameRamp(ramp, this.ramp)) return;
    this.ramp = ramp;
    this.draw();
  }

  private draw(): void {
    this.chosen = Math.max(0, Math.min(this.chosen, this.ramp.length - 1));
    const steps = Array.from({ length: kCurveSteps + 1 }, (_, i) => i / kCurveSteps);
    const line = steps.map((x) => `${xOf(x)},${yOf(evaluate(this.ramp, x))}`);
    this.curve.setAttribute('points', line.join(' '));
    for (const circle of this.svg.querySelectorAll('circle')) circle.remove();
    this.ramp.forEach((point, index) => {
      const circle = document.createElementNS(kSvg, 'circle');
      circle.setAttribute('cx', String(xOf(point.x)));
      circle.setAttribute('cy', String(yOf(point.y)));
      circle.setAttribute('r', '5');
      circle.classList.toggle('chosen', index === this.chosen);
      this.svg.append(circle);
    });
    const point = this.ramp[this.chosen];
    for (const key of ['x', 'y', 'slope'] as const) {
      const input = this.numbers[key];
      if (point && document.activeElement !== input) input.value = String(+point[key].toFixed(4));
    }
  }

  private placeOf(event: PointerEvent): { x: number; y: number } {
    const box = this.svg.getBoundingClientRect();
    const x = ((event.clientX - box.left) / box.width) * kWidth;
    const y = ((event.clientY - box.top) / box.height) * kHeight;
    return {
      x: (x - kMargin) / (kWidth - 2 * kMargin),
      y: (kHeight - kMargin - y) / (kHeight - 2 * kMargin),
    };
  }

  private grab(event: PointerEvent): void {
    const at = this.placeOf(event);
    const distances = this.ramp.map((point) => Math.hypot(point.x - at.x, point.y - at.y));
    this.chosen = distances.indexOf(Math.min(...distances));
    this.svg.setPointerCapture(event.pointerId);
    this.draw();
  }

  private drag(event: PointerEvent): void {
    if (!this.svg.hasPointerCapture(event.pointerId)) return;
    const at = this.placeOf(event);
    this.onEdit(dragged(this.ramp, this.chosen, at.x, at.y));
  }

  private numberInput(row: HTMLElement, key: keyof RampPoint): HTMLInputElement {
    const input = make('input');
    input.type = 'number';
    input.step = key === 'slope' ? '0.1' : '0.01';
    input.addEventListener('change', () => {
      if (Number.isNaN(input.valueAsNumber)) return;
      this.onEdit(replaced(this.ramp, this.chosen, { [key]: input.valueAsNumber }));
    });
    const label = make('label', key);
    label.append(input);
    row.append(label);
    return input;
  }

  private button(row: HTMLElement, text: string, title: string, action: () => void): void {
    const button = make('button', text);
    button.type = 'button';
    button.title = title;
    button.addEventListener('click', action);
    row.append(button);
  }
}
