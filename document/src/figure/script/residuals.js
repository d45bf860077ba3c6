// Residuals against everything that differs between rows, and the fitted shapes.
{
  const BINS = 12;
  const { table: rows, against, components } = page.rows;
  const column = (k, si) => rows.rows.map((row) => (row[k] === null ? null : row[k] / si));
  const mean = (values) => values.reduce((sum, v) => sum + v, 0) / values.length;
  const rms = (values) => Math.sqrt(mean(values.map((v) => v * v)));

  // Classes are drawn beside one another, each row at a place of its own.
  const spread = (v, k) => v + 0.36 * (((k * 0.618034) % 1) - 0.5);

  // Mean of y over equal bins of x; classes are their own bins.
  function trend(points, classes) {
    const [low, high] = around(points.map((p) => p[0]), 1e-9);
    const groups = new Map();
    for (const point of points) {
      const key = classes ? point[0] : Math.floor((BINS * (point[0] - low)) / (high - low));
      if (!groups.has(key)) groups.set(key, []);
      groups.get(key).push(point);
    }
    const inOrder = [...groups].sort((a, b) => a[0] - b[0]).map(([, group]) => group);
    return inOrder.map((g) => [mean(g.map((p) => p[0])), mean(g.map((p) => p[1]))]);
  }

  function panel(thing, k, component, domain) {
    const x = column(thing.column, thing.si);
    const [before, after] = [component.before, component.after].map((c) => column(c, component.si));
    const place = (v, row) => (thing.classes ? spread(v, row) : v);
    const drawn = x.map((v, row) => row).filter((row) => x[row] !== null);
    const series = [["before", before], ["after", after]].map(([name, y]) => (
      { name, points: drawn.map((row) => [place(x[row], row), y[row]]) }
    ));
    const put = trend(drawn.map((row) => [x[row], before[row] - after[row]]), thing.classes);
    const title = `against ${thing.name.split(",")[0]}`;
    return plot({
      id: `r${k}`,
      title,
      description: `${component.name} of the gap ${title}, ${drawn.length} rows: rms ` +
        `${shown(rms(before))} before, ${shown(rms(after))} after, ${component.unit}`,
      x: {
        name: thing.name,
        domain: thing.classes ? [-1.3, 1.3] : around(x.filter((v) => v !== null)),
        ticks: thing.classes ? [-1, 0, 1] : undefined,
      },
      y: { name: component.unit, domain },
      series,
      lines: [put],
    });
  }

  function draw(component) {
    const all = [component.before, component.after].flatMap((c) => column(c, component.si));
    const domain = around([...all, 0]);
    document.getElementById("residuals").innerHTML =
      against.map((thing, k) => panel(thing, k, component, domain)).join("");
  }

  const choice = document.getElementById("component");
  choice.innerHTML = components
    .map((c, k) => `<option value="${k}">${escaped(c.name)}, ${escaped(c.unit)}</option>`).join("");
  // A component with its sign shows shapes that a norm hides: the largest comes first.
  const signed = components.map((c, k) => k).filter((k) => !components[k].name.includes("all"));
  const size = (k) => rms(column(components[k].before, 1));
  const kind = components[0].unit;
  const first = signed.filter((k) => components[k].unit === kind)
    .sort((a, b) => size(b) - size(a))[0] ?? 0;
  choice.value = String(first);
  choice.addEventListener("change", () => draw(components[Number(choice.value)]));
  draw(components[first]);

  function shape(found, k) {
    const { x, y, table: rows, classes } = found;
    const points = rows.rows.map((row, n) => [
      classes ? spread(row[1], n) : row[1] / x.si, row[2] / y.si,
    ]);
    const line = found.curve.map(([u, v]) => [u / x.si, v / y.si]);
    const picture = plot({
      id: `s${k}`,
      title: found.title,
      description: `${y.name} over ${x.name}: the fitted shape and ${points.length} rows around it`,
      x: { name: x.name, domain: around([...points, ...line].map((p) => p[0])) },
      y: { name: y.name, domain: around([...points, ...line].map((p) => p[1])) },
      series: [{ name: "after", points }],
      lines: [line],
    });
    return `<figure>${picture}<figcaption><a href="#" data-csv="shape-${k}" ` +
      `download="shape_${k + 1}.csv">CSV</a></figcaption></figure>`;
  }

  if (page.shapes.length > 0) {
    document.getElementById("shapes").innerHTML = page.shapes.map(shape).join("");
    document.getElementById("shapes-part").hidden = false;
  }
}
