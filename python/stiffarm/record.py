"""Results as they stand in JSON, with their keys as attributes."""

from __future__ import annotations

import json
from typing import Any


class Record(dict):  # type: ignore[type-arg]
    """A dictionary of the JSON's, whose keys are attributes too: ``finding.effect``."""

    def __getattr__(self, name: str) -> Any:
        try:
            return self[name]
        except KeyError:
            known = ", ".join(self)
            raise AttributeError(f"found no {name!r}, expected one of {known}") from None

    def __dir__(self) -> list[str]:
        return [*super().__dir__(), *self]


def read(text: str) -> Record:
    """The record of a JSON text."""
    found = json.loads(text, object_pairs_hook=Record)
    assert isinstance(found, Record)
    return found


def read_all(text: str) -> list[Record]:
    """The records of a JSON list."""
    found = json.loads(text, object_pairs_hook=Record)
    assert isinstance(found, list)
    return found
