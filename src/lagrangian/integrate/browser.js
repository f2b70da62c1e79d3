/* Runs a system that the Python package `lagrangian` compiled, in a browser, a worker or Node. No dependency.

   lagrangianSolver.makeSolver(module, layout)        integrates in WebAssembly; module: bytes or WebAssembly.Module
   lagrangianSolver.makeFallback(functions, layout)   the same interface over JavaScript, with Runge-Kutta steps of order 4
   lagrangianSolver.load(bytes, layout, functions)    a promise of the first; of the second where WebAssembly is forbidden

   solver.solve({state, params, inputs, t0, t1, samples | every | times, rtol, atol, step, maxSteps, maxStep, maxEvents,
                 seconds}) -> {status, message, t, states, final, reached, events, steps, rejected, evaluations}
   solver.start({state, params, inputs, t, ...})      begins a run that is shown while it is computed
   solver.advance(dt) -> {status, message, t, state, events, steps}
   solver.change({state, params, inputs})             between two calls of advance

   States, parameters and inputs are arrays in the order of the layout, or objects by name; what is left out keeps the
   value of the layout (start, change: the value it has). SI units. status: 0 the end was reached, 1 a terminal event,
   negative: the run failed, and message says why. */
"use strict";

const lagrangianSolver = (() => {
  const PAGE = 65536;
  const MATH = {
    sin: Math.sin, cos: Math.cos, asinh: Math.asinh, acosh: Math.acosh, atanh: Math.atanh,
    pow: (x, y) => (x === 1 || (x === -1 && Math.abs(y) === Infinity) ? 1 : Math.pow(x, y)), // as in C
  };

  // -- arguments ---------------------------------------------------------------------------------------------------

  /* The numbers of a group: `given` by order or by name, otherwise those of `before`. */
  function numbers(entries, given, before, what) {
    const found = Float64Array.from(before);
    if (given === undefined || given === null) return found;
    if (Array.isArray(given) || ArrayBuffer.isView(given)) {
      if (given.length !== found.length) throw new RangeError(`${what}: ${given.length} values, needed are ${found.length}`);
      found.set(given);
    } else {
      for (const [name, value] of Object.entries(given)) {
        const k = entries.findIndex((entry) => entry.name === name);
        if (k < 0) throw new RangeError(`${what}: there is no '${name}'; known: ${entries.map((e) => e.name).join(", ")}`);
        found[k] = value;
      }
    }
    const wrong = found.findIndex((x) => !Number.isFinite(x));
    if (wrong >= 0) throw new RangeError(`${what} '${entries[wrong].name}' is ${found[wrong]}; give a finite number`);
    return found;
  }

  function positive(value, what, infinite = false) {
    if (typeof value !== "number" || !(value > 0) || (value === Infinity && !infinite)) {
      throw new RangeError(`${what} must be a number above 0 (got ${value})`);
    }
    return value;
  }

  /* The times at which states are wanted; the first is the start. */
  function instants(o, layout) {
    let times;
    if (o.times !== undefined) {
      times = Float64Array.from(o.times);
    } else {
      const t0 = o.t0 ?? 0, t1 = o.t1 ?? t0 + layout.duration;
      if (o.every !== undefined) {
        const n = Math.floor((t1 - t0) / positive(o.every, "every") * (1 + 1e-12));
        times = Float64Array.from({ length: n + 1 }, (_, k) => t0 + k * o.every);
        if (times[n] < t1 - 1e-12 * Math.abs(t1)) times = Float64Array.of(...times, t1);
      } else {
        const n = (o.samples ?? 1001) - 1;
        if (!Number.isInteger(n) || n < 1) throw new RangeError(`samples must be a whole number, at least 2 (got ${o.samples})`);
        times = Float64Array.from({ length: n + 1 }, (_, k) => (k === n ? t1 : t0 + k * ((t1 - t0) / n)));
      }
    }
    for (let k = 1; k < times.length; k++) {
      if (!(times[k] > times[k - 1])) throw new RangeError(`times must increase (${times[k - 1]} is followed by ${times[k]})`);
    }
    if (times.length < 2 || !times.every(Number.isFinite)) throw new RangeError("give at least two finite times: t0 and t1");
    return times;
  }

  /* What a run needs besides the start, the inputs and the times. */
  function settings(o, layout) {
    const d = layout.defaults;
    return {
      rtol: positive(o.rtol ?? d.rtol, "rtol"), atol: positive(o.atol ?? d.atol, "atol"),
      step: layout.adaptive ? 0 : positive(o.step ?? d.step, "step"),
      maxStep: positive(o.maxStep ?? Infinity, "maxStep", true),
      maxSteps: positive(o.maxSteps ?? d.maxSteps, "maxSteps"), maxEvents: positive(o.maxEvents ?? d.maxEvents, "maxEvents"),
      seconds: positive(o.seconds ?? Infinity, "seconds", true), fallbackStep: positive(o.step ?? d.step, "step"),
    };
  }

  // -- what both solvers have in common ----------------------------------------------------------------------------

  class Solver {
    constructor(layout) {
      this.layout = layout;
      this.now = null;
    }

    /* One run, sampled. */
    solve(o = {}) {
      const l = this.layout, times = instants(o, l), size = l.states.length;
      const state = numbers(l.states, o.state, l.start, "state");
      const u = numbers(l.inputs, o.inputs, l.inputs.map((x) => x.value), "input");
      const p = numbers(l.parameters, o.params, l.parameters.map((x) => x.value), "parameter");
      const run = this.integrate(state, u, p, times, settings(o, l), true);
      let kept = 0;
      while (kept < times.length && run.states.subarray(kept * size, (kept + 1) * size).every(Number.isFinite)) kept++;
      const states = Array.from({ length: kept }, (_, k) => run.states.subarray(k * size, (k + 1) * size));
      return { ...this.told(run), t: times.slice(0, kept), states, final: run.final, reached: run.reached,
               rejected: run.rejected, evaluations: run.evaluations };
    }

    told(run) {
      return { status: run.status, message: this.layout.statuses[run.status] ?? "", steps: run.steps,
               events: run.events.map((e) => ({ ...e, name: this.layout.events[e.index].name })) };
    }

    start(o = {}) {
      const l = this.layout;
      this.now = { state: l.start, u: l.inputs.map((x) => x.value), p: l.parameters.map((x) => x.value), t: o.t ?? 0 };
      this.options = settings(o, l);
      this.change(o);
      return this;
    }

    change(o) {
      const l = this.layout, now = this.now;
      now.state = numbers(l.states, o.state, now.state, "state");
      now.u = numbers(l.inputs, o.inputs, now.u, "input");
      now.p = numbers(l.parameters, o.params, now.p, "parameter");
      if (o.t !== undefined) now.t = o.t;
      return this;
    }

    advance(dt) {
      if (this.now === null) this.start();
      const now = this.now, times = Float64Array.of(now.t, now.t + positive(dt, "dt"));
      const run = this.integrate(now.state, now.u, now.p, times, this.options, false);
      now.state = run.final;
      now.t = run.reached;
      return { ...this.told(run), t: now.t, state: now.state.slice() };
    }
  }

  // -- WebAssembly -------------------------------------------------------------------------------------------------

  class WasmSolver extends Solver {
    constructor(module, layout) {
      super(layout);
      const m = layout.machine;
      if (!(module instanceof WebAssembly.Module)) module = new WebAssembly.Module(module);
      this.base = 64 * Math.ceil((m.data + m.stack) / 64);
      this.memory = new WebAssembly.Memory({ initial: Math.ceil(this.base / PAGE) + 1 });
      const stack = new WebAssembly.Global({ value: "i32", mutable: true }, this.base);
      const env = { __linear_memory: this.memory, __stack_pointer: stack };
      this.code = new WebAssembly.Instance(module, { env, Math: MATH }).exports;
      this.code.facts(this.base);
      this.slots = Number(new BigInt64Array(this.memory.buffer, this.base, 1)[0]);
      this.kind = "wasm";
    }

    /* Addresses for arrays of numbers of the given lengths, one after another. */
    room(lengths) {
      let end = this.base;
      const found = lengths.map((n) => {
        const at = end;
        end += 64 * Math.ceil((8 * n) / 64);
        return at;
      });
      const missing = end - this.memory.buffer.byteLength;
      if (missing > 0) this.memory.grow(Math.ceil(missing / PAGE));
      return found;
    }

    integrate(state, u, p, times, o, store) {
      return this.many(state, u, p, times, o, store, 1);
    }

    /* `count` runs; state, u and p have one row for all runs, or one for each. */
    many(state, u, p, times, o, store, count) {
      const l = this.layout, m = l.machine, size = m.size, shown = l.states.length, samples = store ? times.length : 2;
      const width = m.lanes, events = l.events.length, row = 3 + size;
      const space = events ? Math.max(1024, m.rounds * events * width) : 0;
      const names = ["table", "work", "x0", "u", "p", "times", "states", "final", "status", "reached", "steps", "rejected",
        "evaluations", "event_count", "atol", "drift", "log", "knots", "knot_start", "knot_slope"];
      const lengths = [m.table.length, this.slots * width, count * size, u.length, p.length, samples,
        count * size * (store ? samples : 1), count * size, count, count, count, count, count, count, size,
        count * m.drift, space * row, 1, u.length, u.length];
      const at = Object.fromEntries(this.room(lengths).map((place, k) => [names[k], place]));
      const buffer = this.memory.buffer, view = new DataView(buffer);
      const reals = (name, n) => new Float64Array(buffer, at[name], n), whole = (name, n) => new BigInt64Array(buffer, at[name], n);

      // what goes in
      reals("work", this.slots * width).fill(0);
      const x0 = reals("x0", count * size).fill(0);
      for (let k = 0; k < count; k++) x0.set(state.length > shown ? state.subarray(k * shown, (k + 1) * shown) : state, k * size);
      reals("u", u.length).set(u);
      reals("p", p.length).set(p);
      reals("times", samples).set(store ? times : [times[0], times[times.length - 1]]);
      reals("states", lengths[6]).fill(NaN);
      reals("atol", size).fill(o.atol);
      reals("knots", 1)[0] = times[0];
      reals("knot_start", u.length).set(u);
      reals("knot_slope", u.length).fill(0);
      const inputs = l.inputs.length, parameters = l.parameters.length;
      const words = { ...at, x0_row: 8 * size, u_row: u.length > inputs ? 8 * inputs : 0,
        p_row: p.length > parameters ? 8 * parameters : 0, samples, knot_count: 1, max_steps: o.maxSteps,
        max_events: o.maxEvents, states_row: 8 * size * (store ? samples : 1), states_step: store ? 8 * size : 0 };
      const numbers = { rtol: o.rtol, step: o.step, max_step: o.maxStep };
      m.table.forEach((name, k) => {
        if (name in numbers) view.setFloat64(at.table + 8 * k, numbers[name], true);
        else view.setBigInt64(at.table + 8 * k, BigInt(Math.floor(words[name] ?? 0)), true);
      });
      const head = (name) => at.work + 8 * m.head[name];
      const put = (name, x) => view.setBigInt64(head(name), BigInt(x), true);
      const get = (name) => Number(view.getBigInt64(head(name), true));
      put("cursor", 0); put("last", count); put("log", at.log); put("room", space);

      // run, and empty the log of events whenever it is full
      const found = [], until = o.seconds === Infinity ? Infinity : performance.now() + 1000 * o.seconds;
      for (let why = -1; why !== m.done; ) {
        why = Number(this.code.run(at.table, at.work, BigInt(m.budget)));
        const n = get("logged"), log = new Float64Array(buffer, at.log, n * row);
        for (let k = 0; k < n; k++) {
          const e = log.subarray(k * row, (k + 1) * row);
          found.push({ run: e[0], index: e[1], t: e[2], state: e.slice(3, 3 + shown) });
        }
        put("logged", 0);
        if (why !== m.done && performance.now() > until) { put("quit", 1); put("cursor", count); }
      }

      // what comes out
      const integers = (name) => Array.from(whole(name, count), Number), rows = (name, n) => {
        const all = reals(name, n * size), out = new Float64Array(n * shown);
        for (let k = 0; k < n; k++) out.set(all.subarray(k * size, k * size + shown), k * shown);
        return out;
      };
      const out = { status: integers("status"), steps: integers("steps"), rejected: integers("rejected"),
        evaluations: integers("evaluations"), reached: Array.from(reals("reached", count)) };
      const result = { events: found, states: store ? rows("states", count * samples) : null, final: rows("final", count) };
      for (const [name, list] of Object.entries(out)) result[name] = count === 1 ? list[0] : list;
      return result;
    }
  }

  // -- JavaScript, where WebAssembly is forbidden ------------------------------------------------------------------

  class FallbackSolver extends Solver {
    constructor(functions, layout) {
      super(layout);
      if (layout.events.length) throw new Error("events are found only by WebAssembly, which this page may not run");
      if (!functions.rhs) throw new Error("this system has no right-hand side in JavaScript");
      this.functions = functions;
      this.kind = "javascript";
    }

    integrate(state, u, p, times, o, store) {
      const l = this.layout, f = this.functions.rhs, size = l.machine.size, shown = l.states.length;
      const x = new Float64Array(size), sum = new Float64Array(size), y = new Float64Array(size), k = new Float64Array(size);
      const states = store ? new Float64Array(times.length * shown).fill(NaN) : null;
      const until = o.seconds === Infinity ? Infinity : performance.now() + 1000 * o.seconds;
      let t = times[0], steps = 0, status = l.codes.reached;
      x.set(state);
      if (store) states.set(state);
      this.project(x, u, p, t);
      for (let s = 1; s < times.length && status === l.codes.reached; s++) {
        const from = t, count = Math.max(1, Math.ceil(((times[s] - from) / o.fallbackStep) * (1 - 1e-12)));
        const h = (times[s] - from) / count;
        for (let n = 0; n < count; n++) {
          if (steps >= o.maxSteps) { status = l.codes.tooMany; break; }
          if ((steps & 255) === 255 && performance.now() > until) { status = l.codes.late; break; }
          // the classical method: slopes at the start, twice in the middle, at the end
          f(x, p, u, t, k);
          for (let i = 0; i < size; i++) { sum[i] = k[i]; y[i] = x[i] + (h / 2) * k[i]; }
          f(y, p, u, t + h / 2, k);
          for (let i = 0; i < size; i++) { sum[i] += 2 * k[i]; y[i] = x[i] + (h / 2) * k[i]; }
          f(y, p, u, t + h / 2, k);
          for (let i = 0; i < size; i++) { sum[i] += 2 * k[i]; y[i] = x[i] + h * k[i]; }
          f(y, p, u, t + h, k);
          for (let i = 0; i < size; i++) y[i] = x[i] + (h / 6) * (sum[i] + k[i]);
          const end = n + 1 === count ? times[s] : from + (n + 1) * h;
          this.project(y, u, p, end);
          if (!y.every(Number.isFinite)) { status = l.codes.notFinite; break; }
          x.set(y);
          t = end;
          steps++;
        }
        if (store && status === l.codes.reached) states.set(x.subarray(0, shown), s * shown);
      }
      return { status, steps, rejected: 0, evaluations: 4 * steps, reached: t, events: [], states, final: x.slice(0, shown) };
    }

    /* Newton steps on the constraints of positions until they are met, then one on those of velocities. */
    project(x, u, p, t) {
      const { approach, landing } = this.functions;
      for (let round = 0, gap = Infinity; approach && gap > 1e-12 && round < 9; round++) {
        const d = approach(x, p, u, t);
        for (let i = 0; i < x.length; i++) x[i] += d[i];
        gap = d[x.length]; // before this step
      }
      if (!landing) return;
      const d = landing(x, p, u, t);
      for (let i = 0; i < x.length; i++) x[i] += d[i];
    }
  }

  const makeSolver = (module, layout) => new WasmSolver(module, layout);
  const makeFallback = (functions, layout) => new FallbackSolver(functions, layout);
  const load = async (bytes, layout, functions) => {
    try {
      return makeSolver(await WebAssembly.compile(bytes), layout);
    } catch (error) {
      if (typeof WebAssembly !== "undefined" && !(error instanceof WebAssembly.CompileError)) throw error;
      return makeFallback(functions, layout);
    }
  };
  return { makeSolver, makeFallback, load };
})();
