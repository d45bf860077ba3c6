// The embedded numbers, and the files made of them when their link is followed.
const page = JSON.parse(document.getElementById("data").textContent);

function cell(value) {
  if (value === null || value === undefined) return "";
  const text = String(value);
  return /[",\r\n]/.test(text) ? `"${text.replaceAll('"', '""')}"` : text;
}

function csv({ columns, rows }) {
  return [columns, ...rows].map((row) => row.map(cell).join(",")).join("\n") + "\n";
}

// The gap of each row in space, `before` or `after`.
function gaps(when) {
  const columns = page.rows.vectors[when === "before" ? 0 : 1];
  return page.rows.table.rows.map((row) => columns.map((c) => (c === null ? 0 : row[c])));
}

function vectors() {
  const unit = page.scene.gap === "position" ? "m" : "rad";
  const columns = ["line", "x[m]", "y[m]", "z[m]"];
  for (const when of ["before", "after"]) {
    for (const axis of "xyz") columns.push(`${when}_${axis}[${unit}]`);
  }
  const points = page.scene.points;
  const [before, after] = [gaps("before"), gaps("after")];
  const line = (k) => page.rows.table.rows[k][0];
  const rows = points.map((p, k) => [line(k), ...p, ...before[k], ...after[k]]);
  return { columns, rows };
}

// What lies within an object, by names with `_` between them.
function flat(value, name = "") {
  if (value === null || typeof value !== "object") return { [name]: value };
  const inner = ([key, v]) => flat(v, name ? `${name}_${key}` : key);
  return Object.assign({}, ...Object.entries(value).map(inner));
}

// A list of the report, one row for each entry; what a finding holds has the finding's name.
function entries(value, path, head = {}) {
  if (Array.isArray(value)) return value.flatMap((entry) => entries(entry, path, head));
  if (path.length === 0) return [{ ...head, ...flat(value) }];
  const own = value.effect ? { finding: `${value.effect} at ${value.place}` } : {};
  return entries(value[path[0]] ?? [], path.slice(1), { ...head, ...own });
}

function table(name) {
  if (name === "rows") return page.rows.table;
  if (name === "vectors") return vectors();
  if (name.startsWith("shape-")) return page.shapes[Number(name.slice(6))].table;
  const rows = entries(page.whole, name.split("."));
  const columns = [...new Set(rows.flatMap(Object.keys))];
  return { columns, rows: rows.map((row) => columns.map((column) => row[column])) };
}

// Links get their file when they are followed; the one before is given back.
document.addEventListener("click", (event) => {
  const link = event.target.closest("a[data-csv], a[data-json]");
  if (!link) return;
  if (link.href.startsWith("blob:")) URL.revokeObjectURL(link.href);
  const { csv: name } = link.dataset;
  const text = name ? csv(table(name)) : JSON.stringify(page.whole, null, 2) + "\n";
  const type = name ? "text/csv;charset=utf-8" : "application/json";
  link.href = URL.createObjectURL(new Blob([text], { type }));
}, true);
