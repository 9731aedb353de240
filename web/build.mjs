// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// node build.mjs DIR: bundles src/ into the templates of three pages, each one file that needs no other: DIR/replay.html (with three.js
// and Plotly), DIR/live.html (with three.js and uPlot) and DIR/report.html (with Plotly). Each holds the licence texts of what is bundled
// in it, in a block that no browser runs; DIR/bundled.json tells the packages with their versions.
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

/** A block of text in a page: only "</script" and "<!--" could end or change the element. */
const block = (text) => text.replaceAll('</script', '<\\/script').replaceAll('<!--', '<\\!--');

/** What esbuild took of node_modules, by package. */
function packages(files) {
  const names = new Set();
  for (const file of files) {
    const found = /(?:^|\/)node_modules\/((?:@[^/]+\/)?[^/]+)\//.exec(file);
    if (found) names.add(found[1]);
  }
  return [...names].sort().map((name) => {
    const folder = join(path('..'), 'node_modules', name);
    const { version, license } = JSON.parse(readFileSync(join(folder, 'package.json'), 'utf8'));
    return { name, version, license, text: readFileSync(join(folder, 'LICENSE'), 'utf8').trim() };
  });
}

async function script(entry) {
  const bundle = await build({
    entryPoints: [path(entry)],
    bundle: true,
    minify: true,
    write: false,
    format: 'iife',
    target: 'es2020',
    legalComments: 'inline',
    metafile: true,
    logLevel: 'warning',
  });
  return { text: block(bundle.outputFiles[0].text), files: Object.keys(bundle.metafile.inputs) };
}
const style = async (names) => (await transform(names.map(source).join('\n'), { loader: 'css', minify: true })).code;

const bundled = {};
for (const page of kPages) {
  const fill = (html, place, text) => {
    if (html.split(place).length !== 2) throw new Error(`src/${page.html} must hold ${place} once`);
    return html.replace(place, () => text);
  };
  const code = await script(page.entry);
  const inside = packages([...code.files, ...page.styles]);
  const licences = inside.map((p) => `${p.name} ${p.version} (${p.license})\n\n${p.text}\n`).join('\n\n');
  const notice = `<script type="text/plain" id="licences">\nThis page holds code of\n\n${block(licences)}</script>\n</head>`;
  const html = [
    ['/*@STYLE@*/', await style(page.styles)],
    ['</head>', notice],
    ['/*@SCRIPT@*/', code.text],
  ].reduce((text, [place, filling]) => fill(text, place, filling), source(page.html));
  if (html.split(kMarker).length !== 2) throw new Error(`the page must hold ${kMarker} once`);
  writeFileSync(join(out, `${page.name}.html`), html);
  bundled[`${page.name}.html`] = inside.map(({ name, version, license }) => ({ name, version, license }));
}
writeFileSync(join(out, 'bundled.json'), `${JSON.stringify(bundled, null, 2)}\n`);
