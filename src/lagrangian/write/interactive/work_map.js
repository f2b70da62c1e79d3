"use strict";
// The map of starts, row by row.

jobs.map = async function (job, solver, tell) {
  const { x, p, u, across, up, end, which, width, height, machine } = job, size = x.length;
  for (let coarse = 16; coarse >= 1; coarse /= 2) {
    const columns = Math.ceil(width / coarse), rows = Math.ceil(height / coarse), some = Math.max(1, Math.floor(1500 / columns));
    for (let row = 0; row < rows; row += some) {
      const count = columns * Math.min(some, rows - row), states = new Float64Array(count * size);
      for (let k = 0; k < count; k++) {
        const start = Float64Array.from(x), i = k % columns, j = row + Math.floor(k / columns);
        start[across.state] = across.low + ((i + 0.5) / columns) * (across.high - across.low);
        start[up.state] = up.high - ((j + 0.5) / rows) * (up.high - up.low);
        states.set(startOf(start, p, u, machine), k * size);
      }
      const found = manyRuns(solver, states, count, p, u, end), values = new Float64Array(count);
      for (let k = 0; k < count; k++) values[k] = found.status[k] < 0 ? NaN : found.final[k * size + which];
      if (!(await tell({ columns, rows, row, values, finest: coarse === 1 }))) return;
    }
  }
};

/** Runs side by side; where there is no WebAssembly, one after another. */
function manyRuns(solver, states, count, p, u, end) {
  if (solver.many) return solver.many({ states, count, params: p, inputs: u, t0: 0, t1: end, rtol: 1e-5, atol: 1e-8, maxSteps: 20000, seconds: 5 });
  const size = states.length / count, final = new Float64Array(states.length), status = new Array(count);
  for (let k = 0; k < count; k++) {
    const found = solver.solve({ state: states.slice(k * size, (k + 1) * size), params: p, inputs: u, t0: 0, t1: end, samples: 2, step: end / 500 });
    final.set(found.final, k * size);
    status[k] = found.status;
  }
  return { final, status };
}
