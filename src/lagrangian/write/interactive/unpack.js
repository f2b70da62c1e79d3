"use strict";
// Formulas, sliders, data and scripts come packed, for they are the most of a page.

(async function unpack() {
  const text = document.getElementById("packed").textContent.trim();
  const digits = "0123456789ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz!#$%&()*+-;,=>?@^_`{|}~";
  const values = Object.fromEntries([...digits].map((c, i) => [c, i]));
  const count = Math.ceil(text.length / 5);
  const view = new DataView(new ArrayBuffer(4 * count));
  for (let n = 0; n < count; n++) {
    let word = 0; // of base 85; the last one may be short
    for (let i = 0; i < 5; i++) word = 85 * word + (values[text[5 * n + i]] ?? 84);
    view.setUint32(4 * n, word);
  }
  const bytes = new Uint8Array(view.buffer, 0, 4 * count - (5 * count - text.length));
  const parts = await new Response(new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate"))).json();
  for (const [id, text, type] of parts) {
    if (type === "text/html") {
      document.getElementById(id).innerHTML = text;
      continue;
    }
    const script = document.createElement("script");
    [script.id, script.type, script.textContent] = [id, type, text];
    document.body.append(script); // what is JavaScript runs here
  }
})().catch((error) => (document.getElementById("status").textContent = `Nothing moves here: ${error.message}`));
