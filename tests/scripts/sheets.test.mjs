// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// node sheets.test.mjs PAGES NPM [CHROMIUM]: what `vsa datasheet --all` and `vsa experiments` wrote into PAGES/sheets and
// PAGES/experiments, in a browser (browser.mjs).
import assert from 'node:assert/strict';
import { readdirSync } from 'node:fs';
import { join } from 'node:path';
import { after, before, test } from 'node:test';
import { launch, open as openPage } from './browser.mjs';

const files = readdirSync(join(process.argv[2], 'sheets')).filter((f) => f.endsWith('.html'));
const sheets = files.filter((f) => !['index.html', 'comparison.html'].includes(f));

let browser;
before(async () => {
  browser = await launch();
});
after(() => browser?.close());

const wide = { viewport: { width: 1280, height: 900 } };
/** How many lines each plot has, and how far the farthest-reaching goes, px. */
const plots = (tab) =>
  tab.evaluate(() =>
    [...document.querySelectorAll('.plot')].map((plot) => {
      const boxes = [...plot.querySelectorAll('.trace .js-line')].map((p) => p.getBBox());
      return { lines: boxes.length, span: Math.max(...boxes.map((b) => Math.hypot(b.width, b.height))) };
    }));
const hrefs = (tab, place) => tab.locator(place).evaluateAll((links) => links.map((l) => decodeURIComponent(l.getAttribute('href').slice(2))));

test('the gallery has a picture of every type and leads to its sheet', { timeout: 600_000 }, async () => {
  const { tab, wrong, close } = await openPage(browser, 'sheets', 'index.html', wide);
  assert.ok(sheets.length >= 15);
  assert.deepEqual((await hrefs(tab, '.gallery h3 a')).sort(), [...sheets].sort());
  assert.deepEqual(await hrefs(tab, '#beside a'), ['comparison.html']);
  const drawn = await tab.evaluate(() => [...document.querySelectorAll('.gallery svg .edge')].map((e) => e.getAttribute('d').length));
  assert.equal(drawn.length, 2 * sheets.length);
  assert.ok(drawn.every((length) => length > 100));
  assert.ok(await tab.evaluate(() => document.documentElement.scrollWidth <= 1280));
  assert.deepEqual(wrong, []);
  await close();
});

test('the comparison has a row and curves of every type, on equal axes', { timeout: 600_000 }, async () => {
  const { tab, wrong, close } = await openPage(browser, 'sheets', 'comparison.html', wide);
  const rows = await tab.evaluate(() => [...document.querySelectorAll('table')].map((t) => t.querySelectorAll('tbody tr').length));
  assert.deepEqual(rows, [sheets.length, sheets.length, sheets.length]);
  assert.deepEqual([...new Set(await hrefs(tab, 'tbody th a'))].sort(), [...sheets].sort());
  const charts = await plots(tab);
  assert.equal(charts.length, 6);
  for (const { lines, span } of charts) assert.ok(lines >= 8 && span > 150, `${lines} lines, ${span} px`);
  assert.equal(charts[0].lines, sheets.length, 'stiffness against load, softest');
  const ranges = await tab.evaluate(() => [...document.querySelectorAll('.plot')].map((p) => JSON.stringify([p._fullLayout.xaxis.range, p._fullLayout.yaxis.range])));
  assert.equal(ranges[0], ranges[1], 'softest and stiffest');
  assert.equal(ranges[2], ranges[3]);
  assert.deepEqual(wrong, []);
  await close();
});

for (const file of sheets) {
  test(`the sheet prints on one A4 page: ${file}`, { timeout: 600_000 }, async () => {
    const { tab, wrong, close } = await openPage(browser, 'sheets', file, wide);
    const charts = await plots(tab);
    assert.ok(charts.length >= 3);
    for (const { lines, span } of charts) assert.ok(lines >= 1 && span > 100, `${lines} lines, ${span} px`);
    const text = (await tab.pdf({ preferCSSPageSize: true, printBackground: true })).toString('latin1');
    assert.equal(text.match(/\/Type \/Page\b/g).length, 1);
    assert.match(text, /\/MediaBox \[0 0 59[45][.\d]* 84[12][.\d]*\]/, 'A4');
    assert.deepEqual(wrong, []);
    await close();
  });
}

test('the tasks have bars from the best on, a table and curves', { timeout: 600_000 }, async () => {
  const { tab, wrong, close } = await openPage(browser, 'experiments', 'report.html', wide);
  const widths = await tab.evaluate(() => [...document.querySelectorAll('.bars')].map((card) => [...card.querySelectorAll('.bar')].map((b) => b.getBoundingClientRect().width)));
  assert.equal(widths.length, 3);
  for (const one of widths) assert.equal(one.length, 3);
  assert.deepEqual(widths[0], [...widths[0]].sort((a, b) => b - a), 'far throws first');
  assert.equal(await tab.locator('tbody tr').count(), 3);
  assert.equal((await plots(tab)).length, 3);
  assert.deepEqual(wrong, []);
  await close();
});
