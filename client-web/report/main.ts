// The report of `froxel bench`: reads the results that stand in the page and shows them.

import { element, make } from '../src/core/dom';
import { errorSection } from './error_section';
import { showHead } from './glance';
import { readResults, type Results } from './results';
import { methodSection, publishedSection, sweepSection, type Section } from './sections';
import { usualClock } from './text';

function show(results: Results): void {
  let clock = usualClock(results);
  const sections: Section[] = [
    errorSection(results, clock),
    ...results.sweeps.map((sweep) => sweepSection(results, sweep)),
    methodSection(results),
    ...(results.published.length > 0 ? [publishedSection(results)] : []),
  ];
  const report = element('report', HTMLElement);
  const links = make('ul');
  for (const { id, title, element: section } of sections) {
    const link = make('a', title);
    link.href = `#${id}`;
    const entry = make('li');
    entry.append(link);
    links.append(entry);
    report.append(section);
  }
  element('contents', HTMLElement).append(links);
  const draw = (): void => {
    for (const section of sections) section.draw(clock);
  };
  showHead(element('head', HTMLElement), results, clock, (chosen) => {
    clock = chosen;
    draw();
  });
  let width = 0;
  new ResizeObserver(() => {
    if (report.clientWidth === width) return;
    width = report.clientWidth;
    draw();
  }).observe(report);
}

try {
  show(readResults(element('results', HTMLScriptElement).textContent));
} catch (error) {
  element('report', HTMLElement).append(
    make('p', error instanceof Error ? error.message : String(error), 'warning'),
  );
}
