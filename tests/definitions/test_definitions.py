"""What holds of every definition: to a file and back, copies, hashes, faults with their place."""

from __future__ import annotations

import copy
import inspect
import json
import pickle
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
import yaml
from helpers import definitions
from hypothesis import HealthCheck, Phase, given, settings
from hypothesis import strategies as st

import offwind_pin as ow
from offwind_pin.base.definition import Definition
from offwind_pin.cases.case import Case, load_case, shipped_cases
from offwind_pin.definitions.reader import read_definition

OC6 = ow.load_turbine("oc6_phase2")
PARTS = definitions.SEAS | definitions.TOWER_WIND | definitions.TOWER_TOP | definitions.GUST
FEW = settings(
    max_examples=40,
    deadline=None,
    derandomize=True,
    phases=[Phase.generate],
    suppress_health_check=[HealthCheck.too_slow, HealthCheck.function_scoped_fixture],
)
Key = str | int


def plain(definition: Definition) -> Any:
    return json.loads(definition.model_dump_json())


def leaves(data: Any, place: tuple[Key, ...] = ()) -> Iterator[tuple[Key, ...]]:
    """Places of all values in plain data that are no lists or mappings."""
    if isinstance(data, dict | list):
        items = data.items() if isinstance(data, dict) else enumerate(data)
        for key, value in items:
            yield from leaves(value, (*place, key))
    else:
        yield place


def at(data: Any, place: tuple[Key, ...]) -> Any:
    for part in place:
        data = data[part]
    return data


@FEW
@given(PARTS)
def test_to_json_and_back(made: Definition) -> None:
    """Equal, of one hash in both senses, and the same again; so are copies and pickles."""
    read = type(made).model_validate_json(made.model_dump_json())
    for other in (read, pickle.loads(pickle.dumps(made)), copy.deepcopy(made), made.replace()):
        assert other == made
        assert hash(other) == hash(made)
        assert other.content_hash == made.content_hash
        assert repr(other) == repr(made)


@FEW
@given(definitions.cases(OC6))
def test_cases_to_yaml_and_back(tmp_path: Path, made: Case) -> None:
    """A case written as YAML is read as an equal one, its turbine in it."""
    path = tmp_path / "case.yaml"
    path.write_text(yaml.safe_dump(plain(made), allow_unicode=True), encoding="utf-8")
    read = load_case(path)
    assert read == made
    assert read.content_hash == made.content_hash


@FEW
@given(definitions.cases(OC6), st.data())
def test_a_corrupt_field_is_named(tmp_path: Path, made: Case, data: st.DataObject) -> None:
    """A mapping in place of any value is refused with the path to it."""
    content = plain(made)
    place = data.draw(st.sampled_from(list(leaves(content))))
    at(content, place[:-1])[place[-1]] = {"bogus": "value"}
    refused(tmp_path, content, place, Case)


@FEW
@given(definitions.cases(OC6), st.data())
def test_an_unknown_key_is_named(tmp_path: Path, made: Case, data: st.DataObject) -> None:
    """Wherever it is put, unless any key may be there, as in the materials."""
    content = plain(made)
    mappings = {
        place[:depth]
        for place in leaves(content)
        for depth in range(len(place))
        if isinstance(at(content, place[:depth]), dict)
    }
    free = {"materials", "elements", "ratios_of_critical"}
    closed = sorted((p for p in mappings if not (p and p[-1] in free)), key=str)
    place = data.draw(st.sampled_from(closed))
    at(content, place)["bogus"] = 1
    refused(tmp_path, content, (*place, "bogus"), Case)


@pytest.mark.parametrize("name", ow.shipped_turbines())
@FEW
@given(data=st.data())
def test_a_corrupt_turbine_is_refused(name: str, tmp_path: Path, data: st.DataObject) -> None:
    """The same of turbine files."""
    turbine = ow.load_turbine(name)
    content = plain(turbine)
    assert ow.Turbine.model_validate(content) == turbine
    place = data.draw(st.sampled_from(list(leaves(content))))
    at(content, place[:-1])[place[-1]] = {"bogus": "value"}
    refused(tmp_path, content, place, ow.Turbine)


def refused(folder: Path, content: Any, place: tuple[Key, ...], kind: type[Definition]) -> None:
    path = folder / "content.yaml"
    path.write_text(yaml.safe_dump(content, allow_unicode=True), encoding="utf-8")
    with pytest.raises(ow.InputError) as error:
        read_definition(path, kind)
    assert ".".join(map(str, place)) in str(error.value)
    assert str(path) in error.value.where


def test_equality_is_of_fields() -> None:
    """Whatever arrays were computed from them on the way."""
    first, second = (ow.TableSpectrum((0.1, 0.2, 0.3), (1.0, 2.0, 1.0)) for _ in range(2))
    assert first.peak_period == second.peak_period
    assert first == second
    assert first != second.replace(ordinate=(1.0, 2.0, 2.0))
    assert first != ow.WhiteNoise(2.0, 0.1, 0.3)
    assert pickle.loads(pickle.dumps(first)) == first


@pytest.mark.parametrize("name", shipped_cases())
def test_shipped_cases_to_json_and_back(name: str) -> None:
    made = load_case(name)
    read = Case.model_validate_json(made.model_dump_json())
    assert read == made
    assert hash(read) == hash(made)
    assert read.content_hash == made.content_hash
    assert pickle.loads(pickle.dumps(made)) == made


def test_what_is_replaced_is_checked() -> None:
    """And nothing else changes, whatever was computed from the one before."""
    sea = ow.IrregularWaves(2.0, 8.0, seed=1, repeat_period=600.0)
    other = sea.replace(seed=2)
    assert (other.wave_seed, sea.wave_seed) == (2, 1)
    assert other != sea
    assert other.content_hash != sea.content_hash
    with pytest.raises(ow.InputError, match="seed"):
        sea.replace(seed=-2)
    with pytest.raises(ow.InputError, match="sead"):
        sea.replace(sead=2)
    spectrum = ow.TableSpectrum((0.1, 0.2, 0.3), (1.0, 2.0, 1.0))
    assert (
        spectrum.significant_height < spectrum.replace(ordinate=(1.0, 9.0, 1.0)).significant_height
    )


CASE: dict[str, Any] = {
    "name": "own",
    "turbine": "my_turbine.yaml",
    "foundation": "distributed_springs",
    "sea": {"kind": "measured_waves", "file": "buoy.csv", "low_cut_hz": 0.05, "high_cut_hz": 0.4},
    "tower_top_load": {"kind": "file", "files": [{"file": "load.txt", "factor": 1.35}]},
    "earthquake": {"at2": {"x": "quake.at2"}},
    "analysis": {
        "kind": "transient",
        "duration_s": 30.0,
        "ramp_s": 4.0,
        "dt_s": 0.1,
        "output_dt_s": 0.2,
        "psd_segment_s": 10.0,
    },
}
FILES = {
    "buoy.csv": "".join(f"{0.5 * i},{i % 7}\n" for i in range(80)),
    "load.txt": "0 1 0 0 0 0 0\n99 1 0 0 0 0 0\n",
    "quake.at2": "NPTS= 3, DT= .0050 SEC\n0.1 0.2 0.1\n",
    "curves.csv": "depth_m,y_m,p_n_per_m\n0,0,0\n0,0.1,5e4\n",
}


def written(folder: Path) -> Path:
    """A case with files of every kind that a definition can name."""
    folder.mkdir()
    for name, text in FILES.items():
        (folder / name).write_text(text)
    turbine = plain(OC6)
    turbine["soil"]["distributed_springs"]["curve"] = {"kind": "table", "file": "curves.csv"}
    (folder / "my_turbine.yaml").write_text(yaml.safe_dump(turbine))
    (folder / "case.yaml").write_text(yaml.safe_dump(CASE))
    return folder / "case.yaml"


def test_content_and_not_place_is_hashed(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Copies in two folders have one hash, wherever they are read from; they are no equal cases."""
    first, second = (load_case(written(tmp_path / name)) for name in ("first", "second"))
    assert first.content_hash == second.content_hash
    assert first.turbine.content_hash == second.turbine.content_hash
    assert first != second
    monkeypatch.chdir(tmp_path)
    assert load_case("first/case.yaml") == first


@pytest.mark.parametrize("name", FILES)
def test_a_changed_byte_changes_the_hash(tmp_path: Path, name: str) -> None:
    """Of every file that the case refers to, through its turbine as well."""
    case = load_case(written(tmp_path / "case"))
    before, path = case.content_hash, tmp_path / "case" / name
    path.write_text(FILES[name].replace("1", "2", 1))
    assert case.content_hash != before
    path.write_text(FILES[name])
    assert case.content_hash == before
    path.unlink()
    with pytest.raises(ow.InputError, match=name):
        assert case.content_hash


@FEW
@given(st.data())
def test_every_value_counts(data: st.DataObject) -> None:
    """A definition with any one of its numbers changed has another hash."""
    content = plain(OC6)
    numbers = [p for p in leaves(content) if isinstance(at(content, p), float) and at(content, p)]
    place = data.draw(st.sampled_from(numbers))
    at(content, place[:-1])[place[-1]] *= 1 + 1e-9
    try:
        changed = ow.Turbine.model_validate(content)
    except ValueError:  # a number that others depend on, such as a height where two members meet
        return
    assert changed.content_hash != OC6.content_hash


def test_json_records_files(tmp_path: Path) -> None:
    """With absolute paths and digests: it can be read anywhere, and a file that changed is refused."""
    case = load_case(written(tmp_path / "case"))
    text = case.model_dump_json()
    record = json.loads(text)["sea"]["file"]
    assert record["path"] == str(tmp_path / "case" / "buoy.csv")
    assert len(record["sha256"]) == 64
    assert Case.model_validate_json(text) == case
    (tmp_path / "case" / "buoy.csv").write_text("0,1\n")
    with pytest.raises(ValueError, match=r"buoy\.csv has changed"):
        Case.model_validate_json(text)
    # a file that is gone is refused by what reads it
    (tmp_path / "case" / "buoy.csv").unlink()
    read = Case.model_validate_json(text)
    assert read == case
    assert read.water is not None
    with pytest.raises(ow.InputError, match=r"buoy\.csv"):
        read.water.waves(20.0, 9.81)


def test_signatures_name_what_python_takes() -> None:
    """Editors show names of Python, positional ones first."""
    parameters = inspect.signature(ow.RegularWaves).parameters
    assert list(parameters)[:3] == ["height", "period", "direction_deg"]
    assert parameters["current"].kind is inspect.Parameter.KEYWORD_ONLY
