// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// The sliders: equilibrium and stiffness of what is chosen, one joint, a group or all.

const kDegree = 180 / Math.PI;

export class Commands {
  /** parts: {equilibrium, preset}, each {slider, number, unit}; send(command) */
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

  /** Shown as degrees where the preset is an angle. */
  scale(what) {
    return what === 'equilibrium' || this.chosen.every((a) => a.preset_unit === 'rad') ? kDegree : 1;
  }

  choose(actuators) {
    this.chosen = actuators;
    const none = !this.limits || !actuators.length;
    for (const [what, part] of Object.entries(this.parts)) {
      const spans = none ? [[0, 0]] : actuators.map((a) => this.limits[a.index][what === 'equilibrium' ? 'equilibrium_rad' : 'preset']);
      const scale = this.scale(what);
      const low = Math.max(...spans.map((s) => s[0])) * scale;
      const high = Math.min(...spans.map((s) => s[1])) * scale;
      const off = none || !(high > low);
      Object.assign(part.slider, { min: low, max: high, step: (high - low) / 1000 || 1, disabled: off });
      Object.assign(part.number, { min: low, max: high, step: 'any', disabled: off });
      part.unit.textContent = scale === kDegree ? '°' : (actuators[0]?.preset_unit ?? '');
      part.held = false;
    }
    this.follow();
  }

  moved(what, shown) {
    const part = this.parts[what];
    const value = Math.min(Number(part.slider.max), Math.max(Number(part.slider.min), shown));
    if (!Number.isFinite(value)) return;
    this.write(part, value);
    // Sent once a picture, the newest value only; clipped, so that rounding never leaves the limits.
    const limit = (x) => this.chosen.reduce((v, a) => {
      const [low, high] = this.limits[a.index][what === 'equilibrium' ? 'equilibrium_rad' : 'preset'];
      return Math.min(high, Math.max(low, v));
    }, x);
    this.waiting[what === 'equilibrium' ? 'equilibrium_rad' : 'preset'] = limit(value / this.scale(what));
    part.held = performance.now();
  }

  flush() {
    if (!Object.keys(this.waiting).length || !this.chosen.length) return;
    this.send({ actuators: this.chosen.map((a) => a.index), ...this.waiting });
    this.waiting = {};
  }

  write(part, value) {
    const { min, max } = part.slider;
    part.slider.value = value;
    part.slider.style.setProperty('--done', `${(100 * (value - min)) / (max - min || 1)}%`);
    if (document.activeElement !== part.number) part.number.value = value.toFixed(1);
    part.slider.setAttribute('aria-valuetext', `${value.toFixed(1)} ${part.unit.textContent === '°' ? 'degrees' : part.unit.textContent}`);
  }

  /** The sliders show what is commanded, also by others; not while one is being moved here. */
  follow() {
    const first = this.chosen[this.chosen.length - 1];
    if (!first) return;
    for (const [what, part] of Object.entries(this.parts)) {
      if (part.held && performance.now() - part.held < 500) continue;
      const channel = what === 'equilibrium' ? 'equilibrium_command_rad' : 'preset_command';
      this.write(part, first.data[channel][0] * this.scale(what));
    }
  }
}
