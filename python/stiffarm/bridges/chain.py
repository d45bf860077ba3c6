"""Chains of joints, of whichever package: they become a URDF, which is read like any other."""

from __future__ import annotations

import json
from collections.abc import Sequence
from typing import Any, NamedTuple, Optional
from xml.sax.saxutils import quoteattr

import numpy

from ..arm import Arm
from ..commands import import_urdf

#: Gravity of a URDF, m/s².
_STANDARD = 9.80665

#: Anything beyond is no limit.
_UNLIMITED = 1e10


class Step(NamedTuple):
    """A joint of a chain and the link that it moves."""

    name: str
    kind: str
    #: Where the joint's frame is in the one before at zero, (4, 4).
    placed: Any
    #: Its axis in its frame; of a fixed one nothing.
    axis: Any
    limits: Optional[tuple[float, float]] = None
    mass: float = 0.0
    com: Any = (0.0, 0.0, 0.0)
    #: About the centre of mass, in the frame's axes, (3, 3).
    inertia: Any = None


def matrix(rotation: Any, translation: Any) -> Any:
    placed = numpy.eye(4)
    placed[:3, :3], placed[:3, 3] = rotation, translation
    return placed


def _rpy(rotation: Any) -> tuple[float, float, float]:
    """Roll, pitch and yaw of a URDF: Rz(yaw) Ry(pitch) Rx(roll)."""
    level = numpy.hypot(rotation[0, 0], rotation[1, 0])
    pitch = numpy.arctan2(-rotation[2, 0], level)
    if level < 1e-9:
        # Only the difference of roll and yaw turns anything.
        return float(numpy.arctan2(-rotation[1, 2], rotation[1, 1])), float(pitch), 0.0
    return float(numpy.arctan2(rotation[2, 1], rotation[2, 2])), float(pitch), float(numpy.arctan2(rotation[1, 0], rotation[0, 0]))


def _levelled(down: Any) -> Any:
    """The shortest turn that lets `down`, a unit vector, point along -z."""
    x, y, z = down
    if z > 0.0:
        # Upside down first: the shortest turn from +z to -z is none.
        return _levelled((x, -y, -z)) @ numpy.diag([1.0, -1.0, -1.0])
    cross = numpy.array([[0.0, 0.0, x], [0.0, 0.0, y], [-x, -y, 0.0]])
    return numpy.eye(3) + cross + cross @ cross / (1.0 - z)


def _urdf(name: str, steps: list[Step], down: Any) -> str:
    """Below a root in which gravity points along -z, as in every URDF."""

    def words(values: Any) -> str:
        return '"' + " ".join(repr(float(value)) for value in values) + '"'

    lines = [
        f"<robot name={quoteattr(name)}>",
        '  <link name="world"/><link name="base"/>',
        f'  <joint name="world to base" type="fixed"><origin rpy={words(_rpy(_levelled(down)))}/>'
        '<parent link="world"/><child link="base"/></joint>',
    ]
    parent = "base"
    for k, step in enumerate(steps):
        child = f"link_{k + 1}"
        lines.append(f"  <link name={quoteattr(child)}>")
        if step.mass > 0.0:
            i = numpy.zeros((3, 3)) if step.inertia is None else numpy.asarray(step.inertia)
            entries = zip(("ixx", "ixy", "ixz", "iyy", "iyz", "izz"), i[numpy.triu_indices(3)])
            tensor = " ".join(f'{entry}="{float(value)!r}"' for entry, value in entries)
            lines.append(
                f'    <inertial><origin xyz={words(step.com)}/><mass value="{float(step.mass)!r}"/><inertia {tensor}/></inertial>'
            )
        lines.append("  </link>")
        lines.append(f'  <joint name={quoteattr(step.name)} type="{step.kind}">')
        lines.append(f'    <parent link="{parent}"/><child link="{child}"/>')
        lines.append(f"    <origin xyz={words(step.placed[:3, 3])} rpy={words(_rpy(step.placed[:3, :3]))}/>")
        if step.kind != "fixed":
            lines.append(f"    <axis xyz={words(step.axis)}/>")
        if step.limits is not None:
            low, high = step.limits
            lines.append(f'    <limit lower="{float(low)!r}" upper="{float(high)!r}" effort="0" velocity="0"/>')
        lines.append("  </joint>")
        parent = child
    return "\n".join([*lines, "</robot>", ""])


def limited(low: float, high: float) -> Optional[tuple[float, float]]:
    return (float(low), float(high)) if max(abs(low), abs(high)) < _UNLIMITED and low < high else None


def arm_of(name: str, steps: list[Step], gravity: Any, beside: Sequence[dict[str, float]] = ()) -> Arm:
    """The arm of a chain, where the model has it, under its gravity (world axes, m/s²), with what stands `beside` its joints."""
    size = float(numpy.linalg.norm(gravity))
    down = numpy.asarray(gravity, float) / size if size > 0.0 else numpy.array([0.0, 0.0, -1.0])
    arm = import_urdf(_urdf(name, steps, down), base="base")
    lines, row = [], -1
    for line in arm.toml.splitlines():
        if line.startswith("gravity ="):
            line = f"gravity = {[size / _STANDARD * x for x in json.loads(line.split('=', 1)[1])]}"
        lines.append(line)
        if line.strip() == "[[joint]]":
            row += 1
            lines += [f"{key} = {value!r}" for key, value in (beside[row] if row < len(beside) else {}).items() if value]
    return Arm.from_toml("\n".join(lines) + "\n", f"<{name}>")


def rotation_vector(rotation: Any) -> list[float]:
    """Axis times angle, of any rotation: by its quaternion."""
    trace = numpy.trace(rotation)
    k = numpy.array(
        [
            [rotation[0, 0] - rotation[1, 1] - rotation[2, 2], 0.0, 0.0, 0.0],
            [rotation[0, 1] + rotation[1, 0], rotation[1, 1] - rotation[0, 0] - rotation[2, 2], 0.0, 0.0],
            [rotation[0, 2] + rotation[2, 0], rotation[1, 2] + rotation[2, 1], rotation[2, 2] - rotation[0, 0] - rotation[1, 1], 0.0],
            [rotation[2, 1] - rotation[1, 2], rotation[0, 2] - rotation[2, 0], rotation[1, 0] - rotation[0, 1], trace],
        ]
    )
    # The eigenvector of the largest eigenvalue (Bar-Itzhack 2000): well conditioned at half a turn, too.
    x, y, z, w = numpy.linalg.eigh(k / 3.0)[1][:, -1]
    axis = numpy.array([x, y, z]) * (1.0 if w >= 0.0 else -1.0)
    length = float(numpy.linalg.norm(axis))
    angle = 2.0 * float(numpy.arctan2(length, abs(w)))
    return [float(x) for x in axis * (angle / length if length > 0.0 else 2.0)]
