/** Making elements, and taking over HTML that the server wrote. */

const PLAIN = "section details summary h2 h3 p span div ul ol li table thead tbody tr th td pre wbr";
const MATH =
  "math mrow mi mn mo mtext mspace msup msub msubsup mfrac msqrt mroot mover munder munderover mtable mtr mtd mstyle";
const SHAPES = "svg g path circle ellipse rect line polyline polygon text tspan title desc defs marker";
const ELEMENTS = new Set(`${PLAIN} ${MATH} ${SHAPES}`.split(" "));
const NEVER = /^(on|href|src|style$|id$|name$|xlink)/;

/**
 * Make an element. Properties whose name begins with "on" are listeners, others are attributes.
 * @param {string} name
 * @param {Record<string, any>} [given]
 * @param {...(Node|string|null)} children
 * @returns {any}
 */
export function make(name, given = {}, ...children) {
  const made = document.createElement(name);
  for (const [key, value] of Object.entries(given)) {
    if (key.startsWith("on")) made.addEventListener(key.slice(2), value);
    else if (value === true) made.setAttribute(key, "");
    else if (value !== false && value != null) made.setAttribute(key, String(value));
  }
  made.append(...children.filter((child) => child !== null));
  return made;
}

/**
 * Make a shape of a picture.
 * @param {string} name
 * @param {Record<string, any>} [given]
 * @param {...(Node|string)} children
 * @returns {any}
 */
export function shape(name, given = {}, ...children) {
  const made = document.createElementNS("http://www.w3.org/2000/svg", name);
  for (const [key, value] of Object.entries(given)) made.setAttribute(key, String(value));
  made.append(...children);
  return made;
}

/** @param {string} id @returns {any} */
export const byId = (id) => document.getElementById(id);

/**
 * HTML of the server as nodes: only elements and attributes of a page of mathematics, whatever else is in it.
 * @param {string} html
 */
export function adopted(html) {
  const parsed = new DOMParser().parseFromString(html, "text/html");
  const made = document.createDocumentFragment();
  for (const child of parsed.body.childNodes) copy(child, made);
  return made;
}

/** @param {Node} from @param {Node} to */
function copy(from, to) {
  if (from.nodeType === Node.TEXT_NODE) to.appendChild(document.createTextNode(from.nodeValue ?? ""));
  if (!(from instanceof Element) || !ELEMENTS.has(from.localName)) return;
  const made = document.createElementNS(from.namespaceURI, from.localName);
  for (const { name, value } of from.attributes) {
    if (!NEVER.test(name) && !/url\s*\(|javascript:/i.test(value)) made.setAttribute(name, value);
  }
  for (const child of from.childNodes) copy(child, made);
  to.appendChild(made);
}

/**
 * Let a browser save a text as a file.
 * @param {string} name
 * @param {string} text
 */
export function download(name, text) {
  const address = URL.createObjectURL(new Blob([text], { type: "text/plain;charset=utf-8" }));
  make("a", { href: address, download: name }).click();
  setTimeout(() => URL.revokeObjectURL(address), 1000);
}

/**
 * A function that waits until it has not been called for a while.
 * @param {() => void} act
 * @param {number} [wait] milliseconds
 */
export function settled(act, wait = 300) {
  let timer = 0;
  return () => {
    clearTimeout(timer);
    timer = setTimeout(act, wait);
  };
}
