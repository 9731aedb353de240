// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Live curves: one uPlot strip a signal, all over the same last seconds.
import uPlot from 'uplot';
import { dashSample, element } from '../marks.js';
import { css } from '../palette.js';
import { linesOf } from '../panels.js';

const kDash = { dash: [7, 4], dot: [2, 3], dashdot: [7, 3, 2, 3], longdash: [12, 4] };
const kHeight = 118;
const kSmallest = 1e-3; // of a vertical axis, so that noise at rest stays a line

export class Strips {
  constructor(history, root) {
    this.history = history;
    this.root = root;
    this.window = 10;
    this.strips = [];
    new ResizeObserver(() => this.resize()).observe(root);
  }

  /** [{panels: of panels.js, sources: [{name, color, data, actuator}]}, …] */
  show(sets) {
    for (const strip of this.strips) strip.plot.destroy();
    this.root.replaceChildren();
    this.strips = sets.flatMap(({ panels, sources }) => panels.map((panel) => this.build(panel, linesOf(panel, sources))));
    if (!this.strips.length) this.root.append(element('p', 'empty', 'Choose signals above.'));
    this.draw();
  }

  build(panel, lines) {
    const figure = element('figure');
    const caption = element('figcaption');
    const heading = element('h3', '', panel.title + ' ');
    heading.append(element('small', '', panel.unit));
    const keys = element('div', 'keys');
    const values = lines.map((line) => {
      const key = element('span');
      const value = element('b');
      key.append(dashSample(line.dash, line.color), line.label, value);
      keys.append(key);
      return value;
    });
    caption.append(heading, keys);
    const holder = element('div', 'strip');
    holder.setAttribute('role', 'img');
    holder.setAttribute('aria-label', `${panel.title} in ${panel.unit}, live: ${lines.map((l) => l.label).join(', ')}`);
    figure.append(caption, holder);
    this.root.append(figure);
    const columns = lines.map((line) => this.history.column(line.channel));
    const plot = new uPlot(this.options(holder, lines), [[], ...lines.map(() => [])], holder);
    return { panel, lines, columns, values, plot, holder };
  }

  options(holder, lines) {
    const axis = { stroke: css('--soft'), grid: { stroke: css('--grid'), width: 1 }, ticks: { show: false }, font: `10.5px ${getComputedStyle(document.body).fontFamily}` };
    return {
      width: Math.max(100, holder.clientWidth),
      height: kHeight,
      legend: { show: false },
      cursor: { show: false },
      padding: [6, 8, 0, 0],
      scales: {
        x: { time: false, auto: false },
        y: { range: (_, low, high) => this.range(low, high) },
      },
      axes: [
        { ...axis, size: 22, values: (_, splits) => splits.map((s) => `${+s.toFixed(2)} s`) },
        { ...axis, size: 46 },
      ],
      series: [{}, ...lines.map((line) => ({ stroke: line.color, width: 1.6, dash: kDash[line.dash], points: { show: false } }))],
    };
  }

  range(low, high) {
    if (!(high >= low)) return [-1, 1];
    const slack = Math.max((high - low) * 0.08, kSmallest, Math.abs(high) * 1e-4);
    return [low - slack, high + slack];
  }

  draw() {
    const to = Math.max(this.history.last, this.window);
    for (const { panel, lines, columns, values, plot } of this.strips) {
      const data = this.history.since(to - this.window, columns, panel.scale);
      plot.batch(() => {
        plot.setData(data, true);
        plot.setScale('x', { min: to - this.window, max: to });
      });
      lines.forEach((line, i) => (values[i].textContent = (line.channel[0] * panel.scale).toFixed(panel.digits).replace('-', '−')));
    }
  }

  resize() {
    for (const { plot, holder } of this.strips) {
      if (holder.clientWidth && holder.clientWidth !== plot.width) plot.setSize({ width: holder.clientWidth, height: kHeight });
    }
  }
}
