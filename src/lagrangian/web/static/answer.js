/** The answer box: what was typed, how it reads, and the verdict. */

import { ask, Lost } from "./ask.js";
import { adopted, byId, make, settled } from "./page.js";
import { about, model, whenOpened } from "./state.js";
import { tell } from "./trouble.js";
import { Writing } from "./writing.js";

/** @type {Writing} */
let writing;
/** @type {{abort: AbortController, judging: boolean}|null} */
let asking = null;
/** @type {"preview"|"check"|null} */
let wanted = null;
/** The text of the verdict that is shown. @type {string|null} */
let judged = null;

/** @param {(error: unknown) => void} lose */
export function startAnswer(lose) {
  const soon = settled(() => read("preview").catch(lose));
  const check = () => read("check").catch(lose);
  writing = new Writing(byId("answer-editor"), {
    label: "Your answer: equations, energies or generalized forces, one a line",
    describedby: "answer-names answer-error",
    rows: 9,
    changed: () => {
      judged = null;
      byId("verdict").classList.add("old");
      byId("answer-report").classList.add("old");
      writing.mark([]);
      soon();
    },
  });
  byId("check-answer").addEventListener("click", check);
  for (const choice of document.querySelectorAll("input[name=hint]")) {
    choice.addEventListener("change", () => byId("verdict").firstChild && check());
  }
  byId("answer-editor").addEventListener("keydown", (/** @type {KeyboardEvent} */ event) => {
    if (event.key === "Enter" && (event.ctrlKey || event.metaKey)) {
      event.preventDefault();
      check();
    }
  });
  whenOpened(() => { writing.text = ""; clear(); });
  document.addEventListener("derived", names);
}

/** Say which names an answer to this model may use. */
function names() {
  const { name, coordinates, parameters, inputs } = model.data;
  byId("answer-model").textContent = name;
  const listed = (/** @type {any[]} */ things) => things.map((x) => x.name).join(", ");
  const first = coordinates[0]?.name ?? "x";
  byId("answer-names").replaceChildren(
    "Coordinates ", make("b", {}, listed(coordinates)), "; given ", make("b", {}, listed([...parameters, ...inputs])),
    ". Rates and accelerations: ", make("code", {}, `${first}'`), ", ", make("code", {}, `${first}''`),
    ". Write equations, T = …, V = …, L = … or Xi_1 = …, in plain text or LaTeX.");
}

function clear() {
  judged = null;
  for (const id of ["verdict", "answer-lines", "answer-report"]) byId(id).replaceChildren();
  tell(byId("answer-error"), null);
  byId("answer-state").textContent = "";
}

/** Have the answer read, or judged too; one request at a time, and the newest wish is the next.
 *  @param {"preview"|"check"} verb */
async function read(verb) {
  if (asking) {
    wanted = wanted === "check" ? "check" : verb;
    if (verb === "check" && asking.judging) asking.abort.abort();
    return;
  }
  if (!writing.text.trim()) return clear();
  if (verb === "preview" && writing.text === judged) return;
  const mine = asking = { abort: new AbortController(), judging: verb === "check" };
  const hint = Number(/** @type {any} */ (document.querySelector("input[name=hint]:checked")).value);
  const text = writing.text;
  if (verb === "check") byId("answer-state").textContent = "Checking …";
  try {
    const asked = { ...about(), answer: text, ...(verb === "check" ? { hint } : {}) };
    const answer = await ask(verb, asked, mine.abort.signal);
    if (text === writing.text) show(answer, verb);
  } catch (error) {
    if (error instanceof Lost || !mine.abort.signal.aborted) throw error;
  } finally {
    asking = null;
    const next = wanted;
    wanted = null;
    if (next) await read(next);
  }
}

/** @param {any} answer @param {string} verb */
function show(answer, verb) {
  byId("answer-state").textContent = "";
  const error = answer.error ?? null;
  const own = error?.message?.startsWith("answer:") || error?.status !== 200;
  const told = error && !own ? { ...error, what: `the model has a mistake: ${error.what}`, line: null } : error;
  tell(byId("answer-error"), told, { go: writing.go.bind(writing) });
  if (error) {
    writing.mark(own && error.line ? [{ line: error.line, column: error.column, kind: "wrong", words: error.what }] : []);
    return;
  }
  const findings = answer.data?.lines ?? [];
  byId("answer-lines").replaceChildren(...answer.lines.map((/** @type {any} */ line) => lineOf(line, findings)));
  judged = verb === "check" ? writing.text : null;
  byId("answer-state").textContent = (answer.notes ?? []).join(" ");
  if (verb !== "check") return;
  writing.mark(findings.map((/** @type {any} */ f) => ({
    line: f.line, kind: f.right ? "right" : "wrong", words: f.verdict,
  })));
  const { right, verdict } = answer.data;
  const half = verdict === "incomplete";
  byId("verdict").replaceChildren(make("p", { class: `verdict ${right ? "right" : half ? "half" : "wrong"}`, role: "status" },
    make("span", { "aria-hidden": "true" }, right ? "✓" : half ? "…" : "✗"), ` ${capital(verdict)}`));
  byId("answer-report").replaceChildren(...answer.sections.map((/** @type {any} */ s) => adopted(s.html)));
  for (const id of ["verdict", "answer-report"]) byId(id).classList.remove("old");
}

/** @param {string} words */
const capital = (words) => words[0].toUpperCase() + words.slice(1);

/** @param {any} line @param {any[]} findings */
function lineOf(line, findings) {
  const finding = findings.find((f) => f.line === line.line && f.text === line.text);
  const mark = finding && make("span", { class: finding.right ? "mark right" : "mark wrong" },
    make("span", { "aria-hidden": "true" }, finding.right ? "✓" : "✗"),
    make("span", { class: "unseen" }, finding.verdict));
  const formula = line.html === null ? make("code", {}, line.text) : make("span", { class: "formula" }, adopted(line.html));
  return make("li", { value: line.line }, formula, mark ?? null);
}
