/* What users give: names, numbers and times, checked. */

/* The numbers of a group: `given` by order or by name, otherwise those of `before`. */
function numbers(entries, given, before, what) {
  const found = Float64Array.from(before);
  if (given === undefined || given === null) return found;
  if (Array.isArray(given) || ArrayBuffer.isView(given)) {
    if (given.length !== found.length) {
      throw new RangeError(`${what}: ${given.length} values, needed are ${found.length}`);
    }
    found.set(given);
  } else {
    for (const [name, value] of Object.entries(given)) {
      const k = entries.findIndex((entry) => entry.name === name);
      const known = entries.map((entry) => entry.name).join(", ");
      if (k < 0) throw new RangeError(`${what}: there is no '${name}'; known: ${known}`);
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
      if (!Number.isInteger(n) || n < 1) {
        throw new RangeError(`samples must be a whole number, at least 2 (got ${o.samples})`);
      }
      times = Float64Array.from({ length: n + 1 }, (_, k) => (k === n ? t1 : t0 + k * ((t1 - t0) / n)));
    }
  }
  for (let k = 1; k < times.length; k++) {
    if (times[k] > times[k - 1]) continue;
    throw new RangeError(`times must increase (${times[k - 1]} is followed by ${times[k]})`);
  }
  if (times.length < 2 || !times.every(Number.isFinite)) {
    throw new RangeError("give at least two finite times: t0 and t1");
  }
  return times;
}

/* What a run needs besides the start, the inputs and the times. */
function settings(o, layout) {
  const d = layout.defaults;
  return {
    rtol: positive(o.rtol ?? d.rtol, "rtol"), atol: positive(o.atol ?? d.atol, "atol"),
    step: layout.adaptive ? 0 : positive(o.step ?? d.step, "step"),
    maxStep: positive(o.maxStep ?? d.maxStep ?? Infinity, "maxStep", true),
    maxSteps: positive(o.maxSteps ?? d.maxSteps, "maxSteps"),
    maxEvents: positive(o.maxEvents ?? d.maxEvents, "maxEvents"),
    seconds: positive(o.seconds ?? Infinity, "seconds", true), fallbackStep: positive(o.step ?? d.step, "step"),
  };
}
