"""Errors of the package: one small hierarchy with messages that name fault and remedy.

All of them can be copied and pickled, so that worker processes can pass them on.
"""

from __future__ import annotations

import pickle
from typing import Any


class OffwindError(Exception):
    """Base class of all errors that this package raises."""

    def __reduce__(self) -> tuple[Any, ...]:
        return _restored, (type(self), self.args, self.__dict__)


class InputError(OffwindError, ValueError):
    """Invalid input.

    The message names file and field, the value received, what is allowed, and a remedy.

    Attributes
    ----------
    where : str
        File and field.
    received : object
        The value, or a phrase that says what is wrong.
    allowed : str
        Allowed values; empty if ``received`` is such a phrase.
    remedy : str
        Remedy in one sentence.
    """

    def __init__(self, where: str, received: object, allowed: str, remedy: str) -> None:
        self.where = where
        self.received = received
        self.allowed = allowed
        self.remedy = remedy
        if allowed:
            # A phrase about the value is shown as it is, without quotes.
            phrase = isinstance(received, str) and " " in received
            shown = _cut(received, _LONGEST) if phrase else brief(received)  # type: ignore[arg-type]
            fault = f"got {shown}; allowed: {allowed}"
        else:
            fault = _cut(str(received), 4 * _LONGEST)
        super().__init__(printable(f"{_cut(where, _LONGEST_PLACE)}: {fault}. {remedy}"))

    def within(self, where: str) -> InputError:
        """The same error with a longer location, such as the file that contains the reference.

        Parameters
        ----------
        where : str
            Location that contains the error's own.

        Returns
        -------
        InputError
        """
        return type(self)(f"{where}: {self.where}", self.received, self.allowed, self.remedy)

    def __reduce__(self) -> tuple[Any, ...]:
        state = self.__dict__ | {"received": _portable(self.received)}
        return _restored, (type(self), self.args, state)


class SolverError(OffwindError, RuntimeError):
    """A solution that did not converge.

    Attributes
    ----------
    reason : str
        What failed.
    step : int
        Number of the failed step or iteration.
    joint : str
        Name of the joint with the largest residual.
    residual : float
        Largest entry of the residual over the load scale.
    time : float or None, s
        Simulated time of the failed step (``None`` for a static solve).
    results : object
        Dataset of the results so far, or None.
    """

    def __init__(
        self,
        reason: str,
        *,
        step: int,
        joint: str,
        residual: float,
        time: float | None = None,
        results: Any = None,
    ) -> None:
        self.reason = reason
        self.time = time
        self.step = step
        self.joint = joint
        self.residual = residual
        self.results = results
        at = "" if time is None else f" at t = {time:.6g} s,"
        super().__init__(
            f"{reason}:{at} step {step}; largest residual {residual:.3g} at joint {joint}"
        )


class InterruptedSimulation(OffwindError):
    """The user stopped a simulation.

    Attributes
    ----------
    time : float, s
        Last recorded time.
    results : object
        Dataset of the results so far.
    """

    def __init__(self, time: float, results: Any) -> None:
        self.time = time
        self.results = results
        super().__init__(f"stopped by the user at t = {time:.6g} s")


def _restored(kind: type[OffwindError], arguments: tuple[Any, ...], state: Any) -> OffwindError:
    """An error with its message and fields, created without calling its constructor."""
    error = kind.__new__(kind, *arguments)
    error.__dict__.update(state)
    return error


def _portable(value: object) -> object:
    """The value, or its text if it cannot be pickled."""
    try:
        pickle.dumps(value)
    except Exception:  # anything that another class raises
        return repr(value)
    return value


_LONGEST = 240
"""Characters of a value in a message."""
_LONGEST_PLACE = 5000


def brief(value: object, limit: int = _LONGEST) -> str:
    """A value as text of limited length; evaluates no more of it than is shown."""
    return _cut(_beginning(value, limit), limit)


def _cut(text: str, limit: int) -> str:
    return text if len(text) <= limit else text[: limit - 3] + "..."


def printable(text: str) -> str:
    """A text without characters that move the cursor, colour or reorder a terminal's lines."""
    if text.isprintable():
        return text
    return "".join(
        one if one.isprintable() else one.encode("unicode_escape").decode() for one in text
    )


def _beginning(value: object, limit: int) -> str:
    # 18.0 rather than np.float64(18.0); NumPy is not imported for the sake of messages.
    if getattr(value, "shape", 1) == ():
        value = getattr(value, "item", lambda: value)()
    if isinstance(value, str):
        return repr(value[: limit + 1])
    if isinstance(value, int) and value.bit_length() > 4 * limit:
        return f"an integer of {value.bit_length()} bits"
    if not isinstance(value, dict | list | tuple):
        return repr(value)
    opening, closing = (
        "{}" if isinstance(value, dict) else "[]" if isinstance(value, list) else "()"
    )
    text = opening
    for item in value.items() if isinstance(value, dict) else value:
        if len(text) > limit:
            return text
        left = limit - len(text)
        shown = (
            f"{_beginning(item[0], left)}: {_beginning(item[1], left)}"
            if isinstance(value, dict)
            else _beginning(item, left)
        )
        text += shown if text == opening else f", {shown}"
    return text + ("," if isinstance(value, tuple) and len(value) == 1 else "") + closing
