"use strict";
// What is on the page: its elements by name, its status line and its colours, and how it writes numbers.

function element(id) {
  return document.getElementById(id);
}

/** What happens when something is done to an element. */
function on(id, event, act) {
  element(id).addEventListener(event, act);
}

/** Whether a button is down, also for those who do not see it. */
function press(knob, down) {
  knob.setAttribute("aria-pressed", String(down));
}

/** Write into the status line, which is read aloud when it changes. */
function say(words) {
  if (element("status").textContent !== words) element("status").textContent = words;
}

function digits(x, n = 3) {
  if (x === 0 || Math.abs(x) < 1e-12) return "0";
  const size = Math.abs(x);
  const text = size >= 1e5 || size < 1e-3 ? x.toExponential(n - 1).replace("e+", "e") : x.toFixed(Math.max(0, n - 1 - Math.floor(Math.log10(size))));
  return (size < 0.01 ? text.replace(/(\.\d*?)0+(?=e|$)/, "$1").replace(/\.(?=e|$)/, "") : text).replaceAll("-", "−");
}

function readColours() {
  const style = getComputedStyle(element("drawing").querySelector("svg") ?? document.documentElement), colour = (name) => style.getPropertyValue(`--${name}`).trim();
  const found = Object.fromEntries(["ink", "soft", "line", "accent", "axis", "stiffness", "damping", "gravity", "input", "velocity"].map((name) => [name, colour(name)]));
  const roles = Object.fromEntries(["body", "rod", "ground", "stiffness", "damping", "friction", "gravity", "input", "coordinate", "constraint", "thin", "inside"].map((role) => [role, colour(`scene-${role}`)]));
  return { ...found, ...roles, paper: colour("panel"), series: [found.accent, found.damping, found.stiffness, found.velocity, found.input, found.gravity] };
}
