// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// The gait panel: the paper's Table II, edited while the robot moves.
import { element } from '../marks.js';

const kDegree = 180 / Math.PI;
// [key of the request, label, unit, scale to the shown unit, bounds' key, slider's span, step]
const kWave = [
  ['amplitude_rad', 'Amplitude A', '°', kDegree, 'amplitude_deg', [0, 90], 0.5],
  ['offset_rad', 'Offset D', '°', kDegree, 'offset_deg', [-60, 60], 0.5],
  ['lambda', 'Modules a half wave λ', '', 1, 'lambda', [1, 20], 0.1],
  ['delta_rad', 'Phase δ', '°', kDegree, 'delta_deg', [-180, 180], 1],
  ['preset_rad', 'Stiffness preset', '°', kDegree, 'preset_deg', [0, 45], 0.5],
];
const kFrequency = ['frequency_rad_per_s', 'Frequency ω', 'rad/s', 1, 'frequency_rad_per_s', [0.05, 12], 0.05];

export class GaitPanel {
  constructor(root, ask) {
    this.root = root;
    this.ask = ask;
    this.gait = null;
    this.waiting = false;
  }

  /** State of the gait as the run tells it. */
  set(gait, bounds) {
    const fresh = !this.gait;
    // What was put in here and isn't sent yet must not be lost, however slow the pictures are.
    const busy = this.waiting || (this.root.contains(document.activeElement) && performance.now() - (this.touched ?? 0) < 800);
    if (this.playButton) this.playButton.textContent = gait.playing ? 'Hold the gait' : 'Play the gait';
    if (busy && !fresh) {
      this.gait.playing = gait.playing;
      return;
    }
    this.gait = gait;
    if (fresh) this.build(bounds);
    for (const field of this.fields) field.show();
  }

  build(bounds) {
    this.fields = [];
    const title = element('p', 'gait-title', this.gait.title);
    const tools = element('div', 'gait-tools');
    this.playButton = element('button', '', this.gait.playing ? 'Hold the gait' : 'Play the gait');
    this.playButton.type = 'button';
    this.playButton.id = 'gait-play';
    this.playButton.addEventListener('click', () => this.ask('gait_play', { on: !this.gait.playing }));
    const back = element('button', '', 'Give joints back to the gait');
    back.type = 'button';
    back.id = 'give-back';
    back.title = 'Joints that were moved by hand follow the gait again';
    back.addEventListener('click', () => this.ask('give_back'));
    tools.append(this.playButton, back);
    this.root.replaceChildren(title, tools);
    this.root.append(this.field(kFrequency, bounds, () => this.gait, 'gait'));
    this.gait.groups.forEach((group, i) => {
      const set = element('fieldset');
      set.append(element('legend', '', group.name));
      for (const wave of kWave) set.append(this.field(wave, bounds, () => this.gait.groups[i], group.name));
      this.root.append(set);
    });
  }

  field([key, label, unit, scale, bound, [low, high], step], bounds, target, scope) {
    const line = element('div', 'field');
    const id = `gait-${scope}-${key}`.replace(/[^\w-]/g, '_');
    const name = element('label', '', label);
    name.htmlFor = id;
    const slider = Object.assign(element('input'), { type: 'range', id, min: low, max: high, step });
    const box = Object.assign(element('input'), { type: 'number', min: bounds[bound][0], max: bounds[bound][1], step: 'any' });
    box.setAttribute('aria-label', `${scope}: ${label} in ${unit || 'modules'}`);
    const put = (shown) => {
      const [least, most] = bounds[bound];
      if (!Number.isFinite(shown)) return;
      target()[key] = Math.min(most, Math.max(least, shown)) / scale;
      this.touched = performance.now();
      this.waiting = true;
      show();
    };
    const show = () => {
      const shown = target()[key] * scale;
      slider.value = shown;
      slider.style.setProperty('--done', `${(100 * (Math.min(high, Math.max(low, shown)) - low)) / (high - low)}%`);
      slider.setAttribute('aria-valuetext', `${+shown.toFixed(2)} ${unit}`);
      if (document.activeElement !== box) box.value = +shown.toFixed(2);
    };
    slider.addEventListener('input', () => put(Number(slider.value)));
    box.addEventListener('change', () => box.value !== '' && put(Number(box.value)));
    const last = element('span', 'unit', unit);
    line.append(name, slider, box, last);
    this.fields.push({ show });
    return line;
  }

  flush() {
    if (!this.waiting) return;
    this.waiting = false;
    const groups = this.gait.groups.map((g) => ({
      name: g.name,
      ...Object.fromEntries(kWave.map(([key]) => [key, g[key]])),
    }));
    this.ask('gait', { frequency_rad_per_s: this.gait.frequency_rad_per_s, groups });
  }
}
