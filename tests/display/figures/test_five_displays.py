"""Reports, animations and pictures of the structure on each of the foundations."""

from __future__ import annotations

import pytest
from helpers.case_results import results
from numpy.testing import assert_array_equal

import offwind_pin as ow
from offwind_pin.analysis.drawing_data import modes_dataset, structure_dataset
from offwind_pin.analysis.foundation.registry import FOUNDATIONS
from offwind_pin.analysis.foundation.study.state import soil_springs
from offwind_pin.definitions.soil.depth_profile import DepthLine
from offwind_pin.definitions.soil.springs import LinearModulus
from offwind_pin.display.figures import results as plots
from offwind_pin.display.report.headline import static_increases
from offwind_pin.display.wording import foundation_name


@pytest.fixture(scope="module")
def systems(undamped: ow.Turbine) -> dict[str, ow.System]:
    still = ow.StillWater()
    return {name: ow.build(undamped, name, still, elements=8) for name in FOUNDATIONS}


def structure_texts(system: ow.System) -> list[str]:
    return [text.get_text() for text in plots.structure(structure_dataset(system)).axes[0].texts]


def test_each_has_a_name_of_its_own() -> None:
    """In plain words, without an underscore; somebody else's keeps its own."""
    names = [foundation_name(name) for name in FOUNDATIONS]
    assert len(set(names)) == len(FOUNDATIONS)
    assert not any("_" in name for name in names)
    assert foundation_name("my_own") == "my_own"


@pytest.mark.parametrize("name", FOUNDATIONS)
def test_report_names_the_foundation(systems: dict[str, ow.System], name: str) -> None:
    system = systems[name]
    states = {name: (system, ow.static(system))}
    page = results(system, statics=states, modes=ow.modes(system, 4).to_dataset()).html()
    assert foundation_name(name) in page
    below = {"apparent_fixity": "from the apparent fixity", "distributed_springs": "pile toe"}
    assert ("from the mudline to the" in page) == (name in below)
    assert below.get(name, "from the mudline") in page
    assert ('id="soil"' in page) == (name == "distributed_springs")


@pytest.mark.parametrize(
    ("name", "said", "not_said"),
    [
        ("clamped", "clamped", "mudline springs"),
        ("apparent_fixity", "apparent fixity", "pile toe"),
        ("coupled_springs", "coupled springs at the mudline", "clamped"),
        ("distributed_springs", "pile toe", "clamped"),
        ("macro_element", "macro-element at the mudline", "coupled"),
    ],
)
def test_picture_shows_what_holds_it(
    systems: dict[str, ow.System], name: str, said: str, not_said: str
) -> None:
    texts = structure_texts(systems[name])
    assert any(said in text for text in texts)
    assert not any(not_said in text for text in texts)
    assert sum("mudline" in text and text.startswith("\u2212") for text in texts) == 1


def test_picture_reaches_the_apparent_fixity(systems: dict[str, ow.System]) -> None:
    """The cantilever is drawn down to its foot, and the ground around it."""
    system = systems["apparent_fixity"]
    axes = plots.structure(structure_dataset(system)).axes[0]
    lowest = min(patch.get_path().vertices[:, 1].min() for patch in axes.patches[1:3])
    assert system.chain.base < system.turbine.site.mudline
    assert axes.get_ylim()[0] < system.chain.base
    assert lowest <= system.chain.base


def test_statics_are_distinguished(systems: dict[str, ow.System]) -> None:
    """Each foundation in a sentence that can be read."""
    states = {name: (system, ow.static(system)) for name, system in systems.items()}
    report = results(systems["clamped"], statics=states).report()
    reported = " ".join(static_increases(report))
    for text in (
        "with apparent fixity below the mudline than clamped at the mudline",
        "on coupled springs at the mudline than",
        "on distributed springs than",
        "on a macro-element at the mudline than",
    ):
        assert text in reported


def test_lateral_springs_alone_are_drawn(undamped: ow.Turbine) -> None:
    """Of several loads of the soil."""
    springs = undamped.soil.distributed_springs
    assert springs is not None
    shaft = LinearModulus(
        kind="linear", modulus_n_per_m2=DepthLine(at_mudline=1e8, source="-"), source="-"
    )
    both = springs.model_copy(update={"vertical": shaft})
    soil = undamped.soil.model_copy(update={"distributed_springs": both})
    system = ow.build(undamped.model_copy(update={"soil": soil}), "distributed_springs", elements=8)
    assert len(system.foundation.soil) == 2
    lateral = soil_springs(system)
    assert lateral is system.foundation.soil[0]
    drawn = modes_dataset(system, ow.modes(system, 1)).spring_height
    assert_array_equal(drawn, lateral.height)
