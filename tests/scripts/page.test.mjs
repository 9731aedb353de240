// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// node page.test.mjs PAGES NPM [CHROMIUM]: the replay pages that test_record wrote, in a browser (browser.mjs).
import assert from 'node:assert/strict';
import { after, before, test } from 'node:test';
import { launch, open as openPage } from './browser.mjs';

const kWebGl = ['--disable-gpu', '--enable-unsafe-swiftshader'];

const kUntil_ms = 120_000;
let browser;
before(async () => {
  browser = await launch(...kWebGl);
});
after(() => browser?.close());

/** Opens a page paused at its start. */
const open = (name, { from = browser, ...context } = {}) => openPage(from, name, 'replay.html', context);

/** The 3-D picture as it is now, small: its pixels' colours. */
const picture = (tab) =>
  tab.evaluate(() => {
    const small = document.createElement('canvas');
    small.width = small.height = 96;
    const { stage } = window.vsaReplay;
    stage.dirty = true;
    stage.render(); // read in the same task, before the browser clears the buffer
    const g = small.getContext('2d');
    g.drawImage(stage.canvas, 0, 0, 96, 96);
    return [...new Uint32Array(g.getImageData(0, 0, 96, 96).data.buffer)];
  });
const time = (tab) => tab.evaluate(() => window.vsaReplay.playback.time);
/** Until the replay plays past t. (The page's policy forbids eval, which playwright's own waiting needs.) */
async function reaches(tab, t) {
  const late = await tab.evaluate(
    ([goal, most_ms]) =>
      new Promise((resolve) => {
        const { playback } = window.vsaReplay;
        const start = performance.now();
        const look = () => {
          if (playback.time > goal) resolve(null);
          else if (performance.now() - start > most_ms) resolve({ time: playback.time, playing: playback.playing });
          else setTimeout(look, 20);
        };
        look();
      }),
    [t, kUntil_ms],
  );
  assert.equal(late, null, `not past ${t} s of the replay within ${kUntil_ms / 1000} s: ${JSON.stringify(late)}`);
}
const differing = (a, b) => a.filter((v, i) => v !== b[i]).length;

test('the page of a snake', { timeout: 600_000 }, async (t) => {
  const { tab, wrong, close } = await open('snake');

  await t.test('shows a picture that is not blank', async () => {
    const colors = new Set(await picture(tab));
    assert.ok(colors.size > 100, `${colors.size} colours`);
  });

  await t.test('shows title and summary as the caller gave them', async () => {
    assert.equal(await tab.textContent('#title'), '12-module snake');
    assert.deepEqual(await tab.locator('#summary div').allTextContents(), [
      'Distance4.02 m', 'Duration20 s', 'Energy from the supply182 J', 'Real-time factor18.4',
    ]);
  });

  await t.test('plays: time goes on and the picture with it', async () => {
    await tab.evaluate(() => window.vsaReplay.playback.seek(2));
    const start = await picture(tab);
    await tab.click('#play');
    await reaches(tab, 2.4);
    await tab.click('#play');
    const stopped = await time(tab);
    assert.ok(differing(start, await picture(tab)) > 50);
    assert.equal(await time(tab), stopped, 'paused means paused');
  });

  await t.test('a clock that goes back takes the replay nowhere, least of all before its start', async () => {
    const times = await tab.evaluate(() => {
      const { playback } = window.vsaReplay;
      const after = (start) => {
        playback.seek(start);
        playback.playing = true;
        playback.advance(-5.63);
        playback.pause();
        return playback.time;
      };
      return [after(0), after(3)];
    });
    assert.deepEqual(times, [0, 3]);
  });

  await t.test('scrubbing sets pose and picture, between frames by interpolation', async () => {
    await tab.fill('#scrub', '3');
    const at3 = await picture(tab);
    await tab.fill('#scrub', '12.01');
    assert.ok(Math.abs((await time(tab)) - 12.01) < 1e-9);
    assert.ok(differing(at3, await picture(tab)) > 50);
    const { shown, between } = await tab.evaluate(() => {
      const { run, stage } = window.vsaReplay;
      const width = run.moving.length * 7;
      const frame = run.time.findIndex((x) => x > 12.01) - 1;
      const x = (f) => run.poses[f * width];
      const part = (12.01 - run.time[frame]) / (run.time[frame + 1] - run.time[frame]);
      return { shown: stage.groups[run.moving[0]].position.x, between: x(frame) + (x(frame + 1) - x(frame)) * part };
    });
    assert.ok(Math.abs(shown - between) < 1e-6, `${shown} against ${between}`);
    assert.match(await tab.textContent('#clock'), /12\.01 s \/ 20\.00 s/);
  });

  await t.test('choosing a module in the list changes the curves', async () => {
    const curve = () => tab.evaluate(() => Array.from(window.vsaReplay.curves.panels[0].plot.data[0].y.slice(0, 50)));
    const first = await curve();
    await tab.click('button:has-text("joint_4")');
    const fourth = await curve();
    assert.notDeepEqual(first, fourth);
    const recorded = await tab.evaluate(() => Array.from(window.vsaReplay.run.actuators[3].data.shaft_rad.slice(0, 50)));
    fourth.forEach((y, i) => assert.ok(Math.abs(y - (recorded[i] * 180) / Math.PI) < 1e-9));
    assert.equal(await tab.getAttribute('button:has-text("joint_4")', 'aria-pressed'), 'true');
  });

  await t.test('clicking a module in the picture chooses it', async () => {
    await tab.evaluate(() => {
      window.vsaReplay.playback.seek(0);
      window.vsaReplay.stage.resetView();
      window.vsaReplay.stage.render();
    });
    const at = await tab.evaluate(() => {
      const { stage, run } = window.vsaReplay;
      const p = stage.screen(run.actuators[9].links[0]);
      const r = stage.canvas.getBoundingClientRect();
      return { x: r.left + p.x, y: r.top + p.y };
    });
    await tab.mouse.click(at.x, at.y);
    assert.deepEqual(await tab.evaluate(() => window.vsaReplay.modules.chosen.map((a) => a.name)), ['joint_10']);
  });

  await t.test('comparing shows several modules at once', async () => {
    await tab.click('button:has-text("joint_2") >> nth=0', { modifiers: ['Shift'] });
    assert.equal(await tab.evaluate(() => window.vsaReplay.curves.panels[2].plot.data.length), 2);
    await tab.click('#show-energy');
    assert.equal(await tab.locator('figure').first().locator('h3').textContent(), 'From the supply J');
    await tab.click('#show-modules');
  });

  await t.test('a click in a curve goes to that time', async () => {
    const plot = await tab.locator('.plot').first().boundingBox();
    const axis = await tab.evaluate(() => {
      const { _offset, _length } = window.vsaReplay.curves.panels[0].plot._fullLayout.xaxis;
      return { _offset, _length };
    });
    await tab.mouse.click(plot.x + axis._offset + axis._length / 4, plot.y + 50);
    assert.ok(Math.abs((await time(tab)) - 5) < 0.1, String(await time(tab)));
  });

  await t.test('the keyboard plays, steps and jumps', async () => {
    await tab.focus('#canvas');
    await tab.keyboard.press('End');
    assert.ok(Math.abs((await time(tab)) - 20) < 1e-5);
    await tab.keyboard.press('ArrowLeft');
    assert.ok(Math.abs((await time(tab)) - 19.9) < 1e-5);
    await tab.keyboard.press('Home');
    assert.equal(await time(tab), 0);
    await tab.keyboard.press('Space');
    await reaches(tab, 0.1);
    await tab.keyboard.press('Space');
    assert.equal(await tab.getAttribute('#play', 'aria-label'), 'Play');
  });

  assert.deepEqual(wrong, []);
  await close();
});

test('names that a user wrote are text, not markup', { timeout: 600_000 }, async () => {
  const { tab, wrong, close } = await open('hostile');
  assert.equal(await tab.evaluate(() => window.hacked), undefined);
  assert.equal(await tab.locator('img').count(), 0);
  assert.match(await tab.textContent('#title'), /^<\/script><img src=x/);
  assert.deepEqual(wrong, []);
  await close();
});

test('a world without actuators and with one frame opens', { timeout: 600_000 }, async () => {
  const { tab, wrong, close } = await open('bare');
  assert.equal(await tab.locator('figure').first().locator('h3').textContent(), 'From the supply J');
  await tab.click('#play');
  assert.equal(await time(tab), 0);
  assert.deepEqual(wrong, []);
  await close();
});

test('a phone shows it without scrolling sideways', { timeout: 600_000 }, async () => {
  const { tab, wrong, close } = await open('snake', { viewport: { width: 390, height: 844 }, isMobile: true, hasTouch: true });
  assert.ok((await tab.evaluate(() => document.documentElement.scrollWidth)) <= 390);
  const [view, panel] = [await tab.locator('.stage').boundingBox(), await tab.locator('.panel').boundingBox()];
  assert.ok(panel.y >= view.y + view.height, 'curves stand under the picture');
  assert.ok(view.width <= 390 && panel.width <= 390);
  assert.deepEqual(wrong, []);
  await close();
});

test('without WebGL it says so and the curves still work', { timeout: 600_000 }, async () => {
  const plain = await launch('--disable-3d-apis');
  try {
    const { tab, wrong } = await open('snake', { from: plain });
    assert.match(await tab.textContent('#view-message'), /no WebGL/);
    assert.ok(await tab.isVisible('#view-message'));
    await tab.fill('#scrub', '7');
    const shown = await tab.locator('.keys b').first().textContent();
    const recorded = await tab.evaluate(() => {
      const { run } = window.vsaReplay;
      return (run.actuators[0].data.shaft_rad[run.time.findIndex((x) => x >= 6.9999)] * 180) / Math.PI;
    });
    assert.ok(Math.abs(Number(shown.replace('−', '-')) - recorded) < 0.06, `${shown} against ${recorded}`);
    assert.deepEqual(wrong, []);
  } finally {
    await plain.close();
  }
});
