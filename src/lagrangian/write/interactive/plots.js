"use strict";
// Plots on canvases: lines over time, and one quantity over another.

/** Steps of 1, 2 or 5 times a power of ten, about `wanted` of them. */
function ticks(low, high, wanted) {
  const raw = (high - low) / Math.max(1, wanted), power = 10 ** Math.floor(Math.log10(raw));
  const step = [1, 2, 5, 10].map((m) => m * power).find((s) => s >= raw) ?? raw;
  const found = [];
  for (let x = Math.ceil(low / step) * step; x <= high + 1e-9 * step; x += step) found.push(Math.abs(x) < 1e-9 * step ? 0 : x);
  return { found, step };
}

/** A number of an axis, with as many digits as its steps need. */
function tickText(x, step) {
  if (x === 0) return "0";
  if (Math.abs(x) >= 1e5 || Math.abs(step) < 1e-4) return x.toExponential(1).replace("e+", "e").replaceAll("-", "−");
  return x.toFixed(Math.max(0, -Math.floor(Math.log10(step) + 1e-9))).replace("-", "−");
}

/** Limits with a margin that contain two numbers, never of no extent. */
function limits(low, high) {
  if (!(high >= low)) return [-1, 1];
  const margin = Math.max(0.06 * (high - low), 1e-9 + 1e-3 * Math.abs(high), high - low < 1e-12 ? 0.5 : 0);
  return [low - margin, high + margin];
}

/**
 * Give a canvas as many pixels as the screen has for it; lengths are those of the page. Returns its width and height.
 * @param {HTMLCanvasElement} canvas
 * @param {CanvasRenderingContext2D} context
 */
function fitted(canvas, context) {
  const ratio = window.devicePixelRatio || 1, width = canvas.clientWidth, height = canvas.clientHeight;
  if (canvas.width !== Math.round(width * ratio) || canvas.height !== Math.round(height * ratio)) {
    canvas.width = Math.round(width * ratio);
    canvas.height = Math.round(height * ratio);
  }
  context.setTransform(ratio, 0, 0, ratio, 0, 0);
  return [width, height];
}

const DASHES = [[], [7, 3], [2, 3], [9, 3, 2, 3], [4, 2], [12, 4]];

/** A plot on a canvas, which follows the size of its element. */
class Plot {
  box = { left: 46, top: 8, width: 1, height: 1 };
  xs = [0, 1];
  ys = [0, 1];

  /** @param {HTMLCanvasElement} canvas */
  constructor(canvas) {
    this.canvas = canvas;
    this.context = canvas.getContext("2d");
  }

  X(x) {
    const { box, xs } = this;
    return box.left + ((x - xs[0]) / (xs[1] - xs[0])) * box.width;
  }

  Y(y) {
    const { box, ys } = this;
    return box.top + box.height - ((y - ys[0]) / (ys[1] - ys[0])) * box.height;
  }

  /** Clear the plot and draw its grid. */
  begin(xs, ys, colours) {
    const { context } = this, [width, height] = fitted(this.canvas, context);
    context.clearRect(0, 0, width, height);
    [this.xs, this.ys] = [xs, ys];
    context.font = "11px system-ui, sans-serif";
    context.lineWidth = 1;
    context.setLineDash([]);
    const across = ticks(xs[0], xs[1], Math.max(4, width / 70)), up = ticks(ys[0], ys[1], Math.max(3, height / 36));
    const labels = up.found.map((y) => tickText(y, up.step));
    const wide = Math.max(18, ...labels.map((text) => context.measureText(text).width));
    const box = (this.box = { left: wide + 10, top: 8, width: Math.max(1, width - wide - 18), height: Math.max(1, height - 30) });
    context.fillStyle = colours.soft;
    context.textBaseline = "middle";
    context.textAlign = "right";
    for (const [i, y] of up.found.entries()) {
      context.strokeStyle = y === 0 ? colours.axis : colours.line;
      this.segment(box.left, this.Y(y), box.left + box.width, this.Y(y));
      context.fillText(labels[i], box.left - 6, this.Y(y));
    }
    context.textAlign = "center";
    context.textBaseline = "top";
    for (const x of across.found) {
      context.strokeStyle = colours.line;
      this.segment(this.X(x), box.top + box.height, this.X(x), box.top + box.height + 4);
      const text = tickText(x, across.step), half = context.measureText(text).width / 2;
      context.fillText(text, Math.min(this.X(x), width - half - 1), box.top + box.height + 7);
    }
  }

  segment(x0, y0, x1, y1) {
    const { context } = this;
    context.beginPath();
    context.moveTo(x0, y0);
    context.lineTo(x1, y1);
    context.stroke();
  }

  /** Draw a line through the samples from `first` to `last`; where `broken(i)` is true, the line is interrupted. */
  line(first, last, x, y, colour, dash, broken = null) {
    const { context, box } = this;
    context.save();
    context.beginPath();
    context.rect(box.left, box.top - 2, box.width, box.height + 4);
    context.clip();
    context.strokeStyle = colour;
    context.lineWidth = 1.6;
    context.lineJoin = "round";
    context.setLineDash(dash);
    context.beginPath();
    const stride = broken ? 1 : Math.max(1, Math.floor((last - first) / (2 * box.width)));
    for (let i = first; i <= last; i += stride) {
      const px = this.X(x(i)), py = this.Y(y(i));
      if (i === first || (broken && broken(i))) context.moveTo(px, py);
      else context.lineTo(px, py);
    }
    if (stride > 1) context.lineTo(this.X(x(last)), this.Y(y(last)));
    context.stroke();
    context.restore();
  }

  /** A vertical line at a time. */
  mark(x, colour) {
    const { context, box } = this;
    context.strokeStyle = colour;
    context.setLineDash([2, 3]);
    context.lineWidth = 1;
    this.segment(this.X(x), box.top, this.X(x), box.top + box.height);
    context.setLineDash([]);
  }

  /** A dot at a point, with a rim in the colour of the paper. */
  dot(x, y, colour, paper) {
    const { context } = this;
    context.beginPath();
    context.arc(this.X(x), this.Y(y), 4.5, 0, 2 * Math.PI);
    context.fillStyle = colour;
    context.fill();
    context.lineWidth = 1.5;
    context.strokeStyle = paper;
    context.stroke();
  }

  /** What a pointer is over, in the units of the axes. */
  at(event) {
    const { box, xs, ys } = this, edge = this.canvas.getBoundingClientRect();
    const px = event.clientX - edge.left - box.left, py = event.clientY - edge.top - box.top;
    return [xs[0] + (px / box.width) * (xs[1] - xs[0]), ys[1] - (py / box.height) * (ys[1] - ys[0])];
  }
}
