"""The layering of the package, and its public names."""

from __future__ import annotations

import ast
from pathlib import Path

import pytest

import offwind_pin

PACKAGE = Path(offwind_pin.__file__).parent

BASE = {"errors", "compiled", "number_files"}
"""Modules that every layer may import; of the package they import errors at most."""

ALLOWED: dict[str, set[str]] = {
    "errors": set(),
    "compiled": set(),
    "number_files": {"errors"},
    "turbines": set(),
    "structure": {"turbines"},
    "loads": {"turbines"},
    "solve": set(),
    "results": set(),
    "dynamics": {"turbines", "structure", "loads"},
    "analysis": {"turbines", "structure", "loads", "dynamics", "solve", "results"},
    "signal": {"results"},
}
"""What each folder may import of the package beside the base; display, campaign, verification and cli may import
everything."""

EXCEPTIONS = {"dynamics/compiled_chain.py": {"offwind_pin.solve.generalized_alpha"}}
"""Imports of single files: the compiled chain gives the integrator its functions to compile."""

PINOCCHIO = {"structure", "dynamics"}


def _imports(path: Path) -> set[str]:
    """Full names of everything a file imports."""
    found: set[str] = set()
    for node in ast.walk(ast.parse(path.read_text())):
        if isinstance(node, ast.Import):
            found |= {alias.name for alias in node.names}
        elif isinstance(node, ast.ImportFrom) and node.module:
            assert node.level == 0, f"{path}: relative import"
            found |= {f"{node.module}.{alias.name}" for alias in node.names}
    return found


def _room(path: Path) -> str:
    first = path.relative_to(PACKAGE).parts[0]
    return first.removesuffix(".py")


def _forbidden(room: str, imports: set[str]) -> set[str]:
    """The imports that a room may not have."""
    wrong = set()
    for name in imports:
        parts = name.split(".")
        if parts[0] == "sim" or (parts[0] == "pinocchio" and room not in PINOCCHIO):
            wrong.add(name)
        if parts[0] != "offwind_pin" or room not in ALLOWED:
            continue
        base = set() if room in BASE else BASE
        if parts[1] not in ALLOWED[room] | base | {room}:
            wrong.add(name)
    return wrong


@pytest.mark.parametrize("path", sorted(PACKAGE.rglob("*.py")), ids=lambda p: p.stem)
def test_imports_follow_the_layers(path: Path) -> None:
    """Each file imports only what its layer may."""
    room = _room(path)
    if room in {"__init__", "__main__"}:
        return
    allowed = EXCEPTIONS.get(path.relative_to(PACKAGE).as_posix(), set())
    assert _forbidden(room, _imports(path)) - allowed == set()


def test_exceptions_are_needed() -> None:
    """An exception whose file no longer imports what it names is taken off the list."""
    for name, imports in EXCEPTIONS.items():
        assert imports <= _imports(PACKAGE / name)


def test_the_rule_can_fail() -> None:
    """Negative control: imports against the layers are found."""
    assert _forbidden("loads", {"pinocchio.rnea"})
    assert _forbidden("solve", {"offwind_pin.turbines.definition"})
    assert _forbidden("structure", {"offwind_pin.dynamics.system"})
    assert _forbidden("dynamics", {"offwind_pin.solve.newton"})
    assert _forbidden("compiled", {"offwind_pin.errors.InputError"})
    assert not _forbidden("solve", {"offwind_pin.compiled.kernel"})
    assert not _forbidden("dynamics", {"pinocchio.rnea", "offwind_pin.loads.soil"})


def test_every_folder_has_a_rule() -> None:
    """A new folder must be given its layer."""
    folders = {p.name for p in PACKAGE.iterdir() if p.is_dir() and p.name != "__pycache__"}
    assert folders <= ALLOWED.keys() | {"display", "campaign", "verification"}


def test_public_names() -> None:
    """The public surface changes on purpose only."""
    assert sorted(offwind_pin.__all__) == [
        "Accelerations",
        "AdaptiveStep",
        "Condensation",
        "Crest",
        "CrossSpectra",
        "CurrentSum",
        "CurrentTable",
        "DampedAbsorber",
        "DeflectionTarget",
        "ExtremeOperatingGust",
        "FixedStep",
        "FreeDecay",
        "FrequencyTarget",
        "GeneralizedAlpha",
        "GroundMotion",
        "Identification",
        "InputError",
        "InterruptedSimulation",
        "IrregularWaves",
        "JonswapSpectrum",
        "LoadHistory",
        "LogLaw",
        "MeasuredWaves",
        "ModalResult",
        "OffwindError",
        "OperationalModes",
        "Parameter",
        "PowerLaw",
        "PowerLawCurrent",
        "Pushover",
        "RegularWaves",
        "RotorThrust",
        "RotorWind",
        "SciPyIVP",
        "ShapeTarget",
        "SoilOverview",
        "SolverError",
        "Spreading",
        "StaticResult",
        "StillWater",
        "StreamWaves",
        "SurfaceCurrent",
        "SurfaceRecord",
        "SyntheticWind",
        "System",
        "TableSpectrum",
        "TmaSpectrum",
        "TowerWind",
        "Turbine",
        "UniformCurrent",
        "WhiteNoise",
        "WindSeries",
        "aerodynamic_damping",
        "build",
        "condense",
        "cross_spectral_matrix",
        "den_hartog",
        "equivalent_damping",
        "export_urdf",
        "free_decay",
        "identify_soil",
        "load_turbine",
        "modal_assurance",
        "modes",
        "operational_modes",
        "pile_only",
        "pushover",
        "read_accelerations",
        "read_load_history",
        "rotor_disc",
        "shipped_turbines",
        "simulate",
        "soil_overview",
        "static",
        "thrust_curve",
        "tower_drag",
        "write_soil",
    ]
    assert all(hasattr(offwind_pin, name) for name in offwind_pin.__all__)
