"use strict";
// States that satisfy constraints or have a given energy; the page and its worker share this.

/**
 * The state nearest to x that satisfies all constraints: Newton steps on positions, then one on velocities.
 * @param {Record<string, Function>} functions  `approach` and `landing` if the system has constraints, or `residual` alone where they are too long
 * @param {ArrayLike<number>} x
 * @param {number} machine  the number of states of the solver, which may have one more
 */
function consistent(functions, x, p, u, t, machine, velocities = true) {
  const { approach, landing, residual } = functions, n = x.length, y = new Float64Array(machine);
  y.set(x);
  if (!approach && residual) return nearest((q) => residual(q, p, u, t).slice(), x);
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

/**
 * The state nearest to x at which all rows are 0: Newton steps of least length, with slopes from finite differences.
 * @param {(x: Float64Array) => Float64Array} rows
 * @param {ArrayLike<number>} x
 */
function nearest(rows, x) {
  let y = Float64Array.from(x), f = rows(y);
  for (let round = 0; round < 9 && f.some((r) => Math.abs(r) > 1e-13); round++) {
    const slopes = Array.from(f, () => new Float64Array(y.length));
    for (let i = 0; i < y.length; i++) {
      const h = 1e-7 * Math.max(1, Math.abs(y[i])), moved = y.slice();
      moved[i] += h;
      rows(moved).forEach((r, k) => (slopes[k][i] = (r - f[k]) / h));
    }
    const weights = solved(slopes.map((a) => slopes.map((b) => a.reduce((sum, s, i) => sum + s * b[i], 0))), f);
    y = y.map((q, i) => q - weights.reduce((sum, w, k) => sum + w * slopes[k][i], 0));
    f = rows(y);
  }
  return y.every(Number.isFinite) ? y : Float64Array.from(x);
}

/** The solution of A z = b with a symmetric, positive A, by elimination; a row that follows from others counts nothing. */
function solved(A, b) {
  const n = b.length, rows = A.map((row, i) => [...row, b[i]]), z = new Float64Array(n);
  for (let k = 0; k < n; k++)
    for (let i = k + 1; i < n; i++) {
      const factor = rows[k][k] > 1e-12 * A[k][k] ? rows[i][k] / rows[k][k] : 0;
      for (let j = k; j <= n; j++) rows[i][j] -= factor * rows[k][j];
    }
  for (let k = n - 1; k >= 0; k--) {
    let sum = rows[k][n];
    for (let j = k + 1; j < n; j++) sum -= rows[k][j] * z[j];
    z[k] = rows[k][k] > 1e-12 * A[k][k] ? sum / rows[k][k] : 0;
  }
  return z;
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
