import { expect, it } from 'vitest';

import { htmlPage } from '../../compare/html';

it('HtmlPage_NamesAndWarningsOfFiles_AreTextNotMarkup', () => {
  const hostile = '<script>alert("x")</script> & more';
  const page = htmlPage('models', [
    { name: hostile, pictures: [{ file: 'a "b"#1.png', caption: hostile }], lines: [hostile] },
  ]);
  expect(page).not.toContain('<script>');
  expect(page.split('&lt;script&gt;alert(&quot;x&quot;)&lt;/script&gt; &amp; more')).toHaveLength(4);
  expect(page).toContain('src="a%20%22b%22%231.png"');
});
