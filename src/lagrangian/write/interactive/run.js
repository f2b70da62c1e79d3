"use strict";
// A run that grows while it is shown: computed ahead piece by piece, sampled at equal distances in time, with energies.

/**
 * @param {any} solver  of lagrangianSolver
 * @param {Record<string, Function>} functions  of the system: (x, p, u, t, out) → out
 * @param {any} data
 */
function makeRun(solver, functions, data) {
  const size = data.x.names.length, inputs = data.u.names.length, interval = data.duration / 2400, piece = 24;
  const history = makeHistory(size, inputs), powers = new Float64Array(4);
  const self = { history, interval, p: new Float64Array(0), u: new Float64Array(inputs), end: 0, trouble: "", occurred: /** @type {any[]} */ ([]), begin, goOn, computeTo, closed, energies, measure };
  /** The energy that hands and signals have supplied since the start. */
  let supplied = 0;

  /** T, V and the energy of the balance, in `powers`: h, P, T, V. */
  function energies(x, t) {
    return functions.power(x, self.p, self.u, t, powers);
  }

  function sample(x, t) {
    energies(x, t);
    history.add(t, x, powers[2], powers[3], powers[0] - supplied, self.u);
    self.end = t;
  }

  /** The state nearest to x that satisfies all constraints, with the values of now. */
  function closed(x, t, velocities = true) {
    return consistent(functions, x, self.p, self.u, t, data.machine, velocities);
  }

  /** Begin anew at t = 0. */
  function begin(x, p, u) {
    [self.p, self.u, self.trouble, self.occurred] = [Float64Array.from(p), Float64Array.from(u), "", []];
    supplied = 0;
    history.clear();
    sample(closed(x, 0), 0);
  }

  /** Forget what lies beyond a time. */
  function cut(t) {
    if (t >= self.end) return;
    history.count = history.index(t) + 1;
    self.end = history.at(history.count - 1, 0);
    self.occurred = self.occurred.filter((event) => event.t <= self.end);
    energies(last(), self.end);
    supplied = powers[0] - history.at(history.count - 1, history.balance);
  }

  function last() {
    return Float64Array.from({ length: size }, (_, i) => history.at(history.count - 1, 1 + i));
  }

  /** Go on from a time with other parameters and inputs; what this change supplies is counted as supplied. */
  function goOn(t, p, u) {
    cut(t);
    const before = history.at(history.count - 1, history.balance);
    [self.p, self.u, self.trouble] = [Float64Array.from(p), Float64Array.from(u), ""];
    const x = closed(last(), self.end);
    energies(x, self.end);
    supplied = powers[0] - before;
    history.count--;
    sample(x, self.end);
  }

  /** Compute until a time at least; false if the motion ends before it. */
  function computeTo(t) {
    while (self.end < t - 1e-9 * interval && !self.trouble) {
      const t0 = self.end;
      const found = solver.solve({ state: last(), params: self.p, inputs: self.u, t0, t1: t0 + piece * interval, samples: piece + 1, maxSteps: 200000, seconds: 2, step: interval / 4 });
      const before = supplied, own = found.supplied;
      try {
        for (let i = 1; i < found.states.length; i++) {
          supplied = before + (own ? own[i] : 0);
          sample(found.states[i], found.t[i]);
        }
      } catch (error) {
        self.trouble = String(error.message);
      }
      self.occurred.push(...found.events);
      if (found.status !== 0 && !self.trouble) self.trouble = `${found.message}, at t = ${found.reached.toPrecision(4)} s`;
    }
    return self.end >= t - 1e-9 * interval;
  }

  /** The states of a run ahead, from which the page knows how far things go. */
  function measure(x, span) {
    const found = solver.solve({ state: x, params: self.p, inputs: self.u, t0: 0, t1: span, samples: 241, rtol: 1e-6, atol: 1e-9, maxSteps: 20000, seconds: 0.5, step: span / 2000 });
    return found.states.map((state, i) => ({ x: state, t: found.t[i] }));
  }

  return self;
}
