"""Writes what the extension module lists: src/arm/methods.rs and stiffarm/outputs.pyi, a method for each output, and
stiffarm/settings.py, a keyword for each setting of a diagnosis.

    python tools/outputs.py           writes them
    python tools/outputs.py --check   exit status 1 if one is another
"""

import pathlib
import sys

from stiffarm import _native

STUBS = '''"""An arm's outputs, a method each. Written by tools/outputs.py."""

from typing import Any, Optional

import numpy
from numpy.typing import ArrayLike, NDArray

Reals = NDArray[numpy.floating[Any]]

class Outputs:
    """What an arm computes.

    Joint values and what else is said of joints are (n,) or (batch, n), wrenches (6,) or (batch, 6), results as each method says,
    with the batch in front: float64, or float32 (worked out in double, and rounded) of joint values that are. What is told of the
    tool is told of a ``[[frame]]`` or a ``[[marker]]`` of the robot file `at` its name, wrenches and all: ``arm.places`` lists
    them. `sides` (n,), from which side each joint came to rest, and `warming`, K, are for a corrected arm that depends on them.
    """
'''

METHODS = """//! An arm's outputs, a method each. Written by tools/outputs.py.

use pyo3::prelude::*;
use stiffarm_kernels::Output;

use super::Arm;
use super::evaluate::Beside;
use super::method::methods;

methods! {
"""

BESIDE = "out: Optional[Reals] = None, sides: Optional[ArrayLike] = None, warming: Optional[float] = None, at: Optional[str] = None"


def stub(name, sentence, formula, joints, takes_wrench, result):
    given = [f"{argument}: ArrayLike" for argument, _ in joints] + ["wrench: ArrayLike"] * takes_wrench
    lines = [
        "",
        f"    def {name}(",
        f"        self, {', '.join(given)}, *,",
        f"        {BESIDE},",
        "    ) -> Reals:",
        f'        """{sentence} Result: {result.replace("; ", ", in ", 1)}."""',
    ]
    return "\n".join(lines) + "\n"


def method(name, sentence, formula, joints, takes_wrench, result):
    about = [sentence, "", formula, "", *(f"{argument}: {text}." for argument, text in joints)]
    if takes_wrench:
        about.append("wrench: force and moment on the tool, N and N·m, base axes, at the tool's origin.")
    about.append(f"Result: {result.replace('; ', ', in ', 1)}.")
    if name in FALLIBLE:
        about += ["", "Raises Unstable where the arm has no stable equilibrium; the others are in `out`."]
    values = ", ".join(argument for argument, _ in joints)
    output = name.title().replace("_", "")
    lines = [*(f"/// {line}".rstrip() for line in about), f"{name}({values}{'; wrench' * takes_wrench}) {output};"]
    return "".join(f"    {line}\n" for line in lines)


FALLIBLE = ("deflection", "deflection_with_gravity", "deflection_by_joints", "forward_dynamics")


SETTINGS = '''"""What may be chosen about a diagnosis. Written by tools/outputs.py."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Optional, TypedDict, Union

from .words import Path, Quantity


class Settings(TypedDict, total=False):
    """What may be chosen about a diagnosis, as the options of ``stiffarm diagnose``."""

'''

# What a program has no file of.
HELD = ("check", "compare")


def settings():
    each = [one for one in _native.settings() if one[0] not in HELD]
    return SETTINGS + "".join(f'    {name}: {kind}\n    """{about}."""\n' for name, kind, about in each)


def main():
    folder = pathlib.Path(__file__).parent.parent
    outputs = _native.outputs()
    texts = {
        "src/arm/methods.rs": METHODS + "\n".join(method(*output) for output in outputs) + "}\n",
        "stiffarm/outputs.pyi": STUBS + "".join(stub(*output) for output in outputs),
        "stiffarm/settings.py": settings(),
    }
    if "--check" in sys.argv:
        sys.exit(any((folder / name).read_text(encoding="utf-8") != text for name, text in texts.items()))
    for name, text in texts.items():
        (folder / name).write_text(text, encoding="utf-8")


if __name__ == "__main__":
    main()
