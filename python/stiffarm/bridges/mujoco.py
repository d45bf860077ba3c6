"""Arms of MuJoCo's models."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple, Optional

import numpy

from ..arm import Arm
from .chain import Step, arm_of, limited, matrix

if TYPE_CHECKING:
    import mujoco


class Chain(NamedTuple):
    """The chain of a model of MuJoCo's: bodies from the world to the tip, and the tip in the last."""

    model: Any
    bodies: list[int]
    #: The joint of each body; none of a body that is fixed.
    joints: list[Optional[int]]
    tip: Any
    site: Optional[int]


def quaternion(q: Any) -> Any:
    w, x, y, z = numpy.asarray(q, float) / numpy.linalg.norm(q)
    return numpy.array(
        [
            [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
            [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
            [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
        ]
    )


def chain_of(spec: mujoco.MjSpec, tip: Optional[str]) -> Chain:
    import mujoco

    model = spec.compile()
    site, body = None, model.nbody - 1
    place = numpy.eye(4)
    if tip is not None:
        site = mujoco.mj_name2id(model, mujoco.mjtObj.mjOBJ_SITE, tip)
        body = mujoco.mj_name2id(model, mujoco.mjtObj.mjOBJ_BODY, tip)
        if site >= 0:
            body = int(model.site_bodyid[site])
            place = matrix(quaternion(model.site_quat[site]), model.site_pos[site])
        elif body < 0:
            raise ValueError(f"tip: found no site and no body {tip!r}")
    bodies: list[int] = []
    while body != 0:
        bodies.insert(0, int(body))
        body = model.body_parentid[body]
    joints: list[Optional[int]] = []
    for body in bodies:
        count, first = int(model.body_jntnum[body]), int(model.body_jntadr[body])
        kinds = (int(mujoco.mjtJoint.mjJNT_HINGE), int(mujoco.mjtJoint.mjJNT_SLIDE))
        if count > 1 or (count == 1 and int(model.jnt_type[first]) not in kinds):
            raise ValueError(f"body {model.body(body).name!r}: found joints other than one hinge or slide, expected one at most")
        joints.append(first if count else None)
    return Chain(model, bodies, joints, place, site if site is not None and site >= 0 else None)


def from_mujoco(spec: mujoco.MjSpec, tip: Optional[str]) -> Arm:
    """The chain from the world to a site or body."""
    import mujoco

    chain = chain_of(spec, tip)
    model = chain.model
    # A joint turns about its anchor, which need not be its body's origin: frames are put there, and what is on the body moved back.
    steps, before = [], numpy.eye(4)
    beside: list[dict[str, float]] = []
    for body, joint in zip(chain.bodies, chain.joints):
        placed = before @ matrix(quaternion(model.body_quat[body]), model.body_pos[body])
        anchor = numpy.zeros(3) if joint is None else model.jnt_pos[joint]
        placed = placed @ matrix(numpy.eye(3), anchor)
        before = matrix(numpy.eye(3), -anchor)
        mass, com, inertia = of_body(model, body)
        link = (mass, com - anchor, inertia)
        if joint is None:
            steps.append(Step(f"fixed {body}", "fixed", placed, None, None, *link))
            continue
        slides = int(model.jnt_type[joint]) == int(mujoco.mjtJoint.mjJNT_SLIDE)
        limits = limited(*model.jnt_range[joint]) if model.jnt_limited[joint] else None
        if slides and limits is None:
            # A URDF's joint that slides has limits: as far as any arm reaches.
            limits = (-1e3, 1e3)
        kind = "prismatic" if slides else "continuous" if limits is None else "revolute"
        dof = int(model.jnt_dofadr[joint])
        beside.append(
            {
                "stiffness": _first(model.jnt_stiffness[joint]),
                "coulomb": _first(model.dof_frictionloss[dof]),
                "viscous": _first(model.dof_damping[dof]),
                "rotor_inertia": _first(model.dof_armature[dof]),
            }
        )
        steps.append(Step(model.joint(joint).name or f"joint {joint}", kind, placed, model.jnt_axis[joint], limits, *link))
    steps.append(Step("tip", "fixed", before @ chain.tip, None))
    return arm_of(spec.modelname or "mujoco", steps, model.opt.gravity, beside)


def _first(value: Any) -> float:
    """Of a number, which newer versions have as the coefficients of a polynomial."""
    return float(numpy.ravel(value)[0])


def of_body(model: Any, body: int) -> tuple[float, Any, Any]:
    """Mass, centre and tensor of a body in its frame."""
    turned = quaternion(model.body_iquat[body])
    return float(model.body_mass[body]), numpy.asarray(model.body_ipos[body]), turned @ numpy.diag(model.body_inertia[body]) @ turned.T
