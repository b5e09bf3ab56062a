"""The painter of stills: perspective, what is hidden, order, light."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.testing import assert_allclose

from offwind_pin.display.viewer.painter import Camera, Surface, paint
from offwind_pin.structure.meshes import Mesh, box

WHITE = np.ones(3)


@pytest.fixture
def camera() -> Camera:
    """From upwind, on the level: y to the left, z up, so that -y is on the right."""
    return Camera(np.array([0.0, 0.0, 5.0]), np.array([-1.0, 0.0, 0.0]), 100.0)


def area(corners: np.ndarray) -> float:
    """Of triangles (t, 3, 2), whichever way round."""
    a, b = (corners[:, i] - corners[:, 0] for i in (1, 2))
    return float(np.abs(a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0]).sum() / 2)


def test_perspective(camera: Camera) -> None:
    """Tangents of angles: right, up, smaller further off; the middle is in the middle."""
    assert_allclose(camera.project(np.array([0.0, 0.0, 5.0])), [0, 0, 100])
    assert_allclose(camera.project(np.array([0.0, -2.0, 8.0])), [0.02, 0.03, 100])
    assert_allclose(camera.project(np.array([100.0, -2.0, 8.0])), [0.01, 0.015, 200])


def test_axes_are_a_frame() -> None:
    """Orthonormal and right-handed from any side, with the vertical upright."""
    for azimuth, elevation in ((0.3, 0.2), (-2.2, 0.1), (2.0, -0.4)):
        level = np.cos(elevation)
        towards = [level * np.cos(azimuth), level * np.sin(azimuth), np.sin(elevation)]
        axes = Camera(np.zeros(3), np.array(towards), 10.0).axes
        assert_allclose(axes @ axes.T, np.eye(3), atol=1e-14)
        assert np.linalg.det(axes) == pytest.approx(1)
        assert axes[0, 2] == pytest.approx(0, abs=1e-15)
        assert axes[1, 2] > 0


def test_a_solid_shows_the_side_that_faces_the_camera(camera: Camera) -> None:
    """Of a cuboid straight ahead one side of six, of its true size at its distance."""
    mesh = box([-1, -2, 2], [1, 2, 8])
    corners, colours = paint(camera, [Surface(mesh, WHITE)])
    assert len(corners) == 2
    assert area(corners) == pytest.approx(4 * 6 / 99**2, rel=1e-9)
    assert_allclose(colours[:, 3], 1)
    # what is translucent is seen from both sides: five more, four of them edge-on to the camera
    corners, colours = paint(camera, [Surface(mesh, WHITE, 0.5)])
    assert area(corners) == pytest.approx(
        4 * 6 / 99**2 + 4 * 6 / 101**2 + 2 * (4 * 6 / 99**2 - 4 * 6 / 101**2) / 2, rel=1e-9
    )
    assert_allclose(colours[:, 3], 0.5)


def test_the_nearest_is_painted_last(camera: Camera) -> None:
    red, blue = np.array([1.0, 0, 0]), np.array([0, 0, 1.0])
    near, far = box([-30, -1, 4], [-28, 1, 6]), box([20, -1, 4], [22, 1, 6])
    for surfaces in (
        [Surface(near, red), Surface(far, blue)],
        [Surface(far, blue), Surface(near, red)],
    ):
        _, colours = paint(camera, surfaces)
        assert np.all(np.diff((colours[:, 0] > 0).astype(int)) >= 0)
        assert colours[-1, 0] > 0
        assert colours[0, 2] > 0


def test_light_falls_from_above_and_on_both_sides_alike(camera: Camera) -> None:
    """A roof is brighter than its underside, and a translucent sheet the same whichever way round."""
    square = np.array([[-1.0, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]])
    above = Camera(np.zeros(3), np.array([0.6, 0.0, 0.8]), 50.0)
    below = Camera(np.zeros(3), np.array([0.6, 0.0, -0.8]), 50.0)
    up, down = (Mesh(square, np.array([faces])) for faces in ([0, 1, 2], [2, 1, 0]))
    roof = paint(above, [Surface(up, 0.5 * WHITE)])[1]
    underside = paint(below, [Surface(down, 0.5 * WHITE)])[1]
    assert roof[0, 0] > underside[0, 0] > 0.2
    sheets = [paint(above, [Surface(mesh, 0.5 * WHITE, 0.5)])[1] for mesh in (up, down)]
    assert_allclose(sheets[0], sheets[1])


def test_colours_of_vertices_are_averaged(camera: Camera) -> None:
    mesh = box([-1, -2, 2], [1, 2, 8])
    shade = np.linspace(0, 1, len(mesh.vertices))[:, None] * WHITE
    plain = paint(camera, [Surface(mesh, WHITE)])[1][:, 0]
    found = paint(camera, [Surface(mesh, shade)])[1][:, 0]
    shown = [face for face in mesh.faces if np.all(mesh.vertices[face, 0] == -1)]
    expected = sorted(shade[face, 0].mean() for face in shown)
    assert_allclose(sorted(found / plain), expected, rtol=1e-9)
