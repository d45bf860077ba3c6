"""Arms of other packages' models, and back. Models with joint placements become a URDF, which is read like any other."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any, NamedTuple, Optional
from xml.sax.saxutils import quoteattr

import numpy

from . import _native
from .arm import Arm
from .commands import import_urdf
from .words import log

if TYPE_CHECKING:
    import mujoco
    import pinocchio

#: Anything beyond is no limit.
_UNLIMITED = 1e10


class _Step(NamedTuple):
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


def _matrix(rotation: Any, translation: Any) -> Any:
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


def _urdf(name: str, steps: list[_Step]) -> str:
    def words(values: Any) -> str:
        return '"' + " ".join(repr(float(value)) for value in values) + '"'

    lines = [f"<robot name={quoteattr(name)}>", '  <link name="base"/>']
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


def _limits(low: float, high: float) -> Optional[tuple[float, float]]:
    return (float(low), float(high)) if max(abs(low), abs(high)) < _UNLIMITED and low < high else None


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
        limits = None if turns else _limits(model.lowerPositionLimit[first], model.upperPositionLimit[first])
        kind = "continuous" if kind == "revolute" and limits is None else kind
        inertia = model.inertias[joint]
        placed = model.jointPlacements[joint].homogeneous
        steps.append(_Step(model.names[joint], kind, placed, axis, limits, inertia.mass, inertia.lever, inertia.inertia))
    steps.append(_Step("tip", "fixed", frame.placement.homogeneous, None))
    return _arm(model.name or "pinocchio", steps, model.gravity.linear)


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


class _Chain(NamedTuple):
    """The chain of a model of MuJoCo's: bodies from the world to the tip, and the tip in the last."""

    model: Any
    bodies: list[int]
    #: The joint of each body; none of a body that is fixed.
    joints: list[Optional[int]]
    tip: Any
    site: Optional[int]


def _quaternion(q: Any) -> Any:
    w, x, y, z = numpy.asarray(q, float) / numpy.linalg.norm(q)
    return numpy.array(
        [
            [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
            [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
            [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
        ]
    )


def _turned(rotation: Any) -> Any:
    """The quaternion (w, x, y, z) of a rotation."""
    import mujoco

    found = numpy.zeros(4)
    mujoco.mju_mat2Quat(found, numpy.ascontiguousarray(rotation).reshape(9))
    return found


def _chain(spec: mujoco.MjSpec, tip: Optional[str]) -> _Chain:
    import mujoco

    model = spec.compile()
    site, body = None, model.nbody - 1
    place = numpy.eye(4)
    if tip is not None:
        site = mujoco.mj_name2id(model, mujoco.mjtObj.mjOBJ_SITE, tip)
        body = mujoco.mj_name2id(model, mujoco.mjtObj.mjOBJ_BODY, tip)
        if site >= 0:
            body = int(model.site_bodyid[site])
            place = _matrix(_quaternion(model.site_quat[site]), model.site_pos[site])
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
    return _Chain(model, bodies, joints, place, site if site is not None and site >= 0 else None)


def from_mujoco(spec: mujoco.MjSpec, tip: Optional[str]) -> Arm:
    """The chain from the world to a site or body."""
    import mujoco

    chain = _chain(spec, tip)
    model = chain.model
    # A joint turns about its anchor, which need not be its body's origin: frames are put there, and what is on the body moved back.
    steps, before = [], numpy.eye(4)
    beside: list[dict[str, float]] = []
    for body, joint in zip(chain.bodies, chain.joints):
        placed = before @ _matrix(_quaternion(model.body_quat[body]), model.body_pos[body])
        anchor = numpy.zeros(3) if joint is None else model.jnt_pos[joint]
        placed = placed @ _matrix(numpy.eye(3), anchor)
        before = _matrix(numpy.eye(3), -anchor)
        mass, com, inertia = _of_body(model, body)
        link = (mass, com - anchor, inertia)
        if joint is None:
            steps.append(_Step(f"fixed {body}", "fixed", placed, None, None, *link))
            continue
        slides = int(model.jnt_type[joint]) == int(mujoco.mjtJoint.mjJNT_SLIDE)
        limits = _limits(*model.jnt_range[joint]) if model.jnt_limited[joint] else None
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
        steps.append(_Step(model.joint(joint).name or f"joint {joint}", kind, placed, model.jnt_axis[joint], limits, *link))
    steps.append(_Step("tip", "fixed", before @ chain.tip, None))
    return _arm(spec.modelname or "mujoco", steps, model.opt.gravity, beside)


def _first(value: Any) -> float:
    """Of a number, which newer versions have as the coefficients of a polynomial."""
    return float(numpy.ravel(value)[0])


def _arm(name: str, steps: list[_Step], gravity: Any, beside: Sequence[dict[str, float]] = ()) -> Arm:
    """The arm of a chain, where the model has it, under its gravity (world axes, m/s²), with what stands `beside` its joints."""
    arm = import_urdf(_urdf(name, steps))
    # A table may have its base turned about the first link's z, and moved along it.
    at_zero = numpy.eye(4)
    for step in steps:
        at_zero = at_zero @ step.placed
    base = at_zero @ numpy.linalg.inv(arm.pose(numpy.zeros(arm.dof)))
    down = base[:3, :3].T @ numpy.asarray(gravity, float)
    lines, row = [], -1
    for line in arm.toml.splitlines():
        if line.startswith("gravity ="):
            continue
        lines.append(line)
        if line.startswith("convention ="):
            lines.append(f"gravity = {down.tolist()}")
        if line.strip() == "[[joint]]":
            row += 1
            lines += [f"{key} = {value!r}" for key, value in (beside[row] if row < len(beside) else {}).items() if value]
    # What a dozen products of matrices round is no place.
    if numpy.abs(base - numpy.eye(4)).max() > 1e-13:
        at, turned = base[:3, 3].tolist(), _rotation_vector(base[:3, :3])
        lines += ["", "[base]", f"translation = {at}", f"rotation = {turned}"]
    return Arm.from_toml("\n".join(line for line in lines if not line.startswith("# the base frame")) + "\n", f"<{name}>")


def to_mujoco(arm: Arm, spec: mujoco.MjSpec, nominal: Arm, tip: Optional[str]) -> list[str]:
    """Puts what is different of `arm` from `nominal` into the model that `nominal` was made of; what it has no place for."""
    chain = _chain(spec, tip)
    model = chain.model
    zero = numpy.zeros(arm.dof)
    frames = nominal.frames(zero)
    moved = [_change(frames, arm.frames(zero)), _change(nominal.pose(zero), arm.pose(zero))]
    # Bodies at zero, as they are and as they are to be: each moves with the row of its joint, from 1; 0 is the base.
    place, parent = numpy.eye(4), numpy.eye(4)
    places: list[Any] = []
    rows: list[int] = []
    for body, joint in zip(chain.bodies, chain.joints):
        place = place @ _matrix(_quaternion(model.body_quat[body]), model.body_pos[body])
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
            fixed = [_of_body(model, chain.bodies[k]) for k in there[1:]]
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


def _of_body(model: Any, body: int) -> tuple[float, Any, Any]:
    """Mass, centre and tensor of a body in its frame."""
    turned = _quaternion(model.body_iquat[body])
    return float(model.body_mass[body]), numpy.asarray(model.body_ipos[body]), turned @ numpy.diag(model.body_inertia[body]) @ turned.T


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
            frames[name] = {"translation": placed[:3, 3].tolist(), "rotation": _rotation_vector(placed[:3, :3])}
    return Arm.from_dh(
        rows,
        convention="modified" if robot.mdh else "standard",
        name=robot.name or "arm",
        base=frames.get("base"),
        tool=frames.get("tool"),
    )


def _rotation_vector(rotation: Any) -> list[float]:
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
