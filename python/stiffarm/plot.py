"""Plots by matplotlib (``pip install stiffarm[plot]``)."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from .record import Record

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from .diagnosis import Diagnosis


def diagnosis(found: Diagnosis) -> Figure:
    """How the gap shrinks from finding to finding, each with its interval; of a log, joint by joint."""
    try:
        from matplotlib.figure import Figure
    except ImportError as error:
        raise ImportError("plots are made by matplotlib: pip install stiffarm[plot]") from error
    parts = found.parts
    heights = [2 + len(part.gap) if isinstance(part.gap, list) else 1 + len(part.findings) for part in parts]
    figure = Figure(figsize=(7.0, 1.5 * len(parts) + 0.5 * sum(heights)), layout="constrained")
    all_axes: Any = figure.subplots(len(parts), 1, squeeze=False, height_ratios=heights)
    for axes, part in zip(all_axes[:, 0], parts):
        if isinstance(part.gap, list):
            _joints(axes, part)
        else:
            _findings(axes, part)
        axes.invert_yaxis()
        axes.set_title(str(part.robot))
    return figure


def _findings(axes: Any, found: Record) -> None:
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
    axes.barh(range(len(names)), sizes, xerr=[low, high], color="0.6", error_kw={"capsize": 3})
    axes.set_yticks(range(len(names)), names)
    axes.set_xlabel("gap, rms, on rows that no fit has seen, in parts of the gap before")


def _joints(axes: Any, found: Record) -> None:
    rows = range(len(found.gap) + 1)
    whole = found.shrink
    for shift, when, shade in ((-0.2, "before", "0.8"), (0.2, "after", "0.4")):
        sizes = [joint[when] / joint["size"] for joint in found.gap] + [whole[when]]
        axes.barh([row + shift for row in rows], sizes, height=0.4, color=shade, label=f"{when} the findings")
    # What is left is the mean's, in another log.
    left = sorted(whole["before"] * (1.0 - part) for part in whole["shrink_ci95"])
    errors = [[max(0.0, whole["after"] - left[0])], [max(0.0, left[1] - whole["after"])]]
    axes.errorbar([whole["after"]], [len(found.gap) + 0.2], xerr=errors, color="0.0", capsize=3, linestyle="none")
    axes.set_yticks(rows, [f"joint {row + 1}" for row in rows[:-1]] + ["mean"])
    parts = "torques' spread" if found.rows == "torque" else "position errors"
    axes.set_xlabel(f"gap, rms, on time that no fit has seen, in parts of the {parts}")
    axes.legend()
