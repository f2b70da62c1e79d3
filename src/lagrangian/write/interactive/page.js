"use strict";
// The page: what is on it, what the reader does, and the clock that drives the motion.

(async function page() {
  const data = JSON.parse(element("data").textContent ?? "{}");
  const { scene } = data, nq = data.coordinates, size = data.x.names.length;
  const canvas = /** @type {HTMLCanvasElement} */ (element("canvas")), context = /** @type {CanvasRenderingContext2D} */ (canvas.getContext("2d"));
  const plots = { coordinates: makePlot(element("plot-coordinates")), energy: makePlot(element("plot-energy")), phase: makePlot(element("plot-phase")) };
  const solver = await physics.solver().catch((error) => say(`Nothing moves here: ${error.message}`));
  if (!solver) return;
  const run = makeRun(solver, physics.functions, data), { history } = run;
  const picture = makePicture(scene, (x, t, r) => physics.functions.anchors(x, run.p, run.u, t, r));
  const now = new Float64Array(history.width), push = new Float64Array(data.u.names.length);
  /** What the reader sets. */
  const set = { p: Float64Array.from(data.p.values), u: Float64Array.from(data.u.values), x: Float64Array.from(data.x.values), speed: 1, trail: true };
  let playing = false, shown = 0, last = 0, lit = null, stale = true, colours = readColours(), held = null, turning = null;
  /** The time that is run ahead, and that plots show. */
  const span = Math.min(data.duration, 12 * data.pace);
  /** How far things go: of the anchors on the picture, of each state, and of the energies. */
  let reach = { box: [0, 0, 1, 1], states: [[0, 0]], energy: [0, 0], first: 1 };
  /** Without the functions that close loops nothing can be dragged. */
  const draggable = data.constrained && !physics.functions.approach ? [] : scene.handles;
  const hidden = new Set(data.x.names.map((_, i) => i).filter((i) => i >= 4));

  function say(words) {
    if (element("status").textContent !== words) element("status").textContent = words;
  }

  function element(id) {
    return /** @type {any} */ (document.getElementById(id));
  }

  function readColours() {
    const style = getComputedStyle(element("drawing").querySelector("svg") ?? document.documentElement), colour = (name) => style.getPropertyValue(`--${name}`).trim();
    const found = Object.fromEntries(["ink", "soft", "line", "accent", "axis", "stiffness", "damping", "gravity", "input", "velocity"].map((name) => [name, colour(name)]));
    const roles = Object.fromEntries(["body", "rod", "ground", "stiffness", "damping", "friction", "gravity", "input", "coordinate", "constraint", "thin", "inside"].map((role) => [role, colour(`scene-${role}`)]));
    return { ...found, ...roles, paper: colour("panel"), series: [found.accent, found.damping, found.stiffness, found.velocity, found.input, found.gravity] };
  }

  // -- the run --------------------------------------------------------------------------------------------------------

  function inputsNow() {
    return set.u.map((value, i) => value + push[i]);
  }

  /** Begin the run anew from the initial state. */
  function begin() {
    run.begin(set.x, set.p, inputsNow());
    shown = 0;
    measure();
    tellTrouble();
    stale = true;
  }

  /** A parameter or an input has changed: the run goes on from here. */
  function goOn() {
    run.goOn(shown, set.p, inputsNow());
    shown = Math.min(shown, run.end);
    tellTrouble();
    stale = true;
  }

  function tellTrouble() {
    const events = run.occurred.filter((event) => event.t <= shown).slice(-3).map((event) => `${event.name} at ${event.t.toFixed(3)} s`);
    say([shown >= run.end ? run.trouble : "", ...events].filter(Boolean).join(" · "));
  }

  /** Run ahead to know how far things go; the frame then holds the motion. */
  function measure() {
    const box = [Infinity, Infinity, -Infinity, -Infinity], states = Array.from({ length: size }, () => [Infinity, -Infinity]), energy = [Infinity, -Infinity];
    const widen = (pair, x) => ([pair[0], pair[1]] = [Math.min(pair[0], x), Math.max(pair[1], x)]);
    const start = Float64Array.from({ length: size }, (_, i) => history.at(0, 1 + i));
    const passed = run.measure(start, span);
    picture.spread(passed);
    for (const { x, t } of passed) {
      picture.place(x, t);
      picture.cover(box);
      x.forEach((value, i) => widen(states[i], value));
      const [h, , T, V] = run.energies(x, t);
      for (const e of [T, V, h]) widen(energy, e);
    }
    const margin = 6;
    for (const [low, high, least] of [[0, 2, 0.3 * scene.size[0]], [1, 3, 0.3 * scene.size[1]]]) {
      const lacking = Math.max(0, least - (box[high] - box[low])) / 2;
      box[low] -= lacking + margin;
      box[high] += lacking + margin;
    }
    reach = { box, states, energy, first: Math.max(box[2] - box[0], box[3] - box[1]) };
  }

  // -- drawing --------------------------------------------------------------------------------------------------------

  function frame(moment) {
    requestAnimationFrame(frame);
    const passed = Math.min(0.05, Math.max(0, (moment - last) / 1000));
    last = moment;
    if (playing) {
      const wanted = shown + passed * set.speed * data.pace;
      const reached = run.computeTo(wanted);
      shown = Math.min(wanted, run.end);
      if (!reached) hold();
      tellTrouble();
      stale = true;
    }
    if (stale) draw();
  }

  function draw() {
    stale = false;
    history.state(shown, now);
    drawMotion();
    drawPlots();
    tell();
  }

  function drawMotion() {
    const [width, height] = fitted(canvas, context);
    context.fillStyle = colours.paper; // a recording has no background of its own
    context.fillRect(0, 0, width, height);
    picture.place(now.subarray(1, 1 + size), shown);
    grow();
    picture.fit(reach.box, width, height);
    if (set.trail) drawTrail();
    picture.place(now.subarray(1, 1 + size), shown);
    picture.draw(context, colours, lit, width);
    if (held) drawHeld();
  }

  /** What goes further than the run ahead widens the frame, up to four times. */
  function grow() {
    const box = [...reach.box];
    picture.cover(box);
    const extent = ([x0, y0, x1, y1]) => Math.max(x1 - x0, y1 - y0);
    if (extent(box) < 4 * reach.first) reach.box = box;
  }

  /** The paths of the last seconds, fading. */
  function drawTrail() {
    const end = history.index(shown), pieces = 12, length = Math.min(end, 800), stride = Math.max(1, Math.round(length / 300));
    context.lineWidth = 1.5;
    for (const anchor of data.trail) {
      context.strokeStyle = colours.accent;
      const points = [];
      for (let i = end - length; i <= end; i += stride) {
        picture.place(Float64Array.from({ length: size }, (_, n) => history.at(i, 1 + n)), history.at(i, 0));
        points.push(picture.onCanvas(anchor));
      }
      for (let piece = 0; piece < pieces; piece++) {
        context.globalAlpha = 0.04 + (0.45 * (piece + 1)) / pieces;
        context.beginPath();
        const from = Math.floor((piece * (points.length - 1)) / pieces), to = Math.floor(((piece + 1) * (points.length - 1)) / pieces);
        for (let i = from; i <= to; i++) context.lineTo(points[i][0], points[i][1]);
        context.stroke();
      }
    }
    context.globalAlpha = 1;
  }

  function drawHeld() {
    const [x, y] = picture.onCanvas(held.anchor);
    context.strokeStyle = colours.accent;
    context.lineWidth = 1.5;
    context.beginPath();
    context.arc(x, y, 16, 0, 2 * Math.PI);
    context.stroke();
  }

  function drawPlots() {
    const end = history.index(shown), from = Math.max(0, shown - span), first = history.index(from), xs = [from, Math.max(from + span, shown)];
    const t = (i) => history.at(i, 0);
    let [low, high] = [Infinity, -Infinity], [least, most] = reach.energy;
    for (let i = first; i <= end; i += 4) {
      for (let n = 0; n < nq; n++) if (!hidden.has(n)) [low, high] = [Math.min(low, history.at(i, 1 + n)), Math.max(high, history.at(i, 1 + n))];
      for (const c of [history.T, history.V, history.balance]) [least, most] = [Math.min(least, history.at(i, c)), Math.max(most, history.at(i, c))];
    }
    for (let n = 0; n < nq; n++) if (!hidden.has(n) && from === 0) [low, high] = [Math.min(low, reach.states[n][0]), Math.max(high, reach.states[n][1])];
    plots.coordinates.begin(xs, limits(low, high), colours);
    for (let n = 0; n < nq; n++) if (!hidden.has(n)) plots.coordinates.line(first, end, t, (i) => history.at(i, 1 + n), colours.series[n % 6], DASHES[Math.floor(n / 6) % 6]);
    plots.energy.begin(xs, limits(least, most), colours);
    [history.T, history.V, history.balance].forEach((c, k) => plots.energy.line(first, end, t, (i) => history.at(i, c), colours.series[k], k === 2 ? [7, 3] : []));
    for (const plot of [plots.coordinates, plots.energy]) plot.mark(shown, colours.soft);
    drawPhase(end);
  }

  /** One number over another; angles are drawn between −π and π. */
  function drawPhase(end) {
    const [across, up] = [Number(element("phase-x").value), Number(element("phase-y").value)];
    const turn = (c) => c < nq && data.angles[c];
    const wrapped = (x) => x - 2 * Math.PI * Math.round(x / (2 * Math.PI));
    const value = (c) => (turn(c) ? (i) => wrapped(history.at(i, 1 + c)) : (i) => history.at(i, 1 + c));
    const range = (c) => {
      const [low, high] = extent(c, end);
      const round = turn(c) && (Math.max(...reach.states[c].map(Math.abs)) > 2.8 || low < -Math.PI || high > Math.PI);
      return round ? [-Math.PI, Math.PI] : [low, high];
    };
    const x = value(across), y = value(up), from = Math.max(0, end - 6000);
    const jumps = (i) => (turn(across) && Math.abs(x(i) - x(i - 1)) > Math.PI) || (turn(up) && Math.abs(y(i) - y(i - 1)) > Math.PI);
    plots.phase.begin(limits(...range(across)), limits(...range(up)), colours);
    plots.phase.line(from, end, x, y, colours.accent, [], jumps);
    const at = (c) => (turn(c) ? wrapped(now[1 + c]) : now[1 + c]);
    plots.phase.dot(at(across), at(up), colours.input, colours.paper);
  }

  function extent(c, end) {
    let [low, high] = reach.states[c];
    for (let i = Math.max(0, end - 6000); i <= end; i += 4) [low, high] = [Math.min(low, history.at(i, 1 + c)), Math.max(high, history.at(i, 1 + c))];
    return [low, high];
  }

  // -- numbers --------------------------------------------------------------------------------------------------------

  function digits(x, n = 3) {
    if (x === 0 || Math.abs(x) < 1e-12) return "0";
    const size = Math.abs(x);
    const text = size >= 1e5 || size < 1e-3 ? x.toExponential(n - 1).replace("e+", "e") : x.toFixed(Math.max(0, n - 1 - Math.floor(Math.log10(size))));
    return (size < 0.01 ? text.replace(/(\.\d*?)0+(?=e|$)/, "$1").replace(/\.(?=e|$)/, "") : text).replace("-", "−");
  }

  let told = -1;
  function tell() {
    const clock = `t = ${shown.toFixed(2)} s`;
    element("clock").textContent = clock;
    const slider = element("time");
    slider.max = String(Math.max(run.end, run.interval));
    slider.step = String(run.interval);
    if (document.activeElement !== slider || playing) slider.value = String(shown);
    slider.setAttribute("aria-valuetext", `${shown.toFixed(2)} seconds`);
    const moment = performance.now();
    if (playing && moment - told < 120) return;
    told = moment;
    for (let i = 0; i < size; i++) element(`number-${i}`).textContent = digits(now[1 + i], 4);
    for (const [id, c] of [["number-T", history.T], ["number-V", history.V], ["number-balance", history.balance]]) element(id).textContent = digits(now[c], 4);
    element("number-audit").textContent = digits(Math.abs(now[history.balance] - history.at(0, history.balance)), 2);
  }

  // -- play, hold, step -----------------------------------------------------------------------------------------------

  function play() {
    playing = true;
    last = performance.now();
    button();
  }

  function hold() {
    playing = false;
    told = -1;
    button();
  }

  function button() {
    element("play").querySelector("span").textContent = playing ? "Hold" : "Play";
    element("play").classList.toggle("on", playing);
    stale = true;
  }

  function stepBy(direction) {
    hold();
    const wanted = Math.max(0, shown + (direction * data.pace) / 30);
    run.computeTo(wanted);
    shown = Math.min(wanted, run.end);
    stale = true;
  }

  element("play").addEventListener("click", () => (playing ? hold() : play()));
  element("start").addEventListener("click", () => begin());
  element("back").addEventListener("click", () => stepBy(-1));
  element("step").addEventListener("click", () => stepBy(1));
  element("trail").addEventListener("click", () => {
    set.trail = !set.trail;
    element("trail").setAttribute("aria-pressed", String(set.trail));
    stale = true;
  });
  element("time").addEventListener("input", (event) => {
    hold();
    shown = Math.min(Number(event.target.value), run.end);
    stale = true;
  });
  element("speed").addEventListener("input", (event) => setSpeed(2 ** Number(event.target.value)));

  function setSpeed(speed) {
    set.speed = speed;
    element("speed").value = String(Math.log2(speed));
    const words = `${digits(speed * data.pace, 2)}×`;
    element("speed-value").textContent = words;
    element("speed").setAttribute("aria-valuetext", words);
    remember();
  }

  document.addEventListener("keydown", (event) => {
    const target = /** @type {HTMLElement} */ (event.target);
    if (event.ctrlKey || event.metaKey || event.altKey || target.closest("input, select, textarea, button, summary, a, dialog")) return;
    if (event.key === " ") playing ? hold() : play();
    else if (event.key === "ArrowRight") stepBy(1);
    else if (event.key === "ArrowLeft") stepBy(-1);
    else return;
    event.preventDefault();
  });

  // -- sliders --------------------------------------------------------------------------------------------------------

  const controls = [...document.querySelectorAll(".control")].map((row) => {
    const group = row.getAttribute("data-group"), index = Number(row.getAttribute("data-index"));
    const range = row.querySelector("input[type=range]"), field = row.querySelector("input[type=text]");
    return { row, group, index, range, field, unit: row.getAttribute("data-unit") };
  });

  function show(control) {
    const value = set[control.group][control.index];
    const [low, high] = [Number(control.range.min), Number(control.range.max)];
    if (value < low) control.range.min = String(value);
    if (value > high) control.range.max = String(value);
    control.range.value = String(value);
    if (document.activeElement !== control.field) control.field.value = digits(value);
    control.range.setAttribute("aria-valuetext", `${digits(value)} ${control.unit}`);
  }

  function change(control, value) {
    if (!Number.isFinite(value)) return show(control);
    set[control.group][control.index] = value;
    show(control);
    if (control.group === "x" || shown === 0) begin();
    else goOn();
    remember();
    redraw();
  }

  for (const control of controls) {
    control.range.addEventListener("input", () => change(control, Number(control.range.value)));
    control.field.addEventListener("change", () => change(control, Number(control.field.value.replace("−", "-").replace(",", "."))));
    control.range.addEventListener("dblclick", () => change(control, data[control.group].values[control.index]));
    for (const knob of control.row.querySelectorAll("[data-push]")) {
      const by = Number(knob.getAttribute("data-push"));
      const press = (on) => {
        if (push[control.index] === (on ? by : 0)) return;
        push[control.index] = on ? by : 0;
        knob.classList.toggle("on", on);
        goOn();
      };
      knob.addEventListener("pointerdown", () => press(true));
      for (const name of ["pointerup", "pointerleave", "blur"]) knob.addEventListener(name, () => press(false));
      knob.addEventListener("keydown", (event) => {
        if (event.key === " " || event.key === "Enter") {
          event.preventDefault();
          press(true);
        }
      });
      knob.addEventListener("keyup", () => press(false));
    }
  }

  element("reset").addEventListener("click", () => {
    for (const group of ["p", "u", "x"]) set[group].set(data[group].values);
    controls.forEach(show);
    begin();
    remember();
  });

  // -- dragging -------------------------------------------------------------------------------------------------------

  canvas.addEventListener("pointerdown", (event) => {
    const [x, y] = within(event);
    history.state(shown, now);
    picture.place(now.subarray(1, 1 + size), shown);
    let nearest = null, best = 32;
    for (const anchor of draggable) {
      const [X, Y] = picture.onCanvas(anchor), distance = Math.hypot(X - x, Y - y);
      if (distance < best) [nearest, best] = [{ anchor, dx: X - x, dy: Y - y }, distance];
    }
    canvas.setPointerCapture(event.pointerId);
    if (nearest) {
      held = { ...nearest, playing, x: now.slice(1, 1 + size).fill(0, nq) };
      hold();
      canvas.classList.add("held");
    } else if (picture.depth === 3) turning = [event.clientX, event.clientY];
    stale = true;
  });

  canvas.addEventListener("pointermove", (event) => {
    if (held) follow(...within(event));
    else if (turning) {
      picture.orbit((event.clientX - turning[0]) * 0.008, (event.clientY - turning[1]) * 0.008);
      turning = [event.clientX, event.clientY];
      measure();
      stale = true;
    }
  });

  for (const name of ["pointerup", "pointercancel"])
    canvas.addEventListener(name, () => {
      turning = null;
      if (!held) return;
      const resume = held.playing;
      held = null;
      canvas.classList.remove("held");
      begin();
      remember();
      if (resume) play();
    });

  function within(event) {
    const edge = canvas.getBoundingClientRect();
    return [event.clientX - edge.left, event.clientY - edge.top];
  }

  /** Move the coordinates so that the body that is held comes to the pointer: damped least squares. */
  function follow(x, y) {
    const x0 = dragged(picture, held.anchor, [x + held.dx, y + held.dy], held.x, nq, (trial) => run.closed(trial, 0, false));
    set.x.set(x0);
    held.x.set(x0);
    controls.filter((control) => control.group === "x").forEach(show);
    run.begin(set.x, set.p, inputsNow());
    shown = 0;
    tellTrouble();
    stale = true;
  }

  // -- terms and glyphs light each other --------------------------------------------------------------------------------

  // the derivation is the largest part of the page, and comes packed
  element("whole").innerHTML = await unpacked(element("packed-steps").textContent).text();
  /** In terms and glyphs, names are separated by spaces; a space within a name is a no-break space there. */
  const spelled = new Map(Object.keys(data.elements).map((name) => [name.split(/\s+/).join("\u00a0"), name]));
  const marked = (nodes) => [...nodes].map((node) => ({ node, names: node.getAttribute("data-element").split(" ").filter(Boolean).map((name) => spelled.get(name) ?? name) }));
  const drawing = element("drawing"), glyphs = marked(drawing.querySelectorAll("[data-element]")), terms = marked(document.querySelectorAll(".term[data-element]"));

  function light(names) {
    lit = names && names.length ? new Set(names) : null;
    for (const { node, names: own } of [...terms, ...glyphs]) node.classList.toggle("lit", lit !== null && own.some((name) => lit.has(name)));
    document.body.classList.toggle("choosing", lit !== null);
    stale = true;
  }

  for (const { node, names } of [...terms, ...glyphs]) {
    if (!names.length) continue;
    for (const name of ["pointerenter", "focus"]) node.addEventListener(name, () => light(names));
    for (const name of ["pointerleave", "blur"]) node.addEventListener(name, () => light(null));
  }
  for (const { node } of terms) node.setAttribute("role", "group"); // it has a label
  drawing.querySelector("svg")?.setAttribute("role", "group");
  const described = new Set();
  for (const { node, names } of glyphs) {
    const words = names.map((name) => data.elements[name] ?? name).join(", ");
    if (!words || described.has(words)) continue;
    described.add(words);
    node.setAttribute("tabindex", "0");
    node.setAttribute("role", "img");
    node.setAttribute("aria-label", words);
  }

  // -- the address ----------------------------------------------------------------------------------------------------

  /** What differs from the model, as the part of an address after #. */
  function address() {
    const kept = new URLSearchParams();
    for (const group of ["p", "u", "x"])
      set[group].forEach((value, i) => value !== data[group].values[i] && kept.set(`${group}.${data[group].names[i]}`, String(value)));
    if (set.speed !== 1) kept.set("speed", String(set.speed));
    return `#${kept}`;
  }

  let pending = 0;
  function remember(wait = 200) {
    clearTimeout(pending);
    pending = setTimeout(() => {
      try {
        window.history.replaceState(null, "", address());
      } catch {
        // a page without an address of its own, such as in a notebook
      }
    }, wait);
  }

  function recall() {
    const kept = new URLSearchParams(location.hash.slice(1));
    for (const group of ["p", "u", "x"])
      data[group].names.forEach((name, i) => {
        const text = kept.get(`${group}.${name}`), value = Number(text);
        set[group][i] = text !== null && text !== "" && Number.isFinite(value) ? value : data[group].values[i];
      });
    const speed = Number(kept.get("speed"));
    setSpeed(speed > 0 && Number.isFinite(speed) ? speed : 1);
    controls.forEach(show);
    begin();
  }

  window.addEventListener("hashchange", recall);

  // -- the map of starts ------------------------------------------------------------------------------------------------

  const pickers = Object.fromEntries(["map-x", "map-y", "map-of"].map((id) => [id, element(id)]));
  const ends = (state) => {
    const { range } = controls.find((control) => control.group === "x" && control.index === state);
    return { state, low: Number(range.min), high: Number(range.max) };
  };
  const map = makeMap({
    canvas: element("map-canvas"),
    job: () => ({ x: set.x, p: set.p, u: set.u, across: ends(Number(pickers["map-x"].value)), up: ends(Number(pickers["map-y"].value)), which: Number(pickers["map-of"].value), end: Number(element("map-end").value), machine: data.machine }),
    angle: (state) => state < nq && data.angles[state],
    told: (words) => (element("map-told").textContent = words),
  });
  let soon = 0;
  function redraw() {
    clearTimeout(soon);
    if (element("map").querySelector("details").open) soon = setTimeout(map.draw, 40);
    else map.stop();
  }
  element("map").querySelector("details").addEventListener("toggle", redraw);
  for (const picker of [...Object.values(pickers), element("map-end")]) picker.addEventListener("change", redraw);
  const pick = (event) => {
    if (!map.asked()) return;
    const { across, up } = map.asked(), [a, b] = map.at(event);
    set.x[across.state] = a;
    set.x[up.state] = b;
    controls.filter((control) => control.group === "x").forEach(show);
    begin();
    remember();
    map.show();
  };
  element("map-canvas").addEventListener("pointerdown", pick);
  element("map-canvas").addEventListener("pointermove", (event) => event.buttons && pick(event));

  // -- reading the plots ------------------------------------------------------------------------------------------------

  for (const plot of [plots.coordinates, plots.energy]) {
    const go = (event) => {
      hold();
      shown = Math.min(run.end, Math.max(history.at(0, 0), plot.at(event)[0]));
      stale = true;
    };
    plot.canvas.addEventListener("pointerdown", (event) => {
      plot.canvas.setPointerCapture(event.pointerId);
      go(event);
    });
    plot.canvas.addEventListener("pointermove", (event) => event.buttons && go(event));
  }

  // -- taking it along --------------------------------------------------------------------------------------------------

  /** The model file with the values of the sliders. */
  function modelText() {
    return data.model.map((piece) => {
      if (typeof piece === "string") return piece;
      const [group, index, unit, factor] = piece, value = set[group][index] / factor;
      const number = String(Number(value.toPrecision(12)));
      return unit ? `"${number} ${unit}"` : number;
    }).join("");
  }

  /** Samples, a row each: what spreadsheets read. */
  function csvText() {
    const quoted = (name) => (/[",\n]/.test(name) ? `"${name.replaceAll('"', '""')}"` : name);
    const head = ["t", ...data.x.names, ...data.u.names, "T", "V"].map(quoted).join(",");
    const columns = [0, ...data.x.names.map((_, i) => 1 + i), ...data.u.names.map((_, i) => history.u + i), history.T, history.V];
    const rows = Array.from({ length: history.index(shown) + 1 }, (_, i) => columns.map((column) => history.at(i, column)).join(","));
    return [head, ...rows].join("\n") + "\n";
  }

  function save(blob, ending) {
    const link = document.createElement("a");
    link.href = URL.createObjectURL(blob);
    link.download = `${data.file}.${ending}`;
    link.click();
    setTimeout(() => URL.revokeObjectURL(link.href), 10000);
  }

  /** Put a text on the clipboard; where that is not allowed, show it to be copied by hand. */
  async function copy(knob, text) {
    try {
      await navigator.clipboard.writeText(text);
      const words = knob.textContent;
      knob.textContent = "Copied";
      setTimeout(() => (knob.textContent = words), 1200);
    } catch {
      const dialog = element("copy"), area = dialog.querySelector("textarea");
      area.value = text;
      dialog.showModal();
      area.select();
    }
  }

  element("copy-link").addEventListener("click", (event) => {
    remember(0);
    copy(event.currentTarget, location.href.split("#")[0] + address());
  });
  element("copy-model").addEventListener("click", (event) => copy(event.currentTarget, modelText()));
  element("copy-model").hidden = !data.model.length;
  element("csv").addEventListener("click", () => save(new Blob([csvText()], { type: "text/csv" }), "csv"));

  let recorder = null;
  element("record").hidden = typeof MediaRecorder === "undefined" || !canvas.captureStream;
  element("record").addEventListener("click", () => {
    if (recorder) return recorder.stop();
    const pieces = [];
    recorder = new MediaRecorder(canvas.captureStream(60), { videoBitsPerSecond: 8e6 });
    recorder.addEventListener("dataavailable", (event) => pieces.push(event.data));
    recorder.addEventListener("stop", () => {
      save(new Blob(pieces, { type: recorder.mimeType }), recorder.mimeType.includes("mp4") ? "mp4" : "webm");
      recorder = null;
      recording(false);
    });
    recorder.start();
    recording(true);
    if (!playing) play();
  });

  function recording(on) {
    element("record").textContent = on ? "Stop" : "Record";
    element("record").setAttribute("aria-pressed", String(on));
  }

  // -- begin ----------------------------------------------------------------------------------------------------------

  for (const id of ["phase-x", "phase-y"]) element(id).addEventListener("change", () => (stale = true));
  for (const toggle of document.querySelectorAll("[data-series]")) {
    const n = Number(toggle.getAttribute("data-series"));
    toggle.setAttribute("aria-pressed", String(!hidden.has(n)));
    toggle.addEventListener("click", () => {
      hidden.has(n) ? hidden.delete(n) : hidden.add(n);
      toggle.setAttribute("aria-pressed", String(!hidden.has(n)));
      stale = true;
    });
  }
  /** Where there is one column, the sliders follow the motion; the order for the keyboard is that of the eye. */
  const wide = matchMedia("(min-width: 62rem)");
  const arrange = () => (wide.matches ? element("equations").after(element("controls")) : element("equations").before(element("controls")));
  wide.addEventListener("change", arrange);
  arrange();
  new ResizeObserver(() => (stale = true)).observe(document.body);
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => {
    colours = readColours();
    stale = true;
  });
  element("trail").setAttribute("aria-pressed", "true");
  recall();
  if (solver.kind !== "wasm") element("fallback").hidden = false;
  /** What scripts beside the page can ask: the time, the sample that is shown, the places of bodies on the canvas. */
  Object.assign(globalThis, { livePage: { kind: solver.kind, time: () => shown, playing: () => playing, sample: () => Array.from(history.state(shown, now)), handles: () => scene.handles.map((anchor) => picture.onCanvas(anchor)) } });
  if (matchMedia("(prefers-reduced-motion: reduce)").matches) hold();
  else play();
  requestAnimationFrame(frame);
})();
