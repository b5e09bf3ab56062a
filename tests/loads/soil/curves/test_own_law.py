"""A law of soil curves from outside the package, among shipped ones in layered ground."""

import inspect
from collections.abc import Iterator

import numpy as np
import pytest
from helpers.own_soil import ChordFamily, HyperbolicCurves, HyperbolicFamily, HyperbolicSoil
from numpy.testing import assert_allclose

import offwind_pin as ow
from offwind_pin.definitions.soil.layers import LayeredGround
from offwind_pin.definitions.soil.registry import register_layer
from offwind_pin.loads.soil.curves.family import register_family
from offwind_pin.loads.soil.curves.laws import PolygonCurves, TanhCurves
from offwind_pin.loads.soil.springs.elastic import SoilSprings

SOFT = {"model": "hyperbolic", "initial_modulus_n_per_m2": 6e7, "ultimate_n_per_m": 3e6}
STIFF = {**SOFT, "initial_modulus_n_per_m2": 2e8, "ultimate_n_per_m": 2e7}
SAND = {"model": "api_sand", "friction_angle_deg": 35.0}
CLAY = {"model": "matlock_clay", "undrained_shear_strength_pa": 9e4, "strain_50": 0.008}
PUSH = np.array([1.5e6, 0.0, 0.0, 0.0, 0.0, 0.0])


def on_layers(turbine: ow.Turbine) -> ow.Turbine:
    """Own soil, sand, clay, and own soil again."""
    layers = [
        {**layer, "top_m": top, "submerged_unit_weight_n_per_m3": 9.5e3}
        for layer, top in ((SOFT, 0.0), (SAND, 6.0), (CLAY, 14.0), (STIFF, 24.0))
    ]
    ground = LayeredGround.model_validate({"kind": "layers", "loading": "static", "layers": layers})
    springs = turbine.soil.distributed_springs
    assert springs is not None
    soil = turbine.soil.model_copy(
        update={"distributed_springs": springs.model_copy(update={"curve": ground})}
    )
    return turbine.model_copy(update={"soil": soil})


@pytest.fixture(scope="module")
def own(undamped: ow.Turbine) -> ow.System:
    return ow.build(on_layers(undamped), "distributed_springs", elements=8)


@pytest.fixture
def by_chords(undamped: ow.Turbine) -> Iterator[ow.System]:
    """The same ground, its own soil by polygons."""
    register_family(ChordFamily())
    yield ow.build(on_layers(undamped), "distributed_springs", elements=8)
    register_family(HyperbolicFamily())


def test_curves_of_an_own_law() -> None:
    """Secant, tangent and energy by their formulas, vectorised and compiled."""
    k, ultimate = np.array([6e7, 2e8, 1e8]), np.array([3e6, 2e7, 5e6])
    curves, y = HyperbolicCurves(k, ultimate), np.array([0.0, 0.02, 0.4])
    p = y / (1 / k + y / ultimate)
    assert_allclose(curves.resistance(y), p, rtol=1e-14)
    assert_allclose(curves.tangent(y), k * (1 - p / ultimate) ** 2, rtol=1e-13)
    work = ultimate * y - ultimate**2 / k * np.log(1 + k * y / ultimate)
    assert_allclose(curves.energy(y), work, rtol=1e-12)


def test_an_own_law_joins_shipped_ones(own: ow.System) -> None:
    """One load, in as many compiled groups as there are laws; own layers of one law are one."""
    (soil,) = own.foundation.soil
    assert isinstance(soil, SoilSprings)
    kinds = [type(law) for _, law in soil.curves.groups]
    assert kinds == [HyperbolicCurves, TanhCurves, PolygonCurves]
    assert len(soil.compiled()) == 3


def test_statics_and_modes_with_an_own_law(own: ow.System, by_chords: ow.System) -> None:
    """As by fine chords of the shipped polygons, which lie 1e-5 below the curve."""
    states = [ow.static(system, PUSH) for system in (own, by_chords)]
    top, same = (state.tower_top_displacement[0] for state in states)
    assert top == pytest.approx(same, rel=1e-4)
    frequencies = [
        ow.modes(system, 6, about=state).frequency_hz
        for system, state in zip((own, by_chords), states, strict=True)
    ]
    assert_allclose(*frequencies, rtol=1e-3)


def test_motion_with_an_own_law(own: ow.System, by_chords: ow.System) -> None:
    """The same in time; energies are of the whole load, and they balance."""
    time = np.linspace(0.0, 4.0, 401)
    history = ow.LoadHistory(time, np.outer((1 - np.cos(np.pi * time / 4)) / 2, PUSH), "push")
    runs = [ow.simulate(system, 4.0, 0.02, [history]) for system in (own, by_chords)]
    for name in ("tower_top_displacement", "mudline_moment", "energy_stored"):
        expected = runs[1][name].to_numpy()
        assert_allclose(runs[0][name], expected, rtol=0, atol=1e-4 * np.abs(expected).max())
    assert runs[0]["holder"].to_numpy().tolist().count("soil") == 1
    stored = runs[0]["energy_stored"].sel(holder="soil").to_numpy()
    gained = stored.max() - stored.min()
    assert gained > 1e4
    assert float(np.abs(runs[0]["energy_balance"]).max()) < 0.02 * gained


def test_another_law_is_something_else(own: ow.System, undamped: ow.Turbine) -> None:
    """Negative control: with sand in place of the own soil the structure moves otherwise."""
    turbine = on_layers(undamped)
    springs = turbine.soil.distributed_springs
    assert springs is not None
    assert isinstance(springs.curve, LayeredGround)
    sand = springs.curve.layers[1].model_copy(update={"top": 0.0})
    ground = springs.curve.model_copy(update={"layers": (sand, *springs.curve.layers[2:])})
    soil = turbine.soil.model_copy(
        update={"distributed_springs": springs.model_copy(update={"curve": ground})}
    )
    other = ow.build(turbine.model_copy(update={"soil": soil}), "distributed_springs", elements=8)
    moved = [ow.static(system, PUSH).mudline_displacement[0] for system in (own, other)]
    assert abs(moved[1] / moved[0] - 1) > 20 * 1e-4


def test_layers_of_an_own_kind_are_checked() -> None:
    """A file with a wrong number in such a layer is refused like any other; a name is taken once."""
    with pytest.raises(ValueError, match="ultimate_n_per_m"):
        LayeredGround.model_validate(
            {
                "kind": "layers",
                "loading": "static",
                "layers": [
                    {
                        **SOFT,
                        "ultimate_n_per_m": -1,
                        "top_m": 0,
                        "submerged_unit_weight_n_per_m3": 9e3,
                    }
                ],
            }
        )

    class Namesake(HyperbolicSoil):
        """Another kind of the same name."""

    with pytest.raises(ow.InputError, match="hyperbolic"):
        register_layer(Namesake)


def test_turbines_keep_their_signature() -> None:
    """A registered family is among the kinds of layers; arguments of Turbine are its fields."""
    names = inspect.signature(ow.Turbine).parameters
    assert {"name", "members", "soil"} <= names.keys()
    assert "values" not in names
