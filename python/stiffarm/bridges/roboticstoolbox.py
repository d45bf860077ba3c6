"""Arms of the Robotics Toolbox."""

from __future__ import annotations

from typing import Any

import numpy

from ..arm import Arm
from ..words import log
from .chain import rotation_vector


def from_roboticstoolbox(robot: Any) -> Arm:
    """The table of a ``DHRobot``, with its base and its tool."""
    rows: list[dict[str, Any]] = []
    for link in robot.links:
        slides = bool(link.isprismatic)
        if getattr(link, "flip", False):
            raise ValueError(f"{robot.name}: found a joint that is flipped, expected one that turns as its axis says")
        row: dict[str, Any] = {
            "type": "prismatic" if slides else "revolute",
            "theta": float(link.theta) if slides else float(link.offset),
            "d": float(link.offset) if slides else float(link.d),
            "a": float(link.a),
            "alpha": float(link.alpha),
        }
        if link.qlim is not None:
            row["limits"] = [float(x) for x in link.qlim]
        if link.m:
            row.update(mass=float(link.m), com=[float(x) for x in numpy.asarray(link.r).reshape(3)])
            tensor = numpy.asarray(link.I)
            moments = numpy.linalg.eigvalsh(tensor)
            if moments[2] > (1.0 + 1e-9) * (moments[0] + moments[1]):
                log.warning("%s, joint %d: no body has the moments of inertia %s, which are left out", robot.name, len(rows) + 1, moments)
            elif tensor.any():
                row["inertia"] = [float(x) for x in tensor[numpy.triu_indices(3)]]
        rows.append(row)
    frames = {}
    for name, place in (("base", robot.base), ("tool", robot.tool)):
        placed = numpy.asarray(place.A, float)
        if not numpy.allclose(placed, numpy.eye(4), rtol=0.0, atol=1e-15):
            frames[name] = {"translation": placed[:3, 3].tolist(), "rotation": rotation_vector(placed[:3, :3])}
    return Arm.from_dh(
        rows,
        convention="modified" if robot.mdh else "standard",
        name=robot.name or "arm",
        base=frames.get("base"),
        tool=frames.get("tool"),
    )
