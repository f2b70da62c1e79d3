"use strict";
// The Poincaré section: points of many motions, a colour for each.

class PoincareSection extends BackgroundPlot {
  draw(job) {
    super.draw(job);
    this.told("Computing …");
    this.show();
  }

  take({ run, points, total }) {
    this.runs.set(run, [...(this.runs.get(run) ?? []), ...points]);
    const count = [...this.runs.values()].reduce((n, own) => n + own.length / 2, 0);
    this.told(`${count.toLocaleString("en")} points of ${total} motions in ${this.passed()}`);
    this.showSoon();
  }

  wrapped(c, x) {
    return this.state.angle(c) ? x - 2 * Math.PI * Math.round(x / (2 * Math.PI)) : x;
  }

  show() {
    const { plot, state } = this, { across, up } = this.asked, { context, box } = plot;
    const xs = [Infinity, -Infinity], ys = [Infinity, -Infinity];
    const spots = [...this.runs].map(([run, own]) => [run, Array.from({ length: own.length / 2 }, (_, k) => [this.wrapped(across.state, own[2 * k]), this.wrapped(up, own[2 * k + 1])])]);
    for (const [, own] of spots)
      for (const [x, y] of own) {
        [xs[0], xs[1]] = [Math.min(xs[0], x), Math.max(xs[1], x)];
        [ys[0], ys[1]] = [Math.min(ys[0], y), Math.max(ys[1], y)];
      }
    plot.begin(limits(...xs), limits(...ys), state.colours);
    const { series } = state.colours;
    for (const [run, own] of spots) {
      context.fillStyle = series[run % series.length];
      for (const [x, y] of own) context.fillRect(plot.X(x) - 0.8, plot.Y(y) - 0.8, 1.6, 1.6);
    }
  }
}

/**
 * Put the section on the page. Returns what draws it again.
 * @param {PageState} state
 * @param {Sliders} sliders
 */
function offerSection(state, sliders) {
  const { data, set, nq, size } = state, told = (words) => (element("section-told").textContent = words), section = new PoincareSection("section", state, told);
  const chosen = (id) => Number(element(`section-${id}`).value);
  const begin = () => {
    const where = chosen("where");
    element("section-value").value = where < 0 ? digits(data.section.period) : state.angle(where) ? "0" : digits(set.x[where]);
    element("section-unit").textContent = where < 0 ? "s" : sliders.starts()[where].unit;
  };
  const job = () => {
    const where = chosen("where"), value = numberIn("section-value"), acrossAt = chosen("x"), { range } = sliders.starts()[acrossAt];
    const same = where >= 0 && size === 2 * nq && !data.constrained && element("section-energy").checked;
    const free = same && acrossAt !== where && acrossAt !== nq + where;
    return {
      x: set.x, p: set.p, u: set.u, where, value, round: where >= 0 && state.angle(where), machine: data.machine,
      across: { state: acrossAt, low: Number(range.min), high: Number(range.max) }, up: chosen("y"),
      speed: size === 2 * nq && where >= 0 ? nq + where : -1, rate: free ? nq + where : -1, energy: energyOf(state.run.functions, set.x, set.p, set.u),
      runs: 32, most: 240, dt: state.run.interval * 4, longest: 40 * data.duration,
    };
  };
  const draw = () => {
    const asked = job();
    if (!Number.isFinite(asked.value) || (asked.where < 0 && !(asked.value > 0))) return told("The value must be a number, a time greater than 0.");
    section.draw(asked);
  };
  begin();
  on("section-where", "change", begin);
  on("section-canvas", "pointerdown", (event) => pickSection(section, state, sliders, event));
  return whileOpen("section", ["section-where", "section-value", "section-x", "section-y", "section-energy"], draw, () => section.background.stop());
}

/** Begin the motion at a point of the section. */
function pickSection(section, state, sliders, event) {
  const { asked, plot } = section, { set } = state;
  if (!asked) return;
  const [a, b] = plot.at(event), x = Float64Array.from(set.x);
  if (asked.where >= 0) x[asked.where] = asked.value;
  [x[asked.across.state], x[asked.up]] = [a, b];
  if (asked.rate >= 0 && asked.up !== asked.rate && !energetic(state.run.functions, x, set.p, set.u, asked.rate, asked.energy)) return section.told("No motion of this energy passes there.");
  set.x.set(x);
  sliders.begin();
}
