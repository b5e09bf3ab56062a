"""What the pictures of a sea show: Airy's and Morison's closed forms, spectra, and the axes."""

from __future__ import annotations

import numpy as np
import pytest
from helpers.case_results import Results, results
from helpers.hydrodynamics import upright
from matplotlib.axes import Axes
from numpy.testing import assert_allclose

import offwind_pin as ow
from offwind_pin.analysis import sea_data
from offwind_pin.analysis.drawing_data import structure_dataset
from offwind_pin.base.definition import Array
from offwind_pin.display.figures import results as plots
from offwind_pin.display.figures import sea as sea_plots
from offwind_pin.display.figures.style import to_svg
from offwind_pin.display.report.sea import sea_pictures
from offwind_pin.loads.sea.hydrodynamic_loads import HydrodynamicModel
from offwind_pin.loads.sea.sea import Sea
from offwind_pin.loads.sea.waves.dispersion import wave_number
from offwind_pin.signal.spectra import power_spectral_density

HEIGHT, PERIOD, DEPTH = 4.0, 9.0, 30.0
OMEGA = 2 * np.pi / PERIOD


@pytest.fixture(scope="module")
def sea() -> ow.IrregularWaves:
    return ow.IrregularWaves(4.0, 9.0, seed=2, repeat_period=3600.0, peak_shape=3.3)


@pytest.fixture(scope="module")
def run(coarse: ow.System) -> Results:
    histories = ow.simulate(coarse, 20.0, 0.05, ramp=4.0)
    return results(coarse, root=histories, waves=sea_data.waves_dataset(coarse, histories, 200.0))


def airy(turbine: ow.Turbine, z: Array) -> Array:
    """Amplitude of the horizontal velocity in m/s at heights over the mean level in m."""
    k = wave_number(np.array([OMEGA]), DEPTH, turbine.site.gravity)[0]
    return HEIGHT / 2 * OMEGA * np.cosh(k * (z + DEPTH)) / np.sinh(k * DEPTH)


def texts(axes: Axes) -> list[str]:
    return [text.get_text() for text in axes.texts]


class TestPhases:
    def test_of_a_regular_wave(self, undamped: ow.Turbine) -> None:
        """Crest at 0: crossing a quarter of a period before, trough half a period after."""
        hydrodynamics = HydrodynamicModel.of(undamped, ow.RegularWaves(HEIGHT, PERIOD))
        found = sea_data.phases(hydrodynamics.surface, hydrodynamics.surface.waves, 3 * PERIOD)
        assert found.crossing == pytest.approx(2.75 * PERIOD, abs=1e-4)
        assert found.trough == pytest.approx(3.5 * PERIOD, abs=PERIOD / 200)

    def test_of_irregular_waves(self, undamped: ow.Turbine) -> None:
        """The surface is nothing at the crossing, and never between it and the crest."""
        hydrodynamics = HydrodynamicModel.of(
            undamped, ow.IrregularWaves(4.0, 9.0, seed=1, repeat_period=600.0)
        )
        time = np.arange(0, 600, 0.1)
        crest = float(time[np.argmax(hydrodynamics.surface.elevation(time))])
        found = sea_data.phases(hydrodynamics.surface, hydrodynamics.surface.waves, crest)
        assert abs(hydrodynamics.surface.elevation(np.array([found.crossing]))[0]) < 1e-3
        between = np.linspace(found.crossing + 1e-3, crest, 200)
        assert np.all(hydrodynamics.surface.elevation(between) > 0)
        assert hydrodynamics.surface.elevation(np.array([found.trough]))[0] < 0
        assert crest < found.trough < crest + 12

    def test_mean_period_is_that_of_the_moments(self, undamped: ow.Turbine) -> None:
        hydrodynamics = HydrodynamicModel.of(undamped, ow.RegularWaves(HEIGHT, PERIOD))
        assert sea_data.mean_period(hydrodynamics.surface.waves) == pytest.approx(PERIOD)

    @pytest.mark.parametrize("angle", [0.0, 30.0, -120.0])
    @pytest.mark.parametrize("kind", [ow.RegularWaves, ow.StreamWaves])
    def test_direction_is_where_waves_travel(
        self, undamped: ow.Turbine, kind: type, angle: float
    ) -> None:
        waves = HydrodynamicModel.of(
            undamped, kind(HEIGHT, PERIOD, direction_deg=angle)
        ).surface.waves
        along = sea_data.wave_direction(waves)
        assert_allclose(along, [np.cos(np.radians(angle)), np.sin(np.radians(angle))], atol=1e-6)


class TestProfiles:
    def test_at_a_crest_and_before_it_are_airys(self, undamped: ow.Turbine) -> None:
        """Velocity with the current at the crest, acceleration at the crossing, up to the level."""
        current = ow.PowerLawCurrent(0.7, 40.0)
        sea = ow.RegularWaves(HEIGHT, PERIOD, current=current, water_level=0.0)
        hydrodynamics = HydrodynamicModel.of(undamped, sea)
        crest, crossing = sea_data.profiles(hydrodynamics, sea, np.array([0.0, -PERIOD / 4]))
        speed = airy(undamped, crest.height)
        flow = current.velocity(crest.height, DEPTH)[:, :2]
        assert_allclose(crest.velocity, np.column_stack([speed, 0 * speed]) + flow, atol=1e-9)
        assert_allclose(crest.current, flow)
        assert_allclose(crest.acceleration, 0, atol=1e-9)
        assert_allclose(crossing.acceleration[:, 0], OMEGA * speed, rtol=1e-9)
        assert crest.elevation == pytest.approx(HEIGHT / 2)
        assert (crest.height[0], crest.height[-1]) == (-DEPTH, 0.0)

    def test_reach_the_moving_surface_with_stretching(self, undamped: ow.Turbine) -> None:
        """Wheeler's and vertical profiles end at crest and trough with the value at the level."""
        for rule in ("wheeler", "vertical"):
            sea = ow.RegularWaves(HEIGHT, PERIOD, stretching=rule)
            hydrodynamics = HydrodynamicModel.of(undamped, sea)
            crest, trough = sea_data.profiles(hydrodynamics, sea, np.array([0.0, PERIOD / 2]))
            assert crest.height[-1] == pytest.approx(HEIGHT / 2)
            assert trough.height[-1] == pytest.approx(-HEIGHT / 2)
            top = airy(undamped, np.zeros(1))[0]
            assert crest.velocity[-1, 0] == pytest.approx(top, rel=1e-5)
        # negative control: the rules differ at the trough, where Wheeler brings the level down
        assert trough.velocity[-1, 0] == pytest.approx(
            -airy(undamped, np.array([-HEIGHT / 2]))[0], rel=1e-5
        )
        assert abs(trough.velocity[-1, 0]) < 0.95 * top

    def test_stand_on_the_water_level(self, undamped: ow.Turbine) -> None:
        sea = ow.RegularWaves(HEIGHT, PERIOD, water_level=2.0)
        (crest,) = sea_data.profiles(HydrodynamicModel.of(undamped, sea), sea, np.zeros(1))
        assert crest.height[-1] == 2.0


class TestSpectrum:
    def test_target_has_the_significant_height(self, sea: ow.IrregularWaves) -> None:
        target = sea_data.target_density(sea, 30.0, 9.80665)
        assert target is not None
        frequency = np.linspace(0.02, 2.0, 20001)
        area = np.trapezoid(target(frequency), frequency)
        assert 4 * np.sqrt(area) == pytest.approx(4.0, rel=0.01)

    def test_that_of_a_tma_sea_knows_the_depth(self) -> None:
        made = ow.IrregularWaves(
            spectrum=ow.TmaSpectrum(4.0, 9.0, 3.3), seed=1, repeat_period=600.0
        )
        frequency = np.array([0.1, 0.2])
        deep, shallow = (sea_data.target_density(made, depth, 9.81) for depth in (500.0, 15.0))
        assert deep is not None
        assert shallow is not None
        assert shallow(frequency)[0] / deep(frequency)[0] < 0.98

    def test_waves_without_spectrum_have_no_target(self, undamped: ow.Turbine) -> None:
        for sea in (ow.RegularWaves(HEIGHT, PERIOD), ow.StreamWaves(HEIGHT, PERIOD)):
            assert sea_data.target_density(sea, 30.0, 9.80665) is None
            waves = HydrodynamicModel.of(undamped, sea).surface.waves
            assert not sea_data.has_spectrum(waves)

    def test_bands_hold_the_variance_and_lie_on_the_target(
        self, undamped: ow.Turbine, sea: ow.IrregularWaves
    ) -> None:
        waves = HydrodynamicModel.of(undamped, sea).surface.waves
        frequency, density = sea_data.component_density(waves, 0.002)
        width = frequency[1] - frequency[0]
        assert width == pytest.approx(0.0022222, rel=1e-3)
        variance = np.sum(np.abs(waves.elevation) ** 2) / 2
        assert np.sum(density) * width == pytest.approx(variance, rel=1e-3)
        target = sea_data.target_density(sea, 30.0, 9.80665)
        assert target is not None
        assert_allclose(density, target(frequency), rtol=0.02, atol=2e-3 * density.max())

    def test_one_band_holds_a_narrow_sea(self, undamped: ow.Turbine) -> None:
        """A sea narrower than the bands asked for is one band with all its variance."""
        noise = ow.WhiteNoise(1.0, 0.1, 0.12)
        waves = HydrodynamicModel.of(
            undamped, ow.IrregularWaves(spectrum=noise, seed=1, repeat_period=1000.0)
        ).surface.waves
        (frequency,), (density,) = sea_data.component_density(waves, 0.2)
        assert frequency == pytest.approx(0.11, abs=1e-3)
        assert density * 21 / 1000 == pytest.approx(1 / 16, rel=0.06)

    def test_the_set_down_is_no_variance(self, undamped: ow.Turbine) -> None:
        """Waves of second order begin at harmonic 0, whose square is no part of the variance."""
        steep = ow.IrregularWaves(6.0, 12.0, seed=1, repeat_period=600.0, order=2)
        waves = HydrodynamicModel.of(undamped, steep).surface.waves
        assert abs(waves.elevation[0]) > 0.01
        frequency, density = sea_data.component_density(waves, 1 / 600)
        assert frequency[0] == pytest.approx(1 / 600)
        assert density[0] == pytest.approx(abs(waves.elevation[1]) ** 2 / 2 * 600)

    @pytest.mark.parametrize("quiet", [True, False])
    def test_a_quiet_run_is_drawn_beside_the_components(self, quiet: bool) -> None:
        """A run between groups may lie below all that the picture shows of the whole sea."""
        f = np.linspace(0.0, 0.5, 51)
        whole = np.where(abs(f - 0.1) < 0.035, 5.0, 0.0)
        run = (f, (1e-4 if quiet else 1.0) * whole)
        axes = sea_plots.elevation_spectrum(run, (f, whole), None).axes[0]
        assert axes.get_xlim() == pytest.approx((0, 1.05 * 0.13))

    def test_of_a_long_run_is_that_of_the_components(
        self, undamped: ow.Turbine, sea: ow.IrregularWaves
    ) -> None:
        """Welch's estimate over one whole repetition has the target's variance."""
        hydrodynamics = HydrodynamicModel.of(undamped, sea)
        elevation = hydrodynamics.surface.elevation(np.arange(0, 3600, 0.25))
        frequency, density = power_spectral_density(elevation, 0.25, 200.0)
        target = sea_data.target_density(sea, 30.0, 9.80665)
        assert target is not None
        near = (frequency > 0.08) & (frequency < 0.3)
        ratio = density[near].sum() / target(frequency[near]).sum()
        assert ratio == pytest.approx(1, abs=0.1)


@pytest.mark.parametrize("length", [60.0, 400.0])
def test_long_titles_have_lines_that_fit(length: float) -> None:
    """Of one panel as of two; a title that is cut off tells half the sea."""
    time = np.arange(0, length, 0.5)
    title = "TMA waves " * 15
    figure = sea_plots.surface_elevation(time, np.sin(time), title=title.strip())
    whole = figure.axes[0].get_title("left")
    assert whole.replace("\n", " ") == title.strip()
    assert max(map(len, whole.split("\n"))) <= (85 if length < 120 else 55)


SEAS: dict[str, Sea] = {
    "level": ow.RegularWaves(HEIGHT, PERIOD),
    "splash": ow.RegularWaves(
        HEIGHT, PERIOD, 30.0, stretching="wheeler", current=ow.UniformCurrent(1.0, -20.0)
    ),
    "stream": ow.StreamWaves(8.0, PERIOD, 200.0),
}


def kernel_force(hydrodynamics: HydrodynamicModel, time: float) -> Array:
    """(n, 3) of the load's own kernel on an upright structure at rest, in N."""
    force = hydrodynamics.wave_force()
    return force.forces(time, upright(force.height), 1.0).force


class TestForcePerLength:
    @pytest.mark.parametrize("name", SEAS)
    def test_integrates_to_the_forces_of_the_strips(self, undamped: ow.Turbine, name: str) -> None:
        """Resultant and moment are those of the load itself, along and across, at any time."""
        hydrodynamics = HydrodynamicModel.of(undamped, SEAS[name])
        force = hydrodynamics.wave_force()
        for along in (np.array([1.0, 0.0]), np.array([0.6, -0.8])):
            for time in (0.0, 1.3, 5.9):
                found = sea_data.force_per_length(force, np.array([time]), along)
                exact = kernel_force(hydrodynamics, time)[:, :2] @ along
                assert_allclose(found.total[0] * found.length, exact, atol=1e-6 * abs(exact).max())
                assert found.resultant[0] == pytest.approx(exact.sum(), rel=1e-9)
                lever = found.height + DEPTH
                assert found.moment(-DEPTH)[0] == pytest.approx(exact @ lever, rel=1e-9)

    def test_the_length_of_strips_matters(self, undamped: ow.Turbine) -> None:
        """Negative control: strips of the splash zone are of another length than those below."""
        force = HydrodynamicModel.of(undamped, SEAS["splash"]).wave_force()
        found = sea_data.force_per_length(force, np.array([1.3]), np.array([1.0, 0.0]))
        assert np.ptp(found.length) > 1e-3
        wrong = found.total[0].sum() * found.length[0]
        assert abs(wrong / found.resultant[0] - 1) > 1e-3

    def test_inertia_is_that_of_the_closed_form(self, undamped: ow.Turbine) -> None:
        """rho g Cm pi D^2/4 a tanh(kh), where the pile has one diameter (9 m) and Ca."""
        hydrodynamics = HydrodynamicModel.of(undamped, SEAS["level"])
        assert np.ptp(hydrodynamics.strips.diameter) < 1e-9
        site = undamped.site
        k = wave_number(np.array([OMEGA]), DEPTH, site.gravity)[0]
        mass = site.water_density * (1 + hydrodynamics.added_mass[0]) * np.pi / 4
        closed = mass * hydrodynamics.strips.diameter[0] ** 2 * site.gravity * HEIGHT / 2
        found = sea_data.force_per_length(
            hydrodynamics.wave_force(), np.array([-PERIOD / 4]), np.array([1.0, 0.0])
        )
        inertia = float(found.inertia[0] @ found.length)
        assert inertia == pytest.approx(closed * np.tanh(k * DEPTH), rel=1e-4)

    def test_envelope_bounds_every_instant_and_is_reached(self, undamped: ow.Turbine) -> None:
        force = HydrodynamicModel.of(undamped, SEAS["splash"]).wave_force()
        time, along = np.arange(0, 3 * PERIOD, 0.01), np.array([1.0, 0.0])
        low, high = sea_data.force_envelope(force, time, along)
        total = sea_data.force_per_length(force, time, along).total
        assert_allclose(low, total.min(axis=0))
        assert_allclose(high, total.max(axis=0))
        assert np.all(high[:-1] > low[:-1])


class TestFigures:
    def test_highest_crest_is_sought_after_the_ramp(self) -> None:
        time = np.arange(10.0)
        elevation = np.array([0.0, 9, 0, 1, 0, 3, 0, 2, 0, 0])
        assert sea_plots.highest_crest(time, elevation, 4.0) == 5
        assert sea_plots.highest_crest(time, elevation) == 1

    def test_long_elevations_are_thinned_and_enlarged(self) -> None:
        time = np.arange(0, 10800, 0.1)
        elevation = np.sin(time / 1.3) * np.cos(time / 700)
        figure = sea_plots.surface_elevation(time, elevation, title="long", ramp=60.0)
        whole, near = figure.axes
        assert len(whole.lines[0].get_xdata()) <= 1800
        start, end = near.get_xlim()
        assert end - start == pytest.approx(sea_plots.ZOOM)
        crest = time[sea_plots.highest_crest(time, elevation, 60.0)]
        assert start <= crest <= end
        (dot,) = near.findobj(lambda artist: artist.get_gid() == "highest crest")
        assert dot.get_xdata()[0] == crest
        assert len(to_svg(figure, "long")) < 120_000

    def test_short_elevations_are_shown_once(self) -> None:
        time = np.arange(0, 60, 0.1)
        figure = sea_plots.surface_elevation(time, np.sin(time))
        assert len(figure.axes) == 1

    def test_profiles_are_drawn_as_they_are(self, undamped: ow.Turbine) -> None:
        sea = ow.RegularWaves(
            HEIGHT, PERIOD, stretching="wheeler", water_level=1.5, current=ow.UniformCurrent(1.0)
        )
        hydrodynamics = HydrodynamicModel.of(undamped, sea)
        shown = sea_data.profiles(hydrodynamics, sea, np.array([0.0, -PERIOD / 4, PERIOD / 2]))
        figure = sea_plots.kinematics(shown, np.array([1.0, 0.0]), -DEPTH, 1.5)
        speed, push = figure.axes
        curves = {str(line.get_label()): line for line in speed.lines}
        assert_allclose(curves["crest, +2.00 m"].get_xdata(), shown[0].velocity[:, 0])
        assert_allclose(curves["crest, +2.00 m"].get_ydata(), shown[0].height)
        assert_allclose(curves["current alone"].get_xdata(), 1.0)
        assert "water level +1.50 m" in texts(speed)
        assert speed.get_xlabel().endswith("m/s")
        assert push.get_xlabel().endswith("m/s²")

    def test_forces_are_drawn_in_kilonewtons(self, undamped: ow.Turbine) -> None:
        hydrodynamics = HydrodynamicModel.of(undamped, SEAS["level"])
        force, along = hydrodynamics.wave_force(), np.array([1.0, 0.0])
        worst = sea_data.force_per_length(force, np.array([-PERIOD / 4]), along)
        envelope = sea_data.force_envelope(force, np.arange(0, PERIOD, 0.05), along)
        instant, _ = sea_plots.force_over_height(worst, envelope, -DEPTH, 0.0).axes
        curves = {str(line.get_label()): line for line in instant.lines}
        x, z = (np.asarray(v) for v in curves["total at the instant"].get_data())
        assert np.trapezoid(x, z) * 1e3 == pytest.approx(worst.resultant[0], rel=1e-9)
        assert instant.get_xlabel().endswith("kN/m")

    def test_the_water_level_is_drawn_where_it_is(self, undamped: ow.Turbine) -> None:
        system = ow.build(undamped, "clamped", ow.StillWater(water_level=2.5), elements=6)
        axes = plots.structure(structure_dataset(system)).axes[0]
        assert any("+2.50 m  water level" in text for text in texts(axes))
        assert any(np.allclose(line.get_ydata(), 2.5) for line in axes.lines)
        assert not any(np.allclose(line.get_ydata(), 0.0) for line in axes.lines)


class TestSection:
    def test_four_pictures_of_an_irregular_sea(self, run: Results) -> None:
        names = [picture.name for picture in sea_pictures(run.report())]
        assert names == ["sea-elevation", "sea-kinematics", "sea-spectrum", "sea-forces"]
        text = run.html()
        assert '<section id="sea">' in text
        assert all(f'class="figure-{name}"' in text for name in names)
        section = text[text.index('<section id="sea">') : text.index('<section id="histories">')]
        assert len(section) < 250_000

    def test_captions_tell_the_instants_of_the_results(self, run: Results) -> None:
        data = run.report().analysed
        assert data is not None
        words = {picture.name: picture.caption for picture in sea_pictures(run.report())}
        crest = float(data.time[int(np.argmax(data.wave_elevation.values))])
        assert f"at {crest:.1f} s" in words["sea-kinematics"]
        assert "without stretching" in words["sea-kinematics"]
        moment = np.linalg.norm(data.mudline_moment.values[:, :2], axis=1)
        assert f"at {float(data.time[int(moment.argmax())]):.1f} s" in words["sea-forces"]
        spread = 4 * float(data.wave_elevation.std())
        assert f"{spread:.3g}"[:4] in words["sea-elevation"]

    def test_data_are_those_of_the_sea(self, run: Results, coarse: ow.System) -> None:
        """Read back from the tree, profiles, forces and spectra are those computed directly."""
        data = run.report().part("waves")
        assert data is not None
        hydrodynamics, sea = coarse.hydrodynamics, coarse.sea
        assert hydrodynamics is not None
        assert sea is not None
        shown = sea_data.profiles_of(data)
        direct = sea_data.profiles(
            hydrodynamics, sea, np.array([profile.time for profile in shown])
        )
        for found, expected in zip(shown, direct, strict=True):
            for name in ("height", "velocity", "acceleration", "current"):
                assert_allclose(getattr(found, name), getattr(expected, name), rtol=1e-12)
        along = sea_data.wave_direction(hydrodynamics.surface.waves)
        worst = sea_data.worst_force_of(data)
        expected = sea_data.force_per_length(hydrodynamics.wave_force(), worst.time, along)
        assert_allclose(worst.total, expected.total)
        frequency, density = sea_data.spectrum_of(data, "target") or (None, None)
        target = sea_data.target_density(sea, 30.0, coarse.turbine.site.gravity)
        assert target is not None
        assert_allclose(density, target(frequency))

    @pytest.mark.parametrize("calm", [None, ow.StillWater()])
    def test_nothing_without_waves(
        self, undamped: ow.Turbine, run: Results, calm: Sea | None
    ) -> None:
        system = ow.build(undamped, "clamped", calm, elements=6)
        assert sea_data.waves_dataset(system, run.root, 200.0) is None
        other = results(system, root=run.root)
        assert sea_pictures(other.report()) == []
        assert 'id="sea"' not in other.html()

    def test_regular_waves_have_no_spectrum(self, undamped: ow.Turbine) -> None:
        system = ow.build(undamped, "clamped", ow.RegularWaves(HEIGHT, PERIOD), elements=6)
        histories = ow.simulate(system, 20.0, 0.05, ramp=4.0)
        waves = sea_data.waves_dataset(system, histories, 200.0)
        report = results(system, root=histories, waves=waves).report()
        names = [picture.name for picture in sea_pictures(report)]
        assert names == ["sea-elevation", "sea-kinematics", "sea-forces"]
