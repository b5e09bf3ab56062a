"""The command line: arguments, output, and exit codes for scripts.

Each command imports what it needs when it runs, so that help and completion are quick.
"""

from __future__ import annotations

import json
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from offwind_pin.analysis.foundation.registry import FOUNDATIONS
from offwind_pin.cases.shipped import shipped_cases
from offwind_pin.cli.exit_codes import EXIT_INPUT, EXIT_SOLVER, EXIT_SYSTEM
from offwind_pin.definitions.element import Element
from offwind_pin.definitions.engine import Engine
from offwind_pin.definitions.shipped import shipped_turbines

if TYPE_CHECKING:
    import xarray as xr

    from offwind_pin.base.definition import Array

app = typer.Typer(
    no_args_is_help=True,
    pretty_exceptions_enable=False,
)


def _starting(names: list[str], begin: str) -> list[str]:
    return [name for name in names if name.startswith(begin)]


def _complete_turbine(incomplete: str) -> list[str]:
    return _starting(shipped_turbines(), incomplete)


def _complete_case(incomplete: str) -> list[str]:
    return _starting(shipped_cases(), incomplete)


def _complete_foundation(incomplete: str) -> list[str]:
    return _starting(list(FOUNDATIONS), incomplete)


def _print_version(asked: bool) -> None:  # noqa: FBT001 (the value of the option)
    if asked:
        import offwind_pin

        print(f"offwind {offwind_pin.__version__}")  # noqa: T201
        raise typer.Exit


@app.callback()
def _options(
    version: Annotated[  # noqa: FBT002
        bool,
        typer.Option(
            "--version", callback=_print_version, is_eager=True, help="Print the version and exit."
        ),
    ] = False,
) -> None:
    """Structural dynamics of monopile offshore wind turbines."""


TurbineArgument = Annotated[
    str,
    typer.Argument(
        help=f"Shipped name ({', '.join(shipped_turbines())}) or a YAML file.",
        autocompletion=_complete_turbine,
    ),
]
FoundationOption = Annotated[
    str,
    typer.Option(help=f"One of {', '.join(FOUNDATIONS)}.", autocompletion=_complete_foundation),
]
ElementsOption = Annotated[
    int | None, typer.Option(help="Total number of multibody beam elements.")
]
ElementOption = Annotated[
    Element, typer.Option(help="euler_bernoulli, or timoshenko to include shear.")
]
EngineOption = Annotated[
    Engine, typer.Option(help="Implementation of the equations: compiled or pinocchio.")
]
JsonOption = Annotated[bool, typer.Option("--json", help="Print JSON instead of a table.")]


@app.command()
def show(turbine: TurbineArgument, as_json: JsonOption = False) -> None:  # noqa: FBT002
    """Summarise the turbine as read: masses, lengths, frequencies."""
    from offwind_pin.cases.turbine_overview import overview
    from offwind_pin.cli.tables import print_overview
    from offwind_pin.definitions.reader import load_turbine

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
    engine: EngineOption = "compiled",
    as_json: JsonOption = False,  # noqa: FBT002
) -> None:
    """Natural frequencies about the static state, in still water."""
    from offwind_pin.analysis.build import build
    from offwind_pin.analysis.modal import modes
    from offwind_pin.cases.summary import summarise_damping, summarise_modes
    from offwind_pin.cli.tables import print_modes, print_notes
    from offwind_pin.definitions.reader import load_turbine
    from offwind_pin.loads.sea.sea import StillWater

    sea = None if dry else StillWater()
    system = build(load_turbine(turbine), foundation, sea, elements=elements, element=element)
    result = modes(system, min(8, system.nv) if count is None else count, engine=engine)
    rows = summarise_modes(result)
    if as_json:
        about: dict[str, Any] = {
            "turbine": system.turbine.name,
            "foundation": foundation,
            "dry": dry,
            "engine": engine,
        }
        about |= {"surrogate": system.foundation.surrogate}
        _print_json(about | {"structural_damping": summarise_damping(system), "modes": rows})
        return
    print_modes(f"{foundation}, {'dry' if dry else 'in still water'}", rows)
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
    engine: EngineOption = "compiled",
    as_json: JsonOption = False,  # noqa: FBT002
) -> None:
    """Static equilibrium under gravity and, if given, a load at the yaw bearing."""
    from offwind_pin.analysis.build import build
    from offwind_pin.analysis.static import static
    from offwind_pin.cases.summary import summarise_static
    from offwind_pin.cli.tables import print_surrogate, print_values
    from offwind_pin.definitions.reader import load_turbine

    load = None if tower_top_load is None else _numbers(tower_top_load, "--tower-top-load")
    system = build(load_turbine(turbine), foundation, elements=elements, element=element)
    summary = summarise_static(static(system, load, engine=engine))
    if as_json:
        about = {"turbine": system.turbine.name, "foundation": foundation, "engine": engine}
        _print_json(about | {"surrogate": system.foundation.surrogate} | summary)
        return
    print_values(f"{foundation}, static", summary)
    print_surrogate(system.foundation.surrogate)


@app.command("soil")
def soil_command(
    turbine: TurbineArgument,
    out: Annotated[
        Path | None, typer.Option(help="Directory for soil.html, soil.json, curves and 6x6 files.")
    ] = None,
    result: Annotated[
        Path | None, typer.Option(help="Directory of a run whose largest displacements to use.")
    ] = None,
    load: Annotated[
        str | None,
        typer.Option(metavar="FX,FY,FZ,MX,MY,MZ", help="Load at the yaw bearing in N and N m."),
    ] = None,
    arm: Annotated[
        float | None,
        typer.Option(help="Height of the pushover load above the mudline in m [yaw bearing]."),
    ] = None,
    elements: ElementsOption = None,
    as_json: JsonOption = False,  # noqa: FBT002
) -> None:
    """Soil reaction curves and their state, pushover, 6x6, apparent fixity and damping."""
    from offwind_pin.analysis.foundation.study.study import soil_overview
    from offwind_pin.cases.output_directory import check_writable
    from offwind_pin.cli.tables import print_soil
    from offwind_pin.definitions.reader import load_turbine
    from offwind_pin.display.report.soil_folder import write_soil

    if out is not None:
        check_writable(out)
    acting = None if load is None else _numbers(load, "--load")
    found = soil_overview(
        load_turbine(turbine), load=acting, result=result, arm=arm, elements=elements
    )
    written = [] if out is None else write_soil(found, out)
    if as_json:
        _print_json(found.as_dict())
        return
    print_soil(found)
    for path in written:
        typer.echo(f"Wrote {path}")


@app.command()
def run(
    case: Annotated[
        list[str],
        typer.Argument(
            help=f"Shipped names ({', '.join(shipped_cases())}) or YAML files.",
            autocompletion=_complete_case,
        ),
    ],
    out: Annotated[
        Path,
        typer.Option(
            help="Directory for the results; of several cases or seeds, each has one inside, "
            "such as DIR/oc6-lc5.1/seed_0001."
        ),
    ],
    seed: Annotated[
        int | None, typer.Option(help="Seed of everything random, in place of the case's.")
    ] = None,
    seeds: Annotated[str | None, typer.Option(help="Several seeds: 1-6, or 1,4,7-9.")] = None,
    overwrite: Annotated[  # noqa: FBT002
        bool, typer.Option("--overwrite", help="Replace earlier results of offwind run.")
    ] = False,
    report: Annotated[  # noqa: FBT002
        bool, typer.Option(help="Write report.html; offwind report can do so later.")
    ] = True,
    as_json: JsonOption = False,  # noqa: FBT002
) -> None:
    """Solve load cases; write results.nc, report.html and summary.json.

    A stopped run is continued; finished results of the same case are kept.
    """
    from offwind_pin.base.errors import InputError, SolverError
    from offwind_pin.cases.case import load_case
    from offwind_pin.cases.planned_runs import planned_runs, seed_numbers
    from offwind_pin.cases.run import run_case
    from offwind_pin.cli.progress import simulation_progress
    from offwind_pin.cli.tables import print_values

    if seed is not None and seeds is not None:
        raise InputError("--seed", seed, "either --seed or --seeds", "Leave one of them out.")
    numbers = None if seeds is None else seed_numbers(seeds)
    runs = planned_runs(
        [load_case(name) for name in case], numbers if seed is None else [seed], out
    )
    rows, codes = [], []
    for planned in runs:
        try:
            with simulation_progress() as progress:
                summary = run_case(
                    planned.case,
                    planned.directory,
                    report=report,
                    overwrite=overwrite,
                    progress=progress,
                )
        except (InputError, SolverError) as error:
            if len(runs) == 1:
                raise
            typer.echo(f"offwind: {planned.directory}: {error}", err=True)
            codes.append(EXIT_INPUT if isinstance(error, InputError) else EXIT_SOLVER)
            summary = {"case": planned.case.name, "status": "failed", "message": str(error)}
        rows.append({"directory": str(planned.directory), "seed": planned.case.seed, **summary})
        if not as_json and summary["status"] == "complete":
            print_values(planned.case.title or planned.case.name, summary)
            if report:
                typer.echo(f"Report: {planned.directory / 'report.html'}")
    if as_json:
        _print_json(summary if len(runs) == 1 else {"runs": rows})
    if codes:
        raise typer.Exit(min(codes))


@app.command("report")
def report_command(
    directory: Annotated[Path, typer.Argument(help="Output directory of offwind run.")],
) -> None:
    """Write report.html again from the results in a directory, without solving."""
    from offwind_pin.base.errors import InputError
    from offwind_pin.cases.output_directory import check_writable
    from offwind_pin.cases.report import report_again

    if not directory.is_dir():
        raise InputError(
            "DIR",
            str(directory),
            "an existing directory",
            "Give the --out directory of offwind run.",
        )
    check_writable(directory)
    typer.echo(f"Wrote {report_again(directory)}")


@app.command("animate")
def animate_command(
    turbine: TurbineArgument,
    html: Annotated[Path, typer.Option(help="File to write.")],
    foundation: FoundationOption = "distributed_springs",
    mode: Annotated[str, typer.Option(help="Label of the mode: FA1, SS2, T1, ...")] = "FA2",
    element: ElementOption = "euler_bernoulli",
    dry: Annotated[bool, typer.Option("--dry", help="Without water.")] = False,  # noqa: FBT002
) -> None:
    """Write a self-contained page with one mode moving; others can be selected in it."""
    from offwind_pin.base.whole_files import write_text
    from offwind_pin.display.viewer.view import View

    _check_target("--html", html, "fa2.html")
    results = _modes_of(turbine, foundation, dry=dry, element=element)
    write_text(html, View(results, labels=[mode.upper()]).page())
    typer.echo(f"Wrote {html}")


@app.command("view")
def view_command(
    source: Annotated[
        str,
        typer.Argument(help="Directory of a run or its results.nc; or a turbine, for its modes."),
    ],
    html: Annotated[Path | None, typer.Option(help="Write the page to a file.")] = None,
    still: Annotated[Path | None, typer.Option(help="Write a picture: .png or .svg.")] = None,
    frames: Annotated[
        Path | None, typer.Option(help="New directory for numbered frames of a film.")
    ] = None,
    fps: Annotated[float | None, typer.Option(help="Frames per second, by default 25.")] = None,
    start: Annotated[float | None, typer.Option(help="Start of the part shown, in s.")] = None,
    duration: Annotated[
        float | None, typer.Option(help="Duration of the part shown, in s.")
    ] = None,
    mode_list: Annotated[
        str | None, typer.Option("--modes", help="Modes side by side, up to four: FA1,SS1,FA2,SS2.")
    ] = None,
    foundation: Annotated[
        str, typer.Option(help="Foundation of a turbine; ignored for results.")
    ] = "distributed_springs",
    dry: Annotated[bool, typer.Option("--dry", help="Without water, for a turbine.")] = False,  # noqa: FBT002
    port: Annotated[int, typer.Option(help="Port of the page; 0 for any free one.")] = 0,
    browser: Annotated[bool, typer.Option(help="Open the page in a browser.")] = True,  # noqa: FBT002
) -> None:
    """Animate results: on a local page until Ctrl-C, or in files."""
    import shlex

    from offwind_pin.base.whole_files import write_text
    from offwind_pin.cases.output_directory import check_writable
    from offwind_pin.cli.progress import frames_progress
    from offwind_pin.display.viewer.picture import check_frames, check_still
    from offwind_pin.display.viewer.view import FPS, View
    from offwind_pin.viewer import serve

    for option, path, example in (("--html", html, "view.html"), ("--still", still, "view.png")):
        if path is not None:
            _check_target(option, path, example)
    if still is not None:
        check_still(still)
    if frames is not None:
        check_frames(frames)
        check_writable(frames.parent)
    labels = None if mode_list is None else [part.strip().upper() for part in mode_list.split(",")]
    results = _results_of(source, foundation, dry=dry, modal=labels is not None)
    view = View(results, start, duration, labels)
    if html is not None:
        write_text(html, view.page())
        typer.echo(f"Wrote {html}")
    if still is not None:
        view.still(still)
        typer.echo(f"Wrote {still}")
    if frames is not None:
        rate = FPS if fps is None else fps
        with frames_progress() as progress:
            view.film(frames, rate, progress)
        typer.echo(f"Wrote {frames}; to make a film:")
        pattern, name = (
            shlex.quote(str(path)) for path in (frames / "frame_%05d.png", frames.name)
        )
        film = f"ffmpeg -framerate {rate:g} -i {pattern} -pix_fmt yuv420p {name}.mp4"
        typer.echo(film)
    if (html, still, frames) == (None, None, None):
        serve(view.page(), port, browser=browser)


def _results_of(source: str, foundation: str, *, dry: bool, modal: bool) -> xr.Dataset:
    """Results read from a file; for a turbine its modes, which are solved here.

    modal : whether modes are asked for, which a time history may have in a group
    """
    from offwind_pin.base.errors import InputError
    from offwind_pin.results.reading import open_checked
    from offwind_pin.results.tree import part

    path = Path(source)
    if path.is_dir() or path.suffix == ".nc":
        tree = open_checked(path)
        found = part(tree, "modes") if modal else None
        return tree.to_dataset() if found is None else found
    if not path.exists() and source not in shipped_turbines():
        raise InputError(
            "SOURCE",
            source,
            "the directory of a run, its results.nc, a shipped turbine "
            f"({', '.join(shipped_turbines())}), or a turbine's YAML file",
            "Check the path; offwind run writes results.",
        )
    return _modes_of(source, foundation, dry=dry)


def _modes_of(
    turbine: str, foundation: str, *, dry: bool, element: Element = "euler_bernoulli"
) -> xr.Dataset:
    """The first twelve modes of a turbine."""
    from offwind_pin.analysis.build import build
    from offwind_pin.analysis.drawing_data import modes_dataset
    from offwind_pin.analysis.modal import modes
    from offwind_pin.definitions.reader import load_turbine
    from offwind_pin.loads.sea.sea import StillWater

    sea = None if dry else StillWater()
    system = build(load_turbine(turbine), foundation, sea, element=element)
    return modes_dataset(system, modes(system, min(12, system.nv)))


@app.command()
def urdf(
    turbine: TurbineArgument,
    out: Annotated[Path, typer.Option(help="Directory for the URDF, its meshes and sidecar.")],
    foundation: FoundationOption = "distributed_springs",
    elements: ElementsOption = None,
    element: ElementOption = "euler_bernoulli",
) -> None:
    """Write the URDF that Pinocchio uses, its meshes, and a sidecar with springs and dampers."""
    from offwind_pin.analysis.build import build
    from offwind_pin.cases.output_directory import check_writable
    from offwind_pin.definitions.reader import load_turbine
    from offwind_pin.formats.urdf_folder import export_urdf

    check_writable(out)
    system = build(load_turbine(turbine), foundation, elements=elements, element=element)
    for path in export_urdf(system, out):
        typer.echo(f"Wrote {path}")


@app.command("verify")
def verify_command(
    only: Annotated[str | None, typer.Option(help="Row id, or a pattern such as oc6-*.")] = None,
    page: Annotated[
        Path | None, typer.Option(help="File for the results as a Markdown page.")
    ] = None,
    as_json: JsonOption = False,  # noqa: FBT002
) -> None:
    """Re-run the checks of the verification ledger; exit status 1 if a row fails."""
    from offwind_pin.base.whole_files import write_text
    from offwind_pin.cli.progress import rows_progress
    from offwind_pin.cli.tables import print_outcomes
    from offwind_pin.verification.ledger import choose, verify
    from offwind_pin.verification.page import verification_page

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
    """The ledger's plain structures are not turbines: cautions about them would bury its table."""
    import logging

    logger = logging.getLogger("offwind_pin")
    before = logger.level
    logger.setLevel(logging.ERROR)
    try:
        yield
    finally:
        logger.setLevel(before)


def _numbers(text: str, option: str) -> Array:
    """Numbers separated by commas; the load checks how many there are."""
    import numpy as np

    from offwind_pin.base.errors import InputError

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
    from offwind_pin.base.errors import InputError
    from offwind_pin.cases.output_directory import check_writable

    if path.is_dir():
        raise InputError(option, str(path), "a file name", f"Give a file name, such as {example}.")
    check_writable(path.parent)


def _print_json(data: dict[str, Any]) -> None:
    print(json.dumps(data, indent=2, allow_nan=False))  # noqa: T201
