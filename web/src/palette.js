// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Colours that remain distinct with colour-vision deficiency: Okabe and Ito (2008).

export const dark = window.matchMedia('(prefers-color-scheme: dark)');

export const okabeIto = {
  blue: '#0072b2',
  orange: '#e69f00',
  green: '#009e73',
  vermillion: '#d55e00',
  sky: '#56b4e9',
  purple: '#cc79a7',
};

/** Paper is light whatever the screen is. */
export const isDark = () => dark.matches && !document.documentElement.classList.contains('print');

/** Lines on a dark ground need the light half of the palette first. */
export function series() {
  const c = okabeIto;
  return isDark()
    ? [c.sky, c.orange, c.green, c.purple, '#f0e442', c.vermillion]
    : [c.blue, c.vermillion, c.green, c.orange, c.purple, c.sky];
}

export const css = (name) => getComputedStyle(document.documentElement).getPropertyValue(name).trim();

/** What the 3-D view paints itself; robots and terrain keep the colours of their SDF. */
export const scenery = () =>
  dark.matches
    ? { zenith: 0x0b1422, horizon: 0x2a3a4c, ground: 0x2f3944, line: '#586a7d', minor: '#3c4956', sky: 0.5, room: 0.28, sun: 2.0, path: 0x56b4e9, pick: 0x3aa0e0 }
    : { zenith: 0x7fb0de, horizon: 0xe4edf5, ground: 0xc9d0d6, line: '#8f9ca8', minor: '#b4bdc6', sky: 0.55, room: 0.3, sun: 2.1, path: 0x0072b2, pick: 0x0072b2 };
