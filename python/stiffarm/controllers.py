"""What controllers take: files with what was found, and programs with their points corrected. Both are bytes: the encoding of a
controller's file is its own.
"""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Optional, Union

from .run import AnyArm, robot, run_bytes
from .table import Table
from .words import Path, Quantity, Wrench, options

#: A pose as the program's language writes it: six numbers in its units, or a text.
Written = Union[str, Sequence[float]]


def controller(
    arm: AnyArm,
    format: str,
    *,
    nominal: Optional[AnyArm] = None,
    into: Optional[Path] = None,
    hash: Optional[str] = None,
) -> bytes:
    """What was found, as the file that a controller or a driver takes. What the format does not hold goes to the log.

    format: as ``stiffarm controller --help`` lists them: ``ur-calibration``, ``ur-kinematics``, …. nominal: the robot as its controller
    computes it. into: the controller's own file, of which what was found is changed and nothing else. hash: that of the robot's own
    kinematics file.
    """
    files: dict[str, bytes] = {}
    words = ["controller", robot(arm, files), *options(format=format, into=into, hash=hash)]
    if nominal is not None:
        words += options(nominal=robot(nominal, files))
    return run_bytes(words, files)[1]["-"]


@dataclass(frozen=True)
class Corrected:
    """A program with its points corrected; ``str`` of it is the command's screen."""

    #: Its files, by their names without folders.
    files: dict[str, bytes]
    #: What became of each point.
    moves: Table
    #: Whether every point that should be corrected is.
    complete: bool
    #: The command's screen.
    text: str

    def __str__(self) -> str:
        return self.text


def compensate_program(
    arm: AnyArm,
    program: Union[Path, Sequence[Path]],
    nominal: AnyArm,
    *,
    frames: Optional[Mapping[str, Written]] = None,
    tools: Optional[Mapping[str, Written]] = None,
    home: Optional[Sequence[float]] = None,
    leave: Sequence[str] = (),
    wrench: Optional[Wrench] = None,
    tolerance: Optional[Quantity] = None,
    tolerance_rotation: Optional[Quantity] = None,
    progress: bool = True,
) -> Corrected:
    """A controller's program whose points are corrected so that the arm as it is stands where the controller believes.

    program: a file, or the files of one program: KRL, RAPID, FANUC's TP in letters, URScript, or a table of points. nominal: the robot as
    its controller computes it. frames, tools: places that the program does not define, by name, ``{"1": [500, 0, 200, 0, 0, 0]}`` in the
    units of the language; a tool may be ``"robot"``, that of the robot files. home: joint values before the first point, rad (m).
    leave: points that stay as they are. wrench: the load. tolerance, tolerance_rotation: as of :func:`compensate`.
    """
    files: dict[str, bytes] = {}
    paths = [program] if isinstance(program, (str, os.PathLike)) else list(program)
    given = [("frame", frames), ("tool", tools)]
    words = [
        "compensate",
        robot(arm, files),
        *(word for path in paths for word in options(program=path)),
        *(
            word.replace("=", f"={name}=", 1)
            for option, places in given
            for name, pose in (places or {}).items()
            for word in options(**{option: pose})
        ),
        *options(
            nominal=robot(nominal, files), home=home, leave=leave, wrench=wrench, tolerance=tolerance,
            tolerance_rotation=tolerance_rotation,
        ),
        "--out=<out>",
        "--moves=<moves>",
    ]
    complete, written = run_bytes(words, files, progress)
    moves, text = written.pop("<moves>").decode(), written.pop("-").decode()
    named = {os.path.basename(paths[0] if name == "<out>" else name): content for name, content in written.items()}
    return Corrected(named, Table(moves), complete, text)
