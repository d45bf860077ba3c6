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

function table(name) {
  if (name === "rows") return page.rows.table;
  if (name === "vectors") return vectors();
  if (name.startsWith("shape-")) return page.shapes[Number(name.slice(6))].table;
  return page.tables[name];
}

// Links get their file when they are followed; the one before is given back.
document.addEventListener("click", (event) => {
  const link = event.target.closest("a[data-csv], a[data-json]");
  if (!link) return;
  if (link.href.startsWith("blob:")) URL.revokeObjectURL(link.href);
  const { csv: name, json } = link.dataset;
  const text = name ? csv(table(name)) : JSON.stringify(page[json], null, 2) + "\n";
  const type = name ? "text/csv;charset=utf-8" : "application/json";
  link.href = URL.createObjectURL(new Blob([text], { type }));
}, true);
