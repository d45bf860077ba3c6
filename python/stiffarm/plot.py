"""Plots by matplotlib (``pip install stiffarm[plot]``)."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from .diagnosis import Diagnosis


def diagnosis(found: Diagnosis) -> Figure:
    """How the gap shrinks from finding to finding, each with its interval; of a log, joint by joint."""
    try:
        from matplotlib.figure import Figure
    except ImportError as error:
        raise ImportError("plots are made by matplotlib: pip install stiffarm[plot]") from error
    figure = Figure(figsize=(7.0, 1.5 + 0.5 * (1 + len(found.findings))), layout="constrained")
    axes: Any = figure.subplots()
    names, sizes, errors = _bars(found)
    axes.barh(range(len(names)), sizes, xerr=errors, color="0.6", error_kw={"capsize": 3})
    axes.set_yticks(range(len(names)), names)
    axes.invert_yaxis()
    axes.set_xlabel("gap, rms, on rows that no fit has seen, in parts of the gap before")
    axes.set_title(str(found.robot))
    return figure


def _bars(found: Diagnosis) -> tuple[list[str], list[float], Any]:
    names, sizes, low, high = ["before"], [1.0], [0.0], [0.0]
    first = None
    for finding in found.findings:
        held = finding["held_out"]
        first = first or held["before"]
        size = held["after"] / first
        ends = [(1.0 - s) * held["before"] / first for s in held.get("shrink_ci95", [1 - held["after"] / held["before"]] * 2)]
        names.append(f"{finding['effect']} at {finding['place']}".replace("_", " "))
        sizes.append(size)
        low.append(max(0.0, size - min(ends)))
        high.append(max(0.0, max(ends) - size))
    return names, sizes, [low, high]
