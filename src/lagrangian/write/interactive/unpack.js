"use strict";
// Formulas, sliders, data and scripts come packed, for they are the most of a page.

(async function unpack() {
  const bytes = Uint8Array.from(atob(document.getElementById("packed").textContent), (c) => c.charCodeAt(0));
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
