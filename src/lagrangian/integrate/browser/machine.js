/* Runs in WebAssembly. */

const PAGE = 65536;
const MATH = {
  sin: Math.sin, cos: Math.cos, asinh: Math.asinh, acosh: Math.acosh, atanh: Math.atanh,
  pow: (x, y) => (x === 1 || (x === -1 && Math.abs(y) === Infinity) ? 1 : Math.pow(x, y)), // as in C
};

class WasmSolver extends Solver {
  constructor(module, layout, functions) {
    super(layout, functions);
    const m = layout.machine;
    if (!(module instanceof WebAssembly.Module)) module = new WebAssembly.Module(module);
    this.base = 64 * Math.ceil((m.data + m.stack) / 64);
    this.memory = new WebAssembly.Memory({ initial: Math.ceil(this.base / PAGE) + 1 });
    const stack = new WebAssembly.Global({ value: "i32", mutable: true }, this.base);
    const env = { __linear_memory: this.memory, __stack_pointer: stack };
    this.code = new WebAssembly.Instance(module, { env, Math: MATH }).exports;
    this.code.facts(this.base);
    const facts = new BigInt64Array(this.memory.buffer, this.base, m.facts.length);
    this.facts = Object.fromEntries(m.facts.map((name, k) => [name, Number(facts[k])]));
    this.kind = "wasm";
  }

  /* Addresses for arrays of numbers of the given lengths, one after another, by name. */
  room(lengths) {
    let end = this.base;
    const at = {};
    for (const [name, n] of Object.entries(lengths)) {
      at[name] = end;
      end += 64 * Math.ceil((8 * n) / 64);
    }
    const missing = end - this.memory.buffer.byteLength;
    if (missing > 0) this.memory.grow(Math.ceil(missing / PAGE));
    return at;
  }

  integrate(given, times, o, store) {
    const run = this.runs(given, times, o, store, 1);
    for (const name of ["status", "steps", "rejected", "evaluations", "reached"]) run[name] = run[name][0];
    return run;
  }

  /* Many runs at once: `states` has a row for each; params and inputs one row for all, or one for each. */
  many(o) {
    const { states, params, inputs } = o, l = this.layout, known = this.initial();
    const count = o.count ?? states.length / l.states.length;
    const given = {
      state: Float64Array.from(states),
      u: Float64Array.from(inputs ?? known.u),
      p: Float64Array.from(params ?? known.p),
    };
    for (const [name, size] of [["state", l.states.length], ["u", l.inputs.length], ["p", l.parameters.length]]) {
      const n = given[name].length;
      if (n !== count * size && (n !== size || name === "state")) {
        throw new RangeError(`${count} runs need ${count * size} numbers (got ${n})`);
      }
      if (!given[name].every(Number.isFinite)) throw new RangeError("a number of a run is not finite");
    }
    for (let k = 0, n = l.parameters.length; k < given.p.length; k += n) {
      if (this.unfit(given.p.subarray(k, k + n))) throw new RangeError(`run ${k / n}: ${l.statuses[l.codes.unfit]}`);
    }
    const store = o.samples !== undefined || o.times !== undefined || o.every !== undefined;
    return this.runs(given, instants(store ? o : { ...o, samples: 2 }, l), settings(o, l), store, count);
  }

  runs(given, times, o, store, count) {
    const l = this.layout, m = l.machine, { u, p } = given, first = times[0], last = times[times.length - 1];
    const signal = m.signals ? pieces(l, this.functions, u, p, first, last) : null;
    const at = this.filled(given, signal, store ? times : [first, last], o, store, count);
    const found = this.executed(at, given, signal, first, last, o, count);
    const buffer = this.memory.buffer, size = m.size, shown = l.states.length;
    const whole = (name) => Array.from(new BigInt64Array(buffer, at[name], count), Number);
    const rows = (name, n, when) => {
      const all = new Float64Array(buffer, at[name], n * size), out = new Float64Array(n * shown);
      for (let k = 0; k < n; k++) {
        out.set(this.back(all.subarray(k * size, (k + 1) * size), p, u, when(k)), k * shown);
      }
      return out;
    };
    const run = {
      status: whole("status"), steps: whole("steps"), rejected: whole("rejected"), evaluations: whole("evaluations"),
      reached: Array.from(new Float64Array(buffer, at.reached, count)), events: found.events, states: null,
    };
    const samples = store ? times.length : 0;
    if (l.sticking && count === 1) this.stuck(run, at, samples, times, found.sticking);
    // the energy supplied since the start is a state after [q; v]
    const supplied = (name, n) => Float64Array.from({ length: n }, (_, k) =>
      (l.supply ? new Float64Array(buffer, at[name] + 8 * (k * size + shown), 1)[0] : 0));
    if (store) run.states = rows("states", count * samples, (k) => times[k % samples]);
    run.final = rows("final", count, (k) => run.reached[k]);
    run.supplied = store ? supplied("states", count * samples) : supplied("final", count);
    const drift = new Float64Array(buffer, at.drift, count * m.drift.length);
    const worst = (names) => Math.max(...names.map((name) => drift[m.drift.indexOf(name)]));
    const beyond = (rule) => rule && count === 1 && worst(rule.names) > rule.limit;
    if (beyond(l.spare)) this.apart(run, u, p, times);
    if (beyond(l.broken)) this.broken(run);
    return run;
  }

  /* Fill the memory for runs; return the addresses of its parts. */
  filled({ state, u, p }, signal, times, o, store, count) {
    const l = this.layout, m = l.machine, size = m.size, shown = l.states.length, samples = times.length;
    const { knots, start, slope } = signal ?? { knots: [], start: [], slope: [] }, kept = store ? samples : 1;
    const room = l.events.length ? Math.max(1024, m.rounds * l.events.length * m.lanes) : 0;
    const at = this.room({
      table: m.table.length, work: this.facts.slots * m.lanes, x0: count * size, u: u.length, p: p.length,
      times: samples, states: count * size * kept, final: count * size, status: count, reached: count, steps: count,
      rejected: count, evaluations: count, event_count: count, atol: size, drift: count * m.drift.length,
      log: room * (3 + size), knots: knots.length, knot_start: start.length, knot_slope: slope.length,
    });
    const view = new DataView(this.memory.buffer);
    const reals = (name, n) => new Float64Array(this.memory.buffer, at[name], n);
    reals("work", this.facts.slots * m.lanes).fill(0);
    reals("states", count * size * kept).fill(NaN);
    reals("atol", size).fill(o.atol);
    const x0 = reals("x0", count * size).fill(0);
    for (let k = 0; k < count; k++) {
      x0.set(this.into(state.subarray(k * shown, (k + 1) * shown), p, u, times[0]), k * size);
    }
    for (const [name, list] of Object.entries({ u, p, times, knots, knot_start: start, knot_slope: slope })) {
      reals(name, list.length).set(list);
    }
    const words = {
      ...at, samples, x0_row: 8 * size, states_row: 8 * size * kept, states_step: store ? 8 * size : 0,
      u_row: u.length > l.inputs.length ? 8 * l.inputs.length : 0,
      p_row: p.length > l.parameters.length ? 8 * l.parameters.length : 0,
      knot_count: knots.length, max_steps: o.maxSteps, max_events: o.maxEvents,
    };
    const numbers = { rtol: o.rtol, step: o.step, max_step: o.maxStep };
    m.table.forEach((name, k) => {
      if (name in numbers) view.setFloat64(at.table + 8 * k, numbers[name], true);
      else view.setBigInt64(at.table + 8 * k, BigInt(Math.floor(words[name] ?? 0)), true);
    });
    for (const [name, x] of Object.entries({ last: count, log: at.log, room })) this.put(at.work, name, x);
    return at;
  }

  /* Words at the head of the work space. */
  put(work, name, x) {
    new DataView(this.memory.buffer).setBigInt64(work + 8 * this.layout.machine.head[name], BigInt(x), true);
  }

  get(work, name) {
    return Number(new DataView(this.memory.buffer).getBigInt64(work + 8 * this.layout.machine.head[name], true));
  }

  /* Run until all runs have ended; empty the log of events whenever it is full, and end runs that take too long. */
  executed(at, { u, p }, signal, first, last, o, count) {
    const l = this.layout, m = l.machine, row = 3 + m.size, events = [];
    const until = o.seconds === Infinity ? Infinity : performance.now() + 1000 * o.seconds;
    const reach = l.sticking ? l.sticking.near * (last - first) : 0, pace = { t: first, tried: 0 };
    const input = (t) => (signal ? inputsAt(signal, t, u.length) : u);
    const sticking = (x, t) => sticks(l, this.functions, x, p, input(t), t, reach, o.step);
    const budget = BigInt(Math.max(1, Math.floor(m.budget / (l.sticking ? 16 : 1))));
    for (let why = -1; why !== m.done; ) {
      why = Number(this.code.run(at.table, at.work, budget));
      const n = this.get(at.work, "logged"), log = new Float64Array(this.memory.buffer, at.log, n * row);
      for (let k = 0; k < n; k++) {
        const e = log.subarray(k * row, (k + 1) * row);
        events.push({ run: e[0], index: e[1], t: e[2], state: this.back(e.subarray(3), p, u, e[2]) });
      }
      this.put(at.work, "logged", 0);
      if (why === m.done) break;
      if (performance.now() > until) {
        this.put(at.work, "quit", 1);
        this.put(at.work, "cursor", count);
      }
      if (l.sticking && count === 1) this.look(at.work, sticking, pace, last, o.maxSteps);
    }
    return { events, sticking };
  }

  /* A state [q; v] as the machine integrates it: with more entries, or with momenta. */
  into(state, p, u, t) {
    if (!this.layout.momenta) return state;
    const x = state.slice();
    x.set(this.functions.momenta(state, p, u, t), this.layout.coordinates);
    return x;
  }

  /* The state [q; v] of what the machine integrates. */
  back(x, p, u, t) {
    const state = x.slice(0, this.layout.states.length);
    if (this.layout.momenta && state.every(Number.isFinite)) {
      state.set(this.functions.velocities(x, p, u, t), this.layout.coordinates);
    }
    return state;
  }

  /* End a run that sticks, if at its pace the remaining steps do not reach the end. */
  look(work, sticking, pace, last, most) {
    const view = new DataView(this.memory.buffer), f = this.facts, m = this.layout.machine;
    const word = (name) => Number(view.getBigInt64(work + 8 * f[name], true));
    if (word("state") !== m.running) return;
    const t = view.getFloat64(work + 8 * f.t, true), tried = word("steps") + word("rejected");
    const more = tried - pace.tried, gained = t - pace.t;
    if (more < this.layout.sticking.least) return;
    Object.assign(pace, { t, tried });
    if (gained * (most - tried) >= (last - t) * more) return;
    if (!sticking(new Float64Array(this.memory.buffer, work + 8 * f.x, m.size), t)) return;
    view.setBigInt64(work + 8 * f.state, BigInt(m.ended), true);
    view.setBigInt64(work + 8 * f.code, BigInt(this.layout.codes.chatters), true);
  }

  /* Give a run that was abandoned, or made fixed steps, the status for sticking if it sticks. */
  stuck(run, at, samples, times, sticking) {
    const { codes, adaptive, machine: { size } } = this.layout, buffer = this.memory.buffer;
    const final = new Float64Array(buffer, at.final, size);
    const abandoned = [codes.tooMany, codes.underflow, codes.noConvergence].includes(run.status[0]);
    if (abandoned && sticking(final, run.reached[0])) run.status[0] = codes.chatters;
    if (adaptive || run.status[0] === codes.chatters) return;
    for (let k = 0; k < samples && times[k] <= run.reached[0]; k++) {
      const x = new Float64Array(buffer, at.states + 8 * size * k, size);
      if (!sticking(x, times[k])) continue;
      run.status[0] = codes.chatters;
      run.reached[0] = times[k];
      run.events = run.events.filter((e) => e.t <= times[k]);
      final.set(x);
      return;
    }
    if (sticking(final, run.reached[0])) run.status[0] = codes.chatters;
  }

  /* End a run before the first sample that violates a row of constraints that followed from others at the start. */
  apart(run, u, p, times) {
    const l = this.layout, shown = l.states.length, x = new Float64Array(l.machine.size);
    const violates = (state, t) => {
      x.set(state);
      const [rest, gap] = this.functions.landing(x, p, u, t).subarray(x.length);
      return Math.max(rest, gap) > l.spare.limit;
    };
    const row = (k) => run.states.subarray(k * shown, (k + 1) * shown);
    const k = run.states ? times.findIndex((t, n) => n > 0 && t <= run.reached[0] && violates(row(n), t)) : -1;
    if (k < 0 && (run.states || !violates(run.final, run.reached[0]))) return;
    run.status[0] = l.codes.apart;
    if (k < 0) return;
    run.reached[0] = times[k - 1];
    run.final.set(row(k - 1));
    run.events = run.events.filter((e) => e.t <= times[k - 1]);
  }

  /* End a run in which the state after a reset breaks a constraint, at its first reset. */
  broken(run) {
    const k = run.events.findIndex((e) => this.layout.events[e.index].reset);
    if (k < 0) return;
    run.status[0] = this.layout.codes.broken;
    run.reached[0] = run.events[k].t;
    run.final.set(run.events[k].state);
    run.events.length = k + 1;
  }
}
