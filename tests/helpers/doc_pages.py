"""Pages of the docs as a reader follows them: files are saved, commands run, printed lines compared."""

from __future__ import annotations

import re
import shlex
from collections.abc import Callable
from pathlib import Path
from typing import NamedTuple

ROOT = Path(__file__).resolve().parents[2]

_BLOCK = re.compile(r"^([^\n]*)\n\n?```(\w+)\n(.*?)^```$", flags=re.DOTALL | re.MULTILINE)
_NAMED = re.compile(r"`([\w.]+\.\w+)`[^`]*:$")
_FRAME = str.maketrans("│┃", "  ")


class Block(NamedTuple):
    """A fenced block: name of the file that it is saved as, if any; its language, and its text."""

    file: str | None
    language: str
    text: str


def blocks(page: Path) -> list[Block]:
    """Fenced blocks of a page in order. One is a file where the line before it ends "`name`:"."""
    found = []
    for before, language, text in _BLOCK.findall(page.read_text()):
        named = _NAMED.search(before)
        found.append(Block(named[1] if named else None, language, text))
    return found


def follow(page: Path, folder: Path, run: Callable[[list[str]], str]) -> list[str]:
    """Do what a page says in a folder; returns the commands that were run.

    Every block must be a file to be saved, commands (``console``), or right after those what they
    print (``text``).
    run : a command's words to its standard output
    """
    commands: list[str] = []
    printed: str | None = None
    for block in blocks(page):
        if block.file is not None:
            (folder / block.file).write_text(block.text)
            printed = None
        elif block.language == "console":
            lines = block.text.strip().splitlines()
            printed = "\n".join(run(shlex.split(line)) for line in lines)
            commands += lines
        else:
            assert block.language == "text", f"{page.name}: a block that nothing runs: {block.text}"
            assert printed is not None, f"{page.name}: printed by no command: {block.text}"
            compare(block.text, printed)
            printed = None
    return commands


def compare(shown: str, printed: str) -> None:
    """Every line of what a page shows is part of a printed line, in the same order."""
    rest = [plain(line) for line in printed.splitlines()]
    for line in shown.strip().splitlines():
        places = [i for i, candidate in enumerate(rest) if plain(line) in candidate]
        assert places, f"not printed: {plain(line)}\n" + "\n".join(rest)
        rest = rest[places[0] + 1 :]


def plain(line: str) -> str:
    """A line without a table's frame, and with single blanks."""
    return " ".join(line.translate(_FRAME).split())
