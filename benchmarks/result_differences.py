"""Differences between two folders of results, each judged by a bound of its own.

==================  ================================================================================
what                allowed
==================  ================================================================================
float64 channel     1e-9 of the variable's peak
float32 channel     2e-7 of the variable's peak
segment imbalance   1e-9 of the largest section force or moment, in the new results by themselves
energy balance      difference up to 1e-9 of the largest entry of the ledger that it is the sum of
solver residual     the run's own tolerance, 1e-5 unless the file names another; of statics 1e-10
solver iterations   may differ by one in 1 % of the records; of statics by one
numbers in JSON     1e-7 of themselves, or 1e-9 of the largest number of the same unit beside them
numbers in files    the same, by column or attribute
names               the same text; sentences may be reworded, which is noted
==================  ================================================================================

A file, variable, key or attribute that the reference has and the new results lack is a failure. One
that only the new results have is listed.
"""

from __future__ import annotations

import csv
import fnmatch
import json
import re
from collections.abc import Iterator, Sequence
from dataclasses import asdict, dataclass, field
from pathlib import Path
from typing import Any

import netCDF4
import numpy as np
import xarray as xr
from numpy.typing import NDArray

Array = NDArray[np.float64]

FLOAT64, FLOAT32, NUMBER = 1e-9, 2e-7, 1e-7
IMBALANCE = 1e-9
"""As in the tests of the equilibrium of segments."""
BALANCE = 1e-9
RESIDUAL, STATIC_RESIDUAL = 1e-5, 1e-10
"""Tolerances of generalised-alpha and of statics."""
OTHER_ITERATIONS = 0.01
SMALL = 1e-2
"""Of the peak; smaller numbers are held against this share of it, NUMBER * SMALL being FLOAT64."""
SCIPY = 1e-6
"""Of the peak, for the run by SciPy: its step control passes rounding on up to its tolerance."""

_LEDGER = ("energy_stored", "energy_dissipated", "energy_worked")
_OF_THE_MACHINE = ("wall_s", "realtime_factor", "*_version")
_ABSOLUTE = {
    "mean_iterations": OTHER_ITERATIONS,
    "iterations": 1.0,
    "moment at the toe over the largest": 1e-5,  # of the gallery: rounding about zero
}
"""Allowed absolute differences by key."""
_LARGEST = {"largest_residual": RESIDUAL, "residual": STATIC_RESIDUAL}
"""Largest values by key, whatever the reference has."""
_NUMBER = re.compile(r"[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?")
_ATTRIBUTE = re.compile(r'([\w:]+)="([^"]*)"')


@dataclass(frozen=True)
class Difference:
    """One thing that was compared.

    size, allowed : of the difference in the measure of its kind; detail : for a reader
    """

    name: str
    kind: str
    size: float
    allowed: float
    detail: str = ""

    @property
    def failed(self) -> bool:
        return not self.size <= self.allowed


@dataclass
class Comparison:
    """All that was compared of one group of results."""

    group: str
    compared: list[Difference] = field(default_factory=list)
    missing: list[str] = field(default_factory=list)
    extra: list[str] = field(default_factory=list)
    notes: list[str] = field(default_factory=list)
    accepted: list[str] = field(default_factory=list)

    @property
    def failures(self) -> list[Difference]:
        return [difference for difference in self.compared if difference.failed]

    @property
    def passed(self) -> bool:
        return bool(self.compared) and not self.failures and not self.missing

    def worst(self, *kinds: str) -> Difference | None:
        """The largest difference among those of some kinds, or of all kinds."""
        chosen = [d for d in self.compared if not kinds or d.kind in kinds]
        return max(chosen, key=lambda d: np.inf if np.isnan(d.size) else d.size, default=None)

    def accept(self, patterns: Sequence[str]) -> None:
        """Take off what is known and meant, by patterns of ``group/name``."""

        def meant(name: str) -> bool:
            whole = f"{self.group}/{name}"
            return any(fnmatch.fnmatchcase(whole, pattern) for pattern in patterns)

        off = [d.name for d in self.failures if meant(d.name)]
        self.accepted = sorted({*off, *filter(meant, self.missing)})
        self.compared = [d for d in self.compared if not (d.failed and meant(d.name))]
        self.missing = [name for name in self.missing if not meant(name)]

    def as_dict(self) -> dict[str, Any]:
        worst = {kind: self.worst(kind) for kind in dict.fromkeys(d.kind for d in self.compared)}
        return {
            "group": self.group,
            "passed": self.passed,
            "compared": len(self.compared),
            "worst": {kind: d and _plain(d) for kind, d in worst.items()},
            "failures": [_plain(difference) for difference in self.failures],
            **{name: getattr(self, name) for name in ("missing", "extra", "notes", "accepted")},
        }


def compare_group(group: str, reference: Path, new: Path, accept: Sequence[str] = ()) -> Comparison:
    """Compare every file of one folder with that of the same name in the other."""
    found = Comparison(group)
    files, others = (
        {path.relative_to(folder).as_posix() for path in folder.rglob("*") if path.is_file()}
        for folder in (reference, new)
    )
    found.missing += sorted(files - others)
    found.extra += sorted(others - files)
    for name in sorted(files & others):
        _compare_file(found, name, reference / name, new / name)
    found.accept(accept)
    return found


def _compare_file(found: Comparison, name: str, reference: Path, new: Path) -> None:
    match reference.suffix:
        case ".nc":
            _compare_netcdf(found, name, reference, new)
        case ".json":
            one, other = (json.loads(path.read_text()) for path in (reference, new))
            _compare_data(found, name, one, other)
        case ".csv":
            one, other = (_columns(path) for path in (reference, new))
            _compare_data(found, name, one, other)
        case ".urdf":
            texts = reference.read_text(), new.read_text()
            skeletons = [_NUMBER.sub("#", text) for text in texts]
            found.compared.append(_same_text(f"{name}: elements", skeletons[0], skeletons[1]))
            one, other = (_attributes(text) for text in texts)
            _compare_data(found, name, one, other)
        case ".txt" | ".dat":
            one, other = (_numbers(path.read_text()) for path in (reference, new))
            _compare_data(found, name, one, other)
        case ".html":
            pass  # a report is made for people; that it is there has been checked
        case _:
            same = reference.read_bytes() == new.read_bytes()
            found.compared.append(Difference(name, "bytes", 0.0 if same else np.inf, 0.0))


# --- datasets


def _compare_netcdf(found: Comparison, file: str, reference: Path, new: Path) -> None:
    """Variables and attributes of every group, found again even if they moved to another group."""
    before, after = _datasets(reference), _datasets(new)
    known = {(group, str(name)) for group, data in after.items() for name in data.variables}
    seen = set()
    for group, data in before.items():
        for key in map(str, data.variables):
            name = f"{file}: {group}{key}"
            place = _place(known, group, key)
            if place is None:
                found.missing.append(name)
                continue
            seen.add(place)
            if place != (group, key):
                found.notes.append(f"{name} is {place[0]}{place[1]} now")
            one, other = data.variables[key], after[place[0]].variables[place[1]]
            found.compared.append(
                _of_channel(name, key, one, other, (data, after[place[0]]), scipy="scipy" in file)
            )
            _compare_data(found, f"{name}, attributes", one.attrs, other.attrs)
        if group in after:
            _compare_data(found, f"{file}: {group}attributes", data.attrs, after[group].attrs)
    found.extra += [f"{file}: {group}{key}" for group, key in sorted(known - seen)]


def _datasets(path: Path) -> dict[str, xr.Dataset]:
    """Datasets of a file by their group, the root being ``""``; read into memory."""

    def groups(node: Any, at: str) -> Iterator[str]:
        yield at
        for name, child in node.groups.items():
            yield from groups(child, f"{at}{name}/")

    with netCDF4.Dataset(path) as file:
        names = list(groups(file, ""))
    found = {}
    for name in names:
        with xr.open_dataset(path, group=name or None, engine="netcdf4") as data:
            found[name] = data.load()
    return found


def _place(known: set[tuple[str, str]], group: str, key: str) -> tuple[str, str] | None:
    """Where a variable is: where it was, or in the one other group that has it.

    A group may put its name before that of a dimension, as xarray refuses a second ``height``.
    """
    if (group, key) in known:
        return group, key
    places = [
        (other, name)
        for other, name in sorted(known)
        if name in (key, f"{other.rstrip('/').rpartition('/')[2]}_{key}")
    ]
    return places[0] if len(places) == 1 else None


def _of_channel(
    name: str,
    key: str,
    reference: xr.Variable,
    new: xr.Variable,
    datasets: tuple[xr.Dataset, xr.Dataset],
    *,
    scipy: bool,
) -> Difference:
    one, other = reference.values, new.values
    if one.shape != other.shape:
        return Difference(name, "shape", np.inf, 0.0, f"{one.shape} is {other.shape} now")
    if one.dtype.kind not in "fiub":
        return _same_text(name, str(one.tolist()), str(other.tolist()))
    if np.any(np.isnan(one) != np.isnan(other)):
        return Difference(name, "gaps", np.inf, 0.0, "not-a-numbers are at other places")
    if key == "segment_imbalance":
        return Difference(name, "imbalance", _imbalance(datasets[1], other), IMBALANCE)
    if key == "energy_balance":
        ledger = max(_peak(datasets[0][entry].values) for entry in _LEDGER)
        allowed = SCIPY if scipy else BALANCE
        return Difference(name, "energy balance", _off(one, other, ledger), allowed)
    if key == "solver_residual":
        tolerance = float(datasets[0].attrs.get("residual_tolerance", RESIDUAL))
        return Difference(name, "residual", _peak(other), tolerance)
    if key == "solver_iterations":
        return Difference(name, "iterations", _other_iterations(one, other), OTHER_ITERATIONS)
    single = one.dtype == np.float32
    allowed = FLOAT32 if single else FLOAT64
    kind = str(one.dtype)
    finite = _peak(one[np.isfinite(one)])
    return Difference(name, kind, _off(one, other, finite), SCIPY if scipy else allowed)


def _imbalance(data: xr.Dataset, left: Array) -> float:
    """Largest imbalance over the largest section force, or moment, of the same results."""
    scale = [_peak(data[name].values) for name in ("section_force", "section_moment")]
    return _peak(left / np.repeat(scale, 3))


def _other_iterations(one: NDArray[Any], other: NDArray[Any]) -> float:
    """Share of the records with another number of iterations; infinite if one differs by two."""
    differ = np.abs(one.astype(int) - other.astype(int))
    return float(np.mean(differ > 0)) if differ.max(initial=0) <= 1 else np.inf


def _off(one: NDArray[Any], other: NDArray[Any], scale: float) -> float:
    """Largest difference over a scale; see :func:`_differences`."""
    largest = _peak(_differences(one, other))
    return 0.0 if largest == 0 else largest / scale if scale > 0 else np.inf


def _differences(one: NDArray[Any], other: NDArray[Any]) -> Array:
    """Magnitudes; infinite where one is not finite and the other is not the same."""
    one, other = one.astype(float), other.astype(float)
    same = (one == other) | (np.isnan(one) & np.isnan(other))
    both = np.isfinite(one) & np.isfinite(other)
    off = np.where(same, 0.0, np.inf)
    off[both] = np.abs(one[both] - other[both])
    return off


def _peak(values: NDArray[Any]) -> float:
    """Largest magnitude of what is a number."""
    magnitude = np.abs(np.asarray(values, dtype=float))
    return float(np.max(magnitude, initial=0.0, where=~np.isnan(magnitude)))


# --- plain data


def _compare_data(found: Comparison, at: str, one: Any, other: Any, key: str = "") -> None:
    """Numbers, names, lists and dictionaries of these, as a JSON file or attributes have them."""
    one, other = _opened(one), _opened(other)
    if isinstance(one, dict) and isinstance(other, dict):
        known, news = _kept(one), _kept(other)
        found.missing += [f"{at}, {name}" for name in known if name not in news]
        found.extra += [f"{at}, {name}" for name in news if name not in known]
        for name in known:
            if name in news and not _compare_number(found, f"{at}, {name}", name, one, other):
                _compare_data(found, f"{at}, {name}", one[name], other[name], name)
    elif _is_array(one) and _is_array(other):
        if np.shape(one) != np.shape(other):
            sizes = f"{np.shape(one)} is {np.shape(other)} now"
            found.compared.append(Difference(at, "shape", np.inf, 0.0, sizes))
            return
        a, b = np.array(one, dtype=float), np.array(other, dtype=float)
        found.compared.append(Difference(at, "number", _relative(a, b, _peak(a)), NUMBER))
    elif isinstance(one, list) and isinstance(other, list):
        if len(one) != len(other):
            if all(_is_sentence(item) for item in [*one, *other]):
                found.notes.append(f"{at}: {len(one)} texts are {len(other)} now")
            else:
                sizes = f"{len(one)} entries are {len(other)} now"
                found.compared.append(Difference(at, "shape", np.inf, 0.0, sizes))
            return
        for i, pair in enumerate(zip(one, other, strict=True)):
            _compare_data(found, f"{at}, {i}", *pair, key)
    elif isinstance(one, str) and isinstance(other, str):
        if one != other and (_is_sentence(one) or key.endswith("sha256")):
            found.notes.append(f"{at}: {one[:60]!r} is {other[:60]!r} now")
        else:
            found.compared.append(_same_text(at, one, other))
    else:
        found.compared.append(_same_text(at, repr(one), repr(other)))


def _compare_number(
    found: Comparison, at: str, key: str, one: dict[str, Any], other: dict[str, Any]
) -> bool:
    """Compare an entry if both dictionaries have a number there; whether they have."""
    if not (_is_number(one[key]) and _is_number(other[key])):
        return False
    a, b = float(one[key]), float(other[key])
    if key in _LARGEST:
        found.compared.append(Difference(at, "residual", abs(b), _LARGEST[key]))
    elif key in _ABSOLUTE:
        found.compared.append(Difference(at, "absolute", abs(a - b), _ABSOLUTE[key]))
    else:
        beside = [one[k] for k in one if _unit(k) == _unit(key) and _is_number(one[k])]
        size = _relative(np.array([a]), np.array([b]), _peak(np.array(beside)))
        found.compared.append(Difference(at, "number", size, NUMBER, f"{a!r} is {b!r} now"))
    return True


def _relative(one: Array, other: Array, peak: float) -> float:
    """Largest difference over the number itself, or over a share of the peak if that is more."""
    scale = np.maximum(np.abs(one), SMALL * peak)
    difference = _differences(one, other)
    off = np.divide(difference, scale, out=np.full_like(scale, np.inf), where=scale > 0)
    return _peak(np.where(difference == 0, 0.0, off))


def _unit(key: str) -> str:
    """What a key ends with after its last underscore or comma; keys without either have none."""
    return re.split(r"[_,]", key)[-1].strip() if re.search(r"[_,]", key) else ""


def _kept(data: dict[str, Any]) -> list[str]:
    """Keys that do not depend on the machine."""
    return [k for k in data if not any(fnmatch.fnmatchcase(k, p) for p in _OF_THE_MACHINE)]


def _opened(value: Any) -> Any:
    """Plain data: of attributes, also what is written in one as JSON."""
    if isinstance(value, np.generic | np.ndarray):
        return value.tolist()
    if isinstance(value, str) and value.startswith("{"):
        try:
            return json.loads(value)
        except json.JSONDecodeError:
            return value
    return value


def _is_number(value: Any) -> bool:
    return isinstance(value, int | float | np.integer | np.floating) and not isinstance(value, bool)


def _is_array(value: Any) -> bool:
    """Whether a list, perhaps of lists, holds numbers only."""
    if not isinstance(value, list) or not value:
        return False
    if all(map(_is_number, value)):
        return True
    return all(map(_is_array, value)) and len({np.shape(row) for row in value}) == 1


def _is_sentence(value: Any) -> bool:
    """Whether a text is made for people, rather than a name that a program looks for."""
    return isinstance(value, str) and bool(re.search(r"[\s(/]", value))


def _same_text(name: str, one: str, other: str) -> Difference:
    if one == other:
        return Difference(name, "text", 0.0, 0.0)
    return Difference(name, "text", np.inf, 0.0, f"{one[:60]!r} is {other[:60]!r} now")


# --- files of text


def _columns(path: Path) -> dict[str, Any]:
    """A CSV file by column; numbers where all of a column's cells are."""
    with path.open(newline="") as file:
        head, *rows = csv.reader(file)
    columns = zip(*rows, strict=True)
    return {name: _cells(list(column)) for name, column in zip(head, columns, strict=True)}


def _cells(texts: list[str]) -> list[float] | list[str]:
    try:
        return [float(text) for text in texts]
    except ValueError:
        return texts


def _attributes(text: str) -> dict[str, list[float]]:
    """Numbers of an XML file by the attribute that they are in."""
    found: dict[str, list[float]] = {}
    for name, value in _ATTRIBUTE.findall(text):
        parts = value.split()
        if parts and all(_NUMBER.fullmatch(part) for part in parts):
            found.setdefault(name, []).extend(map(float, parts))
    return found


def _numbers(text: str) -> list[float]:
    """Every number that is a word of a text."""
    return [float(word) for word in text.split() if _NUMBER.fullmatch(word)]


def _plain(difference: Difference) -> dict[str, Any]:
    """For JSON, which has no infinity."""
    size = difference.size if np.isfinite(difference.size) else str(difference.size)
    return asdict(difference) | {"size": size}
