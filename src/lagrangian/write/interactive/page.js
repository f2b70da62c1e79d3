"use strict";
// The page: its parts are made and put together, and the clock that drives the motion is started.

(async function page() {
  const data = JSON.parse(element("data").textContent), { scene } = data;
  const solver = await physics.solver().catch((error) => say(`Nothing moves here: ${error.message}`));
  if (!solver) return;
  const run = new Run(solver, physics.functions, data), state = new PageState(data, run);
  const picture = new Picture(scene, (x, t, r) => physics.functions.anchors(x, run.p, run.u, t, r));
  const motion = new Motion(state, picture), graphs = new Graphs(state), address = new Address(state);
  const player = new Player(state, motion, address), sliders = new Sliders(state, player, address);
  new Dragging(motion, player, sliders, scene.handles);
  lightEachOther(state);
  const studies = [offerMap, offerSweep, offerSection].map((offer) => offer(state, sliders));
  sliders.changed = () => studies.forEach((redraw) => redraw());
  graphs.listen(player);
  offerTrail(state);
  offerSaving(state, address);
  offerRecording(player, motion.canvas);
  const recall = () => {
    player.setSpeed(address.recall());
    sliders.showAll();
    player.begin();
  };
  window.addEventListener("hashchange", recall);
  element("schematic").style.setProperty("--tall", String(Math.min(1.6, Math.max(1, scene.size[1] / 280))));
  arrange();
  watch(state);
  recall();
  if (solver.kind !== "wasm") element("fallback").hidden = false;
  /** What scripts beside the page can ask: the time, the sample that is shown, the places of bodies on the canvas. */
  globalThis.livePage = { kind: solver.kind, time: () => state.shown, playing: () => state.playing, sample: () => Array.from(state.sample()), handles: () => scene.handles.map((anchor) => picture.onCanvas(anchor)) };
  if (matchMedia("(prefers-reduced-motion: reduce)").matches) player.hold();
  else player.play();
  requestAnimationFrame(function frame(moment) {
    requestAnimationFrame(frame);
    player.frame(moment);
    if (!state.stale) return;
    state.stale = false;
    state.sample();
    motion.draw();
    graphs.draw();
  });
})();

/** @param {PageState} state */
function offerTrail(state) {
  press(element("trail"), true);
  on("trail", "click", () => {
    state.set.trail = !state.set.trail;
    press(element("trail"), state.set.trail);
    state.stale = true;
  });
}

/** Where there is one column, the sliders follow the motion; the order for the keyboard is that of the eye. */
function arrange() {
  const wide = matchMedia("(min-width: 62rem)"), controls = element("controls"), equations = element("equations");
  const place = () => (wide.matches ? equations.after(controls) : equations.before(controls));
  wide.addEventListener("change", place);
  place();
}

/**
 * Draw again when the window or the colours change.
 * @param {PageState} state
 */
function watch(state) {
  new ResizeObserver(() => (state.stale = true)).observe(document.body);
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => {
    state.colours = readColours();
    state.stale = true;
  });
}
