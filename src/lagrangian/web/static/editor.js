/** The editor: a model as text, and its derivation, made again whenever the text rests. */

import { ask, Lost } from "./ask.js";
import { adopted, byId, download, make, settled } from "./page.js";
import { draw } from "./schematic.js";
import { about, keep, model, whenOpened } from "./state.js";
import { tell } from "./trouble.js";
import { Writing } from "./writing.js";

const PATIENCE = 1500;

/** @type {Writing} */
let writing;
/** @type {AbortController|null} */
let asking = null;
let askedAt = 0;
let again = false;

/** @param {(error: unknown) => void} lose what to do when the app does not answer */
export function startEditor(lose) {
  const derive = () => deriveNow().catch(lose);
  const soon = settled(derive);
  writing = new Writing(byId("model-editor"), {
    label: "The model, as TOML",
    describedby: "model-error",
    toml: true,
    changed: () => {
      model.text = writing.text;
      model.anyway = false;
      keep();
      dim();
      soon();
    },
  });
  byId("save-model").addEventListener("click", () => download(model.name, model.text));
  byId("notation").addEventListener("change", derive);
  document.addEventListener("keydown", (event) => {
    if ((event.ctrlKey || event.metaKey) && event.key === "s") {
      event.preventDefault();
      download(model.name, model.text);
    }
  });
  whenOpened(() => {
    writing.text = model.text;
    byId("derivation").replaceChildren();
    tell(byId("model-error"), null);
    derive();
  });
}

/** The derivation that is shown no longer fits the text. */
function dim() {
  byId("derivation").classList.add("old");
}

/** @param {string} words @param {string} [kind] */
function say(words, kind = "") {
  const state = byId("derive-state");
  state.textContent = words;
  state.className = `state ${kind}`;
}

/** Derive the text as it is now; one request at a time, and one that takes long is given up for the newest text. */
async function deriveNow() {
  if (asking !== null) {
    again = true;
    const late = asking;
    setTimeout(() => again && asking === late && late.abort(), Math.max(0, askedAt + PATIENCE - performance.now()));
    return;
  }
  again = false;
  asking = new AbortController();
  askedAt = performance.now();
  const text = model.text;
  say("Deriving …", "busy");
  try {
    const answer = await ask("derive", { ...about(), notation: byId("notation").value }, asking.signal);
    if (text === model.text) show(answer, text);
  } catch (error) {
    if (error instanceof Lost || !asking.signal.aborted) throw error;
  } finally {
    asking = null;
    if (again) deriveNow();
  }
}

/** @param {any} answer @param {string} text */
function show(answer, text) {
  const acts = { go: writing.go.bind(writing), anyway: () => { model.anyway = true; deriveNow(); } };
  tell(byId("model-error"), answer.error ?? null, acts);
  if (answer.error) {
    const { line, column, what } = answer.error;
    writing.mark(line ? [{ line, column, kind: "wrong", words: what }] : []);
    dim();
    say(model.data ? "The last derivation without a mistake" : "Not derived", "wrong");
    return;
  }
  writing.mark([]);
  const changed = model.dataOf !== text;
  model.data = answer.data;
  model.units = answer.units;
  model.dataOf = text;
  const sheet = byId("derivation");
  const closed = new Set([...sheet.querySelectorAll("details.step:not([open])")].map((d) => d.dataset.step));
  const marker = make("h2", { class: "name" }, answer.title);
  const drawn = changed ? null : sheet.querySelector(".part-look");
  sheet.replaceChildren(marker, ...(drawn ? [drawn] : []), ...inOrder(answer.sections).map((s) => {
    const made = make("div", { class: `part part-${s.anchor}` }, adopted(s.html));
    const step = made.querySelector("details.step");
    if (step) {
      step.dataset.step = s.anchor;
      step.open = !closed.has(s.anchor);
    }
    return made;
  }));
  sheet.classList.remove("old");
  const checks = answer.data.verified;
  const failed = checks.filter((/** @type {any} */ c) => c.holds === false).length;
  say(failed ? `${failed} checks fail` : `${checks.length} checks hold`, failed ? "wrong" : "right");
  draw(() => model.dataOf === text && sheet.contains(marker)).catch(() => {});
  if (changed) document.dispatchEvent(new CustomEvent("derived"));
}

/** The result first, as it is what most people look for; then the steps that lead to it.
 *  @param {{anchor: string, html: string}[]} sections */
function inOrder(sections) {
  const first = ["notices", "result"];
  return [...sections].sort((a, b) => rank(a) - rank(b));
  function rank(/** @type {{anchor: string}} */ s) {
    const at = first.indexOf(s.anchor);
    return at < 0 ? first.length : at;
  }
}
