"""Section loads in motion: equilibrium of segments, cuts anywhere, what joints carry."""

import itertools
from collections.abc import Sequence
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
import xarray as xr
from numpy.testing import assert_allclose
from numpy.typing import NDArray

import offwind_pin as ow
from offwind_pin.analysis.integrators import GeneralizedAlpha
from offwind_pin.analysis.static import load_scale
from offwind_pin.dynamics.compiled.chain import CompiledChain
from offwind_pin.dynamics.compiled.recorder import Cuts, Segments
from offwind_pin.loads.tower_top.load_history import TowerTopLoad
from offwind_pin.solvers.steps import FixedStep
from offwind_pin.structure.section import lump

Array = NDArray[np.float64]

TOLERANCE = 1e-9
"""Of a segment's imbalance over the largest section load of its kind."""
DEFAULT = ["-75 to 115.63 m", "-30 to 115.63 m", "-75 to -30 m"]
CHOSEN = [(-60.0, -40.0), (-33.3, -27.1), (-10.0, 5.0), (20.0, 90.5), (-75.0, 115.63)]


def shaking(duration: float) -> ow.LoadHistory:
    """A load at the top that shakes all six directions."""
    time = np.linspace(0, duration, 201)
    shape = np.sin(np.outer(2 * time, [1.0, 1.3, 0.7, 1.1, 0.9, 1.7]))
    return ow.LoadHistory(time, shape * [2e6, 1e6, 5e5, 1e7, 2e7, 3e7], "shaking")


def run(system: ow.System, **where: Any) -> xr.Dataset:
    return ow.simulate(system, 4.0, 0.02, [shaking(4.0)], save_at=ow.SaveAt(0.2, **where))


def imbalance(data: xr.Dataset) -> Array:
    """(g,) largest imbalance of each segment over the largest section load, of forces and moments."""
    left = data["segment_imbalance"].to_numpy()
    force, moment = (
        float(np.abs(data[name]).max()) for name in ("section_force", "section_moment")
    )
    return np.abs(left / np.repeat([force, moment], 3)).max(axis=(0, 2))


def test_default_segments_balance(coarse: ow.System) -> None:
    """The whole structure, and its parts above and below the mudline, in waves and shaken."""
    data = run(coarse)
    assert data["segment"].to_numpy().tolist() == DEFAULT
    assert np.all(imbalance(data) < TOLERANCE)
    assert np.ptp(data["section_moment"].to_numpy()) > 1e8


def test_clamped_structure_has_one_default_segment(oc6: ow.Turbine) -> None:
    """Nothing is below its mudline."""
    data = run(ow.build(oc6, "clamped", elements=5))
    assert data["segment"].to_numpy().tolist() == ["-30 to 115.63 m"]
    assert np.all(imbalance(data) < TOLERANCE)


def test_chosen_segments_balance(coarse: ow.System) -> None:
    """Ends anywhere; the recorded heights take them up."""
    data = run(coarse, segments=CHOSEN, heights=[0.0])
    ends = {z for pair in CHOSEN for z in pair}
    assert ends | {-30.0, 0.0} == set(data["height"].to_numpy().tolist())
    assert len(data["segment"]) == len(CHOSEN)
    assert np.all(imbalance(data) < TOLERANCE)


@pytest.mark.parametrize("lost", ["soil", "waves", "added_mass"])
def test_a_load_left_out_is_seen(
    coarse: ow.System, monkeypatch: pytest.MonkeyPatch, lost: str
) -> None:
    """Negative control: where one load does not enter, every segment that it acts on is off.

    The load at the top acts above every segment; they feel it through their upper section.
    """
    sections = CompiledChain.sections

    def without(
        chain: CompiledChain, height: Array, segments: Sequence[tuple[float, float]] = ()
    ) -> tuple[Cuts, Segments]:
        cuts, parts = sections(chain, height, segments)
        names = np.repeat([load.name for load in chain.loads], [len(x.height) for x in chain.loads])
        kept = names[parts.point] != lost
        first = np.cumsum([0, *kept])[parts.first_point]
        return cuts, replace(parts, point=parts.point[kept], first_point=first)

    monkeypatch.setattr(CompiledChain, "sections", without)
    wrong = imbalance(run(coarse)) > 1e3 * TOLERANCE
    below = lost == "soil"
    assert wrong.tolist() == [True, not below, below]


def test_a_wrong_mass_is_seen(coarse: ow.System, monkeypatch: pytest.MonkeyPatch) -> None:
    """Negative control: a segment's pieces a thousandth too heavy do not balance."""
    sections = CompiledChain.sections

    def heavier(
        chain: CompiledChain, height: Array, segments: Sequence[tuple[float, float]] = ()
    ) -> tuple[Cuts, Segments]:
        cuts, parts = sections(chain, height, segments)
        return cuts, replace(parts, piece=parts.piece * [1.001, 1, 1, 1])

    monkeypatch.setattr(CompiledChain, "sections", heavier)
    assert np.all(imbalance(run(coarse)) > 1e3 * TOLERANCE)


def test_forces_are_what_the_mass_between_needs(oc6: ow.Turbine) -> None:
    """Dry: from cut to cut the force falls by mass times recorded acceleration and gravity.

    Slices lie within one rigid body each and are weighed at their centres, apart from the solver.
    """
    system = ow.build(oc6, "clamped", elements=6)
    low, high = -12.0, 77.0
    joints = system.chain.joint_height
    edges = [low, *joints[(joints > low) & (joints < high)], high]
    slices = [lump(system.turbine, *pair) for pair in itertools.pairwise(edges)]
    centers = [body.center for body in slices]
    data = run(system, heights=[low, *centers, high])
    at = [int(np.argmin(np.abs(data["height"].to_numpy() - z))) for z in (low, *centers, high)]
    force = data["section_force"].to_numpy()[:, at]
    acceleration = data["acceleration"].to_numpy()[:, at[1:-1]] + [0, 0, 9.80665]
    needed = np.einsum("n,tnj->tj", [body.mass for body in slices], acceleration)
    assert_allclose(force[:, 0] - force[:, -1], -needed, rtol=0, atol=1e-9 * np.abs(force).max())
    assert np.abs(needed[:, :2]).max() > 1e5


STEP = 1e-6


@pytest.fixture(scope="module")
def undashed(oc6: ow.Turbine) -> ow.System:
    """Soil without dashpots: its force follows from displacements alone."""
    springs = oc6.soil.distributed_springs
    assert springs is not None
    soil = oc6.soil.model_copy(
        update={"distributed_springs": springs.model_copy(update={"dashpot": None})}
    )
    waves = ow.IrregularWaves(2.0, 6.0, seed=3, repeat_period=60.0)
    bare = oc6.model_copy(update={"soil": soil, "structural_damping": None})
    return ow.build(bare, "distributed_springs", waves, elements=8)


def jump(data: xr.Dataset, height: float, name: str) -> Array:
    """(t, 3) section load just below a height less that just above."""
    below, above = (
        data[name].sel(height=height + side, method="nearest").to_numpy() for side in (-STEP, STEP)
    )
    return below - above


def test_jump_at_a_soil_node_is_its_force(undashed: ow.System) -> None:
    """F = -p(|u|) l_s u / |u| of the node between two cuts, and no moment."""
    (soil,) = undashed.foundation.soil
    heights = soil.height[[5, 20, 33, 59]]
    data = run(undashed, heights=np.concatenate([heights - STEP, heights, heights + STEP]))
    for height in heights:
        depth = -30.0 - height
        u = data["displacement"].sel(height=height, method="nearest").to_numpy()[:, :2]
        y = np.hypot(*u.T)[:, None]
        resistance = 9.96e5 * depth * np.tanh(4.5e7 / 9.96e5 * y)
        expected = -resistance * 0.75 * u / y
        found = jump(data, height, "section_force")
        # A sliver of 2e-6 m weighs half a newton.
        assert_allclose(found[:, :2], expected, rtol=0, atol=1e-5 * np.abs(expected).max())
        assert np.abs(expected).max() > 1e4
        shear = np.abs(data["section_force"]).max().item()
        assert np.abs(jump(data, height, "section_moment")).max() < 1e2 * STEP * shear


def test_no_jump_without_a_load(undashed: ow.System) -> None:
    """Across a joint, a boundary, and anywhere in the tower, section loads are continuous."""
    chain = undashed.chain
    heights = np.array([chain.joint_height[-2], chain.boundary[-3], 33.3, -29.9])
    data = run(undashed, heights=np.concatenate([heights - STEP, heights + STEP]))
    for height in heights:
        for name in ("section_force", "section_moment"):
            largest = np.abs(data[name].sel(height=height, method="nearest")).max().item()
            shear = np.abs(data["section_force"]).max().item()
            found = np.abs(jump(data, height, name)).max()
            assert found < 1e-6 * max(largest, shear)


def test_heights_are_those_asked_for(coarse: ow.System) -> None:
    """Loads at a height are the same whatever else is recorded."""
    asked = [-44.4, 3.21, 99.9]
    few = run(coarse, heights=asked)
    many = run(coarse, heights=np.linspace(-75.0, 115.63, 23).tolist() + asked)
    assert few["height"].to_numpy().tolist() == [-75.0, -44.4, -30.0, 3.21, 99.9, 115.63]
    for name in ("section_force", "section_moment", "acceleration", "displacement"):
        for height in asked:
            one, other = (data[name].sel(height=height).to_numpy() for data in (few, many))
            assert np.array_equal(one, other)


@pytest.mark.parametrize("height", [-75.1, 115.7, np.nan])
def test_heights_beside_the_structure_are_refused(coarse: ow.System, height: float) -> None:
    with pytest.raises(ow.InputError, match="heights"):
        run(coarse, heights=[height])


def test_segments_upside_down_are_refused(coarse: ow.System) -> None:
    with pytest.raises(ow.InputError, match="segments"):
        run(coarse, segments=[(5.0, -5.0)])


def test_moments_at_joints_are_what_springs_and_dampers_carry(coarse: ow.System) -> None:
    """M = K q + D v on each joint's axis, in motion, to the residual that the step was left with."""
    load = TowerTopLoad(coarse.chain.top, shaking(4.0), np.zeros(6))
    chain = CompiledChain(coarse, [load])
    sections = chain.sections(coarse.chain.joint_height)
    scale = load_scale(coarse)
    method = GeneralizedAlpha(FixedStep(0.05))
    state = method.begin(chain, ow.static(coarse).q, 0.05)
    state, records = method.advance(chain, sections, state, np.arange(1, 41) * 0.05)
    q, v = state.vectors[:2]
    jacobian = coarse.equations().chain_motion(q, v).jacobian
    axes = jacobian[3:, coarse.chain.roots :].reshape(3, -1, 3)
    found = np.einsum("nj,jnk->nk", records["section_load"][-1, :, 3:], axes).ravel()
    carried = (coarse.joint_stiffness * q + coarse.joint_damping * v)[coarse.chain.roots :]
    left = float(records["residual"][-1]) * scale
    assert 0 < left < 1e-6 * scale
    rounding = 1e-12 * np.abs(carried).max()
    assert np.abs(found - carried).max() < left + rounding
    # Negative control: without the dampers they differ by more than that.
    assert np.abs(coarse.joint_damping * v).max() > 10 * (left + rounding)
