"""Summary of a turbine as read."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import asdict, dataclass
from typing import Any

from offwind_pin.analysis.build import build
from offwind_pin.analysis.foundation.registry import described_foundations
from offwind_pin.analysis.modal import modes
from offwind_pin.base.mode_labels import DAMPING_PARTS
from offwind_pin.cases.summary import summarise_modes
from offwind_pin.definitions.rotor_nacelle import lump_rna
from offwind_pin.definitions.tuned_mass_damper import TunedMassDamper
from offwind_pin.definitions.turbine import Member, Turbine
from offwind_pin.loads.sea.sea import StillWater
from offwind_pin.structure.section import lump

_SHOWN_MODES = ("FA1", "SS1", "FA2", "SS2", "T1")


@dataclass(frozen=True)
class MemberFacts:
    """Extent (m), sections (m) and mass (kg) of one member."""

    name: str
    bottom_m: float
    top_m: float
    bottom_diameter_m: float
    top_diameter_m: float
    thinnest_wall_m: float
    thickest_wall_m: float
    mass_kg: float


@dataclass(frozen=True)
class DamperFacts:
    """Place (m), mass (kg) and tuning of one tuned mass damper."""

    name: str
    z_m: float
    mass_kg: float
    direction: str
    frequency_hz: float
    damping_ratio: float


@dataclass(frozen=True)
class Overview:
    """Masses, lengths, frequencies and damping of a turbine.

    frequencies_hz, damping_ratios : by foundation and label; the second by part, see
        :func:`summarise_modes`
    """

    name: str
    description: str
    mudline_m: float
    toe_m: float
    yaw_bearing_m: float
    water_depth_m: float
    embedded_length_m: float
    members: list[MemberFacts]
    rna_mass_kg: float
    rna_center_of_mass_m: list[float]
    tuned_mass_dampers: list[DamperFacts]
    mass_above_mudline_kg: float
    frequencies_hz: dict[str, dict[str, float]]
    damping_ratios: dict[str, dict[str, dict[str, float | None]]]
    surrogate: str | None

    def as_dict(self) -> dict[str, Any]:
        return asdict(self)

    def tables(self) -> list[tuple[str, list[tuple[str, str]]]]:
        """Titles and rows for a person."""
        lengths = [
            ("yaw bearing", f"{self.yaw_bearing_m:+.2f} m"),
            ("mudline", f"{self.mudline_m:+.2f} m (water depth {self.water_depth_m:g} m)"),
            ("pile toe", f"{self.toe_m:+.2f} m ({self.embedded_length_m:g} m embedded)"),
        ]
        masses = [
            (
                member.name,
                f"{member.mass_kg:,.0f} kg, z {member.bottom_m:+.2f} to {member.top_m:+.2f} m, "
                f"D {member.bottom_diameter_m:g} to {member.top_diameter_m:g} m, "
                f"t {1e3 * member.thinnest_wall_m:g} to {1e3 * member.thickest_wall_m:g} mm",
            )
            for member in self.members
        ]
        x, y, z = (round(value, 3) + 0.0 for value in self.rna_center_of_mass_m)
        masses.append(
            ("rotor-nacelle", f"{self.rna_mass_kg:,.0f} kg, centre {x:.3f}, {y:.3f}, {z:.3f} m")
        )
        masses += [
            (
                damper.name,
                f"{damper.mass_kg:,.0f} kg, z {damper.z_m:+.2f} m, slides "
                f"{damper.direction.replace('_', '-')} at {damper.frequency_hz:.4g} Hz, "
                f"{100 * damper.damping_ratio:.3g} % of critical",
            )
            for damper in self.tuned_mass_dampers
        ]
        masses.append(("above the mudline", f"{self.mass_above_mudline_kg:,.0f} kg"))
        frequencies = [
            (case, ", ".join(f"{label} {value:.4f}" for label, value in found.items()))
            for case, found in self.frequencies_hz.items()
        ]
        return [
            (f"{self.name}: {self.description}", lengths),
            ("Masses", masses),
            ("Natural frequencies in Hz, about the static state under gravity", frequencies),
            (
                "Damping in % of critical: structure + soil + water + other (asked)",
                [(case, _damping_text(found)) for case, found in self.damping_ratios.items()],
            ),
        ]


def overview(turbine: Turbine) -> Overview:
    """Collect the main figures of a turbine; solves the modes on each foundation."""
    rna = lump_rna(turbine.rna)
    mudline = turbine.site.mudline
    springs = turbine.soil.distributed_springs
    found = _modes(turbine)
    return Overview(
        name=turbine.name,
        description=turbine.description,
        mudline_m=mudline,
        toe_m=turbine.toe,
        yaw_bearing_m=turbine.yaw_bearing,
        water_depth_m=-turbine.site.mudline,
        embedded_length_m=mudline - turbine.toe,
        members=[_member_facts(turbine, member) for member in turbine.members],
        rna_mass_kg=rna.mass,
        rna_center_of_mass_m=rna.center_of_mass.tolist(),
        tuned_mass_dampers=[_damper_facts(damper) for damper in turbine.tuned_mass_dampers],
        mass_above_mudline_kg=lump(turbine, mudline, turbine.yaw_bearing).mass
        + rna.mass
        + sum(damper.mass for damper in turbine.tuned_mass_dampers),
        frequencies_hz={
            case: {label: row["frequency_hz"] for label, row in rows.items()}
            for case, rows in found.items()
        },
        damping_ratios={
            case: {
                label: {name: row[name] for name in row if name.startswith("damping_ratio")}
                for label, row in rows.items()
            }
            for case, rows in found.items()
        },
        surrogate=springs.surrogate if springs else None,
    )


def _damper_facts(damper: TunedMassDamper) -> DamperFacts:
    omega = math.sqrt(damper.stiffness / damper.mass)
    return DamperFacts(
        name=damper.name,
        z_m=damper.z,
        mass_kg=damper.mass,
        direction={"both": "both ways"}.get(damper.direction, damper.direction),
        frequency_hz=omega / (2 * math.pi),
        damping_ratio=damper.damping / (2 * damper.mass * omega),
    )


def _member_facts(turbine: Turbine, member: Member) -> MemberFacts:
    walls = [station.thickness for station in member.stations]
    return MemberFacts(
        name=member.name,
        bottom_m=member.bottom,
        top_m=member.top,
        bottom_diameter_m=member.stations[0].diameter,
        top_diameter_m=member.stations[-1].diameter,
        thinnest_wall_m=min(walls),
        thickest_wall_m=max(walls),
        mass_kg=lump(turbine, member.bottom, member.top).mass,
    )


def _damping_text(found: Mapping[str, Mapping[str, float | None]]) -> str:
    texts = []
    for label, ratios in found.items():
        parts = [ratios[f"damping_ratio_{name}"] or 0.0 for name in DAMPING_PARTS]
        text = f"{label} {' + '.join(f'{100 * part:.2f}' for part in parts)}"
        asked = ratios["damping_ratio_asked"]
        texts.append(text if asked is None else f"{text} ({100 * asked:.3g})")
    return ", ".join(texts)


def _modes(turbine: Turbine) -> dict[str, dict[str, dict[str, Any]]]:
    """Shown modes by label, on every foundation that the turbine has the numbers for."""
    found = {}
    for foundation in described_foundations(turbine):
        sea = None if foundation == "clamped" else StillWater()
        system = build(turbine, foundation, sea)
        sliding = system.nv - system.chain.axis_joints
        result = modes(system, min(8 + sliding, system.nv))
        water = "in still water" if sea else "dry"
        rows = {row["label"]: row for row in summarise_modes(result)}
        found[f"{foundation}, {water}"] = {
            label: rows[label] for label in _SHOWN_MODES if label in rows
        }
    return found
