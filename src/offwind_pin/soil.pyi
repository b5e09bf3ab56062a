"""Foundations and soil: studies, condensation, identification."""

from offwind_pin.analysis.foundation.condensation import Condensation, condense
from offwind_pin.analysis.foundation.equivalent_damping import equivalent_damping
from offwind_pin.analysis.foundation.pile_only import pile_only
from offwind_pin.analysis.foundation.pushover import Pushover, pushover
from offwind_pin.analysis.foundation.registry import FoundationKind, register_foundation
from offwind_pin.analysis.foundation.study.study import SoilOverview, soil_overview
from offwind_pin.analysis.updating.identify_soil import Parameter, SoilIdentification, identify_soil
from offwind_pin.analysis.updating.targets import DeflectionTarget, FrequencyTarget, ShapeTarget
from offwind_pin.definitions.soil.layers import SoilLayer
from offwind_pin.display.report.soil_folder import write_soil
from offwind_pin.loads.root_restraint import RootRestraint
from offwind_pin.loads.soil.curves.family import SoilFamily, register_family
from offwind_pin.loads.soil.curves.soil_curve import SoilCurve
from offwind_pin.loads.soil.foundation import Foundation
from offwind_pin.loads.soil.soil_profile import PileNodes

__all__ = [
    "Condensation",
    "DeflectionTarget",
    "Foundation",
    "FoundationKind",
    "FrequencyTarget",
    "Parameter",
    "PileNodes",
    "Pushover",
    "RootRestraint",
    "ShapeTarget",
    "SoilCurve",
    "SoilFamily",
    "SoilIdentification",
    "SoilLayer",
    "SoilOverview",
    "condense",
    "equivalent_damping",
    "identify_soil",
    "pile_only",
    "pushover",
    "register_family",
    "register_foundation",
    "soil_overview",
    "write_soil",
]
