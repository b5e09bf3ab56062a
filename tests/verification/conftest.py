"""The shipped load cases, each run once for all tests."""

import json
from collections.abc import Callable
from functools import cache
from pathlib import Path
from typing import Any

import pytest

from offwind_pin.cases.case import load_case
from offwind_pin.cases.run import run_case

Shipped = Callable[[str], tuple[dict[str, Any], Path]]


@pytest.fixture(scope="session")
def shipped(tmp_path_factory: pytest.TempPathFactory) -> Shipped:
    """Summary and folder of a shipped load case, run as a user runs it."""

    @cache
    def run(name: str) -> tuple[dict[str, Any], Path]:
        out = tmp_path_factory.mktemp(name)
        run_case(load_case(name), out)
        return json.loads((out / "summary.json").read_text()), out

    return run
