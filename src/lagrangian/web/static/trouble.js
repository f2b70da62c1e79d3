/** How a mistake is told: where it is, what it is, and how to fix it. */

import { make } from "./page.js";

/** @typedef {import("./ask.js").Trouble} Trouble */

/** @param {string} words */
const sentence = (words) => words && `${words[0].toUpperCase()}${words.slice(1)}${/[.?!…]$/.test(words) ? "" : "."}`;

/**
 * Show a mistake in its panel, or hide the panel.
 * @param {HTMLElement} panel
 * @param {Trouble|null} trouble
 * @param {{go?: (line: number, column?: number|null) => void, anyway?: () => void}} [acts]
 */
export function tell(panel, trouble, { go, anyway } = {}) {
  panel.hidden = trouble === null;
  if (trouble === null) return panel.replaceChildren();
  const { line, column, element, what, fix, code } = trouble;
  const head = make("p", {});
  if (line && go) {
    const where = `Line ${line}${column ? `, column ${column}` : ""}`;
    head.append(make("button", { type: "button", class: "link", onclick: () => go(line, column) }, where), ": ");
  }
  head.append(make("strong", {}, sentence([element, what].filter(Boolean).join(": "))));
  if (code) head.append(" ", make("span", { class: "code" }, code));
  panel.replaceChildren(head);
  if (fix) panel.append(make("p", {}, sentence(fix)));
  if (trouble.anyway && anyway) {
    panel.append(make("button", { type: "button", onclick: anyway }, "Try anyway"));
  }
}
