"""Directories of results: locked, and nothing in them replaced that is not the run's own."""

import json
import multiprocessing
import os
import shutil
import signal
import uuid
from pathlib import Path
from typing import Any

import pytest

import offwind_pin as ow
from offwind_pin.base.whole_files import write_text
from offwind_pin.results.folder_lock import LOCK, FolderLock
from offwind_pin.results.manifest import MANIFEST, BlockEntry, FileName, read_manifest
from offwind_pin.results.run_folder import RunFolder

RUN = {"case": "gale", "content_hash": "0" * 64, "version": "1"}
OWN: tuple[FileName, ...] = ("results.nc", "summary.json", "report.html")


def contents(directory: Path) -> dict[str, bytes]:
    return {
        str(path.relative_to(directory)): path.read_bytes() if path.is_file() else b"folder"
        for path in sorted(directory.rglob("*"))
    }


def finished(directory: Path, run: dict[str, Any] = RUN) -> None:
    """A complete run that wrote three files."""
    with RunFolder(directory, run) as folder:
        for name in OWN:
            with folder.replacing(name) as path:
                path.write_text(f"{name} of {run['case']}")
        folder.finish()


def with_blocks(directory: Path, count: int = 3) -> None:
    """A run that was stopped after some blocks."""
    with RunFolder(directory, RUN) as folder:
        folder.begin()
        entries = []
        for number in range(count):
            path = directory / "blocks" / f"block_{number:06d}.npz"
            write_text(path, f"block {number}")
            entries.append(entry(path, 20.0 * number))
        folder.update(blocks=tuple(entries))


def entry(path: Path, begin: float) -> BlockEntry:
    from offwind_pin.base.definition import file_digest

    return BlockEntry(file=path.name, begin_s=begin, end_s=begin + 20, sha256=file_digest(path))


class TestLock:
    def test_a_second_one_is_refused(self, tmp_path: Path) -> None:
        """In the same process as well; the message names process and host. Then it is free."""
        lock = FolderLock(tmp_path)
        before = contents(tmp_path)
        with pytest.raises(ow.InputError, match=f"process {os.getpid()} on ") as refused:
            FolderLock(tmp_path)
        assert str(tmp_path) in str(refused.value)
        assert contents(tmp_path) == before
        lock.release()
        FolderLock(tmp_path).release()
        assert contents(tmp_path) == {}

    def test_a_killed_process_has_none(self, tmp_path: Path) -> None:
        """The file that it leaves does not count."""
        context = multiprocessing.get_context("fork")
        locked = context.Event()
        process = context.Process(target=lock_and_wait, args=(tmp_path, locked))
        process.start()
        assert locked.wait(60)
        with pytest.raises(ow.InputError, match=f"process {process.pid} on "):
            FolderLock(tmp_path)
        os.kill(process.pid or 0, signal.SIGKILL)
        process.join()
        assert (tmp_path / LOCK).exists()
        FolderLock(tmp_path).release()

    def test_directories_come_and_go(self, tmp_path: Path) -> None:
        """Those made for the lock are removed with it, unless something is in them."""
        FolderLock(tmp_path / "a" / "b").release()
        assert contents(tmp_path) == {}
        lock = FolderLock(tmp_path / "a" / "b")
        (tmp_path / "a" / "note.txt").write_text("mine")
        lock.release()
        assert set(contents(tmp_path)) == {"a", "a/note.txt"}

    def test_a_replaced_directory_is_noticed(self, tmp_path: Path) -> None:
        directory = tmp_path / "run"
        lock = FolderLock(directory)
        assert lock.intact
        directory.rename(tmp_path / "elsewhere")
        assert not lock.intact
        other = FolderLock(directory)  # another run, which keeps its lock
        lock.release()
        assert other.intact
        other.release()

    def test_a_file_system_without_locks(
        self, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, caplog: pytest.LogCaptureFixture
    ) -> None:
        """The run goes on, with a warning."""

        def refuse(*_: object) -> None:
            raise OSError(95, "Operation not supported")

        monkeypatch.setattr("fcntl.flock", refuse)
        lock = FolderLock(tmp_path)
        assert "no locks" in caplog.text
        lock.release()


def lock_and_wait(directory: Path, locked: Any) -> None:
    lock = FolderLock(directory)
    locked.set()
    signal.pause()
    lock.release()


class TestOwnership:
    @pytest.mark.parametrize("name", [*OWN, "blocks/notes.txt", "blocks/block_000000.npz"])
    @pytest.mark.parametrize("overwrite", [False, True])
    def test_files_without_a_manifest(self, tmp_path: Path, name: str, overwrite: bool) -> None:
        """Whatever they contain, no run replaces or removes them."""
        write_text(tmp_path / name, "mine")
        before = contents(tmp_path)
        with pytest.raises(ow.InputError, match=name.split("/")[0]):
            RunFolder(tmp_path, RUN, overwrite=overwrite)
        assert contents(tmp_path) == before

    def test_files_of_other_names_stay(self, tmp_path: Path) -> None:
        """Beside the results, and beside the blocks; negative control of the refusals."""
        notes = ("note.txt", "results_old.nc", ".results.mine.nc", "plots/report.html")
        for name in notes:
            write_text(tmp_path / name, "mine")
        with_blocks(tmp_path)
        write_text(tmp_path / "blocks" / "note.txt", "mine")
        with RunFolder(tmp_path, RUN) as folder:
            folder.finish()
        finished_files = set(contents(tmp_path))
        assert {*notes, "plots", "blocks", "blocks/note.txt", MANIFEST} == finished_files

    @pytest.mark.parametrize("name", OWN)
    @pytest.mark.parametrize("overwrite", [False, True])
    def test_files_that_were_exchanged(self, tmp_path: Path, name: str, overwrite: bool) -> None:
        """A file that a user put in the place of the run's own is not the run's."""
        finished(tmp_path)
        (tmp_path / name).write_text("mine")
        before = contents(tmp_path)
        if overwrite or name != "report.html":
            with pytest.raises(ow.InputError, match=name):
                RunFolder(tmp_path, RUN, overwrite=overwrite)
        else:  # nothing is written, and an edited report is no reason to complain
            with RunFolder(tmp_path, RUN) as folder:
                assert folder.state == "complete"
        with RunFolder(tmp_path, None) as folder, pytest.raises(ow.InputError, match=name):
            folder.remove(name)  # type: ignore[arg-type]
        assert contents(tmp_path) == before

    def test_links_are_not_followed(self, tmp_path: Path) -> None:
        """Neither results nor blocks go through a link to somewhere else."""
        (tmp_path / "mine").mkdir()
        for name in ("blocks", "results.nc"):
            out = tmp_path / f"out {name}"
            out.mkdir()
            (out / name).symlink_to(tmp_path / "mine")
            with pytest.raises(ow.InputError, match=name):
                RunFolder(out, RUN)

    def test_temporary_files_of_killed_processes_go(self, tmp_path: Path) -> None:
        with_blocks(tmp_path)
        left = uuid.uuid4().hex
        for name in (
            f".results.{left}.nc",
            f".manifest.{left}.json",
            f"blocks/.block_000003.{left}.npz",
        ):
            (tmp_path / name).write_text("half")
        with RunFolder(tmp_path, RUN) as folder:
            folder.finish()
        assert set(contents(tmp_path)) == {MANIFEST}


class TestBlocks:
    def test_are_resumed(self, tmp_path: Path) -> None:
        with_blocks(tmp_path)
        with RunFolder(tmp_path, RUN) as folder:
            assert folder.time_reached == 60.0

    @pytest.mark.parametrize("fault", ["changed", "missing", "of another run", "one too many"])
    def test_that_are_not_the_runs_own(self, tmp_path: Path, fault: str) -> None:
        with_blocks(tmp_path)
        block = tmp_path / "blocks" / "block_000001.npz"
        if fault == "changed":
            block.write_text("Block 1")
        elif fault == "missing":
            block.unlink()
        elif fault == "of another run":
            shutil.copy(tmp_path / "blocks" / "block_000002.npz", block)
        else:
            block = tmp_path / "blocks" / "block_000007.npz"
            block.write_text("mine")
        before = contents(tmp_path)
        with pytest.raises(ow.InputError, match=block.name):
            RunFolder(tmp_path, RUN)
        assert contents(tmp_path) == before

    def test_killed_between_entry_and_file(self, tmp_path: Path) -> None:
        """The last block counts only if its file is there."""
        with_blocks(tmp_path)
        (tmp_path / "blocks" / "block_000002.npz").unlink()
        with RunFolder(tmp_path, RUN) as folder:
            assert folder.time_reached == 40.0

    def test_overwriting_needs_no_whole_blocks(self, tmp_path: Path) -> None:
        with_blocks(tmp_path)
        (tmp_path / "blocks" / "block_000001.npz").write_text("damaged")
        with RunFolder(tmp_path, RUN, overwrite=True) as folder:
            folder.begin()
            assert folder.time_reached == 0.0
        assert set(contents(tmp_path)) == {MANIFEST}


class TestAnotherRun:
    @pytest.mark.parametrize("key", RUN)
    @pytest.mark.parametrize("state", ["complete", "stopped"])
    def test_is_refused(self, tmp_path: Path, key: str, state: str) -> None:
        """The message says what differs."""
        finished(tmp_path) if state == "complete" else with_blocks(tmp_path)
        before = contents(tmp_path)
        with pytest.raises(ow.InputError, match=f"{key} {RUN[key]}.*{key} other.*overwrite"):
            RunFolder(tmp_path, RUN | {key: "other"})
        assert contents(tmp_path) == before

    def test_overwrites_what_is_the_runs_own(self, tmp_path: Path) -> None:
        """Not before it has something to write."""
        finished(tmp_path)
        write_text(tmp_path / "note.txt", "mine")
        before, other = contents(tmp_path), RUN | {"case": "calm"}
        with RunFolder(tmp_path, other, overwrite=True) as folder:
            assert folder.state is None
        assert contents(tmp_path) == before
        with RunFolder(tmp_path, other, overwrite=True) as folder:
            folder.begin()
            assert set(contents(tmp_path)) == {MANIFEST, LOCK, "note.txt"}
        finished(tmp_path, other)
        assert contents(tmp_path)["results.nc"] == b"results.nc of calm"

    def test_killed_while_overwriting(
        self, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
    ) -> None:
        """The old manifest goes last, so files of two runs are never taken for those of one."""
        finished(tmp_path)
        folder = RunFolder(tmp_path, RUN | {"case": "calm"}, overwrite=True)
        unlink = Path.unlink

        def killed(path: Path, *, missing_ok: bool = False) -> None:
            if path.name == "results.nc":
                raise SystemExit
            unlink(path, missing_ok=missing_ok)

        with monkeypatch.context() as patch:
            patch.setattr(Path, "unlink", killed)
            with pytest.raises(SystemExit):
                folder.begin()
        folder.close()
        assert set(contents(tmp_path)) == {MANIFEST, "results.nc"}
        with pytest.raises(ow.InputError, match="case gale"):
            RunFolder(tmp_path, RUN | {"case": "calm"})

    def test_of_the_same_name_without_results_starts_again(self, tmp_path: Path) -> None:
        """A user who deletes results.nc wants it made again."""
        finished(tmp_path)
        (tmp_path / "results.nc").unlink()
        with RunFolder(tmp_path, RUN) as folder:
            assert folder.state is None


class TestManifest:
    @pytest.mark.parametrize(
        "change",
        [
            {"format": "other"},
            {"state": "done"},
            {"files": {"../../secret.txt": None}},
            {"files": {"results.nc": "short"}},
            {"blocks": [{"file": "../note.txt", "begin_s": 0, "end_s": 1, "sha256": "0" * 64}]},
            {"unknown": 1},
            {"run": None},
        ],
        ids=str,
    )
    def test_that_no_run_wrote(self, tmp_path: Path, change: dict[str, Any]) -> None:
        """No name in it leads out of the directory."""
        finished(tmp_path)
        path = tmp_path / MANIFEST
        path.write_text(json.dumps(json.loads(path.read_text()) | change))
        before = contents(tmp_path)
        for overwrite in (False, True):
            with pytest.raises(ow.InputError, match=r"manifest\.json"):
                RunFolder(tmp_path, RUN, overwrite=overwrite)
        assert contents(tmp_path) == before

    def test_is_read_back(self, tmp_path: Path) -> None:
        """Negative control."""
        finished(tmp_path)
        manifest = read_manifest(tmp_path)
        assert manifest is not None
        assert manifest.run == RUN
        assert set(manifest.files) == set(OWN)
        assert read_manifest(tmp_path / "nowhere") is None


def test_a_removed_directory_ends_the_run(tmp_path: Path) -> None:
    """It is not made again, and nothing is written to another of its name."""
    directory = tmp_path / "out"
    with RunFolder(directory, RUN) as folder:
        folder.begin()
        shutil.rmtree(directory)
        with pytest.raises(FileNotFoundError, match="removed or replaced"):
            folder.update(state="solved")
        with pytest.raises(FileNotFoundError, match="removed or replaced"):
            folder.remove("results.nc")
    assert not directory.exists()


def test_bad_input_leaves_nothing(tmp_path: Path) -> None:
    with pytest.raises(ow.InputError), RunFolder(tmp_path / "a" / "out", RUN):
        raise ow.InputError("case", 1, "2", "")
    assert contents(tmp_path) == {}
