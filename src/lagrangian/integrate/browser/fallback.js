/* Runs in JavaScript, where WebAssembly is forbidden. */

class FallbackSolver extends Solver {
  constructor(functions, layout) {
    super(layout, functions);
    if (layout.events.length) throw new Error("events are found only by WebAssembly, which this page may not run");
    for (const name of ["rhs", ...layout.projected]) {
      if (!functions[name]) throw new Error(`without WebAssembly, runs need the function '${name}', which is left out`);
    }
    this.kind = "javascript";
  }

  integrate({ state, u, p }, times, o, store) {
    const l = this.layout, codes = l.codes, shown = l.states.length, last = times[times.length - 1];
    const signal = l.machine.signals ? pieces(l, this.functions, u, p, times[0], last) : null;
    const input = signal ? (t) => inputsAt(signal, t, u.length) : () => u;
    const states = store ? new Float64Array(times.length * shown).fill(NaN) : null;
    const until = o.seconds === Infinity ? Infinity : performance.now() + 1000 * o.seconds;
    const stops = [...new Set([...times, ...(signal?.knots ?? [])])].sort((a, b) => a - b);
    const x = new Float64Array(l.machine.size), wanted = new Map(Array.from(times, (t, k) => [t, k]));
    let t = times[0], steps = 0, status = codes.reached;
    const supplied = new Float64Array(store ? times.length : 1);
    const room = Array.from({ length: 3 }, () => new Float64Array(x.length)), [y] = room;
    x.set(state);
    if (store) states.set(state);
    this.project(x, input(t), p, t);
    for (let s = 1; s < stops.length && status === codes.reached; s++) {
      // equal steps up to the next time at which a state is wanted or an input bends
      const from = t, stop = stops[s], longest = Math.min(o.fallbackStep, o.maxStep);
      const count = Math.max(1, Math.ceil(((stop - from) / longest) * (1 - 1e-12))), h = (stop - from) / count;
      // conditions that switch at the end of a piece have not switched yet
      const before = Math.max(from, stop - Math.abs(stop) * 2 ** -50), held = (at) => Math.min(at, before);
      for (let n = 0; n < count && status === codes.reached; n++) {
        const end = n + 1 === count ? stop : from + (n + 1) * h;
        this.step(x, p, t, h, held, input, room);
        this.project(y, input(held(end)), p, end);
        if (steps >= o.maxSteps) status = codes.tooMany;
        else if ((steps & 255) === 255 && performance.now() > until) status = codes.late;
        else if (!y.every(Number.isFinite)) status = codes.notFinite;
        else {
          x.set(y);
          t = end;
          steps++;
        }
      }
      if (store && status === codes.reached && wanted.has(t)) {
        states.set(x.subarray(0, shown), wanted.get(t) * shown);
        if (l.supply) supplied[wanted.get(t)] = x[shown];
      }
    }
    if (!store && l.supply) supplied[0] = x[shown];
    const counts = { status, steps, rejected: 0, evaluations: 4 * steps };
    return { ...counts, reached: t, events: [], states, final: x.slice(0, shown), supplied };
  }

  /* The classical Runge-Kutta step of order 4 from x to y: slopes at the start, twice in the middle, at the end. */
  step(x, p, t, h, held, input, [y, k, sum]) {
    const size = x.length;
    sum.fill(0);
    for (let stage = 0; stage < 4; stage++) {
      const c = stage === 0 ? 0 : stage === 3 ? 1 : 0.5, weight = stage === 0 || stage === 3 ? 1 : 2;
      for (let i = 0; i < size; i++) y[i] = x[i] + (c ? c * h * k[i] : 0);
      const at = held(t + c * h);
      this.functions.rhs(y, p, input(at), at, k);
      for (let i = 0; i < size; i++) sum[i] += weight * k[i];
    }
    for (let i = 0; i < size; i++) y[i] = x[i] + (h / 6) * sum[i];
  }

  /* Newton steps on the constraints of positions until they are met, then one on those of velocities. */
  project(x, u, p, t) {
    const { approach, landing } = this.functions, names = this.layout.projected;
    const add = (d) => {
      for (let i = 0; i < x.length; i++) x[i] += d[i];
      return d[x.length]; // the gap before this step
    };
    for (let n = 0, gap = 1; names.includes("approach") && gap > 1e-12 && n < 9; n++) gap = add(approach(x, p, u, t));
    if (names.includes("landing")) add(landing(x, p, u, t));
  }
}

const makeSolver = (module, layout, functions) => new WasmSolver(module, layout, functions);
const makeFallback = (functions, layout) => new FallbackSolver(functions, layout);

async function load(bytes, layout, functions) {
  let module;
  try {
    module = await WebAssembly.compile(bytes);
  } catch {
    return makeFallback(functions, layout); // it is forbidden here, or the browser is too old
  }
  return makeSolver(module, layout, functions);
}
