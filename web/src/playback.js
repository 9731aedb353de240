// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0

/** The replay's clock: simulated time, advanced by the wall clock while it plays. Tells listeners after each change. */
export class Playback {
  constructor(start, end) {
    this.start = start;
    this.end = end;
    this.time = start;
    this.playing = false;
    this.speed = 1;
    this.loop = true;
    this.listeners = [];
  }

  onChange(listener) {
    this.listeners.push(listener);
  }

  changed() {
    for (const listener of this.listeners) listener(this);
  }

  get duration() {
    return this.end - this.start;
  }

  seek(time) {
    if (!Number.isFinite(time)) return;
    this.time = Math.min(this.end, Math.max(this.start, time));
    this.changed();
  }

  play() {
    if (this.duration <= 0) return;
    if (this.time >= this.end) this.time = this.start;
    this.playing = true;
    this.changed();
  }

  pause() {
    this.playing = false;
    this.changed();
  }

  toggle() {
    if (this.playing) this.pause();
    else this.play();
  }

  /** Wall time that has passed, s. A browser's clock may be set back (a picture's time lies before its frame's, too): no time, then. */
  advance(seconds) {
    if (!this.playing) return;
    this.time += Math.max(0, seconds) * this.speed;
    if (this.time >= this.end) {
      if (this.loop) {
        this.time = this.start + ((this.time - this.start) % this.duration);
      } else {
        this.time = this.end;
        this.playing = false;
      }
    }
    this.changed();
  }
}
