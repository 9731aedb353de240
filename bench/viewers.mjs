// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// node viewers.mjs VSA WORLD [VIEWERS…] [-- more of vsa run]: how fast a world runs with so many viewers (default: 0 1 8 0 1 8). Each
// viewer takes frames at 60 a second and draws nothing, so that what is measured is the run's own cost, not a browser's. It runs
// `vsa run WORLD --view --speed max` anew for each and prints the real-time factor that the command tells at the end.
import { spawn } from 'node:child_process';
import { view } from './viewer.mjs';

const given = process.argv.slice(2);
const cut = given.includes('--') ? given.indexOf('--') : given.length;
const [vsa, world, ...counts] = given.slice(0, cut);
if (!vsa || !world) {
  console.error('usage: node viewers.mjs VSA WORLD [VIEWERS…] [-- more of vsa run]');
  process.exit(2);
}

async function run(viewers) {
  const child = spawn(vsa, ['run', world, '--view', '--no-topics', '--speed', 'max', ...given.slice(cut + 1)]);
  const counter = { frames: 0 };
  let sockets = [];
  let out = '';
  child.stderr.on('data', (said) => {
    const port = /127\.0\.0\.1:(\d+)/.exec(said)?.[1];
    if (port) sockets = Array.from({ length: viewers }, () => view(Number(port), () => ++counter.frames));
  });
  child.stdout.on('data', (said) => (out += said));
  await new Promise((resolve) => child.on('exit', resolve));
  sockets.forEach((s) => s.close());
  const wall = Number(/in ([\d.]+) s of wall time/.exec(out)?.[1]);
  const simulated = Number(/simulated time\s+([\d.]+) s/.exec(out)?.[1]);
  const each = viewers ? counter.frames / viewers / wall : 0;
  console.log(`${viewers} viewers: ${(simulated / wall).toFixed(2)} times real time, ${each.toFixed(1)} frames a second each`);
}

for (const viewers of counts.length ? counts.map(Number) : [0, 1, 8, 0, 1, 8]) await run(viewers);
