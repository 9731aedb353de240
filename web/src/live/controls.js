// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Buttons, tabs and keys of the live page.
const $ = (id) => document.getElementById(id);

function toggle(id, onChange) {
  const button = $(id);
  button.addEventListener('click', () => {
    const on = button.getAttribute('aria-pressed') !== 'true';
    button.setAttribute('aria-pressed', String(on));
    onChange(on);
  });
}

function showTab(name, redrawCurves) {
  for (const [tab, pane] of [['table', 'table'], ['curves', 'curves-pane'], ['gait', 'gait']]) {
    const on = tab === name;
    $(`tab-${tab}`).setAttribute('aria-selected', String(on));
    $(`tab-${tab}`).tabIndex = on ? 0 : -1;
    $(pane).hidden = !on;
  }
  $('window-label').hidden = name !== 'curves';
  if (name === 'curves') redrawCurves();
}

function connectTabs(redrawCurves) {
  const tabs = ['table', 'curves', 'gait'];
  for (const [i, name] of tabs.entries()) {
    $(`tab-${name}`).addEventListener('click', () => showTab(name, redrawCurves));
    $(`tab-${name}`).addEventListener('keydown', (e) => {
      const by = { ArrowRight: 1, ArrowLeft: -1 }[e.key];
      if (!by) return;
      e.preventDefault();
      const shown = tabs.filter((t) => !$(`tab-${t}`).hidden);
      const next = shown[(shown.indexOf(tabs[i]) + by + shown.length) % shown.length];
      showTab(next, redrawCurves);
      $(`tab-${next}`).focus();
    });
  }
}

const kAnswer_ms = 2000; // after which a frame is believed whatever was asked

/**
 * Whether the run plays, as far as the page knows: what was asked for last, until a frame agrees; frames on their way still show the state
 * before, and a second press must undo the first.
 */
class Playing {
  constructor(link) {
    this.link = link;
    this.shown = false;
    this.asked = null;
  }

  get now() {
    return this.asked && performance.now() - this.asked.at < kAnswer_ms ? this.asked.playing : this.shown;
  }

  /** A frame came. */
  show(frame) {
    this.shown = !frame.paused;
    if (this.asked?.playing === this.shown) this.asked = null;
  }

  ask(playing, what, more) {
    if (!this.link.ready) return;
    this.asked = { playing, at: performance.now() };
    this.link.ask(what, more);
  }

  toggle() {
    if (this.now) this.ask(false, 'pause');
    else this.ask(true, 'play');
  }
}

/// What is clicked or typed goes to the run (`link`), the curves or the view (`stage`: a function, as there may be none). Returns what
/// knows whether the run plays.
export function connectControls({ link, live, curves, redrawCurves, stage }) {
  const playing = new Playing(link);
  $('play').addEventListener('click', () => playing.toggle());
  $('step').addEventListener('click', () => playing.ask(false, 'step', { steps: 1 }));
  $('reset').addEventListener('click', () => link.ask('reset'));
  $('speed').addEventListener('change', (e) => link.ask('speed', { factor: e.target.value === 'max' ? null : Number(e.target.value) }));
  $('record').addEventListener('click', () => link.ask('record', { on: !live.state?.recordings.now }));
  $('window').addEventListener('change', (e) => {
    curves.window = Number(e.target.value);
    curves.draw();
  });
  toggle('follow', (on) => stage()?.setFollowing(on));
  toggle('contacts', (on) => stage()?.setContacts(on));
  $('reset-view').addEventListener('click', () => stage()?.resetView());
  connectTabs(redrawCurves);
  connectKeys();
  return playing;
}

function connectKeys() {
  const keys = {
    ' ': () => $('play').click(),
    '.': () => $('step').click(),
    Backspace: () => $('reset').click(),
    f: () => $('follow').click(),
    c: () => $('contacts').click(),
    v: () => $('reset-view').click(),
  };
  document.addEventListener('keydown', (e) => {
    const key = keys[e.key];
    if (!key || e.ctrlKey || e.metaKey || e.altKey || e.target.matches('select, input')) return;
    if (e.key === ' ' && e.target.matches('button, a, summary')) return; // its own
    e.preventDefault();
    key();
  });
}
