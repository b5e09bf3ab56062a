"""The OC6 Phase II benchmark: this chain's own numbers, OpenFAST's, and the published ones.

"Chain" values are those of an independent program of the same chain of rigid bodies and joints;
"OpenFAST" values come from its own model of the structure (tower modes, Craig-Bampton monopile,
Timoshenko elements), which is why they are met less closely.
"""

import numpy as np
import pytest

import offwind_pin as ow
from offwind_pin.turbines.depth_profile import DepthLine
from offwind_pin.turbines.soil import LinearModulus

CHAIN, OPENFAST = 3e-3, 1e-2
"""Relative tolerances: rounding and discretisation of the chain; another theory of the beam."""


def frequency(result: ow.ModalResult, label: str) -> float:
    return float(result.frequency_hz[result.index(label)])


@pytest.fixture(scope="module")
def clamped(clamped_dry: ow.System) -> ow.ModalResult:
    return ow.modes(clamped_dry, 6)


@pytest.fixture(scope="module")
def coupled(coupled_wet: ow.System) -> ow.ModalResult:
    return ow.modes(coupled_wet, 6)


@pytest.fixture(scope="module")
def coupled_dry(oc6: ow.Turbine) -> ow.ModalResult:
    return ow.modes(ow.build(oc6, "coupled_springs"), 6)


@pytest.fixture(scope="module")
def surrogate(distributed_wet: ow.System) -> ow.ModalResult:
    return ow.modes(distributed_wet, 6)


@pytest.fixture(scope="module")
def uniform_soil(undamped: ow.Turbine) -> ow.System:
    """Distributed springs of the uniform modulus 2.0e8 N/m2, toe springs of the 6x6."""
    soil = undamped.soil.distributed_springs
    assert soil is not None
    assert soil.toe_vertical_stiffness == pytest.approx(1.12e10, rel=1e-3)
    assert soil.toe_torsional_stiffness == pytest.approx(2.55e11, rel=2e-3)
    curve = LinearModulus(kind="linear", modulus=DepthLine(at_mudline=2.0e8))
    springs = soil.model_copy(update={"curve": curve})
    turbine = undamped.model_copy(
        update={"soil": undamped.soil.model_copy(update={"distributed_springs": springs})}
    )
    return ow.build(turbine, "distributed_springs", ow.StillWater())


def top_x(system: ow.System, thrust: float = 0.0) -> float:
    load = np.array([thrust, 0, 0, 0, 0, 0])
    return float(ow.static(system, load).tower_top_displacement[0])


@pytest.mark.parametrize(
    ("label", "hertz"),
    [("FA1", 0.2744), ("SS1", 0.2716), ("T1", 1.2692), ("FA2", 1.4436), ("SS2", 1.3416)],
)
def test_clamped_dry_frequencies(clamped: ow.ModalResult, label: str, hertz: float) -> None:
    """LC 2.1: the first five modes of the clamped structure about its state under gravity."""
    assert frequency(clamped, label) == pytest.approx(hertz, rel=CHAIN)


@pytest.mark.parametrize(
    ("label", "hertz"), [("FA1", 0.27446), ("SS1", 0.27171), ("FA2", 1.4378), ("SS2", 1.3384)]
)
def test_clamped_dry_against_openfast(clamped: ow.ModalResult, label: str, hertz: float) -> None:
    """The same by OpenFAST."""
    assert frequency(clamped, label) == pytest.approx(hertz, rel=OPENFAST)


def test_clamped_static(clamped_dry: ow.System) -> None:
    """LC 1.2, clamped: the assembly's overhang pulls the top upwind."""
    assert top_x(clamped_dry) == pytest.approx(-0.2072, rel=CHAIN)
    assert top_x(clamped_dry) == pytest.approx(-0.2091, rel=OPENFAST)


@pytest.mark.parametrize(("label", "hertz"), [("FA1", 0.2484), ("FA2", 1.1929)])
def test_coupled_springs_in_water(coupled: ow.ModalResult, label: str, hertz: float) -> None:
    """6x6 at the mudline, still water."""
    assert frequency(coupled, label) == pytest.approx(hertz, rel=CHAIN)


@pytest.mark.parametrize(("label", "hertz"), [("FA1", 0.2487), ("FA2", 1.2417)])
def test_coupled_springs_dry(coupled_dry: ow.ModalResult, label: str, hertz: float) -> None:
    """6x6 at the mudline, no water."""
    assert frequency(coupled_dry, label) == pytest.approx(hertz, rel=CHAIN)


@pytest.mark.parametrize(
    ("label", "dry", "wet"),
    [
        ("FA1", 0.24870, 0.24842),
        ("SS1", 0.24665, 0.24640),
        ("FA2", 1.2374, 1.1868),
        ("SS2", 1.1611, 1.1233),
    ],
)
def test_coupled_springs_against_openfast(
    coupled_dry: ow.ModalResult, coupled: ow.ModalResult, label: str, dry: float, wet: float
) -> None:
    """The same by OpenFAST; the water's part of the change is met as well."""
    assert frequency(coupled_dry, label) == pytest.approx(dry, rel=OPENFAST)
    assert frequency(coupled, label) == pytest.approx(wet, rel=OPENFAST)
    change = frequency(coupled, label) / frequency(coupled_dry, label)
    assert change == pytest.approx(wet / dry, abs=2e-3)


def test_coupled_springs_static(clamped_dry: ow.System, coupled_wet: ow.System) -> None:
    """The soil lets the top go 9.2 % further; OpenFAST: -0.2282 m, and 0.1337 m under 1 MN."""
    still, pushed = top_x(coupled_wet), top_x(coupled_wet, 1e6)
    assert still / top_x(clamped_dry) - 1 == pytest.approx(0.092, abs=0.001)
    assert still == pytest.approx(-0.2282, rel=OPENFAST)
    assert pushed - still == pytest.approx(0.1337 + 0.2282, rel=OPENFAST)


def test_uniform_distributed_springs(uniform_soil: ow.System, clamped_dry: ow.System) -> None:
    """A uniform Winkler modulus of 2.0e8 N/m2 along the pile."""
    result = ow.modes(uniform_soil, 6)
    assert frequency(result, "FA1") == pytest.approx(0.2421, rel=CHAIN)
    assert frequency(result, "FA2") == pytest.approx(1.1325, rel=CHAIN)
    assert top_x(uniform_soil) / top_x(clamped_dry) - 1 == pytest.approx(0.117, abs=0.001)


def test_surrogate_soil(surrogate: ow.ModalResult) -> None:
    """LC 2.3 on the shipped surrogate: around the published 0.24 and 1.14 Hz."""
    assert 0.235 < frequency(surrogate, "FA1") < 0.245
    assert 1.12 < frequency(surrogate, "FA2") < 1.16


def test_second_mode_peaks_where_published(surrogate: ow.ModalResult) -> None:
    """The second fore-aft mode has its maximum at 0.64 of the height above the mudline."""
    at = surrogate.shape_peak_height_ratio[surrogate.index("FA2")]
    assert at == pytest.approx(0.64, abs=0.03)
    first = surrogate.shape_peak_height_ratio[surrogate.index("FA1")]
    assert first == pytest.approx(1.0, abs=1e-12)


def test_surrogate_says_so(distributed_wet: ow.System) -> None:
    """A soil that stands in for the benchmark's is never silent about it."""
    assert distributed_wet.foundation.surrogate
    assert "not public" in distributed_wet.foundation.surrogate
