// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// The path of the robot's centre on the ground: strong up to now, faint ahead.
import * as THREE from 'three';
import { Line2 } from 'three/examples/jsm/lines/Line2.js';
import { LineGeometry } from 'three/examples/jsm/lines/LineGeometry.js';
import { LineMaterial } from 'three/examples/jsm/lines/LineMaterial.js';
import { scenery } from './palette.js';

const kPointsMax = 2000;

export class Trace {
  /** `half`: how high a resting link's origin is above the ground, m. */
  constructor(run, path, half) {
    this.stride = Math.max(1, Math.ceil(run.frames / kPointsMax));
    const points = [];
    const near = Math.max(1, Math.round(run.frames / Math.max(1, run.end - run.start) / 2));
    for (let f = 0; f < run.frames; f += this.stride) {
      // The ground under the robot: its lowest link within half a second.
      let low = Infinity;
      for (let k = Math.max(0, f - near); k <= Math.min(run.frames - 1, f + near); ++k) low = Math.min(low, path.low[k]);
      points.push(path.xyz[3 * f], path.xyz[3 * f + 1], low - half + 0.004);
    }
    this.group = new THREE.Group();
    this.count = points.length / 3;
    if (this.count < 2) return;
    this.past = this.line(points, 3.5, 0.95);
    this.ahead = this.line(points, 2, 0.28);
    this.group.add(this.ahead, this.past);
  }

  line(points, width, opacity) {
    const material = new LineMaterial({ linewidth: width, transparent: true, opacity, depthWrite: false });
    const line = new Line2(new LineGeometry().setPositions(points), material);
    line.frustumCulled = false;
    return line;
  }

  paint() {
    for (const line of [this.past, this.ahead]) line?.material.color.setHex(scenery().path);
  }

  resize(width, height) {
    for (const line of [this.past, this.ahead]) line?.material.resolution.set(width, height);
  }

  show(at) {
    if (!this.past) return;
    const done = Math.round((at.frame + at.part) / this.stride);
    this.past.geometry.instanceCount = Math.min(this.count - 1, done);
    this.past.visible = done > 0;
  }
}
