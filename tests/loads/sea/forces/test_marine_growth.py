"""Marine growth and water inside, by hand: masses, diameters, coefficients, weight."""

import xml.etree.ElementTree as ET
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import offwind_pin as ow
from offwind_pin.definitions.hydrodynamics import FloodedPile, MarineGrowth
from offwind_pin.loads.sea.forces.added_mass import AddedMass
from offwind_pin.loads.sea.forces.buoyancy import Buoyancy
from offwind_pin.loads.sea.forces.morison import MorisonForce
from offwind_pin.loads.sea.hydrodynamic_loads import HydrodynamicModel, contents
from offwind_pin.structure.frustum import AxialBody
from offwind_pin.structure.section import frusta, lump

THICK = MarineGrowth(z=(-30.0, -10.0), thickness=0.1, drag_coefficient=1.2)
THIN = MarineGrowth(z=(-10.0, 2.0), thickness=0.05, density=1400.0)


def changed(turbine: ow.Turbine, **keys: Any) -> ow.Turbine:
    hydrodynamics = turbine.hydrodynamics.model_copy(update=keys)
    return turbine.model_copy(update={"hydrodynamics": hydrodynamics})


@pytest.fixture(scope="module")
def grown(oc6: ow.Turbine) -> ow.Turbine:
    return changed(oc6, marine_growth=(THICK, THIN))


def ring(diameter: float, thickness: float, density: float) -> float:
    """kg/m of growth outside a diameter."""
    return density * np.pi * (diameter + thickness) * thickness


def test_growth_s_mass(oc6: ow.Turbine, grown: ow.Turbine) -> None:
    """pi (D + t) t rho per length: 20 m of 0.1 m, 12 m of 0.05 m, on the 9 m pile."""
    expected = 20 * ring(9.0, 0.1, 1325.0) + 12 * ring(9.0, 0.05, 1400.0)
    gained = lump(grown, -30.0, 10.0).mass - lump(oc6, -30.0, 10.0).mass
    assert gained == pytest.approx(expected, rel=1e-10)
    part = lump(grown, -12.0, -9.0).mass - lump(oc6, -12.0, -9.0).mass
    assert part == pytest.approx(2 * ring(9.0, 0.1, 1325.0) + ring(9.0, 0.05, 1400.0), rel=1e-9)
    assert lump(grown, 2.0, 10.0) == lump(oc6, 2.0, 10.0)
    assert lump(grown, -75.0, -30.0) == lump(oc6, -75.0, -30.0)


def test_growth_s_inertia() -> None:
    """A layer on a tower of 9 m: that of a thick tube."""
    oc6 = ow.load_turbine("oc6_phase2")
    grown = changed(oc6, marine_growth=(THICK,))
    inner, outer, length = 4.5, 4.6, 4.0
    mass = 1325.0 * np.pi * (outer**2 - inner**2) * length
    expected = AxialBody(
        mass,
        -14.0,
        mass * ((outer**2 + inner**2) / 4 + length**2 / 12),
        mass * (outer**2 + inner**2) / 2,
    )
    bare, whole = lump(oc6, -16.0, -12.0), lump(grown, -16.0, -12.0)
    for name in ("mass", "transverse", "axial"):
        gained = getattr(whole, name) - getattr(bare, name)
        assert gained == pytest.approx(getattr(expected, name), rel=1e-9)
    assert whole.center == pytest.approx(-14.0, rel=1e-12)


def test_growth_reaches_the_chain_and_its_files(
    oc6: ow.Turbine, grown: ow.Turbine, tmp_path: Path
) -> None:
    """Bodies, URDF and sidecar weigh it; the joints' stiffness is that of the steel."""
    systems = [ow.build(turbine, "clamped", elements=20) for turbine in (oc6, grown)]
    expected = 20 * ring(9.0, 0.1, 1325.0) + 12 * ring(9.0, 0.05, 1400.0)
    bodies = [sum(body.mass for body in system.chain.body) for system in systems]
    assert bodies[1] - bodies[0] == pytest.approx(expected, rel=1e-9)
    assert np.array_equal(systems[0].joint_stiffness, systems[1].joint_stiffness)
    weights = []
    for i, system in enumerate(systems):
        folder = tmp_path / str(i)
        ow.export_urdf(system, folder)
        masses = ET.parse(folder / "oc6_phase2.urdf").getroot().findall(".//inertial/mass")
        weights.append(sum(float(str(mass.get("value"))) for mass in masses))
    assert weights[1] - weights[0] == pytest.approx(expected, rel=1e-9)


def test_without_growth_bodies_are_the_same_to_the_last_bit(oc6: ow.Turbine) -> None:
    """The rule of the steel alone, and a layer elsewhere, give the same numbers exactly."""
    elsewhere = changed(oc6, marine_growth=(THIN,))
    for low, high in ((-30.0, -26.0), (-12.5, -10.0), (2.0, 11.0), (100.0, oc6.yaw_bearing)):
        steel = AxialBody.combine([shell.lump(base) for base, shell in frusta(oc6, low, high)])
        assert lump(oc6, low, high) == steel
        assert lump(elsewhere, low, high) == steel


def test_loads_see_the_larger_diameter(oc6: ow.Turbine, grown: ow.Turbine) -> None:
    """Added mass, inertia and drag on D + 2 t; the layer's own drag coefficient where it has one."""
    hydrodynamics = HydrodynamicModel.of(grown, ow.StillWater())
    z = hydrodynamics.strips.height
    diameter = np.where(z < -10, 9.2, 9.1)
    drag = np.where(z < -10, 1.2, 1.0)
    assert hydrodynamics.strips.diameter == pytest.approx(diameter, rel=1e-14)
    assert hydrodynamics.drag.tolist() == drag.tolist()
    added, wave, *rest = HydrodynamicModel.of(grown, ow.StillWater()).loads()
    assert rest == []
    assert isinstance(added, AddedMass)
    assert isinstance(wave, MorisonForce)
    assert added.mass == pytest.approx(1025.0 * np.pi / 4 * diameter**2 * 0.5, rel=1e-12)
    assert wave.constants[:, 0] == pytest.approx(2 * added.mass, rel=1e-12)
    assert wave.constants[:, 1] == pytest.approx(0.25 * 1025.0 * drag * diameter, rel=1e-12)


def test_a_pile_with_growth_is_slower(oc6: ow.Turbine, grown: ow.Turbine) -> None:
    """Its frequencies fall by what the mass adds to the modes: Rayleigh's quotient."""
    dry = [ow.build(turbine, "clamped", elements=20) for turbine in (oc6, grown)]
    first, second = (ow.modes(system, n=6) for system in dry)
    i = first.index("FA2")
    shape = first.mass_normalised[i, :, 0]
    z = np.linspace(-30.0, 2.0, 6401)
    line = np.where(z < -10, ring(9.0, 0.1, 1325.0), ring(9.0, 0.05, 1400.0))
    gained = np.trapezoid(line * np.interp(z, first.height, shape) ** 2, z)
    ratio = second.frequency_hz[second.index("FA2")] / first.frequency_hz[i]
    assert 1 - ratio == pytest.approx(1 - (1 + gained) ** -0.5, rel=0.05)
    assert ratio < 1 - 2e-4


def test_water_inside(oc6: ow.Turbine) -> None:
    """Its mass over the inner section, from the plug to the level, across the axis only."""
    inside = FloodedPile(kind="flooded", level=-2.0, plug=-28.0, density=1030.0)
    water, pressure = contents(changed(oc6, buoyancy=True), inside)
    area = np.pi / 4 * 8.78**2
    assert isinstance(water, AddedMass)
    assert water.mass.sum() == pytest.approx(1030.0 * area * 26.0, rel=1e-12)
    assert water.height.min() > -28
    assert water.height.max() < -2
    assert isinstance(pressure, Buoyancy)
    lift = pressure.constants[:, 0].sum()
    assert lift == pytest.approx(-1030.0 * 9.80665 * area * 26.0, rel=1e-12)
    assert pressure.height[-1] == -28.0
    assert [load.name for load in contents(oc6, inside)] == ["contained_water"]
    default = contents(oc6, FloodedPile(kind="flooded", level=0.0))[0]
    assert isinstance(default, AddedMass)
    assert default.mass.sum() == pytest.approx(1025.0 * area * 30.0, rel=1e-12)


def test_what_a_turbine_s_water_is(oc6: ow.Turbine) -> None:
    """One load for each thing that the file asks for, and no other."""
    flooded = FloodedPile(kind="flooded", level=0.0)
    names = {
        (False, None): ["added_mass", "waves"],
        (True, None): ["added_mass", "waves", "buoyancy"],
        (False, flooded): ["added_mass", "waves", "contained_water"],
        (True, flooded): [
            "added_mass",
            "waves",
            "buoyancy",
            "contained_water",
            "contained_pressure",
        ],
    }
    for (floats, inside), expected in names.items():
        keys: dict[str, Any] = {"buoyancy": floats}
        if inside is not None:
            keys["contents"] = inside
        loads = HydrodynamicModel.of(changed(oc6, **keys), ow.StillWater()).loads()
        assert [load.name for load in loads] == expected


def test_a_flooded_pile_is_in_the_mass_matrix(oc6: ow.Turbine) -> None:
    """A rigid sideways motion has the contained mass more, a vertical one has not."""
    inside = FloodedPile(kind="flooded", level=-3.0)
    systems = [
        ow.build(turbine, "coupled_springs", ow.StillWater(), elements=12)
        for turbine in (oc6, changed(oc6, contents=inside))
    ]
    rest = np.zeros(systems[0].nv)
    bare, full = (system.equations().mass(rest) for system in systems)
    expected = 1025.0 * np.pi / 4 * 8.78**2 * 27.0
    assert full[0, 0] - bare[0, 0] == pytest.approx(expected, rel=1e-8)
    assert full[2, 2] == pytest.approx(bare[2, 2], rel=1e-14)


def test_static_settlement_of_a_floating_pile(oc6: ow.Turbine) -> None:
    """Hydrostatic pressure on an upright pile lifts nothing but the growth.

    The annuli at the growth's ends are pressed up and down: it weighs what it weighs in water.
    """
    layer = MarineGrowth(z=(-20.0, -10.0), thickness=0.1)
    grown = changed(oc6, buoyancy=True, marine_growth=(layer,))
    dry = changed(grown, buoyancy=False)
    assert oc6.soil.coupled_springs is not None
    reaction = []
    for turbine in (grown, dry):
        system = ow.build(turbine, "coupled_springs", ow.StillWater(), elements=12)
        settled = ow.static(system).mudline_displacement[2]
        reaction.append(-settled * oc6.soil.coupled_springs.stiffness[2][2])
    lifted = reaction[1] - reaction[0]
    volume = np.pi * 9.1 * 0.1 * 10.0
    assert lifted == pytest.approx(1025.0 * 9.80665 * volume, rel=1e-3)
