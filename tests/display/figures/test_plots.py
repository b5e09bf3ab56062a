"""Figures hold the right data, name their units, and leave matplotlib as it was."""

from __future__ import annotations

import re
from collections.abc import Iterator
from itertools import pairwise

import matplotlib as mpl
import numpy as np
import pytest
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.text import Annotation
from numpy.testing import assert_allclose

import offwind_pin as ow
from offwind_pin.analysis.drawing_data import soil_dataset, structure_dataset
from offwind_pin.analysis.foundation.study.state import soil_displacement_reached, soil_springs
from offwind_pin.definitions.turbine import RigidBodyRNA
from offwind_pin.display.figures import results as plots
from offwind_pin.display.figures.style import powers_of_ten, spread, thin, to_svg
from offwind_pin.display.wording import MINUS

RAMP = 4.0


@pytest.fixture(scope="module")
def histories(coarse: ow.System) -> xr.Dataset:
    """Twenty seconds of wind and waves on few elements."""
    wind = ow.SyntheticWind(9.06, 0.388)
    load = wind.generate(coarse.turbine.rna, duration=20.0, repeat_period=20.0, dt=0.05)
    return ow.simulate(coarse, 20.0, 0.05, [load], ramp=RAMP)


@pytest.fixture(scope="module")
def coarse_modes(coarse: ow.System) -> ow.ModalResult:
    return ow.modes(coarse, 8)


@pytest.fixture(scope="module")
def states(undamped: ow.Turbine) -> dict[str, ow.StaticResult]:
    names = ("clamped", "distributed_springs")
    return {name: ow.static(ow.build(undamped, name, elements=8)) for name in names}


@pytest.fixture(autouse=True)
def settings_stay() -> Iterator[None]:
    """No figure changes matplotlib's settings."""
    before = dict(mpl.rcParams)
    yield
    assert dict(mpl.rcParams) == before


def texts(axes: Axes) -> list[str]:
    return [text.get_text() for text in axes.texts]


def with_id(axes: Axes, gid: str) -> list[mpl.artist.Artist]:
    return axes.findobj(lambda artist: artist.get_gid() == gid)


def widest(axes: Axes) -> mpl.lines.Line2D:
    """The curve that stands for the mean: the widest one."""
    return max(axes.lines, key=lambda line: line.get_linewidth())


def psd_figure(**options: object) -> Figure:
    frequency = np.linspace(0, 2, 401)
    density = 1e12 * (1 + 1 / (0.01 + (frequency - 0.24) ** 2))
    marked = {"9P": 1.163, "FA1": 0.236, "FA2": 1.137, "wave peak": 0.182, "far away": 3.0}
    return plots.moment_psd(frequency, density, marked, peaks=(0.24,), **options)


class TestStructure:
    def test_draws_every_element_boundary(self, coarse: ow.System) -> None:
        axes = plots.structure(structure_dataset(coarse)).axes[0]
        (lines,) = with_id(axes, "element-boundaries")
        drawn = np.array([segment[0, 1] for segment in lines.get_segments()])
        assert_allclose(drawn, coarse.chain.boundary)
        widths = [np.ptp(segment[:, 0]) for segment in lines.get_segments()]
        assert widths[0] == pytest.approx(9.0)
        assert widths[-1] == pytest.approx(5.5)

    def test_is_to_scale(self, coarse: ow.System) -> None:
        assert all(
            axes.get_aspect() == 1.0 for axes in plots.structure(structure_dataset(coarse)).axes
        )

    def test_has_a_spring_on_either_side_of_every_node(self, coarse: ow.System) -> None:
        soil = soil_springs(coarse)
        assert soil is not None
        for axes in plots.structure(structure_dataset(coarse)).axes:
            (lines,) = with_id(axes, "soil-springs")
            springs = lines.get_segments()
            heights = {round(float(spring[0, 1]), 6) for spring in springs}
            assert len(springs) == 2 * len(soil.height)
            assert heights == {round(float(height), 6) for height in soil.height}

    def test_names_the_main_heights(self, coarse: ow.System) -> None:
        said = " ".join(texts(plots.structure(structure_dataset(coarse)).axes[0]))
        for height in ("+115.63 m", "+10.00 m", "0 m", f"{MINUS}30.00 m", f"{MINUS}75.00 m"):
            assert height in said

    @pytest.mark.parametrize(
        ("foundation", "sign"), [("clamped", "clamped"), ("coupled_springs", "coupled springs")]
    )
    def test_foundations_without_springs_along_the_pile(
        self, undamped: ow.Turbine, foundation: str, sign: str
    ) -> None:
        system = ow.build(undamped, foundation, elements=6)
        figure = plots.structure(structure_dataset(system))
        assert len(figure.axes) == 1
        assert not with_id(figure.axes[0], "soil-springs")
        assert any(sign in text for text in texts(figure.axes[0]))
        assert "pile toe" not in " ".join(texts(figure.axes[0]))

    def test_dry_structures_have_no_water(self, undamped: ow.Turbine) -> None:
        wet, dry = (
            plots.structure(structure_dataset(ow.build(undamped, "clamped", sea, elements=6))).axes[
                0
            ]
            for sea in (ow.StillWater(), None)
        )
        assert len(wet.collections) == len(dry.collections) + 1
        assert any("dry" in text for text in texts(dry))

    def test_draws_a_rotor_nacelle_assembly_given_as_one_body(self, undamped: ow.Turbine) -> None:
        body = RigidBodyRNA(
            kind="rigid_body",
            mass=5e5,
            center_of_mass=(-3.0, 0.0, 2.0),
            inertia=((1e7, 0, 0), (0, 1e7, 0), (0, 0, 1e7)),
        )
        turbine = undamped.model_copy(update={"rna": body})
        said = texts(
            plots.structure(structure_dataset(ow.build(turbine, "clamped", elements=6))).axes[0]
        )
        assert any("500 t" in text and f"x = {MINUS}3.00" in text for text in said)


class TestModeShapes:
    def test_curves_are_the_shapes(self, coarse_modes: ow.ModalResult) -> None:
        axes = plots.mode_shapes(coarse_modes, -30.0).axes[0]
        i = coarse_modes.index("FA2")
        (line,) = [line for line in axes.lines if str(line.get_label()).startswith("FA2")]
        assert_allclose(line.get_xdata(), coarse_modes.shape[i, :, 0])
        assert_allclose(line.get_ydata(), coarse_modes.height)
        assert f"{coarse_modes.frequency_hz[i]:.3f} Hz" in str(line.get_label())

    def test_one_panel_for_each_family(self, coarse_modes: ow.ModalResult) -> None:
        figure = plots.mode_shapes(coarse_modes, -30.0)
        titles = [axes.get_title("left") for axes in figure.axes]
        assert titles == ["Fore-aft", "Side-side", "Torsion"]

    def test_dots_mark_the_peaks(self, coarse_modes: ow.ModalResult) -> None:
        axes = plots.mode_shapes(coarse_modes, -30.0).axes[0]
        dots = [line for line in axes.lines if line.get_marker() == "o"]
        assert 2 <= len(dots) <= 3
        assert all(abs(dot.get_xdata()[0]) == pytest.approx(1.0) for dot in dots)

    def test_dampers_take_no_place_of_the_structure(self, undamped: ow.Turbine) -> None:
        """Three dampers along x; the second fore-aft mode is drawn beside them all."""
        dampers = [
            {
                "name": f"d{i}",
                "z_m": undamped.yaw_bearing - 1.0,
                "mass_kg": 1e4,
                "direction": "fore_aft",
                "frequency_hz": 0.2 + 0.01 * i,
                "damping_ratio": 0.05,
            }
            for i in range(3)
        ]
        described = undamped.model_dump(by_alias=True) | {"tuned_mass_dampers": dampers}
        turbine = ow.Turbine.model_validate(described)
        found = ow.modes(ow.build(turbine, "clamped", elements=8), 10)
        drawn = [
            str(line.get_label()).split()[0]
            for line in plots.mode_shapes(found, -20.0).axes[0].lines
        ]
        assert {"FA1", "FA2", "TMD1", "TMD2", "TMD3"} <= set(drawn)

    def test_marks_mudline_and_water(self, coarse_modes: ow.ModalResult) -> None:
        wet, dry = (
            plots.mode_shapes(coarse_modes, -30.0, water=water).axes[0] for water in (0.0, None)
        )
        assert texts(wet) == ["mudline", "still water"]
        assert texts(dry) == ["mudline"]


class TestStatics:
    def test_shapes_and_moments(self, states: dict[str, ow.StaticResult]) -> None:
        shape, moment = plots.statics(states).axes
        for axes, column in ((shape, "displacement"), (moment, "section_load")):
            curves = [line for line in axes.lines if len(line.get_xdata()) > 2]
            for curve, state in zip(curves, states.values(), strict=True):
                values = {
                    "displacement": state.displacement[:, 0],
                    "section_load": state.section_load[:, 4] / 1e6,
                }
                assert_allclose(curve.get_xdata(), values[column])
                assert_allclose(curve.get_ydata(), state.height)
        assert shape.get_xlabel().endswith(", m")
        assert moment.get_xlabel().endswith(", MN m")

    def test_names_foundations_and_displacements(self, states: dict[str, ow.StaticResult]) -> None:
        shape = plots.statics(states).axes[0]
        legend = [text.get_text() for text in shape.get_legend().get_texts()]
        assert legend == ["clamped at the mudline", "distributed springs"]
        for state in states.values():
            value = f"{state.tower_top_displacement[0]:+.3f} m".replace("-", MINUS)
            assert value in texts(shape)


class TestTimeHistories:
    def test_channels_over_time(self, histories: xr.Dataset) -> None:
        figure = plots.time_histories(histories)
        thrust, wave, top, moment = figure.axes
        assert_allclose(thrust.lines[0].get_ydata(), histories.tower_top_load[:, 0] / 1e6)
        assert_allclose(wave.lines[0].get_ydata(), histories.wave_elevation)
        assert_allclose(top.lines[0].get_ydata(), histories.tower_top_displacement[:, 0])
        assert_allclose(moment.lines[0].get_ydata(), histories.mudline_moment[:, 1] / 1e6)
        assert [axes.get_ylabel() for axes in figure.axes] == ["MN", "m", "m", "MN m"]
        assert moment.get_xlabel() == "time, s"

    def test_ramp_is_shaded(self, histories: xr.Dataset) -> None:
        for axes in plots.time_histories(histories).axes:
            (shade,) = with_id(axes, "ramp")
            assert (shade.get_x(), shade.get_width()) == (0, RAMP)
        calm = histories.assign_attrs(ramp_s=0.0)
        assert not with_id(plots.time_histories(calm).axes[0], "ramp")

    def test_loads_that_do_not_act_are_left_out(self, histories: xr.Dataset) -> None:
        still = histories.assign(wave_elevation=0 * histories.wave_elevation)
        titles = [axes.get_title("left") for axes in plots.time_histories(still).axes]
        assert len(titles) == 3
        assert not any("Wave" in title for title in titles)

    def test_long_cases_show_their_last_minute(self, histories: xr.Dataset) -> None:
        longer = histories.assign_coords(time=10 * histories.time)
        figure = plots.time_histories(longer)
        assert len(figure.axes) == 8
        last = figure.axes[1]
        assert last.get_xlim() == (140.0, 200.0)
        assert last.lines[0].get_xdata()[0] >= 140.0


class TestMomentPsd:
    def test_marks_stand_at_their_frequencies(self) -> None:
        axes = psd_figure().axes[0]
        for name, frequency in (("FA1", 0.236), ("9P", 1.163), ("wave peak", 0.182)):
            (line,) = with_id(axes, f"mark {name}")
            assert list(line.get_xdata()) == [frequency, frequency]
            assert f"{name}\n{frequency:.3f}" in texts(axes)

    def test_modes_and_excitations_are_distinguished(self) -> None:
        axes = psd_figure().axes[0]
        color = {
            name: with_id(axes, f"mark {name}")[0].get_color()
            for name in ("FA1", "FA2", "9P", "wave peak")
        }
        assert color["FA1"] == color["FA2"] != color["9P"] == color["wave peak"]

    def test_frequencies_beyond_the_axis_are_left_out(self) -> None:
        axes = psd_figure().axes[0]
        assert axes.get_xlim() == (0, 1.6)
        assert not with_id(axes, "mark far away")
        assert axes.lines[0].get_xdata().max() <= 1.6

    def test_labels_do_not_overlap(self) -> None:
        figure = psd_figure()
        with mpl.rc_context({"svg.fonttype": "none"}):
            figure.draw_without_rendering()
        axes = figure.axes[0]
        labels = [
            text.get_window_extent()
            for text in axes.texts
            if isinstance(text, Annotation) and "\n" in text.get_text()
        ]
        labels.sort(key=lambda box: box.x0)
        assert len(labels) == 4
        assert all(a.x1 < b.x0 for a, b in pairwise(labels))

    def test_bands_and_peaks(self) -> None:
        axes = psd_figure(bands=((0.2, 0.3), (1.0, 1.5))).axes[0]
        spans = [(band.get_x(), band.get_x() + band.get_width()) for band in with_id(axes, "band")]
        assert_allclose(spans, [(0.2, 0.3), (1.0, 1.5)])
        (dots,) = with_id(axes, "peaks")
        assert list(dots.get_xdata()) == [0.24]
        assert dots.get_ydata()[0] == pytest.approx(101.0)

    def test_axes_are_logarithmic_with_units(self) -> None:
        axes = psd_figure().axes[0]
        assert axes.get_yscale() == "log"
        assert axes.get_ylabel() == "PSD of the moment, (MN m)²/Hz"
        assert axes.get_xlabel() == "frequency, Hz"


class TestSectionLoadEnvelope:
    def test_mean_and_extremes_after_the_ramp(self, histories: xr.Dataset) -> None:
        moment, shear = plots.section_load_envelope(histories).axes
        after = histories.where(histories.time >= RAMP, drop=True)
        expected = after.section_moment.sel(direction="y") / 1e6
        assert_allclose(widest(moment).get_xdata(), expected.mean("time"))
        curves = {line.get_label(): line.get_xdata() for line in moment.lines}
        assert_allclose(curves["smallest"], expected.min("time"))
        assert_allclose(curves["largest"], expected.max("time"))
        force = after.section_force.sel(direction="x") / 1e6
        assert_allclose(widest(shear).get_xdata(), force.mean("time"))
        assert shear.get_xlabel().endswith(", MN")

    def test_the_ramp_would_change_it(self, histories: xr.Dataset) -> None:
        with_ramp = plots.section_load_envelope(histories.assign_attrs(ramp_s=0.0)).axes[0]
        without = plots.section_load_envelope(histories).axes[0]
        assert not np.allclose(widest(with_ramp).get_xdata(), widest(without).get_xdata())


class TestSoilCurves:
    def test_dots_lie_on_the_curves_of_their_depth(self, coarse: ow.System) -> None:
        soil = soil_springs(coarse)
        assert soil is not None
        reached = np.linspace(0.02, 0.001, len(soil.height))
        axes = plots.p_y_curves(soil_dataset(soil, -30.0, reached)).axes[0]
        dots = [line for line in axes.lines if line.get_marker() == "o"]
        resistance = soil.curves.resistance(reached) / 1e6
        assert len(dots) == 5
        for dot in dots:
            node = int(np.argmin(np.abs(1e3 * reached - dot.get_xdata()[0])))
            assert dot.get_xdata()[0] == pytest.approx(1e3 * reached[node])
            assert dot.get_ydata()[0] == pytest.approx(resistance[node], rel=1e-3)

    def test_without_displacements_there_are_no_dots(self, coarse: ow.System) -> None:
        soil = soil_springs(coarse)
        assert soil is not None
        axes = plots.p_y_curves(soil_dataset(soil, -30.0)).axes[0]
        assert [line.get_marker() for line in axes.lines] == ["None"] * 5
        assert axes.get_xlabel() == "lateral displacement y, mm"
        assert axes.get_ylabel() == "soil resistance p, MN/m"

    def test_displacement_reached_is_the_largest_after_the_ramp(
        self, histories: xr.Dataset, coarse: ow.System
    ) -> None:
        soil = soil_springs(coarse)
        assert soil is not None
        reached = soil_displacement_reached(histories, soil)
        at_mudline = histories.displacement.sel(height=-30.0, time=slice(RAMP, None))
        size = np.hypot(at_mudline.sel(direction="x"), at_mudline.sel(direction="y"))
        assert reached[0] == pytest.approx(float(size.max()))
        assert reached[0] > 5 * reached[-1]


class TestSvg:
    def test_is_the_same_text_every_time(self) -> None:
        assert to_svg(psd_figure(), "psd") == to_svg(psd_figure(), "psd")

    def test_text_stays_text(self) -> None:
        svg = to_svg(psd_figure(), "psd")
        assert ">frequency, Hz</text>" in svg
        assert "wave peak" in svg

    def test_holds_no_address_and_every_reference_is_its_own(self) -> None:
        svg = to_svg(psd_figure(), "psd")
        assert svg.startswith("<svg")
        assert svg.endswith("</svg>")
        assert "http" not in svg
        ids = re.findall(r'\bid="([^"]+)"', svg)
        assert all(name.startswith("psd-") for name in ids)
        assert len(set(ids)) == len(ids)
        targets = re.findall(r'href="#([^"]+)"', svg) + re.findall(r"url\(#([^)]+)\)", svg)
        assert targets
        assert set(targets) <= set(ids)

    def test_names_are_text_not_formulas_nor_markup(self) -> None:
        frequency = np.linspace(0.01, 2, 50)
        figure = plots.moment_psd(frequency, 1e12 / frequency, {"$x<b>": 0.5})
        assert "$x&lt;b&gt;" in to_svg(figure, "psd")


class TestSpread:
    def test_leaves_alone_what_is_apart(self) -> None:
        assert_allclose(spread([3.0, 1.0, 2.0], 0.5), [3.0, 1.0, 2.0])

    def test_parts_a_pair_evenly(self) -> None:
        assert_allclose(spread([1.0, 1.2], 1.0), [0.6, 1.6])

    def test_keeps_order_and_distance(self) -> None:
        wanted = np.random.default_rng(5).uniform(0, 4, 12)
        places = spread(wanted, 0.4)
        order = np.argsort(wanted)
        assert np.all(np.diff(places[order]) >= 0.4 - 1e-12)
        assert places.mean() == pytest.approx(wanted.mean(), abs=0.2)

    def test_of_nothing_is_nothing(self) -> None:
        assert spread([], 1.0).shape == (0,)


class TestThin:
    def test_keeps_every_extreme(self) -> None:
        time = np.linspace(0, 100, 10_001)
        values = np.random.default_rng(2).normal(size=time.size)
        kept_time, kept = thin(time, values, 200)
        assert len(kept) <= 400
        assert (kept.min(), kept.max()) == (values.min(), values.max())
        assert np.all(np.diff(kept_time) > 0)
        assert_allclose(values[np.searchsorted(time, kept_time)], kept)

    def test_leaves_short_histories_alone(self) -> None:
        time = np.arange(10.0)
        assert thin(time, time, 8)[0] is time


def test_powers_of_ten_are_plain_characters() -> None:
    assert [powers_of_ten(value) for value in (1e-4, 1.0, 1e12)] == ["10⁻⁴", "10⁰", "10¹²"]
