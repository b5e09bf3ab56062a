"""Checks for waves that look like a mistake, or to which linear theory does not apply."""

from __future__ import annotations

import numpy as np

from offwind_pin.loads.sea.waves.dispersion import wave_number

DEPTH_LIMIT = 0.78
"""Breaking height of a solitary wave over the depth (McCowan 1894)."""

SECOND_ORDER = 0.1
"""Stokes's second harmonic over a wave's amplitude above which linear theory is doubtful."""

SECONDARY_CREST = 0.25
"""The same above which cos(x) + share cos(2 x) has a second maximum, at x = pi."""

LOW_PERIOD = 3.6
"""Lowest Tp / sqrt(Hs) of wind seas, in s/m^(1/2) (DNV-RP-C205, 3.5.5; IEC 61400-3-1, Annex D)."""

HIGHEST_OF_MANY = 1.86
"""Most probable highest of 1000 waves over the significant height, sqrt(ln(1000) / 2)."""


def breaking_height(wave_number: float, depth: float) -> float:
    """Height in m above which a regular wave breaks.

    Miche's (Ann. Ponts Chaussees 114, 1944) 0.142 L tanh(kh), but at most 0.78 h. wave_number in
    rad/m, depth h in m.
    """
    miche = 0.142 * 2 * np.pi / wave_number * np.tanh(wave_number * depth)
    return float(min(miche, DEPTH_LIMIT * depth))


def second_harmonic_share(amplitude: float, wave_number: float, depth: float) -> float:
    """Amplitude of Stokes's second harmonic over that of the first (Stokes 1847).

    ka (3 - t^2) / (4 t^3) with t = tanh(kh); amplitude a and depth h in m, wave_number in rad/m.
    """
    t = np.tanh(wave_number * depth)
    return float(wave_number * amplitude * (3 - t**2) / (4 * t**3))


def steepest_sea(peak_period: float) -> float:
    """Largest 2 pi Hs / (g Tp^2) of a sea of a peak period in s (DNV-RP-C205, 3.5.4).

    1/15 up to 8 s, 1/25 from 15 s on, linear in between.
    """
    return float(np.interp(peak_period, [8.0, 15.0], [1 / 15, 1 / 25]))


def regular_wave_cautions(
    height: float, wave_number: float, depth: float, order: int = 1
) -> list[str]:
    """Cautions about a regular wave by theory of order 1 or 2.

    height from trough to crest and depth in m, wave_number in rad/m
    """
    limit = breaking_height(wave_number, depth)
    if height > limit:
        return [
            f"a regular wave of {height:g} m is higher than the {limit:.3g} m at which such a wave "
            f"breaks in {depth:g} m of water (Miche; {DEPTH_LIMIT:g} of the depth)"
        ]
    return _nonlinearity(height / 2, wave_number, depth, order, "stream function waves")


def irregular_wave_cautions(
    significant_height: float,
    peak_period: float,
    depth: float,
    gravity: float,
    *,
    wind_sea: bool,
    order: int = 1,
) -> list[str]:
    """Cautions about a sea by theory of order 1 or 2.

    significant_height and depth in m, peak_period in s, gravity in m/s2; wind_sea : whether the sea
    is defined by Hs and Tp, for which limits of steepness are known
    """
    told = []
    steepness = 2 * np.pi * significant_height / (gravity * peak_period**2)
    steepest = steepest_sea(peak_period)
    if wind_sea and steepness > steepest:
        told.append(
            f"Hs {significant_height:.3g} m with Tp {peak_period:.3g} s has a steepness of 1/"
            f"{1 / steepness:.3g}; seas reach 1/{1 / steepest:.3g} at most (DNV-RP-C205, 3.5.4); "
            "is the period Tz rather than Tp?"
        )
    elif wind_sea and peak_period / np.sqrt(significant_height) < LOW_PERIOD:
        ratio = peak_period / np.sqrt(significant_height)
        told.append(
            f"Tp / sqrt(Hs) is {ratio:.3g}, below {LOW_PERIOD:g}, the steepest wind seas for "
            "which the JONSWAP spectrum was derived"
        )
    highest = HIGHEST_OF_MANY * significant_height
    if highest > DEPTH_LIMIT * depth:
        told.append(
            f"Hs {significant_height:.3g} m in {depth:.3g} m of water: the highest of 1000 waves, "
            f"{highest:.3g} m by the Rayleigh distribution, exceeds the breaking limit of "
            f"{DEPTH_LIMIT:g} times the depth"
        )
    k = float(wave_number(np.array([2 * np.pi / peak_period]), depth, gravity)[0])
    remedy = "waves of order 2" if order == 1 else "the highest wave as a stream function wave"
    return told + _nonlinearity(significant_height / 2, k, depth, order, remedy)


def crest_cautions(crest: float, peak_period: float, depth: float, gravity: float) -> list[str]:
    """Cautions about a crest of a height in m above the mean water level, by linear theory."""
    k = float(wave_number(np.array([2 * np.pi / peak_period]), depth, gravity)[0])
    limit = breaking_height(k, depth)
    if 2 * crest <= limit:
        return []
    return [
        f"a crest of {crest:g} m belongs to a linear wave of {2 * crest:g} m, higher than the "
        f"{limit:.3g} m at which a wave of {peak_period:.3g} s breaks in {depth:g} m of water"
    ]


def _nonlinearity(amplitude: float, k: float, depth: float, order: int, remedy: str) -> list[str]:
    share = second_harmonic_share(amplitude, k, depth)
    wave = f"{100 * share:.2g} % of the amplitude of a wave {2 * amplitude:.3g} m high"
    if order == 1 and share > SECOND_ORDER:
        return [
            f"linear theory neglects a second harmonic of {wave}: crests are too low and troughs "
            f"too deep; consider {remedy}"
        ]
    if order == 2 and share > SECONDARY_CREST:
        return [
            f"the second harmonic is {wave}: above {100 * SECONDARY_CREST:g} % second-order theory "
            f"has secondary crests in the troughs; consider {remedy}"
        ]
    return []
