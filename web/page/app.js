// The page: a robot, a table, its columns, a diagnosis, and what is downloaded.
"use strict";

const at = (id) => document.getElementById(id);
const decoder = new TextDecoder();
const bytesOf = (text) => new TextEncoder().encode(text);

// What was chosen: each a name and bytes; what the reader said of columns.
const chosen = { robot: null, data: null, bench: null, log: false, said: new Map() };
let shown = null;

function say(text, wrong = false) {
  at("state").textContent = text;
  at("state").classList.toggle("wrong", wrong);
}

function element(tag, properties = {}, ...inside) {
  const made = Object.assign(document.createElement(tag), properties);
  made.append(...inside);
  return made;
}

// The name by which a command reads a robot: a built-in id, or a file whose ending says what it is.
function robotNamed({ name, bytes }) {
  if (!bytes || /\.(toml|urdf|json)$/.test(name)) return name;
  return name + (decoder.decode(bytes).trimStart().startsWith("<") ? ".urdf" : ".toml");
}

function robotFiles() {
  const files = new Map();
  if (chosen.robot.bytes) files.set(robotNamed(chosen.robot), chosen.robot.bytes);
  return files;
}

// A name that the input does not show: of a file that was dropped, of an example.
const beside = (input, name) => (at(input).files[0]?.name === name ? "" : name);

async function takeRobot(file) {
  chosen.robot = { name: file.name, bytes: new Uint8Array(await file.arrayBuffer()) };
  at("robot-name").textContent = beside("robot-file", file.name);
  at("built-in").value = "";
  await look();
}

async function takeData(name, bytes) {
  Object.assign(chosen, { data: { name, bytes }, said: new Map() });
  at("data-name").textContent = beside("data-file", name);
  chosen.log = isLog(decoder.decode(bytes));
  at("kind").value = chosen.log ? "log" : "campaign";
  await look();
}

// What is known of the bench; nothing without a file.
async function takeBench(file) {
  chosen.bench = file ? { name: file.name, bytes: new Uint8Array(await file.arrayBuffer()) } : null;
  at("bench-name").textContent = file ? beside("bench-file", file.name) : "";
  if (!file) at("bench-file").value = "";
  at("no-bench").hidden = !file;
}

// Shows the columns as they are understood; a table that is a measurement file already stays as it is.
async function look() {
  at("side").hidden = !chosen.log;
  at("bench").hidden = chosen.log;
  at("diagnose").disabled = !(chosen.robot && chosen.data);
  if (!chosen.data) return;
  const { name, bytes } = chosen.data;
  const map = mapOf(chosen.said);
  at("map").textContent = map ?? "";
  at("map-shown").hidden = !map;
  if (chosen.log) {
    chosen.table = null;
    columns(logged(decoder.decode(bytes)));
    return say("");
  }
  const files = new Map([[name, bytes]]);
  if (map) files.set("map.toml", bytesOf(map));
  const words = ["measurements", name, ...(map ? ["--map", "map.toml"] : []), "--csv", "<readings"];
  const answer = await run(words, files);
  if (answer.failure) {
    at("columns").hidden = true;
    return say(answer.failure, true);
  }
  const csv = answer.written.get("<readings");
  const found = understood(answer.remarks, csv);
  chosen.table = !map && isOurs(found, answer.remarks) ? null : { name: "readings.csv", bytes: bytesOf(csv) };
  columns(found);
  say(answer.remarks.filter((remark) => !/^(note: )?`/.test(remark)).join(" "));
}

function columns(found) {
  const short = (value) => (/^-?[\d.]+$/.test(value) ? String(Number(Number(value).toPrecision(6))) : value);
  const rows = found.map(({ theirs, role, unit, values }) => {
    const said = chosen.said.get(theirs) ?? { role, unit };
    const roleOf = element("input", { value: said.role, size: 11, placeholder: "not used" });
    roleOf.setAttribute("list", "roles");
    roleOf.setAttribute("aria-label", `what ${theirs} is`);
    const units = ["", ...new Set([said.unit, ...(UNITS[dimension(said.role)] ?? [])])].filter((u, k) => u || !k);
    const unitOf = element("select", {}, ...units.map((u) => new Option(u || "–", u, false, u === said.unit)));
    unitOf.setAttribute("aria-label", `unit of ${theirs}`);
    const change = (unit) => {
      chosen.said.set(theirs, { role: roleOf.value.trim(), unit });
      look().catch(failed);
    };
    roleOf.onchange = () => change("");
    unitOf.onchange = () => change(unitOf.value);
    const firsts = element("td", { className: "number" }, values.map(short).join("  "));
    return element("tr", {}, element("th", { scope: "row" }, theirs), element("td", {}, roleOf), element("td", {}, unitOf), firsts);
  });
  at("rows").replaceChildren(...rows);
  at("columns").hidden = false;
}

// The words that the reader added, as a shell parts them.
const added = () => (at("options").value.match(/'[^']*'|"[^"]*"|\S+/g) ?? []).map((word) => word.replace(/^['"]|['"]$/g, ""));

async function diagnose() {
  const files = robotFiles();
  const data = chosen.table ?? chosen.data;
  files.set(data.name, data.bytes);
  const words = ["diagnose", robotNamed(chosen.robot), data.name];
  const map = chosen.log && mapOf(chosen.said);
  if (map) {
    files.set("map.toml", bytesOf(map));
    words.push("--map", "map.toml");
  }
  if (chosen.bench && !chosen.log) {
    files.set(chosen.bench.name, chosen.bench.bytes);
    words.push("--bench", chosen.bench.name);
  }
  if (chosen.log && at("torque-side").value) words.push("--torque-side", at("torque-side").value);
  words.push(...added());
  const outputs = { "--json": "<json", "--report": "<report", "--write-robot": "<robot" };
  busy(true, words);
  const begun = performance.now();
  const answer = await run([...words, ...Object.entries(outputs).flat()], files, progress);
  if (answer.failure) return say(answer.failure, true);
  shown = { answer, words, files };
  at("report").srcdoc = answer.written.get("<report");
  at("result").hidden = false;
  at("remarks").textContent = answer.remarks.join("\n");
  say(`Done in ${((performance.now() - begun) / 1000).toFixed(1)} s.`);
  at("result").scrollIntoView();
}

function busy(is, words = []) {
  at("work").hidden = !is;
  // What is being diagnosed does not change meanwhile.
  for (const part of document.querySelectorAll("header, .inputs, #columns")) part.inert = is;
  at("diagnose").disabled = is || !(chosen.robot && chosen.data);
  if (is) {
    at("result").hidden = true;
    at("command").textContent = `stiffarm ${words.map((w) => (/[^\w./:=,+-]/.test(w) ? `'${w}'` : w)).join(" ")}`;
    progress("", -1);
    say("");
    at("cancel").focus();
  }
}

function progress(what, part) {
  at("doing").textContent = what;
  if (part < 0) at("bar").removeAttribute("value");
  else at("bar").value = part;
}

function failed(error) {
  say(error instanceof Ended ? "Cancelled." : `The work broke off: ${error.message}`, !(error instanceof Ended));
}

function download(name, text) {
  const link = element("a", { download: name, href: URL.createObjectURL(new Blob([text])) });
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 1000);
}

// What is made of the diagnosis when it is asked for.
async function save(what) {
  const { answer, words, files } = shown;
  const direct = { json: ["<json", "diagnosis.json"], report: ["<report", "report.html"], robot: ["<robot", "corrected.toml"] };
  if (direct[what]) return download(direct[what][1], answer.written.get(direct[what][0]));
  if (what === "urdf") {
    const urdf = await run([...words, "--write-urdf", "<urdf"], files);
    return urdf.failure ? say(urdf.failure, true) : download("corrected.urdf", urdf.written.get("<urdf"));
  }
  const corrected = new Map([["corrected.toml", bytesOf(answer.written.get("<robot"))]]);
  const c = await run(["generate", "corrected.toml", "--emit", "c", "--out", "<c>"], corrected);
  if (c.failure) return say(c.failure, true);
  for (const [name, text] of c.written) download(name.split("/").pop(), text);
}

// Each example fills in what a reader would choose; simulated ones are simulated here.
const EXAMPLES = {
  lin: async () => {
    await example("lin_planar", "lin1991_table3.csv", bytesOf(textOf("lin")), "--rival ycd --rival ytd");
  },
  kr240: async () => {
    const words = ["simulate", "kuka_kr240", "--effect", "joint_compliance@joint 2=1.5e-7", "--effect", "backlash@joint 1=0.2 mrad"];
    words.push("--effect", "transmission_error@joint 3:cos 2=0.1mrad,sin 2=0.15mrad", "--poses", "60", "--payload", "200kg");
    words.push("--noise-position", "30um", "--noise-rotation", "0.005deg", "--seed", "4", "--withhold", "--csv", "<kr");
    const options = "--noise-position 30um --noise-rotation 0.005deg";
    const made = await run(words, new Map());
    await example("kuka_kr240", "kr.csv", bytesOf(made.written.get("<kr")), options);
  },
  sockets: async () => {
    const words = ["simulate", "panda", "--measure", "point", "--poses", "90", "--payload", "0kg", "--noise-position", "0.1mm"];
    words.push("--effect", "joint_offset@joint 4=3mrad", "--effect", "joint_compliance@joint 2=2e-4", "--seed", "3", "--csv", "<sockets");
    const made = await run(words, new Map());
    await example("panda", "sockets.csv", bytesOf(made.written.get("<sockets")), "");
  },
  panda: async () => {
    const words = ["simulate", "panda", "--log", "<log", "--runs", "1"];
    words.push("--effect", "coulomb_friction@joint 1=5", "--effect", "viscous_friction@joint 2=3");
    const made = await run(words, new Map());
    await example("panda", "log.csv", bytesOf(made.written.get("<log")), "");
  },
};

async function example(robot, name, bytes, options) {
  chosen.robot = { name: robot };
  at("built-in").value = robot;
  at("robot-name").textContent = "";
  at("options").value = options;
  await takeBench(null);
  await takeData(name, bytes);
  await diagnose();
}

// Every action: one at a time, its error said, what shows work put away.
const act = (action) => async (event) => {
  try {
    await action(event);
  } catch (error) {
    failed(error);
  } finally {
    busy(false);
  }
};

function drop(area, take) {
  const over = (is) => (event) => {
    event.preventDefault();
    area.classList.toggle("over", is);
  };
  area.addEventListener("dragover", over(true));
  area.addEventListener("dragleave", over(false));
  area.addEventListener("drop", act(async (event) => {
    over(false)(event);
    if (event.dataTransfer.files[0]) await take(event.dataTransfer.files[0]);
  }));
}

const dataFrom = async (file) => takeData(file.name, new Uint8Array(await file.arrayBuffer()));
drop(at("robot"), takeRobot);
drop(at("data"), (file) => (file.name.endsWith(".toml") ? takeBench(file) : dataFrom(file)));
at("robot-file").onchange = act(({ target }) => target.files[0] && takeRobot(target.files[0]));
at("data-file").onchange = act(({ target }) => target.files[0] && dataFrom(target.files[0]));
at("bench-file").onchange = act(({ target }) => takeBench(target.files[0]));
at("no-bench").onclick = act(() => takeBench(null));
at("built-in").onchange = act(async ({ target }) => {
  chosen.robot = target.value ? { name: target.value } : null;
  at("robot-name").textContent = "";
  await look();
});
at("kind").onchange = act(async ({ target }) => {
  chosen.log = target.value === "log";
  chosen.said = new Map();
  await look();
});
at("diagnose").onclick = act(diagnose);
at("cancel").onclick = () => end?.();
at("save-map").onclick = () => download("map.toml", at("map").textContent);
for (const button of document.querySelectorAll("[data-save]")) button.onclick = act(() => save(button.dataset.save));
for (const button of document.querySelectorAll("[data-example]")) button.onclick = act(EXAMPLES[button.dataset.example]);

// The robots that the program knows.
act(async () => {
  const answer = await run(["robots", "--json", "<robots"], new Map());
  const robots = JSON.parse(answer.written.get("<robots")).filter((robot) => robot.parameters.length === 0);
  at("built-in").append(...robots.map(({ id, name }) => new Option(`${name} (${id})`, id)));
  document.documentElement.dataset.ready = "yes";
})();
