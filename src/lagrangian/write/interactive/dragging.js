"use strict";
// Dragging: coordinates for which an anchor comes nearest to a point of the canvas.

/**
 * Damped least squares on the anchor's finite differences. A body with two freedoms follows the pointer; one on a line
 * or a circle goes where it can.
 * @param {ReturnType<typeof makePicture>} picture
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
