"use strict";
// A sweep: the same start with many values of a parameter, first a few of them, then those between.

/** The numbers of runs less one; each contains the one before. */
const FINER = [8, 32, 128];

jobs.sweep = async function ({ x, p, u, parameter, low, high, which, end, samples, machine }, solver, tell) {
  const known = new Set();
  for (const gaps of FINER) {
    for (let k = 0; k <= gaps; k++) {
      const share = k / gaps;
      if (known.has(share)) continue;
      known.add(share);
      const own = Float64Array.from(p);
      own[parameter] = low + share * (high - low);
      const found = solver.solve({ state: startOf(x, own, u, machine), params: own, inputs: u, t0: 0, t1: end, samples, rtol: 1e-7, atol: 1e-10, maxSteps: 100000, seconds: 2, step: end / 2000 });
      const values = Float32Array.from(found.states, (state) => state[which]);
      if (!(await tell({ share, values, count: known.size, whole: found.status >= 0 }))) return;
    }
  }
};
