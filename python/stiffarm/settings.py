"""What may be chosen about a diagnosis. Written by tools/outputs.py."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Optional, TypedDict, Union

from .words import Path, Quantity


class Settings(TypedDict, total=False):
    """What may be chosen about a diagnosis, as the options of ``stiffarm diagnose``."""

    bench: Optional[Path]
    """Known constants of the bench (TOML): points and their distances, planes, centres. What it does not give is co-estimated."""
    nuisance: Sequence[str]
    """Nuisance parameters, co-estimated and never a finding: base_frame, tool_frame, geometry (zeros, lengths and twists, within --tolerance)."""
    tolerance: Optional[Union[str, tuple[Quantity, Quantity]]]
    """Manufacturing tolerance of lengths and angles, standard deviations [default: 0.3mm,0.5mrad]."""
    usual: Sequence[str]
    """Prior scale of an effect's parameters: joint_compliance=2e-6, link_compliance:bending=1e-6; may be repeated."""
    noise_position: Optional[Quantity]
    """Standard deviation of a measured coordinate: 30um [default: from repeats, else from the residuals]."""
    noise_rotation: Optional[Quantity]
    """Standard deviation of a measured rotation: 0.02deg [default: from repeats, else from the residuals]."""
    keep_all: bool
    """Keep outliers: fit and count rows that do not fit."""
    effects: Optional[Sequence[str]]
    """Try only these effects."""
    folds: Optional[int]
    """Number of folds [default: one per pose up to 30 poses, else 10]."""
    nested: bool
    """Nested cross-validation: repeat the search without each fold, and report the error on it."""
    seed: int
    """Seed of folds, permutations and intervals; the same seed gives the same bytes."""
    rivals: Sequence[str]
    """Compare with another model's predictions: the columns PREFIX_x … or PREFIX_dx …."""
    accept: Optional[Quantity]
    """Tolerance for the position error of the corrected arm in 95 % of the rows, held out or of --check; exit status 1 if the error is larger."""
    torque_side: Optional[str]
    """Where its torques are measured: motor (joint side of the gear), link (a sensor behind it), current, commanded [default: as the log says]."""
    rows: Optional[str]
    """Which rows, where a log has both [default: torque]."""
    band: Optional[Quantity]
    """Cut-off frequency of the low-pass: 50Hz [default: where the joint values exceed their noise]."""
    standstill: Optional[float]
    """Speed, rad/s or m/s, below which a joint's torque is not used [default: 0.5 % of its largest]."""
    known_masses: bool
    """Take the robot file's masses and inertias as known; a difference is a finding [default: they are co-estimated]."""
    map: Optional[str]
    """Names of the columns: ros, rtde, libfranka, lerobot, sage, pace, or a map (TOML)."""
    topic: Optional[str]
    """Topic of a bag with the arm's joints, if several have any."""
