"""Bad hydrodynamics in a turbine file: what is wrong, where, and what to do."""

from importlib import resources
from pathlib import Path
from typing import Any

import pytest
import yaml

import offwind_pin as ow

SHIPPED = (resources.files("offwind_pin.definitions") / "library" / "oc6_phase2.yaml").read_text()


def growth(**keys: Any) -> dict[str, Any]:
    return {"marine_growth": [{"z_m": [-30.0, -10.0], "thickness_m": 0.1} | keys]}


def flooded(**keys: Any) -> dict[str, Any]:
    return {"contents": {"kind": "flooded", "level_m": 0.0} | keys}


def drag(table: Any) -> dict[str, Any]:
    return {"drag_coefficient": table}


FAULTS: dict[str, tuple[dict[str, Any], list[str]]] = {
    "coefficient below zero": (drag(-1.0), ["drag_coefficient", "-1.0"]),
    "coefficient of another unit": (drag(1000.0), ["drag_coefficient", "1000.0", "10"]),
    "coefficient as text": (drag("high"), ["drag_coefficient", "high"]),
    "heights that do not rise": (
        drag({"z_m": [0, -30], "value": [1.0, 1.2]}),
        ["drag_coefficient", "z_m must increase", "Sort"],
    ),
    "table of unequal columns": (
        drag({"z_m": [-30, 0], "value": [1.0, 1.2, 1.3]}),
        ["drag_coefficient", "2 entries", "3"],
    ),
    "table with a wrong key": (
        drag({"height_m": [-30, 0], "value": [1.0, 1.2]}),
        ["height_m", "unknown key", "z_m"],
    ),
    "numbers that do not rise": (
        drag({"keulegan_carpenter": [5, 5], "value": [1.0, 1.2]}),
        ["keulegan_carpenter must increase"],
    ),
    "a negative number": (
        drag({"keulegan_carpenter": [-5, 5], "value": [1.0, 1.2]}),
        ["keulegan_carpenter", "-5"],
    ),
    "a value too large": (
        drag({"keulegan_carpenter": [0, 5], "value": [1.0, 12.0]}),
        ["value", "12.0", "10"],
    ),
    "growth in mm": (growth(thickness_m=100.0), ["marine_growth.0.thickness_m", "100.0", "unit"]),
    "growth in t/m3": (
        growth(density_kg_per_m3=1.325),
        ["marine_growth.0.density_kg_per_m3", "1.325", "unit"],
    ),
    "growth upside down": (growth(z_m=[-10.0, -30.0]), ["marine_growth.0", "lower end first"]),
    "growth in the ground": (growth(z_m=[-40.0, -10.0]), ["-40.0", "above the mudline"]),
    "growth above the tower": (growth(z_m=[-10.0, 200.0]), ["200.0", "115.63"]),
    "growth that overlaps": (
        {"marine_growth": growth()["marine_growth"] + growth(z_m=[-12.0, 0.0])["marine_growth"]},
        ["marine_growth", "-12.0", "without overlap"],
    ),
    "water above the tower": (flooded(level_m=120.0), ["level_m", "120.0"]),
    "a level below the plug": (flooded(level_m=-20.0, plug_m=-10.0), ["plug", "-10.0", "-20.0"]),
    "a plug in the ground": (flooded(plug_m=-50.0), ["plug", "-50.0", "mudline"]),
    "water without a level": ({"contents": {"kind": "flooded"}}, ["level_m", "required"]),
    "unknown contents": ({"contents": {"kind": "air"}}, ["contents.kind", "air", "sealed"]),
    "unknown diffraction": ({"diffraction": "macamy"}, ["diffraction", "maccamy_fuchs"]),
    "buoyancy as a number": ({"buoyancy": 3}, ["buoyancy", "3"]),
    "a key that is not there": ({"bouyancy": True}, ["bouyancy", "Did you mean 'buoyancy'?"]),
}


def read(keys: dict[str, Any], folder: Path) -> ow.Turbine:
    data = yaml.safe_load(SHIPPED)
    data["hydrodynamics"].update(keys)
    path = folder / "turbine.yaml"
    path.write_text(yaml.safe_dump(data))
    return ow.load_turbine(path)


@pytest.mark.parametrize("fault", FAULTS)
def test_it_is_refused(fault: str, tmp_path: Path) -> None:
    keys, words = FAULTS[fault]
    with pytest.raises(ow.InputError) as error:
        read(keys, tmp_path)
    message = str(error.value)
    assert "turbine.yaml" in message
    assert [word for word in words if word not in message] == []


def test_what_is_right_is_read(tmp_path: Path) -> None:
    """Negative control: the same keys with sound values."""
    sound = [
        growth(drag_coefficient=1.1),
        flooded(plug_m=-25.0),
        drag({"z_m": [-30, 0], "value": [1.0, 1.2]}),
        drag({"keulegan_carpenter": [0, 5], "value": [1.0, 1.2]}),
        {"diffraction": "maccamy_fuchs", "buoyancy": True, "contents": {"kind": "sealed"}},
    ]
    for keys in sound:
        assert keys.keys() <= read(keys, tmp_path).hydrodynamics.model_fields_set
