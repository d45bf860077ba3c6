"""All branches of inverse kinematics by EAIK (Ostermeier, Külz & Althoff 2025; BSD-3-Clause) and by the C that
roboticstoolbox 1.5 (Corke; MIT) generates, of the arms and poses that the peers in Rust have written: the time on one thread
(of EAIK's batch, through Python), and what their solutions miss the poses by.

    inverse_peers.py DIRECTORY
"""

import pathlib
import statistics
import subprocess
import sys
import time

import numpy

ROUNDS = 9
FOUND = 1e-6
#: The joint that is given of seven, for want of an elbow angle, and its value, rad.
GIVEN = (2, 0.6)

RIGHT = numpy.pi / 2
#: d, a, alpha and offset of the standard convention.
TABLES = {
    "kr240": [
        (0, 0.35, RIGHT, 0), (0, 1.25, 0, 0), (0, 0.055, -RIGHT, 0),
        (1.1, 0, RIGHT, 0), (0, 0, -RIGHT, 0), (0.23, 0, 0, 0),
    ],
    "irb120": [
        (0.29, 0, -RIGHT, 0), (0, 0.27, 0, -RIGHT), (0, 0.07, -RIGHT, 0),
        (0.302, 0, RIGHT, 0), (0, 0, -RIGHT, 0), (0.072, 0, 0, numpy.pi),
    ],
    "puma560": [
        (0.672, 0, RIGHT, 0), (0, 0.4318, 0, 0), (0.15005, 0.0203, -RIGHT, 0),
        (0.4318, 0, RIGHT, 0), (0, 0, -RIGHT, 0), (0, 0, 0, 0),
    ],
    "ur10": [
        (0.1273, 0, RIGHT, 0), (0, -0.612, 0, 0), (0, -0.5723, 0, 0),
        (0.163941, 0, RIGHT, 0), (0.1157, 0, -RIGHT, 0), (0.0922, 0, 0, 0),
    ],
}  # fmt: skip

#: Times all poses round by round, then writes all solutions; prints the nanoseconds a pose, and how many each pose has.
DRIVER = r"""
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

int main(void) {
    static double poses[1 << 16];
    FILE *file = fopen("toolbox.poses", "rb");
    size_t all = fread(poses, 16 * sizeof(double), sizeof poses / sizeof *poses / 16, file);
    double q[IKINE_MAX_SOLUTIONS][IKINE_DOF], sum = 0.0;
    int count;
    for (int round = 0; round < 9; round++) {
        struct timespec begun, ended;
        clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &begun);
        for (size_t k = 0; k < all; k++) {
            ikine(&poses[16 * k], 1e-6, q, &count);
            sum += count;
        }
        clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &ended);
        printf("%f\n", (1e9 * (ended.tv_sec - begun.tv_sec) + (ended.tv_nsec - begun.tv_nsec)) / all);
    }
    file = fopen("toolbox.solutions", "wb");
    for (size_t k = 0; k < all; k++) {
        ikine(&poses[16 * k], 1e-6, q, &count);
        fwrite(q, sizeof q[0], count, file);
        printf("%d ", count);
    }
    return sum < 0.0;
}
"""


def turns(axis, angles):
    """Rotations about an axis, (count, 3, 3)."""
    x, y, z = axis
    across = numpy.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    s, c = (f(angles)[:, None, None] for f in (numpy.sin, numpy.cos))
    return numpy.eye(3) + s * across + (1 - c) * (across @ across)


def forward(directions, offsets, q):
    rotation = numpy.tile(numpy.eye(3), (len(q), 1, 1))
    position = numpy.tile(offsets[0], (len(q), 1))
    for joint, axis in enumerate(directions):
        rotation = rotation @ turns(axis, q[:, joint])
        position = position + rotation @ offsets[joint + 1]
    return rotation, position


def told(name, times, solutions, arm, poses):
    """Prints what was found."""
    directions, offsets, _ = arm
    branches, met, worst = 0, 0, 0.0
    for pose, q in zip(poses, solutions):
        if not q.size:
            continue
        rotation, position = forward(directions, offsets, q)
        off = numpy.abs(rotation - pose[:3, :3]).max(axis=(1, 2))
        off = numpy.maximum(off, numpy.abs(position - pose[:3, 3]).max(axis=1))
        good = off[off < FOUND]
        branches, met = branches + len(good), met + bool(len(good))
        worst = max([worst, *good])
    count = len(poses)
    print(
        f"{name}: {statistics.median(times):.0f} ns, {branches / count:.3f} branches, worst {worst:.1e}, "
        f"{100 * met / count:.2f} % of poses"
    )


def eaik(path, arm, poses):
    try:
        from eaik.IK_HP import HPRobot
    except ImportError:
        return print("EAIK is skipped: the Python package eaik is not installed")
    directions, offsets, _ = arm
    n = len(directions)
    robot = HPRobot(directions, offsets, [GIVEN] if n == 7 else [])
    if not robot.hasKnownDecomposition():
        return print(f"{path.stem} eaik: no decomposition")
    times = []
    for _ in range(ROUNDS):
        start = time.process_time_ns()
        found = robot.IK_batched(poses, 1)
        times.append((time.process_time_ns() - start) / len(poses))
    solutions = []
    for each in found:
        q = numpy.atleast_2d(numpy.array(each.Q))
        solutions.append(numpy.insert(q, GIVEN[0], GIVEN[1], axis=1) if q.size and q.shape[1] < n else q)
    told(f"{path.stem} eaik", times, solutions, arm, poses)


def toolbox(path, arm, poses):
    table = TABLES.get(path.stem.split(".")[0])
    if table is None or path.stem.endswith("built"):
        return None
    try:
        from roboticstoolbox import DHRobot, RevoluteDH
        from roboticstoolbox.robot.symbolic_ik import generate_code
    except ImportError:
        return print("roboticstoolbox is skipped: its Python package, 1.5 or later, is not installed")
    robot = DHRobot([RevoluteDH(d=d, a=a, alpha=alpha, offset=offset) for d, a, alpha, offset in table])
    folder = path.parent
    (folder / "toolbox.c").write_text(generate_code(robot, "c") + DRIVER)
    command = ["gcc", "-O3", "toolbox.c", "-o", "toolbox", "-lm"]
    subprocess.run(command, check=True, cwd=folder)
    homes = numpy.array(poses)
    homes[:, :3, :3] = homes[:, :3, :3] @ arm[2]
    homes.tofile(folder / "toolbox.poses")
    text = subprocess.run(["./toolbox"], check=True, cwd=folder, capture_output=True, text=True).stdout
    *times, counts = text.splitlines()
    ends = numpy.cumsum([int(count) for count in counts.split()])
    q = numpy.fromfile(folder / "toolbox.solutions").reshape(-1, 6)
    told(f"{path.stem} roboticstoolbox", [float(each) for each in times], numpy.split(q, ends[:-1]), arm, poses)


def compete(path):
    lines = [numpy.array(line.split(), float) for line in path.read_text().splitlines()]
    arm = [numbers.reshape(-1, 3) for numbers in lines[:3]]
    arm[2] = arm[2].T
    poses = []
    for numbers in lines[3:]:
        pose = numpy.eye(4)
        pose[:3, :3] = numbers[:9].reshape(3, 3).T
        pose[:3, 3] = numbers[9:]
        poses.append(pose)
    eaik(path, arm, poses)
    toolbox(path, arm, poses)


for file in sorted(pathlib.Path(sys.argv[1]).glob("*.screws")):
    compete(file)
