"""Rows per second of functions that are written in Python on the same engine (`datafusion` of PyPI): the textbook in
NumPy, a batch of the engine's rows at once, on one core. `fleet/tools/measure` runs it.

    udf.py ROBOT.toml STIFFARM_FLEET ID

Before anything is timed, their values are compared with those of `stiffarm-fleet`.
"""

import json
import pathlib
import subprocess
import sys
import tempfile
import time
import tomllib

import datafusion
import numpy as np
import pyarrow as pa
import pyarrow.csv

ROWS, BATCHES, TIMES = 8192, 2, 30


def number(value):
    """SI, of `350 mm`, `pi/2` or a number."""
    if not isinstance(value, str):
        return float(value)
    if "pi" in value:
        sign, divisor = (-1 if value[0] == "-" else 1), value.partition("/")[2] or "1"
        return sign * np.pi / float(divisor)
    size, unit = value.split()
    return float(size) * {"mm": 1e-3, "m": 1.0, "deg": np.pi / 180}[unit]


class Arm:
    """Of revolute joints in the modified convention: Rx(alpha) Tx(a) Rz(theta) Tz(d)."""

    def __init__(self, path):
        robot = tomllib.loads(pathlib.Path(path).read_text())
        assert robot["convention"] == "modified" and all(row["type"] == "revolute" for row in robot["joint"])
        self.rows = [[number(row.get(name, 0)) for name in ("alpha", "a", "d", "theta")] for row in robot["joint"]]
        self.springs = np.array([number(row["stiffness"]) for row in robot["joint"]])

    def frames(self, q):
        frame, frames = np.broadcast_to(np.eye(4), (len(q), 4, 4)), []
        for joint, (alpha, a, d, theta) in enumerate(self.rows):
            c, s = np.cos(q[:, joint] + theta), np.sin(q[:, joint] + theta)
            step, ca, sa = np.zeros((len(q), 4, 4)), np.cos(alpha), np.sin(alpha)
            step[:, 0, 0], step[:, 0, 1], step[:, 0, 3] = c, -s, a
            step[:, 1, 0], step[:, 1, 1], step[:, 1, 2], step[:, 1, 3] = s * ca, c * ca, -sa, -d * sa
            step[:, 2, 0], step[:, 2, 1], step[:, 2, 2], step[:, 2, 3] = s * sa, c * sa, ca, d * ca
            step[:, 3, 3] = 1
            frame = frame @ step
            frames.append(frame)
        return np.stack(frames, 1)

    def pose(self, q):
        return self.frames(q)[:, -1, :3, :]

    def jacobian(self, q):
        frames = self.frames(q)
        axes, origins = frames[:, :, :3, 2], frames[:, :, :3, 3]
        arms = np.cross(axes, origins[:, -1:] - origins)
        return np.concatenate([arms, axes], 2).transpose(0, 2, 1)

    def deflection(self, q, w):
        jacobian = self.jacobian(q)
        arms, axes = jacobian[:, :3].transpose(0, 2, 1), jacobian[:, 3:].transpose(0, 2, 1)
        force, moment = w[:, None, None, :3], w[:, None, None, 3:]
        # Row j, column i: the force's part is symmetric, the moment's below the diagonal.
        by_force = (force * np.cross(axes[:, None, :], arms[:, :, None])).sum(3)
        lower = np.tril(by_force)
        by_force = lower + np.tril(lower, -1).transpose(0, 2, 1)
        by_moment = (moment * np.cross(axes[:, None, :], axes[:, :, None])).sum(3)
        loaded = np.diag(self.springs) - by_force - np.tril(by_moment, -1)
        torque = jacobian.transpose(0, 2, 1) @ w[:, :, None]
        return jacobian @ np.linalg.solve(loaded, torque)


def column(k):
    return 3 * (np.modf(0.618_034 * (np.arange(ROWS) + 997 * k + 1))[0] - 0.5)


def registered(context, arm):
    def function(name, of, inputs, width):
        def called(*columns):
            block = of(np.column_stack([column.to_numpy() for column in columns]))
            flat = np.ascontiguousarray(block.transpose(0, 2, 1)).reshape(-1)
            return pa.FixedSizeListArray.from_arrays(pa.array(flat), width)

        kind = pa.list_(pa.float64(), width)
        context.register_udf(datafusion.udf(called, [pa.float64()] * inputs, kind, "stable", name))

    function("pose", arm.pose, 6, 12)
    function("jacobian", arm.jacobian, 6, 36)
    function("deflection", lambda all: arm.deflection(all[:, :6], all[:, 6:]), 12, 6)


def main():
    robot, fleet, name = sys.argv[1:]
    context = datafusion.SessionContext(datafusion.SessionConfig().with_target_partitions(1).with_batch_size(ROWS))
    registered(context, Arm(robot))
    batch = pa.record_batch([pa.array(column(k)) for k in range(12)], [f"c{k}" for k in range(12)])
    context.register_record_batches("t", [[batch] * BATCHES])
    print("output              rows/s")
    for output, inputs in (("pose", 6), ("jacobian", 6), ("deflection", 12)):
        given = ", ".join(f"c{k}" for k in range(inputs))
        query = f"SELECT {output}({given}) AS v FROM t"
        got = np.array(context.sql(query).collect()[0].column(0).to_pylist())
        with tempfile.TemporaryDirectory() as folder:
            pa.csv.write_csv(batch, f"{folder}/t.csv")
            sql = f"SELECT {output}('{name}', {given}) AS v FROM t"
            words = [fleet, "sql", sql, "--table", f"t={folder}/t.csv", "--partitions", "1", "--format", "json"]
            lines = subprocess.run(words, check=True, capture_output=True, text=True).stdout.splitlines()
        want = np.array([json.loads(line)["v"] for line in lines])
        worst = np.abs(got - want).max() / np.abs(want).max()
        assert got.shape == want.shape and worst < 1e-12, (output, worst)
        least = float("inf")
        for _ in range(TIMES):
            began = time.perf_counter()
            context.sql(query).collect()
            least = min(least, time.perf_counter() - began)
        print(f"{output:18} {ROWS * BATCHES / least:9.3e}   (values within {worst:.0e} of stiffarm-fleet's)")


if __name__ == "__main__":
    main()
