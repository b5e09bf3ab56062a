"""What the page on modes out of accelerations shows works as printed."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from helpers.white_noise import ModalSystem
from numpy.testing import assert_allclose

PAGE = Path(__file__).resolve().parents[2] / "docs" / "frequency_domain_decomposition.md"


def test_example(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: Any) -> None:
    """The lines run on a record with the header that the page shows."""
    text = PAGE.read_text()
    header = re.findall(r"```csv\n(.*?)\n", text)[0]
    height = np.array([21.0, 43.0, 65.0, 87.0, 87.0]) / 87.0
    shape = np.array([height**2, np.sin(1.4 * np.pi * height)])
    shape[:, 4] = [0.1, 0.0]
    system = ModalSystem(np.array([0.3, 1.1]), np.array([0.02, 0.02]), shape)
    values = system.accelerations(np.diag([0.1, 1.0]), 0.05, 80_000, seed=3)
    table = np.column_stack([0.05 * np.arange(len(values)), values])
    file = tmp_path / "measured.csv"
    np.savetxt(file, table, delimiter=",", header=header, comments="", fmt="%.10g")
    monkeypatch.chdir(tmp_path)
    scope: dict[str, Any] = {}
    exec(re.findall(r"```python\n(.*?)```", text, flags=re.DOTALL)[0], scope)  # our own text
    found = scope["found"]
    assert found.names == ("z21_x", "z43_x", "z65_x", "z87_x")
    assert_allclose(found.frequency_hz, [0.3, 1.1], rtol=0.01)
    assert_allclose(found.damping_ratio, [0.02, 0.02], atol=0.006)
    printed = capsys.readouterr().out
    assert "[[1." in printed
    for caution in found.cautions:
        assert caution in printed
