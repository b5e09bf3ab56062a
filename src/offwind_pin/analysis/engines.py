"""The two implementations of the equations of motion, by name.

``"compiled"`` is an O(N) recursion for this kind of chain; ``"pinocchio"`` uses Pinocchio for the
rigid bodies and their derivatives, and dense matrices. Loads, Newton's method and generalised-alpha
are the same.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, get_args

from offwind_pin.base.errors import InputError
from offwind_pin.definitions.engine import Engine

if TYPE_CHECKING:
    from offwind_pin.analysis.integrators import Integrator
    from offwind_pin.analysis.static import StaticResult
    from offwind_pin.dynamics.compiled.chain import CompiledChain
    from offwind_pin.dynamics.compiled.pencil import CompiledPencil
    from offwind_pin.dynamics.reference.dense_chain import DenseChain
    from offwind_pin.dynamics.reference.dense_pencil import DensePencil
    from offwind_pin.dynamics.system import System
    from offwind_pin.loads.earthquake.ground_motion import GroundMotion
    from offwind_pin.loads.point_load import PointLoad


def check_engine(engine: str) -> None:
    """Reject an unknown engine.

    Raises
    ------
    InputError
        Naming the known engines.
    """
    if engine not in get_args(Engine):
        raise InputError("engine", engine, ", ".join(get_args(Engine)), "Choose one.")


def engine_of(integrator: Integrator, engine: Engine | None) -> Engine:
    """The requested engine, by default the integrator's first.

    Raises
    ------
    InputError
        An unknown engine, or one that the integrator does not support.
    """
    if engine is None:
        return integrator.engines[0]
    check_engine(engine)
    if engine not in integrator.engines:
        raise InputError(
            "engine",
            engine,
            f"{', '.join(integrator.engines)} with {type(integrator).__name__}",
            "Choose one, or use another integrator.",
        )
    return engine


def resting_chain(
    system: System, loads: Sequence[PointLoad], engine: Engine
) -> CompiledChain | DenseChain:
    """A system under the means of loads, for statics.

    Raises
    ------
    InputError
        An unknown engine.
    """
    check_engine(engine)
    if engine == "pinocchio":
        from offwind_pin.dynamics.reference.dense_chain import DenseChain

        return DenseChain(system.equations(loads, None))
    from offwind_pin.dynamics.compiled.chain import CompiledChain

    return CompiledChain(system, loads)


def pencil(system: System, about: StaticResult, engine: Engine) -> CompiledPencil | DensePencil:
    """Linear equations of small motions about a static state.

    Raises
    ------
    InputError
        An unknown engine.
    """
    check_engine(engine)
    if engine == "pinocchio":
        from offwind_pin.dynamics.reference.dense_pencil import DensePencil

        return DensePencil(system.equations(about.acting_loads(), None, about.memory), about.q)
    from offwind_pin.dynamics.compiled.chain import CompiledChain
    from offwind_pin.dynamics.compiled.pencil import CompiledPencil

    chain = CompiledChain(system, about.acting_loads())
    chain.memory = about.memory
    return CompiledPencil(chain, about.q)


def moving_chain(
    system: System,
    loads: Sequence[PointLoad],
    ramp_time: float,
    ground_motion: GroundMotion | None,
    engine: Engine,
) -> CompiledChain:
    """A system under loads, for time integration; compiled code records with either engine."""
    if engine == "pinocchio":
        from offwind_pin.dynamics.reference.moving_chain import MovingChain

        return MovingChain(system, loads, ramp_time, ground_motion)
    from offwind_pin.dynamics.compiled.chain import CompiledChain

    return CompiledChain(system, loads, ramp_time, ground_motion)
