"use strict";
// The motion on its canvas: the frame that holds it, the moving picture, and the paths of points.

class Motion {
  canvas = element("canvas");
  context = this.canvas.getContext("2d");
  /** What a hand holds, if anything. */
  held = null;
  /** Where the anchors of trails were at samples of one edition of the history, one after another. */
  passed = { edition: -1, spots: new Map() };

  /**
   * @param {PageState} state
   * @param {Picture} picture
   */
  constructor(state, picture) {
    Object.assign(this, { state, picture });
  }

  /** Run ahead to know how far things go; the frame then holds the motion, up to three times the size of the picture. */
  measure() {
    const { state, picture } = this, { run, size } = state, most = 3 * Math.max(...picture.scene.size);
    let box = [Infinity, Infinity, -Infinity, -Infinity];
    const states = Array.from({ length: size }, () => [Infinity, -Infinity]), energy = [Infinity, -Infinity];
    const widen = (pair, x) => ([pair[0], pair[1]] = [Math.min(pair[0], x), Math.max(pair[1], x)]);
    const passed = run.measure(state.stored(0), state.span);
    picture.spread(passed);
    this.passed.edition = -1;
    for (const ground of picture.grids) ground.forget();
    for (const { x, t } of passed) {
      picture.place(x, t);
      for (const ground of picture.grids) ground.tread(picture);
      const wider = [...box];
      picture.cover(wider);
      if (Math.max(wider[2] - wider[0], wider[3] - wider[1]) < most) box = wider; // what goes further is followed
      x.forEach((value, i) => widen(states[i], value));
      const [h, , T, V] = run.energies(x, t);
      for (const e of [T, V, h]) widen(energy, e);
    }
    picture.giveWay(box);
    const margin = 6;
    for (const [low, high, least] of picture.scene.size.map((length, i) => [i, i + 2, 0.3 * length])) {
      const lacking = Math.max(0, least - (box[high] - box[low])) / 2;
      box[low] -= lacking + margin;
      box[high] += lacking + margin;
    }
    state.reach = { box, states, energy, most: Math.max(box[2] - box[0], box[3] - box[1], most) };
    state.stale = true;
  }

  /** Place the picture as the sample that is shown says. */
  place() {
    this.picture.place(this.state.x(), this.state.shown);
  }

  draw() {
    const { state, picture, context } = this, { colours } = state, [width, height] = fitted(this.canvas, context);
    context.fillStyle = colours.paper; // a recording has no background of its own
    context.fillRect(0, 0, width, height);
    this.place();
    const held = this.grow();
    picture.fit(state.reach.box, width, height);
    if (!held) this.follow(width, height);
    if (state.set.trail) state.data.trail.forEach((_, k) => this.drawTrail(k));
    this.place();
    for (const ground of picture.grids) ground.lay(picture);
    picture.draw(context, colours, state.lit, width, height);
    if (this.held) this.drawHeld();
  }

  /** What goes further than the run ahead widens the frame, as far as that may be; whether the frame holds it all. */
  grow() {
    const { reach } = this.state, box = [...reach.box];
    this.picture.cover(box);
    const held = Math.max(box[2] - box[0], box[3] - box[1]) <= reach.most;
    if (held) reach.box = box;
    return held;
  }

  /** What leaves the frame for good, such as a body that falls, is followed: all of the bodies if they fit, else their middle. */
  follow(width, height) {
    const { picture } = this, box = [Infinity, Infinity, -Infinity, -Infinity];
    picture.cover(box, false, picture.bodies);
    const by = [width, height].map((length, i) => {
      const [low, high] = [box[i], box[i + 2]].map((x) => (i ? picture.top : picture.left) + picture.zoom * x);
      const middle = (low + high) / 2, margin = Math.min(length / 2, Math.max(0.1 * length, (high - low) / 2 + 8));
      return Math.min(length - margin, Math.max(margin, middle)) - middle;
    });
    if (Number.isFinite(by[0] + by[1])) [picture.left, picture.top] = [picture.left + by[0], picture.top + by[1]];
  }

  /** The positions of the anchors of trails at a sample; each sample is computed once, for it may take long in space. */
  spots(sample) {
    const { state, picture, passed } = this, { history, data } = state, { depth } = picture;
    if (passed.edition !== history.edition) this.passed = { edition: history.edition, spots: new Map() };
    let found = this.passed.spots.get(sample);
    if (!found) {
      const r = picture.place(state.stored(sample), history.at(sample, 0));
      found = Float64Array.from({ length: depth * data.trail.length }, (_, i) => r[data.trail[Math.floor(i / depth)] * depth + (i % depth)]);
      this.passed.spots.set(sample, found);
    }
    return found;
  }

  /** The path of an anchor in the last seconds, fading: of that number among those of trails. */
  drawTrail(number) {
    const { state, picture, context } = this, end = state.history.index(state.shown), pieces = 12;
    const length = Math.min(end, 800), stride = Math.max(1, Math.round(length / 300)), points = [];
    for (let i = end - length; i <= end; i += stride) {
      points.push(picture.onCanvas(number, undefined, this.spots(i)));
    }
    context.lineWidth = 1.5;
    context.strokeStyle = state.colours.accent;
    for (let piece = 0; piece < pieces; piece++) {
      context.globalAlpha = 0.04 + (0.45 * (piece + 1)) / pieces;
      context.beginPath();
      const from = Math.floor((piece * (points.length - 1)) / pieces), to = Math.floor(((piece + 1) * (points.length - 1)) / pieces);
      for (let i = from; i <= to; i++) context.lineTo(points[i][0], points[i][1]);
      context.stroke();
    }
    context.globalAlpha = 1;
  }

  /** A ring about what is held. */
  drawHeld() {
    const { context } = this, [x, y] = this.picture.onCanvas(this.held.anchor);
    context.strokeStyle = this.state.colours.accent;
    context.lineWidth = 1.5;
    context.beginPath();
    context.arc(x, y, 16, 0, 2 * Math.PI);
    context.stroke();
  }
}
