"""Numbers and results in words, for people."""

from __future__ import annotations

import math
from collections.abc import Mapping

from offwind_pin.analysis.foundation.registry import FOUNDATIONS

_SUPERSCRIPT = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")
MINUS, DASH, TIMES = "\u2212", "\u2013", "\u00d7"
_THIN_SPACE = "\u202f"
_NO_BREAK = "\u00a0"
_ROUNDING = 5e-4


def foundation_name(name: str) -> str:
    """Description of a foundation; an unregistered one has its name."""
    return FOUNDATIONS[name].description if name in FOUNDATIONS else name


def supported_on(name: str) -> str:
    """A foundation with its preposition."""
    preposition = FOUNDATIONS[name].preposition if name in FOUNDATIONS else "on"
    return f"{preposition} {foundation_name(name)}".strip()


def base_name(name: str) -> str:
    """Name of the lower end of a structure that extends below the mudline."""
    return FOUNDATIONS[name].lower_end if name in FOUNDATIONS else "lower end"


def water_level_name(level: float) -> str:
    """Description of the mean water surface by its height in m."""
    return "still water" if level == 0 else f"water level {fixed(level, 2, sign=True)} m"


def number(value: float, significant: int = 4) -> str:
    """A number with significant digits, a true minus sign, and spaces between thousands.

    Very large and very small numbers have a mantissa and a power of ten.
    """
    if not math.isfinite(value):
        return "not a number" if math.isnan(value) else ("∞" if value > 0 else f"{MINUS}∞")
    if value == 0:
        return "0"
    mantissa, exponent = f"{value:.{significant - 1}e}".split("e")
    power = int(exponent)
    if -4 <= power < 7:
        text = f"{value:,.{max(0, significant - 1 - power)}f}".replace(",", _THIN_SPACE)
    else:
        text = f"{mantissa}{_NO_BREAK}{TIMES}{_NO_BREAK}10{str(power).translate(_SUPERSCRIPT)}"
    return text.replace("-", MINUS)


def fixed(value: float, decimals: int, *, sign: bool = False) -> str:
    """A number with decimals, a true minus sign, and optionally a plus sign."""
    return f"{value:{'+' if sign else ''}.{decimals}f}".replace("-", MINUS)


def count(value: int) -> str:
    """A whole number with spaces between thousands."""
    return f"{value:,}".replace(",", _THIN_SPACE).replace("-", MINUS)


def quantity(value: float, unit: str, significant: int = 4) -> str:
    """A number with a unit, joined without a line break."""
    return f"{number(value, significant)}{_NO_BREAK}{unit}"


def as_given(value: float) -> str:
    """A number with its given digits, such as a published one."""
    return f"{value:.10g}".replace("-", MINUS)


def significant_digits(value: float) -> int:
    """Number of given digits: 3 for 0.236."""
    mantissa = f"{abs(value):.10g}".split("e")[0]
    return len(mantissa.replace(".", "").lstrip("0"))


def relative_difference(ours: float, reference: float) -> float | None:
    """(ours - reference) / |reference|, or None for a reference of zero."""
    return None if reference == 0 else (ours - reference) / abs(reference)


def difference(ours: float, reference: float, unit: str) -> str:
    """Difference from a reference in per cent, or as a factor where that is clearer."""
    relative = relative_difference(ours, reference)
    if relative is None:
        return f"difference {number(ours - reference, 3)} {unit}".rstrip()
    if abs(relative) < _ROUNDING:
        return "equal within 0.05 %"
    if relative >= 1 or (-1 < relative <= -0.5):
        return f"{number(ours / reference, 3)} times the published value"
    side = "above" if relative > 0 else "below"
    text = f"{100 * abs(relative):.1f} % {side}"
    if unit == "%":
        text += f" ({abs(ours - reference):.1f} percentage points)"
    return text


def orders_of_magnitude(ratio: float) -> str:
    """``"2.1 orders of magnitude"``."""
    return f"{math.log10(ratio):.1f} orders of magnitude".replace("-", MINUS)


def listing(items: list[str]) -> str:
    """``"a, b and c"``."""
    return " and ".join([", ".join(items[:-1]), items[-1]] if len(items) > 1 else items)


def sentence(text: str) -> str:
    """Capitalised, with a full stop at the end."""
    text = text.strip()
    return text[:1].upper() + text[1:] + ("" if text.endswith((".", "!", "?")) else ".")


def surrogate_notes(attributes: Mapping[str, object]) -> list[str]:
    """Notes of results on the surrogates with which they were computed."""
    notes = str(attributes.get("surrogates", "none")).split(" | ")
    return [note for note in notes if note not in {"", "none"}]
