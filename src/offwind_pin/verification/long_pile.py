"""A uniform pile in a uniform Winkler bed, with Hetenyi's solution."""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from offwind_pin.base.definition import Array
from offwind_pin.definitions.turbine import Turbine


@dataclass(frozen=True)
class LongPile:
    """A pile so long that its toe does not matter, with a short stub of a structure on it.

    Lengths in m, modulus of the bed in N/m2. Its weight is negligible, because the theory assumes
    no axial force.
    """

    length: float = 150.0
    diameter: float = 6.0
    thickness: float = 0.06
    modulus: float = 1e8
    youngs_modulus: float = 210e9

    @property
    def bending_stiffness(self) -> float:
        """EI in N m2."""
        inner = self.diameter - 2 * self.thickness
        return self.youngs_modulus * np.pi / 64 * (self.diameter**4 - inner**4)

    @property
    def inverse_length(self) -> float:
        """lambda = (k / 4 EI)^(1/4) in 1/m."""
        return float((self.modulus / (4 * self.bending_stiffness)) ** 0.25)

    def deflection(self, depth: Array, force: float, moment: float) -> Array:
        """y in m under a head force in N and a head moment in N m of the same sense.

        Hetenyi, Beams on Elastic Foundation (1946), Sec. 10: semi-infinite beam.
        """
        a, k = self.inverse_length, self.modulus
        x = a * depth
        decay = np.exp(-x)
        by_force = 2 * a / k * decay * np.cos(x)
        by_moment = 2 * a**2 / k * decay * (np.cos(x) - np.sin(x))
        return force * by_force + moment * by_moment

    def moment(self, depth: Array, force: float, moment: float) -> Array:
        """Bending moment in N m, with the sign of the head moment."""
        a = self.inverse_length
        x = a * depth
        decay = np.exp(-x)
        return force / a * decay * np.sin(x) + moment * decay * (np.cos(x) + np.sin(x))

    @property
    def stiffness(self) -> Array:
        """(2, 2) of the head for displacement and forward rotation, in N, m and rad."""
        a, k = self.inverse_length, self.modulus
        flexibility = np.array([[2 * a / k, 2 * a**2 / k], [2 * a**2 / k, 4 * a**3 / k]])
        return np.linalg.inv(flexibility)

    def turbine(self, nodes: int, curve: Mapping[str, object] | None = None) -> Turbine:
        """The pile with soil springs at a number of nodes; linear ones unless a curve is given."""
        water, stump = 20.0, 10.0
        linear = {"kind": "linear", "modulus_n_per_m2": {"at_mudline": self.modulus}}
        section = {"diameter_m": self.diameter, "thickness_m": self.thickness}
        return Turbine.model_validate(
            {
                "name": "long_pile",
                "site": {
                    "water_depth_m": water,
                    "water_density_kg_per_m3": 1025.0,
                    "gravity_m_per_s2": 1.0,
                },
                "materials": {
                    "light": {
                        "youngs_modulus_pa": self.youngs_modulus,
                        "shear_modulus_pa": 80e9,
                        "density_kg_per_m3": 100.0,
                    }
                },
                "members": [
                    {
                        "name": "monopile",
                        "material": "light",
                        "stations": [
                            {"z_m": -water - self.length, **section},
                            {"z_m": -water + stump, **section},
                        ],
                    }
                ],
                "rna": {
                    "kind": "rigid_body",
                    "mass_kg": 1.0,
                    "center_of_mass_m": [0, 0, 0],
                    "inertia_about_center_of_mass_kg_m2": [[1, 0, 0], [0, 1, 0], [0, 0, 1]],
                },
                "hydrodynamics": {"added_mass_coefficient": 1.0, "drag_coefficient": 1.0},
                "soil": {
                    "distributed_springs": {
                        "nodes": nodes,
                        "curve": curve or linear,
                        "toe_vertical_stiffness_n_per_m": 1e10,
                        "toe_torsional_stiffness_nm_per_rad": 1e11,
                    }
                },
            }
        )
