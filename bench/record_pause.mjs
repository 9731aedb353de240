// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// node record_pause.mjs VSA WORLD [SECONDS] [-- more of vsa run]: how long a viewer sees the world stand still when a recording of so
// many simulated seconds (default 60) begins and when it ends: the largest gap between two frames, beside that of the rest of the run.
// It runs `vsa run WORLD --view --speed max`; frames come 60 times a second, so gaps below 17 ms can't be told apart.
import { spawn } from 'node:child_process';
import { mkdtempSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { view } from './viewer.mjs';

const given = process.argv.slice(2);
const cut = given.includes('--') ? given.indexOf('--') : given.length;
const [vsa, world, seconds = '60'] = given.slice(0, cut);
if (!vsa || !world) {
  console.error('usage: node record_pause.mjs VSA WORLD [SECONDS] [-- more of vsa run]');
  process.exit(2);
}

const kBefore_s = 5; // simulated, until it begins; and after it ended
const kNear_ms = 1000; // of wall time that a begin or an end may need to show
const records = mkdtempSync(join(tmpdir(), 'vsa_pause_'));
const end_s = 2 * kBefore_s + Number(seconds);
const more = ['--no-topics', '--speed', 'max', '--view-records', records, ...given.slice(cut + 1)];
const child = spawn(vsa, ['run', world, '--view', ...more]);
const gaps = { begin: 0, end: 0, rest: 0 };
const asked = { begin: NaN, end: NaN };
let viewer;
let last;

function frame(bytes) {
  const now = performance.now();
  const time_s = bytes.readDoubleLE(4);
  const near = Object.keys(asked).find((what) => now - asked[what] < kNear_ms) ?? 'rest';
  if (last !== undefined) gaps[near] = Math.max(gaps[near], now - last);
  last = now;
  if (Number.isNaN(asked.begin) && time_s > kBefore_s) {
    asked.begin = now;
    viewer.say('{"do":"record","on":true}');
  } else if (Number.isNaN(asked.end) && time_s > kBefore_s + Number(seconds)) {
    asked.end = now;
    viewer.say('{"do":"record","on":false}');
  } else if (time_s > end_s && now - asked.end > kNear_ms) {
    child.kill('SIGINT');
  }
}

child.stderr.on('data', (said) => {
  const port = /127\.0\.0\.1:(\d+)/.exec(said)?.[1];
  if (port) viewer = view(Number(port), frame);
});
await new Promise((resolve) => child.on('exit', resolve));
viewer?.close();
rmSync(records, { recursive: true });
const ms = (x) => `${x.toFixed(0)} ms`;
console.log(`largest gap between frames: ${ms(gaps.begin)} at the begin, ${ms(gaps.end)} at the end, ${ms(gaps.rest)} otherwise`);
