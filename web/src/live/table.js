// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// All actuators at a glance: where each is told to be, where it is, how stiff, how loaded.
import { element } from '../marks.js';
import { presetUnit, shaftUnits } from '../units.js';

const minus = (text) => text.replace('-', '−');
const number = (x, digits) => minus(x.toFixed(digits));
const shown = (x, { scale, digits }) => number(x * scale, digits);

/** What an actuator's cells are shown in. */
const columns = (actuator) => ({
  ...shaftUnits(actuator),
  preset: { title: 'Preset', ...presetUnit(actuator) },
  current: { title: 'Currents', unit: 'A' },
});
const kColumns = ['place', 'preset', 'stiffness', 'load', 'current'];

/** A scale with marks: {box, set(name, part)}; part 0…1 along it. */
function gauge(kinds) {
  const box = element('div', 'gauge');
  box.setAttribute('aria-hidden', 'true');
  const marks = {};
  for (const kind of kinds) box.append((marks[kind] = element('i', kind)));
  return { box, set: (kind, part) => marks[kind].style.setProperty('--at', Math.min(1, Math.max(0, part)).toFixed(4)) };
}

export class Table {
  constructor(run, root, onChoose) {
    this.run = run;
    this.limits = null;
    this.most = { turning: { stiffness: 1, load: 0.5 }, sliding: { stiffness: 1, load: 0.5 } };
    const head = element('div', 'row head');
    head.setAttribute('role', 'row');
    const heading = (text, unit) => {
      const cell = element('div', '', text + ' ');
      cell.append(element('small', '', unit));
      cell.setAttribute('role', 'columnheader');
      head.append(cell);
    };
    heading('Actuator', '');
    this.unit = {};
    for (const key of kColumns) {
      const all = run.actuators.map((a) => columns(a)[key]);
      const units = [...new Set(all.map((c) => c.unit))];
      this.unit[key] = units.length === 1 ? units[0] : ''; // where they differ, each number has its own beside it
      heading([...new Set(all.map((c) => c.title))].join(', '), this.unit[key]);
    }
    root.setAttribute('role', 'table');
    root.setAttribute('aria-label', 'Actuators');
    root.append(head);
    this.rows = run.actuators.map((a) => this.row(a, root, onChoose));
  }

  row(actuator, root, onChoose) {
    const row = element('div', 'row');
    row.setAttribute('role', 'row');
    const name = element('button', 'name', actuator.name);
    name.type = 'button';
    name.addEventListener('click', (e) => onChoose(actuator, e.shiftKey || e.ctrlKey || e.metaKey));
    const parts = {
      place: gauge(['told', 'equilibrium', 'shaft']),
      preset: gauge(['fill', 'told']),
      stiffness: gauge(['fill']),
      load: gauge(['centre', 'shaft']),
    };
    const texts = {};
    const units = columns(actuator);
    const cell = (key) => {
      const out = element('div', `cell ${key}`);
      out.setAttribute('role', 'cell');
      const { title, unit } = units[key];
      texts[key] = element('span', unit === this.unit[key] ? 'value' : 'value own-unit');
      Object.assign(texts[key].dataset, { label: title.toLowerCase(), unit });
      out.append(texts[key]);
      if (parts[key]) out.append(parts[key].box);
      return out;
    };
    const first = element('div', 'cell who');
    first.setAttribute('role', 'rowheader');
    const hand = element('small', 'hand');
    first.append(name, hand);
    row.append(first, ...kColumns.map(cell));
    root.append(row);
    return { actuator, units, row, name, hand, parts, texts };
  }

  setChosen(chosen) {
    for (const r of this.rows) {
      const on = chosen.includes(r.actuator);
      r.row.classList.toggle('chosen', on);
      r.name.setAttribute('aria-pressed', String(on));
    }
  }

  setByHand(hands) {
    this.rows.forEach((r, i) => {
      const [equilibrium, preset] = hands[i] ?? [false, false];
      const place = `${r.units.place.title.toLowerCase()} by hand`;
      r.hand.textContent = equilibrium && preset ? 'by hand' : equilibrium ? place : preset ? 'preset by hand' : '';
    });
  }

  draw() {
    if (!this.limits) return;
    for (const r of this.rows) this.drawRow(r, this.limits[r.actuator.index]);
  }

  drawRow({ actuator, units, parts, texts }, limits) {
    const now = (channel) => actuator.data[channel][0];
    const part = ([low, high], x) => (x - low) / (high - low || 1);
    for (const [mark, channel] of [['told', 'equilibrium_command_rad'], ['equilibrium', 'equilibrium_rad'], ['shaft', 'shaft_rad']]) {
      parts.place.set(mark, part(limits.equilibrium_rad, now(channel)));
    }
    texts.place.textContent = shown(now('shaft_rad'), units.place);
    parts.preset.set('fill', part(limits.preset, Math.abs(now('preset'))));
    parts.preset.set('told', part(limits.preset, Math.abs(now('preset_command'))));
    texts.preset.textContent = units.preset.unit === '' ? '–' : shown(now('preset'), units.preset);
    // The scales grow with what was seen, so that bars of different actuators compare.
    const stiffness = now('stiffness_Nm_per_rad');
    const load = now('torque_Nm');
    const most = this.most[actuator.linear ? 'sliding' : 'turning'];
    most.stiffness = Math.max(most.stiffness, stiffness);
    most.load = Math.max(most.load, Math.abs(load));
    parts.stiffness.set('fill', stiffness / most.stiffness);
    texts.stiffness.textContent = shown(stiffness, units.stiffness);
    parts.load.set('shaft', 0.5 + load / most.load / 2);
    parts.load.set('centre', 0.5);
    texts.load.textContent = shown(load, units.load);
    const second = actuator.motors > 1 ? ` / ${number(now('current_2_A'), 2)}` : '';
    texts.current.textContent = `${number(now('current_1_A'), 2)}${second}`;
  }
}
