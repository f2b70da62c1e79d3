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

/** A plot that fills while runs come from the background. What extends it takes what has come, and shows it. */
class BackgroundPlot {
  /** What is computed, once anything is. */
  asked = null;
  /** Whether the next frame shows what has come. */
  due = false;
  runs = new Map();

  /**
   * @param {string} kind  of the job, which is also the name of the panel
   * @param {PageState} state
   * @param {(words: string) => void} told
   */
  constructor(kind, state, told) {
    Object.assign(this, { kind, state, told, plot: new Plot(element(`${kind}-canvas`)) });
    this.background = new Background((found) => this.take(found), told);
  }

  /** Begin anew with a job. */
  draw(job) {
    this.asked = job;
    this.runs.clear();
    this.began = performance.now();
    this.background.ask({ ...job, kind: this.kind });
  }

  /** The time since then, in words. */
  passed() {
    return `${((performance.now() - this.began) / 1000).toFixed(1)} s`;
  }

  /** Show what has come with the next frame. */
  showSoon() {
    if (this.due) return;
    this.due = true;
    requestAnimationFrame(() => {
      this.due = false;
      this.show();
    });
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
  return Number(element(id).value.replaceAll("−", "-").replace(",", "."));
}
