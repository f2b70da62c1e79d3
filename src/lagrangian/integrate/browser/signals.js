/* Inputs as functions of time, and the times at which conditions switch. */

/* The inputs from t0 to t1 as pieces: u = start + slope (t - knot) from each knot on. A step ends at every knot. */
function pieces(layout, functions, u, p, t0, t1) {
  const inside = new Set(layout.switching ? switches(layout, functions, u, p, t0, t1) : []);
  for (const { table } of layout.inputs) for (const t of table?.times ?? []) if (t > t0 && t < t1) inside.add(t);
  const knots = [t0, ...Float64Array.from(inside).sort()], n = u.length;
  const start = new Float64Array(knots.length * n), slope = new Float64Array(knots.length * n);
  knots.forEach((knot, k) => layout.inputs.forEach(({ table }, i) => {
    const end = knots[k + 1] ?? Math.max(t1, knot);
    start[k * n + i] = table ? tabled(table, knot, false) : u[i];
    const bent = table && !table.hold && end > knot;
    if (bent) slope[k * n + i] = (tabled(table, end, true) - start[k * n + i]) / (end - knot);
  }));
  return { knots: Float64Array.from(knots), start, slope };
}

/* A table at time t; where it jumps, `left` selects the value before. */
function tabled({ times, values, hold }, t, left) {
  let k = 0;
  while (k < times.length && (times[k] < t || (!left && times[k] === t))) k++; // the first entry after t
  if (hold || k === 0 || k === times.length) return values[Math.min(Math.max(k - 1, 0), times.length - 1)];
  return values[k - 1] + ((values[k] - values[k - 1]) * (t - times[k - 1])) / (times[k] - times[k - 1]);
}

/* The times in (t0, t1] at which a condition that depends only on time switches, each to the last bit. */
function switches(layout, { switches: pairs }, u, p, t0, t1) {
  const x = new Float64Array(layout.machine.size), signs = (t) => {
    const f = pairs(x, p, u, t);
    return Array.from({ length: f.length / 2 }, (_, k) => Math.sign(f[2 * k] - f[2 * k + 1]));
  };
  const count = Math.max(64, Math.min(16384, Math.ceil((16384 * (t1 - t0)) / layout.duration))), found = [];
  let before = t0, old = signs(t0);
  for (let n = 1; n <= count; n++) {
    const at = t0 + ((t1 - t0) * n) / count, now = signs(at);
    now.forEach((sign, k) => {
      if (sign === old[k]) return;
      let low = before, high = at;
      for (let middle; (middle = low + (high - low) / 2) > low && middle < high; ) {
        if (signs(middle)[k] === sign) high = middle; else low = middle;
      }
      found.push(high);
    });
    before = at; old = now;
  }
  return found.filter((t) => !found.some((other) => other > t && other - t <= 2 ** -51 * Math.abs(t)));
}

/* The inputs at a time, from their pieces. */
function inputsAt({ knots, start, slope }, t, n) {
  let k = knots.length - 1;
  while (k > 0 && knots[k] > t) k--;
  return Float64Array.from({ length: n }, (_, i) => start[k * n + i] + slope[k * n + i] * (t - knots[k]));
}
