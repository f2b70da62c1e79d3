"use strict";
// What is computed in the background, and the panels that show it while they are open.

/** A worker that runs the page's own scripts; what it does is dropped when something else is asked. */
class Background {
  id = 0;
  worker = null;

  /**
   * @param {(found: any) => void} take
   * @param {(words: string) => void} told
   */
  constructor(take, told) {
    Object.assign(this, { take, told });
  }

  ask(job) {
    this.worker ??= this.open();
    this.worker.postMessage({ ...job, id: ++this.id });
  }

  stop() {
    this.worker?.postMessage({ id: ++this.id });
  }

  open() {
    const text = ["engine", "shared", "worker"].map((name) => element(name).textContent).join("\n");
    const made = new Worker(URL.createObjectURL(new Blob([text], { type: "text/javascript" })));
    made.addEventListener("message", (event) => event.data.id === this.id && this.take(event.data));
    made.addEventListener("error", (event) => this.told(`This cannot be computed: ${event.message}`));
    return made;
  }
}

/** Draw a panel while it is open, shortly after the last change; returns what tells it of a change. */
function whileOpen(id, controls, draw, stop) {
  const details = element(id).querySelector("details");
  let soon = 0;
  const redraw = () => {
    clearTimeout(soon);
    if (details.open) soon = setTimeout(draw, 40);
    else stop();
  };
  details.addEventListener("toggle", redraw);
  for (const control of controls) for (const event of ["change", "input"]) on(control, event, redraw);
  return redraw;
}

/** The number in a field, with a comma or a point. */
function numberIn(id) {
  return Number(element(id).value.replace("−", "-").replace(",", "."));
}
