"use strict";
// A Poincaré section: where motions pass through a value of a coordinate, upward, or where they are at equal times.

/** The number of samples between two looks at a motion. */
const STRETCH = 240;

jobs.section = async function (job, solver, tell) {
  const { runs, most, where, across } = job, motions = [];
  for (let k = 0; k < runs; k++) {
    const x = Float64Array.from(job.x), s = runs > 1 ? k / (runs - 1) : 0.5;
    x[across.state] = across.low + s * (across.high - across.low);
    if (where >= 0) x[where] = job.value;
    const start = job.rate < 0 ? startOf(x, job.p, job.u, job.machine) : energetic(physics.functions, x, job.p, job.u, job.rate, job.energy);
    if (start) motions.push({ run: k, x: start, t: 0, count: 0 });
  }
  for (let left = motions; left.length; left = left.filter((motion) => motion.count < most && !motion.ended))
    for (const motion of left) {
      const points = stretch(motion, job, solver);
      motion.count += points.length / 2;
      if (!(await tell({ run: motion.run, points, total: motions.length }))) return;
    }
};

/** Go on with a motion, and return the points of the section that it passes: [across, up, across, up, …]. */
function stretch(motion, job, solver) {
  const { where, dt, up, across } = job, found = [], step = where < 0 ? job.value : dt;
  const some = where < 0 ? 24 : STRETCH;
  const run = solver.solve({ state: motion.x, params: job.p, inputs: job.u, t0: motion.t, t1: motion.t + some * step, samples: some + 1, rtol: 1e-8, atol: 1e-10, maxSteps: 200000, seconds: 2, step: dt / 8 });
  const point = (x) => found.push(x[across.state], x[up]);
  for (let i = 1; i < run.states.length; i++) {
    if (where < 0) point(run.states[i]);
    else if (passes(run.states[i - 1], run.states[i], job)) point(crossing(run.states[i - 1], run.states[i], run.t[i - 1], run.t[i], job, solver));
  }
  if (found.length) motion.last = run.reached;
  motion.ended = run.status !== 0 || run.t.length < 2 || motion.t - (motion.last || 0) > job.longest;
  [motion.x, motion.t] = [run.final, run.reached];
  return Float64Array.from(found);
}

/** How far beyond the section a state is; an angle counts from −π to π. */
function beyond(x, { where, value, round }) {
  const d = x[where] - value;
  return round ? d - 2 * Math.PI * Math.round(d / (2 * Math.PI)) : d;
}

function passes(before, after, job) {
  const a = beyond(before, job), b = beyond(after, job);
  return a < 0 && b >= 0 && !(job.round && b - a > Math.PI);
}

/** The state on the section between two samples: Newton's method in time, each run from the sample before it. */
function crossing(x, after, t0, t1, job, solver) {
  const at = (t) => solver.solve({ state: x, params: job.p, inputs: job.u, t0, t1: t, samples: 2, rtol: 1e-8, atol: 1e-10, maxSteps: 20000, step: job.dt / 8 }).final;
  let [a, fa, b, fb, state] = [t0, beyond(x, job), t1, beyond(after, job), after];
  for (let round = 0; round < 6 && Math.abs(fb) > 1e-9; round++) {
    // the rate of the coordinate, or the slope of the last two states where the velocities are not rates
    const slope = round > 0 && job.speed >= 0 ? state[job.speed] : (fb - fa) / (b - a), t = b - fb / slope;
    if (!(t > t0 && t < t1 + job.dt)) break;
    state = at(t);
    [a, fa, b, fb] = [b, fb, t, beyond(state, job)];
  }
  return state;
}
