"""Numbers and results in words, for people."""

from __future__ import annotations

import math

from offwind_pin.analysis.modal import FAMILIES

_ORDINALS = ("", "first", "second", "third", "fourth", "fifth", "sixth", "seventh", "eighth")
_SUPERSCRIPT = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")
_THIN_SPACE = "\u202f"
_ROUNDING = 5e-4


def number(value: float, significant: int = 4) -> str:
    """A number with significant digits, a true minus sign, and spaces between thousands.

    Very large and very small ones as a mantissa and a power of ten.
    """
    if not math.isfinite(value):
        return "not a number" if math.isnan(value) else ("∞" if value > 0 else "−∞")
    if value == 0:
        return "0"
    mantissa, exponent = f"{value:.{significant - 1}e}".split("e")
    power = int(exponent)
    if -4 <= power < 7:
        text = f"{value:,.{max(0, significant - 1 - power)}f}".replace(",", _THIN_SPACE)
    else:
        text = f"{mantissa} × 10{str(power).translate(_SUPERSCRIPT)}"
    return text.replace("-", "−")


def as_given(value: float) -> str:
    """A number with the digits it was given, such as a published one."""
    return f"{value:.10g}".replace("-", "−")


def mode_name(label: str) -> str:
    """``"second fore-aft"`` for ``"FA2"``; a label of no known family as it is."""
    family = label.rstrip("0123456789")
    order = int(label[len(family) :] or 0)
    if family not in FAMILIES or not 0 < order < len(_ORDINALS):
        return label
    return f"{_ORDINALS[order]} {FAMILIES[family]}"


def relative_difference(ours: float, reference: float) -> float | None:
    """(ours - reference) / |reference|, or None for a reference of zero."""
    return None if reference == 0 else (ours - reference) / abs(reference)


def difference(ours: float, reference: float, unit: str) -> str:
    """How far ours lies from a reference: in percent, or in multiples where percents mislead."""
    relative = relative_difference(ours, reference)
    if relative is None:
        return f"{number(ours - reference, 3)} {unit} apart".replace("  ", " ")
    if abs(relative) < _ROUNDING:
        return "the same within 0.05 %"
    if relative >= 1 or (-1 < relative <= -0.5):
        return f"{number(ours / reference, 3)} times the published value"
    side = "above" if relative > 0 else "below"
    text = f"{100 * abs(relative):.1f} % {side}"
    if unit == "%":
        text += f" ({abs(ours - reference):.1f} percentage points)"
    return text


def orders_of_magnitude(ratio: float) -> str:
    """``"2.1 orders of magnitude"``."""
    return f"{math.log10(ratio):.1f} orders of magnitude".replace("-", "−")


def listing(items: list[str]) -> str:
    """``"a, b and c"``."""
    return " and ".join([", ".join(items[:-1]), items[-1]] if len(items) > 1 else items)


def sentence(text: str) -> str:
    """First letter large, full stop at the end."""
    text = text.strip()
    return text[:1].upper() + text[1:] + ("" if text.endswith((".", "!", "?")) else ".")
