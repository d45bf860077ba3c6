"""What commands found: the JSON of the command line, and what it is shown as."""

from __future__ import annotations

from html import escape
from typing import Any, Optional

from .arm import Arm
from .record import Record, read
from .table import Table
from .words import Path


class Result:
    """What a command found.

    ``to_dict()`` is the JSON of the command line; its keys are attributes too. ``str`` of it is the command's screen,
    and a notebook shows its page, where it has one.
    """

    def __init__(self, json: str, text: str, page: Optional[str] = None) -> None:
        self._dict = read(json)
        self._text = text
        self._page = page

    def __getattr__(self, name: str) -> Any:
        # What is asked for before the object is there, as by copies, is not in it.
        if name.startswith("_"):
            raise AttributeError(name)
        return getattr(self._dict, name)

    def __str__(self) -> str:
        return self._text

    def __repr__(self) -> str:
        return self._text

    def to_dict(self) -> Record:
        """Everything, as the command line's ``--json`` has it."""
        return self._dict

    def to_html(self, path: Optional[Path] = None) -> str:
        """The page that the command line writes with ``--report``; written to `path` too, if there is one."""
        if self._page is None:
            raise ValueError("found no page: the command line has none of this either")
        if path is not None:
            with open(path, "w", encoding="utf-8") as file:
                file.write(self._page)
        return self._page

    def _repr_html_(self) -> str:
        return framed(self._page, self._text)


class Identification(Result):
    """Springs that were identified; ``corrected`` is the arm with them."""

    def __init__(self, json: str, text: str, page: Optional[str], corrected: Arm) -> None:
        super().__init__(json, text, page)
        self.corrected = corrected


class Predicted(Result):
    """What an arm does on given rows; ``table`` are these rows."""

    def __init__(self, json: str, text: str, table: Table) -> None:
        super().__init__(json, text)
        self.table = table


def framed(page: Optional[str], text: str) -> str:
    """For a notebook: a page in a frame of its own, whose styles are nobody else's; else the text."""
    if page is None:
        return f"<pre>{escape(text)}</pre>"
    return f'<iframe srcdoc="{escape(page)}" style="width: 100%; height: 48rem; border: 0"></iframe>'
