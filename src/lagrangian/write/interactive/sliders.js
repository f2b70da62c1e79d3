"use strict";
// The sliders: one for each parameter, input and number of the initial state, and the buttons that push.

class Sliders {
  /** What else happens after a change. */
  changed = () => {};
  rows = [...document.querySelectorAll(".control")].map((row) => {
    const [group, index, unit] = ["group", "index", "unit"].map((name) => row.getAttribute(`data-${name}`));
    return { row, group, index: Number(index), range: row.querySelector("input[type=range]"), field: row.querySelector("input[type=text]"), unit };
  });

  /**
   * @param {PageState} state
   * @param {Player} player
   * @param {Address} address
   */
  constructor(state, player, address) {
    Object.assign(this, { state, player, address });
    this.rows.forEach((control) => this.listen(control));
    on("reset", "click", () => {
      for (const group of ["p", "u", "x"]) state.set[group].set(state.data[group].values);
      this.showAll();
      player.begin();
      address.remember();
    });
  }

  listen(control) {
    const { range, field, group, index, row } = control;
    range.addEventListener("input", () => this.change(control, Number(range.value)));
    field.addEventListener("change", () => this.change(control, Number(field.value.replaceAll("−", "-").replace(",", "."))));
    range.addEventListener("dblclick", () => this.change(control, this.state.data[group].values[index]));
    for (const knob of row.querySelectorAll("[data-push]")) this.listenToPush(knob, index);
  }

  /** A button that adds to an input while it is down. */
  listenToPush(knob, index) {
    const by = Number(knob.getAttribute("data-push")), { push } = this.state;
    const hold = (down) => {
      if (push[index] === (down ? by : 0)) return;
      push[index] = down ? by : 0;
      knob.classList.toggle("on", down);
      this.player.goOn();
    };
    knob.addEventListener("pointerdown", () => hold(true));
    for (const name of ["pointerup", "pointerleave", "blur", "keyup"]) knob.addEventListener(name, () => hold(false));
    knob.addEventListener("keydown", (event) => {
      if (event.key === " " || event.key === "Enter") {
        event.preventDefault();
        hold(true);
      }
    });
  }

  show({ group, index, range, field, unit }) {
    const value = this.state.set[group][index], text = digits(value);
    if (value < Number(range.min)) range.min = String(value);
    if (value > Number(range.max)) range.max = String(value);
    range.value = String(value);
    if (document.activeElement !== field) field.value = text;
    range.setAttribute("aria-valuetext", `${text} ${unit}`);
  }

  showAll() {
    this.rows.forEach((control) => this.show(control));
  }

  /** The sliders of the initial state. */
  starts() {
    return this.rows.filter(({ group }) => group === "x");
  }

  showStarts() {
    this.starts().forEach((control) => this.show(control));
  }

  change(control, value) {
    const { state, player } = this;
    if (!Number.isFinite(value)) return this.show(control);
    state.set[control.group][control.index] = value;
    this.show(control);
    if (control.group === "x" || state.shown === 0) player.begin();
    else player.goOn();
    this.address.remember();
    this.changed();
  }

  /** Begin anew at an initial state that was set elsewhere. */
  begin() {
    this.showStarts();
    this.player.begin();
    this.address.remember();
  }
}
