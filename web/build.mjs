// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// node build.mjs OUT.html: bundles src/ with three.js and Plotly into the replay page's template, one file that needs no other.
// The packages' licence notices stay in the bundle.
import { readFileSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { build, transform } from 'esbuild';

const kMarker = '@VSA_REPLAY_DATA@';
const out = process.argv[2];
if (!out) {
  console.error('usage: node build.mjs OUT.html');
  process.exit(2);
}
const source = (name) => readFileSync(join(import.meta.dirname ?? '.', 'src', name), 'utf8');

const bundle = await build({
  entryPoints: [join(import.meta.dirname ?? '.', 'src', 'main.js')],
  bundle: true,
  minify: true,
  write: false,
  format: 'iife',
  target: 'es2020',
  legalComments: 'inline',
  logLevel: 'warning',
});
// Inside <script> only "</script" and "<!--" can end or change the element.
const script = bundle.outputFiles[0].text.replaceAll('</script', '<\\/script').replaceAll('<!--', '<\\!--');
const style = (await transform(source('style.css'), { loader: 'css', minify: true })).code;

const fill = (html, place, text) => {
  if (html.split(place).length !== 2) throw new Error(`src/index.html must hold ${place} once`);
  return html.replace(place, () => text);
};
const html = fill(fill(source('index.html'), '/*@STYLE@*/', style), '/*@SCRIPT@*/', script);
if (html.split(kMarker).length !== 2) throw new Error(`the page must hold ${kMarker} once`);
writeFileSync(out, html);
