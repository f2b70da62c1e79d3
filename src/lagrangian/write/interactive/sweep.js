"use strict";
// The sweep: one state over time, for many values of a parameter at once.

/** Runs by their place between the ends of the range. */
class Sweep extends BackgroundPlot {
  take({ share, values, count, whole }) {
    this.runs.set(share, { values, whole });
    const ended = [...this.runs.values()].filter((run) => !run.whole).length;
    this.told(`${count} runs in ${this.passed()}${ended ? `, ${ended} of them end early` : ""}`);
    this.showSoon();
  }

  show() {
    const { plot, state } = this, { end, samples } = this.asked, dark = matchMedia("(prefers-color-scheme: dark)").matches;
    let [low, high] = [Infinity, -Infinity];
    for (const { values } of this.runs.values()) for (const x of values) [low, high] = [Math.min(low, x), Math.max(high, x)];
    plot.begin([0, end], limits(low, high), state.colours);
    const [first, last] = dark ? [0.25, 1] : [0, 0.85]; // what stands out from the paper
    plot.context.globalAlpha = this.runs.size > 40 ? 0.55 : 0.9;
    for (const [share, { values }] of [...this.runs].sort(([a], [b]) => a - b)) {
      const [r, g, b] = colourOf(first + share * (last - first), [0, 1], false);
      if (values.length > 1) plot.line(0, values.length - 1, (i) => (i / (samples - 1)) * end, (i) => values[i], `rgb(${r} ${g} ${b})`, []);
    }
    plot.context.globalAlpha = 1;
  }
}

/**
 * Put the sweep on the page. Returns what draws it again.
 * @param {PageState} state
 * @param {Sliders} sliders
 */
function offerSweep(state, sliders) {
  const { data, set } = state, told = (words) => (element("sweep-told").textContent = words), sweep = new Sweep("sweep", state, told);
  element("sweep").hidden = !data.p.names.length;
  if (!data.p.names.length) return () => {};
  const chosen = () => Number(element("sweep-of").value);
  /** The range is that of the parameter's slider; it begins around the value, or in the middle of the range if that is 0. */
  const choose = () => {
    const { range, unit } = sliders.rows.find(({ group, index }) => group === "p" && index === chosen()), value = set.p[chosen()];
    const reach = 0.3 * Math.abs(value) || 0.25 * (range.max - range.min);
    for (const [id, at] of [["sweep-low", value - reach], ["sweep-high", value + reach]]) {
      Object.assign(element(id), { min: range.min, max: range.max, value: String(at) });
    }
    element("sweep-unit").textContent = unit;
  };
  const draw = () => {
    const [low, high] = ["sweep-low", "sweep-high"].map((id) => Number(element(id).value)), end = numberIn("sweep-end");
    element("sweep-range").textContent = `${digits(low)} … ${digits(high)}`;
    if (!(end > 0)) return told("The time must be greater than 0.");
    sweep.draw({ x: set.x, p: set.p, u: set.u, parameter: chosen(), low, high, which: Number(element("sweep-state").value), end, samples: 321, machine: data.machine });
  };
  choose();
  on("sweep-of", "change", choose);
  return whileOpen("sweep", ["sweep-of", "sweep-low", "sweep-high", "sweep-state", "sweep-end"], draw, () => sweep.background.stop());
}
