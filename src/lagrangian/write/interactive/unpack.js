"use strict";
// Formulas, sliders, data and scripts come packed, for they are the most of a page.

(async function unpack() {
  const text = document.getElementById("packed").textContent.trim();
  const values = new Map();
  for (let c = 33; c < 127; c++) if (!'"&<'.includes(String.fromCharCode(c))) values.set(c, values.size);
  const value = (n) => values.get(text.charCodeAt(n));
  const bytes = new Uint8Array(text.length / 16 * 13);
  for (let n = 0, end = 0, word = 0, bits = 0; n < text.length; n += 2) { // 13 bits in two characters
    word = (word & 255) << 13 | value(n) + 91 * value(n + 1);
    for (bits += 13; bits > 7; bits -= 8) bytes[end++] = word >> (bits - 8);
  }
  const parts = await new Response(new Blob([bytes.subarray(1, bytes.length - bytes[0])]).stream().pipeThrough(new DecompressionStream("deflate"))).json();
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
