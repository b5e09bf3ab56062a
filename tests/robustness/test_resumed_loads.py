"""A stopped run goes on only under the loads, and with the program, that it was begun with."""

from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
import pytest
from helpers.own_loads import AtTop
from numpy.typing import NDArray

import offwind_pin as ow
from offwind_pin.analysis import simulate as module
from offwind_pin.base.fingerprint import content_hash
from offwind_pin.loads.point_load import PointForces, PointMotion
from offwind_pin.results.manifest import environment

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Pull(AtTop):
    """A pull that swings; any function may be among its attributes."""

    size: float = 1e5
    shape: object = None

    def forces(self, time: float, motion: PointMotion, ramp_factor: float) -> PointForces:
        return PointForces(np.array([[self.size * np.sin(time), 0, 0]]), np.zeros((1, 3)))


class Described(Pull):
    """Says by itself what counts."""

    def fingerprint(self) -> str:
        return content_hash(self.size)


@pytest.fixture(scope="module")
def system(undamped: ow.Turbine) -> ow.System:
    return ow.build(undamped, "clamped", elements=3)


def run(system: ow.System, directory: Path, load: Pull, *, stop: bool = False) -> None:
    def progress(time: float) -> None:
        if stop and time >= 20.0:
            raise KeyboardInterrupt

    ow.simulate(
        system, 40.0, 0.1, [load], save_at=ow.SaveAt(1.0), directory=directory, progress=progress
    ).close()


def stopped(system: ow.System, directory: Path, load: Pull) -> None:
    with pytest.raises(ow.InterruptedSimulation) as error:
        run(system, directory, load, stop=True)
    error.value.results.close()


def test_the_same_load_goes_on(system: ow.System, tmp_path: Path) -> None:
    """Another object of the same class and numbers is the same load."""
    stopped(system, tmp_path, Pull(system.chain.top))
    run(system, tmp_path, Pull(system.chain.top))
    assert (tmp_path / "results.nc").is_file()


def test_a_changed_load_is_refused(system: ow.System, tmp_path: Path) -> None:
    """By its last digit; so is a class whose code is another."""
    load = Pull(system.chain.top)
    stopped(system, tmp_path, load)
    for other in (replace(load, size=float(np.nextafter(1e5, 2e5))), Described(system.chain.top)):
        with pytest.raises(ow.InputError, match=r"other load 1 own\)"):
            run(system, tmp_path, other)


def test_another_version_is_refused(
    system: ow.System, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Results of two versions of the package would not be one run's."""
    load = Pull(system.chain.top)
    stopped(system, tmp_path, load)
    for program in ("offwind_pin", "offwind_pin_sources", "numpy"):
        newer = environment() | {program: "99.0"}
        with monkeypatch.context() as patch:
            patch.setattr(module, "environment", lambda newer=newer: newer)
            with pytest.raises(ow.InputError, match=rf"\(other {program}\)"):
                run(system, tmp_path, load)
    run(system, tmp_path, load)


def test_a_load_that_cannot_be_compared_is_not_resumed(system: ow.System, tmp_path: Path) -> None:
    """It runs, and says on going on what is missing; a fingerprint of its own mends it."""
    load = Pull(system.chain.top, shape=np.sin)
    stopped(system, tmp_path / "unknown", load)
    with pytest.raises(ow.InputError, match=r"load 1 own.*fingerprint"):
        run(system, tmp_path / "unknown", load)
    run(system, tmp_path / "new", load)
    described = Described(system.chain.top, shape=np.sin)
    stopped(system, tmp_path / "known", described)
    run(system, tmp_path / "known", described)
