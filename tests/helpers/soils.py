"""The benchmark's pile in other grounds than its own."""

import offwind_pin as ow
from offwind_pin.definitions.soil.springs import DistributedSprings, Hysteresis


def with_springs(turbine: ow.Turbine, springs: DistributedSprings) -> ow.Turbine:
    """The same turbine on other distributed springs."""
    soil = turbine.soil.model_copy(update={"distributed_springs": springs})
    return turbine.model_copy(update={"soil": soil})


def layered(turbine: ow.Turbine, nodes: int = 61) -> ow.Turbine:
    """Clay, sand and clay by PISA and API, with moments, base, shaft and toe springs, and dashpots."""
    springs = DistributedSprings.model_validate(
        {
            "nodes": nodes,
            "curve": {
                "kind": "layers",
                "loading": "static",
                "layers": [
                    {
                        "top_m": 0.0,
                        "model": "pisa",
                        "calibration": "cowden_till",
                        "submerged_unit_weight_n_per_m3": 1.1e4,
                        "undrained_shear_strength_pa": {
                            "depth_m": [0, 11],
                            "values": [80e3, 140e3],
                        },
                        "shear_modulus_pa": {"depth_m": [0, 11], "values": [20e6, 200e6]},
                    },
                    {
                        "top_m": 11.0,
                        "model": "pisa",
                        "calibration": "general_dunkirk_sand",
                        "submerged_unit_weight_n_per_m3": 1.0e4,
                        "relative_density": 0.75,
                        "shear_modulus_pa": {"depth_m": [0, 45], "values": [30e6, 150e6]},
                    },
                    {
                        "top_m": 20.0,
                        "model": "api_sand",
                        "submerged_unit_weight_n_per_m3": 1.0e4,
                        "friction_angle_deg": 35.0,
                    },
                    {
                        "top_m": 30.0,
                        "model": "pisa",
                        "calibration": "cowden_till",
                        "submerged_unit_weight_n_per_m3": 1.1e4,
                        "undrained_shear_strength_pa": 200e3,
                        "shear_modulus_pa": 250e6,
                    },
                ],
            },
            "vertical": {
                "kind": "api",
                "soil": "clay",
                "skin_friction_pa": 8e4,
                "residual_ratio": 0.8,
            },
            "torsional": {
                "kind": "tanh",
                "initial_stiffness_nm_per_m_per_rad": 8e9,
                "ultimate_torque_nm_per_m": 1e7,
            },
            "toe_bearing": {"kind": "api", "end_bearing_pa": 5e6, "area_m2": 3.0},
            "dashpot": {
                "damping_factor": {
                    "displacement_m": [1e-4, 1e-2, 1e-1],
                    "factor": [0.01, 0.05, 0.2],
                },
                "load_frequency_hz": 0.24,
            },
        }
    )
    return with_springs(turbine, springs)


def hysteretic(turbine: ow.Turbine, sliders: int = 20) -> ow.Turbine:
    """The turbine's own springs as sliders, without dashpots."""
    springs = turbine.soil.distributed_springs
    assert springs is not None
    update = {"dashpot": None, "hysteretic": Hysteresis(sliders=sliders)}
    return with_springs(turbine, springs.model_copy(update=update))
