// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// node mcap.test.mjs VSA NPM: what `vsa run --record` wrote, opened with MCAP's own reader from the npm registry (@mcap/core), its
// messages checked against the schemas in the file and against Foxglove's published ones, its numbers against the CSV files.
import assert from 'node:assert/strict';
import { execFileSync, spawn } from 'node:child_process';
import { closeSync, existsSync, fstatSync, mkdtempSync, openSync, readFileSync, readSync, rmSync } from 'node:fs';
import { createRequire } from 'node:module';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { after, before, test } from 'node:test';

const [vsa, npm] = process.argv.slice(2);
const require = createRequire(join(npm, 'package.json'));
const { McapIndexedReader, McapStreamReader } = require('@mcap/core');
const published = require('@foxglove/schemas/jsonschema');
const Ajv = require('ajv').default;

const scratch = mkdtempSync(join(tmpdir(), 'vsa_mcap_'));
after(() => rmSync(scratch, { recursive: true }));

const run = (out, ...more) =>
  execFileSync(vsa, ['run', 'snake_flat', '--gait', 'sidewind', '--no-topics', '--record', join(scratch, out), ...more], { stdio: 'pipe' });

/** What the reader wants of a file: its size and pieces of it. */
class Readable {
  constructor(path) {
    this.file = openSync(path);
  }
  async size() {
    return BigInt(fstatSync(this.file).size);
  }
  async read(offset, length) {
    const bytes = new Uint8Array(Number(length));
    assert.equal(readSync(this.file, bytes, 0, bytes.length, Number(offset)), bytes.length);
    return bytes;
  }
  close() {
    closeSync(this.file);
  }
}

/** The lines of a CSV file as objects. */
function table(path) {
  const [head, ...lines] = readFileSync(path, 'utf8').trimEnd().split('\n');
  const names = head.split(',');
  return lines.map((line) => Object.fromEntries(line.split(',').map((cell, i) => [names[i], cell])));
}

const kNs = 1_000_000_000n;
const timeNs = (seconds) => BigInt(Math.round(Number(seconds) * 1e9));

test('a run of three seconds', { timeout: 600_000 }, async (t) => {
  run('out', '--duration-s', '3', '--fault', 'joint_6 noise_rad=0.001 seed=5');
  const readable = new Readable(join(scratch, 'out', 'run.mcap'));
  const reader = await McapIndexedReader.Initialize({ readable });
  const messages = [];
  for await (const m of reader.readMessages({ validateCrcs: true })) {
    const channel = reader.channelsById.get(m.channelId);
    messages.push({ ...m, topic: channel.topic, schema: reader.schemasById.get(channel.schemaId), json: JSON.parse(new TextDecoder().decode(m.data)) });
  }
  const on = (topic) => messages.filter((m) => m.topic === topic);
  const kTopics = {
    '/model/qbmove_snake/actuators': ['vsasim.ActuatorStates', 301],
    '/world/snake_flat/energy': ['vsasim.Energy', 301],
    '/world/snake_flat/links': ['foxglove.FrameTransforms', 301],
    '/world/snake_flat/static_links': ['foxglove.FrameTransforms', 1],
    '/world/snake_flat/shapes': ['foxglove.SceneUpdate', 1],
  };

  await t.test('has the topics, schemas and numbers of messages that the statistics promise', () => {
    assert.deepEqual(new Set([...reader.channelsById.values()].map((c) => c.topic)), new Set(Object.keys(kTopics)));
    for (const [topic, [schema, count]] of Object.entries(kTopics)) {
      assert.equal(on(topic).length, count, topic);
      assert.ok(on(topic).every((m) => m.schema.name === schema && m.schema.encoding === 'jsonschema'), topic);
    }
    assert.equal(reader.statistics.messageCount, BigInt(messages.length));
    assert.equal(reader.statistics.chunkCount, reader.chunkIndexes.length);
    assert.ok(reader.chunkIndexes.length > 1);
    for (const channel of reader.channelsById.values()) {
      assert.equal(channel.messageEncoding, 'json');
      assert.equal(reader.statistics.channelMessageCounts.get(channel.id), BigInt(on(channel.topic).length));
    }
  });

  await t.test('has simulated times, without gaps, from 0 to 3 s', () => {
    assert.equal(reader.statistics.messageStartTime, 0n);
    assert.equal(reader.statistics.messageEndTime, 3n * kNs);
    const states = on('/model/qbmove_snake/actuators');
    states.forEach((m, i) => {
      assert.equal(m.logTime, BigInt(i) * 10_000_000n);
      assert.equal(m.publishTime, m.logTime);
      assert.equal(m.sequence, i);
      assert.equal(timeNs(m.json.time_s), m.logTime);
    });
  });

  await t.test('finds an interval of one topic by its index', async () => {
    const found = [];
    for await (const m of reader.readMessages({ topics: ['/world/snake_flat/energy'], startTime: kNs, endTime: 2n * kNs })) found.push(m);
    assert.equal(found.length, 101);
  });

  await t.test('has messages that are valid by the schemas in the file', () => {
    const ajv = new Ajv({ strict: true, allowUnionTypes: false });
    const validators = new Map([...reader.schemasById.values()].map((s) => [s.id, ajv.compile(JSON.parse(new TextDecoder().decode(s.data)))]));
    for (const m of messages) {
      const valid = validators.get(m.schema.id);
      assert.ok(valid(m.json), `${m.topic}: ${ajv.errorsText(valid.errors)}`);
    }
    const spoilt = structuredClone(on('/model/qbmove_snake/actuators')[0].json);
    spoilt.actuators[0].shaft_rad = '0';
    assert.ok(!validators.get(on('/model/qbmove_snake/actuators')[0].schema.id)(spoilt), 'a text is not an angle');
  });

  await t.test("has poses and shapes that are valid by Foxglove's own schemas", () => {
    const ajv = new Ajv({ strict: false });
    for (const name of ['FrameTransforms', 'SceneUpdate']) {
      const valid = ajv.compile(published[name]);
      const known = (schema, path) => {
        // Nothing in a message that the published schema doesn't know, at any depth.
        if (Array.isArray(schema)) return schema.flatMap((item, i) => known(item, [...path, i]));
        return schema && typeof schema === 'object' ? Object.entries(schema).flatMap(([k, v]) => [[...path, k], ...known(v, [...path, k])]) : [];
      };
      const describes = (path) =>
        path.reduce((s, key) => s && (typeof key === 'number' ? s.items : s.properties?.[key]), published[name]) !== undefined;
      for (const m of messages.filter((one) => one.schema.name === `foxglove.${name}`)) {
        assert.ok(valid(m.json), ajv.errorsText(valid.errors));
        for (const path of known(m.json, [])) assert.ok(describes(path), `${name}: ${path.join('.')}`);
      }
    }
  });

  await t.test('holds the numbers of the CSV files', () => {
    const rows = table(join(scratch, 'out', 'qbmove_snake_actuators.csv'));
    const states = on('/model/qbmove_snake/actuators').flatMap((m) => m.json.actuators.map((a) => ({ ...a, time_s: m.json.time_s })));
    assert.equal(states.length, rows.length);
    rows.forEach((row, i) => {
      const a = states[i];
      assert.equal(a.name, row.actuator);
      for (const key of ['time_s', 'shaft_rad', 'shaft_speed_rad_per_s', 'equilibrium_command_rad', 'equilibrium_rad', 'deflection_rad',
        'stiffness_Nm_per_rad', 'torque_Nm']) assert.equal(a[key], Number(row[key]), key);
      assert.equal(a.preset_unit, 'rad');
      assert.deepEqual([a.preset_command, a.preset], [Number(row.preset_command_rad), Number(row.preset_rad)]);
      assert.deepEqual(a.motor_rad, [Number(row.motor_1_rad), Number(row.motor_2_rad)]);
      assert.deepEqual(a.current_A, [Number(row.current_1_A), Number(row.current_2_A)]);
    });
    const energy = table(join(scratch, 'out', 'energy.csv'));
    on('/world/snake_flat/energy').forEach((m, i) => {
      assert.deepEqual(m.json, Object.fromEntries(Object.entries(energy[i]).map(([k, v]) => [k, Number(v)])));
    });
    const links = table(join(scratch, 'out', 'links.csv'));
    const transforms = on('/world/snake_flat/links').flatMap((m) => m.json.transforms);
    assert.equal(transforms.length, links.length);
    links.forEach((row, i) => {
      const { translation: p, rotation: q, ...rest } = transforms[i];
      assert.deepEqual([rest.child_frame_id, rest.parent_frame_id], [row.link, 'world']);
      assert.deepEqual([p.x, p.y, p.z, q.w, q.x, q.y, q.z], ['x_m', 'y_m', 'z_m', 'qw', 'qx', 'qy', 'qz'].map((k) => Number(row[k])));
      assert.equal(BigInt(rest.timestamp.sec) * kNs + BigInt(rest.timestamp.nsec), timeNs(row.time_s));
    });
  });

  await t.test('draws every link in a frame that has a transform', () => {
    const frames = new Set(messages.filter((m) => m.schema.name === 'foxglove.FrameTransforms').flatMap((m) => m.json.transforms.map((x) => x.child_frame_id)));
    const { entities } = on('/world/snake_flat/shapes')[0].json;
    assert.ok(entities.length > 12);
    for (const e of entities) assert.ok(frames.has(e.frame_id), e.frame_id);
  });

  await t.test('tells world, step, version, and faults with their seeds', async () => {
    const found = [];
    for await (const m of reader.readMetadata()) found.push(m);
    assert.deepEqual(found.map((m) => m.name), ['vsasim.run']);
    const { version, ...rest } = Object.fromEntries(found[0].metadata);
    assert.equal(`vsa ${version}`, execFileSync(vsa, ['--version'], { encoding: 'utf8' }).trim());
    assert.deepEqual(rest, { world: 'snake_flat', step_s: '0.001', rate_Hz: '100', faults: 'joint_6 noise_rad=0.001 seed=5' });
    assert.equal(reader.header.library, `vsasim ${version}`);
  });
  readable.close();
});

test('two equal runs give equal bytes', { timeout: 600_000 }, () => {
  run('a', '--duration-s', '0.5');
  run('b', '--duration-s', '0.5');
  assert.ok(readFileSync(join(scratch, 'a', 'run.mcap')).equals(readFileSync(join(scratch, 'b', 'run.mcap'))));
});

/** Reads from front to back, as a recovery does. */
function streamed(path) {
  const reader = new McapStreamReader({ validateCrcs: true });
  reader.append(readFileSync(path));
  const seen = {};
  for (let r; (r = reader.nextRecord()); ) seen[r.type] = (seen[r.type] ?? 0) + 1;
  return { Message: 0, ...seen, done: reader.done() };
}

/** Runs, sends the signal once two seconds are in the file, and waits for the end. */
async function signalled(out, signal) {
  const path = join(scratch, out, 'run.mcap');
  const more = ['--no-topics', '--duration-s', '600', '--record', join(scratch, out)];
  const child = spawn(vsa, ['run', 'snake_flat', '--gait', 'sidewind', ...more], { stdio: 'ignore' });
  const ended = new Promise((resolve) => child.once('exit', (code, by) => resolve(by ?? code)));
  try {
    while (!(existsSync(path) && streamed(path).Message > 600)) {
      assert.equal(child.exitCode, null, 'the run ended by itself');
      await new Promise((resolve) => setTimeout(resolve, 50));
    }
  } finally {
    child.kill(signal);
  }
  return { path, how: await ended };
}

test('a run that Ctrl-C ends is whole', { timeout: 600_000 }, async () => {
  const { path, how } = await signalled('interrupted', 'SIGINT');
  assert.equal(how, 130);
  const readable = new Readable(path);
  const reader = await McapIndexedReader.Initialize({ readable });
  readable.close();
  assert.equal(reader.statistics.messageCount, BigInt(streamed(path).Message));
});

test('of a run that was killed a reader finds every whole chunk', { timeout: 600_000 }, async () => {
  const { path, how } = await signalled('killed', 'SIGKILL');
  assert.equal(how, 'SIGKILL');
  const readable = new Readable(path);
  await assert.rejects(McapIndexedReader.Initialize({ readable }), /magic/i);
  readable.close();
  const seen = streamed(path);
  assert.ok(seen.Message > 600, JSON.stringify(seen));
  assert.ok(!seen.DataEnd && !seen.done);
});
