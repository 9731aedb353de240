// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// The sliders: equilibrium and stiffness of what is chosen, one joint, a group or all.
import { presetUnit, shaftUnits } from '../units.js';

/** What a slider is called in requests and limits, and what it is shown in. */
const kWhat = {
  equilibrium: { key: 'equilibrium_rad', channel: 'equilibrium_command_rad', units: (a) => shaftUnits(a).place },
  preset: { key: 'preset', channel: 'preset_command', units: presetUnit },
};

export class Commands {
  /** parts: {equilibrium, preset}, each {slider, number, unit, why}; send(command) */
  constructor(run, parts, send) {
    this.run = run;
    this.send = send;
    this.waiting = {};
    this.chosen = [];
    this.parts = parts;
    for (const [what, part] of Object.entries(parts)) {
      part.slider.addEventListener('input', () => this.moved(what, Number(part.slider.value)));
      part.number.addEventListener('change', () => part.number.value !== '' && this.moved(what, Number(part.number.value)));
    }
  }

  setLimits(limits) {
    this.limits = limits;
    this.choose(this.chosen);
  }

  /** Of the newest chosen; the others have the same, or the slider is off. */
  shown(what) {
    const newest = this.chosen[this.chosen.length - 1];
    return newest ? kWhat[what].units(newest) : { unit: '', scale: 1, digits: 1 };
  }

  /** Why one number can't go to all that are chosen; empty where it can. */
  mixed(what) {
    const units = [...new Set(this.chosen.map((a) => kWhat[what].units(a).unit || 'none'))];
    if (units.length < 2) return '';
    return `Off: the units of those chosen differ (${units.join(', ')}).`;
  }

  choose(actuators) {
    this.flush(); // what waits is for those chosen until now
    this.chosen = actuators;
    const none = !this.limits || !actuators.length;
    for (const [what, part] of Object.entries(this.parts)) {
      const { unit, scale } = this.shown(what);
      const why = this.mixed(what);
      const spans = none || why ? [[0, 0]] : actuators.map((a) => this.limits[a.index][kWhat[what].key]);
      const low = Math.max(...spans.map((s) => s[0])) * scale;
      const high = Math.min(...spans.map((s) => s[1])) * scale;
      const off = !(high > low);
      Object.assign(part.slider, { min: low, max: high, step: (high - low) / 1000 || 1, disabled: off });
      Object.assign(part.number, { min: low, max: high, step: 'any', disabled: off });
      part.unit.textContent = why ? '' : unit;
      part.why.textContent = why;
      part.why.hidden = !why;
      part.held = false;
      if (!why) continue;
      part.number.value = '';
      part.slider.style.setProperty('--done', '0%');
      part.slider.setAttribute('aria-valuetext', why);
    }
    this.follow();
  }

  moved(what, shown) {
    const part = this.parts[what];
    if (part.slider.disabled) return;
    const value = Math.min(Number(part.slider.max), Math.max(Number(part.slider.min), shown));
    if (!Number.isFinite(value)) return;
    this.write(what, value);
    // Sent once a picture, the newest value only; clipped, so that rounding never leaves the limits.
    const { key } = kWhat[what];
    const limit = (x) => this.chosen.reduce((v, a) => {
      const [low, high] = this.limits[a.index][key];
      return Math.min(high, Math.max(low, v));
    }, x);
    this.waiting[key] = limit(value / this.shown(what).scale);
    part.held = performance.now();
  }

  flush() {
    if (!Object.keys(this.waiting).length || !this.chosen.length) return;
    this.send({ actuators: this.chosen.map((a) => a.index), ...this.waiting });
    this.waiting = {};
  }

  write(what, value) {
    const part = this.parts[what];
    const { unit, digits } = this.shown(what);
    const { min, max } = part.slider;
    const text = value.toFixed(digits);
    part.slider.value = value;
    part.slider.style.setProperty('--done', `${(100 * (value - min)) / (max - min || 1)}%`);
    if (document.activeElement !== part.number) part.number.value = text;
    part.slider.setAttribute('aria-valuetext', `${text} ${unit === '°' ? 'degrees' : unit}`);
  }

  /** The sliders show what is commanded, also by others; not while one is being moved here. */
  follow() {
    const newest = this.chosen[this.chosen.length - 1];
    if (!newest) return;
    for (const [what, part] of Object.entries(this.parts)) {
      if (this.mixed(what) || (part.held && performance.now() - part.held < 500)) continue;
      this.write(what, newest.data[kWhat[what].channel][0] * this.shown(what).scale);
    }
  }
}
