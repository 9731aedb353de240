// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// The mouse spring: a link that is dragged is pulled towards the pointer; the force is worked out by the engine. Shift and the arrow
// keys do the same to the chosen joint's link. Where the simulator takes no hands, links are only chosen and drags orbit.

const kClick_px = 5;
const kKeyReach = 0.4; // of the robot's size
const kArrows = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] };
const kTurn = 0.09; // rad a key press

class Pulls {
  constructor(stage, link, on) {
    Object.assign(this, { stage, link, on, held: null, waiting: null, keys: new Set(), hands: true });
  }

  /** Sent once a picture. */
  flush() {
    if (!this.waiting) return;
    this.link.ask('pull', this.waiting);
    this.waiting = null;
  }

  pull(link, point, target) {
    this.waiting = { link, point_m: point.toArray(), target_m: target.toArray() };
  }

  release() {
    if (!this.held && !this.keys.size) return;
    this.held = null;
    this.waiting = null;
    this.link.ask('release');
  }

  down(e) {
    if (!e.isPrimary || e.button !== 0) return;
    const grabbed = this.stage.grab(e.clientX, e.clientY);
    if (!grabbed) return;
    this.stage.canvas.focus({ preventScroll: true });
    if (this.hands) {
      // The camera's own controls must not see it.
      e.stopImmediatePropagation();
      this.stage.canvas.setPointerCapture(e.pointerId);
    }
    this.held = { ...grabbed, id: e.pointerId, x: e.clientX, y: e.clientY, moved: false, more: e.shiftKey };
  }

  move(e) {
    const { held } = this;
    if (!held || held.id !== e.pointerId) return;
    held.moved ||= Math.hypot(e.clientX - held.x, e.clientY - held.y) > kClick_px;
    if (held.moved && this.hands) this.pull(held.link, held.point, this.stage.drag(e.clientX, e.clientY, held.world));
  }

  up(e) {
    const { held } = this;
    if (!held || held.id !== e.pointerId) return;
    if (held.moved && this.hands) this.release();
    else if (!held.moved) this.on.choose(held.link, held.more);
    this.held = null;
  }

  key(e) {
    const arrow = kArrows[e.key];
    if (arrow && e.shiftKey && this.hands) {
      this.keys.add(e.key);
      this.pullByKeys();
    } else if (arrow) {
      this.stage.orbit(-kTurn * arrow[0], -kTurn * arrow[1]);
    } else if (e.key === '+' || e.key === '-') {
      this.stage.orbit(0, 0, e.key === '+' ? 0.9 : 1.1);
    } else {
      return;
    }
    e.preventDefault();
    e.stopPropagation();
  }

  pullByKeys() {
    const index = this.on.chosenLink();
    if (index === undefined) return;
    let right = 0;
    let up = 0;
    for (const key of this.keys) {
      right += kArrows[key][0];
      up += kArrows[key][1];
    }
    const start = this.stage.groups[index].position.clone();
    const origin = start.clone().set(0, 0, 0);
    if (!this.from || this.from.index !== index) this.from = { index, start };
    const by = this.stage.direction(right, up).normalize().multiplyScalar(this.stage.size * kKeyReach);
    this.pull(index, origin, this.from.start.clone().add(by));
  }

  keyUp(e) {
    if (!this.keys.has(e.key) && e.key !== 'Shift') return;
    if (e.key === 'Shift') this.keys.clear();
    else this.keys.delete(e.key);
    if (this.keys.size) return this.pullByKeys();
    this.dropKeys();
  }

  /** Nor does a pull that wasn't sent yet go out after the release: nobody would let go of it. */
  dropKeys() {
    this.keys.clear();
    this.from = null;
    this.waiting = null;
    this.link.ask('release');
  }
}

/** on: { choose(link, more), chosenLink() } */
export function connectPulls(stage, link, on) {
  const pulls = new Pulls(stage, link, on);
  const { canvas } = stage;
  canvas.addEventListener('pointerdown', (e) => pulls.down(e), true);
  canvas.addEventListener('pointermove', (e) => pulls.move(e));
  canvas.addEventListener('pointerup', (e) => pulls.up(e));
  canvas.addEventListener('pointercancel', () => pulls.release());
  canvas.addEventListener('keydown', (e) => pulls.key(e));
  canvas.addEventListener('keyup', (e) => pulls.keyUp(e));
  canvas.addEventListener('blur', () => pulls.keys.size && pulls.dropKeys());
  return pulls;
}
