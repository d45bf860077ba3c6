"""Options of functions as the words of commands."""

from __future__ import annotations

import functools
import inspect
import logging
import os
from collections.abc import Iterable, Sequence
from numbers import Integral
from typing import Any, Callable, Optional, TypeVar, Union

log = logging.getLogger("stiffarm")

#: A quantity: a number in SI, or a text with a unit: ``3e-5``, ``"30 um"``.
Quantity = Union[float, str]
#: A load: fx, fy, fz, mx, my, mz (N, N·m; base axes, at the tool's origin), or a text with units.
Wrench = Union[str, Sequence[float]]
#: A path on disk.
Path = Union[str, "os.PathLike[str]"]
#: Any function.
Function = TypeVar("Function", bound=Callable[..., Any])
#: Remarks, and what is being done with the part that is done.
Hear = Callable[[list, Optional[tuple]], None]  # type: ignore[type-arg]


def plain(value: Any) -> Any:
    """What JSON knows of a path, of a number of NumPy, or of anything in a row."""
    if isinstance(value, os.PathLike):
        return os.fspath(value)
    return value.item() if hasattr(value, "item") and not getattr(value, "ndim", 0) else list(value)


#: What a setting of such a type is where nothing is chosen.
_USUAL = {"Sequence[str]": (), "bool": False, "int": 0}


def signed(settings: type) -> Callable[[Function], Function]:
    """Puts each of some settings into a function's signature, as help() and notebooks show it; any other keyword is refused."""

    def of(function: Function) -> Function:
        own = inspect.signature(function)
        named = [parameter for parameter in own.parameters.values() if parameter.kind is not inspect.Parameter.VAR_KEYWORD]
        for name, kind in settings.__annotations__.items():
            kind = str(getattr(kind, "__forward_arg__", kind))
            named.append(inspect.Parameter(name, inspect.Parameter.KEYWORD_ONLY, default=_USUAL.get(kind), annotation=kind))
        signature = own.replace(parameters=named)

        @functools.wraps(function)
        def checked(*given: Any, **options: Any) -> Any:
            signature.bind(*given, **options)
            return function(*given, **options)

        checked.__signature__ = signature  # type: ignore[attr-defined]
        return checked  # type: ignore[return-value]

    return of


#: What a number is in, where an option of that name is a quantity.
_UNITS = {
    **dict.fromkeys(("length", "noise_position", "tolerance"), "m"),
    **dict.fromkeys(("noise_rotation", "tolerance_rotation"), "rad"),
    **dict.fromkeys(("colour", "jitter", "period"), "s"),
    "rate": "Hz",
    "payload": "kg",
}


def options(**given: Any) -> list[str]:
    """``--name=value`` of each; nothing of None, False and what is empty, the bare name of True; a number gets its SI unit."""
    return [word for name, value in given.items() for word in _option(name, value)]


def _option(name: str, value: Any) -> list[str]:
    word = "--" + name.rstrip("_").replace("_", "-")
    if value is None or value is False:
        return []
    if value is True:
        return [word]
    unit = _UNITS.get(name, "")
    if not isinstance(value, str) and isinstance(value, Iterable):
        text = ",".join(one if isinstance(one, str) else _number(one) for one in value)
        return [f"{word}={text}"] if text else []
    return [f"{word}={value if isinstance(value, (str, os.PathLike)) else _number(value) + unit}"]


def _number(value: Any) -> str:
    """With as many digits as it takes to read it back."""
    return str(int(value)) if isinstance(value, Integral) else repr(float(value))


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
