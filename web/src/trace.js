// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// The path of the robot's centre on the ground: strong up to now, faint ahead.
import * as THREE from 'three';
import { Line2 } from 'three/examples/jsm/lines/Line2.js';
import { LineGeometry } from 'three/examples/jsm/lines/LineGeometry.js';
import { LineMaterial } from 'three/examples/jsm/lines/LineMaterial.js';
import { scenery } from './palette.js';

const kPointsMax = 2000;
const kTestsMax = 1e7; // of a ray against a triangle, while the ground's height is looked up
const kAbove = 0.004; // m over the ground

/** Height of the ground under some of the points, from the still bodies' triangles; null where there is none. */
function groundUnder(points, still) {
  still.forEach((group) => group.updateMatrixWorld(true));
  const meshes = still.flatMap((group) => group.children);
  const triangles = meshes.reduce((sum, m) => sum + (m.geometry.index ?? m.geometry.getAttribute('position')).count / 3, 0);
  const stride = Math.max(1, Math.ceil((points.length * triangles) / kTestsMax));
  const ray = new THREE.Raycaster();
  const down = new THREE.Vector3(0, 0, -1);
  return points.map((p, i) => {
    if (i % stride && i !== points.length - 1) return undefined; // between two that are looked up
    ray.set(p, down);
    return ray.intersectObjects(meshes, false)[0]?.point.z ?? null;
  });
}

/** Sets every point on the ground, linearly between looked-up heights; without ground, `half` below the robot's links. */
function layDown(points, still, low, half) {
  const ground = groundUnder(points, still);
  let before = 0;
  ground.forEach((height, i) => {
    if (height === undefined) return;
    for (let k = before; k <= i; ++k) {
      const part = i > before ? (k - before) / (i - before) : 1;
      const known = ground[before] !== null && height !== null;
      points[k].z = (known ? ground[before] + (height - ground[before]) * part : low[k] - half) + kAbove;
    }
    before = i;
  });
}

export class Trace {
  /** `half`: how high a resting link's origin is above the ground, m; `still`: what may be ground. */
  constructor(run, path, half, still) {
    this.stride = Math.max(1, Math.ceil(run.frames / kPointsMax));
    const points = [];
    const low = [];
    for (let f = 0; f < run.frames; f += this.stride) {
      points.push(new THREE.Vector3().fromArray(path.xyz, 3 * f));
      low.push(path.low[f]);
    }
    layDown(points, still, low, half);
    this.group = new THREE.Group();
    this.count = points.length;
    if (this.count < 2) return;
    const flat = points.flatMap((p) => p.toArray());
    this.past = this.line(flat, 3.5, 0.95);
    this.ahead = this.line(flat, 2, 0.28);
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
