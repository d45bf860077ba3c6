"""Options of functions as the words of commands."""

from __future__ import annotations

import logging
import os
from collections.abc import Iterable, Sequence
from typing import Any, Callable, Optional, Union

log = logging.getLogger("stiffarm")

#: A quantity: a number in SI, or a text with a unit: ``3e-5``, ``"30 um"``.
Quantity = Union[float, str]
#: A load: fx, fy, fz, mx, my, mz (N, N·m; base axes, at the tool's origin), or a text with units.
Wrench = Union[str, Sequence[float]]
#: A path on disk.
Path = Union[str, "os.PathLike[str]"]
#: Remarks, and what is being done with the part that is done.
Hear = Callable[[list, Optional[tuple]], None]  # type: ignore[type-arg]


def plain(value: Any) -> Any:
    """What JSON knows of a path, of a number of NumPy, or of anything in a row."""
    if isinstance(value, os.PathLike):
        return os.fspath(value)
    return value.item() if hasattr(value, "item") and not getattr(value, "ndim", 0) else list(value)


def option(name: str, value: Any, unit: str = "") -> list[str]:
    """``--name=value``; nothing of None and False, the bare name of True; a number gets its SI unit."""
    name = name.replace("_", "-")
    if value is None or value is False:
        return []
    if value is True:
        return [f"--{name}"]
    if isinstance(value, (list, tuple)):
        return [f"--{name}={','.join(map(str, value))}"] if value else []
    if unit and not isinstance(value, str):
        value = f"{float(value)!r}{unit}"
    return [f"--{name}={value}"]


def each(name: str, values: Iterable[Any]) -> list[str]:
    """The option once for each value."""
    return [word for value in values for word in option(name, value)]


def numbers(name: str, values: Union[None, str, Sequence[float]]) -> list[str]:
    """Numbers in a row."""
    if values is None or isinstance(values, str):
        return option(name, values)
    return option(name, ",".join(repr(float(x)) for x in values))


class Progress:
    """Remarks to the logger, progress to tqdm where it is installed and somebody may look at it."""

    def __init__(self, shown: bool) -> None:
        self.shown = shown
        self.bar: Any = None

    def __enter__(self) -> Progress:
        return self

    def __exit__(self, *_: object) -> None:
        if self.bar is not None:
            self.bar.close()

    def __call__(self, remarks: list[str], doing: Optional[tuple[str, Optional[float]]]) -> None:
        for remark in remarks:
            log.warning("%s", remark)
        if doing is None or not self.shown:
            return
        if self.bar is None:
            try:
                from tqdm.auto import tqdm
            except ImportError:
                self.shown = False
                return
            self.bar = tqdm(total=1.0, disable=None, leave=False, bar_format="{desc} {percentage:3.0f} % {elapsed}")
        what, part = doing
        self.bar.set_description_str(what, refresh=False)
        self.bar.n = part or 0.0
        self.bar.refresh()
