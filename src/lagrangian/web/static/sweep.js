/** A sweep: what varies and between what, what is kept of each run, and a plot that fills while it runs. */

import { follow, Lost } from "./ask.js";
import { byId, make } from "./page.js";
import { curves, figure, map } from "./plot.js";
import { about, model } from "./state.js";
import { tell } from "./trouble.js";

const KEPT = { max: "the greatest", min: "the least", final: "the last", mean: "the mean", rms: "the root mean square of", range: "the range of" };
const COUNTS = [10, 20, 40, 80];

/** @type {AbortController|null} */
let running = null;
let madeOf = "";

/** @param {(error: unknown) => void} lose */
export function startSweep(lose) {
  const fresh = () => {
    if (document.body.dataset.view !== "sweep" || !model.data || madeOf === model.dataOf) return;
    madeOf = model.dataOf;
    running?.abort();
    build(lose);
  };
  document.addEventListener("shown", fresh);
  document.addEventListener("derived", fresh);
}

/** What can vary: parameters around their values, initial values and inputs; all in SI units. */
function quantities() {
  const { parameters, coordinates, inputs } = model.data;
  const found = parameters.map((/** @type {any} */ p) => ({ name: p.name, words: p.description, value: p.value_si ?? 1 }));
  for (const c of coordinates) found.push({ name: c.name, words: `${c.description || c.name}, at the start`, value: null });
  for (const u of inputs) found.push({ name: u.name, words: u.description, value: null });
  return found.map((/** @type {any} */ q) => ({ ...q, unit: unitOf(q.name) }));
}

/** @param {(error: unknown) => void} lose */
function build(lose) {
  const all = quantities();
  const first = axis("Vary", all, all[0]?.name, false);
  const second = axis("and", all, "", true);
  const kept = make("select", { "aria-label": "What to keep of each run" },
    ...Object.entries(KEPT).map(([name, words]) => make("option", { value: name }, words)));
  const start = model.data.coordinates[0]?.name ?? "";
  const of = make("input", { type: "text", value: start, "aria-label": "Of which quantity: a name or an expression", size: 14, spellcheck: "false" });
  const duration = make("input", { type: "text", placeholder: "as the model says", "aria-label": "Duration", size: 16 });
  const count = make("select", { "aria-label": "Values along each axis" },
    ...COUNTS.map((n) => make("option", { value: n, selected: n === 20 }, `${n} values each`)));
  const stop = make("button", { type: "button", disabled: true, onclick: () => running?.abort() }, "Stop");
  const go = make("button", { type: "submit", class: "primary" }, "Run");
  const bar = make("progress", { value: 0, max: 1, "aria-label": "Runs that are done", hidden: true });
  const place = make("div", { class: "sheet plain", "aria-live": "off" });
  const said = make("p", { class: "small", role: "status" });
  const trouble = make("div", { class: "trouble", role: "status", hidden: true });
  const form = make("form", { class: "sweep-form", onsubmit: (/** @type {Event} */ event) => {
    event.preventDefault();
    const axes = [first, second].map((a) => a.read(Number(count.value))).filter(Boolean);
    const asked = { ...about(), axes, output: kept.value === "final" ? of.value : `${kept.value} ${of.value}` };
    if (duration.value.trim()) Object.assign(asked, { duration: duration.value.trim() });
    run(asked, { place, said, trouble, bar, go, stop }).catch(lose);
  } },
  first.made, second.made,
  make("fieldset", { class: "axis" }, make("legend", {}, "Keep of each run"), make("div", { class: "tools" }, kept, of)),
  make("fieldset", { class: "axis" }, make("legend", {}, "Each run"), make("div", { class: "tools" }, make("label", {}, "Duration ", duration), count)),
  make("div", { class: "tools" }, go, stop, bar), trouble);
  byId("sweep").replaceChildren(make("div", { class: "panes" }, make("div", { class: "pane" }, form), make("div", { class: "pane" }, place, said)));
}

/** The controls of one axis: what varies, and two sliders with their numbers.
 *  @param {string} words @param {any[]} all @param {string|undefined} chosen @param {boolean} optional */
function axis(words, all, chosen, optional) {
  const pick = make("select", { "aria-label": `${words}: the quantity` },
    optional ? make("option", { value: "" }, "nothing else") : null,
    ...all.map((q) => make("option", { value: q.name, selected: q.name === chosen }, q.words ? `${q.name}: ${q.words}` : q.name)));
  const sliders = make("div", { class: "sliders" });
  /** @type {any[]} */
  let ends = [];
  const fill = () => {
    const q = all.find((x) => x.name === pick.value);
    const value = q?.value ?? null;
    const [low, high] = value === null ? [-2, 2] : value === 0 ? [-1, 1] : value > 0 ? [0, 3 * value] : [3 * value, 0];
    const [from, to] = value === null ? [-1, 1] : [low + (high - low) / 6, low + (5 * (high - low)) / 6];
    ends = q ? [slider("from", low, high, from, q), slider("to", low, high, to, q)] : [];
    sliders.replaceChildren(...ends.map((end) => end.made));
  };
  pick.addEventListener("change", fill);
  fill();
  return {
    made: make("fieldset", { class: "axis" }, make("legend", {}, words), pick, sliders),
    read: (/** @type {number} */ count) => pick.value && { name: pick.value, low: ends[0].value(), high: ends[1].value(), count },
  };
}

/** @param {string} words @param {number} low @param {number} high @param {number} value @param {any} q */
function slider(words, low, high, value, q) {
  const step = 10 ** Math.floor(Math.log10(high - low) - 2);
  const label = `${q.name} ${words}`;
  const number = make("input", { type: "number", step: "any", value: Number(value.toPrecision(4)), "aria-label": `${label}, number` });
  const bar = make("input", { type: "range", min: low, max: high, step, value, "aria-label": label });
  bar.addEventListener("input", () => { number.value = String(Number(Number(bar.value).toPrecision(6))); });
  number.addEventListener("input", () => { bar.value = number.value; });
  return { made: make("div", { class: "slider" }, make("span", {}, words), bar, number, make("span", { class: "unit" }, q.unit)), value: () => Number(number.value) };
}

/** @param {any} asked @param {any} shown */
async function run(asked, { place, said, trouble, bar, go, stop }) {
  running?.abort();
  const mine = running = new AbortController();
  tell(trouble, null);
  go.disabled = true;
  stop.disabled = bar.hidden = false;
  bar.value = 0;
  said.textContent = "Running …";
  /** @type {any[]} */
  let axes = [];
  /** @type {any[][]} */
  const rows = [];
  let [kept, unit] = ["", ""];
  let drawing = 0;
  const draw = () => {
    drawing = 0;
    const z = { name: asked.output, unit };
    const [x, y] = axes.map((a) => ({ ...a, unit: unitOf(a.name) }));
    place.replaceChildren(y ? map(x, y, z, rows)
      : curves({ ...x, values: x.values.slice(0, rows.length) }, [{ ...z, values: rows.map((r) => r[0]) }],
        { across: [x.values[0], x.values[x.values.length - 1]].sort((a, b) => a - b) }));
  };
  try {
    await follow("sweep", asked, mine.signal, (message) => {
      if (message.error) { tell(trouble, message.error); said.textContent = ""; }
      if (message.answer) said.replaceChildren(...summary(message.answer.data, kept, unit));
      if (message.part?.axes) axes = message.part.axes;
      if (message.part?.rows) {
        rows.splice(message.part.start, message.part.rows.length, ...message.part.rows);
        [kept, unit] = [message.part.name, message.part.unit];
        bar.value = rows.length / axes[0].values.length;
        drawing ||= requestAnimationFrame(draw);
      }
    });
  } catch (error) {
    if (!mine.signal.aborted) throw error instanceof Lost ? error : new Lost("The app ended while the sweep was running.");
    if (mine === running) said.textContent = `Stopped after ${rows.length} of ${axes[0]?.values.length ?? "?"} rows.`;
  } finally {
    if (mine === running) {
      running = null;
      go.disabled = false;
      stop.disabled = bar.hidden = true;
    }
  }
}

/** @param {string} name */
const unitOf = (name) => model.units[name] ?? "";

/** @param {string} name @param {number} x @param {string} unit */
const valued = (name, x, unit) => `${name} = ${figure(x)}${unit && " "}${unit}`;

/** The numbers of a sweep in words: of what was asked, not of what else a run stores. @param {any} data @param {string} kept @param {string} unit */
function* summary(data, kept, unit) {
  yield `${data.runs} runs. `;
  if (data.failed) yield make("strong", {}, `${data.failed} of them failed. `);
  const r = data.results.find((/** @type {any} */ found) => found.name === kept);
  if (r) {
    const [least, mean, greatest] = [r.least, r.mean, r.greatest].map((x) => `${figure(x)}${unit && " "}${unit}`);
    const where = Object.entries(r.where).map(([name, x]) => valued(name, x, unitOf(name))).join(", ");
    yield `${r.name}: least ${least}, mean ${mean}, greatest ${greatest} at ${where}. `;
  }
  for (const notice of data.notices) yield `Note: ${notice}. `;
}
