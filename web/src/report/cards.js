// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// A gallery: cards with a small picture each. All pictures have the same logarithmic axes, so that they can be compared at a glance.
import { element } from '../marks.js';
import { linkTo } from './parts.js';

const kSize = { width: 268, height: 132 };
const kInside = { left: 34, right: 6, top: 6, bottom: 26 };

const drawing = (tag, attributes, text) => {
  const e = document.createElementNS('http://www.w3.org/2000/svg', tag);
  for (const [name, value] of Object.entries(attributes)) e.setAttribute(name, value);
  if (text !== undefined) e.textContent = text;
  return e;
};

/** Whole decades that hold all values above 0. */
function decades(values) {
  const positive = values.filter((v) => v > 0).map(Math.log10);
  if (!positive.length) return [0, 1];
  const low = Math.floor(Math.min(...positive) + 1e-9);
  return [low, Math.max(low + 1, Math.ceil(Math.max(...positive) - 1e-9))];
}

/** As it fits below an axis: 0.001, 1, 1000, 10⁴. */
const power = (k) => (Math.abs(k) <= 3 ? String(Number(`1e${k}`)) : `10${[...String(k)].map((c) => '⁰¹²³⁴⁵⁶⁷⁸⁹'[c] ?? '⁻').join('')}`);

function axesOf(cards) {
  const x = decades(cards.flatMap((c) => c.x));
  const y = decades(cards.flatMap((c) => [...c.low, ...c.high]));
  const [w, h] = [kSize.width - kInside.left - kInside.right, kSize.height - kInside.top - kInside.bottom];
  const share = (v, [low, high]) => Math.min(1, Math.max(0, (Math.log10(v) - low) / (high - low)));
  return { x, y, px: (v) => kInside.left + w * share(v, x), py: (v) => kInside.top + h * (1 - share(v, y)) };
}

function grid(svg, { x, y, px, py }, labels) {
  const [left, right, top, bottom] = [kInside.left, kSize.width - kInside.right, kInside.top, kSize.height - kInside.bottom];
  const every = Math.ceil((y[1] - y[0]) / 4);
  for (let k = x[0]; k <= x[1]; ++k) {
    const at = px(10 ** k);
    svg.append(drawing('path', { d: `M${at} ${top}V${bottom}`, class: 'grid' }), drawing('text', { x: at, y: bottom + 10, class: 'middle' }, power(k)));
  }
  for (let k = y[0]; k <= y[1]; ++k) {
    const at = py(10 ** k);
    svg.append(drawing('path', { d: `M${left} ${at}H${right}`, class: 'grid' }));
    if ((k - y[0]) % every === 0) svg.append(drawing('text', { x: left - 4, y: k === y[0] ? at : at + 3, class: 'last' }, power(k)));
  }
  svg.append(drawing('text', { x: (left + right) / 2, y: kSize.height - 4, class: 'middle' }, labels.x_label));
  const turned = { x: 0, y: 0, class: 'middle', transform: `translate(8 ${(top + bottom) / 2}) rotate(-90)` };
  svg.append(drawing('text', turned, labels.y_label));
}

function pictureOf(card, axes, labels) {
  const svg = drawing('svg', { viewBox: `0 0 ${kSize.width} ${kSize.height}`, role: 'img', 'aria-label': `${card.title}: ${labels.y_label} over ${labels.x_label}` });
  grid(svg, axes, labels);
  const points = card.x.map((x, i) => [x, card.low[i], card.high[i]]).filter(([x, low, high]) => x > 0 && low > 0 && high > 0);
  const line = (at) => points.map((p, i) => `${i ? 'L' : 'M'}${axes.px(p[0]).toFixed(1)} ${axes.py(p[at]).toFixed(1)}`);
  if (!points.length) return svg;
  const back = line(2).reverse().map((p) => p.replace('M', 'L'));
  svg.append(drawing('path', { d: [...line(1), ...back, 'Z'].join(''), class: 'between' }));
  for (const at of [1, 2]) svg.append(drawing('path', { d: line(at).join(''), class: 'edge' }));
  return svg;
}

export function cardsOf({ cards, caption, ...labels }) {
  const root = element('div');
  const list = element('ul', 'gallery');
  const axes = axesOf(cards);
  for (const card of cards) {
    const item = element('li', 'card');
    const head = element('h3');
    head.append(card.link ? linkTo(card.link, card.title) : card.title);
    const figures = element('dl');
    for (const [label, value] of card.figures) figures.append(element('dt', '', label), element('dd', '', value));
    const line = element('p', 'line');
    line.append(element('span', `tag ${card.tag}`, card.tag), element('span', '', card.subtitle));
    item.append(head, line, pictureOf(card, axes, labels), figures);
    list.append(item);
  }
  root.append(list);
  if (caption) root.append(element('p', 'caption', caption));
  return root;
}
