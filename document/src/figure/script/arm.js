// The arm in space, turned by mouse, keys and buttons.
{
  const HOME = { turn: -0.9, tilt: 0.35, zoom: 1.1 };
  const [WIDTH, HEIGHT, MARGIN] = [640, 520, 46];
  const svg = document.getElementById("arm");
  const picture = document.getElementById("arm-picture");
  const { places, points, si, unit } = page.scene;
  const view = { ...HOME };
  const narrow = matchMedia("(max-width: 30rem)");

  const through = places.flatMap((place) => place.through);
  const everything = [...through, ...points];
  const low = [0, 1, 2].map((k) => Math.min(...everything.map((p) => p[k])));
  const high = [0, 1, 2].map((k) => Math.max(...everything.map((p) => p[k])));
  const middle = low.map((l, k) => (l + high[k]) / 2);
  const size = Math.hypot(...low.map((l, k) => high[k] - l)) || 1;

  // Nine of ten vectors before are at most a tenth of the picture long: a round factor.
  const lengths = gaps("before").map((g) => Math.hypot(...g)).sort((a, b) => a - b);
  const usual = lengths[Math.floor(0.9 * (lengths.length - 1))] || lengths.at(-1);
  const round = (x) => Number(x.toPrecision(1));
  const standard = usual > 0 ? round(size / 10 / usual) : 1;

  // Orthographic: x to the right, z up, seen along a horizontal direction that tilts.
  function project([x, y, z]) {
    const [c, s] = [Math.cos(view.turn), Math.sin(view.turn)];
    const [u, v, w] = [x - middle[0], y - middle[1], z - middle[2]];
    const [right, away] = [c * u - s * v, s * u + c * v];
    const up = Math.cos(view.tilt) * w + Math.sin(view.tilt) * away;
    const factor = (view.zoom * (Math.min(WIDTH, HEIGHT) - MARGIN)) / size;
    return [WIDTH / 2 + factor * right, HEIGHT / 2 - factor * up];
  }

  const at = (p) => project(p).map((x) => x.toFixed(1)).join(" ");
  const path = (line) => line.map((p, k) => (k ? "L" : "M") + at(p)).join("");

  function floor() {
    const half = size / 2;
    const step = round(size / 6);
    const [x0, y0, z] = [middle[0], middle[1], Math.min(low[2], places[0].through[0][2])];
    let d = "";
    for (let k = Math.ceil((x0 - half) / step); k * step <= x0 + half; k++) {
      d += path([[k * step, y0 - half, z], [k * step, y0 + half, z]]);
    }
    for (let k = Math.ceil((y0 - half) / step); k * step <= y0 + half; k++) {
      d += path([[x0 - half, k * step, z], [x0 + half, k * step, z]]);
    }
    return `<path class="floor" d="${d}"/>`;
  }

  function axes() {
    const from = places[0].through[0];
    return ["x", "y", "z"].map((name, k) => {
      const to = from.map((p, j) => p + (j === k ? size / 10 : 0));
      const [x, y] = project(from.map((p, j) => p + (j === k ? size / 8 : 0)));
      return `<path class="axis-${name}" d="${path([from, to])}"/>` +
        `<text class="tick" text-anchor="middle" x="${x.toFixed(1)}" ` +
        `y="${(y + 4).toFixed(1)}">${name}</text>`;
    }).join("");
  }

  function place({ name, through, share, found }) {
    const part = Math.max(0, Math.min(1, share ?? 0));
    const line = through.length > 1;
    const style = `style="--share:${(100 * part).toFixed(0)}%"`;
    const title = `<title>${escaped(name)}: ${(100 * part).toFixed(0)} % of the gap</title>`;
    if (line) {
      return `<path class="place link" ${style} stroke-width="${(4 + 8 * part).toFixed(1)}" ` +
        `d="${path(through)}">${title}</path>`;
    }
    const [x, y] = project(through[0]);
    return `<circle class="place point${found ? " found" : ""}" ${style} cx="${x.toFixed(1)}" ` +
      `cy="${y.toFixed(1)}" r="${(5 + 5 * part).toFixed(1)}">${title}</circle>`;
  }

  // `base, joints 1, 2`.
  function together(names) {
    const joints = names.filter((name) => name.startsWith("joint "));
    const others = names.filter((name) => !joints.includes(name));
    const numbers = joints.map((name) => name.slice("joint ".length));
    const joint = joints.length > 1 ? "joints" : "joint";
    if (joints.length > 0) others.push(`${joint} ${numbers.join(", ")}`);
    return others.join(", ");
  }

  // Places at one point have one label.
  function labels() {
    const groups = new Map();
    for (const { name, through, found } of places) {
      if (name.startsWith("link") && !found) continue;
      const halfway = () => through[0].map((x, k) => (x + through[2][k]) / 2);
      const p = name.startsWith("link") ? halfway() : through.at(-1);
      const [x, y] = project(p);
      const key = [...groups.keys()].find((k) => Math.hypot(k[0] - x, k[1] - y) < 12) ?? [x, y];
      groups.set(key, [...(groups.get(key) ?? []), name + (found ? " ●" : "")]);
    }
    const taken = [];
    return [...groups].map(([[x, y], names]) => {
      const text = together(names);
      const [u, v, anchor] = free(x, y, text, taken);
      return `<text class="on" text-anchor="${anchor}" x="${u.toFixed(1)}" y="${v.toFixed(1)}">` +
        `${escaped(text)}</text>`;
    }).join("");
  }

  // The first place beside a point where a label lies on no other; above it if there is none.
  function free(x, y, text, taken) {
    // On a phone letters are larger in the picture, as the style has them.
    const letter = narrow.matches ? 1.6 : 1;
    const [wide, high] = [8 * letter * text.length, 16 * letter];
    const rows = [-9, 13, -26, 30, -43, 47, -60, 64].map((dy) => letter * dy);
    const tried = rows.flatMap((dy) => [[x + 13, y + dy, "start"], [x - 13, y + dy, "end"]]);
    const box = ([u, v, anchor]) => [anchor === "end" ? u - wide : u, v - high];
    const apart = ([a, b, w], [c, d]) => a + w < c || c + wide < a || Math.abs(b - d) >= high;
    const found = tried.find((at) => taken.every((other) => apart(other, box(at)))) ?? tried[0];
    taken.push([...box(found), wide]);
    return found;
  }

  function draw() {
    const when = document.querySelector('input[name="when"]:checked').value;
    const factor = standard * 10 ** Number(document.getElementById("magnify").value);
    const drawn = gaps(when);
    const tip = (p, g) => p.map((x, k) => x + factor * g[k]);
    const lines = points.map((p, k) => path([p, tip(p, drawn[k])])).join("");
    const tails = points.map((p) => `M${at(p)}h0`).join("");
    const links = places.filter((p) => p.through.length > 1);
    const joints = places.filter((p) => p.through.length === 1);
    picture.innerHTML = floor() + axes() +
      `<path class="vectors ${when}" d="${lines}"/><path class="tails ${when}" d="${tails}"/>` +
      links.map(place).join("") + joints.map(place).join("") + labels() + legend(factor);
    const magnified = document.getElementById("magnified");
    magnified.textContent = `${shown(Number(factor.toPrecision(2)))} times`;
  }

  // How long a round gap is in the picture.
  function legend(factor) {
    const px = (view.zoom * (Math.min(WIDTH, HEIGHT) - MARGIN)) / size;
    const gap = round(70 / px / factor / si);
    const length = (gap * si * factor * px).toFixed(1);
    return `<path class="interval" d="M20 ${HEIGHT - 20}h${length}"/>` +
      `<text class="tick" x="20" y="${HEIGHT - 28}">${shown(gap)} ${escaped(unit)}</text>`;
  }

  const STEP = 0.12;
  const moves = {
    left: () => { view.turn -= STEP; },
    right: () => { view.turn += STEP; },
    up: () => { view.tilt = Math.min(Math.PI / 2, view.tilt + STEP); },
    down: () => { view.tilt = Math.max(-Math.PI / 2, view.tilt - STEP); },
    in: () => { view.zoom = Math.min(20, view.zoom * 1.2); },
    out: () => { view.zoom = Math.max(0.2, view.zoom / 1.2); },
    home: () => { Object.assign(view, HOME); },
  };
  const keys = {
    ArrowLeft: "left", ArrowRight: "right", ArrowUp: "up", ArrowDown: "down",
    "+": "in", "=": "in", "-": "out", 0: "home",
  };
  const move = (name) => { moves[name](); draw(); };

  svg.addEventListener("keydown", (event) => {
    const name = keys[event.key];
    if (!name || event.ctrlKey || event.metaKey || event.altKey) return;
    event.preventDefault();
    move(name);
  });
  let held = null;
  svg.addEventListener("pointerdown", (event) => {
    held = [event.clientX, event.clientY];
    svg.setPointerCapture(event.pointerId);
  });
  svg.addEventListener("pointermove", (event) => {
    if (!held) return;
    view.turn += (event.clientX - held[0]) / 150;
    view.tilt += (event.clientY - held[1]) / 150;
    view.tilt = Math.max(-Math.PI / 2, Math.min(Math.PI / 2, view.tilt));
    held = [event.clientX, event.clientY];
    draw();
  });
  for (const end of ["pointerup", "pointercancel"]) {
    svg.addEventListener(end, () => { held = null; });
  }
  narrow.addEventListener("change", draw);
  for (const button of document.querySelectorAll("[data-turn]")) {
    button.addEventListener("click", () => move(button.dataset.turn));
  }
  for (const input of document.querySelectorAll('input[name="when"], #magnify')) {
    input.addEventListener("input", draw);
  }
  document.getElementById("arm-line").textContent = page.scene.line;
  draw();
}
