"""Bad tuned mass dampers in a turbine file: what is wrong, where, and what to do."""

from importlib import resources
from pathlib import Path
from typing import Any

import pytest
import yaml

import offwind_pin as ow

SHIPPED = (resources.files("offwind_pin.definitions") / "library" / "oc6_phase2.yaml").read_text()

SOUND: dict[str, Any] = {
    "name": "nacelle",
    "z_m": 115.63,
    "mass_kg": 4e5,
    "direction": "both",
    "frequency_hz": 0.27,
    "damping_ratio": 0.1,
}


def one(*without: str, **keys: Any) -> list[dict[str, Any]]:
    return [{key: value for key, value in (SOUND | keys).items() if key not in without}]


BOTH_WAYS = ["stiffness_n_per_m and damping_n_s_per_m", "frequency_hz and damping_ratio"]
TUNED = ("frequency_hz", "damping_ratio")

FAULTS: dict[str, tuple[list[dict[str, Any]], list[str]]] = {
    "negative mass": (one(mass_kg=-4e5), ["tuned_mass_dampers.0.mass_kg", "-400000"]),
    "no mass": (one("mass_kg"), ["tuned_mass_dampers.0.mass_kg", "required"]),
    "tuned in two ways": (
        one(stiffness_n_per_m=1e6, damping_n_s_per_m=1e5),
        ["tuned_mass_dampers.0", "stiffness_n_per_m, damping_n_s_per_m, frequency_hz", *BOTH_WAYS],
    ),
    "a spring of each way": (one(stiffness_n_per_m=1e6), ["stiffness_n_per_m, freq", *BOTH_WAYS]),
    "not tuned": (one(*TUNED), ["neither spring nor damper", *BOTH_WAYS]),
    "a spring alone": (one(*TUNED, stiffness_n_per_m=1e6), ["gives stiffness_n_per_m;"[:-1]]),
    "mixed ways": (
        one("damping_ratio", damping_n_s_per_m=1e5),
        ["damping_n_s_per_m, frequency_hz", *BOTH_WAYS],
    ),
    "above the yaw bearing": (one(z_m=116.0), ["nacelle", "116.0", "-30.0", "115.63"]),
    "in the ground": (one(z_m=-50.0), ["nacelle", "-50.0", "above the mudline", "-30.0"]),
    "the same name twice": (one() + one(z_m=50.0), ["nacelle, nacelle", "different names"]),
    "a name with blanks": (one(name="in the nacelle"), ["tuned_mass_dampers.0.name", "in the"]),
    "a frequency in rad/s": (one(frequency_hz=1.7e3), ["frequency_hz", "1700", "unit"]),
    "a damping ratio in percent": (one(damping_ratio=13.0), ["damping_ratio", "13.0"]),
    "a negative spring": (
        one(*TUNED, stiffness_n_per_m=-1e6, damping_n_s_per_m=1e5),
        ["stiffness_n_per_m", "-1000000"],
    ),
    "no direction": (one("direction"), ["direction", "required"]),
    "another direction": (one(direction="x"), ["direction", "fore_aft"]),
    "no travel": (one(travel_m=0.0), ["travel_m", "0"]),
    "not a number": (one(z_m=float("nan")), ["z_m", "nan"]),
    "a key that is not there": (one(stiffness=1e6), ["stiffness", "Did you mean", "n_per_m"]),
}


def read(dampers: Any, folder: Path, rename: str | None = None) -> ow.Turbine:
    data = yaml.safe_load(SHIPPED)
    data["tuned_mass_dampers"] = dampers
    if rename:
        data["members"][-1]["name"] = rename
    path = folder / "turbine.yaml"
    path.write_text(yaml.safe_dump(data))
    return ow.load_turbine(path)


@pytest.mark.parametrize("fault", FAULTS)
def test_it_is_refused(fault: str, tmp_path: Path) -> None:
    dampers, words = FAULTS[fault]
    with pytest.raises(ow.InputError) as error:
        read(dampers, tmp_path)
    message = str(error.value)
    assert "turbine.yaml" in message
    assert [word for word in words if word not in message] == []


def test_members_do_not_come_after_dampers(tmp_path: Path) -> None:
    """A member whose joints would be read after a damper's."""
    with pytest.raises(ow.InputError, match="zz_tower begins with zz"):
        read(one(), tmp_path, rename="zz_tower")
    with pytest.raises(ow.InputError, match="zz_tower begins with zz"):
        read([], tmp_path, rename="zz_tower")
    assert read(one(), tmp_path, rename="z_tower").members[-1].name == "z_tower"


def test_what_is_right_is_read(tmp_path: Path) -> None:
    """Negative control: sound dampers, at both ends of the structure, tuned in both ways."""
    direct = one(*TUNED, name="zz", z_m=-30.0, stiffness_n_per_m=1e6, damping_n_s_per_m=0.0)
    turbine = read(one(travel_m=2.0) + direct, tmp_path)
    assert [d.travel for d in turbine.tuned_mass_dampers] == [2.0, None]
    first, second = turbine.tuned_mass_dampers
    assert first.stiffness == pytest.approx(4e5 * (2 * 3.14159265359 * 0.27) ** 2, rel=1e-10)
    assert first.damping == pytest.approx(2 * 0.1 * (first.stiffness * 4e5) ** 0.5, rel=1e-12)
    assert (second.stiffness, second.damping) == (1e6, 0.0)
    assert ow.build(turbine, "clamped", elements=4).nv == 4 * 3 + 4
