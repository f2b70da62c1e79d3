"use strict";
// The moving picture: a small interpreter of the parts of a scene on a canvas.
// The place of an anchor is  origin + scale · view · r + shift  in pixels of the picture, then a zoom that fits them all.
// Where bodies were moved apart to be seen, each moves about its place at rest, with displacements that have room there.

/**
 * @param {any} scene  the scene as data
 * @param {(x: Float64Array, t: number, r: Float64Array) => Float64Array} anchors  state → positions, one after another
 */
function makePicture(scene, anchors) {
  const depth = scene.view[0].length, r = new Float64Array(scene.positions.length * depth);
  const parts = [...scene.parts].sort((a, b) => a.layer - b.layer);
  const bounds = parts.filter((part) => part.kind !== "floor").map((part) => ({ part, corners: part.trace ? [] : cornersOf(part) }));
  /** Displacements: r is replaced by rest + factor · (r − middle). */
  const displaced = { factor: 1, middle: /** @type {Float64Array | null} */ (null), rest: Float64Array.from(scene.positions.flat()) };
  const self = { view: scene.view.map((row) => [...row]), zoom: 1, left: 0, top: 0, place, onCanvas, draw, fit, cover, spread, orbit, depth };

  /** The corners of the box around a shape, in its own axes. */
  function cornersOf({ disc, path }) {
    const points = disc ? [[disc[0] - disc[2], disc[1] - disc[2]], [disc[0] + disc[2], disc[1] + disc[2]]] : path.flatMap(([, ...n]) => n.flatMap((x, i) => (i % 2 ? [] : [[x, n[i + 1]]])));
    const [xs, ys] = [points.map(([x]) => x), points.map(([, y]) => y)];
    return [Math.min(...xs), Math.max(...xs)].flatMap((x) => [Math.min(...ys), Math.max(...ys)].map((y) => [x, y]));
  }

  /** Compute the positions of all anchors. */
  function place(x, t) {
    anchors(x, t, r);
    const { factor, middle, rest } = displaced;
    if (middle) for (let i = 0; i < r.length; i++) r[i] = rest[i] + factor * (r[i] - middle[i]);
    return r;
  }

  /** The place of an anchor in pixels of the picture, before the zoom. */
  function seen(anchor, shift) {
    const [across, down] = self.view;
    let x = scene.origin[0] + (shift ? shift[0] : 0), y = scene.origin[1] + (shift ? shift[1] : 0);
    for (let i = 0; i < depth; i++) {
      x += scene.scale * across[i] * r[anchor * depth + i];
      y += scene.scale * down[i] * r[anchor * depth + i];
    }
    return [x, y];
  }

  /** The place of an anchor on the canvas. */
  function onCanvas(anchor, shift) {
    const [x, y] = seen(anchor, shift);
    return [self.left + self.zoom * x, self.top + self.zoom * y];
  }

  /** The transformation of a part's own axes: (x, y) → (a x + c y + e, b x + d y + f), and the factor of radii. */
  function axes(placement) {
    const { at, towards, across, scaling, shift, shiftTowards } = placement;
    const [e, f] = at === null ? shift : seen(at, shift);
    if (towards === null) return [1, 0, 0, 1, e, f, 1];
    const [x, y] = seen(towards, shiftTowards);
    if (across !== null) {
      const [u, v] = seen(across, shift);
      return [x - e, y - f, u - e, v - f, e, f, Math.hypot(x - e, y - f)];
    }
    const length = Math.hypot(x - e, y - f);
    const cos = length > 1e-9 ? (x - e) / length : 1, sin = length > 1e-9 ? (y - f) / length : 0;
    const along = scaling === "none" ? 1 : length, beside = scaling === "both" ? length : 1;
    return [cos * along, sin * along, -sin * beside, cos * beside, e, f, beside];
  }

  function trace(context, part, [a, b, c, d, e, f, factor], moved) {
    const X = (x, y) => self.left + self.zoom * (a * (x + moved) + c * y + e);
    const Y = (x, y) => self.top + self.zoom * (b * (x + moved) + d * y + f);
    if (part.disc) {
      const [x, y, radius] = part.disc;
      context.arc(X(x, y), Y(x, y), Math.max(0, radius * factor * self.zoom), 0, 2 * Math.PI);
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
  function join(context, { anchors: through, closed, shifts }) {
    through.forEach((anchor, i) => {
      const [x, y] = onCanvas(anchor, shifts[i]);
      context.lineTo(x, y);
    });
    if (closed) context.closePath();
  }

  /** How far a floor has to be moved along itself, again and again, until it fills the frame. */
  function copies(part, place, width) {
    if (part.kind !== "floor" || !part.path) return [0];
    const xs = part.path.flatMap(([, ...n]) => n.filter((_, i) => i % 2 === 0));
    const ys = part.path.flatMap(([, ...n]) => n.filter((_, i) => i % 2 === 1));
    const line = Math.max(...xs) - Math.min(...xs) - (Math.max(...ys) - Math.min(...ys));
    const reach = line * Math.hypot(place[0], place[1]) * self.zoom;
    if (!(reach > 8)) return [0];
    const most = Math.min(60, Math.ceil((2 * width) / reach));
    return Array.from({ length: 2 * most + 1 }, (_, i) => (i - most) * line);
  }

  /**
   * @param {CanvasRenderingContext2D} context
   * @param {Record<string, string>} colours
   * @param {Set<string> | null} lit  elements that stand out, if any
   */
  function draw(context, colours, lit, width) {
    const bold = Math.min(1.5, Math.max(0.65, Math.sqrt(self.zoom)));
    context.lineCap = context.lineJoin = "round";
    for (const part of parts) {
      const transform = part.trace ? null : axes(part.placement);
      if (part.facing && transform && transform[0] * transform[3] >= transform[1] * transform[2]) continue; // its back is seen
      context.globalAlpha = !lit || part.elements.some((name) => lit.has(name)) ? 1 : 0.22;
      const line = colours[part.paint === "inside" ? "inside" : part.role] ?? colours.ink;
      context.setLineDash(part.dashed ? [5 * bold, 4 * bold] : []);
      context.beginPath();
      if (part.trace) join(context, part.trace);
      else for (const moved of copies(part, transform, width)) trace(context, part, transform, moved);
      if (part.solid || part.filled) {
        context.fillStyle = part.solid ? line : part.role === "body" ? colours.inside : colours.paper;
        context.fill();
      }
      if (part.outline > 0) {
        context.lineWidth = part.outline * (part.paint === "inside" || part.outline > 6 ? self.zoom : bold);
        context.strokeStyle = line;
        context.stroke();
      }
    }
    context.setLineDash([]);
    context.globalAlpha = 1;
  }

  /** Widen a box [left, top, right, bottom], in pixels of the picture, by everything that moves. */
  function cover(box) {
    const add = (x, y) => ([box[0], box[1], box[2], box[3]] = [Math.min(box[0], x), Math.min(box[1], y), Math.max(box[2], x), Math.max(box[3], y)]);
    for (const { part, corners } of bounds) {
      if (part.trace) part.trace.anchors.forEach((anchor, i) => add(...seen(anchor, part.trace.shifts[i])));
      else {
        const [a, b, c, d, e, f] = axes(part.placement);
        for (const [x, y] of corners) add(a * x + c * y + e, b * x + d * y + f);
      }
    }
  }

  /** Choose the displacements of a picture in which bodies were moved apart, from states that a run goes through. */
  function spread(states) {
    if (scene.room === null || !states.length) return;
    const keep = displaced.middle;
    displaced.middle = null;
    const seen_ = states.map(({ x, t }) => Float64Array.from(place(x, t)));
    const middle = keep ?? r.map((_, i) => (Math.min(...seen_.map((s) => s[i])) + Math.max(...seen_.map((s) => s[i]))) / 2);
    let largest = 0;
    for (const s of seen_)
      for (const a of scene.handles)
        for (const b of scene.handles)
          for (let i = 0; i < depth; i++) largest = Math.max(largest, Math.abs(s[a * depth + i] - middle[a * depth + i] - s[b * depth + i] + middle[b * depth + i]));
    displaced.middle = middle;
    displaced.factor = Math.min(4, (2 * scene.room) / Math.max(1e-12, scene.scale * largest));
  }

  /** Zoom so that a box in pixels of the picture fills a canvas of a size, with a margin. */
  function fit([x0, y0, x1, y1], width, height, largest = 1.6) {
    const margin = Math.min(30, 0.08 * Math.min(width, height));
    self.zoom = Math.min(largest, (width - 2 * margin) / Math.max(1, x1 - x0), (height - 2 * margin) / Math.max(1, y1 - y0));
    self.left = width / 2 - (self.zoom * (x0 + x1)) / 2;
    self.top = height / 2 - (self.zoom * (y0 + y1)) / 2;
  }

  /** Turn the view of a picture in space by an azimuth about the vertical and an elevation [rad]. */
  function orbit(azimuth, elevation) {
    const [across, down] = self.view, cos = Math.cos(azimuth), sin = Math.sin(azimuth);
    const turned = [across, down].map(([x, y, z]) => [x * cos + y * sin, y * cos - x * sin, z]);
    const [s, d] = turned;
    const out = [d[1] * s[2] - d[2] * s[1], d[2] * s[0] - d[0] * s[2], d[0] * s[1] - d[1] * s[0]]; // towards us
    const tilted = d.map((x, i) => x * Math.cos(elevation) + out[i] * Math.sin(elevation));
    self.view = [s, Math.abs(tilted[2]) > 0.05 && tilted[2] * d[2] > 0 ? tilted : d];
  }

  return self;
}
