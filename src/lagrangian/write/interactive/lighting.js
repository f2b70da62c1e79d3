"use strict";
// Terms of equations and glyphs of the schematic light each other, and the elements that they stand for in the motion.

/** @param {PageState} state */
function lightEachOther(state) {
  const { elements } = state.data, drawing = element("drawing");
  /** In terms and glyphs, names are separated by spaces; a space within a name is a no-break space there. */
  const spelled = new Map(Object.keys(elements).map((name) => [name.split(/\s+/).join("\u00a0"), name]));
  const marked = (nodes) => [...nodes].map((node) => ({ node, names: node.getAttribute("data-element").split(" ").filter(Boolean).map((name) => spelled.get(name) ?? name) }));
  const glyphs = marked(drawing.querySelectorAll("[data-element]")), terms = marked(document.querySelectorAll(".term[data-element]"));
  const all = [...terms, ...glyphs];

  function light(names) {
    const lit = (state.lit = names && new Set(names));
    for (const { node, names: own } of all) node.classList.toggle("lit", lit !== null && own.some((name) => lit.has(name)));
    document.body.classList.toggle("choosing", lit !== null);
    state.stale = true;
  }

  describe(glyphs, elements);
  for (const { node, names } of all) {
    if (!names.length) continue;
    const reached = node.matches("[tabindex]"); // what listens to the focus gets it in some browsers, named or not
    for (const name of ["pointerenter", ...(reached ? ["focus"] : [])]) node.addEventListener(name, () => light(names));
    for (const name of ["pointerleave", ...(reached ? ["blur"] : [])]) node.addEventListener(name, () => light(null));
  }
  for (const { node } of terms) node.setAttribute("role", "group"); // it has a label
  drawing.querySelector("svg")?.setAttribute("role", "group");
}

/** Glyphs can be reached by the keyboard and have names, one glyph for each element. */
function describe(glyphs, elements) {
  const described = new Set();
  for (const { node, names } of glyphs) {
    const words = names.map((name) => elements[name] ?? name).join(", ");
    if (!words || described.has(words)) continue;
    described.add(words);
    node.setAttribute("tabindex", "0");
    node.setAttribute("role", "img");
    node.setAttribute("aria-label", words);
  }
}
