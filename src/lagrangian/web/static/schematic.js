/** The schematic over the derivation; terms of the equations and parts of the picture light each other. */

import { ask } from "./ask.js";
import { adopted, byId, make } from "./page.js";
import { about } from "./state.js";

const style = new CSSStyleSheet();

/** Draw the model that was derived just now. @param {() => boolean} current whether it is still the one that is shown */
export async function draw(current) {
  const answer = await ask("look", about());
  if (!current()) return;
  const sheet = byId("derivation");
  sheet.querySelector(".part-look")?.remove();
  if (answer.error) return;
  style.replaceSync(answer.style);
  document.adoptedStyleSheets = [style];
  const place = make("figure", { class: "part part-look" }, adopted(answer.svg));
  if (answer.missing.length) {
    const said = answer.missing.map((/** @type {string} */ words) => make("li", {}, words));
    place.append(make("details", {}, make("summary", {}, "What is not drawn"), make("ul", {}, ...said)));
  }
  sheet.querySelector(".name").after(place);
  light(sheet, answer.elements);
}

/** @param {HTMLElement} sheet @param {Record<string, string>} titles */
function light(sheet, titles) {
  const byWord = new Map(Object.keys(titles).map((name) => [name.split(/\s+/).join("\u00a0"), name]));
  const parts = [...sheet.querySelectorAll(".part-look [data-element]")].map((node) => ({
    node, names: (node.getAttribute("data-element") ?? "").split(" ").map((word) => byWord.get(word) ?? word),
  }));
  const terms = [...sheet.querySelectorAll(".term[data-from]")].map((node) => {
    const from = `, ${node.getAttribute("data-from")}, `;
    return { node, names: Object.keys(titles).filter((name) => from.includes(`, ${titles[name]}, `)) };
  });
  const all = [...parts, ...terms];
  const choose = (/** @type {string[]} */ names) => {
    sheet.classList.toggle("choosing", names.length > 0);
    for (const { node, names: own } of all) node.classList.toggle("lit", own.some((name) => names.includes(name)));
  };
  describe(parts, titles);
  for (const { node, names } of all) {
    if (!names.some((name) => name in titles)) continue;
    const reached = node.matches("[tabindex]"); // what listens to the focus gets it in some browsers, named or not
    for (const event of ["pointerenter", ...(reached ? ["focus"] : [])]) node.addEventListener(event, () => choose(names));
    for (const event of ["pointerleave", ...(reached ? ["blur"] : [])]) node.addEventListener(event, () => choose([]));
  }
}

/**
 * The keyboard reaches one glyph of each element, which has its name.
 * @param {{ node: Element, names: string[] }[]} parts
 * @param {Record<string, string>} titles
 */
function describe(parts, titles) {
  const described = new Set();
  for (const { node, names } of parts) {
    const words = names.map((name) => titles[name] ?? name).join(", ");
    if (!words || described.has(words)) continue;
    described.add(words);
    for (const [key, value] of [["tabindex", "0"], ["role", "img"], ["aria-label", words]]) node.setAttribute(key, value);
    node.closest("svg")?.setAttribute("role", "group");
  }
}
