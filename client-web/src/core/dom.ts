// Elements of index.html by their id, and what all of a kind do.

/** The element, of the expected class; a page without it is a bug. */
export function element<T extends Element>(id: string, type: new () => T): T {
  const found = document.getElementById(id);
  if (!(found instanceof type)) throw new Error(`index.html has no ${type.name} #${id}`);
  return found;
}

/** A new element with text; never HTML, so that a server's words stay words. */
export function make<K extends keyof HTMLElementTagNameMap>(
  tag: K,
  text = '',
  className = '',
): HTMLElementTagNameMap[K] {
  const made = document.createElement(tag);
  if (text !== '') made.textContent = text;
  if (className !== '') made.className = className;
  return made;
}

/** The element of that id, which comes with HTML of the page's own at the end of the body. */
export function appended<T extends Element>(html: string, id: string, type: new () => T): T {
  document.body.insertAdjacentHTML('beforeend', html);
  return element(id, type);
}

/** A click beside the box of a modal dialog closes it. */
export function closeBeside(dialog: HTMLDialogElement): void {
  dialog.addEventListener('click', (event) => {
    if (event.target === dialog) dialog.close();
  });
}
