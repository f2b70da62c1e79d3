/* What the solvers have in common. */

class Solver {
  constructor(layout, functions) {
    this.layout = layout;
    this.functions = functions ?? {};
    this.now = null;
    for (const name of layout.needs) {
      if (!this.functions[name]) throw new TypeError(`this system needs the function '${name}' of its module`);
    }
  }

  /* One run, sampled. */
  solve(o = {}) {
    const l = this.layout, times = instants(o, l), size = l.states.length;
    const run = this.run(this.given(o), times, settings(o, l), true);
    const row = (k) => run.states.subarray(k * size, (k + 1) * size);
    let kept = 0;
    const there = (k) => k < times.length && row(k).every(Number.isFinite) && (k === 0 || times[k] <= run.reached);
    while (there(kept)) kept++;
    return {
      ...this.told(run), t: times.slice(0, kept), states: Array.from({ length: kept }, (_, k) => row(k)),
      supplied: run.supplied.slice(0, kept), final: run.final, reached: run.reached, rejected: run.rejected,
      evaluations: run.evaluations,
    };
  }

  /* Begin a run that is advanced piece by piece. */
  start(o = {}) {
    this.now = { ...this.given(o), t: o.t ?? 0 };
    this.options = settings(o, this.layout);
    return this;
  }

  /* Change the state, parameters or inputs of this run. */
  change(o) {
    if (this.now === null) this.start();
    this.now = { ...this.given(o, this.now), t: o.t ?? this.now.t };
    return this;
  }

  advance(dt) {
    if (this.now === null) this.start();
    const now = this.now, times = Float64Array.of(now.t, now.t + positive(dt, "dt"));
    const run = this.run(now, times, this.options, false);
    now.state = run.final;
    now.t = run.reached;
    return { ...this.told(run), t: now.t, state: now.state.slice(), supplied: run.supplied[0] };
  }

  /* Integrate, unless a parameter makes a mass impossible: such a run ends where it begins. */
  run(given, times, o, store) {
    if (!this.unfit(given.p)) return this.integrate(given, times, o, store);
    const size = given.state.length, states = store ? new Float64Array(times.length * size).fill(NaN) : null;
    states?.set(given.state);
    const none = { steps: 0, rejected: 0, evaluations: 0, events: [], supplied: new Float64Array(times.length) };
    return { ...none, status: this.layout.codes.unfit, states, final: given.state.slice(), reached: times[0] };
  }

  unfit(p) {
    const { masses } = this.layout;
    if (!masses.length) return false;
    return this.functions.masses([], p, [], 0).some((m, k) => !(m > 0 || (m === 0 && masses[k].rests)));
  }

  initial() {
    const l = this.layout;
    return { state: l.start, u: l.inputs.map((x) => x.value), p: l.parameters.map((x) => x.value) };
  }

  given(o, before = this.initial()) {
    const l = this.layout;
    return {
      state: numbers(l.states, o.state, before.state, "state"),
      u: numbers(l.inputs, o.inputs, before.u, "input"),
      p: numbers(l.parameters, o.params, before.p, "parameter"),
    };
  }

  told(run) {
    const { statuses, events } = this.layout;
    const listed = run.events.map(({ index, t, state }) => ({ index, name: events[index].name, t, state }));
    return { status: run.status, message: statuses[run.status] ?? "", steps: run.steps, events: listed };
  }
}
