"use strict";
// What lies in front in space: the order of the solids, from back to front, for every view and every position.
// The same rule as in the schematic: of two solids that overlap as they are seen, the one that is nearer to the eye
// where their axes are nearest on the screen comes last.

/** Where two pieces of lines are nearest to each other, by their parameters in [0, 1], and how far they are. */
function nearestOf([a, b], [c, d]) {
  const e = [b[0] - a[0], b[1] - a[1]], f = [d[0] - c[0], d[1] - c[1]], g = [c[0] - a[0], c[1] - a[1]];
  const foot = (x, y, way, from) => {
    const square = way[0] ** 2 + way[1] ** 2;
    return square > 1e-12 ? ((x - from[0]) * way[0] + (y - from[1]) * way[1]) / square : 0.5;
  };
  const cross = e[0] * f[1] - e[1] * f[0];
  const tried = [0, 1].flatMap((x) => [[x, foot(a[0] + x * e[0], a[1] + x * e[1], f, c)], [foot(c[0] + x * f[0], c[1] + x * f[1], e, a), x]]);
  if (Math.abs(cross) > 1e-9) tried.unshift([(g[0] * f[1] - g[1] * f[0]) / cross, (g[0] * e[1] - g[1] * e[0]) / cross]);
  let best = [0.5, 0.5, Infinity];
  for (const pair of tried) {
    const [s, t] = pair.map((x) => Math.min(1, Math.max(0, x)));
    const gap = Math.hypot(a[0] + s * e[0] - c[0] - t * f[0], a[1] + s * e[1] - c[1] - t * f[1]);
    if (gap < best[2] - 1e-9) best = [s, t, gap];
  }
  return best;
}

/**
 * The numbers of the solids of a picture, from back to front.
 * @param {Picture} picture  in the position and from the side from which it is seen
 */
function depthOrder(picture) {
  const { scene, view, r } = picture, [across, down] = view, pixel = 1 / scene.scale;
  const eye = [0, 1, 2].map((i) => across[(i + 2) % 3] * down[(i + 1) % 3] - across[(i + 1) % 3] * down[(i + 2) % 3]);
  const far = (anchor) => eye[0] * r[3 * anchor] + eye[1] * r[3 * anchor + 1] + eye[2] * r[3 * anchor + 2];
  const items = scene.solids.map(([a, b, radius, lift]) => ({ ends: [picture.seen(a), picture.seen(b)], far: [far(a), far(b)], radius, lift: lift * pixel, behind: new Set() }));
  for (const item of items) item.box = [0, 1].map((i) => [Math.min(item.ends[0][i], item.ends[1][i]) - item.radius, Math.max(item.ends[0][i], item.ends[1][i]) + item.radius]);
  const apart = (one, two) => one.box.some(([low, high], i) => low > two.box[i][1] || high < two.box[i][0]);
  const at = ({ far: [a, b], lift }, s) => a + s * (b - a) + lift;
  items.forEach((one, i) => {
    for (let j = 0; j < i; j++) {
      const two = items[j];
      if (apart(one, two)) continue;
      const [s, t, gap] = nearestOf(one.ends, two.ends);
      if (gap > one.radius + two.radius) continue;
      const difference = at(one, s) - at(two, t);
      if (difference > 0.75 * pixel) one.behind.add(j);
      else if (difference < -0.75 * pixel) two.behind.add(i);
    }
  });
  const waiting = new Set(items.keys()), order = [];
  while (waiting.size) {
    const ready = [...waiting].filter((i) => ![...items[i].behind].some((j) => waiting.has(j)));
    const next = (ready.length ? ready : [...waiting]).reduce((a, b) => (at(items[b], 0.5) < at(items[a], 0.5) ? b : a));
    waiting.delete(next);
    order.push(next);
  }
  return order;
}
