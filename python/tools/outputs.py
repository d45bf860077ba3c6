"""Writes what the extension module lists: stiffarm/outputs.py, a method for each output, and stiffarm/settings.py, a keyword
for each setting of a diagnosis.

    python tools/outputs.py           writes them
    python tools/outputs.py --check   exit status 1 if one is another
"""

import pathlib
import sys

from stiffarm import _native

HEAD = '''"""An arm's outputs, a method each. Written by tools/outputs.py."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any, Optional

if TYPE_CHECKING:
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

    def evaluate(
        self,
        output: str,
        inputs: Sequence[ArrayLike],
        wrench: Optional[ArrayLike] = None,
        out: Optional[Reals] = None,
        sides: Optional[ArrayLike] = None,
        warming: Optional[float] = None,
        at: Optional[str] = None,
    ) -> Reals:
        """An output by its name."""
        raise NotImplementedError
'''

BESIDE = "out: Optional[Reals] = None, sides: Optional[ArrayLike] = None, warming: Optional[float] = None, at: Optional[str] = None"


def method(name, sentence, formula, joints, takes_wrench, result):
    given = [f"{argument}: ArrayLike" for argument, _ in joints] + ["wrench: ArrayLike"] * takes_wrench
    about = [f"        {argument}: {text}." for argument, text in joints]
    if takes_wrench:
        about.append("        wrench: force and moment on the tool, N and N·m, base axes, at the tool's origin.")
    shape, units = result.split("; ", 1)
    values = ", ".join(argument for argument, _ in joints)
    wrench = "wrench" if takes_wrench else "None"
    raises = "\n\n        Raises Unstable where the arm has no stable equilibrium; the others are in `out`." if name in FALLIBLE else ""
    lines = [
        "",
        f"    def {name}(",
        f"        self, {', '.join(given)}, *,",
        f"        {BESIDE},",
        "    ) -> Reals:",
        f'        """{sentence}',
        "",
        f"        {formula}",
        "",
        *about,
        f"        Result: {shape}, in {units}.{raises}",
        '        """',
        f'        return self.evaluate("{name}", ({values},), {wrench}, out, sides, warming, at)',
    ]
    return "\n".join(lines) + "\n"


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
    folder = pathlib.Path(__file__).parent.parent / "stiffarm"
    texts = {"outputs.py": HEAD + "".join(method(*output) for output in _native.outputs()), "settings.py": settings()}
    if "--check" in sys.argv:
        sys.exit(any((folder / name).read_text(encoding="utf-8") != text for name, text in texts.items()))
    for name, text in texts.items():
        (folder / name).write_text(text, encoding="utf-8")


if __name__ == "__main__":
    main()
