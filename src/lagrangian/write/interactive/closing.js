"use strict";
// States that satisfy constraints or have a given energy; the page and its worker share this.

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

/** T + V of a state at t = 0. */
function energyOf(functions, x, p, u) {
  const [, , T, V] = functions.power(x, p, u, 0, new Float64Array(4));
  return T + V;
}

/**
 * Give a state the energy that is asked, by one of its rates, the larger of two; null if no rate does. T + V is a v² + b v + c.
 * @param {number} rate  the number of this rate among the states
 */
function energetic(functions, x, p, u, rate, energy) {
  const of = (v) => {
    x[rate] = v;
    return energyOf(functions, x, p, u);
  };
  const c = of(0), up = of(1), down = of(-1), a = (up + down) / 2 - c, b = (up - down) / 2, square = b * b - 4 * a * (c - energy);
  if (!(square >= 0) || !(a > 0)) return null;
  x[rate] = (-b + Math.sqrt(square)) / (2 * a);
  return x;
}
