"""Corrected arms back into MuJoCo's models."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Optional

import numpy

from .. import _native
from ..arm import Arm
from .chain import matrix
from .mujoco import chain_of, of_body, quaternion

if TYPE_CHECKING:
    import mujoco


def to_mujoco(arm: Arm, spec: mujoco.MjSpec, nominal: Arm, tip: Optional[str]) -> list[str]:
    """Puts what is different of `arm` from `nominal` into the model that `nominal` was made of; what it has no place for."""
    chain = chain_of(spec, tip)
    model = chain.model
    zero = numpy.zeros(arm.dof)
    frames = nominal.frames(zero)
    moved = [_change(frames, arm.frames(zero)), _change(nominal.pose(zero), arm.pose(zero))]
    # Bodies at zero, as they are and as they are to be: each moves with the row of its joint, from 1; 0 is the base.
    place, parent = numpy.eye(4), numpy.eye(4)
    places: list[Any] = []
    rows: list[int] = []
    for body, joint in zip(chain.bodies, chain.joints):
        place = place @ matrix(quaternion(model.body_quat[body]), model.body_pos[body])
        rows.append((rows[-1] if rows else 0) + (joint is not None))
        target = (moved[0][rows[-1] - 1] if rows[-1] else numpy.eye(4)) @ place
        one = _body(spec, model, body)
        placed = numpy.linalg.inv(parent) @ target
        one.pos, one.quat = placed[:3, 3], _turned(placed[:3, :3])
        parent = target
        places.append(place)
    if chain.site is not None:
        site = spec.site(model.site(chain.site).name)
        placed = numpy.linalg.inv(parent) @ moved[1] @ place @ chain.tip
        site.pos, site.quat = placed[:3, 3], _turned(placed[:3, :3])
    lost = []
    for row, (before, after) in enumerate(zip(nominal.rows, arm.rows)):
        there = [k for k, number in enumerate(rows) if number == row + 1]
        _drive(spec.joint(model.joint(chain.joints[there[0]]).name), before, after)
        if (before.mass, before.com, before.inertia) != (after.mass, after.com, after.inertia):
            # A body that is corrected goes along with its row: the row's frame stays where it was in it.
            inside = [numpy.linalg.inv(places[there[0]]) @ placed for placed in (frames[row], *(places[k] for k in there[1:]))]
            fixed = [of_body(model, chain.bodies[k]) for k in there[1:]]
            if not _weigh(_body(spec, model, chain.bodies[there[0]]), after, inside, fixed):
                lost.append(f"mass and inertia at link {row + 1}: no body has them")
    return [f"{effect} at {place}" for effect, place in arm.effects] + lost


def _body(spec: mujoco.MjSpec, model: Any, body: int) -> Any:
    one = spec.body(model.body(body).name)
    if one is None:
        raise ValueError(f"body {body}: found no name, expected one by which it can be found")
    return one


def _change(before: Any, after: Any) -> Any:
    return after @ numpy.linalg.inv(before)


def _drive(joint: Any, before: _native.Row, after: _native.Row) -> None:
    """Spring and drive of a joint, where they are others."""
    names = {"stiffness": "stiffness", "damping": "viscous", "frictionloss": "coulomb", "armature": "armature"}
    for theirs, ours in names.items():
        value = getattr(after, ours)
        if value is None or value == getattr(before, ours):
            continue
        known = getattr(joint, theirs)
        setattr(joint, theirs, [value, *numpy.ravel(known)[1:]] if numpy.ndim(known) > 0 else value)


def _moments(mass: float, com: Any, inertia: Any, placed: Any) -> Any:
    """What adds up of bodies: mass, first moments, and the tensor about the origin of the frame that they are placed in."""
    turn, centre = placed[:3, :3], placed[:3, :3] @ numpy.asarray(com) + placed[:3, 3]
    tensor = turn @ numpy.asarray(inertia) @ turn.T + mass * (centre @ centre * numpy.eye(3) - numpy.outer(centre, centre))
    return numpy.concatenate([[mass], mass * centre, tensor.ravel()])


def _weigh(body: Any, row: _native.Row, inside: list[Any], fixed: list[tuple[float, Any, Any]]) -> bool:
    """Gives a body what its row weighs beyond the bodies that are fixed to it; whether any body does."""
    total = _moments(row.mass, row.com, row.inertia, inside[0])
    for one, placed in zip(fixed, inside[1:]):
        total = total - _moments(*one, placed)
    mass, tensor = float(total[0]), total[4:].reshape(3, 3)
    if mass <= 0.0:
        return False
    com = total[1:4] / mass
    moments, axes = numpy.linalg.eigh(tensor - mass * (com @ com * numpy.eye(3) - numpy.outer(com, com)))
    if moments[0] <= 0.0 or moments[2] > moments[0] + moments[1]:
        return False
    axes[:, 2] *= numpy.linalg.det(axes)
    body.mass, body.ipos, body.inertia, body.iquat = mass, com, moments, _turned(axes)
    body.fullinertia = [float("nan")] * 6
    body.explicitinertial = True
    return True


def _turned(rotation: Any) -> Any:
    """The quaternion (w, x, y, z) of a rotation."""
    import mujoco

    found = numpy.zeros(4)
    mujoco.mju_mat2Quat(found, numpy.ascontiguousarray(rotation).reshape(9))
    return found
