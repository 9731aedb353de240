// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// The page: reads the run, makes the view, the curves and the controls, and keeps them at the same time.
import { Curves } from './curves.js';
import { readRun } from './data.js';
import { Modules } from './modules.js';
import { dark } from './palette.js';
import { actuatorPanels, energyPanels } from './panels.js';
import { Playback } from './playback.js';
import { Stage } from './stage.js';

const $ = (id) => document.getElementById(id);
const run = readRun($('data').textContent);
const playback = new Playback(run.start, run.end);
const kHeadline = 4; // statistics beside the title; the others unfold
let stage = null;
let energyShown = run.actuators.length === 0;

/** "1.89 m along the path": the number and its unit stand out, the rest explains. */
function statistic(label, value) {
  const item = document.createElement('div');
  const dt = document.createElement('dt');
  const dd = document.createElement('dd');
  const [, number, rest] = /^([+−-]?[\d.]+(?:e[+-]?\d+)? ?(?:[^\s\d,]{1,7}(?=\s|,|$))?)(.*)$/s.exec(value) ?? [null, value, ''];
  const lead = document.createElement('b');
  const more = document.createElement('span');
  dt.textContent = label;
  lead.textContent = number;
  more.textContent = rest;
  dd.title = value;
  dd.append(lead, more);
  item.append(dt, dd);
  return item;
}

function writeHeader() {
  document.title = `${run.title} – vsasim replay`;
  $('title').textContent = run.title;
  const count = run.actuators.length;
  $('subtitle').textContent = `world ${run.world} · ${count} actuator${count === 1 ? '' : 's'} · ${+(run.step_s * 1e3).toFixed(4)} ms steps`;
  const items = run.summary.map(([label, value]) => statistic(label, value));
  $('summary').append(...items.slice(0, kHeadline));
  $('more').hidden = items.length <= kHeadline;
  $('more-list').append(...items.slice(kHeadline));
  for (const note of run.notes) {
    const p = document.createElement('p');
    p.textContent = note;
    $('notes').append(p);
  }
}

function makeStage() {
  try {
    // Asked on a canvas of its own: three.js would log an error, and a context's settings can't be changed later.
    if (!document.createElement('canvas').getContext('webgl2')) throw new Error('no webgl2 context');
    stage = new Stage(run, $('canvas'));
  } catch (error) {
    const message = $('view-message');
    const strong = document.createElement('strong');
    strong.textContent = 'No 3-D view: this browser has no WebGL.';
    message.replaceChildren(strong, 'The curves work without it. Turn on hardware acceleration, or open the page in another browser.');
    message.hidden = false;
    $('canvas').hidden = true;
    document.querySelector('.view-tools').hidden = true;
    console.info('No WebGL:', error.message);
  }
}

function redrawCurves() {
  if (energyShown) curves.show(energyPanels(run.energy), [{ name: 'energy', color: '', data: run.energy }]);
  else curves.show(actuatorPanels(modules.chosen), modules.sources());
}

function selectionChanged(chosen) {
  stage?.highlight(chosen);
  setEnergyShown(false);
}

function setEnergyShown(on) {
  energyShown = on;
  $('show-energy').setAttribute('aria-pressed', String(on));
  $('show-modules').setAttribute('aria-pressed', String(!on));
  $('modules').hidden = on;
  $('compare').hidden = on;
  redrawCurves();
}

const curves = new Curves(run, $('curves'), (t) => playback.seek(t));
const modules = new Modules(run, $('modules'), selectionChanged);

function toggle(id, onChange) {
  const button = $(id);
  button.addEventListener('click', () => {
    const on = button.getAttribute('aria-pressed') !== 'true';
    button.setAttribute('aria-pressed', String(on));
    onChange(on);
  });
}

function connectControls() {
  $('play').addEventListener('click', () => playback.toggle());
  $('scrub').min = run.start;
  $('scrub').max = run.end;
  $('scrub').addEventListener('input', (e) => playback.seek(Number(e.target.value)));
  $('speed').addEventListener('change', (e) => (playback.speed = Number(e.target.value)));
  toggle('loop', (on) => (playback.loop = on));
  toggle('follow', (on) => stage?.setFollowing(on));
  toggle('path', (on) => {
    if (!stage) return;
    stage.trace.group.visible = on;
    stage.dirty = true;
  });
  toggle('compare', (on) => modules.setComparing(on));
  $('reset-view').addEventListener('click', () => stage?.resetView());
  $('show-energy').addEventListener('click', () => setEnergyShown(true));
  $('show-modules').addEventListener('click', () => setEnergyShown(false));
  $('show-modules').hidden = run.actuators.length === 0;
}

function connectKeys() {
  const step = (e) => (e.shiftKey ? 1 : 0.1);
  const keys = {
    ' ': () => playback.toggle(),
    ArrowLeft: (e) => playback.seek(playback.time - step(e)),
    ArrowRight: (e) => playback.seek(playback.time + step(e)),
    Home: () => playback.seek(run.start),
    End: () => playback.seek(run.end),
    f: () => $('follow').click(),
    p: () => $('path').click(),
    l: () => $('loop').click(),
    r: () => $('reset-view').click(),
  };
  document.addEventListener('keydown', (e) => {
    const key = keys[e.key];
    if (!key || e.ctrlKey || e.metaKey || e.altKey || e.target.matches('select')) return;
    if (e.key === ' ' && e.target.matches('button')) return; // the button's own
    e.preventDefault();
    key(e);
  });
}

function connectPicking() {
  const canvas = $('canvas');
  let down = null;
  canvas.addEventListener('pointerdown', (e) => (down = [e.clientX, e.clientY]));
  canvas.addEventListener('pointerup', (e) => {
    if (!down || Math.hypot(e.clientX - down[0], e.clientY - down[1]) > 5) return;
    const link = stage.pick(e.clientX, e.clientY);
    const actuator = run.actuators.find((a) => a.links.includes(link));
    if (actuator) modules.choose(actuator, modules.comparing || e.shiftKey);
  });
}

function writeTime() {
  const { time } = playback;
  const part = playback.duration > 0 ? (time - run.start) / playback.duration : 0;
  $('scrub').value = time;
  $('scrub').style.setProperty('--done', `${100 * part}%`);
  $('scrub').setAttribute('aria-valuetext', `${time.toFixed(2)} seconds`);
  const now = document.createElement('b');
  now.textContent = `${time.toFixed(2)} s`;
  const of = document.createElement('span');
  of.className = 'of';
  of.textContent = ` / ${run.end.toFixed(2)} s`;
  $('clock').replaceChildren(now, of);
  $('play').classList.toggle('playing', playback.playing);
  $('play').setAttribute('aria-label', playback.playing ? 'Pause' : 'Play');
}

function placeLabel() {
  const actuator = modules.chosen[modules.chosen.length - 1];
  const link = actuator?.links[0];
  const at = link === undefined ? null : stage.screen(link, stage.size * 0.13);
  const label = $('label');
  label.hidden = !at;
  if (!at) return;
  label.textContent = actuator.name;
  label.style.transform = `translate(${at.x}px, ${at.y}px) translate(-50%, -100%)`;
}

function everyFrame() {
  let last = performance.now();
  const tick = (now) => {
    // A tab that slept doesn't jump.
    playback.advance(Math.min(0.25, (now - last) / 1000));
    last = now;
    if (stage?.render()) placeLabel();
    requestAnimationFrame(tick);
  };
  requestAnimationFrame(tick);
}

writeHeader();
makeStage();
connectControls();
connectKeys();
if (stage) {
  connectPicking();
  new ResizeObserver(() => stage.resize()).observe($('view'));
  stage.resize();
  stage.resetView();
  stage.highlight(modules.chosen);
}
setEnergyShown(energyShown);
playback.onChange(() => {
  stage?.show(playback.time);
  curves.setTime(playback.time);
  writeTime();
});
playback.seek(run.start);
dark.addEventListener('change', () => {
  modules.paint();
  redrawCurves();
});
everyFrame();
if (!window.matchMedia('(prefers-reduced-motion: reduce)').matches) playback.play();

// For the browser's console and the tests.
window.vsaReplay = { run, playback, stage, modules, curves };
