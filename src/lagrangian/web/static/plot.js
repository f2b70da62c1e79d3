/** Plots as SVG: curves over one quantity, and a map over two. */

import { make, shape } from "./page.js";

/** The size of a plot in pixels; on a narrow screen it is small, so that its letters are not. */
let [width, height] = [640, 380];
const LEFT = 62;
const RIGHT = 16;
const TOP = 14;
const BOTTOM = 46;
const DASHES = ["", "7 4", "2 3", "9 3 2 3"];

/** @typedef {{name: string, unit: string, values: (number|null)[]}} Quantity */

/** A number in a few digits. @param {number} x @param {number} [digits] */
export function figure(x, digits = 4) {
  if (x === 0) return "0";
  const shown = Number(x.toPrecision(digits));
  const size = Math.abs(shown);
  return (size >= 1e5 || size < 1e-3 ? shown.toExponential() : String(shown)).replace("-", "−");
}

/** @param {{name: string, unit: string}} quantity */
export const labelled = ({ name, unit }) => (unit ? `${name} [${unit}]` : name);

/** Round numbers from low to high. @param {number} low @param {number} high @param {number} [count] */
function ticks(low, high, count = 5) {
  const rough = (high - low) / count;
  const power = 10 ** Math.floor(Math.log10(rough));
  const step = power * ([1, 2, 5, 10].find((k) => k * power >= rough) ?? 10);
  const found = [];
  for (let k = Math.ceil(low / step - 1e-9); k * step <= high + step * 1e-9; k++) found.push(k * step);
  return found;
}

/** The least and the greatest number, a little apart where they are equal. @param {(number|null)[]} values */
function range(values) {
  let low = Infinity;
  let high = -Infinity;
  for (const x of values) {
    if (x === null) continue;
    low = Math.min(low, x);
    high = Math.max(high, x);
  }
  if (low > high) return [0, 1];
  const apart = high - low || Math.abs(high) * 0.1 || 1;
  return high - low > 0 ? [low, high] : [low - apart / 2, high + apart / 2];
}

/** Axes with their numbers. @param {any} picture @param {Quantity} x @param {Quantity} y
 *  @param {number[]} across @param {number[]} up */
function axes(picture, x, y, across, up) {
  const px = (/** @type {number} */ v) => LEFT + ((v - across[0]) / (across[1] - across[0])) * (width - LEFT - RIGHT);
  const py = (/** @type {number} */ v) => height - BOTTOM - ((v - up[0]) / (up[1] - up[0])) * (height - TOP - BOTTOM);
  for (const v of ticks(across[0], across[1], width / 100)) {
    picture.append(shape("line", { class: "grid", x1: px(v), x2: px(v), y1: TOP, y2: height - BOTTOM }),
      shape("text", { x: px(v), y: height - BOTTOM + 18, "text-anchor": "middle" }, figure(v)));
  }
  for (const v of ticks(up[0], up[1])) {
    picture.append(shape("line", { class: "grid", x1: LEFT, x2: width - RIGHT, y1: py(v), y2: py(v) }),
      shape("text", { x: LEFT - 8, y: py(v) + 4, "text-anchor": "end" }, figure(v)));
  }
  picture.append(
    shape("rect", { class: "frame", x: LEFT, y: TOP, width: width - LEFT - RIGHT, height: height - TOP - BOTTOM }),
    shape("text", { class: "name", x: (LEFT + width - RIGHT) / 2, y: height - 8, "text-anchor": "middle" }, labelled(x)),
    shape("text", { class: "name", transform: `translate(14 ${(TOP + height - BOTTOM) / 2}) rotate(-90)`, "text-anchor": "middle" },
      labelled(y)));
  return { px, py };
}

/** A new plot without anything in it yet. @param {string} words */
function picture(words) {
  [width, height] = matchMedia("(max-width: 45rem)").matches ? [360, 290] : [640, 380];
  return shape("svg", { class: "plot", viewBox: `0 0 ${width} ${height}`, role: "img", "aria-label": words });
}

/**
 * Curves over a quantity, each with its dash and colour, and a legend where there are several.
 * @param {Quantity} x
 * @param {Quantity[]} lines
 * @param {{across?: number[]}} [given]
 */
export function curves(x, lines, { across = range(x.values) } = {}) {
  const made = picture(`${lines.map((line) => line.name).join(", ")} over ${x.name}`);
  const up = range(lines.flatMap((line) => line.values));
  const room = (up[1] - up[0]) * 0.05;
  const units = new Set(lines.map((line) => line.unit));
  const y = { name: lines.map((line) => line.name).join(", "), unit: units.size === 1 ? [...units][0] : "", values: [] };
  const { px, py } = axes(made, x, y, across, [up[0] - room, up[1] + room]);
  lines.forEach((line, k) => {
    let path = "";
    let pen = false;
    line.values.forEach((v, i) => {
      const at = x.values[i];
      if (v === null || at === null) { pen = false; return; }
      path += `${pen ? "L" : "M"}${px(at).toFixed(1)} ${py(v).toFixed(1)}`;
      pen = true;
    });
    made.append(shape("path", { class: `curve curve-${k % 6}`, d: path, "stroke-dasharray": DASHES[Math.floor(k / 6) % 4] }));
    if (line.values.length < 30) {
      line.values.forEach((v, i) => v !== null && made.append(
        shape("circle", { class: `dot curve-${k % 6}`, cx: px(Number(x.values[i])), cy: py(v), r: 3 })));
    }
  });
  if (lines.length === 1) return made;
  const legend = lines.map((line, k) => make("li", {}, make("span", { class: `swatch curve-${k % 6}` }), line.name));
  return make("div", {}, made, make("ul", { class: "legend" }, ...legend));
}

/** From the least (0) to the greatest (1): dark blue to light yellow, as even in lightness as viridis.
 *  @param {number} s */
function colour(s) {
  const stops = [[68, 1, 84], [59, 82, 139], [33, 145, 140], [94, 201, 98], [253, 231, 37]];
  const at = Math.min(Math.max(s, 0), 1) * (stops.length - 1);
  const k = Math.min(Math.floor(at), stops.length - 2);
  const mixed = stops[k].map((c, i) => Math.round(c + (at - k) * (stops[k + 1][i] - c)));
  return `rgb(${mixed.join(" ")})`;
}

/**
 * A map over two quantities; a value that is not there yet is undefined, that of a run that failed null.
 * @param {Quantity} x @param {Quantity} y @param {{name: string, unit: string}} z
 * @param {(number|null|undefined)[][]} rows values by x, then y
 */
export function map(x, y, z, rows) {
  const made = picture(`${z.name} over ${x.name} and ${y.name}`);
  const [low, high] = range(rows.flat().filter((v) => v !== undefined).map((v) => v ?? null));
  const side = (/** @type {Quantity} */ q) => {
    const [a, b] = range(q.values);
    const half = (b - a) / (q.values.length - 1) / 2;
    return [a - half, b + half];
  };
  const { px, py } = axes(made, x, y, side(x), side(y));
  const w = Math.abs(px(Number(x.values[1])) - px(Number(x.values[0])));
  const h = Math.abs(py(Number(y.values[1])) - py(Number(y.values[0])));
  const frame = made.querySelector(".frame");
  rows.forEach((row, i) => row?.forEach((v, j) => {
    if (v === undefined) return;
    const left = px(Number(x.values[i])) - w / 2;
    const top = py(Number(y.values[j])) - h / 2;
    const cell = shape("rect", { class: v === null ? "cell failed" : "cell", x: left, y: top, width: w + 0.4, height: h + 0.4 },
      shape("title", {}, `${x.name} = ${figure(Number(x.values[i]))}, ${y.name} = ${figure(Number(y.values[j]))}: ` +
        (v === null ? "failed" : `${figure(v)} ${z.unit}`)));
    if (v !== null) cell.setAttribute("fill", colour((v - low) / (high - low)));
    made.insertBefore(cell, frame);
  }));
  const scale = shape("svg", { class: "scale", viewBox: "0 0 100 10", preserveAspectRatio: "none", "aria-hidden": "true" });
  for (let k = 0; k < 50; k++) scale.append(shape("rect", { x: 2 * k, y: 0, width: 2.1, height: 10, fill: colour((k + 0.5) / 50) }));
  return make("div", {}, made,
    make("p", { class: "map-key" }, labelled(z), make("span", {}, figure(low)), scale, make("span", {}, figure(high))));
}
