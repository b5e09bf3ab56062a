"""What loads say of themselves: fingerprints, channels, attributes, means, the ground."""

from collections.abc import Callable
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
import pytest
from helpers.own_loads import HardeningRestraint
from numpy.typing import NDArray

import offwind_pin as ow
from offwind_pin.base.fingerprint import NoFingerprintError, content_hash
from offwind_pin.definitions.rotor_disc import rotor_disc
from offwind_pin.loads.point_load import (
    PointForces,
    PointLoad,
    PointMotion,
    PointTangents,
)
from offwind_pin.loads.tower_top.load_history import constant_load
from offwind_pin.loads.wind.history import constant_wind
from offwind_pin.loads.wind.rotor_thrust import RotorThrust

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Thruster(PointLoad):
    """A pull along x that is switched on smoothly; its channel is what it pulls with."""

    yaw_bearing: float
    pull: float = 2e5
    law: object = None
    name: str = "thruster"

    @property
    def height(self) -> Array:
        return np.array([self.yaw_bearing])

    def forces(self, time: float, motion: PointMotion, ramp_factor: float) -> PointForces:
        size = self.pull * (1 + ramp_factor * np.sin(time))
        return PointForces(np.array([[size, 0.0, 0.0]]), np.zeros((1, 3)))

    def tangents(self, time: float, motion: PointMotion, ramp_factor: float) -> PointTangents:
        return PointTangents.zeros(1)

    @property
    def channels(self) -> tuple[ow.Channel, ...]:
        return (ow.Channel("thruster_pull", (), "N", "pull of the thrusters"),)

    def outputs(self, time: Array, ramp_factor: Array) -> dict[str, Array]:
        return {"thruster_pull": self.pull * (1 + ramp_factor * np.sin(time))}

    def attributes(self) -> dict[str, str]:
        return {"thruster": f"{self.pull:g} N"}

    @property
    def surrogate(self) -> str | None:
        return "invented"


class Named(Thruster):
    """Says by itself what counts."""

    def fingerprint(self) -> str:
        return content_hash(self.pull)


@pytest.fixture(scope="module")
def system(undamped: ow.Turbine) -> ow.System:
    return ow.build(undamped, "clamped", elements=4)


def test_a_load_adds_channels_and_attributes(system: ow.System) -> None:
    """Two loads of one channel are summed; units, attributes and surrogate reach the dataset."""
    top = system.chain.top
    loads = [Thruster(top), Thruster(top, 5e4, name="second")]
    data = ow.simulate(system, 1.0, 0.05, loads)
    time = data["time"].to_numpy()
    assert data["thruster_pull"].to_numpy() == pytest.approx(2.5e5 * (1 + np.sin(time)), rel=1e-14)
    assert data["thruster_pull"].attrs["units"] == "N"
    assert data.attrs["thruster"] == "200000 N; 50000 N"
    assert data.attrs["surrogates"].split(" | ").count("invented") == 2
    assert not data["tower_top_load"].any()


def test_statics_and_modes_see_means(system: ow.System) -> None:
    """A load written in Python is asked with a ramp factor of zero, whatever it does in time."""
    own = ow.static(system, loads=[Thruster(system.chain.top)])
    plain = ow.static(system, np.array([2e5, 0, 0, 0, 0, 0]))
    assert own.tower_top_displacement == pytest.approx(plain.tower_top_displacement, rel=1e-12)


def test_what_is_no_load_is_refused(system: ow.System) -> None:
    """Something that only looks like a load does not know what is asked of it in time."""

    class Lookalike:
        name, height = "lookalike", np.array([0.0])
        forces, tangents = Thruster.forces, Thruster.tangents

    with pytest.raises(ow.InputError, match="PointLoad"):
        ow.static(system, loads=[Lookalike()])  # type: ignore[list-item]


def histories(last: float) -> ow.LoadHistory:
    load = np.zeros((3, 6))
    load[2, 0] = last
    return ow.LoadHistory(np.arange(3.0), load, "test")


PAIRS: dict[str, Callable[[ow.Turbine, float], PointLoad]] = {
    "history": lambda turbine, x: histories(x).acting(turbine.yaw_bearing, 0.0, 2.0),
    "constant": lambda turbine, x: constant_load(turbine.yaw_bearing, np.full(6, x)),
    "own": lambda turbine, x: Thruster(turbine.yaw_bearing, x),
    "rotor": lambda turbine, x: RotorThrust(rotor_disc(turbine), constant_wind(9 * x)),
}


@pytest.mark.parametrize("name", PAIRS)
def test_fingerprint_is_of_the_content(oc6: ow.Turbine, name: str) -> None:
    """Equal for loads made twice of equal numbers, another one after the last digit has changed."""
    make = PAIRS[name]
    assert make(oc6, 1.0).fingerprint() == make(oc6, 1.0).fingerprint()
    assert make(oc6, 1.0).fingerprint() != make(oc6, float(np.nextafter(1.0, 2.0))).fingerprint()


def test_fingerprints_of_a_system(oc6: ow.Turbine) -> None:
    """Water and soil made twice are the same; another seed, dashpot or curve is not."""

    def found(sea: ow.IrregularWaves, factor: float = 1.0) -> list[str]:
        springs = oc6.soil.distributed_springs
        assert springs is not None
        soil = oc6.soil.model_copy(
            update={
                "distributed_springs": springs.model_copy(
                    update={"nodes": round(factor * springs.nodes)}
                )
            }
        )
        turbine = oc6.model_copy(update={"soil": soil, "structural_damping": None})
        built = ow.build(turbine, "distributed_springs", sea, elements=6)
        assert built.hydrodynamics is not None
        loads = [*built.hydrodynamics.loads(), *built.foundation.soil]
        return [load.fingerprint() for load in loads]

    sea = ow.IrregularWaves(2.0, 6.0, seed=3, repeat_period=60.0)
    first = found(sea)
    assert found(sea) == first
    assert len(set(first)) == len(first)
    reseeded = found(sea.replace(seed=4))
    assert reseeded[0] == first[0]  # added mass in still water
    assert reseeded[1] != first[1]
    assert found(sea, 0.5)[-1] != first[-1]


def test_what_cannot_be_hashed_is_no_fingerprint() -> None:
    """A function, a generator or an open file is not content; the class can say what counts."""
    with Path(__file__).open() as file:
        for thing in (np.sin, (i for i in range(3)), file):
            with pytest.raises(NoFingerprintError):
                Thruster(90.0, law=thing).fingerprint()
    assert Named(90.0, law=np.sin).fingerprint() == Named(80.0).fingerprint()
    assert Named(90.0, 1.0).fingerprint() != Named(90.0, 2.0).fingerprint()


def test_fingerprint_of_a_file_is_of_its_bytes(tmp_path: Path) -> None:
    """Two copies are the same, a changed byte is not."""
    for name, text in (("a", "1,2"), ("b", "1,2"), ("c", "1,3")):
        (tmp_path / name).write_text(text)
    a, b, c = (content_hash(tmp_path / name) for name in "abc")
    assert a == b != c


def test_fingerprint_of_a_root_restraint() -> None:
    """That of its numbers, and of the source of a class from outside the package."""
    root = HardeningRestraint(np.ones(6), np.zeros(6))
    assert root.fingerprint() == replace(root).fingerprint()
    assert root.fingerprint() != replace(root, scale=0.02).fingerprint()
