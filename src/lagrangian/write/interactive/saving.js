"use strict";
// Taking it along: a link, the model file, a table of the run, a video of the motion.

/** The model file with the values of the sliders. */
function modelText({ data, set }) {
  return data.model.map((piece) => {
    if (typeof piece === "string") return piece;
    const [group, index, unit, factor] = piece, value = set[group][index] / factor;
    const number = String(Number(value.toPrecision(12)));
    return unit ? `"${number} ${unit}"` : number;
  }).join("");
}

/** Samples, a row each: what spreadsheets read. */
function csvText({ data, history, shown }) {
  const quoted = (name) => (/[",\n]/.test(name) ? `"${name.replaceAll('"', '""')}"` : name);
  const head = ["t", ...data.x.names, ...data.u.names, "T", "V"].map(quoted).join(",");
  const columns = [0, ...data.x.names.map((_, i) => 1 + i), ...data.u.names.map((_, i) => history.u + i), history.T, history.V];
  const rows = Array.from({ length: history.index(shown) + 1 }, (_, i) => columns.map((column) => history.at(i, column)).join(","));
  return [head, ...rows].join("\n") + "\n";
}

function save(blob, name) {
  const link = document.createElement("a");
  link.href = URL.createObjectURL(blob);
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 10000);
}

/** Put a text on the clipboard; where that is not allowed, show it to be copied by hand. */
async function copy(knob, text) {
  try {
    await navigator.clipboard.writeText(text);
    const words = knob.textContent;
    knob.textContent = "Copied";
    setTimeout(() => (knob.textContent = words), 1200);
  } catch {
    const dialog = element("copy"), area = dialog.querySelector("textarea");
    area.value = text;
    dialog.showModal();
    area.select();
  }
}

/**
 * @param {PageState} state
 * @param {Address} address
 */
function offerSaving(state, address) {
  const { data } = state;
  on("copy-link", "click", (event) => {
    address.remember(0);
    copy(event.currentTarget, location.href.split("#")[0] + address.text());
  });
  element("copy-link").hidden = ["about:", "blob:"].includes(location.protocol); // a frame has no address of its own
  on("copy-model", "click", (event) => copy(event.currentTarget, modelText(state)));
  element("copy-model").hidden = !data.model.length;
  on("csv", "click", () => save(new Blob([csvText(state)], { type: "text/csv" }), `${data.file}.csv`));
}

/**
 * @param {Player} player
 * @param {HTMLCanvasElement} canvas
 */
function offerRecording(player, canvas) {
  const knob = element("record"), { state } = player;
  let recorder = null;
  const told = (down) => {
    knob.textContent = down ? "Stop" : "Record";
    press(knob, down);
  };
  knob.hidden = typeof MediaRecorder === "undefined" || !canvas.captureStream;
  knob.addEventListener("click", () => {
    if (recorder) return recorder.stop();
    const pieces = [];
    recorder = new MediaRecorder(canvas.captureStream(60), { videoBitsPerSecond: 8e6 });
    recorder.addEventListener("dataavailable", (event) => pieces.push(event.data));
    recorder.addEventListener("stop", () => {
      save(new Blob(pieces, { type: recorder.mimeType }), `${state.data.file}.${recorder.mimeType.includes("mp4") ? "mp4" : "webm"}`);
      recorder = null;
      told(false);
    });
    recorder.start();
    told(true);
    if (!state.playing) player.play();
  });
}
