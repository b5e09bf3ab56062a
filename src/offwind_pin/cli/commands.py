"""The command line: thin, with messages a person can act on and exit codes a script can read."""

from __future__ import annotations

import json
import logging
import shlex
import webbrowser
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import Annotated, Any

import numpy as np
import typer
import xarray as xr
from rich.console import Console
from rich.table import Table

from offwind_pin.analysis.build import build
from offwind_pin.analysis.foundation.registry import FOUNDATIONS
from offwind_pin.analysis.foundation.study.study import soil_overview
from offwind_pin.analysis.modal import modes
from offwind_pin.analysis.static import static
from offwind_pin.base.definition import Array
from offwind_pin.base.errors import InputError
from offwind_pin.base.mode_labels import mode_name
from offwind_pin.base.whole_files import write_text
from offwind_pin.cases.case import load_case, shipped_cases
from offwind_pin.cases.output_directory import check_writable
from offwind_pin.cases.run import modes_to_dataset, run_case
from offwind_pin.cases.summary import summarise_damping, summarise_modes, summarise_static
from offwind_pin.cases.turbine_overview import overview
from offwind_pin.cli.exit_codes import EXIT_SYSTEM
from offwind_pin.cli.progress import frames_progress, rows_progress, simulation_progress
from offwind_pin.cli.tables import (
    print_notes,
    print_outcomes,
    print_overview,
    print_soil,
    print_surrogate,
)
from offwind_pin.definitions.reader import load_turbine, shipped_turbines
from offwind_pin.display.report.soil_folder import write_soil
from offwind_pin.display.viewer.mode_page import animate
from offwind_pin.display.viewer.serve import address, page_server
from offwind_pin.display.viewer.stills import check_frames, check_still
from offwind_pin.display.viewer.view import FPS, View
from offwind_pin.formats.urdf_folder import export_urdf
from offwind_pin.loads.sea.sea import StillWater
from offwind_pin.results.reading import open_results
from offwind_pin.structure.chain import Element
from offwind_pin.verification.ledger import choose, verify
from offwind_pin.verification.page import verification_page

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
        print_overview(facts)


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
    print_notes(system)


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
    print_surrogate(system.foundation.surrogate)


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
    print_soil(overview)
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
    definition = load_case(case)
    with simulation_progress() as progress:
        summary = run_case(definition, out, progress=progress)
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
        with frames_progress() as progress:
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
    with _without_cautions(), rows_progress(len(rows)) as progress:
        outcomes = verify(rows, progress)
    if page is not None:
        write_text(page, verification_page(outcomes))
    if as_json:
        _print_json({"rows": [outcome.as_dict() for outcome in outcomes]})
    else:
        print_outcomes(outcomes)
    if any(outcome.status == "fail" for outcome in outcomes):
        raise typer.Exit(EXIT_SYSTEM)


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
