"""All branches of inverse kinematics by EAIK (Ostermeier, Külz & Althoff 2025; BSD-3-Clause), of the arms and poses that the
peers in Rust have written: the time of its batch on one thread, and what its solutions miss the poses by.

    eaik_peer.py DIRECTORY
"""

import pathlib
import statistics
import sys
import time

import numpy
from eaik.IK_HP import HPRobot

ROUNDS = 9
FOUND = 1e-6
#: The joint that is given of seven, for want of an elbow angle, and its value, rad.
GIVEN = (2, 0.6)


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


def compete(path):
    lines = [numpy.array(line.split(), float) for line in path.read_text().splitlines()]
    directions, offsets = (numbers.reshape(-1, 3) for numbers in lines[:2])
    poses = []
    for numbers in lines[2:]:
        pose = numpy.eye(4)
        pose[:3, :3] = numbers[:9].reshape(3, 3).T
        pose[:3, 3] = numbers[9:]
        poses.append(pose)
    n = len(directions)
    robot = HPRobot(directions, offsets, [GIVEN] if n == 7 else [])
    name = f"{path.stem} eaik"
    if not robot.hasKnownDecomposition():
        return print(f"{name}: no decomposition")
    times = []
    for _ in range(ROUNDS):
        start = time.process_time_ns()
        found = robot.IK_batched(poses, 1)
        times.append((time.process_time_ns() - start) / len(poses))
    branches, met, worst = 0, 0, 0.0
    for pose, each in zip(poses, found):
        q = numpy.atleast_2d(numpy.array(each.Q))
        if not q.size:
            continue
        if q.shape[1] < n:
            q = numpy.insert(q, GIVEN[0], GIVEN[1], axis=1)
        rotation, position = forward(directions, offsets, q)
        off = numpy.abs(rotation - pose[:3, :3]).max(axis=(1, 2))
        off = numpy.maximum(off, numpy.abs(position - pose[:3, 3]).max(axis=1))
        good = off[off < FOUND]
        branches, met = branches + len(good), met + bool(len(good))
        worst = max([worst, *good])
    count = len(poses)
    print(
        f"{name}: {statistics.median(times):.0f} ns, {branches / count:.3f} branches, worst {worst:.1e}, "
        f"{100 * met / count:.2f} % of poses ({robot.getKinematicFamily()})"
    )


for file in sorted(pathlib.Path(sys.argv[1]).glob("*.screws")):
    compete(file)
