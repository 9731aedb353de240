// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// node live.test.mjs VSA NPM [CHROMIUM]: `vsa run … --view` and its page in a browser, with real clicks.
import assert from 'node:assert/strict';
import { spawn } from 'node:child_process';
import { existsSync, mkdtempSync, readFileSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { after, before, test } from 'node:test';
import { launch, visit } from './browser.mjs';

const vsa = process.argv[2];
const kLong = { timeout: 600_000 }; // half a minute each on an idle machine
const kUntil_ms = 120_000; // for one thing to happen in the page; on an idle machine each takes a second or two
let browser;
before(async () => {
  browser = await launch('--disable-gpu', '--enable-unsafe-swiftshader');
});
const children = [];
after(async () => {
  for (const child of children) child.kill('SIGKILL');
  await browser?.close();
});

/** Runs a world with its view; stop() ends it as Ctrl-C does and waits. */
async function run(world, ...more) {
  const directory = mkdtempSync(join(tmpdir(), 'vsa-live-'));
  const child = spawn(vsa, ['run', world, '--view', '--no-topics', '--view-records', directory, ...more], { stdio: ['ignore', 'pipe', 'pipe'] });
  children.push(child);
  let said = '';
  const url = await new Promise((resolve, reject) => {
    child.stderr.on('data', (text) => {
      said += text;
      const found = /live view: (http:\/\/127\.0\.0\.1:\d+\/)/.exec(said);
      if (found) resolve(found[1]);
    });
    child.on('exit', (code) => reject(new Error(`vsa ended with ${code}: ${said}`)));
  });
  const gone = new Promise((resolve) => child.on('exit', resolve));
  const stop = async () => {
    child.kill('SIGINT');
    const code = await gone;
    rmSync(directory, { recursive: true });
    return code;
  };
  const open = (context = {}) => visit(browser, url, (asked) => asked.startsWith(url), { viewport: { width: 1280, height: 760 }, ...context });
  return { url, directory, stop, open, child };
}

/** Until the page's own state satisfies `holds`, a check of window.vsaLive and `given`; after kUntil_ms it fails and tells that state. */
async function until(tab, holds, given) {
  let late;
  const silent = new Promise((_, reject) => {
    late = setTimeout(() => reject(new Error(`${holds}(${JSON.stringify(given)}): the page itself doesn't answer`)), 1.5 * kUntil_ms);
  });
  const missed = tab.evaluate(
    ([name, x, most_ms]) =>
      new Promise((resolve, reject) => {
        const first = (live) => live.run.actuators[0].data;
        const checks = {
          frames: (live, n) => live.frames >= n && live.state !== null,
          drawn: (live, n) => live.stage.renderer.info.render.frame > n,
          sent: (live) => Object.keys(live.commands.waiting).length === 0,
          paused: (live, on) => live.frame?.paused === on,
          angleAbove: (live, rad) => first(live).shaft_rad[0] > rad,
          commanded: (live, rad) => Math.abs(first(live).equilibrium_command_rad[0] - rad) < 0.02,
          stiffer: (live, than) => first(live).stiffness_Nm_per_rad[0] > than,
          timeAbove: (live, t) => live.frame?.time > t,
          timeBelow: (live, t) => live.frame?.time < t,
          touching: (live) => live.frame?.contacts.length > 0,
          curves: (live, n) => live.history.count > n,
          recording: (live, on) => live.frame?.recording === on && Boolean(live.state?.recordings.now) === on,
          recordings: (live, n) => live.state?.recordings.done.length === n,
          pulled: (live, link) => (link === null ? live.frame?.pulls.length === 0 : live.frame?.pulls.length === 7 && live.frame.pulls[0] === link),
          lifted: (live, [link, above]) => live.stage.groups[link].position.z > above,
          amplitude: (live, rad) => Math.abs(live.state?.gait?.groups[0].amplitude_rad - rad) < 1e-6,
          byHand: (live, i) => live.state?.by_hand[i][1] === true,
          gaitHeld: (live, on) => live.state?.gait?.playing === !on,
        };
        const state = ({ frame, state: told, stage, pulls, ...live }) => ({
          status: document.getElementById('status').textContent,
          frames: live.frames,
          frame: frame && { ...frame, contacts: frame.contacts.length / 6, pulls: [...frame.pulls] },
          state: told,
          held: pulls?.held,
          pictures: stage?.renderer.info.render.frame,
          a_second: live.fps,
          errors: live.errors,
        });
        const start = performance.now();
        const look = () => {
          try {
            if (checks[name](window.vsaLive, x)) resolve(null);
            else if (performance.now() - start > most_ms) resolve(state(window.vsaLive));
            else setTimeout(look, 20);
          } catch (error) {
            reject(error);
          }
        };
        look();
      }),
    [holds, given, kUntil_ms],
  );
  const left = await Promise.race([missed, silent]).finally(() => clearTimeout(late));
  if (left) throw new Error(`not ${holds}(${JSON.stringify(given)}) within ${kUntil_ms / 1000} s: ${JSON.stringify(left)}`);
}
/** Until the page has drawn what it has now: places worked out after it are those on the screen. */
const drawn = async (tab) =>
  until(
    tab,
    'drawn',
    await tab.evaluate(() => {
      const { stage } = window.vsaLive;
      stage.dirty = true;
      return stage.renderer.info.render.frame;
    }),
  );
const time = (tab) => tab.evaluate(() => window.vsaLive.frame.time);

/** Clicks a slider at a part of its length. */
async function slide(tab, id, part) {
  const box = await tab.locator(id).boundingBox();
  const thumb = 18;
  await tab.mouse.click(box.x + thumb / 2 + part * (box.width - thumb), box.y + box.height / 2);
}

test('a bench in the page', kLong, async (t) => {
  const bench = await run('bench_free');
  const { tab, wrong, close } = await bench.open();
  await until(tab, 'frames', 5);

  await t.test('runs in real time and says so', async () => {
    await tab.locator('#status', { hasText: 'running' }).waitFor();
    assert.equal(await tab.inputValue('#speed'), '1');
  });

  await t.test('a slider moves the joint and another makes it stiffer', async () => {
    await slide(tab, '#equilibrium', 0.65);
    await until(tab, 'angleAbove', 0.4);
    const soft = await tab.evaluate(() => window.vsaLive.run.actuators[0].data.stiffness_Nm_per_rad[0]);
    await slide(tab, '#preset', 0.95);
    await until(tab, 'stiffer', soft * 2);
  });

  await t.test('a number typed in is a command too, and never beyond the limits', async () => {
    await tab.fill('#equilibrium-number', '-20');
    await tab.press('#equilibrium-number', 'Enter');
    await until(tab, 'commanded', (-20 * Math.PI) / 180);
    await tab.fill('#equilibrium-number', '99999');
    await tab.press('#equilibrium-number', 'Enter');
    const limit = Number(await tab.getAttribute('#equilibrium', 'max'));
    await until(tab, 'commanded', (limit * Math.PI) / 180);
  });

  await t.test('pause stops time, a step moves it by one step, play goes on, reset begins anew', async () => {
    await tab.click('#play');
    await until(tab, 'paused', true);
    const stopped = await time(tab);
    await tab.click('#step');
    await until(tab, 'timeAbove', stopped);
    assert.ok(Math.abs((await time(tab)) - stopped - 0.001) < 1e-9);
    await tab.click('#reset');
    await until(tab, 'timeBelow', 0.0005);
    assert.deepEqual(await tab.evaluate(() => [window.vsaLive.frame.time, window.vsaLive.frame.paused]), [0, true]);
    await tab.focus('#canvas');
    await tab.keyboard.press('Space');
    await until(tab, 'timeAbove', 0.2);
  });

  await t.test('a second press undoes the first, also before a frame has shown it', async () => {
    await until(tab, 'paused', false);
    const from = await tab.evaluate(() => {
      for (let press = 0; press < 2; ++press) document.getElementById('play').click();
      return window.vsaLive.frame.time;
    });
    await until(tab, 'timeAbove', from + 0.5);
  });

  await t.test('the speed can be chosen', async () => {
    await tab.selectOption('#speed', '4');
    const from = await time(tab);
    await until(tab, 'timeAbove', from + 2);
    assert.equal(await tab.inputValue('#speed'), '4');
  });

  await t.test('the record button writes a replay page that can be fetched', async () => {
    await tab.click('#record');
    await until(tab, 'recording', true);
    const from = await time(tab);
    await until(tab, 'timeAbove', from + 0.5);
    await tab.click('#record');
    await until(tab, 'recordings', 1);
    assert.ok(existsSync(join(bench.directory, 'recording-001', 'energy.csv')));
    const [download] = await Promise.all([tab.waitForEvent('download'), tab.click('#recordings a')]);
    assert.equal(download.suggestedFilename(), 'recording-001.html');
    assert.equal(readFileSync(await download.path(), 'utf8'), readFileSync(join(bench.directory, 'recording-001', 'replay.html'), 'utf8'));
  });

  await t.test('two viewers see the same and what one does', async () => {
    await tab.click('#play');
    await until(tab, 'paused', true);
    const other = await bench.open({ viewport: { width: 390, height: 844 }, isMobile: true, hasTouch: true });
    await until(other.tab, 'paused', true);
    const stopped = await time(tab);
    await other.tab.click('#step');
    await until(tab, 'timeAbove', stopped);
    await tab.fill('#equilibrium-number', '10');
    await tab.press('#equilibrium-number', 'Enter');
    await until(tab, 'sent'); // with the next picture; a step asked for earlier would come too early
    await tab.click('#step');
    for (const page of [tab, other.tab]) await until(page, 'commanded', (10 * Math.PI) / 180);
    assert.ok((await other.tab.evaluate(() => document.documentElement.scrollWidth)) <= 390, 'a phone needs no scrolling sideways');
    assert.deepEqual(other.wrong, []);
    await other.close();
  });

  assert.deepEqual(await tab.evaluate(() => window.vsaLive.errors), []);
  assert.deepEqual(wrong, []);
  await close();
  assert.equal(await bench.stop(), 0);
});

test('a snake in the page', kLong, async (t) => {
  const snake = await run('snake_flat', '--gait', 'sidewind');
  const { tab, wrong, close } = await snake.open();
  await until(tab, 'frames', 5);

  await t.test('shows contacts and curves', async () => {
    await until(tab, 'touching');
    await tab.click('#tab-curves');
    assert.equal(await tab.locator('#curves figure').count(), 3);
    await tab.click('#signals button:has-text("Motor currents")');
    assert.equal(await tab.locator('#curves figure').count(), 4);
    await until(tab, 'curves', 2);
  });

  await t.test('edits the gait while the snake crawls', async () => {
    await tab.click('#tab-gait');
    const box = tab.locator('input[type="number"][aria-label*="Amplitude A"]').first();
    await box.fill('33');
    await box.press('Enter');
    await until(tab, 'amplitude', (33 * Math.PI) / 180);
  });

  await t.test('gives one joint to the hand and leaves the rest to the gait', async () => {
    await tab.click('#modules button:has-text("joint_5")');
    await slide(tab, '#preset', 0.2);
    await until(tab, 'byHand', 5);
    await tab.click('#tab-table');
    await tab.locator('.row', { hasText: 'joint_5' }).locator('.hand', { hasText: 'preset by hand' }).waitFor();
  });

  await t.test('a dragged link is pulled and let go', async () => {
    await tab.click('#tab-gait');
    await tab.click('#gait-play');
    await until(tab, 'gaitHeld', true);
    await tab.click('#follow');
    // Time stands while a place is looked for and pressed: what lies there can't have moved away.
    await tab.click('#play');
    await until(tab, 'paused', true);
    await drawn(tab);
    const at = await tab.evaluate(() => {
      const { stage, run } = window.vsaLive;
      const canvas = stage.canvas.getBoundingClientRect();
      for (const link of run.actuators.flatMap((a) => a.links)) {
        const place = stage.screen(link);
        const [x, y] = place ? [canvas.left + place.x, canvas.top + place.y] : [-1, -1];
        // Not hidden by another link, nor by a button over the picture.
        if (place && stage.pick(x, y) === link && document.elementFromPoint(x, y) === stage.canvas) return { link, x, y };
      }
      return null;
    });
    assert.ok(at, 'some link is in sight');
    await tab.mouse.move(at.x, at.y);
    await tab.mouse.down();
    const held = await tab.evaluate(() => {
      const { pulls, stage } = window.vsaLive;
      return pulls.held && { link: pulls.held.link, z: stage.groups[pulls.held.link].position.z };
    });
    assert.equal(held?.link, at.link, 'what was pressed is held');
    await tab.mouse.move(at.x, at.y - 60, { steps: 4 });
    await tab.mouse.move(at.x, Math.max(80, at.y - 260), { steps: 4 });
    await until(tab, 'pulled', held.link);
    await tab.keyboard.press('Space');
    await until(tab, 'paused', false);
    await until(tab, 'lifted', [held.link, held.z + 0.05]);
    await tab.mouse.up();
    await until(tab, 'pulled', null);
  });

  await t.test('the keyboard pulls too', async () => {
    const link = await tab.evaluate(() => window.vsaLive.modules.chosen.at(-1).links[0]);
    await tab.focus('#canvas');
    await tab.keyboard.down('Shift');
    await tab.keyboard.down('ArrowUp');
    await until(tab, 'pulled', link);
    await tab.keyboard.up('ArrowUp');
    await tab.keyboard.up('Shift');
    await until(tab, 'pulled', null);
  });

  await t.test('the picture gets coarser where it comes too slowly, and finer again when that has passed', async () => {
    const levels = await tab.evaluate(() => {
      const { stage } = window.vsaLive;
      stage.drawn = [];
      const after = (ms, pictures) => {
        for (let i = 0; i < pictures; ++i) stage.timed(ms);
        return stage.quality;
      };
      return [after(500, 120), after(20, 300), after(500, 30), after(20, 900)];
    });
    assert.deepEqual(levels, [3, 2, 3, 3], 'a level that was too much right away is not tried again');
  });

  await t.test('every control has a name and can be reached by the keyboard', async () => {
    const nameless = await tab.evaluate(() =>
      [...document.querySelectorAll('button, input, select, a')]
        .filter((e) => e.checkVisibility())
        .filter((e) => !(e.ariaLabel || e.textContent.trim() || e.title || e.labels?.length || document.querySelector(`label[for="${e.id}"]`)))
        .map((e) => e.outerHTML),
    );
    assert.deepEqual(nameless, []);
    const unreachable = await tab.evaluate(() =>
      [...document.querySelectorAll('button:not([role="tab"]), input, select')].filter((e) => e.checkVisibility() && e.tabIndex < 0).map((e) => e.id),
    );
    assert.deepEqual(unreachable, []);
  });

  assert.deepEqual(await tab.evaluate(() => window.vsaLive.errors), []);
  assert.deepEqual(wrong, []);
  await close();
  assert.equal(await snake.stop(), 0);
});

test('a page whose run has ended says so', kLong, async () => {
  const bench = await run('bench_free');
  const { tab, close } = await bench.open();
  await until(tab, 'frames', 2);
  await bench.stop();
  await tab.locator('#status', { hasText: /over|lost/ }).waitFor();
  await close();
});
