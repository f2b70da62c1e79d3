"use strict";
// Dragging: a pointer holds a body or turns the view, and coordinates follow it.

/**
 * The coordinates for which an anchor comes nearest to a point of the canvas.
 * Damped least squares on the anchor's finite differences. A body with two freedoms follows the pointer; one on a line
 * or a circle goes where it can.
 * @param {Picture} picture
 * @param {number} anchor
 * @param {number[]} goal  on the canvas [px]
 * @param {Float64Array} start  state
 * @param {number} n  the number of coordinates
 * @param {(x: Float64Array) => Float64Array} closed  puts a state back onto the constraints
 */
function dragged(picture, anchor, goal, start, n, closed, rounds = 12) {
  let q = Float64Array.from(start), distance = Infinity, damping = 1e-3;
  const place = (trial) => {
    picture.place(trial, 0);
    return picture.onCanvas(anchor);
  };
  const from = place(q);
  distance = Math.hypot(goal[0] - from[0], goal[1] - from[1]);
  for (let round = 0; round < rounds && distance > 0.05; round++) {
    const here = place(q), rows = [new Float64Array(start.length), new Float64Array(start.length)];
    for (let i = 0; i < n; i++) {
      const h = 1e-6 * Math.max(1, Math.abs(q[i])), moved = Float64Array.from(q);
      moved[i] += h;
      const there = place(closed(moved));
      rows[0][i] = (there[0] - here[0]) / h;
      rows[1][i] = (there[1] - here[1]) / h;
    }
    const dot = (a, b) => a.reduce((sum, x, i) => sum + x * b[i], 0);
    const xx = dot(rows[0], rows[0]), xy = dot(rows[0], rows[1]), yy = dot(rows[1], rows[1]);
    const lambda = damping * (xx + yy) + 1e-12, a = xx + lambda, d = yy + lambda, det = a * d - xy * xy;
    const ex = goal[0] - here[0], ey = goal[1] - here[1];
    const wx = (d * ex - xy * ey) / det, wy = (a * ey - xy * ex) / det; // (J Jᵀ + λ)⁻¹ e
    const trial = closed(q.map((x, i) => x + rows[0][i] * wx + rows[1][i] * wy));
    const reached = place(trial), left = Math.hypot(goal[0] - reached[0], goal[1] - reached[1]);
    if (left < distance) {
      [q, distance, damping] = [Float64Array.from(trial), left, Math.max(1e-6, damping / 5)];
    } else damping *= 8;
  }
  return q;
}

class Dragging {
  /** Where the pointer was that turns the view, if one does. */
  turning = null;

  /**
   * @param {Motion} motion
   * @param {Player} player
   * @param {Sliders} sliders
   * @param {number[]} handles  the anchors that can be dragged
   */
  constructor(motion, player, sliders, handles) {
    Object.assign(this, { motion, player, sliders, handles, state: motion.state });
    on("canvas", "pointerdown", (event) => this.take(event));
    on("canvas", "pointermove", (event) => this.move(event));
    for (const name of ["pointerup", "pointercancel"]) on("canvas", name, () => this.release());
  }

  /** The place of a pointer on the canvas. */
  within(event) {
    const edge = this.motion.canvas.getBoundingClientRect();
    return [event.clientX - edge.left, event.clientY - edge.top];
  }

  /** Take the nearest body within reach, or else the view of a picture in space. */
  take(event) {
    const { motion, state } = this, { picture, canvas } = motion, [x, y] = this.within(event);
    state.sample();
    motion.place();
    let nearest = null, best = 32;
    for (const anchor of this.handles) {
      const [X, Y] = picture.onCanvas(anchor), distance = Math.hypot(X - x, Y - y);
      if (distance < best) [nearest, best] = [{ anchor, dx: X - x, dy: Y - y }, distance];
    }
    canvas.setPointerCapture(event.pointerId);
    if (nearest) {
      motion.held = { ...nearest, playing: state.playing, x: state.x().slice().fill(0, state.nq) };
      this.player.hold();
      canvas.classList.add("held");
    } else if (picture.depth === 3) this.turning = [event.clientX, event.clientY];
    state.stale = true;
  }

  move(event) {
    const { motion, turning } = this;
    if (motion.held) this.follow(...this.within(event));
    else if (turning) {
      motion.picture.orbit((event.clientX - turning[0]) * 0.008, (event.clientY - turning[1]) * 0.008);
      this.turning = [event.clientX, event.clientY];
      motion.measure();
    }
  }

  release() {
    const { motion } = this, { held } = motion;
    this.turning = null;
    if (!held) return;
    motion.held = null;
    motion.canvas.classList.remove("held");
    this.sliders.begin();
    if (held.playing) this.player.play();
  }

  /** Move the coordinates so that the body that is held comes to the pointer. */
  follow(x, y) {
    const { motion, state, sliders } = this, { held } = motion;
    const found = dragged(motion.picture, held.anchor, [x + held.dx, y + held.dy], held.x, state.nq, (trial) => state.run.closed(trial, 0, false));
    state.set.x.set(found);
    held.x.set(found);
    sliders.showStarts();
    this.player.restart();
  }
}
