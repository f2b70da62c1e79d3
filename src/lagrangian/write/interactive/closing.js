"use strict";
// States that satisfy constraints; the page and its worker share this.

/**
 * The state nearest to x that satisfies all constraints: Newton steps on positions, then one on velocities.
 * @param {Record<string, Function>} functions  `approach` and `landing` are there if the system has constraints
 * @param {ArrayLike<number>} x
 * @param {number} machine  the number of states of the solver, which may have one more
 */
function consistent(functions, x, p, u, t, machine, velocities = true) {
  const { approach, landing } = functions, n = x.length, y = new Float64Array(machine);
  y.set(x);
  for (let round = 0, gap = Infinity; approach && gap > 1e-12 && round < 30; round++) {
    const change = approach(y, p, u, t);
    for (let i = 0; i < n; i++) y[i] += change[i];
    gap = change[machine]; // before this step
    if (!Number.isFinite(gap)) return Float64Array.from(x);
  }
  if (landing && velocities) {
    const change = landing(y, p, u, t);
    for (let i = 0; i < n; i++) y[i] += change[i];
  }
  return y.every(Number.isFinite) ? y.slice(0, n) : Float64Array.from(x);
}
