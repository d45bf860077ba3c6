"""Arms of Pinocchio's models."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Optional

import numpy

from ..arm import Arm
from .chain import Step, arm_of, limited

if TYPE_CHECKING:
    import pinocchio


def from_pinocchio(model: pinocchio.Model, tip: Optional[str]) -> Arm:
    """The chain from the universe to a frame of the model."""
    if tip is not None and not model.existFrame(tip):
        known = ", ".join(frame.name for frame in model.frames)
        raise ValueError(f"tip: found no frame {tip!r}, expected one of {known}")
    frame = model.frames[model.getFrameId(tip)] if tip is not None else model.frames[model.nframes - 1]
    chain: list[int] = []
    joint = frame.parentJoint
    while joint != 0:
        chain.insert(0, joint)
        joint = model.parents[joint]
    steps = []
    for joint in chain:
        kind, axis = _axis(model.names[joint], model.joints[joint])
        first = model.joints[joint].idx_q
        turns = kind == "continuous"
        limits = None if turns else limited(model.lowerPositionLimit[first], model.upperPositionLimit[first])
        kind = "continuous" if kind == "revolute" and limits is None else kind
        inertia = model.inertias[joint]
        placed = model.jointPlacements[joint].homogeneous
        steps.append(Step(model.names[joint], kind, placed, axis, limits, inertia.mass, inertia.lever, inertia.inertia))
    steps.append(Step("tip", "fixed", frame.placement.homogeneous, None))
    return arm_of(model.name or "pinocchio", steps, model.gravity.linear)


def _axis(name: str, joint: Any) -> tuple[str, Any]:
    """Whether a joint of Pinocchio's turns or slides, and about which axis, as its own motion subspace says."""
    short = joint.shortname()
    data = joint.createData()
    if joint.nv != 1:
        raise ValueError(f"joint {name!r}: found {short}, expected a joint that turns or slides")
    joint.calc(data, numpy.array([1.0, 0.0]) if joint.nq == 2 else numpy.zeros(1))
    motion = numpy.asarray(data.S).reshape(6)
    turns = numpy.linalg.norm(motion[3:]) > 0.5
    kind = ("continuous" if joint.nq == 2 else "revolute") if turns else "prismatic"
    return kind, motion[3:] if turns else motion[:3]
