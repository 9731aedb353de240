// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// node site.test.mjs SITE NPM [CHROMIUM]: the documentation that `make docs` wrote into SITE, in a browser (browser.mjs), from the
// disk: it needs neither a server nor the net.
import assert from 'node:assert/strict';
import { join } from 'node:path';
import { after, before, test } from 'node:test';
import { pathToFileURL } from 'node:url';
import { launch, visit } from './browser.mjs';

let browser;
before(async () => {
  browser = await launch();
});
after(() => browser?.close());

const site = pathToFileURL(join(process.argv[2], '/')).href;
const open = (file, options = {}) =>
  visit(browser, site + file, (asked) => asked.startsWith(site), { viewport: { width: 1280, height: 900 }, ...options });

test('the first page leads to every chapter', { timeout: 120_000 }, async () => {
  const { tab, wrong, close } = await open('index.html');
  const captions = await tab.locator('.wy-menu .caption-text').allTextContents();
  assert.deepEqual(captions, ['Begin', 'How to', 'Reference', 'Explanation', 'Laboratory', 'Names']);
  assert.ok((await tab.locator('.wy-menu a').count()) > 50);
  await tab.locator('.wy-menu a', { hasText: 'The first hour' }).click();
  await tab.waitForSelector('h1:has-text("The first hour")');
  assert.deepEqual(wrong, []);
  await close();
});

test('a search finds a page and a name', { timeout: 120_000 }, async () => {
  const { tab, wrong, close } = await open('search.html');
  await tab.goto(`${tab.url()}?q=presliding`);
  await tab.waitForSelector('#search-results ul.search li a');
  assert.ok((await tab.locator('#search-results ul.search li').count()) >= 3);
  await tab.goto(tab.url().replace('presliding', 'command_for'));
  await tab.waitForSelector('#search-results ul.search li a:has-text("command_for")');
  assert.deepEqual(wrong, []);
  await close();
});

test('the replay runs inside its page', { timeout: 120_000 }, async () => {
  const { tab, wrong, close } = await open('replay.html');
  const frame = tab.frameLocator('iframe');
  await frame.locator('canvas').first().waitFor();
  await frame.locator('text=joint_11').first().waitFor();
  assert.deepEqual(wrong, []);
  await close();
});

test('a class of each language has its page', { timeout: 120_000 }, async () => {
  const cpp = await open('cpp/annotated.html');
  assert.ok((await cpp.tab.locator('a[href="classvsa_1_1engine_1_1World.html"]').count()) > 0);
  assert.deepEqual(cpp.wrong, []);
  await cpp.close();
  const python = await open('python.html');
  assert.equal(await python.tab.locator('dt[id="vsasim.World"]').count(), 1);
  assert.match(await python.tab.locator('dt[id="vsasim.World.step"] + dd').innerText(), /step/);
  assert.deepEqual(python.wrong, []);
  await python.close();
});

test('nothing is wider than a narrow window', { timeout: 120_000 }, async () => {
  for (const file of ['index.html', 'howto/your-actuator.html', 'explanation/rooms.html']) {
    const { tab, close } = await open(file, { viewport: { width: 420, height: 800 } });
    const width = await tab.evaluate(() => document.documentElement.scrollWidth);
    assert.ok(width <= 420, `${file}: ${width} px`);
    await close();
  }
});
