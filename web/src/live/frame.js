// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// One frame as the server sends it (include/vsa/view/frame.hpp). A frame writes into the arrays of the page's run, which holds one
// moment: the newest.

const kHeader = 28;
export const kContact = 6;
export const kPull = 7;

/** Writes poses, readings and energy into `run`; returns the rest, or null where the sizes don't fit the run. */
export function readFrame(buffer, run) {
  if (buffer.byteLength < kHeader) return null;
  const view = new DataView(buffer);
  const u32 = (at) => view.getUint32(at, true);
  const flags = u32(16);
  const sizes = [run.poses.length, run.readings.length, run.energyValues.length, kContact * u32(20), kPull * u32(24)];
  if (buffer.byteLength !== kHeader + 4 * sizes.reduce((a, b) => a + b, 0)) return null;
  let at = kHeader;
  const fill = (out) => {
    for (let i = 0; i < out.length; ++i, at += 4) out[i] = view.getFloat32(at, true);
    return out;
  };
  for (const array of [run.poses, run.readings, run.energyValues]) fill(array);
  return {
    missed: u32(0),
    time: view.getFloat64(4, true),
    factor: view.getFloat32(12, true),
    paused: (flags & 1) !== 0,
    recording: (flags & 2) !== 0,
    gait: (flags & 4) !== 0,
    contacts: fill(new Float32Array(sizes[3])),
    pulls: fill(new Float32Array(sizes[4])),
  };
}
