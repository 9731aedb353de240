// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// All actuators at a glance: where each is told to be, where it is, how stiff, how loaded.
import { element } from '../marks.js';

const kDegree = 180 / Math.PI;
const minus = (text) => text.replace('-', '−');
const number = (x, digits) => minus(x.toFixed(digits));

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
    this.most = { stiffness: 1, torque: 0.5 };
    const head = element('div', 'row head');
    head.setAttribute('role', 'row');
    const units = [...new Set(run.actuators.map((a) => a.preset_unit))];
    this.presetUnit = units.length === 1 ? (units[0] === 'rad' ? '°' : units[0]) : '';
    for (const [text, unit] of [['Actuator', ''], ['Angle', '°'], ['Preset', this.presetUnit], ['Stiffness', 'N·m/rad'], ['Torque', 'N·m'], ['Currents', 'A']]) {
      const cell = element('div', '', text + ' ');
      cell.append(element('small', '', unit));
      cell.setAttribute('role', 'columnheader');
      head.append(cell);
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
      angle: gauge(['told', 'equilibrium', 'shaft']),
      preset: gauge(['fill', 'told']),
      stiffness: gauge(['fill']),
      torque: gauge(['centre', 'shaft']),
    };
    const texts = {};
    const cell = (key, label, unit, box) => {
      const out = element('div', `cell ${key}`);
      out.setAttribute('role', 'cell');
      texts[key] = element('span', 'value');
      Object.assign(texts[key].dataset, { label, unit });
      out.append(texts[key]);
      if (box) out.append(box);
      return out;
    };
    const first = element('div', 'cell who');
    first.setAttribute('role', 'rowheader');
    const hand = element('small', 'hand');
    first.append(name, hand);
    row.append(
      first,
      cell('angle', 'angle', '°', parts.angle.box),
      cell('preset', 'preset', this.presetUnit, parts.preset.box),
      cell('stiffness', 'stiffness', 'N·m/rad', parts.stiffness.box),
      cell('torque', 'torque', 'N·m', parts.torque.box),
      cell('current', 'currents', 'A'),
    );
    root.append(row);
    return { actuator, row, name, hand, parts, texts };
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
      r.hand.textContent = equilibrium && preset ? 'by hand' : equilibrium ? 'angle by hand' : preset ? 'preset by hand' : '';
    });
  }

  draw() {
    if (!this.limits) return;
    for (const r of this.rows) this.drawRow(r, this.limits[r.actuator.index]);
  }

  drawRow({ actuator, parts, texts }, limits) {
    const now = (channel) => actuator.data[channel][0];
    const angle = ([low, high], x) => (x - low) / (high - low || 1);
    for (const [mark, channel] of [['told', 'equilibrium_command_rad'], ['equilibrium', 'equilibrium_rad'], ['shaft', 'shaft_rad']]) {
      parts.angle.set(mark, angle(limits.equilibrium_rad, now(channel)));
    }
    texts.angle.textContent = number(now('shaft_rad') * kDegree, 1);
    const isAngle = actuator.preset_unit === 'rad';
    parts.preset.set('fill', angle(limits.preset, Math.abs(now('preset'))));
    parts.preset.set('told', angle(limits.preset, Math.abs(now('preset_command'))));
    texts.preset.textContent = isAngle ? number(now('preset') * kDegree, 1) : number(now('preset'), 3);
    // The scales grow with what was seen, so that bars of different actuators compare.
    const stiffness = now('stiffness_Nm_per_rad');
    const torque = now('torque_Nm');
    this.most.stiffness = Math.max(this.most.stiffness, stiffness);
    this.most.torque = Math.max(this.most.torque, Math.abs(torque));
    parts.stiffness.set('fill', stiffness / this.most.stiffness);
    texts.stiffness.textContent = number(stiffness, 2);
    parts.torque.set('shaft', 0.5 + torque / this.most.torque / 2);
    parts.torque.set('centre', 0.5);
    texts.torque.textContent = number(torque, 3);
    const second = actuator.motors > 1 ? ` / ${number(now('current_2_A'), 2)}` : '';
    texts.current.textContent = `${number(now('current_1_A'), 2)}${second}`;
  }
}
