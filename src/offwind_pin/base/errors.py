"""The project's errors: one small hierarchy, each message naming the mistake and the remedy.

All of them can be copied and pickled, so that a worker process hands them on as they are.
"""

from __future__ import annotations

import pickle
from typing import Any


class OffwindError(Exception):
    """Base of every error this package raises on purpose."""

    def __reduce__(self) -> tuple[Any, ...]:
        return _restored, (type(self), self.args, self.__dict__)


class InputError(OffwindError, ValueError):
    """Something a user gave cannot be used.

    The message names where it was found (file and field), what was received, what is allowed
    and what to do about it.

    Attributes
    ----------
    where : str
        File and field.
    received : object
        The value, or a phrase that says what is wrong.
    allowed : str
        What could be there; empty where ``received`` is such a phrase.
    remedy : str
        One sentence.
    """

    def __init__(self, where: str, received: object, allowed: str, remedy: str) -> None:
        self.where = where
        self.received = received
        self.allowed = allowed
        self.remedy = remedy
        fault = f"got {_shorten(received)}; allowed: {allowed}" if allowed else str(received)
        super().__init__(f"{where}: {fault}. {remedy}")

    def __reduce__(self) -> tuple[Any, ...]:
        state = self.__dict__ | {"received": _portable(self.received)}
        return _restored, (type(self), self.args, state)


class SolverError(OffwindError, RuntimeError):
    """A solve that did not converge, with the place where it stopped.

    Attributes
    ----------
    time : float or None, s
        Simulated time of the failed step (``None`` for a static solve).
    step : int
        Number of the failed step or iteration.
    joint : str
        Name of the joint with the largest residual.
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
    """An error with its message and fields, made without its own arguments."""
    error = kind.__new__(kind, *arguments)
    error.__dict__.update(state)
    return error


def _portable(value: object) -> object:
    """The value, or its text where another process could not be given it."""
    try:
        pickle.dumps(value)
    except Exception:  # whatever a foreign class raises
        return repr(value)
    return value


def _shorten(value: object, limit: int = 240) -> str:
    # 18.0 rather than np.float64(18.0); NumPy is not imported for the sake of messages.
    plain = getattr(value, "item", lambda: value)() if getattr(value, "shape", 1) == () else value
    text = plain if isinstance(plain, str) and " " in plain else repr(plain)
    return text if len(text) <= limit else text[: limit - 3] + "..."
