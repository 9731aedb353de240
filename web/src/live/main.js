// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// The live page: what the run sends goes to the view, the table and the curves; what is clicked goes to the run.
import { readRun } from '../data.js';
import { element } from '../marks.js';
import { Modules } from '../modules.js';
import { dark } from '../palette.js';
import { actuatorPanels, energyPanels } from '../panels.js';
import { Commands } from './commands.js';
import { connectControls } from './controls.js';
import { connectPulls } from './pulls.js';
import { readFrame } from './frame.js';
import { GaitPanel } from './gait.js';
import { History } from './history.js';
import { Link } from './link.js';
import { LiveStage } from './stage.js';
import { Strips } from './strips.js';
import { Table } from './table.js';

const $ = (id) => document.getElementById(id);
const calm = window.matchMedia('(prefers-reduced-motion: reduce)').matches;
const kLongest_s = 30;
const kRate_Hz = 60;
const kCurves_ms = calm ? 250 : 50; // between two drawings
const kSoftwareCurves_ms = Math.max(kCurves_ms, 200);
const kTable_ms = 80;
const kNote_ms = 8000;
const kSoftware_ms = 30; // between two pictures where the processor draws them: it has other things to do

const run = readRun($('data').textContent);
const history = new History(run, kLongest_s, kRate_Hz);
const live = { run, history, frame: null, frames: 0, state: null, errors: [], fps: 0 };
let stage = null;
let pulls = null;
let waiting = null; // newest frame not yet drawn
let signals = new Set(['Shaft angle', 'Shaft position', 'Stiffness', 'Torque on the shaft', 'Force on the shaft']);

function note(text, kind = 'note') {
  const p = element('p', kind, text);
  $('notes').append(p);
  setTimeout(() => p.remove(), kNote_ms);
}

function setStatus(text, kind) {
  $('status').textContent = text;
  $('status').className = `pill ${kind}`;
}

const link = new Link({
  open() {
    setStatus('live', 'good');
  },
  lost() {
    if (!link.ended) setStatus('connection lost', 'bad');
  },
  text(message) {
    if (message.type === 'hello') {
      // Another run answers: its world may be another.
      if (live.id && live.id !== message.run) location.reload();
      live.id = message.run;
      setOffers(message.offers);
      table.limits = message.actuators;
      live.bounds = message.gait_bounds;
      commands.setLimits(message.actuators);
      makeGroups(message.state.gait);
      setState(message.state);
    } else if (message.type === 'state') {
      setState(message);
    } else if (message.type === 'end') {
      link.ended = true;
      setStatus(message.text, 'bad');
    } else {
      if (message.type === 'error') live.errors.push(message.text);
      note(message.text, message.type);
    }
  },
  frame(buffer) {
    if (waiting) link.ask('next'); // never drawn: a newer one is here
    waiting = buffer;
  },
});

/** What the simulator can't do isn't shown. */
function setOffers({ contacts, control, hands }) {
  for (const id of ['play', 'step', 'reset', 'speed']) {
    $(id).disabled = !control;
    ($(id).closest('label') ?? $(id)).hidden = !control;
  }
  $('contacts').disabled = !contacts;
  $('contacts').hidden = !contacts;
  $('hint-control').hidden = !control;
  for (const part of document.querySelectorAll('.hint-hands')) part.hidden = !hands;
  const drag = hands ? 'Drag a link to pull it, drag elsewhere to orbit' : 'Drag to orbit';
  const keys = hands ? "; shift and arrow keys pull the chosen joint's link" : '';
  $('canvas').setAttribute('aria-label', `3-D view of the running robot. ${drag}, click a link to choose it. Arrow keys orbit${keys}.`);
  if (pulls) pulls.hands = hands;
  live.offers = { contacts, control, hands };
}

function setState(state) {
  live.state = state;
  const speed = state.speed === null ? 'max' : String(state.speed);
  if (![...$('speed').options].some((o) => o.value === speed)) $('speed').append(new Option(`${speed}×`, speed));
  $('speed').value = speed;
  table.setByHand(state.by_hand);
  $('tab-gait').hidden = !state.gait;
  if (state.gait) gaitPanel.set(state.gait, live.bounds);
  const { now, writing, done } = state.recordings;
  $('record').setAttribute('aria-pressed', String(Boolean(now)));
  $('record').querySelector('span').textContent = now ? 'Stop' : 'Record';
  $('recordings').hidden = !now && !writing.length && !done.length;
  $('recordings').replaceChildren(...(now ? [element('span', 'recording', `Recording into ${now}`)] : []));
  $('recordings').append(...writing.map((name) => element('span', '', `Writing ${name} …`)));
  for (const one of done) {
    const a = element('a', '', `${one.name}.html`);
    Object.assign(a, { href: one.url, download: `${one.name}.html`, title: one.path });
    $('recordings').append(a);
  }
}

// What is chosen
const curves = new Strips(history, $('curves'));
const table = new Table(run, $('rows'), (actuator, more) => modules.choose(actuator, more));
const field = (what) => ({ slider: $(what), number: $(`${what}-number`), unit: $(`${what}-unit`), why: $(`${what}-why`) });
const commands = new Commands(run, { equilibrium: field('equilibrium'), preset: field('preset') }, (command) => link.ask('command', command));
const modules = new Modules(run, $('modules'), chosenChanged);
const gaitPanel = new GaitPanel($('gait'), (what, more) => link.ask(what, more));
let group = null; // actuators that the sliders move, where that is more than the chips show

function chosenChanged(chosen, all = null) {
  group = all;
  const commanded = all ?? chosen;
  stage?.highlight(commanded);
  table.setChosen(commanded);
  commands.choose(commanded);
  for (const b of $('groups').children) b.setAttribute('aria-pressed', String(b.dataset.size === String(all?.length) && b.actuators === all));
  redrawCurves();
}

function makeGroups(gait) {
  $('groups').replaceChildren();
  const button = (text, actuators) => {
    if (actuators.length < 2) return;
    const b = element('button', '', text);
    b.type = 'button';
    b.actuators = actuators;
    b.dataset.size = actuators.length;
    b.setAttribute('aria-pressed', 'false');
    b.addEventListener('click', () => chosenChanged(modules.chosen, group === actuators ? null : actuators));
    $('groups').append(b);
  };
  button('All', run.actuators);
  for (const g of gait?.groups ?? []) {
    button(g.name, run.actuators.filter((a) => g.actuators.includes(a.name) || g.actuators.includes(`${a.model}/${a.name}`)));
  }
}

function redrawCurves() {
  const panels = actuatorPanels(modules.chosen.length ? modules.chosen : run.actuators);
  const energies = energyPanels(run.energy);
  $('signals').replaceChildren();
  // Panels of one title, in different units, share a chip.
  for (const title of new Set([...panels, ...energies].map((p) => p.title))) {
    const chip = element('button', '', title);
    chip.type = 'button';
    chip.setAttribute('aria-pressed', String(signals.has(title)));
    chip.addEventListener('click', () => {
      if (!signals.delete(title)) signals.add(title);
      redrawCurves();
    });
    $('signals').append(chip);
  }
  if ($('curves-pane').hidden) return;
  const wanted = (list) => list.filter((p) => signals.has(p.title));
  curves.show([
    { panels: modules.chosen.length ? wanted(panels) : [], sources: modules.sources() },
    { panels: wanted(energies), sources: [{ name: 'energy', color: '', data: run.energy }] },
  ]);
}

function makeStage() {
  try {
    // Asked on a canvas of its own: three.js would log an error, and a context's settings can't be changed later.
    const gl = document.createElement('canvas').getContext('webgl2');
    if (!gl) throw new Error('no webgl2 context');
    stage = new LiveStage(run, $('canvas'), gl);
    gl.getExtension('WEBGL_lose_context')?.loseContext();
    document.documentElement.classList.toggle('software', stage.software);
  } catch (error) {
    const strong = element('strong', '', 'No 3-D view: this browser has no WebGL.');
    $('view-message').replaceChildren(strong, 'Sliders, numbers and curves work without it.');
    $('view-message').hidden = false;
    $('canvas').hidden = true;
    document.querySelector('.view-tools').hidden = true;
    console.info('No WebGL:', error.message);
  }
}

function writeHeader() {
  document.title = `${run.title} – vsasim live`;
  $('title').textContent = run.title;
  const count = run.actuators.length;
  $('subtitle').textContent = `world ${run.world} · ${count} actuator${count === 1 ? '' : 's'} · ${+(run.step_s * 1e3).toFixed(4)} ms steps`;
  for (const text of run.notes) note(text);
}

function placeLabel() {
  const actuator = group ? null : modules.chosen[modules.chosen.length - 1];
  const at = actuator?.links.length ? stage.screen(actuator.links[0], stage.size * 0.13) : null;
  const label = $('label');
  label.hidden = !at;
  if (!at) return;
  label.textContent = actuator.name;
  label.style.transform = `translate(${at.x}px, ${at.y}px) translate(-50%, -100%)`;
}

function takeFrame() {
  if (!waiting) return;
  const frame = readFrame(waiting, run);
  waiting = null;
  link.ask('next');
  if (!frame) return;
  const before = live.frame;
  live.frame = frame;
  playing.show(frame);
  ++live.frames;
  history.add(frame.time);
  const still = before && before.time === frame.time && !before.pulls.length && !frame.pulls.length;
  if (!still) stage?.moved(frame);
}

function writeClock() {
  const { frame } = live;
  if (!frame) return;
  $('clock').replaceChildren(element('b', '', `${frame.time.toFixed(3)} s`));
  $('play').classList.toggle('playing', playing.now);
  $('play').setAttribute('aria-label', playing.now ? 'Pause' : 'Play');
  $('factor').textContent = frame.paused ? '–' : frame.factor.toPrecision(2).replace(/\.?0+e\+?/, 'e');
  if (link.ready && !link.ended) setStatus(frame.paused ? 'paused' : 'running', frame.paused ? '' : 'good');
}

function everyFrame() {
  let last = performance.now();
  let curvesAt = 0;
  let tableAt = 0;
  let second = last;
  let pictures = 0;
  const tick = (now) => {
    commands.flush();
    gaitPanel.flush();
    pulls?.flush();
    if (!stage?.software || now - last >= kSoftware_ms) {
      takeFrame();
      if (stage?.render()) {
        placeLabel();
        stage.timed(now - last);
        ++pictures;
      }
      last = now;
    }
    if (now - tableAt >= kTable_ms) {
      tableAt = now;
      writeClock();
      commands.follow();
      if (!$('table').hidden) table.draw();
    }
    if (now - curvesAt >= (stage?.software ? kSoftwareCurves_ms : kCurves_ms) && !$('curves-pane').hidden) {
      curvesAt = now;
      curves.draw();
    }
    if (now - second >= 1000) {
      live.fps = (1000 * pictures) / (now - second);
      $('fps').textContent = live.fps.toFixed(0);
      second = now;
      pictures = 0;
    }
    requestAnimationFrame(tick);
  };
  requestAnimationFrame(tick);
}

writeHeader();
makeStage();
const playing = connectControls({ link, live, curves, redrawCurves, stage: () => stage });
if (stage) {
  pulls = connectPulls(stage, link, {
    choose(index, more) {
      const actuator = run.actuators.find((a) => a.links.includes(index));
      if (actuator) modules.choose(actuator, more);
    },
    chosenLink: () => modules.chosen[modules.chosen.length - 1]?.links[0] ?? run.moving[0],
  });
  new ResizeObserver(() => stage.resize()).observe($('view'));
  stage.resize();
  stage.resetView();
}
chosenChanged(modules.chosen);
$('tab-gait').hidden = true;
dark.addEventListener('change', () => {
  modules.paint();
  redrawCurves();
});
everyFrame();

// For the browser's console and the tests.
window.vsaLive = Object.assign(live, { link, stage, modules, commands, table, curves, pulls });
