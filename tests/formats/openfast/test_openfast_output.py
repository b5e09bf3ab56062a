"""OpenFAST's output in all its formats, and what becomes of its channels."""

import struct
from pathlib import Path

import numpy as np
import pytest
from helpers.openfast_files import UNITS, YAW_BEARING, some_load, write_out, write_outb
from numpy.testing import assert_allclose, assert_array_equal

import offwind_pin as ow
from offwind_pin.definitions.rotor_nacelle import lump_rna, rotor_apex
from offwind_pin.formats.openfast.output import read_openfast_output
from offwind_pin.formats.openfast.units import ANGLE, FORCE, MOMENT, si_factor
from offwind_pin.formats.openfast.warnings import load_cautions
from offwind_pin.formats.openfast.yaw_bearing_load import (
    ROTOR_APEX,
    changed,
    from_channels,
    from_rotor_apex,
    resampling_notes,
    superpose,
    weight_at_yaw_bearing,
)
from offwind_pin.formats.openfast.yaw_bearing_load import YAW_BEARING as DEFAULT

TIME = np.arange(0, 30, 0.05)
IN_SI = np.array([1e3] * 6)


@pytest.mark.parametrize("kind", [1, 2, 3, 4])
def test_four_binary_formats(tmp_path: Path, kind: int) -> None:
    """Each gives back what its packing left, in N and N m, and the times."""
    path = tmp_path / "run.outb"
    left = write_outb(path, kind, TIME, YAW_BEARING, UNITS, some_load(TIME))
    history = from_channels(read_openfast_output(path), DEFAULT)
    assert_allclose(history.time, TIME, atol=1e-6)
    assert_allclose(history.load, left * IN_SI, rtol=1e-12, atol=1e-6)
    span = np.ptp(some_load(TIME), axis=0)
    assert np.all(np.abs(history.load / 1e3 - some_load(TIME)) <= span / 5e4 + 1e-3)
    assert "run.outb" in history.origin
    assert "YawBrFxp" in history.origin


def test_text_format(tmp_path: Path) -> None:
    """The text has header lines, names, units and rows; names are found in any case."""
    path = tmp_path / "run.out"
    write_out(path, TIME, YAW_BEARING, UNITS, some_load(TIME))
    output = read_openfast_output(path)
    assert_allclose(
        from_channels(output, DEFAULT).load, 1e3 * some_load(TIME), rtol=1e-8, atol=1e-3
    )
    assert_allclose(output.channel("yawbrfxp", FORCE), 1e3 * some_load(TIME)[:, 0], rtol=1e-8)


def test_chosen_channels(tmp_path: Path) -> None:
    """Components that name no channel are zero; units are read channel by channel."""
    path = tmp_path / "run.out"
    data = np.column_stack([TIME, 2 * TIME, 3 * TIME])
    write_out(path, TIME, ["RotThrust", "TwrBsMyt", "Other"], ["(MN)", "(N·m)", "(N)"], data)
    history = from_channels(read_openfast_output(path), {"Fx": "RotThrust", "My": "TwrBsMyt"})
    assert_allclose(history.load[:, 0], 1e6 * TIME)
    assert_allclose(history.load[:, 4], 2 * TIME)
    assert np.all(history.load[:, [1, 2, 3, 5]] == 0)


def test_older_files_in_latin_1(tmp_path: Path) -> None:
    """Their kN·m is a byte that is no UTF-8, in text and binary."""
    old = [*UNITS[:3], *["(kN.m)"] * 3]
    text, packed = tmp_path / "run.out", tmp_path / "run.outb"
    write_out(text, TIME, YAW_BEARING, old, some_load(TIME))
    write_outb(packed, 3, TIME, YAW_BEARING, old, some_load(TIME))
    for path in (text, packed):
        path.write_bytes(path.read_bytes().replace(b"kN.m", b"kN\xb7m"))
        output = read_openfast_output(path)
        assert output.unit[3] == "(kN·m)"
        assert_allclose(output.channel("YawBrMyp", MOMENT), 1e3 * some_load(TIME)[:, 4], rtol=1e-8)


@pytest.mark.parametrize(
    ("unit", "kind", "factor"),
    [
        ("(kN)", FORCE, 1e3),
        ("N", FORCE, 1.0),
        ("[MN]", FORCE, 1e6),
        ("(kN-m)", MOMENT, 1e3),
        ("(kN·m)", MOMENT, 1e3),
        ("kN m", MOMENT, 1e3),
        ("kN*m", MOMENT, 1e3),
        ("(MN-m)", MOMENT, 1e6),
        ("(N-m)", MOMENT, 1.0),
        ("(deg)", ANGLE, np.pi / 180),
        ("(rad)", ANGLE, 1.0),
    ],
)
def test_units(unit: str, kind: str, factor: float) -> None:
    """Spellings of one unit are one unit."""
    assert si_factor("here", unit, kind) == pytest.approx(factor, rel=1e-15)


@pytest.mark.parametrize(
    ("unit", "kind"),
    [("(kip)", FORCE), ("(mN)", FORCE), ("(kN)", MOMENT), ("(-)", ANGLE), ("", FORCE)],
)
def test_unknown_units_are_refused(unit: str, kind: str) -> None:
    """Neither a unit that is not known nor one of another kind is guessed; mN is not MN."""
    with pytest.raises(ow.InputError, match="unit"):
        si_factor("here", unit, kind)


def binary(tmp_path: Path, kind: int = 2) -> tuple[Path, bytes]:
    path = tmp_path / "run.outb"
    write_outb(path, kind, TIME, YAW_BEARING, UNITS, some_load(TIME))
    return path, path.read_bytes()


@pytest.mark.parametrize("kind", [1, 2, 3, 4])
def test_truncated_anywhere(tmp_path: Path, kind: int) -> None:
    """Wherever the file ends, the message says that it is truncated, and nothing else is raised."""
    path, whole = binary(tmp_path, kind)
    header = len(whole) - len(TIME) * 6 * (8 if kind == 3 else 2)
    for length in [*range(0, header, 7), header + 1, len(whole) - 1]:
        path.write_bytes(whole[:length])
        with pytest.raises(ow.InputError, match="truncated"):
            read_openfast_output(path)


@pytest.mark.parametrize(
    ("place", "raw", "told"),
    [
        (0, struct.pack("<h", 9), "FileID"),
        (0, struct.pack("<h", 0), "FileID"),
        (2, struct.pack("<i", -1), "number of channels"),
        (2, struct.pack("<i", 2**30), "number of channels"),
        (6, struct.pack("<i", -5), "number of time steps"),
        (6, struct.pack("<i", 1), "number of time steps"),
        (10, struct.pack("<d", float("nan")), "time"),
        (18, struct.pack("<d", -0.1), "time step"),
        (18, struct.pack("<d", 0.0), "time step"),
        (26, struct.pack("<f", 0.0), "YawBrFxp.*slope"),
        (26, struct.pack("<f", float("inf")), "YawBrFxp.*slope"),
        (50, struct.pack("<f", float("nan")), "YawBrFxp.*offset"),
        (74, struct.pack("<i", -1), "description"),
        (74, struct.pack("<i", 2**31 - 1), "description"),
        (100, b"\x80", "names"),
        (100, b"\x07", "names"),
    ],
)
def test_header_fields_are_checked(tmp_path: Path, place: int, raw: bytes, told: str) -> None:
    """Every field of the header, out of its bounds, is named."""
    path, whole = binary(tmp_path)
    path.write_bytes(whole[:place] + raw + whole[place + len(raw) :])
    with pytest.raises(ow.InputError, match=told):
        from_channels(read_openfast_output(path), DEFAULT)


def test_many_steps_are_not_reserved(tmp_path: Path) -> None:
    """A header that promises a billion steps costs no memory before the file is found too short."""
    path, whole = binary(tmp_path)
    path.write_bytes(whole[:6] + struct.pack("<i", 10**9) + whole[10:])
    with pytest.raises(ow.InputError, match="truncated"):
        read_openfast_output(path)


@pytest.mark.parametrize("kind", [1, 2, 3, 4])
def test_bytes_of_a_longer_file(
    tmp_path: Path, kind: int, caplog: pytest.LogCaptureFixture
) -> None:
    """A complete file that was written over a longer one is read as without the rest of that."""
    path, whole = binary(tmp_path, kind)
    alone = from_channels(read_openfast_output(path), DEFAULT)
    assert not caplog.records
    path.write_bytes(whole + whole[:1001])
    assert_array_equal(from_channels(read_openfast_output(path), DEFAULT).load, alone.load)
    assert "1001 bytes" in caplog.text


@pytest.mark.parametrize("spoilt", ["nan", "********", "-Infinity", "1.#QNAN", "4_0"])
def test_spoilt_channel_of_a_text_file(tmp_path: Path, spoilt: str) -> None:
    """What is no number matters in a channel that is asked for, and in the time, alone."""
    path = tmp_path / "run.out"
    write_out(
        path,
        TIME,
        [*YAW_BEARING, "Other"],
        [*UNITS, "(kN)"],
        np.column_stack([some_load(TIME), TIME]),
    )
    text = path.read_text()
    lines = text.splitlines()
    cells = lines[20].split("\t")
    lines[20] = "\t".join([*cells[:-1], spoilt])
    path.write_text("\n".join(lines) + "\n")
    output = read_openfast_output(path)
    assert_allclose(
        from_channels(output, DEFAULT).load, 1e3 * some_load(TIME), rtol=1e-8, atol=1e-3
    )
    with pytest.raises(ow.InputError, match="Other, line 21"):
        output.channel("Other", FORCE)
    lines[20] = "\t".join([spoilt, *cells[1:]])
    path.write_text("\n".join(lines) + "\n")
    with pytest.raises(ow.InputError, match="line 21, column 1"):
        read_openfast_output(path)


def test_exponents_of_three_digits(tmp_path: Path) -> None:
    """Fortran leaves their letter out."""
    path = tmp_path / "run.out"
    write_out(path, TIME, ["Fx"], ["(N)"], np.full((len(TIME), 1), 2.0))
    path.write_text(path.read_text().replace("2.000000000E+00", "2.000000000-101", 1))
    values = read_openfast_output(path).channel("Fx", FORCE)
    assert values[0] == 2e-101
    assert np.all(values[1:] == 2.0)


@pytest.mark.parametrize("kind", [1, 2, 4])
def test_bad_scaling_of_another_channel(tmp_path: Path, kind: int) -> None:
    """A slope of 0 spoils its own channel alone."""
    path = tmp_path / "run.outb"
    names, units = ["Other", *YAW_BEARING], ["(kN)", *UNITS]
    left = write_outb(path, kind, TIME, names, units, np.column_stack([TIME, some_load(TIME)]))
    whole = bytearray(path.read_bytes())
    at = 28 if kind == 4 else 26
    assert struct.unpack("<f", whole[at : at + 4])[0] != 0
    whole[at : at + 4] = struct.pack("<f", 0.0)
    path.write_bytes(bytes(whole))
    output = read_openfast_output(path)
    load = from_channels(output, DEFAULT).load
    assert_allclose(load, left[:, 1:] * IN_SI, rtol=1e-12, atol=1e-6)
    with pytest.raises(ow.InputError, match=r"Other.*slope of 0"):
        output.channel("Other", FORCE)


def test_channels_of_one_name(tmp_path: Path) -> None:
    """Neither of two is taken in silence; others can be used."""
    path = tmp_path / "run.out"
    data = np.column_stack([TIME, 2 * TIME, 3 * TIME])
    write_out(path, TIME, ["Fx", "Fy", "FX"], ["(N)"] * 3, data)
    output = read_openfast_output(path)
    with pytest.raises(ow.InputError, match="Fx: got 2 of that name, columns 2, 4"):
        output.channel("Fx", FORCE)
    assert_allclose(output.channel("Fy", FORCE), 2 * TIME)


def test_closing_line(tmp_path: Path) -> None:
    """Modules that write a file of their own end it with a line of text."""
    path = tmp_path / "run.out"
    write_out(path, TIME, YAW_BEARING, UNITS, some_load(TIME))
    alone = read_openfast_output(path).packed
    with path.open("a") as file:
        file.write("\nThis output file was closed on 03-Feb-2023 at 10:11:12.\n")
    assert_array_equal(read_openfast_output(path).packed, alone)


@pytest.mark.parametrize(
    ("change", "told"),
    [
        (lambda text: "", "no line that starts with Time"),
        (lambda text: text.replace("Time", "Zeit"), "no line that starts with Time"),
        (lambda text: text.replace("(kN)\t", "", 1), "6 units"),
        (lambda text: text[: text.index("(s)")], "Time"),
        (lambda text: text[:-2], "truncated"),
        (lambda text: text[:-25], "6 cells"),
        (lambda text: text.replace("    0.1000", "       NaN"), "line 11, column 1"),
        (lambda text: text.replace("    0.1000", "    0.0500"), "line 11, column t"),
        (lambda text: text.replace("(kN)", "(kp)", 1), "YawBrFxp, unit"),
    ],
)
def test_bad_text(tmp_path: Path, change: object, told: str) -> None:
    """What is wrong with a text file is told with its line or channel."""
    path = tmp_path / "run.out"
    write_out(path, TIME, YAW_BEARING, UNITS, some_load(TIME))
    path.write_text(change(path.read_text()))  # type: ignore[operator]
    with pytest.raises(ow.InputError, match=told):
        from_channels(read_openfast_output(path), DEFAULT)


def test_gap_and_unknown_channel(tmp_path: Path) -> None:
    """Missing rows are told with the lines around them, a misspelt channel with its neighbours."""
    path = tmp_path / "run.out"
    keep = np.r_[0:100, 140 : len(TIME)]
    write_out(path, TIME[keep], YAW_BEARING, UNITS, some_load(TIME)[keep])
    with pytest.raises(ow.InputError, match=r"lines 108 to 109.*2\.05 s"):
        from_channels(read_openfast_output(path), DEFAULT)
    write_out(path, TIME, YAW_BEARING, UNITS, some_load(TIME))
    with pytest.raises(ow.InputError, match="Is it YawBrFxp"):
        from_channels(read_openfast_output(path), {"Fx": "YawBrFx"})


def test_a_run_that_diverged(tmp_path: Path) -> None:
    """Loads that no turbine gives, and values that are no numbers, are told with their step."""
    for value, told in ((1e9, "time step 31, Fy"), (np.nan, "YawBrFyp, time step 31")):
        data = some_load(TIME)
        data[30, 1] = value
        path = tmp_path / "run.outb"
        write_outb(path, 3, TIME, YAW_BEARING, UNITS, data)
        with pytest.raises(ow.InputError, match=told):
            from_channels(read_openfast_output(path), DEFAULT)


def test_gap_in_seven_columns(tmp_path: Path) -> None:
    """The same in a file of seven columns; a short table of corners may be as uneven as it likes."""
    path = tmp_path / "loads.txt"
    rows = [f"{t} 1e6 0 0 0 0 0" for t in [*range(30), *range(40, 60)]]
    path.write_text("\n".join(rows))
    with pytest.raises(ow.InputError, match="lines 30 to 31"):
        ow.read_load_history(path)
    path.write_text("0 1e6 0 0 0 0 0\n1 1e6 0 0 0 0 0\n600 1e6 0 0 0 0 0\n")
    assert len(ow.read_load_history(path).time) == 3


def test_apex_load_moves_to_the_yaw_bearing(oc6: ow.Turbine, tmp_path: Path) -> None:
    """A constant force at the apex, seen from a hub that turns, is a constant one at the bearing."""
    apex, shaft = rotor_apex(oc6.rna)
    upright, across = np.array([-shaft[2], 0.0, shaft[0]]), np.array([0.0, 1.0, 0.0])
    force, moment = np.array([9e5, 3e4, -2e4]), np.array([4e6, 1e6, -5e5])
    azimuth = np.mod(0.9 * TIME, 2 * np.pi)
    turned_y = np.cos(azimuth)[:, None] * across + np.sin(azimuth)[:, None] * upright
    turned_z = -np.sin(azimuth)[:, None] * across + np.cos(azimuth)[:, None] * upright

    def seen(vector: np.ndarray) -> list[np.ndarray]:
        return [np.full(len(TIME), vector @ shaft), turned_y @ vector, turned_z @ vector]

    data = np.column_stack([*seen(force), *seen(moment)]) / 1e3
    path = tmp_path / "run.out"
    names = [*ROTOR_APEX.values(), "Azimuth"]
    write_out(path, TIME, names, [*UNITS, "(deg)"], np.column_stack([data, np.degrees(azimuth)]))
    output = read_openfast_output(path)
    history = from_rotor_apex(output, ROTOR_APEX, "Azimuth", oc6.rna)
    expected = np.concatenate([force, moment + np.cross(apex, force)])
    assert_allclose(history.load, np.tile(expected, (len(TIME), 1)), rtol=1e-6, atol=1.0)
    along = from_rotor_apex(output, {"Fx": "RtAeroFxh", "Mx": "RtAeroMxh"}, None, oc6.rna)
    assert_allclose(
        along.load[:, :3], np.tile((force @ shaft) * shaft, (len(TIME), 1)), rtol=1e-6, atol=1e-3
    )
    with pytest.raises(ow.InputError, match="azimuth_channel"):
        from_rotor_apex(output, ROTOR_APEX, None, oc6.rna)


def constant(*load: float) -> ow.LoadHistory:
    return ow.LoadHistory(np.array([0.0, 100.0]), np.array([load, load]), "test")


def test_weight_is_taken_off_once(oc6: ow.Turbine) -> None:
    """Weight and its moment, without the yaw bearing's own mass, leave what the air does."""
    body = lump_rna(oc6.rna)
    weight = weight_at_yaw_bearing(oc6.rna, 9.80665)
    bearing = oc6.rna.yaw_bearing_mass
    assert weight[2] == pytest.approx(-(body.mass - bearing) * 9.80665)
    assert weight[4] == pytest.approx(body.mass * 9.80665 * body.center_of_mass[0])
    history = constant(*(weight + np.array([1e6, 0, 0, 0, 5e6, 0])))
    left = changed(history, 1.0, 0.0, weight).load[0]
    assert_allclose(left, [1e6, 0, 0, 0, 5e6, 0], atol=1e-3)


def test_cautions(oc6: ow.Turbine) -> None:
    """kN for N, a thousand too much, and the weight are each told; a sound load is not."""
    gravity = 9.80665
    weight = weight_at_yaw_bearing(oc6.rna, gravity)[2]
    told = {
        "kN": constant(1000, 0, 0, 0, 0, 0),
        "twice": constant(1e9, 0, 0, 0, 0, 0),
        "subtract_weight": constant(1e6, 0, 1.02 * weight, 0, 0, 0),
    }
    for word, history in told.items():
        found = load_cautions(history, oc6.rna, gravity)
        assert len(found) == 1
        assert word in found[0]
    for sound in (
        constant(1e6, 0, 0, 0, 0, 0),
        constant(2e4, 0, -1e5, 0, 0, 0),
        constant(*[0.0] * 6),
    ):
        assert load_cautions(sound, oc6.rna, gravity) == []


def test_superposition() -> None:
    """Histories add up over the time that all cover, the coarser one interpolated, and that is told."""
    fine = ow.LoadHistory(np.arange(0, 10.01, 0.1), np.ones((101, 6)), "fine")
    ramp = np.arange(2.0, 13.0)
    coarse = ow.LoadHistory(ramp, np.tile(ramp[:, None], (1, 6)), "coarse")
    total, notes = superpose([fine, changed(coarse, 2.0, -1.0, None)])
    assert total.time[0] == 1.0
    assert total.time[-1] == pytest.approx(10.0)
    assert_allclose(total.load[:, 0], 1 + 2 * (total.time + 1), rtol=1e-12)
    assert len(notes) == 1
    assert "coarse, times 2, -1 s later: step 1 s" in notes[0]
    same, none = superpose([fine, fine])
    assert none == []
    assert_allclose(same.load, 2)
    with pytest.raises(ow.InputError, match="overlap"):
        superpose([fine, changed(fine, 1.0, 50.0, None)])


def test_resampling_is_told() -> None:
    """A step other than dt is noted; one too coarse for 1.5 Hz, or much finer than dt, is a caution."""

    def sampled(step: float) -> ow.LoadHistory:
        return ow.LoadHistory(step * np.arange(50), np.ones((50, 6)), f"{step}")

    assert resampling_notes(sampled(0.02), 0.02) == ([], [])
    notes, cautions = resampling_notes(sampled(0.05), 0.02)
    assert len(notes) == 1
    assert cautions == []
    assert "attenuates" in resampling_notes(sampled(0.5), 0.02)[1][0]
    assert "aliased" in resampling_notes(sampled(0.005), 0.02)[1][0]


@pytest.mark.parametrize("kind", [1, 2, 3, 4])
def test_spoilt_bytes_are_read_or_refused(tmp_path: Path, kind: int) -> None:
    """Whatever stands in the header, the file is read to finite numbers or refused as input."""
    path, whole = binary(tmp_path, kind)
    rng = np.random.default_rng(kind)
    refused = 0
    for _ in range(300):
        spoilt = bytearray(whole)
        for place in rng.integers(0, 300, rng.integers(1, 4)):
            spoilt[place] = rng.integers(0, 256)
        path.write_bytes(bytes(spoilt))
        try:
            history = from_channels(read_openfast_output(path), DEFAULT)
        except ow.InputError:
            refused += 1
        else:
            assert np.all(np.isfinite(history.load))
            assert np.all(np.diff(history.time) > 0)
    assert 30 < refused < 300
