"""The report: complete, self-contained, escaped, and written whole or not at all."""

from __future__ import annotations

import re
from dataclasses import replace
from html.parser import HTMLParser

import numpy as np
import pytest
import xarray as xr
from helpers.case_results import Results, published, results
from helpers.earthquakes import shaking

import offwind_pin as ow
from offwind_pin.analysis.drawing_data import sea_in_words
from offwind_pin.analysis.sea_data import waves_dataset
from offwind_pin.base.mode_labels import is_mode, mode_name
from offwind_pin.cases.earthquake import CaseEarthquake, earthquake_dataset
from offwind_pin.cases.identification import summarise_identified
from offwind_pin.cases.tower_top import synthetic_dataset
from offwind_pin.display.report import case_report
from offwind_pin.display.report.case_report import SECTIONS, tables
from offwind_pin.display.wording import (
    DASH,
    MINUS,
    TIMES,
    difference,
    fixed,
    listing,
    number,
    significant_digits,
)
from offwind_pin.loads.wind.synthetic_thrust import operate_rotor
from offwind_pin.signal.moment_spectrum import Band, MomentSpectrum
from offwind_pin.signal.spectra import band_sum, peaks, power_spectral_density

HOSTILE = '"><script>alert(1)</script><img src=x onerror=alert(2)>'
RAMP = 4.0


class Page(HTMLParser):
    """Tags, attributes and visible text of a page."""

    def __init__(self, text: str) -> None:
        super().__init__()
        self.tags: list[str] = []
        self.attributes: list[tuple[str, str]] = []
        self.words: list[str] = []
        self._hidden = False
        self.feed(text)

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.tags.append(tag)
        self.attributes += [(name, value or "") for name, value in attrs]
        self._hidden = tag == "style"

    def handle_data(self, data: str) -> None:
        if not self._hidden:
            self.words.append(data)

    @property
    def text(self) -> str:
        return " ".join(" ".join(self.words).split())

    def values(self, name: str) -> list[str]:
        return [value for key, value in self.attributes if key == name]


@pytest.fixture(scope="module")
def full(coarse: ow.System) -> Results:
    """Results with every part, of a short case on few elements."""
    wind = ow.SyntheticWind(9.06, 0.388)
    load = wind.generate(coarse.turbine.rna, duration=20.0, repeat_period=20.0, dt=0.05)
    histories = ow.simulate(coarse, 20.0, 0.05, [load], ramp=RAMP)
    state = ow.static(coarse, load.mean(RAMP, 20.0))
    modes = ow.modes(coarse, 8, state)
    psd = spectrum(histories, modes)
    identified = identified_modes()
    summary = {
        "case": "short",
        "wall_s": 2.5,
        "realtime_factor": 8.0,
        "status": "complete",
        "FA1_hz": float(modes.frequency_hz[1]),
        "psd_sum_ratio": psd.ratio,
        **summarise_identified(identified),
    }
    return results(
        coarse,
        summary,
        root=histories,
        statics={"distributed_springs": (coarse, state)},
        name="short",
        title="A short case",
        description="Twenty seconds.",
        modes=modes.to_dataset(),
        spectrum=psd.to_dataset(),
        waves=waves_dataset(coarse, histories, 10.0),
        published=published(
            ("first fore-aft", 0.24, "Hz", "a paper", "FA1_hz"),
            ("PSD sum ratio", 100.0, "", "a paper", "psd_sum_ratio"),
            ("damage", 1.0, "", "a paper", "damage"),
        ),
        wind=synthetic_dataset(wind, coarse.turbine.rna),
        rotor=operating_rotor(),
        earthquake=earthquake_dataset(CaseEarthquake(shaking(), ["a caution"], 9.81), modes),
        identified_modes=identified,
        settling=settling(),
    )


@pytest.fixture(scope="module")
def bare(undamped: ow.Turbine) -> Results:
    """The least a report can be made of."""
    system = ow.build(undamped, "clamped", elements=6)
    return results(system, name="bare", title="Bare")


@pytest.fixture(scope="module")
def html(full: Results) -> str:
    return full.html()


@pytest.fixture(scope="module")
def page(html: str) -> Page:
    return Page(html)


def static_state(found: Results) -> ow.StaticResult:
    return found.report().statics["distributed_springs"]


def operating_rotor() -> xr.Dataset:
    names = ("mean_wind", "wind_standard_deviation", "thrust_coefficient", "mean_thrust")
    values = dict.fromkeys((*names, "blade_passing_frequency", "control_time", "wake_time"), 1.1)
    return xr.Dataset(values, attrs={"control": "lagged", "wind": "made"})


def identified_modes() -> xr.Dataset:
    """Two shapes at five nodes, as good as exact."""
    lines, values = np.linspace(0.01, 3.0, 300), np.array([0.24, 1.14])
    shape = np.array([np.linspace(0, 1, 5) ** 2, np.sin(np.linspace(0.2, 2.8, 5))])
    density = 1e-3 / np.outer(1 + 100 * (lines - 0.24) ** 2, np.arange(1, 6) ** 2)
    damping = ("mode", np.array([0.006, 0.025]))
    return xr.Dataset(
        {
            "frequency": ("mode", values),
            "damping_ratio": damping,
            "damping_scatter": ("mode", np.array([0.001, 0.001])),
            "shape": (("mode", "height"), shape),
            "computed_frequency": ("mode", 1.001 * values),
            "computed_damping_ratio": damping,
            "computed_shape": (("mode", "height"), shape),
            "assurance": ("mode", np.ones(2)),
            "peak_height_ratio": ("mode", np.array([1.0, 0.6])),
            "singular_value": (("line", "number"), density),
        },
        {"mode": ["FA1", "FA2"], "height": np.linspace(-30.0, 115.0, 5), "line": lines},
        {"record_s": 600.0, "seed": 1, "cautions": '["a caution about the record"]'},
    )


def settling() -> xr.Dataset:
    time = np.linspace(0.0, 300.0, 601)
    swing = 0.2 * np.exp(-time / 30) * np.cos(1.5 * time)
    top = np.column_stack([-0.2 + swing, 0 * time, 0 * time])
    return xr.Dataset(
        {
            "tower_top_displacement": (("time", "direction"), top),
            "difference": ("time", np.abs(swing)),
            "static_tower_top_displacement": ("direction", top[-1]),
        },
        {"time": time, "direction": ["x", "y", "z"]},
    )


def spectrum(histories: xr.Dataset, modes: ow.ModalResult) -> MomentSpectrum:
    moment = histories.mudline_moment.sel(direction="y", time=slice(RAMP, None)).values
    frequency, density = power_spectral_density(moment, 0.05, 10.0)
    bands = tuple(
        Band(low, high, band_sum(frequency, density, low, high))
        for low, high in ((0.2, 0.3), (1.0, 1.5))
    )
    marked = {"wave peak": 1 / 6, "3P": 0.388, "FA1": float(modes.frequency_hz[1])}
    found = tuple(peaks(frequency, density, 0.05, 1.6))
    return MomentSpectrum(frequency, density, found, bands, marked, 10.0)


def sections(text: str) -> list[str]:
    return re.findall(r'<section[^>]*\bid="([^"]+)"', text)


class TestSelfContained:
    def test_holds_no_address_and_no_script(self, html: str, page: Page) -> None:
        assert "http://" not in html
        assert "https://" not in html
        assert "@import" not in html
        assert not {"script", "link", "iframe", "object", "embed", "img", "image"} & set(page.tags)
        assert not [name for name, _ in page.attributes if name.startswith("on")]

    def test_every_reference_is_found_within(self, html: str, page: Page) -> None:
        references = page.values("href") + page.values("src") + page.values("xlink:href")
        references += re.findall(r"url\(([^)]*)\)", html)
        ids = page.values("id")
        assert len(references) > 20
        assert len(set(ids)) == len(ids)
        assert {reference.removeprefix("#") for reference in references} <= set(ids)

    def test_is_the_same_every_time(self, full: Results, html: str) -> None:
        assert full.html() == html


class TestContents:
    def test_every_section_in_order(self, html: str) -> None:
        assert sections(html) == list(SECTIONS)

    def test_sections_without_data_are_left_out(self, bare: Results) -> None:
        text = bare.html()
        assert sections(text) == ["structure", "damping", "provenance"]
        assert re.findall(r'href="#([a-z]+)">', text) == sections(text)
        assert "surrogate" not in Page(text).text.lower()

    @pytest.mark.parametrize(
        ("name", "gone"),
        [
            ("modes", {"modes"}),
            ("static/0", {"statics"}),
            ("spectrum", {"psd"}),
            ("wind", {"wind"}),
            ("rotor", {"rotor"}),
            ("earthquake", {"earthquake"}),
            ("identified_modes", {"identified"}),
            ("published", {"published"}),
            ("waves", {"sea"}),
            ("soil", {"soil"}),
            ("histories", {"histories", "envelope", "sea"}),
        ],
    )
    def test_leaving_out_one_part(
        self, full: Results, monkeypatch: pytest.MonkeyPatch, name: str, gone: set[str]
    ) -> None:
        """Figures are made and not drawn: the whole report has drawn the same ones."""
        monkeypatch.setattr(case_report, "to_svg", lambda figure, section: "")
        text = full.without(name).html()
        assert sections(text) == [name for name in SECTIONS if name not in gone]

    def test_key_numbers(self, full: Results, page: Page) -> None:
        modes, psd = full.report().modes, full.report().spectrum
        assert modes is not None
        assert psd is not None
        assert psd.ratio is not None
        for label in ("FA1", "FA2", "SS1"):
            i = modes.index(label)
            assert f"{modes.frequency_hz[i]:.4f}" in page.text
            assert f"{100 * modes.damping_ratio[i]:.2f}" in page.text
        state = static_state(full)
        assert number(state.tower_top_displacement[0]) in page.text
        assert number(state.mudline_load[4] / 1e6) in page.text
        assert number(psd.ratio, 3) in page.text
        assert number(psd.bands[0].area / 1e12, 3) in page.text

    def test_solver_account(self, full: Results, page: Page) -> None:
        mean = float(full.root.solver_iterations[1:].mean())
        worst = float(full.root.solver_residual.max())
        assert f"{mean:.2f} on average" in page.text
        assert " ".join(number(worst, 2).split()) in page.text
        assert "time steps 400" in page.text
        assert "2.50 s" in page.text
        assert "8.00 (simulated" in page.text

    def test_provenance(self, full: Results, page: Page) -> None:
        assert full.root.attrs["definition_sha256"] in page.text
        assert "seed of the waves 3" in page.text
        assert "seed of the synthetic wind 1" in page.text
        assert '"wall_s": 2.5' in page.text

    def test_mean_thrust_is_derived(self, coarse: ow.System, page: Page) -> None:
        rotor = operate_rotor(coarse.turbine.rna, 9.06, 0.388)
        assert f"{number(rotor.thrust / 1e6)} MN" in page.text
        assert number(rotor.tip_speed_ratio, 3) in page.text

    def test_damping_achieved(self, coarse: ow.System, page: Page) -> None:
        for label, ratio in coarse.damping_ratios.items():
            row = f"{label} {mode_name(label)} "
            assert row in page.text
            assert f"{100 * ratio:.3f}" in page.text


class TestSurrogates:
    def test_are_told_with_their_reasons(self, coarse: ow.System, page: Page) -> None:
        assert coarse.foundation.surrogate is not None
        assert " ".join(coarse.foundation.surrogate.split()) in page.text
        wind = ow.SyntheticWind(9.06, 0.388)
        assert wind.surrogate.removeprefix("synthetic") in page.text
        assert page.text.count("To use real data") == 2

    def test_are_not_made_up(
        self, full: Results, coarse: ow.System, monkeypatch: pytest.MonkeyPatch
    ) -> None:
        monkeypatch.setattr(case_report, "to_svg", lambda figure, section: "")
        measured = full.root.assign_attrs(surrogates=coarse.foundation.surrogate)
        text = Page(replace(full, root=measured).without("wind").html()).text
        assert text.count("To use real data") == 1


class TestPublished:
    def test_difference_is_said(self, full: Results, page: Page) -> None:
        assert difference(full.summary["FA1_hz"], 0.24, "Hz") in page.text
        assert "not computed" in page.text
        assert "of 2 published" in page.text

    def test_frequencies_stand_beside_their_modes(self, html: str) -> None:
        assert re.search(r"<td>FA1</td>[^\n]*\n<td class=\"n\">0.24</td>", html)
        assert re.search(r"<td>FA2</td>[^\n]*\n<td class=\"n\">–</td>", html)

    def test_bars_point_to_the_side_and_stop_at_the_end(self, bare: Results) -> None:
        rows = published(
            ("low", 1.0, "m", "", "low"),
            ("high", 1.0, "m", "", "high"),
            ("far", 1.0, "m", "", "far"),
        )
        computed = {"low": 0.95, "high": 1.02, "far": 7.0}
        text = replace(bare.with_groups(published=rows), summary=computed).html()
        bars = re.findall(r"left:([\d.]+)%;width:([\d.]+)%", text)
        assert bars == [("25.0", "25.0"), ("50.0", "10.0"), ("50.0", "50.0")]


class TestHeadline:
    def test_statics_are_compared(self, undamped: ow.Turbine) -> None:
        """In one order whatever the order in the results."""
        states = {}
        for name in ("clamped", "distributed_springs"):
            system = ow.build(undamped, name, elements=8)
            states[name] = system, ow.static(system)
        before, now = (state.tower_top_displacement[0] for _, state in states.values())
        text = Page(results(system, statics=states).html()).text
        backwards = results(system, statics=dict(reversed(states.items())))
        assert Page(backwards.html()).text == text
        assert f"{100 * (now / before - 1):.1f} %" in text
        assert fixed(now, 3) in text
        assert fixed(before, 3) in text

    def test_a_run_that_stopped_says_so(self, full: Results) -> None:
        short = full.root.isel(time=slice(0, 40))
        stopped = replace(full, root=short).without("spectrum").without("waves")
        text = stopped.with_attributes("case", status="failed", message="the reason").html()
        assert "Not complete." in text
        assert "1.950 s" in text
        assert "the reason" in text.lower()
        assert "envelope" not in sections(text)

    def test_a_complete_run_does_not(self, page: Page) -> None:
        assert "Not complete." not in page.text


class TestHostileNames:
    def test_are_shown_and_not_obeyed(self, full: Results, coarse: ow.System) -> None:
        psd = full.report().spectrum
        assert psd is not None
        named = full.with_attributes("case", name=HOSTILE, title=HOSTILE, description=HOSTILE)
        state = named.groups["static/0"].assign_attrs(foundation=HOSTILE)
        nasty = replace(
            named.with_groups(
                **{"static/0": state},
                published=published((HOSTILE, 1.0, HOSTILE, HOSTILE, HOSTILE)),
                spectrum=replace(psd, marked={HOSTILE: 0.3}).to_dataset(),
            ),
            root=full.root.assign_attrs(surrogates=HOSTILE, **{HOSTILE: HOSTILE}),
            summary={HOSTILE: HOSTILE},
        )
        page = Page(nasty.html())
        assert not {"script", "img"} & set(page.tags)
        assert not [name for name, _ in page.attributes if name.startswith("on")]
        assert page.text.count("<script>alert(1)</script>") >= 10


class TestMomentSpectrum:
    @pytest.fixture
    def psd(self) -> MomentSpectrum:
        frequency = np.linspace(0, 2, 201)
        density = np.exp(-(((frequency - 1.2) / 0.1) ** 2)) + 1e-6
        bands = (Band(0.2, 0.3, 8.0), Band(1.0, 1.5, 2.0))
        marked = {"3P": 0.25, "FA2": 1.101}
        return MomentSpectrum(frequency, density, (0.25, 0.29, 1.1, 1.2), bands, marked, 100.0)

    def test_ratio(self, psd: MomentSpectrum) -> None:
        assert psd.ratio == 4.0
        assert replace(psd, bands=psd.bands[:1]).ratio is None

    def test_peaks(self, psd: MomentSpectrum) -> None:
        assert psd.strongest_peak(1.0, 1.5) == 1.2
        assert psd.strongest_peak(0.5, 0.6) is None
        assert psd.nearest_peak(0.251) == 0.25
        assert psd.nearest_peak(0.27) is None
        assert psd.nearest_peak(0.26, nearness=0.1) == 0.25

    def test_a_marked_mode_goes_before_the_strongest(self, psd: MomentSpectrum) -> None:
        assert psd.peak_in(psd.bands[1]) == ("FA2", 1.1)
        assert psd.peak_in(psd.bands[0])[0] is None


class TestWording:
    @pytest.mark.parametrize(
        ("value", "text"),
        [
            (0.0, "0"),
            (0.24296, "0.2430"),
            (-2.859e7, f"{MINUS}2.859\u00a0{TIMES}\u00a010⁷"),
            (1295.1, "1\u202f295"),
            (1.24e-16, f"1.240\u00a0{TIMES}\u00a010⁻¹⁶"),
            (99.996, "100.0"),
            (float("inf"), "∞"),
        ],
    )
    def test_numbers(self, value: float, text: str) -> None:
        assert number(value) == text

    @pytest.mark.parametrize(
        ("ours", "reference", "unit", "text"),
        [
            (0.2744, 0.28, "Hz", "2.0 % below"),
            (1.46, 1.44, "Hz", "1.4 % above"),
            (0.28, 0.28, "Hz", "equal within 0.05 %"),
            (-1.1, -1.0, "m", "10.0 % below"),
            (11.42, 14.3, "%", "20.1 % below (2.9 percentage points)"),
            (1296.0, 100.0, "", "13.0 times the published value"),
            (10.0, 100.0, "", "0.100 times the published value"),
            (0.5, 0.0, "m", "difference 0.500 m"),
        ],
    )
    def test_differences(self, ours: float, reference: float, unit: str, text: str) -> None:
        assert difference(ours, reference, unit) == text

    def test_modes(self) -> None:
        assert mode_name("FA2") == "second fore-aft"
        assert mode_name("T1") == "first torsion"
        assert mode_name("V11") == "11th vertical"
        assert [is_mode(name) for name in ("SS12", "3P", "wave peak", "FA0")] == [True] + 3 * [
            False
        ]

    def test_digits_as_given(self) -> None:
        values = (0.236, 0.28, 0.27446, 100.0, -14.3)
        assert [significant_digits(value) for value in values] == [3, 2, 5, 3, 3]

    def test_lists(self) -> None:
        assert [listing(list("abc"[:n])) for n in range(4)] == ["", "a", "a and b", "a, b and c"]

    def test_band_names(self) -> None:
        assert Band(1.0, 1.5, 0.0).name == f"1{DASH}1.5 Hz"


def test_the_sea_is_named_with_all_that_acts(undamped: ow.Turbine) -> None:
    """Level, stretching and current beside the waves; none of them where there is none."""
    plain = ow.RegularWaves(2.0, 8.0)
    system = ow.build(undamped, "clamped", plain, elements=4)
    assert sea_in_words(system) == plain.in_words
    current = ow.UniformCurrent(0.5, 90.0)
    sea = ow.RegularWaves(2.0, 8.0, current=current, water_level=1.5, stretching="wheeler")
    told = sea_in_words(ow.build(undamped, "clamped", sea, elements=4))
    assert "z = 1.5 m" in told
    assert "wheeler" in told
    assert "0.5 m/s" in told
    assert "90" in told


def test_rounding_is_no_number(full: Results) -> None:
    """What is 1e-13 of the largest of its unit is shown as none; 1e-6 of it stays."""
    data = full.root.copy(deep=True)
    moment = data["mudline_moment"]
    largest = float(np.abs(moment.sel(direction="y")).max())
    for size, shown in ((1e-13, False), (1e-6, True)):
        moment.loc[{"direction": "x"}] = size * largest
        rows = {
            name: values for name, _, values in tables.statistics(replace(full, root=data).report())
        }
        assert any(rows["side-side moment at the mudline (x)"]) == shown
