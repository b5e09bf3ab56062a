"""What a modal result says of itself: equations, scaling, signs, shapes."""

import numpy as np
import pytest
from helpers.poses import body_poses
from numpy.testing import assert_allclose

import offwind_pin as ow

SHOWN = {"FA": 0, "SS": 1, "V": 2, "T": 5}


@pytest.fixture(scope="module")
def result(coupled_wet: ow.System) -> ow.ModalResult:
    return ow.modes(coupled_wet, 8)


def test_modes_satisfy_their_equation(coupled_wet: ow.System, result: ow.ModalResult) -> None:
    """K phi = omega^2 M phi about the state under gravity, phi' M phi = 1."""
    q, rest = ow.static(coupled_wet).q, np.zeros(coupled_wet.nv)
    equations = coupled_wet.equations((), np.inf)
    stiffness, _ = equations.tangents(0.0, q, rest)
    mass = equations.mass(q)
    squares = (2 * np.pi * result.frequency_hz) ** 2
    inertia = mass @ result.vector * squares
    left = stiffness @ result.vector - inertia
    assert np.abs(left).max() < 1e-8 * np.abs(inertia).max()
    assert_allclose(result.vector.T @ mass @ result.vector, np.eye(8), atol=1e-9)


def test_shapes_are_scaled_and_positive_at_their_peak(result: ow.ModalResult) -> None:
    """Both shapes of a mode have the same sign, positive where the mode's own motion peaks."""
    for i, label in enumerate(result.label):
        along = SHOWN[label.rstrip("0123456789")]
        unit, scaled = result.shape[i, :, along], result.mass_normalised[i, :, along]
        peak = int(np.argmax(np.abs(unit)))
        assert unit[peak] == pytest.approx(1.0, rel=1e-12)
        assert scaled[peak] > 0
        assert_allclose(scaled / scaled[peak], unit, atol=1e-12)


def test_vector_and_shape_are_one_motion(coupled_wet: ow.System, result: ow.ModalResult) -> None:
    """The mass-normalised shape is what the mode's joint displacements do to the axis."""
    q, rest = ow.static(coupled_wet).q, np.zeros(coupled_wet.nv)
    equations, step = coupled_wet.equations(), 1e-4
    height = coupled_wet.chain.boundary
    for i in range(4):
        there, back = (
            equations.chain_motion(q + s * step * result.vector[:, i], rest)
            .points_at(height)
            .position
            for s in (1, -1)
        )
        moved = (there - back) / (2 * step)
        scale = np.abs(moved).max()
        assert_allclose(result.mass_normalised[i, :, :3], moved, atol=1e-6 * scale)


def test_rotation_is_the_slope_of_the_displacement(result: ow.ModalResult) -> None:
    """Fore-aft, the rotation about y is du/dz: by the trapezoid over the first mode."""
    shape, height = result.shape[result.index("FA1")], result.height
    climbed = np.trapezoid(shape[:, 4], height)
    assert climbed == pytest.approx(shape[-1, 0] - shape[0, 0], rel=2e-3)


def test_participation_is_a_share(result: ow.ModalResult) -> None:
    """The families' shares sum to one, and the label is the largest one's."""
    assert_allclose(result.participation.sum(axis=1), 1.0, rtol=1e-9)
    families = [("FA", "SS", "T", "V")[i] for i in np.argmax(result.participation, axis=1)]
    assert [label[:-1] for label in result.label] == families
    # The overhanging assembly couples torsion and the second side-side mode by a tenth.
    assert result.participation.max(axis=1).min() > 0.85


def test_number_of_modes_is_checked(coupled_wet: ow.System, result: ow.ModalResult) -> None:
    """None, too many, or an unknown label is refused with what there is."""
    for n in (0, coupled_wet.nv + 1):
        with pytest.raises(ow.InputError, match="1 to"):
            ow.modes(coupled_wet, n)
    with pytest.raises(ow.InputError, match="FA1"):
        result.index("FA9")


@pytest.mark.parametrize("name", ["clamped_dry", "coupled_wet", "distributed_wet"])
def test_small_motion_is_the_modal_shape(request: pytest.FixtureRequest, name: str) -> None:
    """Differences of poses along a modal vector are the mode's displacements and rotations."""
    system: ow.System = request.getfixturevalue(name)
    equilibrium = ow.static(system)
    modes = ow.modes(system, 5, about=equilibrium)
    lever = modes.height - system.chain.origin
    step = 1e-4
    for index in range(5):
        vector = step * modes.vector[:, index]
        fore, aft = (body_poses(system, equilibrium.q + s * vector) for s in (1, -1))
        centre = body_poses(system, equilibrium.q)
        rate = (fore - aft) / (2 * step)
        moved = rate[:, :3, 3] + lever[:, None] * rate[:, :3, 2]
        spin = rate[:, :3, :3] @ centre[:, :3, :3].transpose(0, 2, 1)
        turned = np.stack([spin[:, 2, 1], spin[:, 0, 2], spin[:, 1, 0]], axis=1)
        shape = modes.mass_normalised[index]
        size = np.abs(shape[:, :3]).max()
        assert_allclose(moved, shape[:, :3], rtol=0, atol=1e-6 * size)
        assert_allclose(turned, shape[:, 3:], rtol=0, atol=1e-6 * np.abs(shape[:, 3:]).max())
        # Negative control: the neighbouring mode is no match at this tolerance.
        other = modes.mass_normalised[(index + 1) % 5]
        assert np.abs(moved - other[:, :3]).max() > 0.1 * size
