"""What the page on the pile shows works as printed, in its order."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

import pytest

from offwind_pin.formats.openfast.subdyn_soildyn import read_soildyn, read_subdyn_ssi

PAGE = Path(__file__).resolve().parents[2] / "docs" / "pile.md"


def test_examples(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: Any) -> None:
    monkeypatch.chdir(tmp_path)
    scope: dict[str, Any] = {}
    for block in re.findall(r"```python\n(.*?)```", PAGE.read_text(), flags=re.DOTALL):
        exec(block, scope)  # our own text
    printed = capsys.readouterr().out.splitlines()
    assert float(printed[0].split()[1]) == pytest.approx(0.9)
    tangent, secant, defect = map(float, printed[1].split())
    assert 0.9 * secant < tangent < secant
    assert 0 < defect < 0.01
    assert float(printed[2]) < 1e-6
    assert "initial_modulus.gradient = " in printed[3]
    assert (read_subdyn_ssi(tmp_path / "out" / "ssi.dat")[0] == scope["tangent"].symmetric).all()
    assert read_soildyn(tmp_path / "out" / "soildyn.dat").location[2] == -30.0
