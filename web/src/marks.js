// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Small parts that both pages are made of.

export const element = (tag, className, text) => {
  const e = document.createElement(tag);
  if (className) e.className = className;
  if (text !== undefined) e.textContent = text;
  return e;
};

/** A piece of the line as it stands in the plot, for a legend. */
export function dashSample(dash, color) {
  const ns = 'http://www.w3.org/2000/svg';
  const svg = document.createElementNS(ns, 'svg');
  svg.setAttribute('viewBox', '0 0 18 6');
  svg.setAttribute('aria-hidden', 'true');
  const line = document.createElementNS(ns, 'path');
  line.setAttribute('d', 'M0 3h18');
  line.setAttribute('stroke', color);
  line.setAttribute('stroke-width', '2.4');
  line.setAttribute('stroke-dasharray', { dash: '5 3', dot: '2 2.4', dashdot: '6 2 2 2' }[dash] ?? 'none');
  svg.append(line);
  return svg;
}
