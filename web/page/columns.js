// The columns of a table as they are understood, and what the reader says of them: a map, as `--map` reads it.
"use strict";

const UNITS = {
  length: ["m", "mm", "um", "in"],
  angle: ["rad", "deg", "mrad"],
  force: ["N", "kN", "lbf", "kgf"],
  moment: ["Nm", "Nmm"],
  mass: ["kg", "lb"],
  time: ["s", "ms"],
  temperature: ["degC", "K"],
  current: ["A", "mA"],
};

// What a column of that name measures; of a joint, revolute is assumed.
function dimension(role) {
  const known = [
    [/^(qd?d?|q_cmd)\d+$|^d?r[xyz]$/, "angle"],
    [/^d?[xyz]$|^from_[xyz]$|^distance$|^sigma(_[xyz])?$/, "length"],
    [/^f[xyz]$/, "force"],
    [/^(m[xyz]|tau\d+)$/, "moment"],
    [/^mass$/, "mass"],
    [/^(t|time)$/, "time"],
    [/^temp(erature|\d+)$/, "temperature"],
    [/^i\d+$/, "current"],
  ];
  const found = known.find(([name]) => name.test(role));
  return found ? found[1] : null;
}

// `x[mm]` as name and unit.
function parted(header) {
  const found = /^(.*?)\s*\[([^\]]*)\]\s*$/.exec(header.trim());
  return found ? { name: found[1], unit: found[2] } : { name: header.trim(), unit: "" };
}

const cells = (line) => line.split(",").map((cell) => cell.trim());

// A log has time, joints and torques, currents or commands; and no measured position.
function isLog(text) {
  const header = text.split(/\r?\n/).find((line) => line.trim() && !line.startsWith("#")) ?? "";
  const names = header.split(/[,;\t]/).map((cell) => parted(cell.replaceAll('"', "")).name.toLowerCase());
  const has = (pattern) => names.some((name) => pattern.test(name));
  return has(/^(t|time|stamp|timestamp)/) && has(/^(tau|i|q_cmd)_?\d|effort|current|torque/) && !has(/^[xyz]$/);
}

const TURNS = ["rx", "ry", "rz"];

// Whether a table is a measurement file as it stands: every column has our name, and nothing else was to be said of it.
function isOurs(found, remarks) {
  const known = ({ theirs, role, unit }) => {
    const { name, unit: given } = parted(theirs);
    return role === "" || (name === role && (unit === "" || given === unit || given === ""));
  };
  const beside = remarks.filter((remark) => !/^(note: )?`/.test(remark));
  return found.every(known) && beside.every((remark) => /^(note: )?\d+ rows?$/.test(remark.trim()));
}

// The columns that remarks of `stiffarm measurements` name: theirs, what it became, its first values.
function understood(remarks, csv) {
  const lines = csv.split("\n").filter((line) => line && !line.startsWith("#"));
  const header = cells(lines[0] ?? "");
  const rows = lines.slice(1, 4).map(cells);
  const values = (name) => {
    const at = header.findIndex((cell) => parted(cell).name === name);
    return at < 0 ? [] : rows.map((row) => row[at] ?? "");
  };
  const found = [];
  for (const remark of remarks) {
    const kept = /^(?:note: )?`(.+?)` is kept as `(.+?)`/.exec(remark);
    const is = /^(?:note: )?`([^`]+?)` is ([a-z_0-9]+)(?:\[([^\]]*)\])?/.exec(remark);
    const turned = /^(?:note: )?((?:`[^`]+`(?:, )?)+) are rx, ry, rz/.exec(remark);
    if (turned) {
      const theirs = [...turned[1].matchAll(/`([^`]+)`/g)].map((name) => name[1]);
      theirs.forEach((name, k) => found.push({ theirs: name, role: TURNS[k] ?? "", unit: "", values: values(TURNS[k]) }));
    } else if (kept) {
      found.push({ theirs: kept[1], role: "", unit: "", values: values(parted(kept[2]).name) });
    } else if (is && is[2] !== "a") {
      found.push({ theirs: is[1], role: is[2], unit: is[3] ?? "", values: values(is[2]) });
    } else if (is) {
      found.push({ theirs: is[1], role: "mass", unit: "", values: values("fz") });
    }
  }
  return found;
}

// The columns of a log, by their names.
function logged(text) {
  const lines = text.split(/\r?\n/).filter((line) => line.trim() && !line.startsWith("#"));
  const separator = [",", ";", "\t"].find((mark) => lines[0].includes(mark)) ?? ",";
  const rows = lines.slice(0, 4).map((line) => line.split(separator).map((cell) => cell.trim()));
  return rows[0].map((header, k) => {
    const { name, unit } = parted(header);
    const role = dimension(name) || /^(run|payload|contact)$/.test(name) ? name : "";
    return { theirs: header, role, unit, values: rows.slice(1).map((row) => row[k] ?? "") };
  });
}

// The map of what the reader said: Map of their column → { role, unit }. Nothing said is no map.
function mapOf(said) {
  if (said.size === 0) return null;
  const quoted = (text) => JSON.stringify(text);
  const ignored = [...said].filter(([, { role }]) => role === "").map(([theirs]) => quoted(parted(theirs).name));
  const named = [...said].filter(([, { role }]) => role !== "").map(([theirs, { role, unit }]) => {
    const inUnit = unit ? `, unit = ${quoted(unit)}` : "";
    return `${role} = { column = ${quoted(parted(theirs).name)}${inUnit} }\n`;
  });
  const head = ignored.length ? `ignore = [${ignored.join(", ")}]\n` : "";
  return `${head}\n[columns]\n${named.join("")}`;
}
