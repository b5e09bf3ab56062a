"""Bad input: exit status 2, one message that names file, field, value, what is allowed, remedy."""

from __future__ import annotations

import copy
from collections.abc import Callable
from importlib import resources
from pathlib import Path
from typing import Any

import pytest
import yaml

from offwind_pin import cli

Definition = dict[str, Any]

SHIPPED = yaml.safe_load(
    (resources.files("offwind_pin.definitions") / "library" / "oc6_phase2.yaml").read_text()
)
CASE = yaml.safe_load(
    (resources.files("offwind_pin.cases") / "oc6_phase2" / "lc5.1.yaml").read_text()
)


def _set(*path: str | int, to: Any) -> Callable[[Definition], None]:
    def change(data: Definition) -> None:
        target: Any = data
        for part in path[:-1]:
            target = target[part]
        target[path[-1]] = to

    return change


def _drop(*path: str | int) -> Callable[[Definition], None]:
    def change(data: Definition) -> None:
        target: Any = data
        for part in path[:-1]:
            target = target[part]
        del target[path[-1]]

    return change


def _reverse_stations(data: Definition) -> None:
    data["members"][1]["stations"].reverse()


def _table_of_curves(data: Definition) -> None:
    data["soil"]["distributed_springs"]["curve"] = {"kind": "table", "file": "curves.csv"}


def _rigid_rna(inertia: list[list[float]]) -> Callable[[Definition], None]:
    return _set(
        "rna",
        to={
            "kind": "rigid_body",
            "mass_kg": 8e5,
            "center_of_mass_m": [-5, 0, 3],
            "inertia_about_center_of_mass_kg_m2": inertia,
        },
    )


STATION = ("members", 1, "stations", 3)
SPRINGS = ("soil", "distributed_springs")

TURBINE_FAULTS: dict[str, tuple[Callable[[Definition], None], list[str]]] = {
    "missing field": (_drop("site", "water_depth_m"), ["site.water_depth_m", "required"]),
    "missing block": (_drop("rna"), ["field rna", "required"]),
    "unknown key": (
        _set("site", "water_dept_m", to=30),
        ["site.water_dept_m", "Did you mean 'water_depth_m'?"],
    ),
    "unknown key at the top": (_set("materal", to={}), ["materal", "'materials'"]),
    "key of another unit": (
        _set(*STATION, to={"z_m": 41.52, "diameter_mm": 7460, "thickness_m": 0.06}),
        ["diameter_mm", "Did you mean 'diameter_m'?"],
    ),
    "negative diameter": (
        _set(*STATION, "diameter_m", to=-7.46),
        ["diameter_m", "-7.46", "greater"],
    ),
    "zero thickness": (_set(*STATION, "thickness_m", to=0), ["thickness_m", "greater than 0"]),
    "thickness in mm": (_set(*STATION, "thickness_m", to=60), ["thickness_m", "60", "unit"]),
    "thickness larger than the radius": (
        _set(*STATION, to={"z_m": 41.52, "diameter_m": 1.0, "thickness_m": 0.6}),
        ["stations.3", "larger than the radius", "half the diameter"],
    ),
    "NaN": (_set(*STATION, "z_m", to=float("nan")), ["z_m", "nan", "finite"]),
    "infinite": (_set("site", "gravity_m_per_s2", to=float("inf")), ["gravity_m_per_s2", "finite"]),
    "true for a number": (
        _set("site", "water_depth_m", to=True),
        ["water_depth_m", "true or false"],
    ),
    "text for a number": (
        _set("site", "water_depth_m", to="thirty"),
        ["water_depth_m", "'thirty'", "valid number"],
    ),
    "list for a number": (_set("site", "water_depth_m", to=[30]), ["water_depth_m", "[30]"]),
    "unsorted stations": (_reverse_stations, ["members.1", "increase strictly", "sort"]),
    "repeated station": (
        _set(*STATION, "z_m", to=31.01),
        ["members.1", "two stations are at z_m = 31.01", "another member"],
    ),
    "a single station": (
        _set("members", 1, "stations", to=[{"z_m": 10, "diameter_m": 8, "thickness_m": 0.07}]),
        ["members.1.stations", "at least 2"],
    ),
    "gap between members": (
        _set("members", 0, "stations", 1, "z_m", to=9.0),
        ["starts at z_m = 10.0", "ends at 9.0"],
    ),
    "unknown material": (
        _set("members", 1, "material", to="stell"),
        ["'stell'", "materials", "steel"],
    ),
    "Young's modulus in GPa": (
        _set("materials", "steel", "youngs_modulus_pa", to=210),
        ["youngs_modulus_pa", "210", "unit"],
    ),
    "density in t/m3": (
        _set("materials", "steel", "density_kg_per_m3", to=8.5),
        ["density_kg_per_m3", "8.5", "unit"],
    ),
    "mudline below the pile toe": (
        _set("site", "water_depth_m", to=80),
        ["mudline", "-80", "pile toe", "-75", "reduce the water depth"],
    ),
    "point mass off the structure": (
        _set("point_masses", to=[{"name": "platform", "z_m": 300, "mass_kg": 1e4}]),
        ["'platform'", "300", "outside the structure"],
    ),
    "6x6 not symmetric": (
        _set("soil", "coupled_springs", "stiffness", 0, 4, to=5.0e10),
        ["coupled_springs", "not symmetric"],
    ),
    "6x6 not positive definite": (
        _set("soil", "coupled_springs", "stiffness", 2, 2, to=-1.0),
        ["coupled_springs", "not positive definite"],
    ),
    "6x6 with coupling of the other sign": (
        _set(
            "soil",
            "coupled_springs",
            "stiffness",
            to=[
                [2.0e9, 0, 0, 0, 2.0e10, 0],
                [0, 2.0e9, 0, -2.0e10, 0, 0],
                [0, 0, 1.0e10, 0, 0, 0],
                [0, -2.0e10, 0, 3.0e11, 0, 0],
                [2.0e10, 0, 0, 0, 3.0e11, 0],
                [0, 0, 0, 0, 0, 1.0e11],
            ],
        ),
        ["coupled_springs", "x-ry = 2e+10", "negative"],
    ),
    "6x6 with five rows": (
        _drop("soil", "coupled_springs", "stiffness", 5),
        ["coupled_springs.stiffness"],
    ),
    "unknown kind of curve": (
        _set(*SPRINGS, "curve", "kind", to="tahn"),
        ["distributed_springs.curve.kind", "linear, tanh, table"],
    ),
    "curve without stiffness": (
        _set(*SPRINGS, "curve", "initial_modulus_n_per_m2", to={"gradient": 0}),
        ["initial_modulus_n_per_m2", "both zero"],
    ),
    "one soil node": (_set(*SPRINGS, "nodes", to=1), ["nodes", "greater than or equal to 2"]),
    "negative damping factor": (
        _set(*SPRINGS, "dashpot", "damping_factor", to=-0.1),
        ["damping_factor", "-0.1"],
    ),
    "damping ratio in percent": (
        _set("structural_damping", "ratios_of_critical", "FA1", to=1.27),
        ["ratios_of_critical.FA1", "1.27", "less than 1"],
    ),
    "damping of an unknown mode": (
        _set("structural_damping", "ratios_of_critical", to={"XY1": 0.01}),
        ["ratios_of_critical", "XY1"],
    ),
    "inertia not symmetric": (
        _rigid_rna([[2e8, 1e6, 0], [0, 1e8, 0], [0, 0, 1.1e8]]),
        ["rna", "not symmetric"],
    ),
    "inertia of no rigid body": (
        _rigid_rna([[9e8, 0, 0], [0, 1e8, 0], [0, 0, 1.1e8]]),
        ["rna", "principal moments"],
    ),
    "blade table of unequal lengths": (
        _drop("rna", "blade", "mass_density_kg_per_m", 3),
        ["rna.blade", "span_fraction", "one density per"],
    ),
    "heights in mm": (_set(*STATION, "z_m", to=41520), ["z_m", "41520", "unit"]),
    "name that leaves the folder": (_set("name", to="../evil"), ["field name", "../evil"]),
    "member of a kept name": (_set("members", 1, "name", to="rna"), ["members are named", "rna"]),
    "weightless blades": (
        _set("rna", "blade", "mass_density_kg_per_m", to=[0.0] * 30),
        ["rna", "all zero"],
    ),
    "nacelle inertia about its own centre": (
        _set("rna", "nacelle_yaw_inertia_kg_m2", to=1e6),
        ["nacelle_yaw_inertia_kg_m2", "about the yaw axis"],
    ),
    "inertia of a mass that is not round": (
        _set(
            "point_masses",
            to=[{"name": "a", "z_m": 10, "mass_kg": 1, "inertia_kg_m2": [2e3, 0, 0]}],
        ),
        ["point_masses.0", "twice"],
    ),
    "damping ratio of zero": (
        _set("structural_damping", "ratios_of_critical", "FA1", to=0),
        ["ratios_of_critical.FA1", "greater than 0"],
    ),
    "missing table of curves": (_table_of_curves, ["curves.csv", "no such file"]),
}


def _complaint(argv: list[str], monkeypatch: pytest.MonkeyPatch, capsys: Any) -> str:
    """The one message of a refused command, after checking its form."""
    monkeypatch.setattr("sys.argv", ["offwind", *argv])
    with pytest.raises(SystemExit) as stop:
        cli.main()
    streams = capsys.readouterr()
    assert stop.value.code == 2, streams.err
    assert streams.out == ""
    assert "Traceback" not in streams.err
    assert len(streams.err.strip().splitlines()) == 1, streams.err
    return str(streams.err)


@pytest.mark.parametrize("fault", TURBINE_FAULTS)
def test_turbine_fault(
    fault: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: Any
) -> None:
    """Each fault of a turbine file is told with file, field and remedy, and nothing is written."""
    change, expected = TURBINE_FAULTS[fault]
    data = copy.deepcopy(SHIPPED)
    change(data)
    path = tmp_path / "turbine.yaml"
    path.write_text(yaml.safe_dump(data))
    out = tmp_path / "out"
    message = _complaint(["urdf", str(path), "--out", str(out)], monkeypatch, capsys)
    if fault != "missing table of curves":
        assert str(path) in message
    for text in expected:
        assert text in message
    assert not out.exists()


TEXT_FAULTS = {
    "empty file": ("", "empty file"),
    "truncated file": ("site: {water_depth_m: 30,\n", "line"),
    "key given twice": ("name: a\nname: b\n", "given twice"),
    "a list": ("- 1\n- 2\n", "mapping"),
    "nested without end": ("a: " + "[" * 100_000 + "\n", "levels of nesting"),
    "an alias bomb": (
        "a0: &a0 [x, x, x, x, x, x, x, x, x, x]\n"
        + "".join(f"a{i}: &a{i} [{', '.join([f'*a{i - 1}'] * 10)}]\n" for i in range(1, 30)),
        "aliases that expand",
    ),
    "an alias within itself": ("a: &a [1, *a]\n", "within its own anchor"),
    "a huge integer": ("a: " + "9" * 5000 + "\n", "5000 digits"),
    "two documents": ("a: 1\n---\na: 2\n", "document"),
    "a NUL": ("name: a\0b\n", "control characters"),
    "a set": ("materials: !!set {steel}\n", "the tag"),
    "a list as a key": ("? [1, 2]\n: 3\n", "key that is not a string"),
    "megabytes": ("# " + "x" * 3_000_000 + "\n", "at most"),
    "nested too deep": ("a: " + "[" * 3000 + "\n", "valid YAML"),
    "a Python object": ("name: !!python/object/apply:os.system ['true']\n", "valid YAML"),
}


@pytest.mark.parametrize("fault", TEXT_FAULTS)
def test_text_fault(
    fault: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: Any
) -> None:
    """A file that is no definition at all is refused with its name."""
    text, expected = TEXT_FAULTS[fault]
    path = tmp_path / "turbine.yaml"
    path.write_text(text)
    message = _complaint(["show", str(path)], monkeypatch, capsys)
    assert str(path) in message
    assert expected in message


def test_binary_file_is_refused(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: Any
) -> None:
    """A file that is not text is refused with its name."""
    path = tmp_path / "turbine.yaml"
    path.write_bytes(b"\xff\xfe\x00\x81")
    assert "UTF-8" in _complaint(["show", str(path)], monkeypatch, capsys)


CURVE_FAULTS = {
    "empty": ("", "no rows"),
    "header only": ("depth_m,y_m,p_n_per_m\n", "no rows"),
    "wrong header": ("z,y,p\n0,0,0\n", "header"),
    "text cell": ("depth_m,y_m,p_n_per_m\n0,0,0\n0,abc,5\n", "'abc'"),
    "missing cell": ("depth_m,y_m,p_n_per_m\n0,0,0\n0,0.1\n", "2 cells"),
    "not a number": ("depth_m,y_m,p_n_per_m\n0,0,0\n0,0.1,nan\n", "'nan'"),
    "negative": ("depth_m,y_m,p_n_per_m\n0,0,0\n0,0.1,-5\n", "positive side"),
    "unsorted": ("depth_m,y_m,p_n_per_m\n0,0.2,1\n0,0.1,2\n", "Sort"),
    "load at rest": ("depth_m,y_m,p_n_per_m\n0,0,5\n0,0.1,6\n", "origin"),
    "one point": ("depth_m,y_m,p_n_per_m\n0,0,0\n", "two points"),
}


@pytest.mark.parametrize("fault", CURVE_FAULTS)
def test_curve_table_fault(
    fault: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: Any
) -> None:
    """Each fault of a p-y table is told with the table's name."""
    text, expected = CURVE_FAULTS[fault]
    data = copy.deepcopy(SHIPPED)
    _table_of_curves(data)
    (tmp_path / "turbine.yaml").write_text(yaml.safe_dump(data))
    (tmp_path / "curves.csv").write_text(text)
    message = _complaint(["static", str(tmp_path / "turbine.yaml")], monkeypatch, capsys)
    assert "curves.csv" in message
    assert expected in message


HISTORY_FAULTS = {
    "empty": ("", "0 rows"),
    "comments only": ("# t Fx\n! more\n", "0 rows"),
    "one row": ("0 1 2 3 4 5 6\n", "1 rows"),
    "truncated row": ("0 1 2 3 4 5 6\n1 1 2 3\n", "4 cells"),
    "text cell": ("0 1 2 3 4 5 6\n1 1 2 x 4 5 6\n", "'x'"),
    "time stands still": ("0 1 2 3 4 5 6\n0 1 2 3 4 5 6\n", "Sort the rows by time"),
    "unit scale": ("0 1 2 3 4 5 6\n1 1 2 3 4 5e13 6\n", "units N and N m"),
    "too short": ("0 1 2 3 4 5 6\n100 1 2 3 4 5 6\n", "at least 660"),
}


@pytest.mark.parametrize("fault", HISTORY_FAULTS)
def test_load_history_fault(
    fault: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: Any
) -> None:
    """Each fault of a tower-top load file is told with its name, and nothing is written."""
    text, expected = HISTORY_FAULTS[fault]
    data = copy.deepcopy(CASE)
    data["tower_top_load"] = {"kind": "file", "file": "wind.txt"}
    (tmp_path / "case.yaml").write_text(yaml.safe_dump(data))
    (tmp_path / "wind.txt").write_text(text)
    argv = ["run", str(tmp_path / "case.yaml"), "--out", str(tmp_path / "out")]
    message = _complaint(argv, monkeypatch, capsys)
    assert "wind.txt" in message
    assert expected in message
    assert not (tmp_path / "out").exists()


CASE_FAULTS: dict[str, tuple[Callable[[Definition], None], str]] = {
    "unknown foundation": (_set("foundation", to="clampd"), "one of clamped"),
    "unknown key": (_set("fundation", to="clamped"), "'foundation'"),
    "unknown turbine": (_set("turbine", to="oc6_phase3"), "'oc6_phase2'"),
    "ramp longer than the case": (_set("analysis", "ramp_s", to=700), "ramp_s"),
    "step that does not divide": (_set("analysis", "dt_s", to=0.7), "multiple of dt"),
    "segment longer than the window": (_set("analysis", "psd_segment_s", to=900), "psd_segment_s"),
    "wave height in cm": (_set("sea", "significant_height_m", to=125), "unit"),
    "huge seed": (_set("seed", to=10**30), "seed"),
    "output too coarse": (_set("analysis", "output_dt_s", to=1.0), "output_dt_s"),
    "load that a static case would ignore": (
        _set("analysis", to={"kind": "static", "compare_with": "clamped"}),
        "tower_top_load",
    ),
    "negative seed": (_set("seed", to=-1), "seed"),
}


@pytest.mark.parametrize("fault", CASE_FAULTS)
def test_case_fault(
    fault: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: Any
) -> None:
    """Each fault of a case file is told, and nothing is written."""
    change, expected = CASE_FAULTS[fault]
    data = copy.deepcopy(CASE)
    change(data)
    (tmp_path / "case.yaml").write_text(yaml.safe_dump(data))
    argv = ["run", str(tmp_path / "case.yaml"), "--out", str(tmp_path / "out")]
    assert expected in _complaint(argv, monkeypatch, capsys)
    assert not (tmp_path / "out").exists()


COMMAND_FAULTS = {
    "unknown turbine": (["modes", "oc6_phase"], "Did you mean 'oc6_phase2'?"),
    "missing file": (["modes", "nowhere.yaml"], "nowhere.yaml"),
    "unknown foundation": (["modes", "oc6_phase2", "--foundation", "clamp"], "clamped"),
    "unknown case": (["run", "oc6-lc5.2", "--out", "x"], "oc6-lc5.1"),
    "five load components": (["static", "oc6_phase2", "--tower-top-load", "1,2,3,4,5"], "six"),
    "load that is no number": (["static", "oc6_phase2", "--tower-top-load", "a,0,0,0,0,0"], "six"),
    "too few elements": (["modes", "oc6_phase2", "--elements", "1"], "at least 3"),
    "too many modes": (["modes", "oc6_phase2", "--count", "1000"], "1 to"),
    "no modes": (["modes", "oc6_phase2", "--count", "0"], "1 to"),
    "unknown mode": (["animate", "oc6_phase2", "--mode", "FA99", "--html", "x.html"], "FA1"),
}


@pytest.mark.parametrize("fault", COMMAND_FAULTS)
def test_command_fault(
    fault: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: Any
) -> None:
    """Arguments that cannot be used are told, and nothing is written."""
    monkeypatch.chdir(tmp_path)
    argv, expected = COMMAND_FAULTS[fault]
    assert expected in _complaint(argv, monkeypatch, capsys)
    assert list(tmp_path.iterdir()) == []


def test_the_shipped_definition_passes(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: Any
) -> None:
    """Negative control: the unchanged file, written the same way, is accepted."""
    path = tmp_path / "turbine.yaml"
    path.write_text(yaml.safe_dump(SHIPPED))
    monkeypatch.setattr("sys.argv", ["offwind", "static", str(path), "--foundation", "clamped"])
    with pytest.raises(SystemExit) as stop:
        cli.main()
    assert stop.value.code == 0, capsys.readouterr().err
