"use strict";
// The map of starts: two numbers of the initial state across a picture, coloured by where the motion ends.

const HUES = Array.from({ length: 256 }, (_, k) => [...ofHue((2 * Math.PI * k) / 256 + 4.2), 255]);

/** The colour of a hue in Oklab (B. Ottosson, 2020) with a lightness of 0.7 and a chroma of 0.12, as sRGB. */
function ofHue(h) {
  const L = 0.7, a = 0.12 * Math.cos(h), b = 0.12 * Math.sin(h);
  const [l, m, s] = [L + 0.3963377774 * a + 0.2158037573 * b, L - 0.1055613458 * a - 0.0638541728 * b, L - 0.0894841775 * a - 1.291485548 * b].map((x) => x ** 3);
  const linear = [4.0767416621 * l - 3.3077115913 * m + 0.2309699292 * s, -1.2684380046 * l + 2.6097574011 * m - 0.3413193965 * s, -0.0041960863 * l - 0.7034186147 * m + 1.707614701 * s];
  return linear.map((x) => Math.round(255 * (x <= 0.0031308 ? 12.92 * x : 1.055 * Math.max(x, 0) ** (1 / 2.4) - 0.055)));
}

/** An angle goes round a circle of hues of equal lightness; any other number goes from blue to yellow. */
function colourOf(x, [low, high], round) {
  if (!Number.isFinite(x)) return [128, 128, 128, 90];
  if (round) return HUES[((Math.round((x / (2 * Math.PI)) * 256) % 256) + 256) % 256];
  const s = high > low ? (x - low) / (high - low) : 0.5;
  const stops = [[48, 18, 92], [38, 92, 160], [42, 150, 135], [132, 198, 84], [250, 226, 80]], at = Math.min(3, Math.floor(4 * s)), part = 4 * s - at;
  return [...stops[at].map((a, i) => Math.round(a + part * (stops[at + 1][i] - a))), 255];
}

class StartMap {
  width = 384;
  height = 288;
  /** What is computed, once anything is. */
  asked = null;
  picture = document.createElement("canvas");

  /**
   * @param {{canvas: HTMLCanvasElement, job: () => any, angle: (state: number) => boolean, told: (words: string) => void}} parts
   */
  constructor(parts) {
    Object.assign(this, parts);
    this.background = new Background((found) => this.take(found), this.told);
    [this.picture.width, this.picture.height] = [this.width, this.height];
  }

  /** Begin a new map; what was being computed is dropped. */
  draw() {
    this.asked = { ...this.job(), width: this.width, height: this.height };
    this.range = [Infinity, -Infinity];
    [this.began, this.started] = [performance.now(), 0];
    this.background.ask({ ...this.asked, kind: "map" });
    this.told("Computing …");
  }

  /** Rows of the map have come. */
  take({ columns, rows, row, values: some, finest }) {
    if (row === 0) this.values = new Float64Array(columns * rows).fill(NaN);
    this.values.set(some, row * columns);
    this.started += some.length;
    const [low, high] = this.range;
    for (const x of some) if (Number.isFinite(x)) this.range = [Math.min(this.range[0], x), Math.max(this.range[1], x)];
    const all = row === 0 || this.range[0] !== low || this.range[1] !== high, end = row + some.length / columns;
    this.paint(columns, rows, all ? 0 : row, end);
    this.told(this.words(finest && end >= rows ? `${(columns * rows).toLocaleString("en")} starts` : `${this.started.toLocaleString("en")} runs`));
  }

  /** What was computed, in which time, and what the colours mean. */
  words(count) {
    const ends = this.angle(this.asked.which) ? "turns of the circle" : this.range.map((x) => x.toPrecision(3)).join(" … ");
    return `${count} in ${((performance.now() - this.began) / 1000).toFixed(1)} s · colours: ${ends}`.replaceAll("-", "−");
  }

  /** Paint some of the rows. */
  paint(columns, rows, from, to) {
    const small = document.createElement("canvas"), image = new ImageData(columns, to - from), round = this.angle(this.asked.which);
    for (let k = 0; k < image.data.length / 4; k++) image.data.set(colourOf(this.values[from * columns + k], this.range, round), 4 * k);
    [small.width, small.height] = [columns, to - from];
    small.getContext("2d").putImageData(image, 0, 0);
    const painter = this.picture.getContext("2d"), { width, height } = this;
    painter.imageSmoothingEnabled = false;
    painter.drawImage(small, 0, (from / rows) * height, width, ((to - from) / rows) * height);
    this.show();
  }

  /** Copy the map, with a ring at the start of the run. */
  show() {
    const context = this.canvas.getContext("2d"), [w, h] = fitted(this.canvas, context);
    context.imageSmoothingEnabled = false;
    context.clearRect(0, 0, w, h);
    context.drawImage(this.picture, 0, 0, w, h);
    if (!this.asked) return;
    const { across, up, x } = { ...this.asked, ...this.job() };
    const X = ((x[across.state] - across.low) / (across.high - across.low)) * w, Y = ((up.high - x[up.state]) / (up.high - up.low)) * h;
    for (const [colour, thick] of [["#000", 4], ["#fff", 1.6]]) {
      context.strokeStyle = colour;
      context.lineWidth = thick;
      context.beginPath();
      context.arc(X, Y, 6, 0, 2 * Math.PI);
      context.stroke();
    }
  }

  /** The two numbers under a pointer. */
  at(event) {
    const edge = this.canvas.getBoundingClientRect(), { across, up } = this.asked;
    const a = Math.min(1, Math.max(0, (event.clientX - edge.left) / edge.width)), b = Math.min(1, Math.max(0, (event.clientY - edge.top) / edge.height));
    return [across.low + a * (across.high - across.low), up.high - b * (up.high - up.low)];
  }
}

/**
 * Put the map on the page: with its choices, and with a pointer that begins a run. Returns what draws it again.
 * @param {PageState} state
 * @param {Sliders} sliders
 */
function offerMap(state, sliders) {
  const { set, data } = state, canvas = element("map-canvas");
  const chosen = (id) => Number(element(`map-${id}`).value);
  const axis = (id) => {
    const n = chosen(id), { range } = sliders.starts()[n];
    return { state: n, low: Number(range.min), high: Number(range.max) };
  };
  const map = new StartMap({
    canvas,
    job: () => ({ x: set.x, p: set.p, u: set.u, across: axis("x"), up: axis("y"), which: chosen("of"), end: chosen("end"), machine: data.machine }),
    angle: (n) => state.angle(n),
    told: (words) => (element("map-told").textContent = words),
  });
  const pick = (event) => {
    if (!map.asked) return;
    const { across, up } = map.asked, [a, b] = map.at(event);
    set.x[across.state] = a;
    set.x[up.state] = b;
    sliders.begin();
    map.show();
  };
  canvas.addEventListener("pointerdown", pick);
  canvas.addEventListener("pointermove", (event) => event.buttons && pick(event));
  return whileOpen("map", ["map-x", "map-y", "map-of", "map-end"], () => map.draw(), () => map.background.stop());
}
