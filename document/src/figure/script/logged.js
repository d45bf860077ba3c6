// What drives a joint against time, what each finding does, friction against speed, and what is left.
{
  const WIDE = { width: 960, height: 300, left: 64, right: 944, top: 30, bottom: 250 };
  const COLOURS = 8;
  const get = (id) => document.getElementById(id);

  // A line of each name; the keys say which is which.
  function wide(id, joint, title, lines) {
    const time = joint.stretch[0];
    const values = lines.flatMap((line) => line.y);
    const picture = plot({
      id,
      title,
      description: `${title} of ${joint.name} against time: ${lines.map((l) => l.name).join(", ")}`,
      x: { name: "time, s", domain: around(time, 1e-9) },
      y: { name: joint.unit, domain: around([...values, 0]) },
      series: [],
      lines: lines.map(({ style, y }) => ({ style, points: y.map((v, k) => [time[k], v]) })),
      size: WIDE,
    }).replace('class="plot"', 'class="plot wide"');
    const key = ({ name, style }) => `<span class="key"><svg viewBox="0 0 16 16" aria-hidden="true">` +
      `<path class="${style}" d="M0 8H16"/></svg> ${escaped(name)}</span>`;
    get(id).innerHTML = picture;
    get(`${id}-key`).innerHTML = lines.map(key).join("");
  }

  // Alone on its axes: what it is against.
  function against(id, joint, [name, at]) {
    const pairs = (column) => joint.points.map((row) => [row[at], row[column]]);
    const values = joint.points.flatMap((row) => [row[4], row[5]]);
    return plot({
      id,
      title: `against ${name.split(",")[0]}`,
      description: `What is left of ${joint.name} against ${name}, before and with the findings`,
      x: { name, domain: around(joint.points.map((row) => row[at])) },
      y: { name: joint.unit, domain: around([...values, 0]) },
      series: [{ name: "before", points: pairs(4) }, { name: "after", points: pairs(5) }],
      lines: [],
    });
  }

  function draw(joint) {
    const [, whole, rigid, model] = joint.stretch;
    const torque = page.what === "torque";
    const lines = [{ name: torque ? "torque" : "error", style: "trend thin", y: whole }];
    if (torque) lines.push({ name: "rigid links", style: "line before", y: rigid });
    lines.push({ name: torque ? "with the findings" : "the findings", style: "line after", y: model });
    wide("time", joint, torque ? "Torque" : "Position error", lines);
    const parts = joint.parts.map(([name, y], k) => ({ name, style: `line c${k % COLOURS}`, y }));
    if (parts.length > 0) wide("parts", joint, "What each finding does", parts);
    else [get("parts").innerHTML, get("parts-key").innerHTML] = ["Nothing was found at this joint.", ""];
    const [points, line] = joint.friction;
    get("friction-part").hidden = points.length === 0;
    get("friction").innerHTML = points.length === 0 ? "" : plot({
      id: "friction-plot",
      title: `friction of ${joint.name}`,
      description: `Friction of ${joint.name} against its speed`,
      x: { name: `speed, ${joint.speed}`, domain: around(points.map((p) => p[0])) },
      y: { name: joint.unit, domain: around([...points.map((p) => p[1]), 0]) },
      series: [{ name: "after", points }],
      lines: [line],
    });
    const axes = [
      [`angle, ${joint.angle}`, 1],
      [`speed, ${joint.speed}`, 2],
      [`${page.what}, ${joint.unit}`, 3],
      ["time, s", 0],
    ];
    if (joint.angle === "mm") axes[0][0] = "place, mm";
    get("rest").innerHTML = axes.map((axis, k) => against(`rest-${k}`, joint, axis)).join("");
  }

  const choice = get("joint");
  choice.innerHTML = page.joints
    .map((joint, k) => `<option value="${k}">${escaped(joint.name)}</option>`).join("");
  choice.addEventListener("change", () => draw(page.joints[Number(choice.value)]));
  // First the joint of which the findings take most.
  const taken = page.whole.gap.map((gap) => (gap.before - gap.after) / gap.size);
  choice.value = String(taken.indexOf(Math.max(...taken)));
  draw(page.joints[Number(choice.value)]);
}
