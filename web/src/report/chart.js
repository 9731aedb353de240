// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// One chart: a Plotly figure with a legend of buttons, its caption, and its numbers to save.
import Plotly from 'plotly.js-basic-dist-min';
import { dashSample, element } from '../marks.js';
import { css, isDark, series } from '../palette.js';
import { save, slug, tableText } from './save.js';

const kDashes = { line: 'solid', dashed: 'dash', dotted: 'dot' };
const kMarkersUpTo = 400; // points that are drawn as rings; beyond that as dots

/** Plotly reads some HTML in texts; what a user wrote is none. */
const plain = (text) => text.replaceAll('&', '&amp;').replaceAll('<', '&lt;').replaceAll('>', '&gt;');

const colorOf = (curve) => {
  if (curve.color < 0) return css('--soft'); // a reference, no result
  const colors = series();
  return colors[curve.color % colors.length];
};

function translucent(hex, opacity) {
  const [r, g, b] = [1, 3, 5].map((at) => parseInt(hex.slice(at, at + 2), 16));
  return `rgba(${r}, ${g}, ${b}, ${opacity})`;
}

/** y ± error as polygons, a new one after each gap. */
function bandOutline({ x, y, error }) {
  const out = { x: [], y: [] };
  let from = 0;
  const close = (to) => {
    for (let i = from; i < to; ++i) (out.x.push(x[i]), out.y.push(y[i] - error[i]));
    for (let i = to - 1; i >= from; --i) (out.x.push(x[i]), out.y.push(y[i] + error[i]));
    if (to > from) (out.x.push(null), out.y.push(null));
    from = to + 1;
  };
  x.forEach((_, i) => {
    if ([x[i], y[i], error[i]].includes(null)) close(i);
  });
  close(x.length);
  return out;
}

function traceOf(curve, visible) {
  const color = colorOf(curve);
  const common = { type: 'scatter', name: plain(curve.name), visible, hoverlabel: { namelength: 40 } };
  if (curve.style === 'band') {
    const fill = translucent(color, isDark() ? 0.28 : 0.2);
    return { ...common, ...bandOutline(curve), mode: 'lines', line: { width: 0 }, fill: 'toself', fillcolor: fill, hoverinfo: 'skip' };
  }
  const few = curve.x.length <= kMarkersUpTo;
  const trace = { ...common, x: curve.x, y: curve.y, hovertemplate: '%{x:.4~g}, %{y:.4~g}', mode: curve.style === 'markers' ? 'markers' : 'lines' };
  trace.line = { color, width: curve.style === 'line' ? 1.8 : 1.6, dash: kDashes[curve.style] };
  trace.marker = { color, size: few ? 6 : 3, symbol: few ? 'circle-open' : 'circle', line: { width: 1.4 } };
  if (curve.error.length) trace.error_y = { type: 'data', array: curve.error, color, thickness: 1, width: 2.5 };
  return trace;
}

function sample(curve) {
  const color = colorOf(curve);
  if (curve.style !== 'band' && curve.style !== 'markers') return dashSample(kDashes[curve.style], color);
  const e = element('span', `swatch ${curve.style}`);
  e.setAttribute('aria-hidden', 'true');
  e.style.setProperty('--color', color);
  return e;
}

/** 1, 10, 100 …; over a short span 1, 2, 5, 10 …. What is out of sight isn't drawn. */
function logTicks(all) {
  const values = all.filter((v) => v > 0);
  if (!values.length) return {};
  const [low, high] = [Math.min(...values), Math.max(...values)].map(Math.log10);
  const steps = high - low < 2.2 ? [1, 2, 5] : [1];
  const tickvals = [];
  for (let k = Math.floor(low) - 1; k <= high + 1; ++k) steps.forEach((s) => tickvals.push(Number(`${s}e${k}`)));
  return { type: 'log', tickmode: 'array', tickvals, ticktext: tickvals.map(String), minor: { dtick: 'D1', showgrid: false, ticks: 'outside', ticklen: 2 } };
}

export class Chart {
  constructor(data) {
    this.data = data;
    this.hidden = new Set(); // legend entries that are switched off
    this.figure = element('figure', 'card chart');
    this.keys = element('div', 'keys');
    this.plot = element('div', 'plot');
    this.plot.setAttribute('role', 'img');
    this.plot.setAttribute('aria-label', `${data.title}: ${data.y_label} over ${data.x_label}. ${this.entries().map((e) => e.label).join(', ')}`);
    const head = element('div', 'chart-head');
    head.append(element('h3', '', data.title), this.tools());
    this.figure.append(head, this.keys, this.plot);
    if (data.caption) this.figure.append(element('figcaption', 'caption', data.caption));
  }

  /** One entry a group; a curve without one has its own. */
  entries() {
    const entries = new Map();
    for (const curve of this.data.curves) {
      const label = curve.group || curve.name;
      if (!entries.has(label)) entries.set(label, { label, curves: [] });
      entries.get(label).curves.push(curve);
    }
    return [...entries.values()];
  }

  tools() {
    const tools = element('div', 'tools');
    const tool = (text, what, action) => {
      const button = element('button', '', text);
      button.type = 'button';
      button.title = `Save ${what}`;
      button.setAttribute('aria-label', `Save ${what} of “${this.data.title}”`);
      button.addEventListener('click', action);
      tools.append(button);
    };
    const name = slug(this.data.title);
    tool('CSV', 'the numbers', () => save(`${name}.csv`, 'text/csv', tableText(this.data)));
    tool('SVG', 'the picture', async () => {
      const { clientWidth: width, clientHeight: height } = this.plot;
      const url = await Plotly.toImage(this.plot, { format: 'svg', width, height });
      save(`${name}.svg`, 'image/svg+xml', decodeURIComponent(url.slice(url.indexOf(',') + 1)));
    });
    return tools;
  }

  drawKeys() {
    const entries = this.entries();
    const keyOf = (entry) => {
      const button = element('button');
      button.type = 'button';
      button.setAttribute('aria-pressed', String(!this.hidden.has(entry.label)));
      button.title = 'Show or hide';
      const kinds = new Map(entry.curves.map((c) => [`${c.style} ${colorOf(c)}`, c]));
      button.append(...[...kinds.values()].map(sample), element('span', '', entry.label));
      button.addEventListener('click', () => this.toggle(entry.label));
      return button;
    };
    const focused = [...this.keys.children].indexOf(document.activeElement);
    this.keys.replaceChildren(...(entries.length === 1 && entries[0].label === this.data.title ? [] : entries.map(keyOf)));
    this.keys.children[focused]?.focus();
  }

  toggle(label) {
    if (!this.hidden.delete(label)) this.hidden.add(label);
    this.draw();
  }

  draw() {
    this.drawKeys();
    const visible = (curve) => !this.hidden.has(curve.group || curve.name);
    // Bands first, so that no curve lies under one.
    const ordered = [...this.data.curves].sort((a, b) => (b.style === 'band') - (a.style === 'band'));
    const traces = ordered.map((curve) => traceOf(curve, visible(curve)));
    Plotly.react(this.plot, traces, this.layout(), { displayModeBar: false, responsive: false });
  }

  /** Logarithmic or not, over the range that was given or what the curves need. */
  scale(name) {
    const log = this.data[`${name}_log`];
    const range = this.data[`${name}_range`];
    return {
      ...(log ? logTicks(range ?? this.data.curves.flatMap((c) => c[name])) : {}),
      ...(range ? { range: log ? range.map(Math.log10) : range } : {}),
    };
  }

  layout() {
    const { clientWidth: width, clientHeight: height } = this.plot;
    const small = document.documentElement.classList.contains('sheet');
    const size = small ? 9.5 : 11.5;
    const axis = {
      color: css('--soft'), gridcolor: css('--grid'), linecolor: css('--line'), showline: true, mirror: true, ticks: 'outside', ticklen: 3,
      tickcolor: css('--line'), tickfont: { size }, zerolinecolor: css('--line'), zerolinewidth: 1, automargin: true,
    };
    const titled = (text) => ({ title: { text: plain(text), font: { size: size + 0.5, color: css('--ink') }, standoff: small ? 4 : 8 } });
    return {
      width,
      height,
      margin: { l: 40, r: 10, t: 8, b: 30 },
      showlegend: false,
      hovermode: 'closest',
      hoverlabel: { bgcolor: css('--card'), bordercolor: css('--line'), font: { color: css('--ink'), size: 12 } },
      // A finger scrolls the page; a mouse zooms.
      dragmode: window.matchMedia('(pointer: coarse)').matches ? false : 'zoom',
      uirevision: 'kept', // a zoom survives a redraw
      paper_bgcolor: 'transparent',
      plot_bgcolor: 'transparent',
      font: { family: getComputedStyle(document.body).fontFamily, size },
      xaxis: { ...axis, ...titled(this.data.x_label), nticks: 8, ...this.scale('x') },
      yaxis: { ...axis, ...titled(this.data.y_label), nticks: 7, ...this.scale('y') },
    };
  }
}
