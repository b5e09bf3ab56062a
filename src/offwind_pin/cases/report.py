"""The report of a case, from its results alone."""

from __future__ import annotations

from pathlib import Path

import xarray as xr

from offwind_pin.base.errors import InputError
from offwind_pin.base.whole_files import write_text
from offwind_pin.cases.tree_summary import summary
from offwind_pin.display.report.case_report import render_report
from offwind_pin.results.manifest import REPORT
from offwind_pin.results.reading import open_case
from offwind_pin.results.run_folder import RunFolder

GENERATOR = '<meta name="generator" content="offwind-pin">'
"""What a report has in its head."""


def report(tree: xr.DataTree) -> str:
    """HTML text of the report of a case; nothing is solved.

    Parameters
    ----------
    tree : DataTree
        Results of a case, from :func:`offwind_pin.results.reading.open_case`.
    """
    return render_report(tree, summary(tree))


def report_again(directory: Path) -> Path:
    """Write ``report.html`` of the results in a directory; returns its path.

    Raises
    ------
    InputError
        No results of a case there, or a ``report.html`` of other origin.
    """
    path = directory / REPORT
    with RunFolder(directory, None) as folder, open_case(directory) as tree:
        page = report(tree)
        if folder.manifest is None:  # results that were copied to another directory
            _check_generated(path)
            write_text(path, page)
        else:
            with folder.replacing(REPORT):
                write_text(path, page)
    return path


def _check_generated(path: Path) -> None:
    """Refuse a file that is not a report."""
    if path.exists() and GENERATOR not in path.read_text(encoding="utf-8", errors="replace"):
        raise InputError(
            str(path),
            "a page that offwind report did not write",
            f"no {REPORT}, or an earlier report",
            "Move it away.",
        )
