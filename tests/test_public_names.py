"""The public names: one object under every name, in short lists, known to type checkers."""

from __future__ import annotations

import ast
import importlib.util
import pickle
from pathlib import Path
from types import ModuleType

import pytest

import offwind_pin as ow

NAMESPACES = (ow, ow.sea, ow.signal, ow.soil, ow.wind)

MOVED = {
    "sea": {"Crest", "CurrentSum", "CurrentTable", "MeasuredWaves", "PowerLawCurrent", "Spreading"}
    | {"StreamWaves", "SurfaceCurrent", "SurfaceRecord", "TableSpectrum", "TmaSpectrum"}
    | {"UniformCurrent", "WhiteNoise"},
    "signal": {"Accelerations", "CrossSpectra", "FreeDecay", "OperationalModes", "free_decay"}
    | {"cross_spectral_matrix", "modal_assurance", "operational_modes", "read_accelerations"},
    "soil": {"Condensation", "DeflectionTarget", "FrequencyTarget", "Parameter"}
    | {"Pushover", "ShapeTarget", "SoilOverview", "condense", "equivalent_damping"}
    | {"identify_soil", "pile_only", "pushover", "soil_overview", "write_soil"},
    "wind": {"ExtremeOperatingGust", "LogLaw", "PowerLaw", "RotorWind", "SyntheticWind"}
    | {"TowerWind", "WindSeries", "aerodynamic_damping", "rotor_disc", "thrust_curve"}
    | {"tower_drag"},
}
"""Names that were at the top in version 0.1, by the namespace that they have moved to."""


@pytest.mark.parametrize("space", NAMESPACES, ids=lambda space: space.__name__)
def test_listed_names_are_there(space: ModuleType) -> None:
    assert dir(space) == space.__all__
    for name in space.__all__:
        assert getattr(space, name) is not None
    with pytest.raises(AttributeError, match="no_such_name"):
        _ = space.no_such_name


@pytest.mark.parametrize("space", NAMESPACES, ids=lambda space: space.__name__)
def test_no_name_hides_a_module(space: ModuleType) -> None:
    """Python would put an imported submodule in the place of an object of that name."""
    for name in space.__all__:
        if hasattr(space, "__path__") and not isinstance(getattr(space, name), ModuleType):
            assert importlib.util.find_spec(f"{space.__name__}.{name}") is None


def test_namespaces_share_their_objects_with_the_top() -> None:
    for space in NAMESPACES[1:]:
        for name in space.__all__:
            if name in ow.__all__:
                assert getattr(ow, name) is getattr(space, name)


def test_moved_names_are_kept() -> None:
    """They are the same objects, and no longer in the list of the top."""
    for space, names in MOVED.items():
        assert names <= set(getattr(ow, space).__all__)
        for name in names:
            assert getattr(ow, name) is getattr(getattr(ow, space), name)
            assert name not in ow.__all__


def test_a_name_imported_from_the_top_pickles() -> None:
    assert pickle.loads(pickle.dumps(ow.StillWater())) == ow.StillWater()


@pytest.mark.parametrize("space", NAMESPACES, ids=lambda space: space.__name__)
def test_every_name_of_a_stub_can_be_imported(space: ModuleType) -> None:
    """What type checkers read in the stub is what Python finds."""
    assert space.__file__ is not None
    stub = ast.parse(Path(space.__file__).with_suffix(".pyi").read_text())
    imports = [node for node in stub.body if isinstance(node, ast.ImportFrom)]
    names = {alias.asname or alias.name for node in imports for alias in node.names}
    assert set(space.__all__) <= names
    for name in names:
        getattr(space, name)


def test_renamed_names_are_still_there() -> None:
    """Names of version 0.1 that have another name now."""
    assert ow.Identification is ow.soil.SoilIdentification
