"""Mutants of every shipped and documented definition: one leaf or key at a time is spoilt."""

from __future__ import annotations

import copy
import re
from collections.abc import Iterator
from importlib import resources
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

import offwind_pin as ow
from helpers.openfast_files import UNITS, YAW_BEARING, some_load, write_outb
from offwind_pin.analysis.foundation.registry import FOUNDATIONS
from offwind_pin.base.yaml_files import parse_yaml, read_yaml
from offwind_pin.cases.case import Case, TransientAnalysis
from offwind_pin.cases.tower_top import tower_top
from offwind_pin.definitions.reader import definition_of
from offwind_pin.definitions.turbine import Turbine
from offwind_pin.formats.openfast.yaw_bearing_load import ROTOR_APEX

ROOT = Path(__file__).resolve().parents[2]

VALUES: tuple[Any, ...] = (
    None,
    "",
    "x",
    "045",
    "1:30",
    "yes",
    "\u0664\u0660",
    "4_0",
    "\x1b[2J\x00",
    "w" * 5000,
    True,
    -1,
    0,
    2.5,
    10**400,
    1e308,
    1e-300,
    -1e-300,
    1e20,
    1e-20,
    float("nan"),
    float("inf"),
    [],
    {},
    [[]],
    {"x": 1},
)
"""What a leaf or a whole block becomes."""


_SOLVED = ("apparent_fixity", "macro_element")
"""Foundations that take a solve; they are made where their own block has been changed."""


class Seed(NamedTuple):
    """A definition that is valid, as the data of a file."""

    name: str
    kind: type[Turbine] | type[Case]
    data: dict[str, Any]


class Mutant(NamedTuple):
    """A seed with one change."""

    seed: Seed
    place: tuple[str | int, ...]
    change: str
    data: dict[str, Any]


def files(folder: Path) -> None:
    """Write the files that the definitions name."""
    turbine, case = (
        (ROOT / "docs" / f"{name}_file.md").read_text() for name in ("turbine", "case")
    )
    (folder / "my_turbine.yaml").write_text(_blocks(turbine, "yaml")[0])
    (folder / "curves.csv").write_text(_blocks(turbine, "csv")[0])
    (folder / "my_load.txt").write_text(_blocks(case, "text")[0])
    time = np.arange(0.0, 700.0, 0.25)
    wave = np.sin(0.7 * time)
    np.savetxt(folder / "buoy.csv", np.column_stack([time, wave]), fmt="%.4f")
    np.savetxt(folder / "my_record.txt", np.column_stack([time, wave, wave]), fmt="%.4f")
    names = [*YAW_BEARING, *ROTOR_APEX.values(), "Azimuth"]
    data = np.hstack([some_load(time), some_load(time), (50 * time % 360)[:, None]])
    write_outb(folder / "run.outb", 3, time, names, [*UNITS, *UNITS, "(deg)"], data)


def seeds(folder: Path) -> list[Seed]:
    """Every shipped definition, and every block of the docs in one that is valid with it.

    Parameters
    ----------
    folder : Path
        Where :func:`files` has written.
    """
    found = []
    package = resources.files("offwind_pin")
    for kind, part in ((Turbine, "definitions/library"), (Case, "cases/oc6_phase2")):
        paths = sorted(Path(str(package / part)).glob("*.yaml"))
        found += [Seed(path.stem, kind, read_yaml(path)) for path in paths]
    for kind, page in ((Turbine, "turbine_file"), (Case, "case_file")):
        whole, *parts = [
            parse_yaml(text, folder / page)
            for text in _blocks((ROOT / "docs" / f"{page}.md").read_text(), "yaml")
        ]
        assert isinstance(whole, dict)
        if kind is Case:
            whole["turbine"] = "oc6_phase2"  # it has a rotor
        found.append(Seed(page, kind, whole))
        for i, part in enumerate(parts):
            if isinstance(part, dict):
                for data in _merged(whole, part):
                    try:
                        definition_of(data, folder / "seed.yaml", kind)
                    except ow.InputError:
                        continue
                    found.append(Seed(f"{page}, block {i + 2}", kind, data))
                    break
    return found


def _merged(whole: dict[str, Any], part: dict[str, Any]) -> Iterator[dict[str, Any]]:
    """A block at the top level, in the soil, or in the springs of the soil."""
    yield whole | part
    soil = whole.get("soil")
    if soil:
        yield whole | {"soil": soil | part}
        springs = soil.get("distributed_springs")
        if springs:
            yield whole | {"soil": soil | {"distributed_springs": springs | part}}


def _blocks(page: str, language: str) -> list[str]:
    return re.findall(rf"```{language}\n(.*?)```", page, flags=re.DOTALL)


def mutants(all_seeds: list[Seed]) -> list[tuple[Seed, tuple[str | int, ...], int]]:
    """Seed, place and number of the change of every mutant."""
    return [
        (seed, place, change)
        for seed in all_seeds
        for place in _places(seed.data)
        for change in range(len(VALUES) + 2)
    ]


def mutant(seed: Seed, place: tuple[str | int, ...], change: int) -> Mutant:
    """One of them."""
    data = copy.deepcopy(seed.data)
    target: Any = data
    for part in place[:-1]:
        target = target[part]
    last = place[-1]
    if change < len(VALUES):
        target[last] = copy.deepcopy(VALUES[change])
        return Mutant(seed, place, repr(VALUES[change])[:40], data)
    if change == len(VALUES) or isinstance(last, int):
        del target[last]
        return Mutant(seed, place, "dropped", data)
    target[f"{last}_"] = target.pop(last)
    return Mutant(seed, place, "renamed", data)


def _places(data: Any, above: tuple[str | int, ...] = ()) -> Iterator[tuple[str | int, ...]]:
    """Every key and item; of a long list of numbers the first, one in the middle and the last."""
    if isinstance(data, dict):
        items: list[tuple[str | int, Any]] = list(data.items())
    elif isinstance(data, list):
        chosen = range(len(data)) if len(data) < 4 else (0, len(data) // 2, len(data) - 1)
        items = [(i, data[i]) for i in chosen]
    else:
        return
    for name, value in items:
        yield (*above, name)
        yield from _places(value, (*above, name))


def outcome(one: Mutant, folder: Path) -> str:
    """``refused``, or ``valid`` where the definition, its system and its loads can be made.

    Anything else is raised; so is a refusal that does not name the file.
    """
    path = folder / "mutant.yaml"
    try:
        definition = definition_of(one.data, path, one.seed.kind)
    except ow.InputError as error:
        message = str(error)
    else:
        message = ""
    if message:
        assert str(path) in message, message
        assert message.isprintable(), message
        assert len(message) < 20_000, message
        return "refused"
    try:
        if isinstance(definition, Turbine):
            _make_turbine(definition, one.place)
        else:
            _make_case(definition)
    except (ow.InputError, ow.SolverError):
        return "refused"
    return "valid"


def _make_turbine(turbine: Turbine, place: tuple[str | int, ...]) -> None:
    """Systems of a turbine; the damping is calibrated where it has been changed."""
    assert repr(turbine)
    assert turbine.content_hash
    if place[0] != "structural_damping":
        turbine = turbine.model_copy(update={"structural_damping": None})
    refusals = []
    names = [name for name in FOUNDATIONS if name not in _SOLVED or name in place]
    for name in names:
        try:
            system = ow.build(turbine, name, ow.StillWater(), elements=4)
        except ow.InputError as error:
            refusals.append(error)
        else:
            assert np.all(np.isfinite(system.chain.joint_stiffness))
    if len(refusals) == len(names):
        raise refusals[0]


def _make_case(case: Case) -> None:
    """System and loads of a case."""
    assert case.content_hash
    case = case.replace(turbine=case.turbine.model_copy(update={"structural_damping": None}))
    case.build()
    if isinstance(case.analysis, TransientAnalysis):
        tower_top(case, case.turbine, case.analysis)
    if case.earthquake is not None:
        case.earthquake.ground_motion()
