"use strict";
// The run as it is played: begun anew, continued after a change, held, and shown at a time.

class Player {
  /** When the last frame was drawn. */
  last = 0;

  /**
   * @param {PageState} state
   * @param {Motion} motion
   * @param {Address} address
   */
  constructor(state, motion, address) {
    Object.assign(this, { state, motion, address });
    on("play", "click", () => this.toggle());
    on("start", "click", () => this.begin());
    on("back", "click", () => this.stepBy(-1));
    on("step", "click", () => this.stepBy(1));
    on("time", "input", (event) => this.goTo(Number(event.target.value)));
    on("speed", "input", (event) => this.setSpeed(2 ** Number(event.target.value)));
    document.addEventListener("keydown", (event) => this.key(event));
  }

  /** Begin the run anew from the initial state. */
  begin() {
    this.restart();
    this.motion.measure();
  }

  /** The same, without a run ahead. */
  restart() {
    const { state } = this;
    state.run.begin(state.set.x, state.set.p, state.inputs());
    state.shown = 0;
    this.changed();
  }

  /** A parameter or an input has changed: the run goes on from here. */
  goOn() {
    const { state } = this;
    state.run.goOn(state.shown, state.set.p, state.inputs());
    this.show(state.shown);
    this.changed();
  }

  /** Show a time of what is computed. */
  show(t) {
    this.state.shown = Math.min(t, this.state.run.end);
    this.state.stale = true;
  }

  /** The run is another one: tell what happened in it, and draw. */
  changed() {
    const { run, shown } = this.state, events = run.occurred.filter((event) => event.t <= shown).slice(-3).map((event) => `${event.name} at ${event.t.toFixed(3)} s`);
    say([shown >= run.end ? run.trouble : "", ...events].filter(Boolean).join(" · "));
    this.state.stale = true;
  }

  /** Compute until a time, and show it; false if the motion ends before it. */
  reach(t) {
    const reached = this.state.run.computeTo(t);
    this.show(t);
    return reached;
  }

  /** Go on with the clock, if the run is played. */
  frame(moment) {
    const { state } = this, passed = Math.min(0.05, Math.max(0, (moment - this.last) / 1000));
    this.last = moment;
    if (!state.playing) return;
    if (!this.reach(state.shown + passed * state.set.speed * state.data.pace)) this.hold();
    this.changed();
  }

  play() {
    this.state.playing = true;
    this.last = performance.now();
    this.button();
  }

  hold() {
    this.state.playing = false;
    this.button();
  }

  toggle() {
    this.state.playing ? this.hold() : this.play();
  }

  button() {
    const { playing } = this.state, knob = element("play");
    knob.querySelector("span").textContent = playing ? "Pause" : "Play";
    knob.classList.toggle("on", playing);
    this.state.stale = true;
  }

  stepBy(direction) {
    this.hold();
    this.reach(Math.max(0, this.state.shown + (direction * this.state.data.pace) / 30));
  }

  goTo(t) {
    this.hold();
    this.show(t);
  }

  setSpeed(speed) {
    const words = `${digits(speed * this.state.data.pace, 2)}×`, slider = element("speed");
    this.state.set.speed = speed;
    slider.value = String(Math.log2(speed));
    element("speed-value").textContent = words;
    slider.setAttribute("aria-valuetext", words);
    this.address.remember();
  }

  key(event) {
    if (event.ctrlKey || event.metaKey || event.altKey || event.target.closest("input, select, textarea, button, summary, a, dialog")) return;
    if (event.key === " ") this.toggle();
    else if (event.key === "ArrowRight") this.stepBy(1);
    else if (event.key === "ArrowLeft") this.stepBy(-1);
    else return;
    event.preventDefault();
  }
}
