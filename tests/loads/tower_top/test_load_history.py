"""Tower-top load files and their interpolation."""

from pathlib import Path

import numpy as np
import pytest
from numpy.testing import assert_allclose

import offwind_pin as ow
from offwind_pin.loads.point_load import PointMotion
from offwind_pin.loads.tower_top.load_history import TowerTopLoad, constant_load

GOOD = """\
! OpenFAST-like header
# t Fx Fy Fz Mx My Mz
% blanks, tabs, commas
0.0  1e6 0 -8e6  1 2 3

1.0,2e6,0,-8e6,4,5,6   # a comment at the end
\t3.0\t4e6\t1e5\t-8e6\t7\t8\t9 ! another
"""


@pytest.fixture
def history(tmp_path: Path) -> ow.LoadHistory:
    path = tmp_path / "loads.txt"
    path.write_text(GOOD)
    return ow.read_load_history(path)


def test_comments_and_separators(history: ow.LoadHistory) -> None:
    """Three rows come out of blanks, tabs, commas and comments."""
    assert_allclose(history.time, [0, 1, 3])
    assert_allclose(history.load[1], [2e6, 0, -8e6, 4, 5, 6])
    assert_allclose(history.load[2], [4e6, 1e5, -8e6, 7, 8, 9])
    assert history.origin.startswith("loads.txt (SHA-256 ")
    assert history.surrogate is None


def test_linear_between_samples_and_held_beyond(history: ow.LoadHistory) -> None:
    """Between samples linear, outside the first and the last one."""
    assert_allclose(history.at(2.0), [3e6, 5e4, -8e6, 5.5, 6.5, 7.5])
    assert_allclose(history.at(np.array([-5.0, 0.0, 3.0, 99.0]))[:, 0], [1e6, 1e6, 4e6, 4e6])


def test_mean_is_that_of_the_interpolated_line(history: ow.LoadHistory) -> None:
    """The mean weighs unequal intervals by their length, and cuts them where it must."""
    assert history.mean(0.0, 3.0)[0] == pytest.approx((1.5e6 * 1 + 3e6 * 2) / 3)
    assert history.mean(0.5, 2.0)[0] == pytest.approx((1.75e6 * 0.5 + 2.5e6 * 1) / 1.5)


def test_single_sample_is_a_constant() -> None:
    """A history of one sample holds at any time, one or many."""
    load = np.arange(6.0)
    history = constant_load(100.0, load).history
    assert_allclose(history.at(12.0), load)
    assert_allclose(history.at(np.array([0.0, 3.0])), [load, load])


def test_ramp_acts_on_the_departure_from_the_mean(history: ow.LoadHistory) -> None:
    """At rise 0 the mean acts, at 1 the history, half-way half of the departure."""
    mean = history.mean(0.0, 3.0)
    top = TowerTopLoad(115.0, history, mean)
    none, full, half, early = top.time_inputs(
        np.array([3.0, 3.0, 3.0, 1.0]), np.array([0.0, 1.0, 0.5, 1.0])
    )
    assert_allclose(none, mean)
    assert_allclose(full, history.at(3.0))
    assert_allclose(half, (mean + history.at(3.0)) / 2)
    assert_allclose(early, history.at(1.0))
    still = PointMotion(*np.zeros((4, 1, 3)))
    applied = top.forces(3.0, still, 0.5)
    assert_allclose(np.hstack([applied.force, applied.moment])[0], half)


ROW = "0 1 2 3 4 5 6\n"


@pytest.mark.parametrize(
    ("text", "told"),
    [
        ("", "0 rows"),
        ("# only a comment\n", "0 rows"),
        (ROW, "1 rows"),
        (ROW + "1 1 2 3 4 5\n", "line 2.*6 cells"),
        (ROW + "1 1 2 3 4 5 6 7\n", "line 2.*8 cells"),
        ("t Fx Fy Fz Mx My Mz\n" + ROW, "line 1, column 1"),
        (ROW + "1 1 2 x 4 5 6\n", "line 2, column 4"),
        (ROW + "1 1 2 inf 4 5 6\n", "line 2, column 4"),
        (ROW + "0 1 2 3 4 5 6\n", "line 2, column t"),
        (ROW + "-1 1 2 3 4 5 6\n", "line 2, column t"),
        (ROW + "1 1 2 3 4 -5e12 6\n", "units"),
    ],
    ids=[
        "empty",
        "comment only",
        "one row",
        "short row",
        "long row",
        "bare header",
        "word",
        "infinite",
        "repeated time",
        "time runs back",
        "units",
    ],
)
def test_bad_file_is_refused(tmp_path: Path, text: str, told: str) -> None:
    """Every fault is told with the file and the line."""
    path = tmp_path / "bad.txt"
    path.write_text(text)
    with pytest.raises(ow.InputError, match=told) as caught:
        ow.read_load_history(path)
    assert str(path) in str(caught.value)


def test_missing_and_binary_files_are_refused(tmp_path: Path) -> None:
    """A file that is not there, or not text, is named."""
    with pytest.raises(ow.InputError, match="no such file"):
        ow.read_load_history(tmp_path / "none.txt")
    binary = tmp_path / "binary.txt"
    binary.write_bytes(b"\xff\xfe\x00\x80")
    with pytest.raises(ow.InputError, match="text in lines"):
        ow.read_load_history(binary)
