// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// node live_fps.mjs VSA NPM [CHROMIUM]: pictures a second of the live page, by the page's own clock, while the 12-module snake crawls in
// real time with its curves shown. A line for each way in which a browser does without a GPU: as it does by itself (WebGL by SwiftShader,
// the page itself by its own software) and with everything, also the page, by SwiftShader. A third line is for machines without a GPU too:
// the page as it runs with one, all its shapes, shadows and reflections asked for, by a WebGL that draws nothing. It tells what the page
// itself can do, not what a GPU can. The median of 20 seconds, the extremes, the picture's size that the page has chosen, and what the
// machine draws with.
import { spawn } from 'node:child_process';
import { launch, visit } from '../tests/scripts/browser.mjs';

const kSeconds = 20;
const kBySoftware = ['--disable-gpu', '--enable-unsafe-swiftshader'];
const kWays = {
  'by itself': { flags: kBySoftware },
  'all by SwiftShader': { flags: ['--use-angle=swiftshader', '--enable-unsafe-swiftshader'] },
  'page alone, nothing drawn': { flags: kBySoftware, before: drawNothing },
};

/** In the page: WebGL takes every call, is asked for as much as a GPU, and draws nothing. */
function drawNothing() {
  const { prototype } = WebGL2RenderingContext;
  for (const name of ['drawElements', 'drawArrays', 'drawElementsInstanced', 'drawArraysInstanced', 'drawRangeElements', 'clear']) prototype[name] = () => {};
  const { getParameter } = prototype;
  const kRenderer = 0x9246; // UNMASKED_RENDERER_WEBGL
  prototype.getParameter = function (name) {
    return name === kRenderer ? 'nothing' : getParameter.call(this, name);
  };
}

/** Starts the run; its page's address. */
function start(child) {
  return new Promise((resolve, reject) => {
    let said = '';
    child.stderr.on('data', (text) => {
      said += text;
      const found = /live view: (http:\/\/127\.0\.0\.1:\d+\/)/.exec(said);
      if (found) resolve(found[1]);
    });
    child.on('exit', (code) => reject(new Error(`vsa ended with ${code}: ${said}`)));
  });
}

/** In the page: its own count once a second, after it has settled; then the picture's size and the renderer. */
async function count(seconds) {
  const wait = (ms) => new Promise((resolve) => setTimeout(resolve, ms));
  const { vsaLive: live } = window;
  while (live.frames < 60) await wait(100);
  await wait(5000);
  const seen = [];
  while (seen.length < seconds) {
    await wait(1000);
    seen.push(live.fps);
  }
  const gl = document.createElement('canvas').getContext('webgl2');
  const info = gl?.getExtension('WEBGL_debug_renderer_info');
  const { width, height } = live.stage.canvas;
  return { seen, size: `${width} × ${height}`, renderer: info ? gl.getParameter(info.UNMASKED_RENDERER_WEBGL) : 'unknown' };
}

for (const [way, { flags, before }] of Object.entries(kWays)) {
  const child = spawn(process.argv[2], ['run', 'snake_flat', '--gait', 'sidewind', '--view', '--no-topics'], { stdio: ['ignore', 'ignore', 'pipe'] });
  const url = await start(child);
  const browser = await launch(...flags);
  const context = { viewport: { width: 1280, height: 760 }, reducedMotion: 'no-preference' };
  const { tab } = await visit(browser, url, (asked) => asked.startsWith(url), context, before);
  await tab.click('#tab-curves');
  const { seen, size, renderer } = await tab.evaluate(count, kSeconds);
  seen.sort((a, b) => a - b);
  const [least, middle, most] = [seen[0], seen[kSeconds / 2], seen.at(-1)].map((x) => x.toFixed(0));
  console.log(`${way}: ${middle} pictures a second (${least} to ${most}) of ${size} points, drawn by ${renderer}`);
  await browser.close();
  child.removeAllListeners('exit');
  child.kill('SIGINT');
}
