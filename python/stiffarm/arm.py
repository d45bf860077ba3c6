"""Arms: read, built, evaluated."""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any, Optional, Union

from . import _native
from .branches import Branches
from .words import Path, Progress

if TYPE_CHECKING:
    import mujoco
    import pinocchio
    from numpy.typing import ArrayLike

#: An entry of a table: a number in SI, or a text with a unit: ``0.35``, ``"350 mm"``, ``"pi/2"``.
Cell = Union[float, str]


class Arm(_native.Arm):
    """An arm: its robot file, and everything that is computed of it.

    ``q`` is (n,) or (batch, n), rad (m of a prismatic joint); results have the batch in front. An array of doubles that
    lies pose after pose is not copied, `out` is filled where it is given, and the interpreter is free while many poses are
    worked on, on all cores. ``engine("jacobian")`` says what computes: the compiled ``kernels`` of a built-in arm,
    ``c`` after :meth:`compile`, the ``textbook``, or the ``graph`` of a corrected arm and of frames and markers.
    """

    @classmethod
    def load(cls, robot: Path, *, set: Optional[Mapping[str, Cell]] = None, base: Optional[str] = None, tip: Optional[str] = None) -> Arm:
        """The arm of a robot file (TOML), a URDF, a diagnosis (JSON), or the id of a built-in one.

        `set` gives symbolic parameters their numbers; `base` and `tip` are the links between which a URDF is read.
        """
        name = os.fspath(robot)
        if name.lower().endswith((".urdf", ".xml")):
            from .commands import import_urdf

            return import_urdf(name, base=base, tip=tip)
        if base is not None or tip is not None:
            raise ValueError("base and tip are the links of a URDF, and found none")
        return cls._made(name, None, set)

    @classmethod
    def from_toml(cls, text: str, name: str = "<arm>", *, set: Optional[Mapping[str, Cell]] = None) -> Arm:
        """The arm of the text of a robot file; `name` is what messages call it."""
        return cls._made(name, text.encode(), set)

    @classmethod
    def from_dh(
        cls,
        rows: Sequence[Mapping[str, Any]],
        *,
        convention: str = "standard",
        name: str = "arm",
        gravity: Optional[Sequence[float]] = None,
        base: Optional[Mapping[str, Any]] = None,
        tool: Optional[Mapping[str, Any]] = None,
        frames: Sequence[Mapping[str, Any]] = (),
        markers: Sequence[Mapping[str, Any]] = (),
    ) -> Arm:
        """The arm of a Denavit-Hartenberg table.

        A row has any of ``theta d a alpha beta stiffness mass com inertia limits type …``, as in a robot file; angles in
        rad or as ``"pi/2"``, ``"90 deg"``, lengths in m or as ``"350 mm"``. `convention` is ``standard`` or ``modified``
        (Khalil, Craig), `base` and `tool` have a ``translation`` (m) and a ``rotation`` (rotation vector, rad); `frames` a ``name``
        and the ``joint`` (from 1) on whose link they are, too, `markers` a ``name`` and a ``translation``, in the tool's frame.
        """
        lines = [f"name = {_value(name)}", f"convention = {_value(convention)}"]
        if gravity is not None:
            lines.append(f"gravity = {_value(list(gravity))}")
        for row in rows:
            lines += ["", "[[joint]]", *_entries({"type": "revolute", **row})]
        for head, frame in (("base", base), ("tool", tool)):
            if frame:
                lines += ["", f"[{head}]", *_entries(frame)]
        for head, each in (("frame", frames), ("marker", markers)):
            for one in each:
                lines += ["", f"[[{head}]]", *_entries(one)]
        return cls.from_toml("\n".join(lines) + "\n", f"<{name}>")

    @classmethod
    def from_pinocchio(cls, model: pinocchio.Model, *, tip: Optional[str] = None) -> Arm:
        """The arm of a model of Pinocchio's, up to the frame `tip` [default: the last frame of the last joint]."""
        from .bridges.pinocchio import from_pinocchio

        return from_pinocchio(model, tip)

    @classmethod
    def from_mujoco(cls, spec: mujoco.MjSpec, *, tip: Optional[str] = None) -> Arm:
        """The arm of a model of MuJoCo's, up to the site or body `tip` [default: the last body], with its joints' springs."""
        from .bridges.mujoco import from_mujoco

        return from_mujoco(spec, tip)

    @classmethod
    def from_roboticstoolbox(cls, robot: Any) -> Arm:
        """The arm of a ``DHRobot`` of Corke's Robotics Toolbox."""
        from .bridges.roboticstoolbox import from_roboticstoolbox

        return from_roboticstoolbox(robot)

    @classmethod
    def _made(cls, name: str, text: Optional[bytes], set: Optional[Mapping[str, Cell]]) -> Arm:
        words = [f"{key}={value}" for key, value in (set or {}).items()]
        with Progress(False) as hear:
            arm = cls.__new__(cls, name, text, words, hear)
        # A diagnosis holds the file of its arm: messages are about that.
        return arm if text is not None or not name.endswith(".json") else cls.from_toml(arm.toml, f"<{os.path.basename(name)}>")

    def inverse_kinematics(
        self,
        pose: ArrayLike,
        near: Optional[ArrayLike] = None,
        *,
        wrench: Optional[Sequence[float]] = None,
        sides: Optional[ArrayLike] = None,
        warming: Optional[float] = None,
        given: Union[None, int, str] = None,
        elbow_angle: Optional[float] = None,
    ) -> Branches:
        """Every branch of the inverse kinematics: the readings at which the tool stands at a pose.

        `pose` is (4, 4) or (batch, 4, 4), as :meth:`pose` returns it; `near` (n,) or (batch, n) are readings: each joint comes by whole
        turns as near to them as its limits allow, a joint that the pose leaves free stays there, and of seven joints the last one (or
        the first) has its value from there in every branch. With a `wrench` (6,) they are set-points of the arm that gives under it
        and its weights. `given` chooses what of seven joints is given: a joint by its name or number from 1, or ``"elbow_angle"`` of an
        arm with a spherical shoulder and wrist, rad: that of `near`, or `elbow_angle`. Where no table with a closed form is near, six
        joints are searched for every solution: what is none of sixteen has an infinite distance. An arm without either is a
        ``ValueError`` that says what stands in the way.
        """
        load = None if wrench is None else [float(each) for each in wrench]
        kept = "elbow_angle" if given is None and elbow_angle is not None else given
        what = None if kept is None else str(kept)
        return Branches(*self.branches(pose, near, load, sides, warming, what, elbow_angle))

    #: Its short name.
    regressor = _native.Arm.torque_regressor

    def compile(self, *, compiler: Optional[str] = None, cache: Optional[Path] = None) -> str:
        """Prints C for the arm, compiles it, compares it with what computed before, and uses it; tells which is in use.

        Compiled once for a text and a compiler: the library stays in `cache` [default: ``stiffarm`` in the user's folder of
        caches]. `compiler` is a command [default: ``$CC``, else cc, gcc or clang]. Without one ``textbook`` is told, and stays.
        """
        from .compiler import compiled

        return compiled(self, compiler, cache)

    def to_mujoco(self, spec: mujoco.MjSpec, nominal: Arm, *, tip: Optional[str] = None) -> list[str]:
        """Puts into a model of MuJoCo's what this arm has corrected of `nominal`, the arm of that model: places and turns of the
        bodies and of the site `tip`; masses, centres and moments of inertia; the joints' springs, friction and armature. Tells what
        the model has no place for.
        """
        from .bridges.to_mujoco import to_mujoco

        return to_mujoco(self, spec, nominal, tip)

    def save(self, path: Path) -> None:
        """Writes the robot file."""
        with open(path, "w", encoding="utf-8") as file:
            file.write(self.toml)

    def __repr__(self) -> str:
        more = f", {len(self.effects)} effects" if self.effects else ""
        return f"<Arm {self.name}: {self.dof} joints{more}>"

    def __eq__(self, other: object) -> bool:
        """Whether both have the same robot file, to the byte."""
        return self.toml == other.toml if isinstance(other, Arm) else NotImplemented

    def __hash__(self) -> int:
        return hash(self.toml)

    def __reduce__(self) -> tuple[Any, ...]:
        if self.built_in:
            return Arm.load, (self.given,)
        return Arm.from_toml, (self.toml, self.given)


def _entries(table: Mapping[str, Any]) -> list[str]:
    return [f"{key} = {_value(value)}" for key, value in table.items() if value is not None]


def _value(value: Any) -> str:
    """As TOML writes it."""
    if isinstance(value, str):
        plain = value.replace("\\", "\\\\").replace('"', '\\"').replace("\n", "\\n")
        return f'"{plain}"'
    if isinstance(value, Mapping):
        return "{ " + ", ".join(f"{key} = {_value(each)}" for key, each in value.items()) + " }"
    if hasattr(value, "tolist"):
        value = value.tolist()
    if isinstance(value, (list, tuple)):
        return "[" + ", ".join(map(_value, value)) + "]"
    # An index of a joint is a whole number, and a number in SI is none.
    return repr(value if isinstance(value, int) else float(value))
