"""Commands, run inside this program."""

from __future__ import annotations

import os
from typing import Union

from . import _native
from .arm import Arm
from .table import Table
from .words import Path, Progress

#: An arm: itself, the id of a built-in one, or the path of a robot file, a URDF or a diagnosis.
AnyArm = Union[Arm, Path]


def robot(arm: AnyArm, files: dict[str, bytes]) -> str:
    """The word for an arm, its file among the `files` where it is not what that word says."""
    if not isinstance(arm, Arm):
        name = os.fspath(arm)
        if not name.lower().endswith((".urdf", ".xml")):
            return name
        arm = Arm.load(name)
    if arm.built_in:
        return arm.given
    # Two arms may have the same name.
    word = "<nominal>" if arm.given in files else arm.given
    files[word] = arm.toml.encode()
    return word


def run_bytes(words: list[str], files: dict[str, bytes], progress: bool = False) -> tuple[bool, dict[str, bytes]]:
    """Whether all was as it should, and what was written, by name; ``-`` is the screen."""
    with Progress(progress) as hear:
        return _native.run(words, files, hear)


def run(words: list[str], files: dict[str, bytes], progress: bool = False) -> tuple[bool, dict[str, str]]:
    """The same where all that is written is text."""
    good, written = run_bytes(words, files, progress)
    return good, {name: text.decode() for name, text in written.items()}


def tabled(words: list[str], files: dict[str, bytes], progress: bool = False, *, out: str = "csv") -> Table:
    """The table that a command writes."""
    return Table(run([*words, f"--{out}=<{out}>"], files, progress)[1][f"<{out}>"])
