// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Saves what a chart shows as a file, without any server.

export const slug = (text) => text.normalize('NFKD').replace(/[^\w]+/g, '_').replace(/^_+|_+$/g, '').slice(0, 60).toLowerCase() || 'chart';

const quoted = (text) => (/[",\n\r]/.test(text) ? `"${text.replaceAll('"', '""')}"` : text);

/** One row a point: curve, group, x, y, error. */
export function tableText({ curves, x_label, y_label }) {
  const rows = [['curve', 'group', x_label, y_label, 'error'].map(quoted)];
  for (const c of curves) {
    c.x.forEach((x, i) => rows.push([quoted(c.name), quoted(c.group), x ?? '', c.y[i] ?? '', c.error[i] ?? '']));
  }
  return rows.map((r) => r.join(',')).join('\n') + '\n';
}

export function save(name, type, text) {
  const link = document.createElement('a');
  link.href = URL.createObjectURL(new Blob([text], { type }));
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 1000);
}
