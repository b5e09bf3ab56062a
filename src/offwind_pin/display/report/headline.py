"""Headline of a report: the outcome in a few sentences, and up to four key figures."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from offwind_pin.base.mode_labels import mode_name
from offwind_pin.display.report.tables import mudline_moment
from offwind_pin.display.wording import (
    difference,
    fixed,
    foundation_name,
    listing,
    number,
    orders_of_magnitude,
    relative_difference,
    sentence,
    supported_on,
)

if TYPE_CHECKING:
    from offwind_pin.display.report.contents import CaseReport
    from offwind_pin.signal.moment_spectrum import MomentSpectrum

_STOPPED = {"failed": "failed", "interrupted": "was interrupted"}

CLOSE = 0.02
"""Relative difference from a published value that counts as agreement in the headline."""


@dataclass(frozen=True)
class Card:
    """A key figure with unit and meaning."""

    value: str
    unit: str
    meaning: str


def headline(report: CaseReport) -> list[str]:
    """The outcome in a few sentences, the most important first."""
    said = [
        _status_sentence(report),
        *_history_sentences(report),
        *_spectrum_sentences(report),
        *static_increases(report),
        *_mode_sentences(report),
        _published_sentence(report),
    ]
    return [sentence(text) for text in said if text]


def cards(report: CaseReport) -> list[Card]:
    """Up to four key figures of the most detailed analysis of the case."""
    chosen = [
        *_history_cards(report),
        *_spectrum_cards(report.spectrum),
        *_static_cards(report),
        *_mode_cards(report),
    ]
    return chosen[:4]


def _status_sentence(report: CaseReport) -> str:
    if report.status == "complete":
        return ""
    cause = str(report.case.get("message", ""))
    text = f"the run {_STOPPED[report.status]}"
    if report.histories is not None:
        end = float(report.histories.time.values[-1])
        text += f" at {number(end)} s; this page shows the results up to then"
    return f"{text}. {sentence(cause)}" if cause else text


def _spectrum_sentences(report: CaseReport) -> list[str]:
    psd = report.spectrum
    if psd is None:
        return []
    said = []
    peaks = [psd.peak_in(band)[1] for band in psd.bands[:2]]
    found = [f"{peak:.3f} Hz" for peak in peaks if peak is not None]
    if found:
        said.append(f"the spectrum of the mudline moment peaks at {listing(found)}")
    if psd.ratio is not None and any(
        row.quantity.startswith("PSD sum") for row in report.published
    ):
        first, second = psd.bands[:2]
        said.append(
            f"its variance between {first.low:g} and {first.high:g} Hz is "
            f"{number(psd.ratio, 3)} times that between {second.low:g} and {second.high:g} Hz "
            f"({orders_of_magnitude(psd.ratio)})"
        )
    return said


def _history_sentences(report: CaseReport) -> list[str]:
    data = report.analysed
    if data is None:
        return []
    top = data.tower_top_displacement.sel(direction="x")
    moment = data.mudline_moment.sel(direction="y") / 1e6
    return [
        f"after the ramp, the tower-top displacement along x ranges from "
        f"{number(float(top.min()), 3)} to {number(float(top.max()), 3)} m and the fore-aft moment "
        f"at the mudline from {number(float(moment.min()), 3)} to "
        f"{number(float(moment.max()), 3)} MN m"
    ]


def static_increases(report: CaseReport) -> list[str]:
    """Tower-top displacement on each foundation compared with the first in order."""
    if len(report.statics) < 2:
        return []
    (name, first), *others = report.statics.items()
    before = float(first.tower_top_displacement[0])
    if before == 0:
        return []
    said = []
    for other, result in others:
        now = float(result.tower_top_displacement[0])
        change = 100 * (abs(now) / abs(before) - 1)
        word = "larger" if change >= 0 else "smaller"
        said.append(
            f"the static tower-top displacement is {abs(change):.1f} % {word} "
            f"{supported_on(other)} than {supported_on(name)}: {fixed(now, 3)} m along x compared "
            f"with {fixed(before, 3)} m"
        )
    return said


def _mode_sentences(report: CaseReport) -> list[str]:
    if report.modes is None:
        return []
    modes = report.modes
    said = [
        f"{mode_name(label)} {modes.frequency_hz[modes.index(label)]:.3f} Hz"
        for label in ("FA1", "SS1", "FA2")
        if label in modes.label
    ]
    where = foundation_name(report.foundation)
    water = "in water" if report.wet else "dry"
    return [f"natural frequencies, {where}, {water}: {listing(said)}"] if said else []


def _published_sentence(report: CaseReport) -> str:
    compared = [
        (abs(relative), row, row.ours)
        for row in report.published
        if row.ours is not None
        and (relative := relative_difference(row.ours, row.value)) is not None
    ]
    if not compared:
        return ""
    close = sum(size <= CLOSE for size, *_ in compared)
    _, farthest, ours = max(compared, key=lambda entry: entry[0])
    how = difference(ours, farthest.value, farthest.unit)
    return (
        f"{close} of {len(compared)} published values are reproduced within {100 * CLOSE:g} %; "
        f"the largest difference is in {farthest.quantity}: {how}"
    )


def _history_cards(report: CaseReport) -> list[Card]:
    data = report.analysed
    if data is None:
        return []
    moment = float(abs(mudline_moment(data, "y")).max())
    top = float(abs(data.tower_top_displacement.sel(direction="x")).max())
    return [
        Card(number(moment, 3), "MN m", "largest fore-aft moment at the mudline"),
        Card(number(top, 3), "m", "largest tower-top displacement along x"),
    ]


def _spectrum_cards(psd: MomentSpectrum | None) -> list[Card]:
    if psd is None:
        return []
    found = []
    for band in psd.bands[:2]:
        mode, peak = psd.peak_in(band)
        if peak is not None:
            where = f"{mode_name(mode)} mode" if mode else band.name
            found.append(Card(f"{peak:.3f}", "Hz", f"spectral peak of the mudline moment, {where}"))
    return found


def _static_cards(report: CaseReport) -> list[Card]:
    if report.histories is not None or (report.modes is not None and len(report.statics) < 2):
        return []
    states = report.statics
    found = [
        Card(
            fixed(float(result.tower_top_displacement[0]), 3),
            "m",
            f"tower top along x, {foundation_name(name)}",
        )
        for name, result in states.items()
    ]
    if len(states) == 2:
        first, second = (abs(state.tower_top_displacement[0]) for state in states.values())
        if first > 0:
            change = fixed(100 * (second / first - 1), 1, sign=True)
            where = " over ".join(foundation_name(name) for name in reversed(states))
            found.append(Card(change, "%", f"deflection, {where}"))
    return found


def _mode_cards(report: CaseReport) -> list[Card]:
    modes = report.modes
    if modes is None:
        return []
    return [
        Card(f"{modes.frequency_hz[modes.index(label)]:.3f}", "Hz", f"{mode_name(label)} mode")
        for label in ("FA1", "FA2", "SS1", "T1")
        if label in modes.label
    ]
