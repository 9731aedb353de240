// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// The list of actuators and what is selected.
import { series } from './palette.js';

export const kCompareMax = 6; // as many as there are distinct colours

export class Modules {
  constructor(run, root, onChange) {
    this.run = run;
    this.onChange = onChange;
    this.chosen = run.actuators.length ? [run.actuators[0]] : [];
    this.comparing = false;
    this.buttons = [];
    for (const [index, robot] of run.robots.entries()) {
      const heading = document.createElement('h2');
      heading.textContent = `${robot.model} · ${[...new Set(robot.actuators.map((a) => a.type))].join(', ')}`;
      const chips = document.createElement('div');
      chips.className = 'chips';
      chips.setAttribute('role', 'group');
      chips.setAttribute('aria-label', `Actuators of ${robot.model}`);
      for (const a of run.actuators.filter((x) => x.robot === index)) chips.append(this.chip(a));
      root.append(heading, chips);
    }
    this.paint();
  }

  chip(actuator) {
    const button = document.createElement('button');
    button.type = 'button';
    button.title = `${actuator.joint} (${actuator.type})`;
    const dot = document.createElement('i');
    dot.className = 'dot';
    const name = document.createElement('span');
    name.textContent = actuator.name;
    button.append(dot, name);
    button.addEventListener('click', (e) => this.choose(actuator, this.comparing || e.shiftKey || e.ctrlKey || e.metaKey));
    this.buttons.push({ actuator, button, dot });
    return button;
  }

  /** `more`: add to the selection, or take from it. The newest comes last; beyond the maximum the oldest goes. */
  choose(actuator, more = false) {
    const others = this.chosen.filter((a) => a !== actuator);
    if (!more) this.chosen = [actuator];
    else if (others.length < this.chosen.length) this.chosen = others.length ? others : this.chosen;
    else this.chosen = [...others, actuator].slice(-kCompareMax);
    this.paint();
    this.onChange(this.chosen);
  }

  setComparing(on) {
    this.comparing = on;
    if (!on && this.chosen.length > 1) this.choose(this.chosen[this.chosen.length - 1]);
  }

  color(actuator) {
    return series()[this.chosen.indexOf(actuator)];
  }

  sources() {
    return this.chosen.map((a) => ({ name: a.name, color: this.color(a), data: a.data, actuator: a }));
  }

  paint() {
    for (const { actuator, button, dot } of this.buttons) {
      const on = this.chosen.includes(actuator);
      button.setAttribute('aria-pressed', String(on));
      dot.hidden = !on || this.chosen.length < 2;
      dot.style.background = on ? this.color(actuator) : '';
    }
  }
}
