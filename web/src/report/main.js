// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// The report: builds headings, tables, figures and charts from the data in the page (src/report/json.cpp writes them). Whatever text
// they hold goes into text nodes.
import { element } from '../marks.js';
import { dark } from '../palette.js';
import { cardsOf } from './cards.js';
import { Chart } from './chart.js';
import { keepFitting } from './paper.js';
import { barsOf, figuresOf, linkTo, tableOf, textOf } from './parts.js';

const kContentsFrom = 3; // sections that are worth a table of contents

const report = JSON.parse(document.getElementById('data').textContent);
if (report.format !== 1) throw new Error(`This page can't read data of format ${report.format}.`);
const charts = [];

function blockOf(block) {
  if (block.kind === 'chart') {
    charts.push(new Chart(block));
    return charts[charts.length - 1].figure;
  }
  return { text: textOf, table: tableOf, figures: figuresOf, bars: barsOf, cards: cardsOf }[block.kind](block);
}

/** Blocks of one kind that follow each other stand in one grid: charts and a sheet's tables side by side where there is room. */
function sectionOf({ title, blocks }, index) {
  const section = element('section');
  section.id = `section-${index + 1}`;
  if (title) {
    const heading = element('h2', '', title);
    heading.id = `heading-${index + 1}`;
    section.setAttribute('aria-labelledby', heading.id);
    section.append(heading);
  }
  let group = null;
  for (const block of blocks) {
    if (group?.kind !== block.kind) {
      group = { kind: block.kind, root: element('div', `blocks ${block.kind}-blocks`) };
      section.append(group.root);
    }
    group.root.append(blockOf(block));
  }
  return section;
}

function writeContents() {
  const titled = report.sections.map((s, i) => ({ title: s.title, at: `#section-${i + 1}` })).filter((s) => s.title);
  const nav = document.getElementById('contents');
  nav.hidden = report.one_page || titled.length < kContentsFrom;
  const list = element('ol');
  for (const { title, at } of titled) {
    const link = element('a', '', title);
    link.href = at;
    const item = element('li');
    item.append(link);
    list.append(item);
  }
  nav.append(list);
}

document.title = report.title ? `${report.title} – vsasim` : 'vsasim report';
for (const place of ['title', 'subtitle', 'footer']) {
  const e = document.getElementById(place);
  e.textContent = report[place];
  e.hidden = !report[place];
}
const beside = document.getElementById('beside');
const pages = report.links ?? [];
beside.hidden = !pages.length;
beside.append(...pages.map(([text, file]) => linkTo(file, text)));
document.getElementById('sections').append(...report.sections.map(sectionOf));
writeContents();
const prepare = () => charts.forEach((chart) => chart.drawKeys());
const draw = () => charts.forEach((chart) => chart.draw());
keepFitting({ onePage: report.one_page, prepare, draw });
dark.addEventListener('change', draw);
window.vsaReport = { report, charts };
