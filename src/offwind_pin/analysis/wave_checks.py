"""Statistics of the realised waves, and checks before a simulation."""

from __future__ import annotations

from typing import Any

from offwind_pin.base.errors import InputError
from offwind_pin.dynamics.system import System
from offwind_pin.loads.sea.irregular_waves import IrregularWaves
from offwind_pin.loads.sea.sea import LinearSea
from offwind_pin.loads.sea.waves.statistics import moments

FEWEST_STEPS = 20
"""Fewest steps per period of the main waves: the period error, (omega dt)^2 / 12, is 0.8 %."""


def wave_facts(system: System) -> dict[str, Any]:
    """Statistics of the realised waves, notes and cautions; empty without waves.

    Over one of their periods: ``m0_m2`` (the variance), ``m2_m2_hz2`` (frequencies in Hz),
    ``significant_height_m`` (4 sqrt(m0)) and ``peak_period_s`` of irregular waves,
    ``zero_crossing_period_s`` (sqrt(m0 / m2)), ``highest_crest_m`` and ``lowest_trough_m`` about
    the mean water level, ``repeat_period_s``, ``components``; lists ``notes`` and ``cautions``.
    """
    hydrodynamics = system.hydrodynamics
    if system.sea is None or hydrodynamics is None or hydrodynamics.surface.waves is None:
        return {}
    waves, surface = hydrodynamics.surface.waves, hydrodynamics.surface
    state = moments(waves)
    facts: dict[str, Any] = {}
    if system.sea.longest_time is not None:
        facts = {
            "significant_height_m": state.significant_height,
            "peak_period_s": state.peak_period,
        }
    return facts | {
        "zero_crossing_period_s": state.zero_crossing_period,
        "highest_crest_m": surface.highest_elevation,
        "lowest_trough_m": surface.lowest_elevation,
        "m0_m2": state.m0,
        "m2_m2_hz2": state.m2,
        "repeat_period_s": float(waves.period),
        "components": int((waves.harmonic > 0).sum()),
        "notes": system.sea.notes(),
        "cautions": system.sea.cautions(waves.first_order),
    }


def check_waves(system: System, duration: float, ramp: float, dt: float | None) -> None:
    """Reject waves that a simulation cannot represent.

    duration, ramp and time step dt in s; dt is None if the solver chooses it

    Raises
    ------
    InputError
        Waves that repeat or expose the sea bed, a crest outside the fully developed waves, or too
        long a time step.
    """
    sea, hydrodynamics = system.sea, system.hydrodynamics
    if sea is None or hydrodynamics is None or hydrodynamics.surface.waves is None:
        return
    waves = hydrodynamics.surface.waves
    longest = sea.longest_time
    if longest is not None and duration > longest * (1 + 1e-9):
        raise InputError(
            "waves, repeat period",
            f"{longest:g} s of {sea.in_words}",
            f"at least the duration of the simulation ({duration:g} s)",
            "The waves would repeat: raise repeat_period, give a longer record, or shorten the "
            "simulation.",
        )
    lowest = hydrodynamics.surface.lowest_elevation
    if lowest <= -waves.depth:
        raise InputError(
            "waves",
            f"a trough of {lowest:.3g} m in {waves.depth:.3g} m of water",
            "a surface that stays above the bed",
            "Reduce the waves. Are heights in m and densities in m2/Hz?",
        )
    if isinstance(sea, IrregularWaves) and sea.crest is not None:
        time = sea.crest.time
        if not ramp <= time <= duration:
            raise InputError(
                "waves, field crest.time",
                f"{time:g} s",
                f"after the ramp and before the end ({ramp:g} to {duration:g} s)",
                "Move the crest.",
            )
    if dt is None:
        return
    period = sea.main_period
    if period is not None and period < FEWEST_STEPS * dt * (1 - 1e-9):
        raise InputError(
            "dt",
            f"{dt:g} s, {period / dt:.3g} steps in the waves' period of {period:.3g} s",
            f"{FEWEST_STEPS} steps or more ({period / FEWEST_STEPS:.3g} s at most)",
            "Shorten the time step.",
        )
    shortest = float(waves.period / waves.harmonic.max())
    if isinstance(sea, LinearSea) and shortest < 2 * dt * (1 - 1e-9):
        raise InputError(
            "dt",
            f"{dt:g} s, {shortest / dt:.3g} steps in the shortest waves' {shortest:.3g} s",
            f"two steps or more ({shortest / 2:.3g} s at most)",
            "Shorten the time step.",
        )
