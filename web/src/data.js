// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Reads the run that the recorder put into the page (src/record/page.cpp writes it).

function view(base64) {
  const text = atob(base64);
  const bytes = new Uint8Array(text.length);
  for (let i = 0; i < text.length; ++i) bytes[i] = text.charCodeAt(i);
  return new DataView(bytes.buffer);
}

function floats(base64) {
  const bytes = view(base64);
  return Float32Array.from({ length: bytes.byteLength / 4 }, (_, i) => bytes.getFloat32(4 * i, true));
}

/** Of times: after days a 32-bit one wouldn't tell two frames apart. */
function doubles(base64) {
  const bytes = view(base64);
  return Float64Array.from({ length: bytes.byteLength / 8 }, (_, i) => bytes.getFloat64(8 * i, true));
}

/** Named channels of one thing, each a Float32Array over the frames. */
function channels(all, names, frames, first) {
  const out = {};
  names.forEach((name, i) => {
    out[name] = all.subarray((first + i) * frames, (first + i + 1) * frames);
  });
  return out;
}

export function readRun(text) {
  const json = JSON.parse(text);
  if (json.format !== 2) throw new Error(`This page can't read data of format ${json.format}.`);
  const frames = json.frames;
  const time = doubles(json.time);
  const moving = json.links.map((link, i) => (link.pose ? -1 : i)).filter((i) => i >= 0);
  const readings = floats(json.actuators);
  let n = 0;
  const actuators = json.robots.flatMap((robot, robotIndex) =>
    robot.actuators.map((a) => ({
      ...a,
      model: robot.model,
      robot: robotIndex,
      index: n,
      data: channels(readings, json.actuator_channels, frames, json.actuator_channels.length * n++),
    })),
  );
  const energy = floats(json.energy);
  return {
    ...json,
    time,
    moving,
    poses: floats(json.poses),
    actuators,
    readings, // of all actuators; their data are views of it
    energyValues: energy,
    energy: channels(energy, json.energy_channels, frames, 0),
    geometries: json.geometries.map((g) => ({ vertices: floats(g.vertices), indices: Uint32Array.from(floats(g.indices)) })),
    start: frames ? time[0] : 0,
    end: frames ? time[frames - 1] : 0,
  };
}

/** Frame before time t and how far t is towards the next, 0…1. */
export function frameAt(run, t) {
  let low = 0;
  let high = run.frames - 1;
  if (high < 1 || t <= run.time[0]) return { frame: 0, part: 0 };
  if (t >= run.time[high]) return { frame: high - 1, part: 1 };
  while (high - low > 1) {
    const middle = (low + high) >> 1;
    if (run.time[middle] <= t) low = middle;
    else high = middle;
  }
  return { frame: low, part: (t - run.time[low]) / (run.time[high] - run.time[low]) };
}

export function valueAt(channel, at) {
  const a = channel[at.frame];
  return at.part > 0 ? a + (channel[at.frame + 1] - a) * at.part : a;
}

/** The model that the camera follows: the one with most actuators; without any, the first that moves. Null: nothing moves. */
export function mainModel(run) {
  let best = null;
  for (const robot of run.robots) {
    if (!best || robot.actuators.length > best.actuators.length) best = robot;
  }
  // A link knows its top-level model; a nested robot's scoped name begins with it.
  const top = best ? best.model.split('::')[0] : null;
  if (run.moving.some((i) => run.links[i].model === top)) return top;
  return run.moving.length ? run.links[run.moving[0]].model : null;
}

/** Mass-weighted centre of the model's links (their origins) and its lowest link, frame by frame: xyz and low. */
export function centrePath(run, model) {
  const width = run.moving.length * 7;
  const mine = run.moving.map((link, slot) => ({ slot, link: run.links[link] })).filter((m) => m.link.model === model);
  const mass = mine.reduce((sum, m) => sum + m.link.mass_kg, 0);
  const xyz = new Float32Array(run.frames * 3);
  const low = new Float32Array(run.frames);
  for (let f = 0; f < run.frames; ++f) {
    low[f] = mine.length ? Infinity : 0;
    for (const m of mine) {
      const weight = mass > 0 ? m.link.mass_kg / mass : 1 / mine.length;
      const at = f * width + m.slot * 7;
      for (let k = 0; k < 3; ++k) xyz[3 * f + k] += weight * run.poses[at + k];
      low[f] = Math.min(low[f], run.poses[at + 2]);
    }
  }
  return { xyz, low };
}
