"""The page on extending runs as printed, and what it prints is what closed forms give."""

from __future__ import annotations

import runpy
from pathlib import Path
from typing import Any
from unittest.mock import patch

import numpy as np
import pytest
from helpers.doc_pages import ROOT, blocks

import offwind_pin as ow
from offwind_pin.analysis.foundation.registry import FOUNDATIONS
from offwind_pin.display.wording import supported_on

PAGE = ROOT / "docs" / "extending.md"
EXAMPLES = [block.text for block in blocks(PAGE) if block.language == "python"]


def run(name: str, tmp_path: Path) -> dict[str, Any]:
    """The variables of the one example that defines a class of that name."""
    (code,) = (text for text in EXAMPLES if f"class {name}(" in text)
    file = tmp_path / "example.py"
    file.write_text(code, encoding="utf-8")
    return runpy.run_path(str(file))


def printed(capsys: pytest.CaptureFixture[str]) -> list[float]:
    return [float(line) for line in capsys.readouterr().out.split()]


def test_load(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """Springs in parallel: the guy wire adds its stiffness to the tower's."""
    found = run("GuyWire", tmp_path)
    assert printed(capsys) == pytest.approx([5e5], rel=2e-3)
    assert found["tower"] > 5e5


def test_foundation(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """Sway and rocking are the loads at the mudline over the springs' stiffness."""
    with patch.dict(FOUNDATIONS):
        run("Springs", tmp_path)
        case = {"name": "own", "turbine": "oc6_phase2", "foundation": "gravity_base"}
        case |= {"sea": {"kind": "dry"}, "analysis": {"kind": "static"}}
        assert ow.Case.model_validate(case).build().foundation.root is not None
        assert supported_on("gravity_base") == "on a gravity base"
    assert printed(capsys) == pytest.approx([1e5, 1.0], rel=1e-6)
    with pytest.raises(ValueError, match="gravity_base"):  # negative control
        ow.Case.model_validate(case)


def test_soil_law(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """The formula at a point; far below the ultimate resistance nothing but the initial stiffness."""
    found = run("Hyperbola", tmp_path)
    assert printed(capsys) == pytest.approx([2e6, 1.0], rel=1e-6)
    assert found["weak"] > 1.01 * found["straight"]


def test_wave_model(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """The surface is a cosine, and in deep water the loads are those of linear theory."""
    found = run("DeepWaterWaves", tmp_path)
    surface, moment = printed(capsys)
    assert surface < 1e-6
    size = float(abs(found["linear"].mudline_moment).max()) / 1e6
    assert moment < 1e-6 * size
    field = found["DeepWaterWaves"](0.1, 2.0).waves(50.0, 9.81)
    speed = abs(field.velocity(np.array([0.0, -5.0]))[0, :, 0])
    assert speed == pytest.approx(0.1 * np.pi * np.exp([0.0, -5 * np.pi**2 / 9.81]))


def test_integrator(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """Average acceleration is generalised-alpha without numerical damping; with it there is more."""
    found = run("AverageAcceleration", tmp_path)
    assert printed(capsys)[0] < 1e-7
    size = float(abs(found["expected"]).max())
    assert float(abs(found["damped"] - found["expected"]).max()) > 1e-4 * size


def test_integrator_is_resumed_and_fails_like_any(tmp_path: Path) -> None:
    """A stopped run goes on to bitwise the same; a step that fails ends with what came before."""
    found = run("AverageAcceleration", tmp_path)
    system = found["system"]

    class Stops(found["AverageAcceleration"]):  # type: ignore[misc]
        """Fails at a time, until it is mended."""

        fails_at = 30.0

        def step(self, chain: Any, time_inputs: Any, *state: Any) -> Any:
            if time_inputs[0] > self.fails_at:
                raise ow.StepFailed("as requested", time_inputs[0], state[1])
            return super().step(chain, time_inputs, *state)

    def simulate(folder: str, method: ow.Integrator) -> Any:
        settings = {"integrator": method, "save_at": ow.SaveAt(0.5, heights=[0.0])}
        return ow.simulate(system, 32.0, directory=tmp_path / folder, **settings).load()

    method = Stops()
    with pytest.raises(ow.SolverError, match="as requested") as failed:
        simulate("stopped", method)
    assert failed.value.time == pytest.approx(30.02)
    assert failed.value.results["time"][-1] == 30.0
    failed.value.results.close()
    method.fails_at = 99.0
    assert simulate("stopped", method).identical(simulate("whole", method))


def test_step_policy(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """Five steps to each interval of 0.2 s."""
    found = run("EqualSteps", tmp_path)
    assert printed(capsys) == pytest.approx([0.04], rel=1e-12)
    assert found["history"].attrs["step_policy"] == "equal steps"


def test_every_example_is_run() -> None:
    assert len(EXAMPLES) == 6
