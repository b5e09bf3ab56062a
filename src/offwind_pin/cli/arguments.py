"""What the commands share: numbers on the command line, and errors that name the user's file."""

from __future__ import annotations

import functools
import re
from collections.abc import Callable
from pathlib import Path
from typing import Any, ParamSpec, TypeVar

import typer

from offwind_pin.base.errors import InputError, printable

P = ParamSpec("P")
R = TypeVar("R")


def number_option(text: str) -> Any:
    """An option for a decimal number, with its help."""
    return typer.Option(parser=_number, metavar="FLOAT", help=text)


def integer_option(text: str) -> Any:
    """An option for a whole number, with its help."""
    return typer.Option(parser=_integer, metavar="INTEGER", help=text)


def _number(text: str) -> float:
    from offwind_pin.base.number_tables import parse_number

    value = parse_number(text)
    if value is None:
        raise typer.BadParameter(f"{printable(text)!r} is no finite number")
    return value


def _integer(text: str | int) -> int:
    if re.fullmatch(r"[+-]?[0-9]{1,9}", str(text)) is None:
        raise typer.BadParameter(f"{printable(str(text))!r} is no whole number")
    return int(text)


def say(text: str, *, error: bool = False) -> None:
    """A line on standard output, or error; paths in it cannot steer the terminal."""
    typer.echo(printable(text), err=error)


def naming(argument: str) -> Callable[[Callable[P, R]], Callable[P, R]]:
    """Errors of a command name the file that this argument gives."""

    def decorate(command: Callable[P, R]) -> Callable[P, R]:
        @functools.wraps(command)
        def wrapper(*args: P.args, **kwargs: P.kwargs) -> R:
            try:
                return command(*args, **kwargs)
            except InputError as error:
                found = kwargs.get(argument)
                several = found if isinstance(found, list) else [found]
                given = str(several[0]) if len(several) == 1 else ""
                path = Path(given)
                if error.where.startswith("-") or path.name in error.where or not path.suffix:
                    raise
                raise error.within(given) from None

        return wrapper

    return decorate
