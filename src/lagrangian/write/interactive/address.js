"use strict";
// The address of the page: what the reader has set stands in it, behind #.

class Address {
  pending = 0;

  /** @param {PageState} state */
  constructor({ set, data }) {
    Object.assign(this, { set, data });
  }

  /** What differs from the model, as the part of an address after #. */
  text() {
    const { set, data } = this, kept = new URLSearchParams();
    for (const group of ["p", "u", "x"])
      set[group].forEach((value, i) => value !== data[group].values[i] && kept.set(`${group}.${data[group].names[i]}`, String(value)));
    if (set.speed !== 1) kept.set("speed", String(set.speed));
    return `#${kept}`;
  }

  remember(wait = 200) {
    clearTimeout(this.pending);
    this.pending = setTimeout(() => {
      try {
        window.history.replaceState(null, "", this.text());
      } catch {
        // a page without an address of its own, such as in a notebook
      }
    }, wait);
  }

  /** Set what the address says, and return its speed. */
  recall() {
    const { set, data } = this, kept = new URLSearchParams(location.hash.slice(1));
    for (const group of ["p", "u", "x"])
      data[group].names.forEach((name, i) => {
        const text = kept.get(`${group}.${name}`), value = Number(text);
        set[group][i] = text !== null && text !== "" && Number.isFinite(value) ? value : data[group].values[i];
      });
    const speed = Number(kept.get("speed"));
    return speed > 0 && Number.isFinite(speed) ? speed : 1;
  }
}
