"use strict";
// The map of starts: two numbers of the initial state across a picture, coloured by where the motion ends.

/**
 * @param {{canvas: HTMLCanvasElement, job: () => any, angle: (state: number) => boolean, told: (words: string) => void}} parts
 */
function makeMap({ canvas, job, angle, told }) {
  const width = 384, height = 288, context = /** @type {CanvasRenderingContext2D} */ (canvas.getContext("2d"));
  const picture = document.createElement("canvas"), painter = /** @type {CanvasRenderingContext2D} */ (picture.getContext("2d"));
  let worker = /** @type {Worker | null} */ (null), id = 0, asked = /** @type {any} */ (null), range = [Infinity, -Infinity], values = new Float64Array(0), began = 0, started = 0;
  [picture.width, picture.height] = [width, height];

  const hues = Array.from({ length: 256 }, (_, k) => [...ofHue((2 * Math.PI * k) / 256 + 4.2), 255]);

  /** The colour of a hue in Oklab (B. Ottosson, 2020) with a lightness of 0.7 and a chroma of 0.12, as sRGB. */
  function ofHue(h) {
    const L = 0.7, a = 0.12 * Math.cos(h), b = 0.12 * Math.sin(h);
    const [l, m, s] = [L + 0.3963377774 * a + 0.2158037573 * b, L - 0.1055613458 * a - 0.0638541728 * b, L - 0.0894841775 * a - 1.291485548 * b].map((x) => x ** 3);
    const linear = [4.0767416621 * l - 3.3077115913 * m + 0.2309699292 * s, -1.2684380046 * l + 2.6097574011 * m - 0.3413193965 * s, -0.0041960863 * l - 0.7034186147 * m + 1.707614701 * s];
    return linear.map((x) => Math.round(255 * (x <= 0.0031308 ? 12.92 * x : 1.055 * Math.max(x, 0) ** (1 / 2.4) - 0.055)));
  }

  /** The worker runs the page's own scripts. */
  function open() {
    const text = ["engine", "shared", "worker"].map((name) => document.getElementById(name)?.textContent ?? "").join("\n");
    const made = new Worker(URL.createObjectURL(new Blob([text], { type: "text/javascript" })));
    made.addEventListener("message", (event) => event.data.id === id && take(event.data));
    made.addEventListener("error", (event) => told(`The map cannot be computed: ${event.message}`));
    return made;
  }

  /** Begin a new map; what was being computed is dropped. */
  function draw() {
    worker ??= open();
    asked = { ...job(), id: ++id, width, height };
    range = [Infinity, -Infinity];
    [began, started] = [performance.now(), 0];
    worker.postMessage(asked);
    told("Computing …");
  }

  function stop() {
    worker?.postMessage({ id: ++id });
  }

  /** Rows of the map have come. */
  function take({ columns, rows, row, values: some, finest }) {
    if (row === 0) values = new Float64Array(columns * rows).fill(NaN);
    values.set(some, row * columns);
    started += some.length;
    const before = [...range];
    for (const x of some) if (Number.isFinite(x)) range = [Math.min(range[0], x), Math.max(range[1], x)];
    const all = row === 0 || range[0] !== before[0] || range[1] !== before[1];
    paint(columns, rows, all ? 0 : row, row + some.length / columns);
    const done = finest && row + some.length / columns >= rows;
    const ends = angle(asked.which) ? "turns of the circle" : `${range[0].toPrecision(3)} … ${range[1].toPrecision(3)}`;
    told(`${done ? `${(columns * rows).toLocaleString("en")} starts` : `${started.toLocaleString("en")} runs`} in ${((performance.now() - began) / 1000).toFixed(1)} s · colours: ${ends}`.replaceAll("-", "−"));
  }

  function paint(columns, rows, from, to) {
    const image = painter.createImageData(columns, to - from);
    for (let k = 0; k < image.data.length / 4; k++) image.data.set(colour(values[from * columns + k]), 4 * k);
    const small = document.createElement("canvas");
    [small.width, small.height] = [columns, to - from];
    small.getContext("2d")?.putImageData(image, 0, 0);
    painter.imageSmoothingEnabled = false;
    painter.drawImage(small, 0, (from / rows) * height, width, ((to - from) / rows) * height);
    show();
  }

  /** An angle goes round a circle of hues of equal lightness; any other number goes from blue to yellow. */
  function colour(x) {
    if (!Number.isFinite(x)) return [128, 128, 128, 90];
    if (angle(asked.which)) return hues[((Math.round((x / (2 * Math.PI)) * 256) % 256) + 256) % 256];
    const s = range[1] > range[0] ? (x - range[0]) / (range[1] - range[0]) : 0.5;
    const stops = [[48, 18, 92], [38, 92, 160], [42, 150, 135], [132, 198, 84], [250, 226, 80]], at = Math.min(3, Math.floor(4 * s)), part = 4 * s - at;
    return [...stops[at].map((a, i) => Math.round(a + part * (stops[at + 1][i] - a))), 255];
  }

  /** Copy the map, with a cross at the start of the run. */
  function show() {
    const [w, h] = fitted(canvas, context);
    context.imageSmoothingEnabled = false;
    context.clearRect(0, 0, w, h);
    context.drawImage(picture, 0, 0, w, h);
    if (!asked) return;
    const { across, up, x } = { ...asked, ...job() };
    const X = ((x[across.state] - across.low) / (across.high - across.low)) * w, Y = ((up.high - x[up.state]) / (up.high - up.low)) * h;
    for (const [colour_, thick] of [["#000", 4], ["#fff", 1.6]]) {
      context.strokeStyle = String(colour_);
      context.lineWidth = Number(thick);
      context.beginPath();
      context.arc(X, Y, 6, 0, 2 * Math.PI);
      context.stroke();
    }
  }

  /** The two numbers under a pointer. */
  function at(event) {
    const edge = canvas.getBoundingClientRect(), { across, up } = asked;
    const a = Math.min(1, Math.max(0, (event.clientX - edge.left) / edge.width)), b = Math.min(1, Math.max(0, (event.clientY - edge.top) / edge.height));
    return [across.low + a * (across.high - across.low), up.high - b * (up.high - up.low)];
  }

  return { draw, stop, show, at, asked: () => asked };
}
