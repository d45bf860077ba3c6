// Small plots: points before and after, a line, two axes.
const SIZE = { width: 300, height: 210, left: 52, right: 290, top: 26, bottom: 164 };

function escaped(text) {
  const names = { "&": "&amp;", "<": "&lt;", ">": "&gt;", '"': "&quot;" };
  return String(text).replace(/[&<>"]/g, (c) => names[c]);
}

// Round numbers (1, 2, 5 times a power of ten) within an interval.
function ticks([low, high], count) {
  const wanted = (high - low) / count;
  if (!(wanted > 0) || !Number.isFinite(wanted)) return [low];
  const power = 10 ** Math.floor(Math.log10(wanted));
  const step = [1, 2, 5, 10].find((m) => m * power >= wanted * 0.999) * power;
  const found = [];
  for (let k = Math.ceil(low / step - 1e-9); k * step <= high + 1e-9 * step; k++) {
    found.push(k * step);
  }
  return found;
}

function shown(x) {
  return String(Number(x.toPrecision(4))).replace("-", "−");
}

// The interval of some numbers, a little wider; never without width.
function around(values, wider = 0.04) {
  let [low, high] = [Infinity, -Infinity];
  for (const v of values) {
    if (v < low) low = v;
    if (v > high) high = v;
  }
  if (!(low <= high)) return [-1, 1];
  const edge = high > low ? wider * (high - low) : Math.abs(low) * 0.5 || 1;
  return [low - edge, high + edge];
}

function scale([low, high], [from, to]) {
  return (x) => from + ((x - low) / (high - low)) * (to - from);
}

function dots(points, x, y) {
  return points.map(([u, v]) => `M${x(u).toFixed(1)} ${y(v).toFixed(1)}h0`).join("");
}

function curve(points, x, y) {
  const at = ([u, v], k) => `${k ? "L" : "M"}${x(u).toFixed(1)} ${y(v).toFixed(1)}`;
  return points.map(at).join("");
}

// `series` holds {class, points}; `lines` curves, or {style, points}; all in the units of the axes.
function plot({ id, title, description, x, y, series, lines, size = SIZE }) {
  const { width, height, left, right, top, bottom } = size;
  const atX = scale(x.domain, [left, right]);
  const atY = scale(y.domain, [bottom, top]);
  let text = `<title id="${id}-t">${escaped(title)}</title>` +
    `<desc id="${id}-d">${escaped(description)}</desc>` +
    `<text x="${left}" y="16">${escaped(title)}</text>`;
  for (const tick of x.ticks ?? ticks(x.domain, Math.round(width / 75))) {
    const px = atX(tick).toFixed(1);
    text += `<line class="mark" x1="${px}" x2="${px}" y1="${top}" y2="${bottom}"/>` +
      `<text class="tick" text-anchor="middle" x="${px}" y="${bottom + 16}">${shown(tick)}</text>`;
  }
  for (const tick of ticks(y.domain, 4)) {
    const px = atY(tick).toFixed(1);
    text += `<line class="${tick === 0 ? "zero" : "mark"}" x1="${left}" x2="${right}" ` +
      `y1="${px}" y2="${px}"/><text class="tick" text-anchor="end" x="${left - 6}" ` +
      `y="${Number(px) + 4}">${shown(tick)}</text>`;
  }
  for (const { name, points } of series) {
    text += `<path class="many ${name}" d="${dots(points, atX, atY)}"/>`;
    // What was before is hollow: shape and colour both tell.
    if (name === "before") text += `<path class="many inside" d="${dots(points, atX, atY)}"/>`;
  }
  for (const line of lines) {
    const { style, points } = line.points ? line : { style: "trend", points: line };
    text += `<path class="${style}" d="${curve(points, atX, atY)}"/>`;
  }
  const [across, down] = [(left + right) / 2, (top + bottom) / 2];
  text += `<rect class="frame" x="${left}" y="${top}" width="${right - left}" ` +
    `height="${bottom - top}"/><text class="name" text-anchor="middle" x="${across}" ` +
    `y="${bottom + 34}">${escaped(x.name)}</text><text class="name" text-anchor="middle" ` +
    `transform="translate(12 ${down}) rotate(-90)">${escaped(y.name)}</text>`;
  return `<svg class="plot" viewBox="0 0 ${width} ${height}" role="img" ` +
    `aria-labelledby="${id}-t ${id}-d">${text}</svg>`;
}
