"use strict";
// The moving picture: a small interpreter of the parts of a scene on a canvas.
// The place of an anchor is  origin + scale · view · r + shift  in pixels of the picture, then a zoom that fits them all.
// Where bodies were moved apart to be seen, each moves about its place at rest, with displacements that have room there.

/** The corners of the box around a shape, in its own axes; of a disc its centre, for it is round as it turns. */
function cornersOf({ disc, path }) {
  if (disc) return [disc];
  const points = path.flatMap(([, ...n]) => n.flatMap((x, i) => (i % 2 ? [] : [[x, n[i + 1]]])));
  const [xs, ys] = [points.map(([x]) => x), points.map(([, y]) => y)];
  return [Math.min(...xs), Math.max(...xs)].flatMap((x) => [Math.min(...ys), Math.max(...ys)].map((y) => [x, y]));
}

/** The line of a floor, which may be slanted, as one piece that whole strokes fill: where copies of it lie is n times this. */
function pieceOf(path) {
  const [[, x0, y0], [, x1, y1], ...strokes] = path;
  const starts = strokes.filter(([letter]) => letter === "M"), length = Math.hypot(x1 - x0, y1 - y0);
  const step = starts.length > 1 ? Math.hypot(starts[1][1] - starts[0][1], starts[1][2] - starts[0][2]) : 0;
  const part = step > 0 && step < length ? (step * Math.floor(length / step + 1e-9)) / length : 1; // the strokes stay at equal distances
  return [part * (x1 - x0), part * (y1 - y0)];
}

/** About how far dots that move with a charge are from each other [px], and how often the most that flowed sends them round. */
const DOTS = 26, ROUNDS = 2;

/** How far what stands aside is from the bodies [px]. */
const ASIDE = 24;

class Picture {
  zoom = 1;
  left = 0;
  top = 0;
  /** Displacements: r is replaced by rest + factor · (r − middle). */
  displaced = { factor: 1, middle: null };
  /** How far to the left what stands beside the bodies has to give way [px]. */
  aside = 0;
  /** Floors begin to the right of this [px]. */
  floorFrom = -Infinity;

  /**
   * @param {any} scene  the scene as data
   * @param {(x: Float64Array, t: number, r: Float64Array) => Float64Array} anchors  state → positions, one after another
   */
  constructor(scene, anchors) {
    this.scene = scene;
    this.anchors = anchors;
    this.view = scene.view.map((row) => [...row]);
    this.depth = scene.view[0].length;
    this.r = new Float64Array(scene.positions.length * this.depth);
    this.rest = Float64Array.from(scene.positions.flat());
    this.parts = [...scene.parts].sort((a, b) => a.layer - b.layer);
    this.grids = this.parts.filter((part) => part.kind === "grid").map((part) => new Ground(part));
    this.bounds = this.parts.filter((part) => part.kind !== "floor").map((part) => ({ part, corners: part.trace ? [] : cornersOf(part) }));
    this.bodies = this.bounds.filter(({ part }) => part.role === "body" || scene.handles.includes(part.placement.at));
  }

  /** Compute the positions of all anchors. */
  place(x, t) {
    const { r, rest } = this, { factor, middle } = this.displaced;
    this.x = x;
    this.anchors(x, t, r);
    if (middle) for (let i = 0; i < r.length; i++) r[i] = rest[i] + factor * (r[i] - middle[i]);
    return r;
  }

  /** The place of an anchor in pixels of the picture, before the zoom; of `r`, positions of anchors [m]. */
  seen(anchor, shift, r = this.r) {
    const { scene, depth } = this, [across, down] = this.view;
    let x = scene.origin[0] + (shift ? shift[0] : 0), y = scene.origin[1] + (shift ? shift[1] : 0);
    for (let i = 0; i < depth; i++) {
      x += scene.scale * across[i] * r[anchor * depth + i];
      y += scene.scale * down[i] * r[anchor * depth + i];
    }
    return [x, y];
  }

  /** The place of an anchor on the canvas. */
  onCanvas(anchor, shift, r = this.r) {
    const [x, y] = this.seen(anchor, shift, r);
    return [this.left + this.zoom * x, this.top + this.zoom * y];
  }

  /** The transformation of a part's own axes: (x, y) → (a x + c y + e, b x + d y + f), and the factor of radii. */
  axes(placement) {
    const { at, towards, across, scaling, shift, shiftTowards } = placement;
    const [e, f] = at === null ? shift : this.seen(at, shift);
    if (towards === null) return [1, 0, 0, 1, e, f, 1];
    const [x, y] = this.seen(towards, shiftTowards);
    if (across !== null) {
      const [u, v] = this.seen(across, shift);
      return [x - e, y - f, u - e, v - f, e, f, Math.hypot(x - e, y - f)];
    }
    const length = Math.hypot(x - e, y - f);
    const cos = length > 1e-9 ? (x - e) / length : 1, sin = length > 1e-9 ? (y - f) / length : 0;
    const along = scaling === "none" ? 1 : length, beside = scaling === "both" ? length : 1;
    return [cos * along, sin * along, -sin * beside, cos * beside, e, f, beside];
  }

  trace(context, part, [a, b, c, d, e, f, factor], [along, up]) {
    const { left, top, zoom } = this;
    const X = (x, y) => left + zoom * (a * (x + along) + c * (y + up) + e);
    const Y = (x, y) => top + zoom * (b * (x + along) + d * (y + up) + f);
    if (part.disc) {
      const [x, y, radius] = part.disc;
      context.arc(X(x, y), Y(x, y), Math.max(0, radius * factor * zoom), 0, 2 * Math.PI);
      return;
    }
    for (const [letter, ...n] of part.path) {
      if (letter === "M") context.moveTo(X(n[0], n[1]), Y(n[0], n[1]));
      else if (letter === "L") context.lineTo(X(n[0], n[1]), Y(n[0], n[1]));
      else if (letter === "C") context.bezierCurveTo(X(n[0], n[1]), Y(n[0], n[1]), X(n[2], n[3]), Y(n[2], n[3]), X(n[4], n[5]), Y(n[4], n[5]));
      else context.closePath();
    }
  }

  /** Lines from anchor to anchor. */
  join(context, { anchors: through, closed, shifts }) {
    through.forEach((anchor, i) => {
      const [x, y] = this.onCanvas(anchor, shifts[i]);
      context.lineTo(x, y);
    });
    if (closed) context.closePath();
  }

  /** By what a floor has to be moved along itself, again and again, until it fills a canvas, wherever the view is. */
  copies(part, [a, b, c, d, e, f], width, height) {
    if (part.kind !== "floor" || !part.path) return [[0, 0]];
    const { left, top, zoom } = this, [x, y] = pieceOf(part.path), [[, x0, y0]] = part.path;
    const across = zoom * (a * x + c * y), down = zoom * (b * x + d * y), square = across * across + down * down;
    if (!(square > 64)) return [[0, 0]];
    const from = left + zoom * (a * x0 + c * y0 + e), above = top + zoom * (b * x0 + d * y0 + f);
    const corners = [0, width].flatMap((u) => [0, height].map((v) => ((u - from) * across + (v - above) * down) / square));
    const first = Math.floor(Math.min(...corners)) - 1, last = Math.ceil(Math.max(...corners));
    return Array.from({ length: last - first + 1 }, (_, i) => [(first + i) * x, (first + i) * y]);
  }

  /**
   * @param {CanvasRenderingContext2D} context
   * @param {Record<string, string>} colours
   * @param {Set<string> | null} lit  elements that stand out, if any
   */
  draw(context, colours, lit, width, height) {
    const bold = Math.min(1.5, Math.max(0.65, Math.sqrt(this.zoom)));
    context.lineCap = context.lineJoin = "round";
    for (const part of this.ordered()) {
      const transform = part.trace ? null : this.axes(part.placement);
      if (part.aside && transform) transform[4] -= this.aside;
      if (part.facing && transform && transform[0] * transform[3] >= transform[1] * transform[2]) continue; // its back is seen
      context.globalAlpha = !lit || part.elements.some((name) => lit.has(name)) ? 1 : 0.22;
      const line = colours[part.paint === "inside" ? "inside" : part.role] ?? colours.ink;
      context.setLineDash(part.dashed ? [5 * bold, 4 * bold] : []);
      const clipped = part.kind === "floor" && this.floorFrom > -Infinity;
      if (clipped) this.clipFloor(context, width);
      context.beginPath();
      if (part.trace) this.join(context, part.trace);
      else for (const moved of this.copies(part, transform, width, height)) this.trace(context, part, transform, moved);
      if (part.solid || part.filled) {
        context.fillStyle = part.solid ? line : part.role === "body" ? colours.inside : colours.paper;
        context.fill();
      }
      if (part.outline > 0) {
        context.lineWidth = part.outline * (part.paint === "inside" || part.outline > 6 ? this.zoom : bold);
        context.strokeStyle = line;
        context.stroke();
      }
      if (clipped) context.restore();
    }
    context.setLineDash([]);
    context.globalAlpha = 1;
    context.fillStyle = colours.coordinate ?? colours.ink;
    for (const flow of this.scene.flows) this.drawFlow(context, flow);
  }

  /** Until it is restored, draw only where floors may be: not under what stands aside. */
  clipFloor(context, width) {
    const from = this.left + this.zoom * this.floorFrom;
    context.save();
    context.beginPath();
    context.rect(from, -1e5, Math.max(0, width - from), 2e5);
    context.clip();
  }

  /** Dots inside a loop, which go along with its charge: however far that went so far is so many rounds. */
  drawFlow(context, flow) {
    const { box: [x0, y0, x1, y1], sense } = flow, charge = this.x[flow.state];
    [flow.low, flow.high] = [Math.min(flow.low ?? charge, charge), Math.max(flow.high ?? charge, charge)];
    const moved = ((charge - (flow.last ?? charge)) * ROUNDS) / (flow.high - flow.low || 1);
    [flow.offset, flow.last] = [(flow.offset ?? 0) + sense * moved, charge];
    const w = x1 - x0, h = y1 - y0, round = 2 * (w + h), count = Math.round(round / DOTS);
    for (let n = 0; n < count; n++) {
      const along = ((n / count + flow.offset) % 1) * round, s = along < 0 ? along + round : along;
      const [x, y] = s < w ? [x0 + s, y0] : s < w + h ? [x1, y0 + s - w] : s < 2 * w + h ? [x1 - (s - w - h), y1] : [x0, y1 - (s - 2 * w - h)];
      context.beginPath();
      context.arc(this.left + this.zoom * (x - this.aside), this.top + this.zoom * y, 2.4 * this.zoom, 0, 2 * Math.PI);
      context.fill();
    }
  }

  /** The parts from back to front: of one layer, solids follow what is none, by their distance from the eye. */
  ordered() {
    if (this.depth < 3 || !this.scene.solids.length) return this.parts;
    const place = new Map(depthOrder(this).map((solid, i) => [solid, i]));
    const key = ({ layer, group }) => layer * 1e6 + (group === null ? -1 : place.get(group));
    return [...this.parts].sort((a, b) => key(a) - key(b));
  }

  /** Let what stands aside, such as a circuit, give way to bodies that fill a box, and widen the box by it. */
  giveWay(box) {
    const own = [Infinity, Infinity, -Infinity, -Infinity];
    this.aside = 0;
    this.cover(own, true);
    if (own[2] === -Infinity) return;
    if (box[0] < Infinity) this.aside = Math.max(0, own[2] + ASIDE - box[0]);
    this.floorFrom = own[2] - this.aside + ASIDE / 3;
    this.cover(box, true);
  }

  /** Widen a box [left, top, right, bottom], in pixels of the picture, by everything that moves, or that stands aside. */
  cover(box, aside = false, what = this.bounds) {
    const add = (x, y, r = 0) => ([box[0], box[1], box[2], box[3]] = [Math.min(box[0], x - r), Math.min(box[1], y - r), Math.max(box[2], x + r), Math.max(box[3], y + r)]);
    for (const { part, corners } of what) {
      if (part.aside !== aside) continue;
      if (part.trace) part.trace.anchors.forEach((anchor, i) => add(...this.seen(anchor, part.trace.shifts[i])));
      else {
        const [a, b, c, d, e, f, factor] = this.axes(part.placement);
        for (const [x, y, r = 0] of corners) add(a * x + c * y + e - (aside ? this.aside : 0), b * x + d * y + f, r * factor);
      }
    }
  }

  /** Choose the displacements of a picture in which bodies were moved apart, from states that a run goes through. */
  spread(states) {
    const { scene, displaced, depth } = this;
    for (const flow of scene.flows) {
      const charges = states.map(({ x }) => x[flow.state]);
      [flow.low, flow.high] = [Math.min(...charges), Math.max(...charges)];
    }
    const { room, swing } = scene;
    if ((room === null && swing === null) || !states.length) return;
    const keep = displaced.middle;
    displaced.middle = null;
    const seen_ = states.map(({ x, t }) => Float64Array.from(this.place(x, t)));
    const middle = keep ?? this.r.map((_, i) => (Math.min(...seen_.map((s) => s[i])) + Math.max(...seen_.map((s) => s[i]))) / 2);
    let largest = 0, most = 0; // how far two bodies come apart, and how far one goes
    for (const s of seen_)
      for (const a of scene.handles)
        for (let i = 0; i < depth; i++) {
          const way = (b) => s[b * depth + i] - middle[b * depth + i];
          most = Math.max(most, Math.abs(way(a)));
          for (const b of scene.handles) largest = Math.max(largest, Math.abs(way(a) - way(b)));
        }
    if (scene.handles.length === 1) largest = 2 * most;
    const free = room === null ? Infinity : (2 * room) / Math.max(1e-12, scene.scale * largest);
    if (free < 1 || swing === null) displaced.factor = Math.min(4, free);
    else displaced.factor = most > 1e-9 ? Math.max(1, Math.min(free, (room ?? swing) / (scene.scale * most))) : 1;
    displaced.middle = room === null && displaced.factor === 1 ? keep : middle;
  }

  /** Zoom so that a box in pixels of the picture fills a canvas of a size, with a margin. */
  fit([x0, y0, x1, y1], width, height, largest = 1.6) {
    const margin = Math.min(30, 0.08 * Math.min(width, height));
    this.zoom = Math.min(largest, (width - 2 * margin) / Math.max(1, x1 - x0), (height - 2 * margin) / Math.max(1, y1 - y0));
    this.left = width / 2 - (this.zoom * (x0 + x1)) / 2;
    this.top = height / 2 - (this.zoom * (y0 + y1)) / 2;
  }

  /** Turn the view of a picture in space by an azimuth about the vertical and an elevation [rad]. */
  orbit(azimuth, elevation) {
    const [across, down] = this.view, cos = Math.cos(azimuth), sin = Math.sin(azimuth);
    const turned = [across, down].map(([x, y, z]) => [x * cos + y * sin, y * cos - x * sin, z]);
    const [s, d] = turned;
    const out = [d[1] * s[2] - d[2] * s[1], d[2] * s[0] - d[0] * s[2], d[0] * s[1] - d[1] * s[0]]; // towards us
    const tilted = d.map((x, i) => x * Math.cos(elevation) + out[i] * Math.sin(elevation));
    this.view = [s, Math.abs(tilted[2]) > 0.05 && tilted[2] * d[2] > 0 ? tilted : d];
  }
}
