"""Tables of measurements: whatever holds columns goes in, and what commands write comes out."""

from __future__ import annotations

import csv
import io
import os
from collections.abc import Iterator, Mapping
from typing import TYPE_CHECKING, Any, Union

from .words import Path

if TYPE_CHECKING:
    import pandas
    import polars

#: Measurements or logs: a path, a dictionary of arrays, or a table of pandas, polars, pyarrow or whatever else has an Arrow
#: C stream.
Frame = Union[Path, "Table", Mapping[str, Any], Any]

#: Columns that may be given together, as an array of as many.
_NUMBERED = ("q", "s", "tau", "i", "q_cmd")
_WRENCH = ("fx", "fy", "fz", "mx", "my", "mz")

#: What a table that is nowhere on disk is called in messages.
NAME = "<data>"


class Table(Mapping[str, Any]):
    """Columns by their names, with or without the unit: ``table["x[m]"]``, ``table["x"]``; arrays of float64, lists of texts.

    ``csv`` is the file as the command line writes it, with its comments. A table goes wherever a frame does.
    """

    def __init__(self, text: str) -> None:
        self.csv = text
        lines = text.splitlines(keepends=True)
        self.comments = [line[1:].strip() for line in lines if line.startswith("#")]
        rows = list(csv.reader(line for line in lines if not line.startswith("#")))
        head, body = rows[0], rows[1:]
        self._columns = {name: _column([row[k] for row in body]) for k, name in enumerate(head)}
        self._named = {name.split("[")[0]: name for name in head}
        self.rows = len(body)

    def __getitem__(self, name: str) -> Any:
        return self._columns[self._named.get(name, name)]

    def __iter__(self) -> Iterator[str]:
        return iter(self._columns)

    def __len__(self) -> int:
        return len(self._columns)

    def __repr__(self) -> str:
        return f"Table of {self.rows} rows: {', '.join(self)}"

    def save(self, path: Path) -> None:
        """Writes the file."""
        with open(path, "w", encoding="utf-8", newline="") as file:
            file.write(self.csv)

    def to_pandas(self) -> pandas.DataFrame:
        """As a DataFrame of pandas."""
        import pandas

        return pandas.DataFrame(dict(self))

    def to_polars(self) -> polars.DataFrame:
        """As a DataFrame of polars."""
        import polars

        return polars.DataFrame(dict(self))


class Map(Table):
    """A quantity over two joints: a row for each cell, NaN where there is none; ``svg`` is the picture."""

    def __init__(self, text: str, svg: str) -> None:
        super().__init__(text)
        self.svg = svg

    def _repr_svg_(self) -> str:
        return self.svg


def _column(cells: list[str]) -> Any:
    import numpy

    try:
        return numpy.array([float(cell) if cell else float("nan") for cell in cells])
    except ValueError:
        return cells


def held(frame: Frame, files: dict[str, bytes], name: str = NAME) -> str:
    """The word for a frame: its path, or `name` with its bytes among the `files`."""
    if isinstance(frame, (str, os.PathLike)):
        return os.fspath(frame)
    files[name] = frame.csv.encode() if isinstance(frame, Table) else _bytes(frame)
    return name


def _bytes(frame: Any) -> bytes:
    columns = _columns(frame)
    lengths = {name: len(column) for name, column in columns.items()}
    if len(set(lengths.values())) > 1:
        told = ", ".join(f"{name} has {length}" for name, length in lengths.items())
        raise ValueError(f"found columns of several lengths, expected one: {told}")
    text = io.StringIO()
    # Floats are written with as many digits as it takes to read them back.
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(columns)
    writer.writerows(zip(*columns.values()))
    return text.getvalue().encode()


def _columns(frame: Any) -> dict[str, list[Any]]:
    if isinstance(frame, Mapping):
        return {name: cells for key, column in frame.items() for name, cells in _parts(str(key), column)}
    if hasattr(frame, "__arrow_c_stream__"):
        from . import arrow

        try:
            return arrow.columns(frame)
        except ImportError:
            # pandas has the interface, but not without pyarrow; its columns can be asked for one by one.
            if not hasattr(frame, "columns"):
                raise
    if hasattr(frame, "columns") and hasattr(frame, "__getitem__"):
        return {str(name): _list(frame[name]) for name in frame.columns}
    kind = type(frame).__name__
    raise TypeError(
        f"found {kind}, expected a path, a dictionary of arrays, or a table with an Arrow C stream (pandas, polars, pyarrow, …)"
    )


def _parts(name: str, column: Any) -> Iterator[tuple[str, list[Any]]]:
    """A column, or those of an array of two dimensions: `q` (m, n) is q1 … qn, `wrench` (m, 6) is fx … mz."""
    shape = getattr(column, "shape", None)
    if shape is None or len(shape) < 2:
        yield name, _list(column)
        return
    bare, unit = (name.split("[")[0], name[len(name.split("[")[0]) :])
    if len(shape) == 2 and bare in _NUMBERED:
        names = [f"{bare}{k + 1}{unit}" for k in range(shape[1])]
    elif bare == "wrench" and shape[1:] == (6,) and not unit:
        names = list(_WRENCH)
    else:
        several = ", ".join(_NUMBERED)
        raise ValueError(f"{name}: found the shape {tuple(shape)}, expected (rows,); of {several} (rows, n), of wrench (rows, 6)")
    for k, each in enumerate(names):
        yield each, _list(column[:, k])


def _list(column: Any) -> list[Any]:
    return column.tolist() if hasattr(column, "tolist") else list(column)
