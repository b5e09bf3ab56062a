"""Structural dynamics of monopile offshore wind turbines.

>>> import offwind_pin as ow
>>> turbine = ow.load_turbine("oc6_phase2")
>>> system = ow.build(turbine, foundation="coupled_springs", sea=ow.StillWater())
>>> ow.modes(system, n=2).label
['SS1', 'FA1']
"""

from offwind_pin.analysis.aerodynamic_damping import aerodynamic_damping
from offwind_pin.analysis.build import build
from offwind_pin.analysis.foundation.condensation import Condensation, condense
from offwind_pin.analysis.foundation.equivalent_damping import equivalent_damping
from offwind_pin.analysis.foundation.pile_only import pile_only
from offwind_pin.analysis.foundation.pushover import Pushover, pushover
from offwind_pin.analysis.foundation.study.study import SoilOverview, soil_overview
from offwind_pin.analysis.integrators import GeneralizedAlpha, SciPyIVP
from offwind_pin.analysis.modal import ModalResult, modes
from offwind_pin.analysis.simulate import simulate
from offwind_pin.analysis.static import StaticResult, static
from offwind_pin.analysis.tower_drag import tower_drag
from offwind_pin.analysis.updating.identify_soil import Identification, Parameter, identify_soil
from offwind_pin.analysis.updating.targets import DeflectionTarget, FrequencyTarget, ShapeTarget
from offwind_pin.base.errors import InputError, InterruptedSimulation, OffwindError, SolverError
from offwind_pin.definitions.reader import load_turbine, shipped_turbines
from offwind_pin.definitions.rotor_disc import rotor_disc
from offwind_pin.definitions.tuned_mass_damper import DampedAbsorber, den_hartog
from offwind_pin.definitions.turbine import Turbine
from offwind_pin.display.report.soil_folder import write_soil
from offwind_pin.dynamics.system import System
from offwind_pin.formats.urdf_folder import export_urdf
from offwind_pin.loads.earthquake.ground_motion import GroundMotion
from offwind_pin.loads.sea.current import (
    CurrentSum,
    CurrentTable,
    PowerLawCurrent,
    SurfaceCurrent,
    UniformCurrent,
)
from offwind_pin.loads.sea.irregular_waves import Crest, IrregularWaves
from offwind_pin.loads.sea.measured_waves import MeasuredWaves
from offwind_pin.loads.sea.sea import RegularWaves, StillWater, StreamWaves
from offwind_pin.loads.sea.waves.spectra import (
    JonswapSpectrum,
    TableSpectrum,
    TmaSpectrum,
    WhiteNoise,
)
from offwind_pin.loads.sea.waves.spreading import Spreading
from offwind_pin.loads.sea.waves.surface_record import SurfaceRecord
from offwind_pin.loads.tower_top.load_history import LoadHistory, read_load_history
from offwind_pin.loads.wind.profiles import ExtremeOperatingGust, LogLaw, PowerLaw, WindSeries
from offwind_pin.loads.wind.rotor_effective_wind import RotorWind
from offwind_pin.loads.wind.rotor_thrust import RotorThrust
from offwind_pin.loads.wind.synthetic_thrust import SyntheticWind
from offwind_pin.loads.wind.thrust_table import thrust_curve
from offwind_pin.loads.wind.tower_wind import TowerWind
from offwind_pin.signal.operational_modes.accelerations import Accelerations, read_accelerations
from offwind_pin.signal.operational_modes.cross_spectra import CrossSpectra, cross_spectral_matrix
from offwind_pin.signal.operational_modes.free_decay import FreeDecay, free_decay
from offwind_pin.signal.operational_modes.identify import OperationalModes, operational_modes
from offwind_pin.signal.operational_modes.modal_assurance import modal_assurance
from offwind_pin.solvers.steps import AdaptiveStep, FixedStep

__all__ = [
    "Accelerations",
    "AdaptiveStep",
    "Condensation",
    "Crest",
    "CrossSpectra",
    "CurrentSum",
    "CurrentTable",
    "DampedAbsorber",
    "DeflectionTarget",
    "ExtremeOperatingGust",
    "FixedStep",
    "FreeDecay",
    "FrequencyTarget",
    "GeneralizedAlpha",
    "GroundMotion",
    "Identification",
    "InputError",
    "InterruptedSimulation",
    "IrregularWaves",
    "JonswapSpectrum",
    "LoadHistory",
    "LogLaw",
    "MeasuredWaves",
    "ModalResult",
    "OffwindError",
    "OperationalModes",
    "Parameter",
    "PowerLaw",
    "PowerLawCurrent",
    "Pushover",
    "RegularWaves",
    "RotorThrust",
    "RotorWind",
    "SciPyIVP",
    "ShapeTarget",
    "SoilOverview",
    "SolverError",
    "Spreading",
    "StaticResult",
    "StillWater",
    "StreamWaves",
    "SurfaceCurrent",
    "SurfaceRecord",
    "SyntheticWind",
    "System",
    "TableSpectrum",
    "TmaSpectrum",
    "TowerWind",
    "Turbine",
    "UniformCurrent",
    "WhiteNoise",
    "WindSeries",
    "aerodynamic_damping",
    "build",
    "condense",
    "cross_spectral_matrix",
    "den_hartog",
    "equivalent_damping",
    "export_urdf",
    "free_decay",
    "identify_soil",
    "load_turbine",
    "modal_assurance",
    "modes",
    "operational_modes",
    "pile_only",
    "pushover",
    "read_accelerations",
    "read_load_history",
    "rotor_disc",
    "shipped_turbines",
    "simulate",
    "soil_overview",
    "static",
    "thrust_curve",
    "tower_drag",
    "write_soil",
]
