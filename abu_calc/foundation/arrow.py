"""Columns as a stream of the Arrow C data interface, which pandas, Polars, DuckDB and PyArrow read, without a library.

    class Table:
        def __arrow_c_stream__(self, requested_schema=None):
            return arrow_stream(self.columns)

A stream gives one struct whose children are the columns: numbers as float64 or int64, true and false as bits, all else
as text; what is missing is null. Source: the Arrow C data interface, C stream interface and PyCapsule interface.
The memory is kept until the reader releases it. A column may be taken from its struct, so each is kept on its own.
"""

import ctypes
import itertools
import json
import math
from array import array
from collections.abc import Mapping, Sequence
from ctypes import POINTER, c_char_p, c_int, c_int64, c_void_p, cast, memset, pointer, sizeof
from typing import Any, Final

RELEASE: Final = ctypes.CFUNCTYPE(None, c_void_p)
NULLABLE: Final = 2


class ArrowSchema(ctypes.Structure):
    """Type of a column, or of the struct that holds the columns."""


class ArrowArray(ctypes.Structure):
    """Buffers of a column, or of the struct that holds the columns."""


class ArrowStream(ctypes.Structure):
    """Functions that give schema and arrays, in this order, and the release."""


ArrowSchema._fields_ = [
    ("format", c_char_p), ("name", c_char_p), ("metadata", c_char_p), ("flags", c_int64), ("n_children", c_int64),
    ("children", POINTER(POINTER(ArrowSchema))), ("dictionary", c_void_p), ("release", c_void_p),
    ("private_data", c_void_p),
]  # fmt: skip
ArrowArray._fields_ = [
    ("length", c_int64), ("null_count", c_int64), ("offset", c_int64), ("n_buffers", c_int64), ("n_children", c_int64),
    ("buffers", POINTER(c_void_p)), ("children", POINTER(POINTER(ArrowArray))), ("dictionary", c_void_p),
    ("release", c_void_p), ("private_data", c_void_p),
]  # fmt: skip
GET: Final = ctypes.CFUNCTYPE(c_int, c_void_p, c_void_p)
ERROR: Final = ctypes.CFUNCTYPE(c_void_p, c_void_p)
ArrowStream._fields_ = [
    ("get_schema", c_void_p), ("get_next", c_void_p), ("get_last_error", c_void_p), ("release", c_void_p),
    ("private_data", c_void_p),
]  # fmt: skip

_kept: Final[dict[int, object]] = {}
"""Memory that readers hold, by the number that stands in its `private_data`."""
_numbers: Final = itertools.count(1)


def arrow_stream(columns: Mapping[str, Sequence[Any]]) -> object:
    """A capsule "arrow_array_stream" with the columns, all of the same length."""
    stream = ArrowStream(
        cast(_GET_SCHEMA, c_void_p), cast(_GET_NEXT, c_void_p), cast(_NO_ERROR, c_void_p),
        cast(_STREAM_RELEASE, c_void_p),
    )  # fmt: skip
    stream.private_data = _keep({"columns": {name: _encoded(list(values)) for name, values in columns.items()},
                                 "length": len(next(iter(columns.values()), ())), "sent": False})  # fmt: skip
    place = ctypes.addressof(stream)
    _kept[-place] = stream
    return _NEW(place, b"arrow_array_stream", cast(_CAPSULE_END, c_void_p))


class _Column:
    """Format and buffers of one column: its validity, then its values."""

    def __init__(self, kind: bytes, length: int, missing: int, *buffers: bytes | None) -> None:
        self.kind, self.length, self.missing, self.buffers = kind, length, missing, buffers


def _encoded(values: list[Any]) -> _Column:
    missing = [value is None or (isinstance(value, float) and math.isnan(value)) for value in values]
    there = [value for value, absent in zip(values, missing, strict=True) if not absent]
    count = sum(missing)
    valid = _bits([not absent for absent in missing]) if count else None
    if there and all(isinstance(value, bool) for value in there):
        return _Column(b"b", len(values), count, valid, _bits([bool(value) for value in values]))
    if there and all(isinstance(value, int) and abs(value) < 2**63 and not isinstance(value, bool) for value in there):
        filled = array("q", (0 if absent else value for value, absent in zip(values, missing, strict=True)))
        return _Column(b"l", len(values), count, valid, filled.tobytes())
    if all(isinstance(value, (int, float)) and not isinstance(value, bool) for value in there):
        numbers = array("d", (0.0 if absent else value for value, absent in zip(values, missing, strict=True)))
        return _Column(b"g", len(values), count, valid, numbers.tobytes())
    texts = [b"" if absent else _text(value) for value, absent in zip(values, missing, strict=True)]
    ends = array("q", itertools.accumulate(map(len, texts), initial=0))
    return _Column(b"U", len(values), count, valid, ends.tobytes(), b"".join(texts))


def _text(value: object) -> bytes:
    text = value if isinstance(value, str) else json.dumps(value, ensure_ascii=False, default=str)
    return text.encode("utf-8", "replace")


def _bits(values: Sequence[bool]) -> bytes:
    """Truth values, eight in a byte, the first in its lowest bit.

    >>> _bits([True, False, True, False, False, False, False, False, True]).hex()
    '0501'
    """
    packed = bytearray((len(values) + 7) // 8)
    for index, value in enumerate(values):
        packed[index // 8] |= value << index % 8
    return bytes(packed)


def _keep(memory: object) -> int:
    number = next(_numbers)
    _kept[number] = memory
    return number


def _filled_schema(schema: ArrowSchema, kind: bytes, name: bytes, children: Sequence[ArrowSchema] = ()) -> None:
    pointers = (POINTER(ArrowSchema) * len(children))(*map(pointer, children))
    schema.format, schema.name, schema.flags = kind, name, 0 if children else NULLABLE
    schema.n_children, schema.children = len(children), cast(pointers, POINTER(POINTER(ArrowSchema)))
    schema.release = cast(_SCHEMA_RELEASE, c_void_p)
    schema.private_data = _keep((kind, name, pointers, children))


def _filled_array(
    place: ArrowArray, length: int, missing: int, buffers: Sequence[bytes | None], children: Sequence[ArrowArray] = ()
) -> None:
    addresses = (c_void_p * len(buffers))(
        *(None if buffer is None else cast(c_char_p(buffer or b"\0"), c_void_p) for buffer in buffers)
    )
    pointers = (POINTER(ArrowArray) * len(children))(*map(pointer, children))
    place.length, place.null_count, place.n_buffers, place.n_children = length, missing, len(buffers), len(children)
    place.buffers, place.children = cast(addresses, POINTER(c_void_p)), cast(pointers, POINTER(POINTER(ArrowArray)))
    place.release = cast(_ARRAY_RELEASE, c_void_p)
    place.private_data = _keep((buffers, addresses, pointers, children))


def _get_schema(stream: int, out: int) -> int:
    state: Any = _kept[ArrowStream.from_address(stream).private_data]
    memset(out, 0, sizeof(ArrowSchema))
    children = [ArrowSchema() for _ in state["columns"]]
    for child, (name, column) in zip(children, state["columns"].items(), strict=True):
        _filled_schema(child, column.kind, name.encode("utf-8", "replace"))
    _filled_schema(ArrowSchema.from_address(out), b"+s", b"", children)
    return 0


def _get_next(stream: int, out: int) -> int:
    state: Any = _kept[ArrowStream.from_address(stream).private_data]
    memset(out, 0, sizeof(ArrowArray))  # without a release, the end of the stream
    if state["sent"]:
        return 0
    state["sent"] = True
    children = [ArrowArray() for _ in state["columns"]]
    for child, column in zip(children, state["columns"].values(), strict=True):
        _filled_array(child, column.length, column.missing, column.buffers)
    _filled_array(ArrowArray.from_address(out), state["length"], 0, (None,), children)
    return 0


def _released(kind: Any, kept: dict[int, object] = _kept, release: Any = RELEASE) -> Any:
    """A release of a schema, an array or a stream: of its children first, then of the memory that it holds."""

    def end(place: int) -> None:
        held = kind.from_address(place)
        for index in range(getattr(held, "n_children", 0)):
            child = held.children[index].contents
            if child.release:
                release(child.release)(ctypes.addressof(child))
        kept.pop(held.private_data, None)
        held.release = None

    return release(end)


def _capsule_end(capsule: int, kept: dict[int, object] = _kept, release: Any = RELEASE) -> None:
    place = _POINTER(capsule, b"arrow_array_stream")
    stream = ArrowStream.from_address(place)
    if stream.release:
        release(stream.release)(place)
    kept.pop(-place, None)


_GET_SCHEMA, _GET_NEXT = GET(_get_schema), GET(_get_next)
_NO_ERROR: Final = ERROR(lambda stream: None)
_SCHEMA_RELEASE, _ARRAY_RELEASE, _STREAM_RELEASE = map(_released, (ArrowSchema, ArrowArray, ArrowStream))
_CAPSULE_END: Final = RELEASE(_capsule_end)
_NEW: Final = ctypes.PYFUNCTYPE(ctypes.py_object, c_void_p, c_char_p, c_void_p)(("PyCapsule_New", ctypes.pythonapi))
_POINTER: Final = ctypes.PYFUNCTYPE(c_void_p, c_void_p, c_char_p)(("PyCapsule_GetPointer", ctypes.pythonapi))
