// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// node page_parts.test.mjs: parts of the replay and live pages without a browser, on stand-ins for what they use of one.
import assert from 'node:assert/strict';
import { test } from 'node:test';

/** As much of an element as the parts touch. */
class FakeElement extends EventTarget {
  constructor() {
    super();
    Object.assign(this, { className: '', textContent: '', value: '', children: [], attributes: {}, dataset: {}, properties: {} });
    this.style = { setProperty: (name, value) => (this.properties[name] = value) };
    this.classList = { toggle: () => {} };
  }
  append(...children) {
    this.children.push(...children);
  }
  setAttribute(name, value) {
    this.attributes[name] = value;
  }
  focus() {}
  /** Its own text and its children's. */
  get text() {
    return this.textContent + this.children.map((c) => c.text ?? c).join('');
  }
}
globalThis.document = { activeElement: null, createElement: () => new FakeElement() };
globalThis.window = { matchMedia: () => ({ matches: true }) };
document.documentElement = { classList: { contains: () => false } };

const src = (name) => import(new URL(`../../web/src/${name}`, import.meta.url));
const { actuatorPanels, linesOf } = await src('panels.js');
const { Commands } = await src('live/commands.js');
const { Table } = await src('live/table.js');
const { connectPulls } = await src('live/pulls.js');

const kNumbers = {
  shaft_rad: 0.5, shaft_speed_rad_per_s: 2, equilibrium_rad: 0.25, equilibrium_command_rad: 0.125, preset: 0.75, preset_command: 0.75,
  stiffness_Nm_per_rad: 40, torque_Nm: 3, current_1_A: 1, current_2_A: 1,
};
const data = () => Object.fromEntries(Object.entries(kNumbers).map(([name, x]) => [name, Float32Array.of(x)]));
let made = 0;
const actuator = (more) => ({ name: `joint_${made}`, index: made++, preset_unit: 'rad', linear: false, motors: 2, data: data(), ...more });
const some = (...kinds) => {
  made = 0;
  return kinds.map(actuator);
};
const kDegree = 180 / Math.PI;

const sourcesOf = (actuators) => actuators.map((a) => ({ name: a.name, color: `of ${a.name}`, data: a.data, actuator: a }));
/** What panels show, as the pages draw them: [title, unit, scale, names of the lines]. */
const shown = (actuators) =>
  actuatorPanels(actuators).map((p) => {
    const lines = linesOf(p, sourcesOf(actuators)).map((l) => l.label);
    return [p.title, p.unit, Number(p.scale.toFixed(3)), lines.join(', ')];
  });

test('curves of a turning shaft are in degrees and newton metres', () => {
  assert.deepEqual(shown(some({})), [
    ['Shaft angle', '°', 57.296, 'shaft, equilibrium, commanded'],
    ['Stiffness preset', '°', 57.296, 'attained, commanded'],
    ['Stiffness', 'N·m/rad', 1, 'stiffness'],
    ['Torque on the shaft', 'N·m', 1, 'torque'],
    ['Motor currents', 'A', 1, 'motor 1, motor 2'],
    ['Shaft speed', 'rad/s', 1, 'speed'],
  ]);
});

test('curves of a linear actuator are in metres and newtons', () => {
  assert.deepEqual(shown(some({ linear: true, preset_unit: 'N/m', motors: 1 })), [
    ['Shaft position', 'm', 1, 'shaft, equilibrium, commanded'],
    ['Stiffness preset', 'N/m', 1, 'attained, commanded'],
    ['Stiffness', 'N/m', 1, 'stiffness'],
    ['Force on the shaft', 'N', 1, 'force'],
    ['Motor current', 'A', 1, 'motor 1'],
    ['Shaft speed', 'm/s', 1, 'speed'],
  ]);
  assert.deepEqual(shown(some({ linear: true }))[1], ['Stiffness preset', '°', 57.296, 'attained, commanded'], 'a pulley turns all the same');
});

test('linear actuators beside turning ones have panels of their own, and so has each unit of the preset', () => {
  const mixed = some({}, { linear: true }, { preset_unit: 'N·m/rad' }, { preset_unit: '' });
  assert.deepEqual(shown(mixed).filter(([title]) => title !== 'Motor currents'), [
    ['Shaft angle', '°', 57.296, [0, 2, 3].flatMap((i) => ['shaft', 'equilibrium', 'commanded'].map((l) => `joint_${i} ${l}`)).join(', ')],
    ['Shaft position', 'm', 1, 'joint_1 shaft, joint_1 equilibrium, joint_1 commanded'],
    ['Stiffness preset', '°', 57.296, 'joint_0 attained, joint_0 commanded, joint_1 attained, joint_1 commanded'],
    ['Stiffness preset', 'N·m/rad', 1, 'joint_2 attained, joint_2 commanded'],
    ['Stiffness', 'N·m/rad', 1, 'joint_0, joint_2, joint_3'],
    ['Stiffness', 'N/m', 1, 'joint_1'],
    ['Torque on the shaft', 'N·m', 1, 'joint_0, joint_2, joint_3'],
    ['Force on the shaft', 'N', 1, 'joint_1'],
    ['Shaft speed', 'rad/s', 1, 'joint_0, joint_2, joint_3'],
    ['Shaft speed', 'm/s', 1, 'joint_1'],
  ]);
  const [line] = linesOf(actuatorPanels(mixed)[1], sourcesOf(mixed));
  assert.equal(line.color, 'of joint_1', 'alone in its panel it still has the colour of its chip');
});

/** The live table: its head, and each row's values with the unit that stands beside them. */
function table(actuators) {
  const root = new FakeElement();
  const made = new Table({ actuators }, root, () => {});
  made.limits = actuators.map(() => ({ equilibrium_rad: [-1, 1], preset: [0, 1] }));
  made.draw();
  made.setByHand(actuators.map(() => [true, false]));
  const beside = (cell) => (cell.className.split(' ').includes('own-unit') ? ` ${cell.dataset.unit}` : '');
  return {
    head: root.children[0].children.map((c) => c.text.trim()),
    rows: made.rows.map((r) => Object.values(r.texts).map((cell) => cell.textContent + beside(cell))),
    labels: made.rows.map((r) => Object.values(r.texts).map((cell) => `${cell.dataset.label} ${cell.dataset.unit}`)),
    hands: made.rows.map((r) => r.hand.textContent),
    bars: made.rows.map((r) => r.row.children[4].children[1].children[1].properties['--at']), // of the torque or force
  };
}

test('the table of turning actuators has its units in the head', () => {
  const { head, rows } = table(some({}, {}));
  assert.deepEqual(head, ['Actuator', 'Angle °', 'Preset °', 'Stiffness N·m/rad', 'Torque N·m', 'Currents A']);
  assert.deepEqual(rows[1], ['28.6', '43.0', '40.00', '3.000', '1.00 / 1.00']);
});

test('the table of linear actuators is in metres and newtons', () => {
  const { head, rows, labels, hands } = table(some({ linear: true, preset_unit: 'N/m' }));
  assert.deepEqual(head, ['Actuator', 'Position m', 'Preset N/m', 'Stiffness N/m', 'Force N', 'Currents A']);
  assert.deepEqual(rows, [['0.5000', '0.750', '40.00', '3.000', '1.00 / 1.00']]);
  assert.deepEqual(labels, [['position m', 'preset N/m', 'stiffness N/m', 'force N', 'currents A']]);
  assert.deepEqual(hands, ['position by hand']);
});

test('an actuator without a preset has none in the table', () => {
  const { rows } = table(some({ preset_unit: '' }, {}));
  assert.deepEqual(rows.map((cells) => cells[1].slice(0, 4)), ['–', '43.0']);
});

test('in a table of both, each number has its unit beside it, and bars compare what has one unit', () => {
  const both = some({}, { linear: true });
  both[1].data.torque_Nm[0] = 300;
  const { head, rows, bars } = table(both);
  assert.deepEqual(head, ['Actuator', 'Angle, Position', 'Preset °', 'Stiffness', 'Torque, Force', 'Currents A']);
  assert.deepEqual(rows, [
    ['28.6 °', '43.0', '40.00 N·m/rad', '3.000 N·m', '1.00 / 1.00'],
    ['0.5000 m', '43.0', '40.00 N/m', '300.000 N', '1.00 / 1.00'],
  ]);
  assert.deepEqual(bars, ['1.0000', '1.0000']);
});

/** The sliders of these actuators; `sent` fills with what they command. */
function sliders(actuators) {
  const sent = [];
  const part = () => ({ slider: new FakeElement(), number: new FakeElement(), unit: new FakeElement(), why: new FakeElement() });
  const commands = new Commands({ actuators }, { equilibrium: part(), preset: part() }, (command) => sent.push(command));
  commands.setLimits(actuators.map(() => ({ equilibrium_rad: [-1, 1], preset: [0, 2] })));
  return { commands, sent, ...commands.parts };
}
/** Moved as by a mouse: one that is off can't be. */
const move = ({ slider }, value) => {
  if (slider.disabled) return;
  slider.value = String(value);
  slider.dispatchEvent(new Event('input'));
};

test('the sliders of a turning shaft are in degrees', () => {
  const [one] = some({});
  const { commands, equilibrium, preset, sent } = sliders([one]);
  commands.choose([one]);
  assert.deepEqual([equilibrium.slider.max, equilibrium.unit.textContent, equilibrium.number.value], [kDegree, '°', '7.2']);
  assert.deepEqual([preset.slider.max, preset.unit.textContent, preset.number.value], [2 * kDegree, '°', '43.0']);
  move(equilibrium, 20);
  commands.flush();
  assert.deepEqual(sent, [{ actuators: [0], equilibrium_rad: 20 / kDegree }]);
});

test('the sliders of a linear actuator are in metres and in the unit of its preset', () => {
  const [one] = some({ linear: true, preset_unit: 'N/m' });
  const { commands, equilibrium, preset, sent } = sliders([one]);
  commands.choose([one]);
  assert.deepEqual([equilibrium.slider.min, equilibrium.slider.max, equilibrium.unit.textContent], [-1, 1, 'm']);
  assert.equal(equilibrium.number.value, '0.1250');
  assert.deepEqual([preset.slider.max, preset.unit.textContent, preset.number.value], [2, 'N/m', '0.750']);
  move(equilibrium, 0.02);
  move(preset, 1.5);
  commands.flush();
  assert.deepEqual(sent, [{ actuators: [0], equilibrium_rad: 0.02, preset: 1.5 }]);
});

test('a command goes to those chosen when it was given', () => {
  const [first, second] = some({}, {});
  const { commands, equilibrium, sent } = sliders([first, second]);
  commands.choose([first]);
  move(equilibrium, 20);
  commands.choose([second]);
  commands.flush();
  assert.deepEqual(sent, [{ actuators: [0], equilibrium_rad: 20 / kDegree }]);
});

test('one number goes to several presets only where they have one unit', () => {
  const [rad, stiffness, other, none] = some({}, { preset_unit: 'N·m/rad' }, {}, { preset_unit: '' });
  const { commands, equilibrium, preset, sent } = sliders([rad, stiffness, other, none]);
  for (const [chosen, units] of [[[rad, stiffness], '°, N·m/rad'], [[none, rad], 'none, °']]) {
    commands.choose(chosen);
    move(preset, 1);
    commands.moved('preset', 1);
    commands.flush();
    assert.deepEqual(sent, []);
    assert.ok(preset.slider.disabled && preset.number.disabled && !equilibrium.slider.disabled);
    assert.deepEqual([preset.why.hidden, preset.why.textContent], [false, `Off: the units of those chosen differ (${units}).`]);
    assert.deepEqual([preset.number.value, preset.unit.textContent], ['', ''], 'no number that is only one of theirs');
  }
  commands.choose([rad, other]);
  assert.deepEqual([preset.slider.disabled, preset.why.hidden, preset.unit.textContent], [false, true, '°']);
  move(preset, 30);
  commands.flush();
  assert.deepEqual(sent, [{ actuators: [0, 2], preset: 30 / kDegree }]);
});

test('one equilibrium goes to several shafts only where all turn or all slide', () => {
  const [turning, sliding, another] = some({}, { linear: true }, { linear: true });
  const { commands, equilibrium, preset, sent } = sliders([turning, sliding, another]);
  commands.choose([turning, sliding]);
  move(equilibrium, 0.5);
  commands.flush();
  assert.deepEqual(sent, []);
  assert.deepEqual([equilibrium.slider.disabled, equilibrium.why.hidden, preset.slider.disabled], [true, false, false]);
  assert.equal(equilibrium.why.textContent, 'Off: the units of those chosen differ (°, m).');
  commands.choose([sliding, another]);
  move(equilibrium, 0.5);
  commands.flush();
  assert.deepEqual(sent, [{ actuators: [1, 2], equilibrium_rad: 0.5 }]);
});

/** As much of a vector of three.js as a pull takes. */
class FakeVector {
  constructor(...x) {
    this.x = x;
  }
  clone() {
    return new FakeVector(...this.x);
  }
  set(...x) {
    this.x = x;
    return this;
  }
  add(by) {
    return this.set(...this.x.map((v, i) => v + by.x[i]));
  }
  normalize() {
    return this;
  }
  multiplyScalar(k) {
    return this.set(...this.x.map((v) => v * k));
  }
  toArray() {
    return this.x;
  }
}

/** One link, which a key pulls up by 1 m; `asked` fills with what goes to the run. */
function hand() {
  const asked = [];
  const canvas = new FakeElement();
  const stage = { canvas, size: 2.5, groups: [{ position: new FakeVector(0, 0, 0) }], direction: (right, up) => new FakeVector(right, 0, up) };
  const link = { ask: (what, more) => asked.push(what === 'pull' ? [what, more.target_m] : [what]) };
  const pulls = connectPulls(stage, link, { choose: () => {}, chosenLink: () => 0 });
  const event = (type, key) => canvas.dispatchEvent(Object.assign(new Event(type), { key, shiftKey: true }));
  return { pulls, asked, stage, press: (key) => event('keydown', key), letGo: (key) => event('keyup', key), leave: () => event('blur') };
}

test('a pull by keys ends when the picture loses the focus, also before it was sent', () => {
  const { pulls, asked, press, leave } = hand();
  press('ArrowUp');
  leave();
  pulls.flush();
  assert.deepEqual(asked, [['release']]);
  leave();
  assert.equal(asked.length, 1, 'nothing is held, nothing is let go');
});

test('a pull by keys begins where its link is, also after the last one ended by a lost focus', () => {
  const { pulls, asked, stage, press, letGo, leave } = hand();
  press('ArrowUp');
  pulls.flush();
  leave();
  stage.groups[0].position.set(0, 0, 5);
  press('ArrowUp');
  pulls.flush();
  letGo('ArrowUp');
  pulls.flush();
  assert.deepEqual(asked, [['pull', [0, 0, 1]], ['release'], ['pull', [0, 0, 6]], ['release']]);
});
