"""Files of compiled kernels: damaged ones are compiled again, unwritable ones reported once."""

import random
import resource
import signal
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from offwind_pin.base import kernel_cache, kernels


def twice(x: float) -> float:
    return 2.0 * x


@pytest.fixture
def compiled(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, caplog: pytest.LogCaptureFixture
) -> Callable[[], bool]:
    """Make the kernel as in a new process, and call it; whether it came from the cache."""
    monkeypatch.setattr(kernels, "_cache_directory", lambda: tmp_path / "cache")
    for report in (kernel_cache._report_damaged, kernel_cache._report_unwritable):
        report.cache_clear()

    def call() -> bool:
        function: Any = kernels.kernel(twice)
        assert function(1.5) == 3.0
        return bool(sum(function.stats.cache_hits.values()))

    return call


def files(tmp_path: Path) -> list[Path]:
    """Index and machine code."""
    found = sorted(path for path in (tmp_path / "cache").rglob("*") if path.is_file())
    assert [path.suffix for path in found] == [".nbc", ".nbi"]
    return found


def test_compiled_once(tmp_path: Path, compiled: Callable[[], bool]) -> None:
    """Negative control of the tests below."""
    assert not compiled()
    assert compiled()
    assert len(files(tmp_path)) == 2


@pytest.mark.seeded
@pytest.mark.parametrize("suffix", [".nbc", ".nbi"])
def test_damaged(
    tmp_path: Path,
    compiled: Callable[[], bool],
    caplog: pytest.LogCaptureFixture,
    campaign_seed: int,
    suffix: str,
) -> None:
    """Truncated anywhere, with one byte changed, empty: compiled again and repaired, reported once."""
    assert not compiled()
    path = next(path for path in files(tmp_path) if path.suffix == suffix)
    whole = path.read_bytes()
    draw = random.Random(campaign_seed)
    cut, at = draw.randrange(len(whole)), draw.randrange(len(whole))
    changed = bytearray(whole)
    changed[at] ^= 1 << draw.randrange(8)
    for content in (whole[:cut], bytes(changed), b"", whole + b"more"):
        path.write_bytes(content)
        assert not compiled()
        assert compiled()
    assert caplog.text.count("damaged files") == 1


def test_removed(tmp_path: Path, compiled: Callable[[], bool]) -> None:
    """Index without machine code, as a kill leaves it, and the reverse."""
    assert not compiled()
    for path in files(tmp_path):
        path.unlink()
        assert not compiled()
        assert compiled()


@pytest.mark.parametrize("place", ["cache", "."])
def test_a_directory_that_cannot_be(
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    compiled: Callable[[], bool],
    caplog: pytest.LogCaptureFixture,
    place: str,
) -> None:
    """Where the directory should be there is a file: reported once, and nothing else is written."""
    directory = tmp_path / "home"
    directory.mkdir()
    monkeypatch.setattr(kernels, "_cache_directory", lambda: directory / "cache")
    if place == "cache":
        (directory / "cache").write_text("mine")
    else:
        directory.rmdir()
        directory.write_text("mine")
    for _ in range(2):
        assert not compiled()
    assert caplog.text.count("cannot be kept") == 1
    assert not list(tmp_path.rglob("*.nbi"))


def test_a_full_disk(
    tmp_path: Path, compiled: Callable[[], bool], caplog: pytest.LogCaptureFixture
) -> None:
    """Nothing half written is left, and it is kept once there is room."""
    before = resource.getrlimit(resource.RLIMIT_FSIZE)
    handler = signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
    try:
        for size in (10, 1000):
            resource.setrlimit(resource.RLIMIT_FSIZE, (size, before[1]))
            assert not compiled()
            assert not [path for path in (tmp_path / "cache").rglob("*.tmp.*") if path.is_file()]
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, before)
        signal.signal(signal.SIGXFSZ, handler)
    assert caplog.text.count("cannot be kept") == 1
    assert not compiled()
    assert compiled()
