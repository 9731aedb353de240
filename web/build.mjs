// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// node build.mjs DIR: bundles src/ into the templates of three pages, each one file that needs no other: DIR/replay.html (with three.js
// and Plotly), DIR/live.html (with three.js and uPlot) and DIR/report.html (with Plotly). The packages' licence notices stay in the
// bundles.
import { readFileSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { build, transform } from 'esbuild';

const kMarker = '@VSA_PAGE_DATA@';
const kPages = [
  { name: 'replay', html: 'index.html', entry: 'main.js', styles: ['base.css', 'style.css'] },
  {
    name: 'live',
    html: 'live/index.html',
    entry: 'live/main.js',
    styles: ['base.css', 'style.css', '../node_modules/uplot/dist/uPlot.min.css', 'live/style.css'],
  },
  { name: 'report', html: 'report/index.html', entry: 'report/main.js', styles: ['base.css', 'report/style.css'] },
];

const out = process.argv[2];
if (!out) {
  console.error('usage: node build.mjs DIR');
  process.exit(2);
}
const path = (name) => join(import.meta.dirname ?? '.', 'src', name);
const source = (name) => readFileSync(path(name), 'utf8');

async function script(entry) {
  const bundle = await build({
    entryPoints: [path(entry)],
    bundle: true,
    minify: true,
    write: false,
    format: 'iife',
    target: 'es2020',
    legalComments: 'inline',
    logLevel: 'warning',
  });
  // Inside <script> only "</script" and "<!--" can end or change the element.
  return bundle.outputFiles[0].text.replaceAll('</script', '<\\/script').replaceAll('<!--', '<\\!--');
}
const style = async (names) => (await transform(names.map(source).join('\n'), { loader: 'css', minify: true })).code;

for (const page of kPages) {
  const fill = (html, place, text) => {
    if (html.split(place).length !== 2) throw new Error(`src/${page.html} must hold ${place} once`);
    return html.replace(place, () => text);
  };
  const html = fill(fill(source(page.html), '/*@STYLE@*/', await style(page.styles)), '/*@SCRIPT@*/', await script(page.entry));
  if (html.split(kMarker).length !== 2) throw new Error(`the page must hold ${kMarker} once`);
  writeFileSync(join(out, `${page.name}.html`), html);
}
