"use strict";
// What the page shows, and what the reader has set.

class PageState {
  playing = false;
  /** The time that is shown. */
  shown = 0;
  /** Whether something has changed that is not drawn yet. */
  stale = true;
  /** The names of the elements that stand out, if any. */
  lit = null;
  colours = readColours();
  /** How far things go: of the anchors on the picture, of each state, and of the energies. */
  reach = { box: [0, 0, 1, 1], states: [[0, 0]], energy: [0, 0], first: 1 };

  /**
   * @param {any} data  of the page
   * @param {Run} run
   */
  constructor(data, run) {
    const { history } = run, [p, u, x] = ["p", "u", "x"].map((group) => Float64Array.from(data[group].values));
    Object.assign(this, { data, run, history, size: x.length, nq: data.coordinates });
    /** What the reader sets, and what hands add to the inputs while they push. */
    this.set = { p, u, x, speed: 1, trail: true };
    this.push = new Float64Array(u.length);
    /** The sample that is shown: t, x, T, V, balance, u. */
    this.now = new Float64Array(history.width);
    /** The time that is run ahead, and that plots show. */
    this.span = Math.min(data.duration, 12 * data.pace);
  }

  inputs() {
    return this.set.u.map((value, i) => value + this.push[i]);
  }

  /** Take the sample of the time that is shown. */
  sample() {
    return this.history.state(this.shown, this.now);
  }

  /** The state in that sample. */
  x() {
    return this.now.subarray(1, 1 + this.size);
  }

  /** The state of a stored sample. */
  stored(i) {
    return Float64Array.from({ length: this.size }, (_, n) => this.history.at(i, 1 + n));
  }

  angle(n) {
    return n < this.nq && this.data.angles[n];
  }
}
