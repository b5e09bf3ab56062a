"""Motion of the ground: integrals, baseline, files, and what is refused."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from helpers.earthquakes import shaking
from numpy.typing import NDArray
from scipy.integrate import quad

import offwind_pin as ow
from offwind_pin.loads.earthquake.ground_motion import ground_motion_cautions
from offwind_pin.loads.earthquake.records import (
    read_at2,
    read_at2_components,
    read_columns,
    unit_cautions,
)

Array = NDArray[np.float64]

CORNERS = np.array([1.0, 1.5, 2.5, 3.0])
RECORD = np.array([[0.0, 1, 0], [2, 0, 0], [-1, 0.5, 3], [1, 0, 0]])


@pytest.fixture
def motion() -> ow.GroundMotion:
    """Four corners, unevenly spaced."""
    return ow.GroundMotion(CORNERS, RECORD)


def test_velocity_and_displacement_are_the_integrals(motion: ow.GroundMotion) -> None:
    """By quadrature of the straight lines, inside, at the corners, before and after."""

    def acceleration(time: float, axis: int) -> float:
        return float(np.interp(time, CORNERS, RECORD[:, axis], left=0.0, right=0.0))

    times = np.array([0.3, 1.0, 1.2, 1.5, 2.2, 2.9, 3.0, 4.5])
    found = motion.motion(times)
    assert found.shape == (8, 1, 3, 3)
    for i, time in enumerate(times):
        for axis in range(3):
            near = [corner for corner in CORNERS if 0 < corner < time]
            velocity, _ = quad(acceleration, 0, time, (axis,), points=near or None)
            moved, _ = quad(
                lambda t, axis=axis, time=time: (time - t) * acceleration(t, axis),
                0,
                time,
                points=near or None,
            )
            assert found[i, 0, 1, axis] == pytest.approx(velocity, abs=1e-10)
            assert found[i, 0, 0, axis] == pytest.approx(moved, abs=1e-10)
            assert found[i, 0, 2, axis] == pytest.approx(acceleration(time, axis), abs=1e-12)
    assert np.all(found[0] == 0)


def test_drifts_on_after_the_end(motion: ow.GroundMotion) -> None:
    """No acceleration, the last velocity, a displacement that grows with it."""
    end, later = motion.motion(np.array([3.0, 7.0]))[:, 0]
    assert np.all(later[2] == 0)
    assert later[1] == pytest.approx(end[1])
    assert later[0] == pytest.approx(end[0] + 4 * end[1])
    assert np.abs(end[1]).max() > 0.1


def test_parabola_brings_the_ground_to_rest() -> None:
    """Of a record with a slanting baseline: velocity ends at zero; what is taken off is a parabola;
    no other parabola that does so leaves a smaller mean square of the velocity."""
    clean = shaking(8.0, 0.02)
    slant = np.column_stack([0.05 + 0 * clean.time, 0.02 * clean.time, -0.01 * clean.time**2])
    crooked = replace(clean, acceleration=clean.acceleration + slant)
    mended = replace(crooked, baseline="parabolic")
    late = crooked.motion(clean.time[-1:])[0, 0, 1]
    assert np.abs(late).max() > 0.3
    assert np.abs(mended.motion(np.array([8.0, 20.0]))[:, 0, 1]).max() < 1e-12
    taken = crooked.acceleration - mended.corrected[0]
    assert np.abs(np.diff(taken, 3, axis=0)).max() < 1e-11
    assert np.abs(taken).max() > 0.03
    assert np.abs(mended.corrected[0] - clean.acceleration).max() < 0.05
    velocity = mended.motion(clean.time)[:, 0, 1]
    share = clean.time / 8.0
    for shape in (share - share**2, share**2 - share**3):  # velocities that begin and end at zero
        for amount in (-1e-3, 1e-3):
            other = velocity + amount * shape[:, None]
            assert np.all(np.mean(other**2, axis=0) > np.mean(velocity**2, axis=0))


def test_later_scaled_turned(motion: ow.GroundMotion) -> None:
    time = np.linspace(0, 5, 11)
    assert motion.later(0.5).motion(time + 0.5) == pytest.approx(motion.motion(time))
    assert motion.scaled(-2.0).motion(time) == pytest.approx(-2 * motion.motion(time))
    turned = motion.turned(np.pi / 2).motion(time)
    assert turned[..., 1] == pytest.approx(motion.motion(time)[..., 0], abs=1e-12)
    assert turned[..., 0] == pytest.approx(-motion.motion(time)[..., 1], abs=1e-12)
    assert turned[..., 2] == pytest.approx(motion.motion(time)[..., 2], abs=1e-12)


def gapped() -> ow.GroundMotion:
    record = shaking(2.0, 0.02)
    time = record.time.copy()
    time[50:] += 0.5
    return replace(record, time=time)


FAULTS: dict[str, tuple[Callable[[], object], str]] = {
    "empty": (lambda: ow.GroundMotion(np.zeros(0), np.zeros((0, 3))), "two samples or more"),
    "one sample": (lambda: ow.GroundMotion(np.zeros(1), np.zeros((1, 3))), "two samples or more"),
    "two components": (lambda: ow.GroundMotion(np.arange(4), np.zeros((4, 2))), "three components"),
    "lengths": (lambda: ow.GroundMotion(np.arange(4), np.zeros((5, 3))), "Give three"),
    "not a number": (
        lambda: ow.GroundMotion(np.arange(4), np.full((4, 3), np.nan)),
        "acceleration.*finite",
    ),
    "words": (lambda: ow.GroundMotion(["a", "b"], np.zeros((2, 3))), "time.*finite"),
    "infinite time": (
        lambda: ow.GroundMotion(np.array([0, np.inf]), np.zeros((2, 3))),
        "time.*finite",
    ),
    "times that fall": (
        lambda: ow.GroundMotion(np.array([0, 2.0, 1.0]), np.zeros((3, 3))),
        "1 s after 2 s",
    ),
    "repeated time": (
        lambda: ow.GroundMotion(np.array([0, 1.0, 1.0]), np.zeros((3, 3))),
        "rising times",
    ),
    "gap": (gapped, "a step of 0.52 s"),
    "cm/s2": (lambda: shaking().scaled(100.0), "cm/s2"),
    "levels without heights": (
        lambda: ow.GroundMotion(np.arange(4), np.zeros((2, 4, 3))),
        "acceleration \\(2, 4, 3\\)",
    ),
    "heights that fall": (
        lambda: ow.GroundMotion(np.arange(4), np.zeros((2, 4, 3)), np.array([0.0, -5.0])),
        "rising heights",
    ),
    "unknown baseline": (
        lambda: ow.GroundMotion(np.arange(4), np.zeros((4, 3)), baseline="cubic"),
        "none or parabolic",
    ),
}


@pytest.mark.parametrize("fault", FAULTS)
def test_bad_motions(fault: str) -> None:
    make, told = FAULTS[fault]
    with pytest.raises(ow.InputError, match=told):
        make()


def test_bad_motions_of_a_simulation(clamped_dry: ow.System, coarse: ow.System) -> None:
    """No motion at all, one that comes too late, levels that do not reach the toe."""
    with pytest.raises(ow.InputError, match="a GroundMotion or None"):
        ow.simulate(clamped_dry, 1.0, 0.05, ground_motion=np.zeros((20, 3)))
    with pytest.raises(ow.InputError, match="a start at 3 s"):
        ow.simulate(clamped_dry, 1.0, 0.05, ground_motion=shaking().later(3.0))
    shallow = ow.GroundMotion(np.arange(4), np.zeros((2, 4, 3)), np.array([-40.0, -20.0]))
    with pytest.raises(ow.InputError, match=r"from z = -40 to -20 m.*z = -75 m.*mudline"):
        ow.simulate(coarse, 1.0, 0.05, ground_motion=shallow)


def test_cautions(caplog: pytest.LogCaptureFixture, clamped_dry: ow.System) -> None:
    """Each on its own, told in the log and in the results; a good record has none."""
    good = shaking(6.0, 0.01)
    assert ground_motion_cautions(good, 0.01, 10.0) == []

    def told(motion: ow.GroundMotion, dt: float = 0.01, duration: float = 10.0) -> str:
        (caution,) = ground_motion_cautions(motion, dt, duration)
        return caution

    assert "skip samples" in told(good, dt=0.02)
    assert "ends at 6 s" in told(good, duration=5.0)
    assert "begins at -1 s" in told(good.later(-1.0))
    assert "coarse" in told(shaking(6.0, 0.05))
    drifting = replace(good, acceleration=good.acceleration + np.array([0.05, 0, 0]))
    assert "still moves at 0.3" in told(drifting)
    assert "only zeros" in told(good.scaled(0.0))
    crooked = replace(drifting, baseline="parabolic").scaled(0.1)
    assert ground_motion_cautions(crooked, 0.01, 10.0) == []
    crooked = replace(good, acceleration=good.acceleration + 0.6, baseline="parabolic")
    assert "removes 18%" in told(crooked)
    data = ow.simulate(clamped_dry, 0.2, 0.1, ground_motion=good.later(-3.0))
    assert "skip samples" in caplog.text
    assert "ends at 3 s" in data.attrs["ground_motion_cautions"]


def test_units_are_guessed() -> None:
    """Peaks beyond what the ground does, or too weak to be analysed."""
    record = shaking().acceleration  # 3 m/s2
    for unit in ("m_per_s2", "cm_per_s2", "g"):
        assert unit_cautions(record, unit) == []
    assert "in cm/s2?" in unit_cautions(9.8 * record, "m_per_s2")[0]
    assert "in m/s2 or cm/s2?" in unit_cautions(9.80665 * record, "g")[0]
    assert "in g?" in unit_cautions(record / 9.80665, "m_per_s2")[0]
    assert "in m/s2 or g?" in unit_cautions(record / 100, "cm_per_s2")[0]
    assert unit_cautions(0 * record, "g") == []


def columns(path: Path, values: Array, head: str = "# t, accelerations\n") -> Path:
    path.write_text(head + "\n".join(" ".join(f"{v!r}" for v in row) for row in values.tolist()))
    return path


def test_columns(tmp_path: Path) -> None:
    """Axes and unit as told; comments and separators do not matter."""
    table = np.array([[0, 0.1, 0.2], [0.01, -0.3, 0.0], [0.02, 0.0, 0.1]])
    record = read_columns(columns(tmp_path / "a.txt", table), "g", ("z", "x"))
    assert record.time == pytest.approx(table[:, 0])
    assert record.acceleration[:, 2] == pytest.approx(9.80665 * table[:, 1])
    assert record.acceleration[:, 0] == pytest.approx(9.80665 * table[:, 2])
    assert np.all(record.acceleration[:, 1] == 0)
    assert record.origin.startswith("a.txt (SHA-256 ")
    (tmp_path / "b.csv").write_text("! made\n0;1\n0.5, 2 % end\n\n1\t3")
    record = read_columns(tmp_path / "b.csv", "cm_per_s2", ("y",))
    assert record.acceleration[:, 1] == pytest.approx([0.01, 0.02, 0.03])


NEW_HEAD = (
    "PEER NGA STRONG MOTION DATABASE RECORD\nSomewhere, 1/1/2000, Station, 90\n"
    "ACCELERATION TIME SERIES IN UNITS OF {unit}\nNPTS={count:7d}, DT=   {step} SEC\n"
)
OLD_HEAD = (
    "PEER STRONG MOTION DATABASE RECORD\nSOMEWHERE 01/01/00, STATION, 090\n"
    "ACCELERATION TIME HISTORY IN UNITS OF {unit}. FILTER POINTS: HP=0.1 Hz LP=20 Hz\n"
    " {count}    {step}    NPTS, DT\n"
)


def at2(
    path: Path, values: Array, head: str = NEW_HEAD, count: int | None = None, **how: str
) -> Path:
    settings = {"unit": "G", "step": ".0050", "count": len(values) if count is None else count}
    rows = [values[i : i + 5] for i in range(0, len(values), 5)]
    text = "\n".join("".join(f"{v:15.7E}" for v in row) for row in rows)
    path.write_text(head.format(**(settings | how)) + text + "\n")
    return path


@pytest.mark.parametrize("head", [NEW_HEAD, OLD_HEAD])
def test_at2(tmp_path: Path, head: str) -> None:
    """Either header; several samples in a line, the last one shorter."""
    values = np.linspace(-0.2, 0.3, 13)
    step, acceleration, _ = read_at2(at2(tmp_path / "a.AT2", values, head))
    assert step == 0.005
    assert acceleration == pytest.approx(9.80665 * values, rel=1e-6)


AT2_HEADS = {
    "lower case": "NPTS= {count}, dt= {step}, sec",
    "no blanks": "NPTS={count},DT={step}SEC",
    "no comma": "NPTS=  {count}   DT=   {step} SEC",
    "comma behind": "NPTS=   {count}, DT=   {step} SEC,",
    "interval first": "DT= {step} SEC, NPTS= {count}",
    "colons": "Npts: {count} Dt: {step} s",
    "numbers first": "  {count}    {step}    NPTS, DT",
    "numbers first, lower case": "{count} {step} npts,dt",
}


@pytest.mark.parametrize("head", AT2_HEADS)
def test_at2_headers(tmp_path: Path, head: str) -> None:
    """Spellings of the header's last line."""
    whole = "\n".join([*NEW_HEAD.splitlines()[:3], AT2_HEADS[head]]) + "\n"
    values = np.linspace(-0.2, 0.3, 13)
    step, acceleration, _ = read_at2(at2(tmp_path / "a.AT2", values, whole))
    assert (step, len(acceleration)) == (0.005, 13)


AT2_UNITS = {"G": 9.80665, "g": 9.80665, "G'S": 9.80665, "g's": 9.80665, "(g)": 9.80665} | {
    "cm/s2": 0.01,
    "CM/SEC/SEC": 0.01,
    "cm/sec**2": 0.01,
    "CM/S^2": 0.01,
    "cm/s/s": 0.01,
    "gal": 0.01,
    "Gals": 0.01,
    "m/s2": 1.0,
    "M/SEC2": 1.0,
    "mm/s2": 1e-3,
    "in/s2": 0.0254,
    "IN/SEC/SEC": 0.0254,
    "ft/s2": 0.3048,
}


@pytest.mark.parametrize("unit", AT2_UNITS)
def test_at2_units(tmp_path: Path, unit: str) -> None:
    """Every unit in any case is read as itself, and none as g in silence."""
    head = NEW_HEAD.replace("UNITS OF", "units of") if unit.islower() else NEW_HEAD
    _, acceleration, _ = read_at2(at2(tmp_path / "a.AT2", np.full(4, 0.5), head, unit=unit))
    assert acceleration == pytest.approx(0.5 * AT2_UNITS[unit], rel=1e-12)


def test_at2_closing_line(tmp_path: Path) -> None:
    """Text behind the last sample is no sample; numbers there are too many."""
    path = at2(tmp_path / "a.AT2", np.full(7, 0.1))
    whole = path.read_text()
    path.write_text(whole + "\n-- end of record 7 --\n")
    assert len(read_at2(path)[1]) == 7
    path.write_text(whole + "0.1\n")
    with pytest.raises(ow.InputError, match="8 samples, 7"):
        read_at2(path)


def test_at2_components_of_different_length(tmp_path: Path) -> None:
    """The shorter one is followed by zeros."""
    files = {
        "x": at2(tmp_path / "x.AT2", np.full(7, 0.1)),
        "z": at2(tmp_path / "z.AT2", np.full(5, 0.2)),
    }
    record = read_at2_components(files)
    assert record.time == pytest.approx(0.005 * np.arange(7))
    assert np.count_nonzero(record.acceleration, axis=0).tolist() == [7, 0, 5]


FILE_FAULTS: dict[str, tuple[Callable[[Path], object], str]] = {
    "missing": (lambda p: read_columns(p / "none.txt", "g", ("x",)), "no such file"),
    "empty": (lambda p: read_columns(columns(p / "a", np.zeros((0, 2))), "g", ("x",)), "0 rows"),
    "columns": (
        lambda p: read_columns(columns(p / "a", np.zeros((3, 3))), "g", ("x",)),
        "line 2.*3 cells",
    ),
    "word": (
        lambda p: read_columns(columns(p / "a", np.zeros((1, 2)), "0 fast\n"), "g", ("x",)),
        "line 1, column 2.*fast",
    ),
    "times": (
        lambda p: read_columns(columns(p / "a", np.zeros((3, 2))), "g", ("x",)),
        "line 3.*later than",
    ),
    "gap": (
        lambda p: read_columns(
            columns(p / "a", np.column_stack([np.append(np.arange(30), 60), np.zeros(31)])),
            "g",
            ("x",),
        ),
        "a step of 31 s",
    ),
    "axis twice": (lambda p: read_columns(p / "a", "g", ("x", "x")), "each once"),
    "no axis": (lambda p: read_columns(p / "a", "g", ()), "one to three"),
    "no header": (lambda p: read_at2(columns(p / "a", np.zeros((9, 2)))), "NPTS and DT"),
    "velocity": (lambda p: read_at2(at2(p / "a", np.zeros(9), unit="CM/SEC")), "CM/SEC"),
    "no unit": (
        lambda p: read_at2(at2(p / "a", np.zeros(9), NEW_HEAD.replace("IN UNITS OF", "in"))),
        "no unit.*G",
    ),
    "unknown unit": (
        lambda p: read_at2(at2(p / "a", np.zeros(9), unit="furlongs")),
        "furlongs.*IN/S2",
    ),
    "ms": (
        lambda p: read_at2(at2(p / "a", np.zeros(9), NEW_HEAD.replace("SEC", "MSEC"))),
        "DT in MSEC",
    ),
    "word among samples": (
        lambda p: read_at2(
            columns(
                p / "a", np.zeros((1, 2)), NEW_HEAD.format(unit="G", count=2, step=".1") + "x\n"
            )
        ),
        "line 5, column 1",
    ),
    "times in ms": (
        lambda p: read_columns(
            columns(p / "a", np.column_stack([5.0 * np.arange(30), np.zeros(30)])), "g", ("x",)
        ),
        "in ms",
    ),
    "truncated": (lambda p: read_at2(at2(p / "a", np.zeros(9), count=12)), "9 samples, 12"),
    "zero step": (lambda p: read_at2(at2(p / "a", np.zeros(9), step="0.0")), "positive interval"),
    "steps": (
        lambda p: read_at2_components(
            {"x": at2(p / "a", np.zeros(9)), "y": at2(p / "b", np.zeros(9), step=".01")}
        ),
        "one interval",
    ),
}


@pytest.mark.parametrize("fault", FILE_FAULTS)
def test_bad_files(fault: str, tmp_path: Path) -> None:
    read, told = FILE_FAULTS[fault]
    with pytest.raises(ow.InputError, match=told):
        read(tmp_path)
