// Runs commands, one at a time, on a thread of its own. It stands behind the code that `stiffarm-web-bindgen` writes.
"use strict";

// No more often than a reader sees it.
const TURN = 100;
let told = 0;

globalThis.hears = (what, part) => {
  const now = performance.now();
  if (now - told < TURN) return;
  told = now;
  postMessage({ doing: what, part });
};

globalThis.breaks = (why) => postMessage({ broken: why });

onmessage = async ({ data: { module, words, files } }) => {
  try {
    await wasm_bindgen({ module_or_path: module });
    const given = new wasm_bindgen.Files();
    for (const [name, bytes] of files) given.add(name, bytes);
    postMessage({ answer: JSON.parse(wasm_bindgen.run(words, given)) });
  } catch (error) {
    postMessage({ broken: String(error) });
  }
};
