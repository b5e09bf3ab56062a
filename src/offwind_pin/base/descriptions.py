"""Descriptions of objects: on one line, and as tables in notebooks."""

from __future__ import annotations

import html
from collections.abc import Iterable, Sequence
from dataclasses import MISSING, fields
from typing import Any

LONGEST = 240
"""Characters of a description on one line."""
_LONGEST_PART = 80
_FEW = 4


def one_line(thing: Any) -> str:
    """A dataclass on one line: ``Name(field=value, ...)``.

    Fields with default values are omitted. Arrays are given by their shape, long sequences by their
    number of items, and other long values by their class.
    """
    parts = [
        f"{item.name}={_brief(value)}"
        for item in fields(thing)
        if item.repr and not _is_default(value := getattr(thing, item.name), item.default)
    ]
    return cut(f"{type(thing).__name__}({', '.join(parts)})")


def cut(text: str, longest: int = LONGEST) -> str:
    """A text, truncated if it is too long."""
    return text if len(text) <= longest else f"{text[: longest - 4]}...{text[-1]}"


def html_table(title: str, columns: Sequence[str], rows: Iterable[Sequence[object]]) -> str:
    """A plain HTML table; every text is escaped.

    Parameters
    ----------
    columns : sequence of str
        Headings; empty if the first cell of each row names the row.
    """
    head = "".join(f"<th>{html.escape(column)}</th>" for column in columns)
    body = "".join(
        "<tr>" + "".join(f"<td>{html.escape(str(cell))}</td>" for cell in row) + "</tr>"
        for row in rows
    )
    top = f"<thead><tr>{head}</tr></thead>" if columns else ""
    return f"<table><caption>{html.escape(title)}</caption>{top}<tbody>{body}</tbody></table>"


def _is_default(value: Any, default: Any) -> bool:
    if default is MISSING or hasattr(value, "shape"):
        return False
    return value is default or bool(type(value) is type(default) and value == default)


def _brief(value: Any) -> str:
    shape = getattr(value, "shape", ())
    if shape:
        return f"<{' x '.join(map(str, shape))} {type(value).__name__}>"
    if hasattr(value, "item"):
        return repr(value.item())
    if isinstance(value, str):
        return cut(repr(value), _LONGEST_PART)
    if isinstance(value, tuple | list | dict) and len(value) > _FEW:
        return f"<{len(value)} items>"
    text = repr(value)
    simple = isinstance(value, int | float | type(None))
    return text if simple or len(text) <= _LONGEST_PART else f"{type(value).__name__}(...)"
