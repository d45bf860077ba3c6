"""Tables that come through the Arrow C stream interface, without a library of Arrow's.

The three structures are those of https://arrow.apache.org/docs/format/CDataInterface.html and CStreamInterface.html; what is read
are numbers (decimals as doubles), truth values, texts, and times in seconds: timestamps and dates since 1970, as those of workbooks
and texts are, times of the day since midnight, and durations.
"""

from __future__ import annotations

import ctypes
from typing import Any, Optional


class _Schema(ctypes.Structure):
    pass


class _Array(ctypes.Structure):
    pass


class _Stream(ctypes.Structure):
    pass


_SchemaPointer = ctypes.POINTER(_Schema)
_ArrayPointer = ctypes.POINTER(_Array)

_Schema._fields_ = [
    ("format", ctypes.c_char_p),
    ("name", ctypes.c_char_p),
    ("metadata", ctypes.c_char_p),
    ("flags", ctypes.c_int64),
    ("n_children", ctypes.c_int64),
    ("children", ctypes.POINTER(_SchemaPointer)),
    ("dictionary", _SchemaPointer),
    ("release", ctypes.CFUNCTYPE(None, _SchemaPointer)),
    ("private_data", ctypes.c_void_p),
]
_Array._fields_ = [
    ("length", ctypes.c_int64),
    ("null_count", ctypes.c_int64),
    ("offset", ctypes.c_int64),
    ("n_buffers", ctypes.c_int64),
    ("n_children", ctypes.c_int64),
    ("buffers", ctypes.POINTER(ctypes.c_void_p)),
    ("children", ctypes.POINTER(_ArrayPointer)),
    ("dictionary", _ArrayPointer),
    ("release", ctypes.CFUNCTYPE(None, _ArrayPointer)),
    ("private_data", ctypes.c_void_p),
]
_Stream._fields_ = [
    ("get_schema", ctypes.CFUNCTYPE(ctypes.c_int, ctypes.POINTER(_Stream), _SchemaPointer)),
    ("get_next", ctypes.CFUNCTYPE(ctypes.c_int, ctypes.POINTER(_Stream), _ArrayPointer)),
    ("get_last_error", ctypes.CFUNCTYPE(ctypes.c_char_p, ctypes.POINTER(_Stream))),
    ("release", ctypes.CFUNCTYPE(None, ctypes.POINTER(_Stream))),
    ("private_data", ctypes.c_void_p),
]

#: NumPy's types by Arrow's formats.
_NUMBERS = {
    "c": "i1", "C": "u1", "s": "i2", "S": "u2", "i": "i4", "I": "u4", "l": "i8", "L": "u8", "e": "f2", "f": "f4", "g": "f8",
}  # fmt: skip

#: Units of times in a second.
_UNITS = {"s": 1, "m": 10**3, "u": 10**6, "n": 10**9}

#: Seconds of a day.
_DAY = 86400

_pointer = ctypes.pythonapi.PyCapsule_GetPointer
_pointer.restype = ctypes.c_void_p
_pointer.argtypes = [ctypes.py_object, ctypes.c_char_p]


def columns(table: Any) -> dict[str, list[Any]]:
    """The columns of whatever has an Arrow C stream; what is null is None."""
    capsule = table.__arrow_c_stream__()
    stream = ctypes.cast(_pointer(capsule, b"arrow_array_stream"), ctypes.POINTER(_Stream))
    schema = _Schema()
    _check(stream, stream.contents.get_schema(stream, ctypes.byref(schema)))
    try:
        if schema.format != b"+s":
            raise TypeError(f"found an Arrow stream of {schema.format.decode()!r}, expected a table: columns")
        fields = [schema.children[k].contents for k in range(schema.n_children)]
        found: dict[str, list[Any]] = {field.name.decode(): [] for field in fields}
        while (batch := _next(stream)) is not None:
            try:
                for k, field in enumerate(fields):
                    child = batch.children[k].contents
                    cells = _cells(field.name.decode(), field, child, batch.offset, batch.length)
                    found[field.name.decode()].extend(cells)
            finally:
                batch.release(ctypes.byref(batch))
        return found
    finally:
        schema.release(ctypes.byref(schema))


def _next(stream: Any) -> Optional[_Array]:
    batch = _Array()
    _check(stream, stream.contents.get_next(stream, ctypes.byref(batch)))
    # A released array is the end of the stream.
    return batch if batch.release else None


def _check(stream: Any, code: int) -> None:
    if code:
        told = stream.contents.get_last_error(stream)
        raise ValueError(f"the Arrow stream ends: {told.decode() if told else f'error {code}'}")


def _cells(name: str, field: Any, array: Any, skipped: int, length: int) -> list[Any]:
    import numpy

    offset, kind = array.offset + skipped, field.format.decode()
    cells: list[Any]

    def buffer(k: int, dtype: str, count: int) -> Any:
        size = count * numpy.dtype(dtype).itemsize
        address = array.buffers[k]
        if not address or not size:
            return numpy.zeros(0, dtype)
        there: Any = (ctypes.c_char * size).from_address(address)
        return numpy.frombuffer(there, dtype)

    def bits(k: int) -> Any:
        packed = buffer(k, "u1", (offset + length + 7) // 8)
        return numpy.unpackbits(packed, bitorder="little")[offset : offset + length]

    if field.dictionary:
        values = _cells(name, field.dictionary.contents, array.dictionary.contents, 0, array.dictionary.contents.length)
        numbers = buffer(1, _NUMBERS[kind], offset + length)[offset:].tolist()
        cells = [values[k] if 0 <= k < len(values) else None for k in numbers]
    elif kind in _NUMBERS:
        cells = buffer(1, _NUMBERS[kind], offset + length)[offset:].tolist()
    elif kind == "b":
        cells = bits(1).tolist()
    elif kind == "tdD":
        cells = [_DAY * day for day in buffer(1, "i4", offset + length)[offset:].tolist()]
    elif kind[:2] in ("ts", "tt", "tD", "td") and kind[2:3] in _UNITS:
        wide = "i4" if kind in ("tts", "ttm") else "i8"
        # Whole numbers are divided exactly, and rounded once.
        cells = [number / _UNITS[kind[2]] for number in buffer(1, wide, offset + length)[offset:].tolist()]
    elif kind.startswith("d:"):
        _, scale, size = (int(word) for word in f"{kind[2:]},128".split(",")[:3])
        packed, size = buffer(1, "u1", size // 8 * (offset + length)).tobytes(), size // 8
        whole = [int.from_bytes(packed[at : at + size], "little", signed=True) for at in range(offset * size, len(packed), size)]
        # Whole numbers are divided exactly, and rounded once.
        cells = [number / 10**scale for number in whole]
    elif kind in ("u", "U"):
        ends = buffer(1, "i4" if kind == "u" else "i8", offset + length + 1)[offset:].tolist()
        data = buffer(2, "u1", ends[-1] if ends else 0).tobytes()
        cells = [data[a:b].decode() for a, b in zip(ends, ends[1:])]
    elif kind == "vu":
        cells = _views(array, offset, length)
    elif kind == "n":
        return [None] * length
    else:
        raise TypeError(f"{name}: found Arrow's type {kind!r}, expected numbers, truth values, texts or times")
    if array.buffers[0] and array.null_count != 0:
        cells = [cell if there else None for cell, there in zip(cells, bits(0).tolist())]
    return cells


def _views(array: Any, offset: int, length: int) -> list[str]:
    """Texts behind views of sixteen bytes: up to twelve bytes lie there, longer ones in another buffer."""
    cells = []
    for k in range(offset, offset + length):
        view = ctypes.string_at(array.buffers[1] + 16 * k, 16)
        size = int.from_bytes(view[:4], "little")
        text = view[4 : 4 + size]
        if size > 12:
            number, start = int.from_bytes(view[8:12], "little"), int.from_bytes(view[12:], "little")
            text = ctypes.string_at(array.buffers[2 + number] + start, size)
        cells.append(text.decode())
    return cells
