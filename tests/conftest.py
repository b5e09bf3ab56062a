"""The shipped turbine and its systems, made once."""

from typing import Any

import pytest

import offwind_pin as ow
from offwind_pin import cli


@pytest.fixture(scope="session")
def oc6() -> ow.Turbine:
    """The shipped benchmark turbine."""
    return ow.load_turbine("oc6_phase2")


@pytest.fixture(scope="session")
def undamped(oc6: ow.Turbine) -> ow.Turbine:
    """The same without structural damping, so that no calibration is run."""
    return oc6.model_copy(update={"structural_damping": None})


@pytest.fixture(scope="session")
def clamped_dry(oc6: ow.Turbine) -> ow.System:
    """LC 2.1: clamped at the mudline, no water."""
    return ow.build(oc6, "clamped")


@pytest.fixture(scope="session")
def coupled_wet(oc6: ow.Turbine) -> ow.System:
    """Coupled springs at the mudline in still water."""
    return ow.build(oc6, "coupled_springs", ow.StillWater())


@pytest.fixture(scope="session")
def distributed_wet(oc6: ow.Turbine) -> ow.System:
    """Distributed surrogate springs in still water."""
    return ow.build(oc6, "distributed_springs", ow.StillWater())


@pytest.fixture(scope="session")
def coarse(oc6: ow.Turbine) -> ow.System:
    """Few elements, everything acting: soil with dashpots, structural damping, waves."""
    waves = ow.IrregularWaves(2.0, 6.0, seed=3, repeat_period=60.0)
    return ow.build(oc6, "distributed_springs", waves, elements=8)


@pytest.fixture
def offwind(monkeypatch: pytest.MonkeyPatch, capsys: Any) -> Any:
    """Run the command; returns exit code, standard output and standard error."""

    def run(*argv: str) -> tuple[int, str, str]:
        monkeypatch.setattr("sys.argv", ["offwind", *argv])
        with pytest.raises(SystemExit) as stop:
            cli.main()
        streams = capsys.readouterr()
        return int(stop.value.code or 0), streams.out, streams.err

    return run
