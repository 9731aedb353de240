// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// What the frames have shown lately: a ring of all readings and energies.

export class History {
  constructor(run, seconds, rate) {
    this.run = run;
    this.width = run.readings.length + run.energyValues.length;
    this.capacity = Math.ceil(seconds * rate);
    this.time = new Float64Array(this.capacity);
    this.values = new Float32Array(this.capacity * this.width);
    this.clear();
  }

  clear() {
    this.count = 0;
    this.next = 0;
  }

  get last() {
    return this.count ? this.time[(this.next + this.capacity - 1) % this.capacity] : 0;
  }

  add(time) {
    if (this.count && time === this.last) return; // paused
    if (this.count && time < this.last) this.clear(); // reset
    const at = this.next * this.width;
    this.time[this.next] = time;
    this.values.set(this.run.readings, at);
    this.values.set(this.run.energyValues, at + this.run.readings.length);
    this.next = (this.next + 1) % this.capacity;
    this.count = Math.min(this.capacity, this.count + 1);
  }

  /** Which column of the ring a channel (a view of the run's arrays) is. */
  column(channel) {
    const index = channel.byteOffset / 4;
    return channel.buffer === this.run.readings.buffer ? index : index + this.run.readings.length;
  }

  /** [times, values…] of these columns since `from`, scaled: what uPlot draws. */
  since(from, columns, scale) {
    const out = [[], ...columns.map(() => [])];
    for (let i = 0; i < this.count; ++i) {
      const row = (this.next + this.capacity - this.count + i) % this.capacity;
      if (this.time[row] < from) continue;
      out[0].push(this.time[row]);
      for (let c = 0; c < columns.length; ++c) out[c + 1].push(this.values[row * this.width + columns[c]] * scale);
    }
    return out;
  }
}
