/** The motion: the page of the model, which integrates by itself; where a browser cannot, a run as curves over time. */

import { ask } from "./ask.js";
import { byId, make, settled } from "./page.js";
import { curves, figure } from "./plot.js";
import { about, model } from "./state.js";
import { tell } from "./trouble.js";

let madeOf = "";

/** @param {(error: unknown) => void} lose */
export function startMotion(lose) {
  const fresh = () => {
    if (document.body.dataset.view !== "motion" || !model.data || madeOf === model.dataOf) return;
    madeOf = model.dataOf;
    start(lose).catch(lose);
  };
  document.addEventListener("shown", fresh);
  document.addEventListener("derived", fresh);
}

/** @param {(error: unknown) => void} lose */
async function start(lose) {
  const text = madeOf;
  byId("motion-lead").textContent = model.data.name;
  byId("motion").replaceChildren(make("p", { class: "state busy", role: "status" }, "Building the motion …"));
  const answer = await ask("page", about());
  if (text !== madeOf) return;
  document.body.classList.toggle("moving", !answer.error);
  if (answer.error) return build(lose, answer.error);
  byId("motion").replaceChildren(make("iframe", {
    src: answer.address, sandbox: "allow-scripts allow-downloads", title: `The motion of ${model.data.name}`,
  }));
}

/** @param {(error: unknown) => void} lose @param {import("./ask.js").Trouble} reason why there is no page */
function build(lose, reason) {
  const { parameters, coordinates } = model.data;
  const place = make("div", { class: "plots" });
  const said = make("p", { class: "small", role: "status" });
  const trouble = make("div", { class: "trouble", role: "status", hidden: true });
  const fields = [
    field("duration", "", "as the model says"),
    ...coordinates.flatMap((/** @type {any} */ c) => [field(c.name, "initial", "start"), field(`${c.name}'`, "initial", "rate at the start")]),
    ...parameters.map((/** @type {any} */ p) => field(p.name, "params", p.value_si === null ? "no value" : figure(p.value_si))),
  ];
  const act = () => {
    /** @type {any} */
    const asked = { ...about(), initial: {}, params: {} };
    for (const f of fields) {
      const text = f.input.value.trim();
      if (!text) continue;
      if (f.group) asked[f.group][f.name] = text;
      else asked.duration = text;
    }
    said.textContent = "Running …";
    ask("simulate", asked).then((answer) => show(answer, { place, said, trouble })).catch(lose);
  };
  const form = make("form", { class: "values", oninput: settled(act, 500), onsubmit: (/** @type {Event} */ e) => { e.preventDefault(); act(); } },
    ...fields.map((f) => f.made), make("button", { type: "submit", class: "primary" }, "Run"));
  const why = make("div", { class: "trouble" });
  tell(why, reason);
  byId("motion").replaceChildren(why, make("p", { class: "small" }, "Here the app computes the run and shows it as curves."), make("div", { class: "panes narrow" },
    make("div", { class: "pane" }, make("h2", {}, "Values"), make("p", { class: "small" }, "SI units, or with a unit: 30 deg, 12 mm. What is left empty is taken from the model."), form),
    make("div", { class: "pane" }, trouble, place, said)));
  act();
}

/** @param {string} name @param {string} group @param {string} placeholder */
function field(name, group, placeholder) {
  const input = make("input", { type: "text", placeholder, size: 10, spellcheck: "false", autocomplete: "off" });
  return { name, group, input, made: make("label", {}, make("span", {}, name), input) };
}

/** @param {any} answer @param {any} shown */
function show(answer, { place, said, trouble }) {
  tell(trouble, answer.error ?? null);
  place.classList.toggle("old", Boolean(answer.error));
  said.textContent = "";
  if (answer.error) return;
  const { t, columns } = answer.curves;
  const time = { name: "t", unit: "s", values: t };
  const own = new Set(model.data.coordinates.map((/** @type {any} */ c) => c.name));
  const groups = new Map();
  for (const c of columns.filter((/** @type {any} */ c) => own.has(c.name))) groups.set(c.unit, [...(groups.get(c.unit) ?? []), c]);
  const energies = columns.filter((/** @type {any} */ c) => c.name.startsWith("energy.") && c.name !== "energy.supplied")
    .map((/** @type {any} */ c) => ({ ...c, name: c.name === "energy.kinetic" ? "T*" : "V" }));
  place.replaceChildren(...[...groups.values()].map((g) => curves(time, g.slice(0, 6))), curves(time, energies));
  const { message, steps, method, balance, stuck } = answer.data;
  said.textContent = `${message[0].toUpperCase()}${message.slice(1)}. ${method}, ${steps} steps; the ${balance.kind} is missed by ${figure(balance.missed_by, 2)}.${Object.entries(stuck).map(frictionWords).join("")}`;
}

/** How often and how long a friction sticks.
 * @param {[string, [number, number][]]} entry */
function frictionWords([name, spans]) {
  if (!spans.length) return ` Friction ${name} slips all the time.`;
  const seconds = spans.reduce((sum, [from, to]) => sum + to - from, 0);
  return ` Friction ${name} sticks ${spans.length === 1 ? "once" : `${spans.length} times`}, ${figure(seconds, 3)} s in all.`;
}
