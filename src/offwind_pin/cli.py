"""The command line: thin, with messages a person can act on and exit codes a script can read."""

from __future__ import annotations

import json
import logging
import shlex
import sys
import webbrowser
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import Annotated, Any

import numpy as np
import typer
import xarray as xr
from rich.console import Console
from rich.progress import BarColumn, Progress, TextColumn, TimeRemainingColumn
from rich.table import Table

from offwind_pin.analysis.build import build
from offwind_pin.analysis.foundations import FOUNDATIONS
from offwind_pin.analysis.modal import mode_name, modes
from offwind_pin.analysis.static import static
from offwind_pin.campaign.case import load_case, shipped_cases
from offwind_pin.campaign.export import export_urdf
from offwind_pin.campaign.output import check_writable
from offwind_pin.campaign.overview import Overview, overview
from offwind_pin.campaign.run import modes_to_dataset, run_case
from offwind_pin.campaign.soil_files import write_soil
from offwind_pin.campaign.soil_overview import SoilOverview, soil_overview
from offwind_pin.campaign.summaries import summarise_damping, summarise_modes, summarise_static
from offwind_pin.display.animation import animate
from offwind_pin.display.pictures import check_frames, check_still
from offwind_pin.display.serve import address, page_server
from offwind_pin.display.soil_page import soil_tables
from offwind_pin.display.viewing import FPS, View
from offwind_pin.dynamics.sea import StillWater
from offwind_pin.dynamics.system import System
from offwind_pin.errors import InputError, InterruptedSimulation, SolverError
from offwind_pin.results.files import write_text
from offwind_pin.results.reading import open_results
from offwind_pin.structure.chain import Element
from offwind_pin.turbines.base import Array
from offwind_pin.turbines.reader import load_turbine, shipped_turbines
from offwind_pin.verification.ledger import Outcome, Row, choose, verify
from offwind_pin.verification.page import outcome_cells, verification_page

EXIT_SYSTEM, EXIT_INPUT, EXIT_SOLVER, EXIT_INTERRUPTED = 1, 2, 3, 130

app = typer.Typer(
    help="Structural dynamics of monopile offshore wind turbines.",
    no_args_is_help=True,
    add_completion=False,
    pretty_exceptions_enable=False,
)

TurbineArgument = Annotated[
    str, typer.Argument(help=f"Shipped name ({', '.join(shipped_turbines())}) or a YAML file.")
]
FoundationOption = Annotated[str, typer.Option(help=f"One of {', '.join(FOUNDATIONS)}.")]
ElementsOption = Annotated[int | None, typer.Option(help="Multibody beam elements in all.")]
ElementOption = Annotated[
    Element, typer.Option(help="euler_bernoulli, or timoshenko for elements that shear as well.")
]
JsonOption = Annotated[bool, typer.Option("--json", help="Print JSON instead of a table.")]


@app.command()
def show(turbine: TurbineArgument, as_json: JsonOption = False) -> None:  # noqa: FBT002
    """Print what was understood of a turbine: masses, lengths, frequencies."""
    facts = overview(load_turbine(turbine))
    if as_json:
        _print_json(facts.as_dict())
    else:
        _print_overview(facts)


@app.command("modes")
def modes_command(
    turbine: TurbineArgument,
    foundation: FoundationOption = "distributed_springs",
    dry: Annotated[bool, typer.Option("--dry", help="Without water.")] = False,  # noqa: FBT002
    elements: ElementsOption = None,
    element: ElementOption = "euler_bernoulli",
    count: Annotated[int | None, typer.Option(help="Number of modes, by default 8.")] = None,
    as_json: JsonOption = False,  # noqa: FBT002
) -> None:
    """Natural frequencies about the static state, in still water."""
    sea = None if dry else StillWater()
    system = build(load_turbine(turbine), foundation, sea, elements=elements, element=element)
    result = modes(system, min(8, system.nv) if count is None else count)
    rows = summarise_modes(result)
    if as_json:
        about: dict[str, Any] = {
            "turbine": system.turbine.name,
            "foundation": foundation,
            "dry": dry,
        }
        about |= {"surrogate": system.foundation.surrogate}
        _print_json(about | {"structural_damping": summarise_damping(system), "modes": rows})
        return
    water = "dry" if dry else "in still water"
    table = Table("mode", "", "frequency", "damping", "peak at", title=f"{foundation}, {water}")
    for row in rows:
        table.add_row(
            row["label"],
            mode_name(row["label"]),
            f"{row['frequency_hz']:.4f} Hz",
            f"{100 * row['damping_ratio']:.2f} %",
            f"{row['shape_peak_height_ratio']:.2f} of height",
        )
    Console().print(table)
    _print_notes(system)


@app.command("static")
def static_command(
    turbine: TurbineArgument,
    foundation: FoundationOption = "distributed_springs",
    tower_top_load: Annotated[
        str | None,
        typer.Option(metavar="FX,FY,FZ,MX,MY,MZ", help="Load at the yaw bearing in N and N m."),
    ] = None,
    elements: ElementsOption = None,
    element: ElementOption = "euler_bernoulli",
    as_json: JsonOption = False,  # noqa: FBT002
) -> None:
    """Static equilibrium under gravity and, if given, a load at the yaw bearing."""
    load = None if tower_top_load is None else _numbers(tower_top_load, "--tower-top-load")
    system = build(load_turbine(turbine), foundation, elements=elements, element=element)
    summary = summarise_static(static(system, load))
    if as_json:
        about = {"turbine": system.turbine.name, "foundation": foundation}
        _print_json(about | {"surrogate": system.foundation.surrogate} | summary)
        return
    table = Table("quantity", "value", title=f"{foundation}, static")
    for key, value in summary.items():
        table.add_row(key, f"{value:.6g}")
    Console().print(table)
    _print_surrogate(system.foundation.surrogate)


@app.command("soil")
def soil_command(
    turbine: TurbineArgument,
    out: Annotated[
        Path | None, typer.Option(help="Directory for soil.html, soil.json, curves and 6x6 files.")
    ] = None,
    result: Annotated[
        Path | None, typer.Option(help="Directory of a run, for the state that it reached.")
    ] = None,
    load: Annotated[
        str | None,
        typer.Option(metavar="FX,FY,FZ,MX,MY,MZ", help="Load at the yaw bearing in N and N m."),
    ] = None,
    arm: Annotated[
        float | None,
        typer.Option(help="Height in m of the pushover's load, by default the yaw bearing's."),
    ] = None,
    elements: ElementsOption = None,
    as_json: JsonOption = False,  # noqa: FBT002
) -> None:
    """Curves of the soil, their state, pushover, 6x6, apparent fixity and damping."""
    if out is not None:
        check_writable(out)
    acting = None if load is None else _numbers(load, "--load")
    overview = soil_overview(
        load_turbine(turbine), load=acting, result=result, arm=arm, elements=elements
    )
    written = [] if out is None else write_soil(overview, out)
    if as_json:
        _print_json(overview.as_dict())
        return
    _print_soil(overview)
    for path in written:
        Console().print(f"Wrote {path}", soft_wrap=True)


@app.command()
def run(
    case: Annotated[
        str, typer.Argument(help=f"Shipped name ({', '.join(shipped_cases())}) or a YAML file.")
    ],
    out: Annotated[Path, typer.Option(help="Directory for the results.")],
    as_json: JsonOption = False,  # noqa: FBT002
) -> None:
    """Solve a load case; write summary.json, results.nc and report.html."""
    definition, folder = load_case(case)
    with _simulation_progress() as progress:
        summary = run_case(definition, folder, out, progress=progress)
    if as_json:
        _print_json(summary)
        return
    table = Table("quantity", "value", title=definition.title or definition.name)
    for key, value in summary.items():
        if isinstance(value, int | float | str):
            table.add_row(key, f"{value:.6g}" if isinstance(value, float) else str(value))
    console = Console()
    console.print(table)
    console.print(f"Report: {out / 'report.html'}", soft_wrap=True)


@app.command("animate")
def animate_command(
    turbine: TurbineArgument,
    html: Annotated[Path, typer.Option(help="File to write.")],
    foundation: FoundationOption = "distributed_springs",
    mode: Annotated[str, typer.Option(help="Label of the mode: FA1, SS2, T1, ...")] = "FA2",
    element: ElementOption = "euler_bernoulli",
    dry: Annotated[bool, typer.Option("--dry", help="Without water.")] = False,  # noqa: FBT002
) -> None:
    """Write a self-contained page with a mode moving."""
    _check_target("--html", html, "fa2.html")
    system = build(
        load_turbine(turbine), foundation, None if dry else StillWater(), element=element
    )
    write_text(html, animate(system, modes(system, min(12, system.nv)), mode.upper()))
    Console().print(f"Wrote {html}", soft_wrap=True)


@app.command("view")
def view_command(
    source: Annotated[
        str,
        typer.Argument(help="Directory of a run or its results.nc; or a turbine, for its modes."),
    ],
    html: Annotated[Path | None, typer.Option(help="Write the page into a file.")] = None,
    still: Annotated[Path | None, typer.Option(help="Write a picture: .png or .svg.")] = None,
    frames: Annotated[
        Path | None, typer.Option(help="New directory for numbered frames of a film.")
    ] = None,
    fps: Annotated[float, typer.Option(help="Frames a second.")] = FPS,
    start: Annotated[float | None, typer.Option(help="Start of the part shown in s.")] = None,
    duration: Annotated[float | None, typer.Option(help="Its duration in s.")] = None,
    mode_list: Annotated[
        str | None, typer.Option("--modes", help="Side by side, up to four: FA1,SS1,FA2,SS2.")
    ] = None,
    foundation: Annotated[
        str, typer.Option(help="Of a turbine; results have their own.")
    ] = "distributed_springs",
    dry: Annotated[bool, typer.Option("--dry", help="A turbine without water.")] = False,  # noqa: FBT002
    port: Annotated[int, typer.Option(help="By default any that is free.")] = 0,
    browser: Annotated[bool, typer.Option(help="Open the page in a browser.")] = True,  # noqa: FBT002
) -> None:
    """Show results in motion: a page on this computer until Ctrl-C, or files."""
    for option, path, example in (("--html", html, "view.html"), ("--still", still, "view.png")):
        if path is not None:
            _check_target(option, path, example)
    if still is not None:
        check_still(still)
    if frames is not None:
        check_frames(frames)
        check_writable(frames.parent)
    labels = None if mode_list is None else [part.strip().upper() for part in mode_list.split(",")]
    view = View(_results_of(source, foundation, dry=dry), start, duration, labels)
    if html is not None:
        write_text(html, view.page())
        Console().print(f"Wrote {html}", soft_wrap=True)
    if still is not None:
        view.still(still)
        Console().print(f"Wrote {still}", soft_wrap=True)
    if frames is not None:
        with _frames_progress() as progress:
            view.film(frames, fps, progress)
        Console().print(f"Wrote {frames}; a film of it:", soft_wrap=True)
        pattern, name = (
            shlex.quote(str(path)) for path in (frames / "frame_%05d.png", frames.name)
        )
        film = f"ffmpeg -framerate {fps:g} -i {pattern} -pix_fmt yuv420p {name}.mp4"
        Console().print(film, soft_wrap=True, markup=False)
    if (html, still, frames) == (None, None, None):
        _serve(view.page(), port, browser=browser)


def _results_of(source: str, foundation: str, *, dry: bool) -> xr.Dataset:
    """Results read from a file; of a turbine its modes, the only thing that is solved here."""
    path = Path(source)
    if path.is_dir() or path.suffix == ".nc":
        return open_results(path)
    if not path.exists() and source not in shipped_turbines():
        raise InputError(
            "SOURCE",
            source,
            "the directory of a run, its results.nc, a shipped turbine "
            f"({', '.join(shipped_turbines())}), or a turbine's YAML file",
            "Check the path; offwind run makes results.",
        )
    system = build(load_turbine(source), foundation, None if dry else StillWater())
    return modes_to_dataset(system, modes(system, min(10, system.nv)))


def _serve(page: str, port: int, *, browser: bool) -> None:
    """Serve a page on 127.0.0.1 until Ctrl-C."""
    with page_server(page, port) as server:
        url = address(server)
        print(f"{url}   (Ctrl-C ends)", flush=True)  # noqa: T201
        if browser:
            webbrowser.open(url)
        with suppress(KeyboardInterrupt):
            server.serve_forever()


@app.command()
def urdf(
    turbine: TurbineArgument,
    out: Annotated[Path, typer.Option(help="Directory for the URDF, its meshes and sidecar.")],
    foundation: FoundationOption = "distributed_springs",
    elements: ElementsOption = None,
    element: ElementOption = "euler_bernoulli",
) -> None:
    """Write the URDF that Pinocchio runs, its meshes, and the sidecar with springs and dampers."""
    check_writable(out)
    system = build(load_turbine(turbine), foundation, elements=elements, element=element)
    for path in export_urdf(system, out):
        Console().print(f"Wrote {path}", soft_wrap=True)


@app.command("verify")
def verify_command(
    only: Annotated[
        str | None, typer.Option(help="Rows by id, or several: oc6-*, morison-*.")
    ] = None,
    page: Annotated[Path | None, typer.Option(help="File for the rows as a Markdown page.")] = None,
    as_json: JsonOption = False,  # noqa: FBT002
) -> None:
    """Check every claim of the verification ledger anew; exit status 1 if a row fails."""
    rows = choose(only)
    if page is not None:
        _check_target("--page", page, "VERIFICATION.md")
    with _without_cautions(), _rows_progress(len(rows)) as progress:
        outcomes = verify(rows, progress)
    if page is not None:
        write_text(page, verification_page(outcomes))
    if as_json:
        _print_json({"rows": [outcome.as_dict() for outcome in outcomes]})
    else:
        _print_outcomes(outcomes)
    if any(outcome.status == "fail" for outcome in outcomes):
        raise typer.Exit(EXIT_SYSTEM)


def main() -> None:
    """Entry point of the ``offwind`` command."""
    logging.basicConfig(level=logging.WARNING, format="offwind: %(message)s")
    logging.getLogger("offwind_pin").setLevel(logging.INFO)
    try:
        app()
    except InputError as error:
        _complain(f"offwind: {error}")
        sys.exit(EXIT_INPUT)
    except SolverError as error:
        _complain(f"offwind: {error}")
        sys.exit(EXIT_SOLVER)
    except InterruptedSimulation as stopped:
        _complain(f"offwind: {stopped}; the results so far are kept")
        sys.exit(EXIT_INTERRUPTED)
    except OSError as error:
        _complain(f"offwind: {error.strerror or error}: {error.filename or 'while writing'}")
        sys.exit(EXIT_SYSTEM)


@contextmanager
def _simulation_progress() -> Iterator[Callable[[float, float], None]]:
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
def _frames_progress() -> Iterator[Callable[[int, int], None]]:
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
def _without_cautions() -> Iterator[None]:
    """Plain structures of the ledger are no turbines: cautions about them would drown its table."""
    logger = logging.getLogger("offwind_pin")
    before = logger.level
    logger.setLevel(logging.ERROR)
    try:
        yield
    finally:
        logger.setLevel(before)


@contextmanager
def _rows_progress(count: int) -> Iterator[Callable[[int, Row], None]]:
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


def _numbers(text: str, option: str) -> Array:
    """Numbers separated by commas; how many there must be is the load's own business."""
    try:
        return np.array([float(cell) for cell in text.split(",")])
    except ValueError:
        raise InputError(
            option,
            text,
            "six finite numbers FX,FY,FZ,MX,MY,MZ in N and N m",
            "Separate them by commas: 1e6,0,0,0,0,0.",
        ) from None


def _check_target(option: str, path: Path, example: str) -> None:
    if path.is_dir():
        raise InputError(option, str(path), "a file name", f"Name a file, such as {example}.")
    check_writable(path.parent)


def _print_json(data: dict[str, Any]) -> None:
    print(json.dumps(data, indent=2, allow_nan=False))  # noqa: T201


def _complain(message: str) -> None:
    print(message, file=sys.stderr)  # noqa: T201


def _print_surrogate(surrogate: str | None) -> None:
    if surrogate:
        Console().print(f"Surrogate soil: {surrogate}", style="yellow")


def _print_notes(system: System) -> None:
    """What a reader of modes must know besides."""
    _print_surrogate(system.foundation.surrogate)
    damping = summarise_damping(system)
    if not damping["asked"]:
        text = "No structural damping: the turbine file has no structural_damping block."
        Console().print(text, style="yellow")
    for label, asked in damping["asked"].items():
        achieved = damping["achieved"][label]
        if abs(achieved / asked - 1) > 0.05:
            text = f"Damping of {label}: {asked:.4g} asked for, {achieved:.4g} achieved."
            Console().print(text, style="yellow")


def _print_outcomes(outcomes: Sequence[Outcome]) -> None:
    """A table for each group, and what failed once more at the end."""
    console = Console()
    for group in dict.fromkeys(outcome.row.group for outcome in outcomes):
        table = Table("row", "found", "off by", "allowed", "", title=f"\n{group}", box=None)
        table.title_justify = "left"
        for outcome in outcomes:
            if outcome.row.group == group:
                name, _, found, _, *cells = outcome_cells(outcome)
                table.add_row(name, found, *cells, style=_OUTCOME_STYLE[outcome.status])
        console.print(table)
    passed = sum(outcome.status == "pass" for outcome in outcomes)
    absent = [outcome for outcome in outcomes if outcome.status == "not run"]
    console.print(f"{passed} of {len(outcomes)} rows passed, {len(absent)} not run.")
    for outcome in outcomes:
        if outcome.status != "pass":
            text = f"{outcome.row.id}: {outcome.status}, {outcome.row.quantity}"
            text += "" if outcome.reason is None else f" ({outcome.reason})"
            console.print(text, soft_wrap=True, markup=False)


_OUTCOME_STYLE = {"pass": "", "fail": "bold red", "not run": "yellow"}


def _print_soil(overview: SoilOverview) -> None:
    console = Console()
    for title, columns, rows in soil_tables(overview):
        table = Table(*columns, title=title, title_justify="left", show_header=any(columns))
        for column in table.columns[1:]:
            column.justify = "right"
        for row in rows:
            table.add_row(*row)
        console.print(table)
    if overview.state is not None:
        console.print(f"State: {overview.state.origin}", soft_wrap=True)
    for text in (*overview.foundation.cautions, *overview.remarks):
        console.print(text, style="yellow", markup=False)
    _print_surrogate(overview.foundation.surrogate)


def _print_overview(facts: Overview) -> None:
    console = Console()
    for title, rows in facts.tables():
        table = Table(title=title, show_header=False, title_justify="left")
        for name, value in rows:
            table.add_row(name, value)
        console.print(table)
    _print_surrogate(facts.surrogate)
