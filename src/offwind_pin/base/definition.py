"""Building blocks of definitions: numbers with ranges, files, and the frozen base class."""

from __future__ import annotations

import hashlib
import inspect
import json
from collections.abc import Iterator
from pathlib import Path
from typing import Annotated, Any, ClassVar, Self, dataclass_transform

import numpy as np
from numpy.typing import NDArray
from pydantic import (
    BaseModel,
    BeforeValidator,
    ConfigDict,
    Field,
    PlainSerializer,
    ValidationError,
    ValidationInfo,
    ValidatorFunctionWrapHandler,
    WrapValidator,
)
from pydantic.fields import FieldInfo

from offwind_pin.base.errors import InputError
from offwind_pin.base.input_files import check_file, is_file
from offwind_pin.base.validation import input_error

Array = NDArray[np.float64]
ComplexArray = NDArray[np.complex128]


LARGEST = 1e30
"""Magnitude beyond which no number is plausible, whatever its unit; products stay finite."""
MOST_NUMBERS = 1_000_000
"""Largest length of a list; longer data belongs in a file."""


def _plain(value: Any) -> Any:
    """A number as a Python object; accepts NumPy numbers and rejects booleans."""
    if isinstance(value, np.generic):
        value = value.item()
    if isinstance(value, bool):
        raise ValueError("expected a number, not true or false")
    return value


def _listed(value: Any) -> Any:
    return value.tolist() if isinstance(value, np.ndarray) else value


def _locate(value: Any, validate: ValidatorFunctionWrapHandler, info: ValidationInfo) -> Path:
    """Absolute path of a file; a relative path refers to the folder of the file that contains
    it."""
    recorded = None
    if isinstance(value, dict):
        if not {"path"} <= value.keys() <= {"path", "sha256"}:
            raise ValueError("a file requires a path; give the path, or {path, sha256}")
        value, recorded = value["path"], value.get("sha256")
    folder = (info.context or {}).get("folder", "")
    path: Path = (folder / validate(value)).absolute()
    if recorded is not None and is_file(path) and file_digest(path) != recorded:
        raise ValueError(
            f"{path} has changed since its SHA-256 was recorded; restore it, or leave sha256 out"
        )
    return path


def _file_record(path: Path) -> dict[str, str | None]:
    return {"path": str(path), "sha256": file_digest(path) if is_file(path) else None}


Number = Annotated[
    float,
    Field(strict=True, allow_inf_nan=False, ge=-LARGEST, le=LARGEST),
    BeforeValidator(_plain),
]
"""A finite number; text is rejected."""
Integer = Annotated[int, Field(strict=True), BeforeValidator(_plain)]
"""An integer; 3.0 is rejected."""
Flag = Annotated[bool, Field(strict=True)]
"""True or false; 1 and "yes" are rejected."""
Positive = Annotated[Number, Field(gt=0)]
NonNegative = Annotated[Number, Field(ge=0)]
Vector3 = tuple[Number, Number, Number]
Vector6 = tuple[Number, Number, Number, Number, Number, Number]
Direction = Annotated[Number, Field(ge=-360, le=360)]
"""In degrees."""
Seed = Annotated[Integer, Field(ge=0, lt=2**31)]
Numbers = Annotated[tuple[Number, ...], Field(max_length=MOST_NUMBERS), BeforeValidator(_listed)]
"""Numbers in a row, from a list, a tuple or a one-dimensional array."""
File = Annotated[Path, WrapValidator(_locate), PlainSerializer(_file_record, when_used="json")]
"""Absolute path of a file. JSON has ``{path, sha256}``; reading it rejects a changed file."""


def key(name: str, *, default: Any = ..., kw_only: bool | None = None) -> Any:
    """A field with a different name in files, usually with its unit.

    Parameters
    ----------
    name : str
        Key in a file, such as ``height_m``.
    """
    return Field(default, validation_alias=name, serialization_alias=name, kw_only=kw_only)


@dataclass_transform(kw_only_default=True, field_specifiers=(Field, key))
class Definition(BaseModel):
    """Base of every definition: frozen, with unknown keys rejected and units in the keys of files.

    A subclass that is declared with ``kw_only=False`` takes its own fields by position as well.

    Attributes
    ----------
    source : str, optional
        Where the numbers come from.
    """

    model_config = ConfigDict(
        frozen=True,
        extra="forbid",
        validate_by_name=True,
        validate_by_alias=True,
        serialize_by_alias=True,
    )

    source: str | None = Field(default=None, description="where the numbers come from")

    _positional: ClassVar[tuple[str, ...]] = ()

    def __init_subclass__(cls, *, kw_only: bool = True, **settings: Any) -> None:
        super().__init_subclass__(**settings)

    @classmethod
    def __pydantic_init_subclass__(cls, *, kw_only: bool = True, **settings: Any) -> None:
        super().__pydantic_init_subclass__(**settings)
        if not kw_only:
            inherited = {name for base in cls.__bases__ for name in _fields(base)}
            own = (
                name
                for name, field in cls.model_fields.items()
                if name not in inherited and not field.kw_only
            )
            cls._positional = (*cls._positional, *own)
        cls.__signature__ = _signature(cls.model_fields, cls._positional)

    def __init__(self, *values: Any, **named: Any) -> None:
        """Make and check a definition.

        Raises
        ------
        InputError
            An invalid value, named by its field.
        """
        called = type(self).__name__
        if len(values) > len(self._positional):
            raise TypeError(
                f"{called}() takes {len(self._positional)} positional arguments, "
                f"{len(values)} were given"
            )
        for name, value in zip(self._positional, values, strict=False):
            if name in named:
                raise TypeError(f"{called}() got two values for argument {name!r}")
            named[name] = value
        try:
            self.__pydantic_validator__.validate_python(named, self_instance=self)
        except ValidationError as error:
            raise input_error(called, named, error, type(self), by_alias=False) from None

    # Lets pydantic make nested definitions itself, which keeps the path to a fault.
    __init__.__pydantic_base_init__ = True  # type: ignore[attr-defined]

    def __str__(self) -> str:
        return repr(self)

    def __eq__(self, other: object) -> bool:
        # By fields alone: pydantic would also compare cached properties, such as arrays.
        return type(self) is type(other) and all(
            getattr(self, name) == getattr(other, name) for name in _fields(type(self))
        )

    def __hash__(self) -> int:
        return hash((type(self), *(_hashable(getattr(self, name)) for name in _fields(type(self)))))

    def __repr_args__(self) -> Iterator[tuple[str, Any]]:
        """What differs from its default, positional arguments first."""
        fields = type(self).model_fields
        for name in sorted(fields, key=lambda name: name not in self._positional):
            value = getattr(self, name)
            if value != fields[name].default:
                yield name, _Brief(value)

    def replace(self, **changes: Any) -> Self:
        """A copy with some fields changed, checked like a new one.

        Parameters
        ----------
        **changes : object
            New values by field.

        Returns
        -------
        Definition

        Raises
        ------
        InputError
            An invalid value.
        """
        kept = {name: getattr(self, name) for name in self.model_fields_set}
        return type(self)(**(kept | changes))

    @property
    def content_hash(self) -> str:
        """SHA-256 of the definition; files count by their content, not by their path.

        Raises
        ------
        InputError
            A file that cannot be read.
        """
        text = json.dumps(_content(self), sort_keys=True, separators=(",", ":"))
        return hashlib.sha256(text.encode()).hexdigest()


_LONGEST = 160
"""Characters of a field in the ``repr`` of a definition."""


class _Brief:
    """A value whose ``repr`` is short and still distinguishes it from others."""

    def __init__(self, value: object) -> None:
        self._value = value

    def __repr__(self) -> str:
        if isinstance(self._value, Path):
            return f"<{self._value.name}>"
        text = repr(self._value)
        if len(text) <= _LONGEST:
            return text
        digest = hashlib.sha256(text.encode()).hexdigest()[:12]
        size = f"{len(self._value)} in " if isinstance(self._value, tuple | dict | str) else ""
        return f"<{size}{type(self._value).__name__}, SHA-256 {digest}>"


def _signature(fields: dict[str, FieldInfo], positional: tuple[str, ...]) -> inspect.Signature:
    """Signature of a definition; pydantic would use the names in files."""
    parameters: list[inspect.Parameter] = []
    needed = False  # a positional argument before one without a default has none itself
    for name in reversed(positional):
        needed = needed or fields[name].is_required()
        kind: Any = inspect.Parameter.POSITIONAL_OR_KEYWORD
        parameters.insert(0, _parameter(name, fields[name], kind, needed=needed))
    for name, field in fields.items():
        if name not in positional:
            kind = inspect.Parameter.KEYWORD_ONLY
            parameters.append(_parameter(name, field, kind, needed=field.is_required()))
    return inspect.Signature(parameters)


def _parameter(name: str, field: FieldInfo, kind: Any, *, needed: bool) -> inspect.Parameter:
    default = inspect.Parameter.empty if needed else field.get_default(call_default_factory=True)
    return inspect.Parameter(name, kind, default=default, annotation=field.annotation)


def _fields(base: type) -> dict[str, Any]:
    return base.model_fields if issubclass(base, BaseModel) else {}


def _hashable(value: Any) -> Any:
    if isinstance(value, dict):
        return frozenset((name, _hashable(item)) for name, item in value.items())
    return tuple(map(_hashable, value)) if isinstance(value, tuple | list) else value


def _content(value: Any) -> Any:
    """Plain data of a value, by the keys of files."""
    if isinstance(value, Definition):
        fields = type(value).model_fields
        return {
            field.serialization_alias or name: _content(getattr(value, name))
            for name, field in fields.items()
        }
    if isinstance(value, Path):
        return {"sha256": file_digest(value)}
    if isinstance(value, tuple | list):
        return [_content(item) for item in value]
    if isinstance(value, dict):
        return {str(name): _content(item) for name, item in value.items()}
    return value


def file_digest(path: Path) -> str:
    """SHA-256 of a file's bytes.

    Raises
    ------
    InputError
        An unreadable file.
    """
    check_file(path)
    try:
        with path.open("rb") as file:
            return hashlib.file_digest(file, "sha256").hexdigest()
    except OSError as error:
        reason = error.strerror or "unreadable"
        raise InputError(str(path), reason, "a readable file", "Check the path.") from None


def origin_of(path: Path) -> str:
    """Name and digest of a file, as an origin of data.

    Raises
    ------
    InputError
        An unreadable file.
    """
    return f"{path.name} (SHA-256 {file_digest(path)})"
