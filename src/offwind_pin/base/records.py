"""Records of numbers and arrays that compiled code reaches through one pointer.

A record is a frozen dataclass whose fields are numbers, NumPy arrays and further records. The
contents of its arrays may change, its fields may not. In compiled code it is a pointer to a table
with the value of each number and the address and shape of each array, so that passing it on costs
one word. Compiled code neither counts nor keeps references: the caller keeps the record. Kernels
(:mod:`offwind_pin.base.kernels`) take records by their type, ``Class.numba_type()``.
"""

from __future__ import annotations

import math
import zlib
from dataclasses import dataclass
from typing import Annotated, Any, ClassVar, Self, dataclass_transform, get_type_hints

import numpy as np
from numba import types
from numba.core import cgutils
from numba.core.typing.templates import AttributeTemplate
from numba.extending import (
    NativeValue,
    infer_getattr,
    intrinsic,
    lower_getattr_generic,
    models,
    register_model,
    unbox,
)
from numpy.typing import NDArray

Number = Annotated[float, types.float64]
Count = Annotated[int, types.int64]
Numbers = Annotated[NDArray[np.float64], types.float64[::1]]
Numbers2 = Annotated[NDArray[np.float64], types.float64[:, ::1]]
Numbers3 = Annotated[NDArray[np.float64], types.float64[:, :, ::1]]
Numbers4 = Annotated[NDArray[np.float64], types.float64[:, :, :, ::1]]
Counts = Annotated[NDArray[np.intp], types.intp[::1]]
Counts2 = Annotated[NDArray[np.intp], types.intp[:, ::1]]
Flags = Annotated[NDArray[np.bool_], types.boolean[::1]]
"""Types of fields; arrays have one dimension or as many as their name says, rows contiguous."""

_lowering: Any = cgutils
_DTYPES: dict[Any, Any] = {types.float64: np.float64, types.intp: np.intp, types.boolean: np.bool_}


class RecordType(types.Type):
    """Type of a class of records in compiled code.

    Attributes
    ----------
    members : type of each field
    slots : where its value, or its address and shape, begin in the table
    size : of the table
    """

    def __init__(self, record: type[Record]) -> None:
        hints = get_type_hints(record, include_extras=True)
        self.members: dict[str, Any] = {}
        self.slots: dict[str, int] = {}
        self.size = 0
        for name in record.__annotations__:
            self.members[name] = member = _member(hints[name])
            self.slots[name] = self.size
            self.size += 1 + (member.ndim if isinstance(member, types.Array) else 0)
        # Kept machine code is found by the name of a type: it changes with the fields.
        layout = zlib.crc32(repr(self.members).encode())
        super().__init__(f"{record.__module__}.{record.__qualname__}_{layout:08x}")


def _member(hint: Any) -> Any:
    metadata = getattr(hint, "__metadata__", None)
    return hint.numba_type() if metadata is None else metadata[0]


@dataclass_transform(frozen_default=True, eq_default=False)
class Record:
    """Base class of records; a subclass is made a frozen dataclass.

    Records pickle, and copy with :mod:`copy`; a shallow copy shares the arrays.
    """

    _numba_type_: ClassVar[RecordType]
    _table: NDArray[np.int64]
    _address: int

    def __init_subclass__(cls) -> None:
        dataclass(frozen=True, eq=False, repr=False)(cls)
        cls._numba_type_ = RecordType(cls)

    @classmethod
    def numba_type(cls) -> RecordType:
        """Its type in compiled code."""
        return cls._numba_type_

    def __post_init__(self) -> None:
        kind = self._numba_type_
        table = np.zeros(kind.size, dtype=np.int64)
        for name, member in kind.members.items():
            value, slot = getattr(self, name), kind.slots[name]
            if isinstance(member, RecordType):
                table[slot] = value._address
            elif isinstance(member, types.Array):
                _check(f"{type(self).__name__}.{name}", value, member)
                table[slot] = value.__array_interface__["data"][0]
                table[slot + 1 : slot + 1 + value.ndim] = value.shape
            elif member == types.float64:
                table[slot : slot + 1].view(np.float64)[0] = value
            else:
                table[slot] = value
        object.__setattr__(self, "_table", table)
        object.__setattr__(self, "_address", table.__array_interface__["data"][0])

    def __reduce__(self) -> tuple[type[Self], tuple[Any, ...]]:
        return type(self), tuple(getattr(self, name) for name in self._numba_type_.members)


def _check(name: str, array: Any, member: types.Array) -> None:
    """Refuse an array that compiled code would misread."""
    dtype = np.dtype(_DTYPES[member.dtype])
    if array.dtype != dtype or array.ndim != member.ndim or not array.flags.c_contiguous:
        raise TypeError(
            f"{name} is {array.dtype}, {array.ndim}-dimensional; it must be {dtype}, "
            f"{member.ndim}-dimensional and contiguous"
        )


register_model(RecordType)(models.OpaqueModel)


@unbox(RecordType)  # type: ignore[no-untyped-call, untyped-decorator]
def _pointer(kind: RecordType, record: Any, c: Any) -> Any:
    address = c.pyapi.object_getattr_string(record, "_address")
    pointer = c.pyapi.long_as_voidptr(address)
    c.pyapi.decref(address)
    failed = _lowering.is_not_null(c.builder, c.pyapi.err_occurred())
    return NativeValue(pointer, is_error=failed)  # type: ignore[no-untyped-call]


@infer_getattr
class _Fields(AttributeTemplate):
    key = RecordType

    def generic_resolve(self, record: Any, name: Any) -> Any:  # type: ignore[override]
        return record.members.get(name)


@lower_getattr_generic(RecordType)  # type: ignore[no-untyped-call, untyped-decorator]
def _value(context: Any, builder: Any, kind: RecordType, pointer: Any, name: str) -> Any:
    member, slot = kind.members[name], kind.slots[name]
    word = _lowering.intp_t
    table = builder.bitcast(pointer, word.as_pointer())

    def load(place: int) -> Any:
        value = builder.load(builder.gep(table, [word(place)]))
        value.set_metadata("invariant.load", builder.module.add_metadata([]))
        return value

    value = load(slot)
    if isinstance(member, types.Array):
        data = builder.inttoptr(value, context.get_data_type(member.dtype).as_pointer())
        shape = [load(slot + 1 + i) for i in range(member.ndim)]
        return view(context, builder, member, data, shape)
    if isinstance(member, RecordType):
        return builder.inttoptr(value, _lowering.voidptr_t)
    return builder.bitcast(value, context.get_value_type(member))


def view(context: Any, builder: Any, kind: types.Array, data: Any, shape: list[Any]) -> Any:
    """A contiguous array at an address, in code that is being lowered; nobody owns its memory."""
    fields: Any = context.data_model_manager[kind]
    size = context.get_constant(
        types.intp, context.get_abi_sizeof(context.get_data_type(kind.dtype))
    )
    array = _lowering.get_null_value(context.get_value_type(kind))

    def insert(array: Any, name: str, value: Any, *place: int) -> Any:
        return builder.insert_value(array, value, (fields.get_field_position(name), *place))

    array = insert(array, "data", data)
    array = insert(array, "itemsize", size)
    step, count = size, context.get_constant(types.intp, 1)
    for i in reversed(range(kind.ndim)):
        array = insert(array, "shape", shape[i], i)
        array = insert(array, "strides", step, i)
        step, count = builder.mul(step, shape[i]), builder.mul(count, shape[i])
    return insert(array, "nitems", count)


def _part(typing: Any, array: Any, first: Any, last: Any) -> Any:
    def lower(context: Any, builder: Any, used: Any, values: Any) -> Any:
        whole = context.make_array(array)(context, builder, values[0])
        length = builder.sub(values[2], values[1])
        shape = [length, *(builder.extract_value(whole.shape, i) for i in range(1, array.ndim))]
        offset = values[1]
        for size in shape[1:]:
            offset = builder.mul(offset, size)
        return view(context, builder, array, builder.gep(whole.data, [offset]), shape)

    return array(array, types.intp, types.intp), lower


def _matrix(typing: Any, numbers: Any, first: Any, rows: Any, columns: Any) -> Any:
    kind = types.Array(numbers.dtype, 2, "C")

    def lower(context: Any, builder: Any, used: Any, values: Any) -> Any:
        whole = context.make_array(numbers)(context, builder, values[0])
        return view(context, builder, kind, builder.gep(whole.data, [values[1]]), values[2:])

    return kind(numbers, types.intp, types.intp, types.intp), lower


def _stack_row(typing: Any, length: Any) -> Any:
    kind = types.Array(types.float64, 1, "C")

    def lower(context: Any, builder: Any, used: Any, values: Any) -> Any:
        return view(context, builder, kind, _room(context, builder, length), values)

    return kind(length), lower


def _stack_matrix(typing: Any, rows: Any, columns: Any) -> Any:
    kind = types.Array(types.float64, 2, "C")

    def lower(context: Any, builder: Any, used: Any, values: Any) -> Any:
        return view(context, builder, kind, _room(context, builder, rows, columns), values)

    return kind(rows, columns), lower


def _room(context: Any, builder: Any, *lengths: types.IntegerLiteral) -> Any:
    """Pointer to room for numbers among the local variables of a function."""
    count = math.prod(length.literal_value for length in lengths)
    number = context.get_data_type(types.float64)
    return _lowering.alloca_once(builder, number, _lowering.intp_t(count))


def _clear(typing: Any, array: Any) -> Any:
    def lower(context: Any, builder: Any, used: Any, values: Any) -> Any:
        whole = context.make_array(array)(context, builder, values[0])
        size = builder.mul(whole.nitems, whole.itemsize)
        _lowering.memset(builder, whole.data, size, 0)
        return context.get_dummy_value()

    return types.void(array), lower


clear: Any = intrinsic(_clear)
"""``clear(array)`` sets a contiguous array to zero."""

stack_row: Any = intrinsic(prefer_literal=True)(_stack_row)
stack_matrix: Any = intrinsic(prefer_literal=True)(_stack_matrix)
"""``stack_row(length)`` and ``stack_matrix(rows, columns)``: local arrays of fixed size.

Their contents are undefined at first. They take no allocator, and must not be returned. Each place
in the source is one array, in a loop too.
"""

part: Any = intrinsic(_part)
"""``part(array, first, last)``: ``array[first:last]`` of a contiguous array, for bounds within it.

A slice would take several times longer to compile.
"""

matrix: Any = intrinsic(_matrix)
"""``matrix(numbers, first, rows, columns)``: out of a contiguous array, from its first place on."""
