// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Screen and paper. For printing the page is laid out at the paper's width in the light colours before the browser takes it; a data
// sheet's charts share what height its text leaves, and what is still too long is scaled down, so that it is always one page.

const kMillimetre = 96 / 25.4;
const kWidth = 186 * kMillimetre; // A4 less the margins of @page (style.css)
const kHeight = 279 * kMillimetre;
const kSheetFrom = 800; // px: a screen of that width shows the sheet as it prints
const kPadding = 24; // px, of the sheet on a screen (style.css)
const kChart = { min: 125, max: 330 }; // px, a sheet's plots

const root = document.documentElement;
const printing = () => root.classList.contains('print');

const heightNow = () => document.body.getBoundingClientRect().height;

/** Gives the plots of a data sheet the height that fills its page; returns what is used then. */
function shareHeight(height, scale = 1) {
  const rows = new Set([...document.querySelectorAll('.plot')].map((p) => Math.round(p.getBoundingClientRect().top))).size;
  const set = (px) => root.style.setProperty('--plot-height', `${px}px`);
  set(kChart.min);
  if (rows) set(Math.floor(Math.max(kChart.min, Math.min(kChart.max, kChart.min + (height - heightNow()) / rows / scale))));
  return heightNow();
}

/** Scaled-down text takes a wider layout, which is shorter: a few rounds find the scale. The screen shows the page unscaled. */
function fitOnePage() {
  const onScreen = !printing();
  root.classList.add('print');
  let scale = 1;
  for (let round = 0; round < 8; ++round) {
    document.body.style.width = `${kWidth / scale}px`;
    document.body.style.zoom = scale;
    const used = shareHeight(kHeight, scale);
    if (used <= kHeight) break;
    scale *= Math.max(0.5, 0.99 * (kHeight / used));
  }
  root.classList.toggle('print', !onScreen);
  if (onScreen) document.body.style.width = `${kWidth / scale + 2 * kPadding}px`;
  return scale;
}

/** `prepare` makes what takes room beside the plots, `draw` fills the plots. */
export function keepFitting({ onePage, prepare, draw }) {
  const layOut = () => {
    document.body.style.zoom = '';
    document.body.style.width = printing() ? `${kWidth}px` : '';
    root.style.removeProperty('--plot-height');
    const sheet = onePage && (printing() || window.innerWidth >= kSheetFrom);
    root.classList.toggle('sheet', sheet);
    prepare();
    const scale = sheet ? fitOnePage() : 1;
    document.body.style.zoom = ''; // Plotly measures its texts wrongly in a scaled page
    draw();
    if (printing()) document.body.style.zoom = scale === 1 ? '' : scale;
  };
  const paper = (on) => {
    if (printing() === on) return;
    root.classList.toggle('print', on);
    layOut();
  };
  window.addEventListener('beforeprint', () => paper(true));
  window.addEventListener('afterprint', () => paper(false));
  window.matchMedia('print').addEventListener('change', (e) => paper(e.matches));
  let width = window.innerWidth;
  window.addEventListener('resize', () => {
    if (printing() || window.innerWidth === width) return;
    width = window.innerWidth;
    layOut();
  });
  layOut();
}
