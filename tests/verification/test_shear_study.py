"""The study of what shear changes gives the numbers that the limits name."""

import importlib.util
from pathlib import Path

import pytest

SCRIPT = Path(__file__).parents[2] / "sim" / "shear.py"


def test_what_shear_changes() -> None:
    """About 1 % of the second modes on a clamp; twice that where the pile bends in the soil."""
    spec = importlib.util.spec_from_file_location("shear", SCRIPT)
    assert spec is not None
    assert spec.loader is not None
    study = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(study)
    table = study.main()
    change = {
        (case, name): 100 * (values["timoshenko"] / values["euler_bernoulli"] - 1)
        for case, rows in table.items()
        for name, values in rows.items()
    }
    assert change["clamped, dry", "FA2"] == pytest.approx(-1.2, abs=0.1)
    assert change["clamped, dry", "SS2"] == pytest.approx(-0.9, abs=0.1)
    assert change["distributed springs, still water", "FA1"] == pytest.approx(-1.2, abs=0.1)
    assert change["distributed springs, still water", "FA2"] == pytest.approx(-2.0, abs=0.1)
    assert change["distributed springs, still water", "lean"] == pytest.approx(0.8, abs=0.1)
    assert abs(change["coupled springs, still water", "T1"]) < 0.1
