"use strict";
// A run that grows while it is shown: computed ahead piece by piece, sampled at equal distances in time, with energies.

class Run {
  end = 0;
  trouble = "";
  /** Events, in the order in which they occurred. */
  occurred = [];
  /** The energy that hands and signals have supplied since the start. */
  supplied = 0;
  p = [];
  powers = new Float64Array(4);

  /**
   * @param {any} solver  of lagrangianSolver
   * @param {Record<string, Function>} functions  of the system: (x, p, u, t, out) → out
   * @param {any} data
   */
  constructor(solver, functions, { x, u, machine, duration }) {
    Object.assign(this, { solver, functions, machine, interval: duration / 2400, size: x.names.length, u: new Float64Array(u.names.length) });
    this.history = makeHistory(this.size, this.u.length);
  }

  /** The energy h of the balance, the power P supplied, T and V; they are overwritten by the next call. */
  energies(x, t) {
    return this.functions.power(x, this.p, this.u, t, this.powers);
  }

  sample(x, t) {
    const [h, , T, V] = this.energies(x, t);
    this.history.add(t, x, T, V, h - this.supplied, this.u);
    this.end = t;
  }

  /** The state nearest to x that satisfies all constraints, with the values of now. */
  closed(x, t, velocities = true) {
    return consistent(this.functions, x, this.p, this.u, t, this.machine, velocities);
  }

  /** Begin anew at t = 0. */
  begin(x, p, u) {
    [this.p, this.u, this.trouble, this.occurred] = [Float64Array.from(p), Float64Array.from(u), "", []];
    this.supplied = 0;
    this.history.keep(0);
    this.sample(this.closed(x, 0), 0);
  }

  /** Forget what lies beyond a time. */
  cut(t) {
    const { history } = this;
    if (t >= this.end) return;
    history.keep(history.index(t) + 1);
    this.end = this.lastAt(0);
    this.occurred = this.occurred.filter((event) => event.t <= this.end);
    this.supply(this.last(), this.lastAt(history.balance));
  }

  /** One number of the last sample. */
  lastAt(column) {
    return this.history.at(this.history.count - 1, column);
  }

  /** The last state. */
  last() {
    return Float64Array.from({ length: this.size }, (_, i) => this.lastAt(1 + i));
  }

  /** Count as supplied what leaves a state at the end with this balance. */
  supply(x, balance) {
    this.supplied = this.energies(x, this.end)[0] - balance;
  }

  /** Go on from a time with other parameters and inputs; what this change supplies is counted as supplied. */
  goOn(t, p, u) {
    const { history } = this;
    this.cut(t);
    const before = this.lastAt(history.balance);
    [this.p, this.u, this.trouble] = [Float64Array.from(p), Float64Array.from(u), ""];
    const x = this.closed(this.last(), this.end);
    this.supply(x, before);
    history.keep(history.count - 1);
    this.sample(x, this.end);
  }

  /** Compute until a time at least; false if the motion ends before it. */
  computeTo(t) {
    const { interval } = this, wanted = t - 1e-9 * interval, pieces = 24;
    while (this.end < wanted && !this.trouble)
      this.take(this.solver.solve({ state: this.last(), params: this.p, inputs: this.u, t0: this.end, t1: this.end + pieces * interval, samples: pieces + 1, maxSteps: 200000, seconds: 2, step: interval / 4 }));
    return this.end >= wanted;
  }

  /** Append what was computed; the first of its samples is there already. */
  take(found) {
    const before = this.supplied, own = found.supplied;
    try {
      for (let i = 1; i < found.states.length; i++) {
        this.supplied = before + (own ? own[i] : 0);
        this.sample(found.states[i], found.t[i]);
      }
    } catch (error) {
      this.trouble = String(error.message);
    }
    this.occurred.push(...found.events);
    if (found.status !== 0 && !this.trouble) this.trouble = `${found.message}, at t = ${found.reached.toPrecision(4)} s`;
  }

  /** The states of a run ahead, from which the page knows how far things go. */
  measure(x, span) {
    const found = this.solver.solve({ state: x, params: this.p, inputs: this.u, t0: 0, t1: span, samples: 241, rtol: 1e-6, atol: 1e-9, maxSteps: 20000, seconds: 0.5, step: span / 2000 });
    return found.states.map((state, i) => ({ x: state, t: found.t[i] }));
  }
}
