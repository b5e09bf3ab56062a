"""The public names."""

from offwind_pin import plots, sea, signal, soil, viewer, wind
from offwind_pin.analysis.build import build
from offwind_pin.analysis.integrators import (
    GeneralizedAlpha,
    Integrator,
    OneStepMethod,
    SciPyIVP,
    StepFailed,
)
from offwind_pin.analysis.modal import ModalResult, modes
from offwind_pin.analysis.simulate import simulate
from offwind_pin.analysis.static import StaticResult, static
from offwind_pin.base.channels import Channel
from offwind_pin.base.errors import InputError, InterruptedSimulation, OffwindError, SolverError
from offwind_pin.cases.case import Case, load_case
from offwind_pin.cases.run import run_case
from offwind_pin.definitions.reader import load_turbine
from offwind_pin.definitions.shipped import shipped_turbines
from offwind_pin.definitions.structural_damping import (
    ModalDamping,
    RayleighDamping,
    StiffnessDamping,
)
from offwind_pin.definitions.tuned_mass_damper import DampedAbsorber, den_hartog
from offwind_pin.definitions.turbine import Turbine
from offwind_pin.dynamics.system import System
from offwind_pin.formats.urdf_folder import export_urdf
from offwind_pin.loads.earthquake.ground_motion import GroundMotion
from offwind_pin.loads.point_load import (
    PointForces,
    PointLoad,
    PointMotion,
    PointTangents,
)
from offwind_pin.loads.sea.irregular_waves import IrregularWaves
from offwind_pin.loads.sea.sea import RegularWaves, StillWater
from offwind_pin.loads.sea.waves.spectra import JonswapSpectrum
from offwind_pin.loads.tower_top.load_history import LoadHistory, read_load_history
from offwind_pin.loads.wind.rotor_thrust import RotorThrust
from offwind_pin.results.reading import open_results
from offwind_pin.results.save_at import SaveAt

# Names that have moved to a namespace can still be imported from here.
from offwind_pin.sea import Crest as Crest
from offwind_pin.sea import CurrentSum as CurrentSum
from offwind_pin.sea import CurrentTable as CurrentTable
from offwind_pin.sea import MeasuredWaves as MeasuredWaves
from offwind_pin.sea import PowerLawCurrent as PowerLawCurrent
from offwind_pin.sea import Spreading as Spreading
from offwind_pin.sea import StreamWaves as StreamWaves
from offwind_pin.sea import SurfaceCurrent as SurfaceCurrent
from offwind_pin.sea import SurfaceRecord as SurfaceRecord
from offwind_pin.sea import TableSpectrum as TableSpectrum
from offwind_pin.sea import TmaSpectrum as TmaSpectrum
from offwind_pin.sea import UniformCurrent as UniformCurrent
from offwind_pin.sea import WhiteNoise as WhiteNoise
from offwind_pin.signal import Accelerations as Accelerations
from offwind_pin.signal import CrossSpectra as CrossSpectra
from offwind_pin.signal import FreeDecay as FreeDecay
from offwind_pin.signal import OperationalModes as OperationalModes
from offwind_pin.signal import cross_spectral_matrix as cross_spectral_matrix
from offwind_pin.signal import free_decay as free_decay
from offwind_pin.signal import modal_assurance as modal_assurance
from offwind_pin.signal import operational_modes as operational_modes
from offwind_pin.signal import read_accelerations as read_accelerations
from offwind_pin.soil import Condensation as Condensation
from offwind_pin.soil import DeflectionTarget as DeflectionTarget
from offwind_pin.soil import FrequencyTarget as FrequencyTarget
from offwind_pin.soil import Parameter as Parameter
from offwind_pin.soil import Pushover as Pushover
from offwind_pin.soil import ShapeTarget as ShapeTarget
from offwind_pin.soil import SoilIdentification as Identification  # noqa: F401
from offwind_pin.soil import SoilOverview as SoilOverview
from offwind_pin.soil import condense as condense
from offwind_pin.soil import equivalent_damping as equivalent_damping
from offwind_pin.soil import identify_soil as identify_soil
from offwind_pin.soil import pile_only as pile_only
from offwind_pin.soil import pushover as pushover
from offwind_pin.soil import soil_overview as soil_overview
from offwind_pin.soil import write_soil as write_soil
from offwind_pin.solvers.steps import AdaptiveStep, FixedStep, StepPolicy
from offwind_pin.wind import ExtremeOperatingGust as ExtremeOperatingGust
from offwind_pin.wind import LogLaw as LogLaw
from offwind_pin.wind import PowerLaw as PowerLaw
from offwind_pin.wind import RotorWind as RotorWind
from offwind_pin.wind import SyntheticWind as SyntheticWind
from offwind_pin.wind import TowerWind as TowerWind
from offwind_pin.wind import WindSeries as WindSeries
from offwind_pin.wind import aerodynamic_damping as aerodynamic_damping
from offwind_pin.wind import rotor_disc as rotor_disc
from offwind_pin.wind import thrust_curve as thrust_curve
from offwind_pin.wind import tower_drag as tower_drag

__version__: str

__all__ = [
    "AdaptiveStep",
    "Case",
    "Channel",
    "DampedAbsorber",
    "FixedStep",
    "GeneralizedAlpha",
    "GroundMotion",
    "InputError",
    "Integrator",
    "InterruptedSimulation",
    "IrregularWaves",
    "JonswapSpectrum",
    "LoadHistory",
    "ModalDamping",
    "ModalResult",
    "OffwindError",
    "OneStepMethod",
    "PointForces",
    "PointLoad",
    "PointMotion",
    "PointTangents",
    "RayleighDamping",
    "RegularWaves",
    "RotorThrust",
    "SaveAt",
    "SciPyIVP",
    "SolverError",
    "StaticResult",
    "StepFailed",
    "StepPolicy",
    "StiffnessDamping",
    "StillWater",
    "System",
    "Turbine",
    "build",
    "den_hartog",
    "export_urdf",
    "load_case",
    "load_turbine",
    "modes",
    "open_results",
    "plots",
    "read_load_history",
    "run_case",
    "sea",
    "shipped_turbines",
    "signal",
    "simulate",
    "soil",
    "static",
    "viewer",
    "wind",
]
