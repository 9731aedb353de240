// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// The 3-D view: builds the world's links, sets them to a time, picks and highlights.
import * as THREE from 'three';
import { OrbitControls } from 'three/examples/jsm/controls/OrbitControls.js';
import { centrePath, frameAt, mainModel } from './data.js';
import { dark, scenery } from './palette.js';
import { kExposure, Scenery } from './scenery.js';
import { geometryOf, meshesOf, place } from './shapes.js';
import { Trace } from './trace.js';

const kView = new THREE.Vector3(-0.3, -1, 0.5).normalize();

export class Stage {
  /** `coarse`: for a machine that draws with the processor. */
  constructor(run, canvas, { coarse = false } = {}) {
    this.run = run;
    this.canvas = canvas;
    this.coarse = coarse;
    this.renderer = new THREE.WebGLRenderer({ canvas, antialias: !coarse });
    this.renderer.shadowMap.enabled = true;
    this.renderer.shadowMap.type = THREE.PCFSoftShadowMap;
    this.renderer.toneMapping = THREE.NeutralToneMapping;
    this.renderer.toneMappingExposure = kExposure;
    this.scene = new THREE.Scene();
    this.camera = new THREE.PerspectiveCamera(34, 1, 0.01, 600);
    this.camera.up.set(0, 0, 1);
    this.controls = new OrbitControls(this.camera, canvas);
    Object.assign(this.controls, { enableDamping: true, dampingFactor: 0.12, maxPolarAngle: Math.PI * 0.495, zoomToCursor: true });
    this.controls.addEventListener('change', () => (this.dirty = true));

    this.following = true;
    this.path = centrePath(run, mainModel(run));
    this.centre = new THREE.Vector3();
    this.selected = [];
    this.moving = new Map(run.moving.map((link, slot) => [link, slot]));
    this.size = this.reach();
    this.scenery = new Scenery(this.renderer, this.scene, this.size, coarse);
    this.groups = run.links.map((link) => this.build(link));
    const still = this.groups.filter((_, i) => run.links[i].pose);
    this.trace = new Trace(run, this.path, this.restHeight(), still);
    this.scene.add(this.trace.group);
    this.controls.minDistance = this.size * 0.15;
    this.controls.maxDistance = 60;
    this.paint();
    dark.addEventListener('change', () => this.paint());
    this.show(run.start);
    this.resetView();
  }

  /** Half the extent of what moves at the start, m. */
  reach() {
    const box = new THREE.Box3();
    for (let slot = 0; slot < this.run.moving.length && this.run.frames; ++slot) {
      box.expandByPoint(new THREE.Vector3().fromArray(this.run.poses, slot * 7));
    }
    return box.isEmpty() ? 0.5 : Math.max(0.25, box.getSize(new THREE.Vector3()).length() / 2);
  }

  restHeight() {
    let half = Infinity;
    for (const i of this.run.moving) {
      const { size } = this.groups[i].userData;
      if (this.groups[i].children.length) half = Math.min(half, Math.min(...size.toArray()) / 2);
    }
    return Number.isFinite(half) ? half : 0;
  }

  build(link) {
    const group = new THREE.Group();
    const still = Boolean(link.pose);
    const parts = [];
    const box = new THREE.Box3(); // around all shapes, each in its own frame
    for (const shape of link.visuals) {
      const level = still && shape.kind === 'plane' && Math.abs(link.pose[4]) + Math.abs(link.pose[5]) < 1e-6;
      if (level) {
        this.scenery.ground(group);
        continue;
      }
      const geometry = geometryOf(shape, this.run, still, this.coarse);
      if (!geometry) continue;
      geometry.computeBoundingBox();
      box.union(geometry.boundingBox);
      parts.push({ shape, geometry });
    }
    for (const mesh of meshesOf(parts, this.coarse)) {
      mesh.receiveShadow = true;
      mesh.userData.link = this.run.links.indexOf(link);
      group.add(mesh);
    }
    group.userData.size = box.getSize(new THREE.Vector3());
    if (still) place(group, link.pose);
    this.scene.add(group);
    return group;
  }

  paint() {
    this.scenery.paint();
    this.trace.paint();
    this.highlight(this.selected);
    this.dirty = true;
  }

  /** Poses at time t: positions linear, rotations spherical between frames. */
  show(t) {
    const { run } = this;
    if (!run.frames) return;
    const at = frameAt(run, t);
    const width = run.moving.length * 7;
    const next = run.frames > 1 ? width : 0;
    const from = new THREE.Quaternion();
    const to = new THREE.Quaternion();
    const p = run.poses;
    run.moving.forEach((link, slot) => {
      const a = at.frame * width + slot * 7;
      const b = a + next;
      const group = this.groups[link];
      const mix = (k) => p[a + k] + (p[b + k] - p[a + k]) * at.part;
      group.position.set(mix(0), mix(1), mix(2));
      from.set(p[a + 4], p[a + 5], p[a + 6], p[a + 3]);
      to.set(p[b + 4], p[b + 5], p[b + 6], p[b + 3]);
      group.quaternion.copy(from).slerp(to, at.part);
    });
    this.moveCentre(at);
    this.trace.show(at);
    this.dirty = true;
  }

  moveCentre(at) {
    const c = this.path.xyz;
    const next = this.run.frames > 1 ? 3 : 0;
    const mix = (k) => c[3 * at.frame + k] + (c[3 * at.frame + next + k] - c[3 * at.frame + k]) * at.part;
    const now = new THREE.Vector3(mix(0), mix(1), mix(2));
    if (this.following) {
      const step = now.clone().sub(this.centre);
      this.camera.position.add(step);
      this.controls.target.add(step);
    }
    this.centre.copy(now);
  }

  setFollowing(on) {
    this.following = on;
    if (!on) return;
    const step = this.centre.clone().sub(this.controls.target);
    this.camera.position.add(step);
    this.controls.target.add(step);
    this.dirty = true;
  }

  resetView() {
    // A tall window sees less to the sides.
    const fit = Math.max(1, 1.25 / this.camera.aspect);
    this.controls.target.copy(this.centre);
    this.camera.position.copy(kView).multiplyScalar(this.size * 3.5 * fit).add(this.centre);
    this.controls.update();
    this.dirty = true;
  }

  /** Highlights the links of these actuators; the first of them carries the label. */
  highlight(actuators) {
    this.selected = actuators;
    const links = new Set(actuators.flatMap((a) => a.links));
    for (const group of this.groups) {
      for (const mesh of group.children) {
        const on = links.has(mesh.userData.link);
        mesh.material.emissive?.setHex(on ? scenery().pick : 0);
        if (mesh.material.emissive) mesh.material.emissiveIntensity = on ? 0.55 : 0;
      }
    }
    this.dirty = true;
  }

  /** The ray under a place on the canvas (client coordinates). */
  ray(x, y) {
    const r = this.canvas.getBoundingClientRect();
    const at = new THREE.Vector2(((x - r.left) / r.width) * 2 - 1, 1 - ((y - r.top) / r.height) * 2);
    const ray = new THREE.Raycaster();
    ray.setFromCamera(at, this.camera);
    return ray;
  }

  /** What is drawn there: {link, point in the world}, or null. */
  hit(x, y) {
    const hit = this.ray(x, y).intersectObjects(this.groups)[0];
    return hit ? { link: hit.object.userData.link ?? -1, point: hit.point } : null;
  }

  /** The link drawn there, or -1. */
  pick(x, y) {
    return this.hit(x, y)?.link ?? -1;
  }

  /** Where a link is on the canvas, CSS pixels from its corner; null when it is behind the camera. */
  screen(link, above = 0) {
    const v = this.groups[link].getWorldPosition(new THREE.Vector3());
    v.z += above;
    v.project(this.camera);
    if (v.z > 1) return null;
    return { x: ((v.x + 1) / 2) * this.canvas.clientWidth, y: ((1 - v.y) / 2) * this.canvas.clientHeight };
  }

  resize() {
    const { clientWidth: width, clientHeight: height } = this.canvas;
    if (!width || !height) return;
    this.renderer.setPixelRatio(Math.min(2, window.devicePixelRatio));
    this.renderer.setSize(width, height, false);
    this.camera.aspect = width / height;
    this.camera.updateProjectionMatrix();
    this.trace.resize(width, height);
    this.dirty = true;
  }

  /** Draws if anything changed; true when it did. */
  render() {
    this.controls.update();
    if (!this.dirty) return false;
    this.dirty = false;
    this.scenery.follow(this.following ? this.centre : this.controls.target, this.camera);
    this.renderer.render(this.scene, this.camera);
    return true;
  }
}
