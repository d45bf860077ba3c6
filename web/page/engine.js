// Calls commands of stiffarm in a worker. Nothing is loaded: program and worker stand in this page.
"use strict";

const textOf = (id) => document.getElementById(id).textContent;

// The program, unpacked and compiled once.
const program = (async () => {
  const packed = Uint8Array.from(atob(textOf("program").trim()), (c) => c.charCodeAt(0));
  const unpacked = new Blob([packed]).stream().pipeThrough(new DecompressionStream("gzip"));
  return WebAssembly.compile(await new Response(unpacked).arrayBuffer());
})();
const code = new Blob([textOf("glue"), "\n", textOf("worker")], { type: "text/javascript" });
const source = URL.createObjectURL(code);

// What ends the command that runs, if one does.
let end = null;

// Runs a command. `files` maps the names in its words to bytes; what it writes to names `<…` is returned by name.
// `hears(what, part)` is called with how far it is.
async function run(words, files, hears = () => {}) {
  const module = await program;
  const worker = new Worker(source);
  let mine;
  try {
    return await new Promise((resolve, reject) => {
      end = mine = () => reject(new Ended());
      worker.onmessage = ({ data }) => {
        if (data.doing) hears(data.doing, data.part);
        else if (data.broken) reject(new Error(data.broken));
        else resolve({ ...data.answer, written: new Map(data.answer.written) });
      };
      worker.onerror = (event) => reject(new Error(event.message));
      worker.postMessage({ module, words, files: [...files] });
    });
  } finally {
    if (end === mine) end = null;
    worker.terminate();
  }
}

class Ended extends Error {}
