"""A run that another process starts, kills, and starts again."""

from pathlib import Path

import offwind_pin as ow

DT, OUTPUT, DURATION = 0.05, 2.0, 2400.0

INTEGRATORS = {
    "fixed": ow.GeneralizedAlpha(ow.FixedStep(DT)),
    "adaptive": ow.GeneralizedAlpha(ow.AdaptiveStep(1e-5, largest=0.5)),
}


def run(directory: Path, steps: str, duration: float = DURATION) -> None:
    """On soil in waves, so that a block's end holds everything a state consists of."""
    turbine = ow.load_turbine("oc6_phase2").model_copy(update={"structural_damping": None})
    waves = ow.IrregularWaves(2.0, 6.0, seed=3, repeat_period=DURATION)
    system = ow.build(turbine, "distributed_springs", waves, elements=4)
    ow.simulate(
        system,
        duration,
        ramp=10.0,
        output_dt=OUTPUT,
        integrator=INTEGRATORS[steps],
        heights=[0.0],
        directory=directory,
    )
