// A native range input beside a lil-gui number box: keyboard and touch work, and its scale may be
// logarithmic. The box keeps taking any number; the server judges it.

import type { Controller } from 'lil-gui';

import { kSliderSteps, type Scale } from './range_scale';

/** Returns how to show a value; call it whenever the value changed. */
export function attachSlider(
  controller: Controller,
  scale: Scale,
  onInput: (value: number) => void,
): (value: number) => void {
  const input = document.createElement('input');
  input.type = 'range';
  input.className = 'slider';
  input.min = '0';
  input.max = String(kSliderSteps);
  input.setAttribute('aria-labelledby', controller.$name.id);
  controller.$widget.prepend(input);
  controller.domElement.classList.add('with-slider');

  const show = (value: number): void => {
    const position = scale.toPosition(value);
    if (document.activeElement !== input || !input.matches(':active')) {
      input.value = String(position);
    }
    input.style.setProperty('--fill', `${(Number(input.value) / kSliderSteps) * 100}%`);
  };
  input.addEventListener('input', () => {
    onInput(scale.toValue(input.valueAsNumber));
  });
  return show;
}
