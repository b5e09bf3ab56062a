"""Files are written whole or not at all."""

import json
from pathlib import Path

import netCDF4
import numpy as np
import pytest
import xarray as xr
from numpy.testing import assert_allclose

from offwind_pin.base.whole_files import (
    append_netcdf,
    whole_file,
    write_json,
    write_netcdf,
    write_text,
)


def names(folder: Path) -> list[str]:
    return sorted(path.name for path in folder.iterdir())


def test_new_file_appears_whole(tmp_path: Path) -> None:
    """The text is there, in folders made for it, and nothing else."""
    path = tmp_path / "a" / "b" / "note.txt"
    write_text(path, "modulus: µ\n")
    assert path.read_text(encoding="utf-8") == "modulus: µ\n"
    assert names(path.parent) == ["note.txt"]


def test_failing_writer_leaves_the_old_file_and_no_litter(tmp_path: Path) -> None:
    """A writer that fails half-way changes nothing."""
    path = tmp_path / "result.txt"
    path.write_text("old")

    def fail() -> None:
        with whole_file(path) as temporary:
            temporary.write_text("half of the n")
            raise RuntimeError("disk on fire")

    with pytest.raises(RuntimeError, match="fire"):
        fail()
    assert path.read_text() == "old"
    assert names(tmp_path) == ["result.txt"]


def test_interrupted_writer_leaves_nothing_new(tmp_path: Path) -> None:
    """An interruption by the user, too, leaves no file where there was none."""
    path = tmp_path / "result.txt"

    def interrupt() -> None:
        with whole_file(path) as temporary:
            temporary.write_text("half")
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        interrupt()
    assert names(tmp_path) == []


def test_old_file_stays_until_the_new_one_is_whole(tmp_path: Path) -> None:
    """While the block runs a reader sees the old file."""
    path = tmp_path / "result.txt"
    path.write_text("old")
    with whole_file(path) as temporary:
        temporary.write_text("new")
        assert path.read_text() == "old"
    assert path.read_text() == "new"


def test_json_refuses_nan_and_keeps_the_old_file(tmp_path: Path) -> None:
    """JSON has no NaN: the writer fails, the old file stays."""
    path = tmp_path / "summary.json"
    write_json(path, {"frequency_hz": 0.25})
    with pytest.raises(ValueError, match="JSON"):
        write_json(path, {"frequency_hz": float("nan")})
    assert json.loads(path.read_text()) == {"frequency_hz": 0.25}
    assert names(tmp_path) == ["summary.json"]


def test_netcdf_reads_back(tmp_path: Path) -> None:
    """Numbers come back exactly, or with the precision asked for in the file."""
    rng = np.random.default_rng(1)
    moment, field = rng.normal(size=(5, 3)), rng.normal(size=(5, 4, 3))
    data = xr.Dataset(
        {
            "mudline_moment": (("time", "direction"), moment),
            "displacement": (("time", "height", "direction"), field),
        },
        attrs={"title": "test"},
    )
    path = tmp_path / "results.nc"
    append_netcdf(path, iter([data]), {"displacement": "float32"})
    with xr.open_dataset(path, engine="netcdf4") as again:
        assert_allclose(again.mudline_moment, moment, rtol=0)
        assert_allclose(again.displacement, field, rtol=6e-8)
        assert again.displacement.dtype == np.float32
        assert again.attrs["title"] == "test"
    assert names(tmp_path) == ["results.nc"]


def test_names_have_a_fixed_width_in_the_file(tmp_path: Path) -> None:
    """HDF5 2.0 crashes on strings of variable length in one file after another; ours have none."""
    data = xr.Dataset(
        {"load": (("time", "component"), np.ones((2, 3)))},
        {"component": ["Fx", "Fyy", "M\u00e9"]},
    )
    path = tmp_path / "results.nc"
    write_netcdf(path, data)
    with netCDF4.Dataset(path) as file:
        assert all(variable.dtype is not str for variable in file.variables.values())
    with xr.open_dataset(path, engine="netcdf4") as again:
        assert again["component"].values.tolist() == ["Fx", "Fyy", "M\u00e9"]
        assert float(again["load"].sel(component="Fyy").sum()) == 2.0


def test_failing_netcdf_leaves_the_old_file(tmp_path: Path) -> None:
    """Data that the format cannot hold fails without touching what is there."""
    path = tmp_path / "results.nc"
    path.write_text("old")
    data = xr.Dataset({"odd": ("x", np.array([object()], dtype=object))})
    with pytest.raises((TypeError, ValueError)):
        write_netcdf(path, data)
    assert path.read_text() == "old"
    assert names(tmp_path) == ["results.nc"]
