"use strict";
// The samples of a run, at equal distances in time, with the energies at each.

/**
 * @param {number} states  the number of states, the supplied energy included
 * @param {number} inputs
 */
function makeHistory(states, inputs, most = 40000) {
  const width = 1 + states + 3 + inputs; // t, x, T, V, balance, u
  let rows = new Float64Array(2048 * width);
  // the edition changes whenever a sample is no longer what it was
  const self = { count: 0, edition: 0, width, T: 1 + states, V: 2 + states, balance: 3 + states, u: 4 + states, add, at, keep, index, state };

  /** Keep the first samples alone. */
  function keep(count) {
    self.count = count;
    self.edition++;
  }

  /** Append a sample; of a very long run, the older half is dropped. */
  function add(t, x, T, V, balance, u) {
    if (self.count === most) {
      rows.copyWithin(0, (most / 2) * width, most * width);
      keep(most / 2);
    }
    if ((self.count + 1) * width > rows.length) {
      const larger = new Float64Array(Math.min(2 * rows.length, most * width));
      larger.set(rows);
      rows = larger;
    }
    const place = self.count++ * width;
    rows[place] = t;
    rows.set(x, place + 1);
    rows[place + self.T] = T;
    rows[place + self.V] = V;
    rows[place + self.balance] = balance;
    rows.set(u, place + self.u);
  }

  /** One number of a sample: 0 is the time, 1 + i is state i. */
  function at(sample, column) {
    return rows[sample * width + column];
  }

  /** The last sample at or before a time. */
  function index(t) {
    let low = 0, high = self.count - 1;
    while (low < high) {
      const middle = (low + high + 1) >> 1;
      if (rows[middle * width] <= t) low = middle;
      else high = middle - 1;
    }
    return low;
  }

  /** Every number of the run at a time between samples, by straight lines. */
  function state(t, out) {
    const i = index(t), j = Math.min(i + 1, self.count - 1), a = i * width, b = j * width;
    const span = rows[b] - rows[a], part = span > 0 ? Math.min(1, Math.max(0, (t - rows[a]) / span)) : 0;
    for (let n = 0; n < width; n++) out[n] = rows[a + n] + part * (rows[b + n] - rows[a + n]);
    return out;
  }

  return self;
}
