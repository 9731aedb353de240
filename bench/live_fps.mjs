// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// node live_fps.mjs VSA NPM [CHROMIUM]: pictures a second of the live page, by the page's own clock, while the 12-module snake crawls in
// real time with its curves shown. One line: the median of 20 seconds, and what the machine draws with.
import { spawn } from 'node:child_process';
import { launch, visit } from '../tests/scripts/browser.mjs';

const kSeconds = 20;
const child = spawn(process.argv[2], ['run', 'snake_flat', '--gait', 'sidewind', '--view', '--no-topics'], { stdio: ['ignore', 'ignore', 'pipe'] });
const url = await new Promise((resolve, reject) => {
  let said = '';
  child.stderr.on('data', (text) => {
    said += text;
    const found = /live view: (http:\/\/127\.0\.0\.1:\d+\/)/.exec(said);
    if (found) resolve(found[1]);
  });
  child.on('exit', (code) => reject(new Error(`vsa ended with ${code}: ${said}`)));
});
const browser = await launch('--use-angle=swiftshader', '--enable-unsafe-swiftshader');
const { tab } = await visit(browser, url, (asked) => asked.startsWith(url), { viewport: { width: 1280, height: 760 } });
await tab.click('#tab-curves');
await tab.evaluate(() => new Promise((resolve) => { const look = () => (window.vsaLive.frames > 60 ? resolve() : requestAnimationFrame(look)); look(); }));
const counts = await tab.evaluate(
  (seconds) =>
    new Promise((resolve) => {
      const seen = [];
      const look = () => {
        seen.push(window.vsaLive.fps);
        if (seen.length === seconds) resolve(seen);
        else setTimeout(look, 1000);
      };
      setTimeout(look, 2000);
    }),
  kSeconds,
);
const renderer = await tab.evaluate(() => {
  const gl = document.createElement('canvas').getContext('webgl2');
  const info = gl?.getExtension('WEBGL_debug_renderer_info');
  return info ? gl.getParameter(info.UNMASKED_RENDERER_WEBGL) : 'unknown';
});
counts.sort((a, b) => a - b);
console.log(`${counts[kSeconds / 2].toFixed(0)} pictures a second (${counts[0].toFixed(0)} to ${counts.at(-1).toFixed(0)}), drawn by ${renderer}`);
await browser.close();
child.kill('SIGINT');
