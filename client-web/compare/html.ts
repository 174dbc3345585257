// A page of pictures with words, that lies beside them.

export interface Picture {
  readonly file: string; // from the page's folder
  readonly caption: string;
}

export interface Figure {
  readonly name: string;
  readonly pictures: readonly Picture[];
  readonly lines: readonly string[];
}

const kStyle = `
body { background: #202020; color: #d8d8d8; font: 13px/1.4 sans-serif; margin: 16px; }
main { display: flex; flex-wrap: wrap; gap: 16px; }
section { background: #2c2c2c; box-sizing: border-box; min-width: 496px; padding: 8px; }
h2 { font-size: 15px; margin: 0 0 4px; }
.pictures { display: flex; gap: 4px; }
figure { margin: 0; }
img { display: block; width: 480px; }
ul { margin: 4px 0 0; max-width: 464px; overflow-wrap: anywhere; padding-left: 16px; }`;

const kEntities: Readonly<Record<string, string>> = { '&': '&amp;', '<': '&lt;', '>': '&gt;', '"': '&quot;' };

const escape = (text: string): string => text.replace(/[&<>"]/g, (character) => kEntities[character] ?? '');

const picture = ({ file, caption }: Picture): string =>
  `<figure><img src="${encodeURIComponent(file)}" alt=""><figcaption>${escape(caption)}</figcaption></figure>`;

const figure = ({ name, pictures, lines }: Figure): string =>
  [
    `<section><h2>${escape(name)}</h2>`,
    `<div class="pictures">${pictures.map(picture).join('')}</div>`,
    `<ul>${lines.map((line) => `<li>${escape(line)}</li>`).join('')}</ul></section>`,
  ].join('\n');

export const htmlPage = (title: string, figures: readonly Figure[]): string => `<!doctype html>
<html lang="en"><meta charset="utf-8"><title>${escape(title)}</title><style>${kStyle}</style>
<h1>${escape(title)}</h1>
<main>
${figures.map(figure).join('\n')}
</main></html>
`;
