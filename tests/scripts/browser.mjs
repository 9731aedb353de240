// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// What the page tests share: node SOME.test.mjs PAGES NPM [CHROMIUM] opens PAGES/NAME/FILE in Debian's Chromium; visit() opens any
// address. playwright-core comes
// from NPM/node_modules. Without Chromium it says so and ends with 77, which ctest reports as skipped.
import { existsSync } from 'node:fs';
import { createRequire } from 'node:module';
import { join, resolve } from 'node:path';
import { pathToFileURL } from 'node:url';

const [pages, npmGiven, given] = process.argv.slice(2);
const chromiumPath = [given, process.env.CHROMIUM, '/usr/bin/chromium', '/usr/bin/chromium-browser'].find((p) => p && existsSync(p));
if (!chromiumPath) {
  console.log('page test left out: no chromium (Debian: apt install chromium; elsewhere set CHROMIUM)');
  process.exit(77);
}
const npm = resolve(npmGiven);
const { chromium } = createRequire(join(npm, 'package.json'))('playwright-core');
const kArguments = [
  '--headless', '--no-sandbox', '--disable-quic', '--no-first-run', '--disable-background-networking', '--disable-component-update', '--disable-sync',
];
const kPatience = { timeout: 180_000 }; // software rendering on a busy machine

export const launch = (...more) => chromium.launch({ executablePath: chromiumPath, args: [...kArguments, ...more], ...kPatience });

/**
 * Opens an address; `wrong` fills with console errors, exceptions and requests that `allowed` doesn't allow. `before`: a function that runs
 * in the page before its own scripts.
 */
export async function visit(browser, url, allowed, context = {}, before = () => {}) {
  // Half the pixels each way: pictures are drawn by the processor here, and take a quarter of the time.
  const usual = { viewport: { width: 1000, height: 640 }, deviceScaleFactor: 0.5, reducedMotion: 'reduce' };
  const tab = await (await browser.newContext({ ...usual, ...context })).newPage();
  tab.setDefaultTimeout(kPatience.timeout);
  await tab.addInitScript(before);
  const wrong = [];
  tab.on('console', (m) => m.type() === 'error' && wrong.push(`console: ${m.text()}`));
  tab.on('pageerror', (e) => wrong.push(`exception: ${e.stack || e}`));
  tab.on('request', (r) => !allowed(r.url()) && !/^(data|blob):/.test(r.url()) && wrong.push(`request: ${r.url()}`));
  await tab.goto(url, { ...kPatience, waitUntil: 'domcontentloaded' });
  return { tab, wrong, close: () => tab.context().close() };
}

/** Opens PAGES/name/file, which may ask for nothing but itself. */
export function open(browser, name, file, context = {}) {
  const url = pathToFileURL(join(pages, name, file)).href;
  return visit(browser, url, (asked) => asked.split('#')[0] === url, context);
}
