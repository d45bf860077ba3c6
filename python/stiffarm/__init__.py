"""Kernels of robot arms on NumPy's arrays, and the diagnosis of their sim-to-real gap.

>>> import stiffarm
>>> arm = stiffarm.Arm.load("kuka_kr240")
>>> arm.jacobian([0.1, 0.9, -1.2, 0.4, 0.8, 0.0]).shape
(6, 6)

Everything is in SI: m, rad, N, N·m, kg, K. A twist is (dx, dy, dz, drx, dry, drz), a wrench (fx, fy, fz, mx, my, mz), both
at the tool's origin in base axes. Remarks go to the logger ``stiffarm``, progress to tqdm where it is installed.
"""

from ._native import VERSION as __version__
from ._native import Effect, Error, LogEffect, Reading, Row, Samples, Unstable, robots
from .arm import Arm
from .branches import Branches
from .commands import check, compensate, effects, generate, identify, import_urdf, measurements, papers, predict
from .commands import eval as eval
from .commands import map as map
from .controllers import Corrected, compensate_program, controller
from .diagnosis import Diagnosis, diagnose
from .experiments import Log, Motion, poses, simulate, withhold
from .prediction import LogPrediction, Prediction
from .record import Record
from .result import Identification, Predicted, Result
from .table import Map, Table

# Without eval and map, which `from stiffarm import *` would hide Python's own by.
__all__ = [
    "Arm",
    "Branches",
    "Corrected",
    "Diagnosis",
    "Effect",
    "Error",
    "Identification",
    "Log",
    "LogEffect",
    "LogPrediction",
    "Map",
    "Motion",
    "Predicted",
    "Prediction",
    "Reading",
    "Record",
    "Result",
    "Row",
    "Samples",
    "Table",
    "Unstable",
    "__version__",
    "check",
    "compensate",
    "compensate_program",
    "controller",
    "diagnose",
    "effects",
    "generate",
    "identify",
    "import_urdf",
    "measurements",
    "papers",
    "poses",
    "predict",
    "robots",
    "simulate",
    "withhold",
]
