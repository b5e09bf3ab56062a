"""The report of a case, from its results alone."""

from __future__ import annotations

from pathlib import Path

import xarray as xr

from offwind_pin.base.whole_files import write_text
from offwind_pin.cases.tree_summary import summary
from offwind_pin.display.report.case_report import render_report
from offwind_pin.results.reading import open_case


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
        No results of a case there.
    """
    path = directory / "report.html"
    with open_case(directory) as tree:
        write_text(path, report(tree))
    return path
