"""Progress bars on standard error."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import TYPE_CHECKING

from rich.console import Console
from rich.progress import BarColumn, Progress, TextColumn, TimeRemainingColumn

if TYPE_CHECKING:
    from offwind_pin.verification.ledger import Row


@contextmanager
def simulation_progress() -> Iterator[Callable[[float, float], None]]:
    """Progress bar on standard error, shown once a simulation reports its first step."""
    bar = Progress(
        TextColumn("simulated {task.completed:7.1f} of {task.total:.0f} s"),
        BarColumn(),
        TextColumn("{task.fields[speed]:5.1f} x real time"),
        TimeRemainingColumn(),
        TextColumn("left"),
        console=Console(stderr=True),
    )

    def update(now: float, duration: float) -> None:
        if not bar.tasks:
            bar.start()
            bar.add_task("", total=duration, speed=0.0)
        task = bar.tasks[0]
        elapsed = task.elapsed or 0.0
        bar.update(task.id, completed=now, speed=now / elapsed if elapsed > 0 else 0.0)

    try:
        yield update
    finally:
        if bar.tasks:
            bar.stop()


@contextmanager
def frames_progress() -> Iterator[Callable[[int, int], None]]:
    """Progress bar on standard error with the frames written."""
    bar = Progress(
        BarColumn(),
        TextColumn("frame {task.completed:.0f} of {task.total:.0f}"),
        TimeRemainingColumn(),
        console=Console(stderr=True),
        transient=True,
    )
    with bar:
        task = bar.add_task("", total=1)

        def update(written: int, count: int) -> None:
            bar.update(task, completed=written, total=count)

        yield update


@contextmanager
def rows_progress(count: int) -> Iterator[Callable[[int, Row], None]]:
    """Progress bar on standard error with the row that is being checked."""
    bar = Progress(
        BarColumn(),
        TextColumn("{task.completed:.0f} of {task.total:.0f}"),
        TextColumn("{task.description}"),
        console=Console(stderr=True),
        transient=True,
    )
    with bar:
        task = bar.add_task("", total=count)

        def update(place: int, row: Row) -> None:
            bar.update(task, completed=place, description=row.id)

        yield update
