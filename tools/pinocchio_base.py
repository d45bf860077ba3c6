"""How many sums of moments of mass motion can tell, by the rank of Pinocchio's joint-torque regressor.

What `stiffarm generate … --emit base` counts, from a regressor that shares nothing with this project: a hundred random
motions of each table, bodies of which no number is zero, the rank by singular values. Prints for each arm the count where
gravity is along the first axis and where it leans, with the smallest singular value that counts and the largest that
does not, relative to the largest of all.

    pip install pin && python3 tools/pinocchio_base.py
"""

import math

import numpy as np
import pinocchio as pin

QUARTER = math.pi / 2
# a, alpha, d; standard convention.
PUMA_560 = [
    (0, QUARTER, 0.672), (0.4318, 0, 0), (0.0203, -QUARTER, 0.15005),
    (0, QUARTER, 0.4318), (0, -QUARTER, 0), (0, 0, 0),
]  # fmt: skip
# The same, modified convention.
PANDA = [
    (0, 0, 0.333), (0, -QUARTER, 0), (0, QUARTER, 0.316), (0.0825, QUARTER, 0),
    (-0.0825, -QUARTER, 0.384), (0, QUARTER, 0), (0.088, QUARTER, 0),
]  # fmt: skip


def arm(rows, modified, gravity):
    model = pin.Model()
    model.gravity.linear = np.array(gravity)
    parent, before = 0, pin.SE3.Identity()
    for k, (a, alpha, d) in enumerate(rows):
        lean = pin.SE3(pin.utils.rotate("x", alpha), np.array([a, 0, 0]))
        along = pin.SE3(np.eye(3), np.array([0, 0, d]))
        place = lean * along if modified else before * along
        before = lean
        parent = model.addJoint(parent, pin.JointModelRZ(), place, f"joint{k}")
        model.appendBodyToJoint(parent, pin.Inertia.Random(), pin.SE3.Identity())
    return model


def rank(model, random):
    data = model.createData()
    draws = [[random.uniform(-3, 3, model.nv) for _ in range(3)] for _ in range(100)]
    rows = [pin.computeJointTorqueRegressor(model, data, *draw).copy() for draw in draws]
    values = np.linalg.svd(np.vstack(rows), compute_uv=False)
    values /= values[0]
    found = int((values > 1e-9).sum())
    return f"{found} ({values[found - 1]:.1e}, {values[found]:.1e})"


def main():
    random = np.random.default_rng(1)
    arms = [("PUMA 560", PUMA_560, False), ("Panda", PANDA, True)]
    for n in range(3, 8):
        oblique = [(random.uniform(0.1, 0.5), random.uniform(0.3, 1.2), random.uniform(0.1, 0.5)) for _ in range(n)]
        arms.append((f"oblique axes, {n} joints: 7n - 4 = {7 * n - 4}", oblique, True))
    print("Pinocchio", pin.__version__)
    for name, rows, modified in arms:
        along, leaning = (rank(arm(rows, modified, g), random) for g in ([0, 0, -9.81], [3, -2, -9]))
        print(f"{name}: of {10 * len(rows)}, {along}; leaning {leaning}")


main()
