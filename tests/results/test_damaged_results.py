"""Damaged and foreign files of results: one message that names the file, never a traceback."""

from __future__ import annotations

import random
import re
import shutil
from collections.abc import Callable
from pathlib import Path
from typing import Any

import netCDF4
import numpy as np
import pytest
import xarray as xr

import offwind_pin as ow
from offwind_pin import viewer
from offwind_pin.base.whole_files import write_netcdf
from offwind_pin.cases.report import report_again
from offwind_pin.cases.run import run_case
from offwind_pin.results.reading import open_case, open_checked

CASE: dict[str, Any] = {
    "name": "waves",
    "turbine": "oc6_phase2",
    "foundation": "distributed_springs",
    "elements": 4,
    "sea": {"kind": "irregular_waves", "significant_height_m": 2.0, "peak_period_s": 6.0},
    "analysis": {
        "kind": "transient",
        "duration_s": 25.0,
        "ramp_s": 5.0,
        "dt_s": 0.1,
        "output_dt_s": 0.2,
        "psd_segment_s": 10.0,
    },
}


@pytest.fixture(scope="module")
def whole(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Results of a case, without their manifest."""
    out = tmp_path_factory.mktemp("whole")
    run_case(ow.Case.model_validate(CASE), out / "run", report=False)
    return Path(shutil.copy(out / "run" / "results.nc", out))


@pytest.fixture(scope="module")
def histories(whole: Path) -> Path:
    """The time history alone, as simulate writes it."""
    with xr.open_dataset(whole) as data:
        write_netcdf(whole.with_name("histories.nc"), data)
    return whole.with_name("histories.nc")


def refusal(path: Path) -> str:
    """What all readers say of a file."""
    readers: tuple[Callable[[Path], Any], ...] = (open_case, open_checked, viewer.time_history)
    messages = []
    for reader in readers:
        with pytest.raises(ow.InputError) as refused:
            reader(path)
        messages.append(str(refused.value))
        assert str(path) in messages[-1]
    return messages[1]


def test_whole_files_are_read(whole: Path, histories: Path) -> None:
    """Negative control."""
    for path in (whole, histories):
        with open_checked(path) as tree:
            assert tree["mudline_moment"].sizes["time"] == 126
        assert "<html" in viewer.time_history(path)
    with open_case(whole) as tree:
        assert "spectrum" in tree.children


def damage(name: str) -> Callable[[netCDF4.Dataset], None]:
    """A change of a file that all readers refuse."""

    def without(file: netCDF4.Dataset) -> None:
        file["spectrum"].renameVariable("density", "dichte")

    def no_group(file: netCDF4.Dataset) -> None:
        file.renameGroup("waves", "wellen")

    def attribute(file: netCDF4.Dataset) -> None:
        file["waves"].delncattr("crest_s")

    def other_attribute(file: netCDF4.Dataset) -> None:
        file["case"].setncattr("status", "done")

    def text(file: netCDF4.Dataset) -> None:
        file["case"].setncattr("wall_s", "long")

    def dimension(file: netCDF4.Dataset) -> None:
        file["soil"].renameDimension("soil_spring", "soil_node")

    def not_finite(file: netCDF4.Dataset) -> None:
        file["modes"]["modes_height"][2] = np.nan

    def one_number(file: netCDF4.Dataset) -> None:
        file["mudline_moment"][5, 1] = np.nextafter(file["mudline_moment"][5, 1], 1e9)

    def order(file: netCDF4.Dataset) -> None:
        file["time"][3] = file["time"][1]

    def no_times(file: netCDF4.Dataset) -> None:
        file.renameVariable("time", "zeit")

    def older(file: netCDF4.Dataset) -> None:
        file["case"].delncattr("inventory")

    def other_format(file: netCDF4.Dataset) -> None:
        text = file["case"].getncattr("inventory")
        file["case"].setncattr("inventory", text.replace('"format": 1', '"format": 99'))

    def no_inventory(file: netCDF4.Dataset) -> None:
        file["case"].setncattr("inventory", "{")

    def another(file: netCDF4.Dataset) -> None:
        file.createGroup("static/other")

    def title(file: netCDF4.Dataset) -> None:
        file.setncattr("title", "offwind-pin something")

    return locals()[name]


@pytest.mark.parametrize(
    ("name", "says"),
    [
        ("without", "group /spectrum, variable .*density is missing"),
        ("no_group", "group /waves is missing|group /wellen was added"),
        ("attribute", "group /waves, attribute crest_s is missing"),
        ("other_attribute", "group /case, attribute status was changed"),
        ("text", "could not convert"),
        ("dimension", "group /soil, variable .* dimensions"),
        ("not_finite", "group /modes, variable modes_height was changed"),
        ("one_number", "variable mudline_moment was changed"),
        ("order", "variable time was changed"),
        ("no_times", "variable (time|zeit)"),
        ("older", "no inventory"),
        ("other_format", "format 99"),
        ("no_inventory", "JSONDecodeError"),
        ("another", "group /static/other was added"),
        ("title", "title 'offwind-pin something'"),
    ],
)
def test_damaged_cases(whole: Path, tmp_path: Path, name: str, says: str) -> None:
    path = Path(shutil.copy(whole, tmp_path))
    with netCDF4.Dataset(path, "a") as file:
        damage(name)(file)
    assert re.search(says, refusal(path))


@pytest.mark.parametrize(
    ("change", "says"),
    [
        (lambda data: data.rename(time="zeit"), "no times"),
        (lambda data: data.isel(time=[0, 2, 1]), "rising"),
        (lambda data: data.isel(time=[0, 1, 1]), "rising"),
        (lambda data: data.assign_coords(height=data["height"] * np.nan), "height"),
        (lambda data: data.assign_coords(time=data["time"].astype(str)), "times|time"),
        (lambda data: data.assign(displacement=data["displacement"] * np.nan), "displacement"),
        (lambda data: data.assign(displacement=data["displacement"].isel(height=0)), "dimensions"),
        (lambda data: data.assign(wave_elevation=data["wave_elevation"].astype(str)), "wave_elevation"),
        (lambda data: data.assign_attrs(mudline_m="deep"), "mudline_m"),
        (lambda data: data.assign_attrs(turbine=5), "turbine"),
        (lambda data: data.assign_attrs(rotor_nacelle="{"), "rotor_nacelle"),
        (lambda data: data.assign_attrs(title="Ozone"), "Ozone"),
        (lambda data: xr.Dataset(attrs=data.attrs), "."),
        (lambda data: xr.Dataset({"o3": ("lat", [1.0])}), "title"),
    ],
)  # fmt: skip
def test_damaged_histories(
    histories: Path, tmp_path: Path, change: Callable[[xr.Dataset], xr.Dataset], says: str
) -> None:
    """Files without groups, as simulate and other programs write them."""
    with xr.open_dataset(histories) as data:
        changed = change(data.load())
    changed.encoding = {}
    path = tmp_path / "results.nc"
    changed.to_netcdf(path, engine="netcdf4")
    assert re.search(says, refusal(path))


@pytest.mark.seeded
def test_damaged_bytes(whole: Path, tmp_path: Path, campaign_seed: int) -> None:
    """Truncated, overwritten, or another kind of file: in the directory of the run, by checksum."""
    draw = random.Random(campaign_seed)
    content = whole.read_bytes()
    changed = bytearray(content)
    changed[draw.randrange(len(content))] ^= 1 << draw.randrange(8)
    run = tmp_path / "run"
    shutil.copytree(whole.parent / "run", run)
    path = run / "results.nc"
    for damaged in (
        content[: draw.randrange(1, len(content))],
        bytes(changed),
        content[: len(content) // 2] + bytes(len(content) - len(content) // 2),
        b"",
        b"text\n" * 100,
    ):
        path.write_bytes(damaged)
        assert "damaged or changed" in refusal(path)
    (run / "manifest.json").unlink()
    for damaged in (content[: len(content) // 3], b"", b"text\n" * 100, b"CDF\x01" + bytes(60)):
        path.write_bytes(damaged)
        refusal(path)


@pytest.mark.seeded
def test_random_changes(whole: Path, tmp_path: Path, campaign_seed: int, offwind: Any) -> None:
    """Whatever variable or attribute is changed: report and view end with exit 2, or as before."""
    draw = random.Random(campaign_seed)
    seen = 0
    for number in range(12):
        out = tmp_path / str(number)
        out.mkdir()
        path = Path(shutil.copy(whole, out))
        with netCDF4.Dataset(path, "a") as file:
            groups = [file, *file.groups.values()]
            group = draw.choice(groups)
            names, kept = list(group.variables), group.ncattrs()
            if names and draw.random() < 0.6:
                variable = group[draw.choice(names)]
                if draw.random() < 0.5:
                    group.renameVariable(variable.name, "other")
                elif variable.dtype is not str and variable.dtype.kind in "fi":
                    variable[:] = draw.choice([0, -1, 7])
            elif kept:
                name = draw.choice(kept)
                group.delncattr(name) if draw.random() < 0.5 else group.setncattr(
                    name, draw.choice([1.5, "x", -1])
                )
        code, _, err = offwind("view", str(out), "--html", str(out / "a.html"))
        assert code in (0, 2)
        assert "Traceback" not in err
        if code == 2:
            seen += 1
            assert str(path) in err.replace("\n", "")
            with pytest.raises(ow.InputError):
                report_again(out)
    assert seen > 6
