// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// The 3-D view of a running world: the replay's, with contacts, hands that pull, and a picture as fine as the machine can draw.
import * as THREE from 'three';
import { centrePath, mainModel } from '../data.js';
import { okabeIto } from '../palette.js';
import { Stage } from '../stage.js';
import { kContact, kPull } from './frame.js';

const kMarks = 256;
const kUp = new THREE.Vector3(0, 1, 0);
const kArrow = 0.25; // of the robot's reach, for the largest force drawn
// Finest first: pixel ratio, shadow map, materials without reflections.
const kQualities = [
  { pixels: 2, shadow: 2048, plain: false },
  { pixels: 1, shadow: 1024, plain: false },
  { pixels: 0.75, shadow: 512, plain: true },
  { pixels: 0.5, shadow: 512, plain: true },
];
// Where the processor draws: shadows of one look-up a pixel, whose edges are hard, so their map is finer than the picture.
const kSoftwareQualities = [1, 0.75, 0.6, 0.5].map((pixels) => ({ pixels, shadow: 1024, plain: true }));
// A picture that takes longer is made coarser.
const kSlow_ms = 40;
const kSoftwareSlow_ms = 60;
const kLook = 30; // pictures between two decisions
const kEasy = 0.6; // of the limit: fast enough to try a finer picture …
const kEasyLooks = 10; // … if it stays so for this many decisions

/** Whether WebGL is drawn by the processor. */
function software(gl) {
  const info = gl.getExtension('WEBGL_debug_renderer_info');
  const name = info ? gl.getParameter(info.UNMASKED_RENDERER_WEBGL) : '';
  return /swiftshader|llvmpipe|software|basic render/i.test(name);
}

function contactMarks() {
  const arrow = new THREE.CylinderGeometry(0.012, 0.012, 1, 8).translate(0, 0.5, 0);
  const material = new THREE.MeshBasicMaterial({ color: okabeIto.orange, depthTest: false, transparent: true, opacity: 0.85 });
  const marks = new THREE.InstancedMesh(arrow, material, kMarks);
  marks.frustumCulled = false;
  marks.renderOrder = 2;
  marks.count = 0;
  return marks;
}

export class LiveStage extends Stage {
  constructor(run, canvas, gl) {
    const soft = software(gl);
    super(run, canvas, { coarse: soft });
    this.model = mainModel(run);
    this.marks = contactMarks();
    this.feet = new THREE.InstancedMesh(
      new THREE.SphereGeometry(1, 10, 8),
      new THREE.MeshBasicMaterial({ color: okabeIto.vermillion, depthTest: false, transparent: true, opacity: 0.9 }),
      kMarks,
    );
    Object.assign(this.feet, { frustumCulled: false, renderOrder: 3, count: 0 });
    this.hands = new THREE.Group();
    this.scene.add(this.marks, this.feet, this.hands);
    this.weight = 9.81 * run.moving.reduce((sum, i) => sum + (run.links[i].mass_kg || 0), 0);
    this.drawn = [];
    this.easy = 0;
    this.finest = 0;
    this.justFiner = false;
    this.plain = false;
    this.software = soft;
    this.qualities = soft ? kSoftwareQualities : kQualities;
    this.setQuality(soft ? 1 : 0);
    this.controls.enableDamping = !window.matchMedia('(prefers-reduced-motion: reduce)').matches;
  }

  setQuality(level) {
    this.quality = level;
    const { shadow, plain } = this.qualities[level];
    if (plain && !this.plain) this.makePlain();
    const sun = this.scenery.sun;
    this.renderer.shadowMap.type = this.software ? THREE.BasicShadowMap : level > 1 ? THREE.PCFShadowMap : THREE.PCFSoftShadowMap;
    if (sun.shadow.mapSize.x !== shadow) {
      sun.shadow.mapSize.set(shadow, shadow);
      sun.shadow.map?.dispose();
      sun.shadow.map = null;
    }
    this.resize();
  }

  /** Materials that a processor draws several times as fast. */
  makePlain() {
    const kept = ['color', 'map', 'vertexColors', 'transparent', 'opacity', 'side', 'polygonOffset', 'polygonOffsetFactor', 'polygonOffsetUnits'];
    this.scene.traverse((mesh) => {
      if (!mesh.isMesh || !mesh.material.isMeshStandardMaterial) return;
      const plain = new THREE.MeshLambertMaterial(Object.fromEntries(kept.map((key) => [key, mesh.material[key]])));
      mesh.material.dispose();
      mesh.material = plain;
    });
    this.plain = true;
    this.scenery.withoutReflections();
    this.highlight(this.selected);
  }

  resize() {
    super.resize();
    const { clientWidth: width, clientHeight: height } = this.canvas;
    if (!width || !height || this.quality === undefined) return;
    this.renderer.setPixelRatio(Math.min(this.qualities[this.quality].pixels, window.devicePixelRatio));
    this.renderer.setSize(width, height, false);
  }

  /**
   * Coarser where pictures come too slowly; finer again when the machine has long had time to spare, as after a load that passed. A level
   * that proved too much right after is not tried again, and materials without reflections stay.
   */
  timed(ms) {
    this.drawn.push(ms);
    if (this.drawn.length < kLook) return;
    const middle = this.drawn.sort((a, b) => a - b)[kLook >> 1];
    this.drawn = [];
    const slow = this.software ? kSoftwareSlow_ms : kSlow_ms;
    this.easy = middle < kEasy * slow ? this.easy + 1 : 0;
    if (middle > slow && this.quality + 1 < this.qualities.length) {
      if (this.justFiner) this.finest = this.quality + 1;
      this.setQuality(this.quality + 1);
    }
    this.justFiner = false;
    if (this.easy < kEasyLooks || this.quality <= this.finest) return;
    if (this.qualities[this.quality - 1].plain !== this.plain) return;
    this.easy = 0;
    this.justFiner = true;
    this.setQuality(this.quality - 1);
  }

  /** The run's arrays hold a new moment. */
  moved(frame) {
    this.path = centrePath(this.run, this.model);
    this.show(this.run.start);
    this.showContacts(frame.contacts);
    this.showHands(frame.pulls);
  }

  setContacts(on) {
    this.marks.visible = this.feet.visible = on;
    this.dirty = true;
  }

  showContacts(values) {
    const count = Math.min(kMarks, values.length / kContact);
    const pose = new THREE.Matrix4();
    const turn = new THREE.Quaternion();
    const at = new THREE.Vector3();
    const force = new THREE.Vector3();
    const foot = this.size * 0.012;
    for (let i = 0; i < count; ++i) {
      at.fromArray(values, kContact * i);
      force.fromArray(values, kContact * i + 3);
      const size = force.length();
      turn.setFromUnitVectors(kUp, size > 0 ? force.multiplyScalar(1 / size) : kUp);
      // The root keeps weak contacts visible beside strong ones.
      const length = this.size * kArrow * Math.min(1.5, Math.sqrt(size / Math.max(1e-6, this.weight)));
      this.marks.setMatrixAt(i, pose.compose(at, turn, new THREE.Vector3(this.size, length, this.size)));
      this.feet.setMatrixAt(i, pose.compose(at, turn, new THREE.Vector3(foot, foot, foot)));
    }
    for (const mesh of [this.marks, this.feet]) {
      mesh.count = count;
      mesh.instanceMatrix.needsUpdate = true;
    }
  }

  /** A point of a link, in the world. */
  pointOf(link, point) {
    const group = this.groups[link];
    return point.clone().applyQuaternion(group.quaternion).add(group.position);
  }

  showHands(values) {
    const count = values.length / kPull;
    while (this.hands.children.length < count) this.hands.add(this.hand());
    this.hands.children.forEach((hand, i) => {
      hand.visible = i < count;
      if (i >= count) return;
      const from = this.pointOf(values[kPull * i], new THREE.Vector3().fromArray(values, kPull * i + 1));
      const to = new THREE.Vector3().fromArray(values, kPull * i + 4);
      hand.children[0].geometry.setFromPoints([from, to]);
      hand.children[1].position.copy(to);
    });
  }

  hand() {
    const look = { color: okabeIto.purple, depthTest: false, transparent: true };
    const line = new THREE.Line(new THREE.BufferGeometry(), new THREE.LineBasicMaterial(look));
    const end = new THREE.Mesh(new THREE.SphereGeometry(this.size * 0.03, 16, 12), new THREE.MeshBasicMaterial(look));
    line.frustumCulled = false;
    const hand = new THREE.Group().add(line, end);
    hand.traverse((o) => (o.renderOrder = 4));
    return hand;
  }

  /** The moving link under a place on the canvas: {link, point in its frame, world}; null over anything else. */
  grab(x, y) {
    const hit = this.hit(x, y);
    if (!hit || !this.moving.has(hit.link)) return null;
    const group = this.groups[hit.link];
    const point = hit.point.clone().sub(group.position).applyQuaternion(group.quaternion.clone().invert());
    return { link: hit.link, point, world: hit.point };
  }

  /** Where the pointer is on the plane through `world` that faces the camera. */
  drag(x, y, world) {
    const normal = this.camera.getWorldDirection(new THREE.Vector3());
    const plane = new THREE.Plane().setFromNormalAndCoplanarPoint(normal, world);
    return this.ray(x, y).ray.intersectPlane(plane, new THREE.Vector3()) ?? world;
  }

  /** Turns the camera about what it looks at, rad; `nearer` scales the distance. */
  orbit(right, up, nearer = 1) {
    const offset = this.camera.position.clone().sub(this.controls.target);
    const s = new THREE.Spherical().setFromVector3(new THREE.Vector3(offset.x, offset.z, -offset.y));
    s.theta += right;
    s.phi = Math.min(this.controls.maxPolarAngle, Math.max(0.05, s.phi + up));
    s.radius = Math.min(this.controls.maxDistance, Math.max(this.controls.minDistance, s.radius * nearer));
    const v = new THREE.Vector3().setFromSpherical(s);
    this.camera.position.copy(this.controls.target).add(new THREE.Vector3(v.x, -v.z, v.y));
    this.controls.update();
    this.dirty = true;
  }

  /** A direction on the screen as one in the world. */
  direction(right, up) {
    return new THREE.Vector3(right, up, 0).applyQuaternion(this.camera.quaternion);
  }
}
