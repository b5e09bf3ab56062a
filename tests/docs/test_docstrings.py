"""Docstrings of public objects in numpydoc's form, and in agreement with the signatures."""

from __future__ import annotations

import functools
import inspect
import re
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any, Literal, get_args, get_origin

import pytest

import offwind_pin as ow

NAMESPACES = (ow, ow.plots, ow.sea, ow.signal, ow.soil, ow.viewer, ow.wind)

SECTIONS = {"Parameters", "Attributes", "Returns", "Yields", "Raises", "Notes", "References"}
TYPE = re.compile(
    r"(int|float|complex|str|bytes|bool|None|list|tuple|dict|set|callable|sequence|iterator"
    r"|iterable|mapping|object|type|module|array|array_like)\b"
    r"|\([^()]*\) (or \([^()]*\) )?((bool|int|complex) )?(array|array_like|tuple|sequence)\b"
    r"|\(\w+(, \w+)*\)"  # a tuple, such as (float, float)
    r"|\{.+\}"  # a choice, such as {"none", "vertical"}
    r"|[A-Z]\w+"  # a class
)
"""What the text after ``name :`` begins with."""


def test_public_docstrings() -> None:
    faults = {f"{public.name}: {fault}" for public in all_public() for fault in public.faults()}
    assert sorted(faults) == []


def test_the_walk_finds_functions_methods_and_properties() -> None:
    names = {public.name for public in all_public()}
    assert {
        "offwind_pin.simulate",
        "offwind_pin.ModalResult",
        "offwind_pin.ModalResult.to_dataframe",
        "offwind_pin.StaticResult.mudline_load",
        "offwind_pin.GroundMotion.corrected",
        "offwind_pin.sea.LinearWaves.free",
        "offwind_pin.viewer.serve",
        "offwind_pin.plots.psd",
    } <= names


class Beam:
    """A beam.

    Attributes
    ----------
    length : float, m
    stiffness, mass : (n,) array
        Of each section.
    """

    def __init__(self, length: float, stiffness: Any, mass: Any) -> None:
        pass

    def good(self, load: float) -> float:
        """Deflection.

        Parameters
        ----------
        load : float, N

        Returns
        -------
        float, m
        """
        return load

    def missing(self, load: float, span: float) -> None:
        """Deflect.

        Parameters
        ----------
        load : float, N
        """

    def unknown(self) -> None:
        """Deflect.

        Parameters
        ----------
        load : float, N
        """

    def untyped(self, load: float) -> None:
        """Deflect.

        Parameters
        ----------
        load : in N
        """

    def silent(self) -> float:
        """Deflect."""
        return 0.0

    def loose(self) -> float:
        """Deflect.

        Returns
        -------
        the deflection in m
        """
        return 0.0

    def misspelt(self) -> None:
        """Deflect.

        Parameter
        ---------
        """

    def bare(self) -> None: ...

    @property
    def naked(self) -> float:
        return 0.0


@pytest.mark.parametrize(
    ("method", "fault"),
    [
        ("good", []),
        ("missing", ["span is not described"]),
        ("unknown", ["load is no parameter"]),
        ("untyped", ["no type in 'load : in N'"]),
        ("silent", ["no section Returns"]),
        ("loose", ["no type in 'the deflection in m'"]),
        ("misspelt", ["unknown section 'Parameter'"]),
        ("bare", ["no docstring"]),
        ("naked", ["no docstring"]),
    ],
)
def test_faults_are_found(method: str, fault: list[str]) -> None:
    assert Public("Beam", vars(Beam)[method], Beam).faults() == fault


def test_attributes_describe_the_arguments_of_a_class() -> None:
    assert Public("Beam", Beam).faults() == []

    class Longer(Beam):
        """A longer beam."""

        def __init__(self, length: float, stiffness: Any, mass: Any, more: float) -> None:
            pass

    assert Public("Longer", Longer).faults() == ["more is not described"]


@dataclass
class Public:
    """A public function or class, or a member of a class."""

    name: str
    raw: Any
    owner: type | None = None

    @property
    def function(self) -> Any:
        """What is called, without the decorator that binds it."""
        if isinstance(self.raw, property):
            return self.raw.fget
        if isinstance(self.raw, functools.cached_property):
            return self.raw.func
        return getattr(self.raw, "__func__", self.raw)

    @property
    def docstring(self) -> str:
        """Its own, or that of the method that it overrides."""
        found = inspect.getdoc(self.function)
        for base in self.owner.__mro__ if self.owner and not found else ():
            overridden = vars(base).get(self.function.__name__)
            found = found or inspect.getdoc(Public("", overridden).function)
        return found or ""

    @property
    def parameters(self) -> dict[str, Any] | None:
        """Those of the signature, or None where there is none to compare with."""
        if inspect.isclass(self.raw):
            made = inspect.isfunction(self.raw.__init__) or hasattr(self.raw, "_fields")
            if not made or getattr(self.raw, "_is_protocol", False):
                return None
        elif self.function is not self.raw and not hasattr(self.raw, "__func__"):
            return None  # a property
        return {
            name: parameter
            for name, parameter in inspect.signature(self.function).parameters.items()
            if name not in {"self", "cls"} and not _is_constant(parameter)
        }

    def faults(self) -> list[str]:
        if not self.docstring:
            return ["no docstring"]
        parts = sections(self.docstring)
        found = [f"unknown section {name!r}" for name in parts if name and name not in SECTIONS]
        for section in ("Parameters", "Attributes", "Returns", "Yields"):
            for line in entries(parts.get(section, [])):
                kind = line.partition(" : ")[2]
                if not kind and section in {"Returns", "Yields"}:
                    kind = line
                if not TYPE.match(kind):
                    found.append(f"no type in {line!r}")
        if self.parameters is None:
            return found
        own = names(parts.get("Parameters", []))
        described = set(own)
        if inspect.isclass(self.raw):
            for base in self.raw.__mro__:
                inherited = sections(inspect.cleandoc(vars(base).get("__doc__") or ""))
                described |= names(inherited.get("Attributes", []))
                described |= names(inherited.get("Parameters", []))
        elif inspect.signature(self.function).return_annotation not in {"None", None}:
            found += [] if {"Returns", "Yields"} & set(parts) else ["no section Returns"]
        found += [f"{name} is not described" for name in self.parameters if name not in described]
        found += [f"{name} is no parameter" for name in sorted(own - set(self.parameters))]
        return found


def _is_constant(parameter: inspect.Parameter) -> bool:
    """Whether it has one value only, by which files tell one class from another."""
    return get_origin(parameter.annotation) is Literal and len(get_args(parameter.annotation)) == 1


def all_public() -> Iterator[Public]:
    """Functions and classes of the public namespaces, and public members of the classes."""
    seen: set[int] = set()
    for space in NAMESPACES:
        for name in getattr(space, "__all__", vars(space)):
            found = getattr(space, name)
            home = getattr(found, "__module__", "")
            if name.startswith("_") or not home.startswith("offwind_pin") or id(found) in seen:
                continue
            seen.add(id(found))
            yield Public(f"{space.__name__}.{name}", found)
            if inspect.isclass(found):
                yield from _members(f"{space.__name__}.{name}", found)


def _members(name: str, owner: type) -> Iterator[Public]:
    for member in dir(owner):
        base = next(base for base in owner.__mro__ if member in vars(base))
        raw = vars(base)[member]
        public = Public(f"{name}.{member}", raw, owner)
        ours = base.__module__.startswith("offwind_pin") and not member.startswith("_")
        if ours and inspect.isfunction(public.function):
            yield public


def sections(text: str) -> dict[str, list[str]]:
    """Lines by section; those before the first are in section ``""``."""
    lines = text.splitlines()
    found: dict[str, list[str]] = {"": []}
    section = ""
    for line, following in zip(lines, [*lines[1:], ""], strict=True):
        if re.fullmatch("-{3,}", following):
            section = line
            found[section] = []
        elif not re.fullmatch("-{3,}", line):
            found[section].append(line)
    return found


def entries(lines: list[str]) -> list[str]:
    """First lines of the entries of a section."""
    return [line for line in lines if line and not line.startswith(" ")]


def names(lines: list[str]) -> set[str]:
    """Names described in a section; ``a, b : float`` describes two."""
    heads = [line.partition(" : ")[0] for line in entries(lines)]
    return {name.lstrip("*") for head in heads for name in head.split(", ")}
