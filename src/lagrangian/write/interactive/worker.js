"use strict";
// In a worker: very many runs, coarse first, then finer, until something else is asked.

/** What can be asked, by kind: (job, solver, tell) → nothing; `tell` sends results, and says whether they are wanted. */
const jobs = {};

/** How long [ms] a job computes before messages that have arrived are read. */
const BUSY = 15;

(function work() {
  const loading = physics.solver();
  let current = 0;

  addEventListener("message", async ({ data: job }) => {
    current = job.id;
    if (!job.kind) return;
    const solver = await loading;
    let since = performance.now();
    const tell = async (found) => {
      postMessage({ ...found, id: job.id });
      if (performance.now() - since > BUSY) {
        await new Promise((go) => setTimeout(go, 0));
        since = performance.now();
      }
      return current === job.id;
    };
    if (current !== job.id) return;
    try {
      await jobs[job.kind](job, solver, tell);
    } catch (error) {
      setTimeout(() => { throw error; }); // the page listens to errors of the worker, not to rejected promises
    }
  });
})();

/** A start that satisfies the constraints, if there are any. */
function startOf(x, p, u, machine) {
  return physics.functions.approach ? consistent(physics.functions, x, p, u, 0, machine) : x;
}
