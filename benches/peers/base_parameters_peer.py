"""The fit of base parameters alone by Pinocchio's regressor and numpy, and by FIGAROH: of the states and torques that the
command dynamics of stiffarm-bench wrote. Prints milliseconds of one fit, the median of some; how many numbers were
found; and what they leave of the torques, as a part of their size.

    python3 benches/peers/base_parameters_peer.py DIRECTORY
"""

import sys
import time
import warnings
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pinocchio as pin

try:
    from figaroh.tools.qrdecomposition import QRDecomposer
    from figaroh.tools.regressor import RegressorBuilder, eliminate_non_dynaffect
except ImportError:
    QRDecomposer = None

FOLDER = Path(sys.argv[1])
ROUNDS = 5


def model_of(lines):
    """As dynamics_drive.cpp makes it."""
    model = pin.Model()
    model.gravity.linear = np.array(lines[0])
    parent = 0
    for k, x in enumerate(lines[1:]):
        c, s = np.cos(x[3]), np.sin(x[3])
        place = pin.SE3(np.array([[1, 0, 0], [0, c, -s], [0, s, c]]), np.array(x[:3]))
        parent = model.addJoint(parent, pin.JointModelRZ(), place, f"joint{k + 1}")
        xx, xy, xz, yy, yz, zz = x[8:]
        tensor = np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]])
        model.appendBodyToJoint(parent, pin.Inertia(x[4], np.array(x[5:8]), tensor), pin.SE3.Identity())
    return model


def by_pinocchio(model, q, qd, qdd, torques):
    """All ten numbers of each link, of which least squares of the smallest norm tells as many as are seen."""
    data = model.createData()
    columns = np.vstack([pin.computeJointTorqueRegressor(model, data, *row) for row in zip(q, qd, qdd)])
    values, _, rank, _ = np.linalg.lstsq(columns, torques.ravel(), rcond=1e-10)
    return rank, columns @ values


def by_figaroh(model, q, qd, qdd, torques):
    """Its regressor, its base by two QR decompositions, and the values that it finds with them."""
    builder = RegressorBuilder(SimpleNamespace(model=model, data=model.createData()))
    columns = builder.build_basic_regressor(q, qd, qdd, {"act_idxv": list(range(model.nv))})
    names = {f"{name}{link}": 0.0 for link in range(model.nv) for name in range(10)}
    # Its rows stand joint by joint.
    told = torques.T.ravel()
    reduced, left = eliminate_non_dynaffect(columns, names, 1e-6)
    found = QRDecomposer().double_decomposition(told, reduced, left)
    base, values = found[0], found[3]
    return base.shape[1], (base @ values).reshape(model.nv, -1).T.ravel()


warnings.simplefilter("ignore")
ways = {"pinocchio": by_pinocchio} | ({"figaroh": by_figaroh} if QRDecomposer else {})
for path in sorted(FOLDER.glob("*.links")):
    model = model_of([[float(x) for x in line.split()] for line in path.read_text().splitlines()])
    n = model.nv
    states = np.fromfile(path.with_suffix(".states")).reshape(-1, 3, n)
    torques = np.fromfile(path.with_suffix(".inverse_dynamics")).reshape(-1, n)
    for name, way in ways.items():
        times = []
        for _ in range(ROUNDS):
            start = time.process_time()
            count, told = way(model, *np.ascontiguousarray(states.swapaxes(0, 1)), torques)
            times.append(1e3 * (time.process_time() - start))
        off = np.linalg.norm(told - torques.ravel()) / np.linalg.norm(torques)
        print(f"{path.stem} base parameters {name}: {np.median(times):.1f} ms, {count} numbers, {off:.1e} left")
