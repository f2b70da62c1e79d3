"use strict";
// The ground in space: a grid of squares that reaches two of them beyond wherever bodies are or were.

/** The most squares on either side of a body, and how many there are in a row before they become larger. */
const NEAR = 40, IN_A_ROW = 40;

class Ground {
  /** @param {any} part  the grid of the scene, whose own axes go from 0 to 1 along its sides */
  constructor(part) {
    this.part = part;
    const upright = part.path.filter(([letter, x], i) => letter === "L" && x === part.path[i - 1][1]).length;
    this.counts = [upright - 1, part.path.length / 2 - upright - 1];
    this.forget();
  }

  forget() {
    this.reach = this.counts.map((count) => [0, count]);
  }

  /** The places of bodies over the ground, in squares along its two sides. */
  places({ r, scene: { handles } }) {
    const { at, towards, across } = this.part.placement, from = (k) => [0, 1, 2].map((i) => r[3 * k + i] - r[3 * at + i]);
    const sides = [from(towards), from(across)].map((e, i) => e.map((x) => (this.counts[i] * x) / e.reduce((sum, y) => sum + y * y, 0)));
    const found = handles.map((k) => sides.map((e) => from(k).reduce((sum, x, i) => sum + x * e[i], 0)));
    return found.filter(([s, t]) => Number.isFinite(s + t));
  }

  /** Let the ground reach to where the bodies are. */
  tread(picture) {
    for (const place of this.places(picture))
      place.forEach((s, i) => {
        const pair = this.reach[i];
        if (s - 2 < pair[0]) pair[0] = Math.floor(s - 2);
        if (s + 2 > pair[1]) pair[1] = Math.ceil(s + 2);
      });
  }

  /** Draw the lines that are there and near. */
  lay(picture) {
    this.tread(picture);
    const places = this.places(picture);
    if (!places.length) return;
    const ranges = this.reach.map(([low, high], i) => {
      const now = places.map((place) => Math.round(place[i]));
      return [Math.max(low, Math.min(...now) - NEAR), Math.min(high, Math.max(...now) + NEAR)];
    });
    const every = Math.ceil(Math.max(...ranges.map(([low, high]) => high - low)) / IN_A_ROW);
    const [across, up] = ranges.map(([low, high]) => [every * Math.floor(low / every), every * Math.ceil(high / every)]), [n, m] = this.counts;
    const line = (x0, y0, x1, y1) => [["M", x0 / n, y0 / m], ["L", x1 / n, y1 / m]];
    this.part.path = [];
    for (let i = across[0]; i <= across[1]; i += every) this.part.path.push(...line(i, up[0], i, up[1]));
    for (let i = up[0]; i <= up[1]; i += every) this.part.path.push(...line(across[0], i, across[1], i));
  }
}
