"use strict";
// What is plotted: coordinates and energies over time, the phase portrait, and the numbers of the moment.

class Graphs {
  coordinates = new Plot(element("plot-coordinates"));
  energy = new Plot(element("plot-energy"));
  phase = new Plot(element("plot-phase"));
  /** When numbers were last written. */
  told = -1;

  /** @param {PageState} state */
  constructor(state) {
    this.state = state;
    /** The coordinates that are not plotted. */
    this.hidden = new Set(state.data.x.names.map((_, i) => i).filter((i) => i >= 4));
  }

  /** What the reader does to plots: choose what is plotted, and point at a time. */
  listen(player) {
    const { state, hidden } = this;
    for (const id of ["phase-x", "phase-y"]) on(id, "change", () => (state.stale = true));
    for (const toggle of document.querySelectorAll("[data-series]")) {
      const n = Number(toggle.getAttribute("data-series"));
      press(toggle, !hidden.has(n));
      toggle.addEventListener("click", () => {
        hidden.has(n) ? hidden.delete(n) : hidden.add(n);
        press(toggle, !hidden.has(n));
        state.stale = true;
      });
    }
    for (const plot of [this.coordinates, this.energy]) {
      const go = (event) => player.goTo(Math.max(state.history.at(0, 0), plot.at(event)[0]));
      plot.canvas.addEventListener("pointerdown", (event) => {
        plot.canvas.setPointerCapture(event.pointerId);
        go(event);
      });
      plot.canvas.addEventListener("pointermove", (event) => event.buttons && go(event));
    }
  }

  draw() {
    const { shown, span, history, colours } = this.state, from = Math.max(0, shown - span);
    this.drawOverTime(history.index(from), history.index(shown), [from, Math.max(from + span, shown)]);
    for (const plot of [this.coordinates, this.energy]) plot.mark(shown, colours.soft);
    this.drawPhase(history.index(shown));
    this.tell();
  }

  /** The samples from `first` to `end`. */
  drawOverTime(first, end, xs) {
    const { nq, reach, history, colours } = this.state, t = (i) => history.at(i, 0), energies = [history.T, history.V, history.balance];
    const visible = Array.from({ length: nq }, (_, n) => n).filter((n) => !this.hidden.has(n));
    let [low, high] = [Infinity, -Infinity], [least, most] = reach.energy;
    for (let i = first; i <= end; i += 4) {
      for (const n of visible) [low, high] = [Math.min(low, history.at(i, 1 + n)), Math.max(high, history.at(i, 1 + n))];
      for (const c of energies) [least, most] = [Math.min(least, history.at(i, c)), Math.max(most, history.at(i, c))];
    }
    if (xs[0] === 0) for (const n of visible) [low, high] = [Math.min(low, reach.states[n][0]), Math.max(high, reach.states[n][1])];
    this.coordinates.begin(xs, limits(low, high), colours);
    for (const n of visible) this.coordinates.line(first, end, t, (i) => history.at(i, 1 + n), colours.series[n % 6], DASHES[Math.floor(n / 6) % 6]);
    this.energy.begin(xs, limits(least, most), colours);
    energies.forEach((c, k) => this.energy.line(first, end, t, (i) => history.at(i, c), colours.series[k], k === 2 ? [7, 3] : []));
  }

  /** One number over another; angles are drawn between −π and π. */
  drawPhase(end) {
    const { state, phase } = this, { history, colours, now } = state;
    const [across, up] = ["phase-x", "phase-y"].map((id) => Number(element(id).value)), from = Math.max(0, end - 6000);
    const wrapped = (c, x) => (state.angle(c) ? x - 2 * Math.PI * Math.round(x / (2 * Math.PI)) : x);
    const value = (c) => (i) => wrapped(c, history.at(i, 1 + c)), x = value(across), y = value(up);
    const jumps = (i) => (state.angle(across) && Math.abs(x(i) - x(i - 1)) > Math.PI) || (state.angle(up) && Math.abs(y(i) - y(i - 1)) > Math.PI);
    phase.begin(limits(...this.range(across, from, end)), limits(...this.range(up, from, end)), colours);
    phase.line(from, end, x, y, colours.accent, [], jumps);
    phase.dot(wrapped(across, now[1 + across]), wrapped(up, now[1 + up]), colours.input, colours.paper);
  }

  /** The least and the largest value of a state, or a whole turn of an angle that goes round. */
  range(c, from, end) {
    const { state } = this, { history } = state, known = state.reach.states[c];
    let [low, high] = known;
    for (let i = from; i <= end; i += 4) [low, high] = [Math.min(low, history.at(i, 1 + c)), Math.max(high, history.at(i, 1 + c))];
    const round = state.angle(c) && (Math.max(...known.map(Math.abs)) > 2.8 || low < -Math.PI || high > Math.PI);
    return round ? [-Math.PI, Math.PI] : [low, high];
  }

  /** The clock, and the numbers, which change eight times a second while the motion is played. */
  tell() {
    const { run, history, now, shown, playing, size } = this.state, slider = element("time"), moment = performance.now();
    element("clock").textContent = `t = ${shown.toFixed(2)} s`;
    slider.max = String(Math.max(run.end, run.interval));
    slider.step = String(run.interval);
    if (document.activeElement !== slider || playing) slider.value = String(shown);
    slider.setAttribute("aria-valuetext", `${shown.toFixed(2)} seconds`);
    if (playing && moment - this.told < 120) return;
    this.told = moment;
    const write = (id, x, n = 4) => (element(`number-${id}`).textContent = digits(x, n));
    for (let i = 0; i < size; i++) write(i, now[1 + i]);
    for (const id of ["T", "V", "balance"]) write(id, now[history[id]]);
    write("audit", Math.abs(now[history.balance] - history.at(0, history.balance)), 2);
  }
}
