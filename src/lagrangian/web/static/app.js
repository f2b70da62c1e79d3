/** Starts the app: takes the token, asks for the models, and shows one view at a time. */

import { startAnswer } from "./answer.js";
import { ask, Lost, takeToken } from "./ask.js";
import { startEditor } from "./editor.js";
import { startModels } from "./models.js";
import { startMotion } from "./motion.js";
import { byId } from "./page.js";
import { kept, model, open, whenOpened } from "./state.js";
import { startSweep } from "./sweep.js";

const VIEWS = ["models", "editor", "answer", "motion", "sweep"];

/** @param {unknown} error */
function lose(error) {
  const panel = byId("lost");
  panel.hidden = false;
  panel.textContent = error instanceof Lost ? error.message : `This should not happen: ${error}`;
  if (!(error instanceof Lost)) console.error(error);
}

/** Show the view that the address names. @param {boolean} [focus] */
function route(focus = true) {
  const named = location.hash.slice(1);
  if (named === "main") return;
  const wanted = VIEWS.includes(named) ? named : "models";
  const view = wanted !== "models" && !model.text ? "models" : wanted;
  for (const name of VIEWS) byId(`view-${name}`).hidden = name !== view;
  for (const link of document.querySelectorAll(".bar nav a")) {
    if (link.getAttribute("href") === `#${view}`) link.setAttribute("aria-current", "page");
    else link.removeAttribute("aria-current");
  }
  document.body.dataset.view = view;
  scrollTo(0, 0);
  const words = byId(`${view}-title`).textContent;
  document.title = `${words} – lagrangian`;
  if (focus) byId(`${view}-title`).focus({ preventScroll: true });
  document.dispatchEvent(new CustomEvent("shown", { detail: view }));
}

async function start() {
  takeToken();
  const { examples, opened } = await ask("models");
  startEditor(lose);
  startAnswer(lose);
  startMotion(lose);
  startSweep(lose);
  startModels(examples);
  whenOpened(() => { byId("file-name").textContent = model.name; });
  addEventListener("hashchange", () => route());
  const before = kept();
  const first = before ?? opened;
  if (first) open(first.name, first.text);
  if (first && !location.hash) history.replaceState(null, "", "#editor");
  route(false);
  document.body.classList.add("started");
}

start().catch(lose);
