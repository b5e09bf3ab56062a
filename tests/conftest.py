"""The shipped turbine and its systems, made once; random tests draw from seeds."""

import logging
import os
from collections.abc import Iterator
from typing import Any

import pytest
from hypothesis import settings

import offwind_pin as ow
from offwind_pin import cli

# Results must not depend on the user's terminal, display or Matplotlib settings. Compiled kernels
# stay in the user's cache.
_PERSONAL = ("BROWSER", "DISPLAY", "WAYLAND_DISPLAY", "COLUMNS", "LINES", "CLICOLOR_FORCE")
_COLOUR = ("FORCE_COLOR", "NO_COLOR", "PY_COLORS", "GITHUB_ACTIONS")
for _name in (*_PERSONAL, *_COLOUR):
    os.environ.pop(_name, None)
os.environ |= {"MATPLOTLIBRC": os.devnull, "MPLBACKEND": "agg"}

# The same examples on every machine; `make soak` draws others, from its own seeds.
settings.register_profile("repeatable", derandomize=True, deadline=None, database=None)
settings.register_profile("soak", deadline=None, database=None, print_blob=True)
settings.load_profile("repeatable")


def pytest_addoption(parser: pytest.Parser) -> None:
    parser.addoption(
        "--campaign-seed", type=int, default=1, help="of the tests marked seeded (default: 1)"
    )


LONGEST = (
    "verification/test_ledger.py",
    "benchmarks/test_pure_python.py",
)
"""Files that begin first, so that no worker is left with a long one at the end. The second compiles
hardly anything, while the first compiles what most of the others need."""

TOGETHER = {"verification/test_load_cases.py": "verification/test_ledger.py"}
"""Files that share what another one has run, and go to the same worker."""


def _file(nodeid: str) -> str:
    """Of a test, from the folder of the tests."""
    return nodeid.partition("::")[0].removeprefix("tests/")


def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    places = {file: place for place, file in enumerate(LONGEST)}
    items.sort(key=lambda item: places.get(_file(item.nodeid), len(places)))


@pytest.hookimpl(optionalhook=True)
def pytest_xdist_make_scheduler(config: pytest.Config, log: Any) -> Any:
    """Whole files to a worker, in the order of the collection, those that share runs together."""
    if config.getoption("dist") != "loadfile":
        return None
    from xdist.scheduler import LoadFileScheduling

    class Scheduling(LoadFileScheduling):
        def _split_scope(self, nodeid: str) -> str:
            file = _file(nodeid)
            return TOGETHER.get(file, file)

    config.option.loadscopereorder = False
    return Scheduling(config, log)


@pytest.fixture(scope="session")
def campaign_seed(pytestconfig: pytest.Config) -> int:
    """From which a test marked ``seeded`` draws."""
    return int(pytestconfig.getoption("--campaign-seed"))


@pytest.fixture(autouse=True)
def _log_level() -> Iterator[None]:
    """Commands set it for their process; a later test must not depend on whether one ran."""
    logger = logging.getLogger("offwind_pin")
    before = logger.level
    yield
    logger.setLevel(before)


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
