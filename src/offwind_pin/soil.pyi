"""Foundations and soil: studies, condensation, identification."""

from offwind_pin.analysis.foundation.condensation import Condensation, condense
from offwind_pin.analysis.foundation.equivalent_damping import equivalent_damping
from offwind_pin.analysis.foundation.pile_only import pile_only
from offwind_pin.analysis.foundation.pushover import Pushover, pushover
from offwind_pin.analysis.foundation.study.study import SoilOverview, soil_overview
from offwind_pin.analysis.updating.identify_soil import Identification, Parameter, identify_soil
from offwind_pin.analysis.updating.targets import DeflectionTarget, FrequencyTarget, ShapeTarget
from offwind_pin.display.report.soil_folder import write_soil
from offwind_pin.loads.root_restraint import RootRestraint
from offwind_pin.loads.soil.foundation import Foundation

__all__ = [
    "Condensation",
    "DeflectionTarget",
    "Foundation",
    "FrequencyTarget",
    "Identification",
    "Parameter",
    "Pushover",
    "RootRestraint",
    "ShapeTarget",
    "SoilOverview",
    "condense",
    "equivalent_damping",
    "identify_soil",
    "pile_only",
    "pushover",
    "soil_overview",
    "write_soil",
]
