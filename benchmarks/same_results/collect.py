"""Write one group of results with the ``offwind_pin`` that Python finds.

``python collect.py GROUP CHECKOUT OUT`` is run by ``same_results.py`` in a process of its own, with
the sources of the revision in question on ``PYTHONPATH``. It knows the package by its command line
and its top-level names only, so that it runs with every revision.
"""

from __future__ import annotations

import importlib.util
import io
import json
import sys
from collections.abc import Callable
from contextlib import redirect_stdout
from pathlib import Path
from typing import Any
from unittest import mock

import matplotlib as mpl

mpl.use("Agg")

import matplotlib.pyplot as plt
import numpy as np

import offwind_pin as ow
from offwind_pin.cli import main as offwind

FOLDER = Path(__file__).resolve().parent
FOUNDATIONS = (
    "clamped",
    "apparent_fixity",
    "coupled_springs",
    "distributed_springs",
    "macro_element",
)
LOAD = "2.0e6,3.0e5,-1.0e5,4.0e6,1.2e7,2.0e6"
NOT_SUPPORTED = 2
"""Exit status of a foundation that a turbine has no numbers for."""


def run(*arguments: str) -> dict[str, Any]:
    """One command in this process: exit status and what it wrote, as data where that is JSON."""
    written = io.StringIO()
    status = 0
    with mock.patch("sys.argv", ["offwind", *arguments]), redirect_stdout(written):
        try:
            offwind()
        except SystemExit as stop:
            status = int(stop.code or 0)
    text = written.getvalue()
    return {"status": status, "output": json.loads(text) if text.startswith("{") else None}


def commands(out: Path, _: Path) -> None:
    """What every command says of the shipped turbines, and of two with every block."""
    own = [str(path) for path in sorted(FOLDER.glob("turbine_*.yaml"))]
    for turbine in [*ow.shipped_turbines(), *own]:
        name = Path(turbine).stem
        keep(out / f"show_{name}.json", run("show", turbine, "--json"))
        keep(
            out / f"soil_{name}.json",
            run("soil", turbine, "--load", LOAD, "--json", "--out", str(out / f"soil_{name}")),
        )
        for foundation in FOUNDATIONS:
            on = (turbine, "--foundation", foundation)
            at = f"{name}_{foundation}"
            found = run("static", *on, "--json")
            keep(out / f"static_{at}.json", found)
            if found["status"] == NOT_SUPPORTED:
                continue
            keep(
                out / f"static_loaded_{at}.json",
                run("static", *on, "--tower-top-load", LOAD, "--json"),
            )
            keep(out / f"modes_{at}.json", run("modes", *on, "--json"))
            keep(out / f"modes_dry_{at}.json", run("modes", *on, "--dry", "--json"))
            shearing = ("--element", "timoshenko", "--elements", "30", "--count", "12")
            keep(out / f"modes_shear_{at}.json", run("modes", *on, *shearing, "--json"))
            keep(
                out / f"urdf_{at}.json",
                run("urdf", *on, "--elements", "30", "--out", str(out / f"urdf_{at}")),
            )


def gallery(out: Path, checkout: Path) -> None:
    """Numbers of the examples, each as its own revision has it."""
    for path in sorted((checkout / "docs" / "gallery").glob("plot_*.py")):
        spec = importlib.util.spec_from_file_location(path.stem, path)
        if spec is None or spec.loader is None:
            raise ImportError(f"{path} is no module")
        example = importlib.util.module_from_spec(spec)
        spec.loader.exec_module(example)
        keep(out / f"{path.stem}.json", example.main())
        plt.close("all")


def saved(**settings: Any) -> dict[str, Any]:
    """Settings of the output as the revision takes them."""
    return {"save_at": ow.SaveAt(**settings)} if hasattr(ow, "SaveAt") else settings


def python_api(out: Path, _: Path) -> None:
    """What a case file does not offer: steps and integrators of one's own, loads as objects."""
    turbine = ow.load_turbine(FOLDER / "turbine_springs.yaml")
    noise = ow.WhiteNoise(2.0, 0.05, 0.4)
    sea = ow.IrregularWaves(spectrum=noise, seed=4, repeat_period=600.0, stretching="vertical")
    history = ow.read_load_history(FOLDER / "load.txt")
    system = ow.build(turbine, "distributed_springs", sea, elements=20)
    adaptive = ow.GeneralizedAlpha(ow.AdaptiveStep(tolerance=1e-6, largest=0.1), 0.8)
    ow.simulate(
        system,
        20.0,
        loads=[history],
        ramp=5.0,
        **saved(output_dt=0.1, heights=[-25.0, 0.0, 33.3], segments=[(-20.0, 0.0), (0.0, 87.6)]),
        integrator=adaptive,
        directory=out / "adaptive_step",
    )
    elastic = ow.load_turbine(FOLDER / "turbine_macro.yaml")
    small = ow.build(elastic, "clamped", ow.RegularWaves(3.0, 8.0), elements=4)
    ow.simulate(
        small,
        1.0,
        loads=[history],
        **saved(output_dt=0.1),
        integrator=ow.SciPyIVP("Radau"),
        directory=out / "scipy",
    )
    ow.simulate(small, 5.0, 0.02, [history], start="undeformed", directory=out / "undeformed")
    oc6 = ow.load_turbine("oc6_phase2")
    on_springs = ow.build(oc6, "distributed_springs")
    condensed = ow.condense(on_springs, ow.static(on_springs))
    pushed = ow.pushover(oc6, 145.63)
    damping = ow.aerodynamic_damping(ow.build(oc6, "clamped", elements=24), 9.0)
    keep(
        out / "studies.json",
        {
            "condensed_stiffness": plain(condensed.stiffness),
            "condensed_load": plain(condensed.load),
            "pushover_load": plain(pushed.load),
            "pushover_displacement": plain(pushed.displacement),
            "pushover_rotation": plain(pushed.rotation),
            "aerodynamic_damping": dict(zip(damping.label, plain(damping.ratio), strict=True)),
            "thrust": plain(ow.thrust_curve(oc6, np.array([5.0, 9.0, 14.0, 20.0]))),
            "den_hartog": vars(ow.den_hartog(0.02)),
        },
    )


def case(name: str) -> Callable[[Path, Path], None]:
    """A group that is one load case."""

    def solve(out: Path, _: Path) -> None:
        done = run("run", name, "--out", str(out), "--json")
        if done["status"] != 0:
            raise RuntimeError(f"offwind run {name} ended with exit status {done['status']}")

    return solve


def plain(values: Any) -> Any:
    return np.asarray(values).tolist()


def keep(path: Path, data: Any) -> None:
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(json.dumps(data, indent=1) + "\n")


SHIPPED = ("oc6-lc1.2", "oc6-lc2.1", "oc6-lc2.3", "oc6-lc5.1")
OWN = tuple(path.stem for path in sorted(FOLDER.glob("case_*.yaml")))
GROUPS: dict[str, Callable[[Path, Path], None]] = {
    **{name: case(name) for name in SHIPPED},
    **{name: case(str(FOLDER / f"{name}.yaml")) for name in OWN},
    "python_api": python_api,
    "commands": commands,
    "gallery": gallery,
}


if __name__ == "__main__":
    group, checkout, out = sys.argv[1:]
    if not Path(ow.__file__).is_relative_to(checkout):
        raise ImportError(f"the package is {ow.__file__} and not that of {checkout}")
    GROUPS[group](Path(out), Path(checkout))
