/** The models to open: built-in examples, a file, or a new one. */

import { ask } from "./ask.js";
import { byId, make } from "./page.js";
import { open, openNew } from "./state.js";

/** @typedef {{name: string, description: string, text: string}} Example */

/** @param {Example[]} examples */
export function startModels(examples) {
  const cards = byId("cards");
  const listed = examples.map((example) => ({ example, card: cardOf(example) }));
  cards.replaceChildren(...listed.map(({ card }) => card));
  drawSeen(listed);
  byId("search").addEventListener("input", (/** @type {any} */ event) => {
    const words = event.target.value.toLowerCase().split(/\s+/);
    let count = 0;
    for (const { example, card } of listed) {
      const said = `${example.name} ${example.description}`.toLowerCase();
      card.hidden = !words.every((/** @type {string} */ word) => said.includes(word));
      count += card.hidden ? 0 : 1;
    }
    byId("found").textContent = event.target.value ? `${count} of ${listed.length} examples` : "";
  });
  byId("new-model").addEventListener("click", () => { openNew(); location.hash = "editor"; });
  byId("open-file").addEventListener("change", (/** @type {any} */ event) => openFile(event.target.files[0]));
  document.addEventListener("dragover", (event) => event.preventDefault());
  document.addEventListener("drop", (event) => {
    event.preventDefault();
    const file = event.dataTransfer?.files[0];
    if (file) openFile(file);
  });
}

/** @param {File} file */
async function openFile(file) {
  if (!file) return;
  open(file.name, file.size > 2 ** 20 ? "# This file is larger than 1 MiB: it is not a model.\n" : await file.text());
  byId("open-file").value = "";
  location.hash = "editor";
}

/** @param {Example} example */
function cardOf({ name, description, text }) {
  const [topic, rest] = description.includes(": ") ? description.split(/: (.*)/s) : ["", description];
  const act = () => { open(`${name}.toml`, text); location.hash = "editor"; };
  return make("li", { class: "card" },
    make("button", { type: "button", onclick: act },
      make("span", { class: "card-name" }, name.replaceAll("-", " ")),
      topic ? make("span", { class: "card-topic" }, topic) : null,
      make("span", { class: "card-words" }, rest)));
}

/** Draw the examples that are in sight, one after another, as long as nobody works on a model.
 *  @param {{example: Example, card: HTMLElement}[]} listed */
function drawSeen(listed) {
  /** @type {Map<Element, Example>} */
  const waiting = new Map();
  let drawing = false;
  const next = async () => {
    if (drawing) return;
    drawing = true;
    for (const [card, example] of waiting) {
      if (document.body.dataset.view !== "models") break;
      waiting.delete(card);
      const answer = await ask("look", { model: example.text, name: `${example.name}.toml` }).catch(() => null);
      if (answer?.svg) card.querySelector("button")?.prepend(pictureOf(answer));
    }
    drawing = false;
  };
  const watching = new IntersectionObserver((entries) => {
    for (const { target, isIntersecting } of entries) {
      const example = listed.find(({ card }) => card === target)?.example;
      if (!isIntersecting || !example) continue;
      watching.unobserve(target);
      waiting.set(target, example);
    }
    next();
  });
  for (const { card } of listed) watching.observe(card);
  document.addEventListener("shown", next);
}

/** A schematic as an image: what is in it stays in it. @param {{svg: string, style: string}} answer */
function pictureOf({ svg, style }) {
  const whole = svg.replace(/(<svg[^>]*>)/, (head) => `${head}<style>${style}.lagrangian-scene{background:none!important}</style>`);
  return make("img", { src: `data:image/svg+xml,${encodeURIComponent(whole)}`, alt: "" });
}
