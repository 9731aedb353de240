// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// node report.test.mjs PAGES NPM [CHROMIUM]: the reports that test_report wrote, in a browser (browser.mjs).
import assert from 'node:assert/strict';
import { after, before, test } from 'node:test';
import { launch, open as openPage } from './browser.mjs';

let browser;
before(async () => {
  browser = await launch();
});
after(() => browser?.close());

const open = (name, context) => openPage(browser, name, 'report.html', context);
const pdf = async (tab) => (await tab.pdf({ preferCSSPageSize: true, printBackground: true })).toString('latin1');
const pagesOf = (text) => text.match(/\/Type \/Page\b/g).length;
/** As on paper; the page hears of it with the next frame. */
async function onPaper(tab, media) {
  await tab.emulateMedia({ media });
  await tab.evaluate(() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done))));
}
/** The lengths of what is drawn for the lines of a chart. */
const drawn = (tab, chart) =>
  tab.evaluate((i) => [...document.querySelectorAll('.plot')[i].querySelectorAll('.trace .js-line')].map((p) => p.getAttribute('d').length), chart);

test('a report', { timeout: 600_000 }, async (t) => {
  const { tab, wrong, close } = await open('report');

  await t.test('has one heading a section, in order', async () => {
    assert.equal(await tab.locator('h1').textContent(), 'Validation of qbmove_maker_pro_6_1');
    assert.deepEqual(await tab.locator('h2').allTextContents(), ['Summary', 'Curves', 'Notes']);
    assert.deepEqual(await tab.locator('nav a').allTextContents(), ['Summary', 'Curves', 'Notes']);
    assert.equal(await tab.title(), 'Validation of qbmove_maker_pro_6_1 – vsasim');
  });

  await t.test('has the table with heads and numbers to the right', async () => {
    assert.equal(await tab.locator('table caption').textContent(), 'RMS of deflection');
    assert.deepEqual(await tab.locator('thead th[scope=col]').allTextContents(), ['preset', 'ours', '2015 simulation', 'bound']);
    assert.deepEqual(await tab.locator('tbody th[scope=row]').allTextContents(), ['0 rad', '0.6903 rad', 'mean']);
    assert.equal(await tab.locator('tbody td.number').count(), 9);
  });

  await t.test('marks good and bad by more than colour', async () => {
    assert.deepEqual(await tab.locator('.figure .value').allTextContents(), [
      '✓0.0087 rad (within its bound)', '✗0.0146 rad (breaks its bound)', '2',
    ]);
  });

  await t.test('draws every curve, its errors, its band and the gap', async () => {
    const [lines, shapes] = await tab.evaluate(() => {
      const plot = document.querySelector('.plot');
      const d = (q) => [...plot.querySelectorAll(q)].map((p) => p.getAttribute('d') ?? '');
      const lined = [...plot.querySelectorAll('.js-line')].filter((p) => parseFloat(getComputedStyle(p).strokeWidth) > 0);
      return [lined.map((p) => p.getAttribute('d')), { fills: d('.js-fill').filter((x) => x).length, points: d('.points path').length, errors: d('.errorbar').length, errorPaths: d('.yerror').length }];
    });
    assert.equal(lines.length, 6, 'three lines, each of two strokes: before and after the gap');
    assert.ok(lines.every((d) => d.length > 50));
    assert.ok(shapes.fills >= 1, 'the band');
    assert.equal(shapes.points, 40, '41 points less the gap');
    assert.equal(shapes.errorPaths, 40);
    assert.ok((await drawn(tab, 1)).some((length) => length > 10), 'the second chart');
    assert.equal(await tab.evaluate(() => document.querySelectorAll('.plot')[1]._fullLayout.yaxis.type), 'log');
  });

  await t.test('labels its axes with units', async () => {
    assert.deepEqual(await tab.locator('.plot >> nth=0').locator('.xtitle, .ytitle').allTextContents(), ['deflection [rad]', 'load torque [N·m]']);
  });

  await t.test('gives a group one legend entry, which the keyboard switches', async () => {
    const keys = tab.locator('.keys').first().locator('button');
    assert.deepEqual(await keys.allTextContents(), ['hardware', 'simulation', '2015', 'points']);
    await keys.first().focus();
    await tab.keyboard.press('Enter');
    assert.equal(await keys.first().getAttribute('aria-pressed'), 'false');
    const shown = () => tab.evaluate(() => document.querySelector('.plot').data.filter((trace) => trace.visible).length);
    assert.equal(await shown(), 3, 'the line and its band are gone');
    assert.equal(await tab.evaluate(() => document.activeElement.textContent), 'hardware', 'the focus stays');
    await tab.keyboard.press('Enter');
    assert.equal(await shown(), 5);
  });

  await t.test('saves a chart’s numbers and its picture', async () => {
    const saved = async (name) => {
      const [download] = await Promise.all([tab.waitForEvent('download'), tab.locator('.tools').first().locator(`button:has-text("${name}")`).click()]);
      const chunks = [];
      for await (const chunk of await download.createReadStream()) chunks.push(chunk);
      return [download.suggestedFilename(), Buffer.concat(chunks).toString()];
    };
    const [csvName, csv] = await saved('CSV');
    assert.equal(csvName, 'torque_against_deflection.csv');
    const rows = csv.split('\n');
    assert.equal(rows[0], 'curve,group,deflection [rad],load torque [N·m],error');
    assert.equal(rows.length, 1 + 5 * 41 + 1);
    assert.match(rows[1], /^"hardware, rising",hardware,-0\.6,-1\.5,$/);
    const [svgName, svg] = await saved('SVG');
    assert.equal(svgName, 'torque_against_deflection.svg');
    assert.match(svg, /^<svg/);
  });

  await t.test('prints light, without what is only for the screen', async () => {
    const text = await pdf(tab);
    assert.ok(pagesOf(text) >= 1 && pagesOf(text) <= 2, `${pagesOf(text)} pages`);
    assert.equal(await tab.evaluate(() => document.documentElement.classList.contains('print')), false, 'and the screen is as before');
    await onPaper(tab, 'print');
    assert.equal(await tab.locator('.tools').first().isVisible(), false);
    await onPaper(tab, 'screen');
    assert.equal(await tab.locator('.tools').first().isVisible(), true);
  });

  assert.deepEqual(wrong, []);
  await close();
});

for (const name of ['sheet_short', 'sheet', 'sheet_long']) {
  test(`a data sheet prints on exactly one page: ${name}`, { timeout: 600_000 }, async () => {
    for (const context of [{}, { viewport: { width: 390, height: 844 }, isMobile: true }, { colorScheme: 'dark', viewport: { width: 1600, height: 900 } }]) {
      const { tab, wrong, close } = await open(name, context);
      const text = await pdf(tab);
      assert.equal(pagesOf(text), 1);
      assert.match(text, /\/MediaBox \[0 0 59[45][.\d]* 84[12][.\d]*\]/, 'A4');
      // What is on paper isn't cut: the laid-out page is no higher and no wider than the paper between the margins.
      await onPaper(tab, 'print');
      const size = await tab.evaluate(() => {
        const r = document.body.getBoundingClientRect();
        const parts = [...document.querySelectorAll('.card, .plot svg')].map((e) => e.getBoundingClientRect());
        return { width: r.width, height: r.height, right: Math.max(...parts.map((p) => p.right)) - r.left, plots: document.querySelectorAll('.js-line').length };
      });
      assert.ok(size.width <= 703.5 && size.right <= 703.5, `${size.width}, ${size.right} px wide`);
      assert.ok(size.height <= 1055, `${size.height} px high`);
      assert.ok(size.plots >= 16, 'the charts are there');
      assert.deepEqual(wrong, []);
      await close();
    }
  });
}

test('texts that a user wrote are text, not markup', { timeout: 600_000 }, async () => {
  const { tab, wrong, close } = await open('report_hostile');
  const evil = '</script><img src=x onerror="window.hacked=1"><a href="https://example.org">b</a>';
  assert.equal(await tab.evaluate(() => window.hacked), undefined);
  assert.equal(await tab.locator('img, main a, .plot a').count(), 0);
  for (const place of ['h1', '#subtitle', '#footer', '.text', 'caption', '.figure dt', 'tbody td', '.chart h3', '.keys button', '.xtitle', '.ytitle']) {
    assert.equal(await tab.locator(place).first().textContent(), evil, place);
  }
  assert.deepEqual(wrong, []);
  await close();
});

test('a gallery', { timeout: 600_000 }, async (t) => {
  const { tab, wrong, close } = await open('gallery', { viewport: { width: 1280, height: 900 } });
  const href = (place) => tab.locator(place).evaluateAll((links) => links.map((l) => l.getAttribute('href')));

  await t.test('leads to files beside it, from its head, its cards, its bars and the first cells of its table', async () => {
    assert.deepEqual(await href('#beside a'), ['./comparison.html']);
    assert.deepEqual(await href('.gallery h3 a'), ['./one.html', './two.html']);
    assert.deepEqual(await href('.bars dt a'), ['./one.html', './one.html']);
    assert.deepEqual(await href('tbody th a'), ['./one%20%26%20only.html']);
  });

  await t.test('draws all cards on the same decades, a line where there is no range', async () => {
    const cards = await tab.evaluate(() =>
      [...document.querySelectorAll('.gallery li')].map((li) => ({
        ticks: [...li.querySelectorAll('svg text')].map((e) => e.textContent).join(' '),
        high: li.querySelector('.between')?.getBBox().height ?? -1,
        edges: li.querySelectorAll('.edge').length,
      })));
    assert.equal(new Set(cards.map((c) => c.ticks)).size, 1);
    assert.match(cards[0].ticks, /^0\.01 0\.1 1 10 .*100.* load/);
    assert.ok(cards[0].high > 20, 'softest to stiffest');
    assert.equal(cards[1].high, 0);
    assert.deepEqual(cards.map((c) => c.edges), [2, 2, 0]);
  });

  await t.test('has bars as long as their numbers', async () => {
    const widths = await tab.evaluate(() => [...document.querySelectorAll('.bars')[0].querySelectorAll('.bar')].map((e) => e.getBoundingClientRect().width));
    assert.ok(widths[0] > 40);
    assert.ok(Math.abs(widths[1] / widths[0] - 0.5) < 0.01);
    assert.equal(widths[2], 0);
  });

  await t.test('has the ranges that a chart was given', async () => {
    const ranges = await tab.evaluate(() => ['xaxis', 'yaxis'].map((name) => document.querySelector('.plot')._fullLayout[name].range));
    assert.deepEqual(ranges, [[0, 2], [0, 5]]);
  });

  assert.ok(pagesOf(await pdf(tab)) <= 3);
  assert.deepEqual(wrong, []);
  await close();
  const evil = await open('gallery_hostile');
  assert.equal(await evil.tab.evaluate(() => window.hacked), undefined);
  assert.equal(await evil.tab.locator('img').count(), 0);
  assert.deepEqual(evil.wrong, []);
  await evil.close();
});

test('a report with nothing in it opens', { timeout: 600_000 }, async () => {
  const { tab, wrong, close } = await open('report_empty');
  assert.equal(await tab.locator('.plot .main-svg').count() > 0, true);
  assert.deepEqual(wrong, []);
  await close();
});

test('a phone shows it without scrolling sideways', { timeout: 600_000 }, async () => {
  for (const name of ['report', 'sheet', 'report_hostile', 'gallery']) {
    const { tab, wrong, close } = await open(name, { viewport: { width: 390, height: 844 }, isMobile: true, hasTouch: true });
    assert.ok((await tab.evaluate(() => document.documentElement.scrollWidth)) <= 390, name);
    assert.deepEqual(wrong, []);
    await close();
  }
});

test('light and dark have readable contrast', { timeout: 600_000 }, async () => {
  for (const colorScheme of ['light', 'dark']) {
    const { tab, close } = await open('report', { colorScheme });
    const ratios = await tab.evaluate(() => {
      const rgb = (text) => text.match(/[\d.]+/g).slice(0, 3).map(Number);
      const luminance = (c) => rgb(c).map((v) => (v / 255 <= 0.03928 ? v / 255 / 12.92 : ((v / 255 + 0.055) / 1.055) ** 2.4)).reduce((s, v, i) => s + v * [0.2126, 0.7152, 0.0722][i], 0);
      const ground = (e) => (!e ? 'rgb(255,255,255)' : /rgba\(.*, 0\)|transparent/.test(getComputedStyle(e).backgroundColor) ? ground(e.parentElement) : getComputedStyle(e).backgroundColor);
      const text = [...document.querySelectorAll('h1, h2, h3, #subtitle, p, th, td, dt, dd, button, footer, nav a')];
      const svg = [...document.querySelectorAll('.xtick text, .xtitle')].map((e) => [getComputedStyle(e).fill, ground(e.closest('.plot'))]);
      return [...text.map((e) => [getComputedStyle(e).color, ground(e)]), ...svg].map((pair) => {
        const [a, b] = pair.map(luminance);
        return (Math.max(a, b) + 0.05) / (Math.min(a, b) + 0.05);
      });
    });
    assert.ok(ratios.length > 40);
    assert.ok(Math.min(...ratios) >= 4.5, `${colorScheme}: ${Math.min(...ratios)}`);
    await close();
  }
});
