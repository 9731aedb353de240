// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// The curves: one small Plotly figure a panel, all on the same time axis, with a cursor at the replay's time.
import Plotly from 'plotly.js-basic-dist-min';
import { frameAt, valueAt } from './data.js';
import { dashSample, element } from './marks.js';
import { css } from './palette.js';
import { linesOf } from './panels.js';

const kPointsMax = 60000; // points drawn at once; beyond that frames are skipped
const kMargin = { l: 46, r: 8, t: 6, b: 20 };

export class Curves {
  constructor(run, root, seek) {
    this.run = run;
    this.root = root;
    this.seek = seek;
    this.range = [run.start, run.end > run.start ? run.end : run.start + 1];
    this.panels = [];
    this.time = run.start;
    new ResizeObserver(() => this.resize()).observe(root);
  }

  /** sources: [{name, color, data, actuator}]; several share a panel's lines by dash and differ by colour. */
  show(panels, sources) {
    const empty = !sources.length || !this.run.frames;
    const same = !empty && panels.length === this.panels.length && panels.every((p, i) => p.title === this.panels[i].panel.title);
    if (!same) {
      // Not purged: Plotly may still have work under way for a figure; without its element it is collected.
      this.root.replaceChildren();
      this.panels = empty ? [] : panels.map((panel) => this.build(panel));
    }
    if (empty) this.root.append(element('p', 'empty', this.run.frames ? 'Nothing is selected.' : 'The recording holds no frames.'));
    this.panels.forEach((built, i) => this.fill(built, panels[i], sources));
    this.setTime(this.time);
  }

  build(panel) {
    const figure = element('figure');
    const caption = element('figcaption');
    const heading = element('h3');
    const keys = element('div', 'keys');
    caption.append(heading, keys);
    const plot = element('div', 'plot');
    plot.setAttribute('role', 'img');
    figure.append(caption, plot);
    this.root.append(figure);
    return { panel, plot, heading, keys, cursor: element('div', 'cursor'), values: [], listening: false };
  }

  fill(built, panel, sources) {
    const { plot, heading, keys, cursor } = built;
    const lines = linesOf(panel, sources);
    heading.replaceChildren(panel.title + ' ', element('small', '', panel.unit));
    keys.replaceChildren();
    built.panel = panel;
    built.values = lines.map((line) => {
      const key = element('span');
      const value = element('b');
      key.append(dashSample(line.dash, line.color), line.label, value);
      keys.append(key);
      return { channel: line.channel, value };
    });
    plot.setAttribute('aria-label', `${panel.title} in ${panel.unit} over time: ${lines.map((l) => l.label).join(', ')}`);
    Plotly.react(plot, this.traces(panel, lines), this.layout(plot), { displayModeBar: false, doubleClick: false });
    plot.append(cursor);
    if (!built.listening) this.listen(built);
    built.listening = true;
  }

  traces(panel, lines) {
    const stride = Math.max(1, Math.ceil((this.run.frames * lines.length) / kPointsMax));
    const pick = (array, scale) => {
      const out = [];
      for (let i = 0; i < array.length; i += stride) out.push(array[i] * scale);
      return out;
    };
    const x = pick(this.run.time, 1);
    return lines.map((line) => ({
      type: 'scatter',
      mode: x.length > 1 ? 'lines' : 'markers',
      x,
      y: pick(line.channel, panel.scale),
      hoverinfo: 'skip',
      line: { color: line.color, width: line.dash === 'solid' ? 1.7 : 1.4, dash: line.dash },
      marker: { color: line.color },
    }));
  }

  layout({ clientWidth: width, clientHeight: height }) {
    const axis = { color: css('--soft'), gridcolor: css('--grid'), zeroline: false, linecolor: css('--line'), tickfont: { size: 10.5 } };
    return {
      width,
      height,
      margin: kMargin,
      showlegend: false,
      hovermode: false,
      // A finger scrolls the page; a mouse zooms.
      dragmode: window.matchMedia('(pointer: coarse)').matches ? false : 'zoom',
      paper_bgcolor: 'transparent',
      plot_bgcolor: 'transparent',
      font: { family: getComputedStyle(document.body).fontFamily, size: 11 },
      xaxis: { ...axis, range: [...this.range], ticksuffix: ' s', nticks: 8 },
      yaxis: { ...axis, fixedrange: true, nticks: 5, automargin: false },
    };
  }

  listen(built) {
    const { plot } = built;
    let down = null;
    // Captured, because Plotly keeps what happens on its drag layer to itself.
    plot.addEventListener('pointerdown', (e) => (down = { x: e.clientX, y: e.clientY }), true);
    const up = (e) => {
      const click = down && Math.hypot(e.clientX - down.x, e.clientY - down.y) < 4;
      down = null;
      if (click) this.seek(this.timeAt(built, e.clientX));
    };
    window.addEventListener('pointerup', (e) => down && up(e), true);
    plot.addEventListener('dblclick', () => this.zoom(this.run.start, this.run.end), true);
    plot.on('plotly_relayout', (change) => {
      const from = change['xaxis.range[0]'];
      if (from !== undefined) this.zoom(from, change['xaxis.range[1]']);
    });
  }

  timeAt({ plot }, clientX) {
    const axis = plot._fullLayout.xaxis;
    return axis.p2d(clientX - plot.getBoundingClientRect().left - axis._offset);
  }

  /** All panels show the same span of time. */
  zoom(from, to) {
    if (!(to > from) || (this.range[0] === from && this.range[1] === to)) return;
    this.range = [from, to];
    for (const p of this.panels) Plotly.relayout(p.plot, { 'xaxis.range': [from, to] }).then(() => this.placeCursor(p));
  }

  resize() {
    for (const p of this.panels) {
      const { clientWidth: width, clientHeight: height } = p.plot;
      if (width && width !== p.plot._fullLayout.width) Plotly.relayout(p.plot, { width, height }).then(() => this.placeCursor(p));
    }
  }

  setTime(time) {
    this.time = time;
    if (!this.run.frames) return;
    const at = frameAt(this.run, time);
    for (const p of this.panels) {
      for (const v of p.values) v.value.textContent = (valueAt(v.channel, at) * p.panel.scale).toFixed(p.panel.digits).replace('-', '−');
      this.placeCursor(p);
    }
  }

  placeCursor({ plot, cursor }) {
    const axis = plot._fullLayout?.xaxis;
    if (!axis) return;
    const part = (this.time - axis.range[0]) / (axis.range[1] - axis.range[0]);
    cursor.hidden = part < 0 || part > 1;
    cursor.style.transform = `translateX(${axis._offset + part * axis._length}px)`;
  }
}
