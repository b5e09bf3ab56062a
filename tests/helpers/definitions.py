"""Random valid definitions of what acts, for properties of all of them."""

from __future__ import annotations

from typing import Any

from hypothesis import strategies as st

import offwind_pin as ow
from offwind_pin.cases.case import Case, TransientAnalysis
from offwind_pin.loads.sea.sea import DrySea
from offwind_pin.loads.wind.rotor_load import RotorLoad


def number(low: float, high: float) -> st.SearchStrategy[float]:
    return st.floats(low, high, allow_nan=False)


def rising(low: float, high: float, count: int) -> st.SearchStrategy[tuple[float, ...]]:
    """So many numbers, each above the one before."""
    grid = st.lists(st.integers(0, 10_000), min_size=count, max_size=count, unique=True)
    return grid.map(lambda steps: tuple(low + (high - low) * s / 10_000 for s in sorted(steps)))


ANGLE = number(-360, 360)
SINGLE_CURRENT = st.one_of(
    st.builds(ow.UniformCurrent, number(0, 3), ANGLE),
    st.builds(ow.PowerLawCurrent, number(0, 3), ANGLE, number(0.05, 1)),
    st.builds(ow.SurfaceCurrent, number(0, 3), ANGLE, number(1, 60)),
    st.builds(
        ow.CurrentTable,
        number(0, 3),
        depth=rising(0, 60, 3),
        factor=st.tuples(*[number(-2, 2)] * 3),
    ),
)
CURRENT = SINGLE_CURRENT | st.builds(
    ow.CurrentSum, st.lists(SINGLE_CURRENT, min_size=1, max_size=3).map(tuple)
)
WATER = {"current": st.none() | CURRENT, "water_level": number(-5, 5)}
LINEAR = WATER | {
    "stretching": st.sampled_from(["none", "vertical", "extrapolation", "wheeler"]),
    "order": st.sampled_from([1, 2]),
}
SHAPE = number(1, 7) | st.just("iec")
SPECTRUM = st.one_of(
    st.builds(ow.JonswapSpectrum, number(0.1, 15), number(2, 20), SHAPE),
    st.builds(ow.TmaSpectrum, number(0.1, 15), number(2, 20), SHAPE),
    st.builds(ow.WhiteNoise, number(0.1, 15), number(0.03, 0.1), number(0.2, 1)),
    st.builds(
        ow.TableSpectrum,
        st.just((0.05, 0.1, 0.15, 0.2)),
        st.tuples(number(0.1, 9), *[number(0, 9)] * 3),
    ),
)
IRREGULAR = {
    "seed": st.none() | st.integers(0, 2**31 - 1),
    "repeat_period": st.none() | number(600, 1e4),
    "direction_deg": ANGLE,
    "amplitudes": st.sampled_from(["deterministic", "random"]),
    "spreading": st.none()
    | st.builds(ow.Spreading, st.sampled_from(["cos_2s", "cos_n"]), number(0.5, 50)),
    "crest": st.none() | st.builds(ow.Crest, number(0.1, 5), number(0, 500)),
}
HEIGHT, PERIOD = number(0.1, 20), number(2, 20)
RECORD = st.lists(number(-5, 5), min_size=64, max_size=70).map(
    lambda level: ow.SurfaceRecord(0.5, tuple(level), "drawn")
)
SEAS = st.one_of(
    st.builds(ow.StillWater, **WATER),
    st.builds(ow.RegularWaves, HEIGHT, PERIOD, ANGLE, **LINEAR),
    st.builds(ow.StreamWaves, HEIGHT, PERIOD, ANGLE, number(0, 60), **WATER),
    st.builds(ow.IrregularWaves, HEIGHT, PERIOD, peak_shape=SHAPE, **IRREGULAR, **LINEAR),
    st.builds(ow.IrregularWaves, spectrum=SPECTRUM, **IRREGULAR, **LINEAR),
    st.builds(ow.MeasuredWaves, RECORD, number(0.02, 0.1), number(0.4, 0.9), ANGLE, **WATER),
)
PROFILE = st.builds(ow.PowerLaw, number(0, 1)) | st.builds(ow.LogLaw, number(1e-4, 0.4))
GUST = st.one_of(
    st.builds(ow.ExtremeOperatingGust, number(0.1, 30), number(0, 50), number(1, 20)),
    st.builds(ow.WindSeries, rising(0, 60, 4), st.tuples(*[number(-5, 5)] * 4)),
)
TOWER_WIND = st.builds(
    ow.TowerWind,
    number(0, 60),
    number(10, 200),
    PROFILE,
    number(0, 2),
    direction_deg=ANGLE,
    gust=st.none() | GUST,
    air_density=number(1, 1.4),
)
SEED = st.none() | st.integers(0, 2**31 - 1)
TOWER_TOP = st.one_of(
    st.builds(ow.SyntheticWind, number(3, 25), number(0.1, 2), number(0, 0.5), seed=SEED),
    st.builds(
        RotorLoad,
        wind_speed=number(4, 20),
        turbulence_class=st.sampled_from("ABC"),
        shear_exponent=number(0, 0.4),
        tower_shadow=st.booleans(),
        control=st.sampled_from(["lagged", "instant"]),
        control_time=number(0.5, 20),
        inflow_lag=st.booleans(),
        seed=SEED,
    ),
)
ANALYSIS = st.builds(
    TransientAnalysis,
    kind=st.just("transient"),
    duration=number(100, 1000),
    ramp=number(0, 40),
    dt=number(0.01, 0.1),
    output_dt=number(0.1, 0.3),
    psd_segment=number(10, 50),
)


def cases(turbine: ow.Turbine) -> st.SearchStrategy[Case]:
    """Load cases of a turbine with all that may act."""
    settings: dict[str, Any] = {
        "name": st.from_regex(r"\A[A-Za-z0-9._-]{1,20}\Z"),
        "title": st.text(st.characters(codec="utf-8", categories=["L", "N", "P", "Zs"])),
        "turbine": st.just(turbine),
        "foundation": st.sampled_from(["clamped", "coupled_springs", "distributed_springs"]),
        "sea": SEAS | st.just(DrySea()),
        "tower_top_load": st.none() | TOWER_TOP,
        "tower_wind": st.none() | TOWER_WIND,
        "analysis": ANALYSIS,
        "seed": st.integers(0, 2**31 - 1),
        "elements": st.none()
        | st.integers(1, 100)
        | st.just({"tower": 12, "monopile": 8, "pile": 6}),
    }
    return st.builds(Case, **settings)
