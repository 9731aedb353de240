// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// What a report has beside charts: paragraphs, tables, numbers that stand out, bars.
import { element } from '../marks.js';

/** To a file beside this page; nowhere else. */
export function linkTo(file, text) {
  const link = element('a', '', text);
  link.href = `./${encodeURIComponent(file)}`;
  return link;
}

export const textOf = ({ text }) => element('p', 'text', text);

/** "0.3", "0.3 ± 0.1", "0.3 … 20", "0.3 / –" */
const isNumber = (cell) => cell.split(/[±…/]/).every((part) => /^([+−-]?[\d.]+(e[+−-]?\d+)?|–|)$/i.test(part.trim()));

/** Columns that hold numbers (or nothing: a dash) are set to the right; the first column heads its row. */
export function tableOf({ title, head, rows, caption, links = [] }) {
  const columns = Math.max(head.length, ...rows.map((r) => r.length));
  const numeric = Array.from({ length: columns }, (_, c) => {
    const cells = rows.map((r) => r[c] ?? '').filter((t) => !/^[-–—]?$/.test(t.trim()));
    return c > 0 && cells.length > 0 && cells.every(isNumber);
  });
  const table = element('table');
  if (title) table.append(element('caption', '', title));
  const cellOf = (tag, text, c, scope) => {
    const cell = element(tag, numeric[c] ? 'number' : '', text);
    if (scope) cell.scope = scope;
    return cell;
  };
  if (head.length) {
    const row = element('tr');
    row.append(...head.map((text, c) => cellOf('th', text, c, 'col')));
    const thead = element('thead');
    thead.append(row);
    table.append(thead);
  }
  const body = element('tbody');
  rows.forEach((cells, r) => {
    const row = element('tr');
    row.append(...cells.map((text, c) => cellOf(c === 0 ? 'th' : 'td', text, c, c === 0 ? 'row' : null)));
    if (links[r]) row.firstChild.replaceChildren(linkTo(links[r], row.firstChild.textContent));
    body.append(row);
  });
  table.append(body);
  const scroll = element('div', 'scroll');
  scroll.append(table);
  scroll.tabIndex = 0; // a wide table scrolls by the keyboard too
  scroll.setAttribute('role', 'region');
  scroll.setAttribute('aria-label', title || 'Table');
  const card = element('div', 'card table');
  card.append(scroll);
  if (caption) card.append(element('p', 'caption', caption));
  return card;
}

const kVerdicts = { good: ['✓', 'within its bound'], bad: ['✗', 'breaks its bound'] };

export function figuresOf({ figures }) {
  const list = element('dl', 'figures');
  for (const { label, value, note, verdict } of figures) {
    const tile = element('div', `card figure ${verdict}`);
    const number = element('dd', 'value', value);
    if (kVerdicts[verdict]) {
      const mark = element('span', 'mark', kVerdicts[verdict][0]);
      mark.setAttribute('aria-hidden', 'true');
      number.prepend(mark);
      number.append(element('span', 'sr', ` (${kVerdicts[verdict][1]})`));
    }
    tile.append(element('dt', '', label), number);
    if (note) tile.append(element('dd', 'note', note));
    list.append(tile);
  }
  return list;
}

/** As long as their numbers, from one zero on. */
export function barsOf({ title, bars, caption }) {
  const most = Math.max(...bars.map((b) => b.value ?? 0), 0);
  const card = element('div', 'card bars');
  card.append(element('h3', '', title));
  const list = element('dl');
  for (const { label, value, text, note, link } of bars) {
    const name = element('dt');
    name.append(link ? linkTo(link, label) : label);
    const track = element('dd', 'track');
    const bar = element('span', 'bar');
    bar.style.setProperty('--share', most > 0 && value > 0 ? value / most : 0);
    bar.setAttribute('aria-hidden', 'true');
    track.append(bar);
    const end = element('dd');
    end.append(element('b', '', text), element('span', 'note', note));
    list.append(name, track, end);
  }
  card.append(list);
  if (caption) card.append(element('p', 'caption', caption));
  return card;
}
