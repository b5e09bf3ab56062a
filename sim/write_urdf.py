"""Write the shipped turbine's URDF folders: clamped, and with its pile."""

from pathlib import Path

import offwind_pin as ow

ROOT = Path(__file__).resolve().parents[1] / "urdf"
FOUNDATIONS = ("clamped", "distributed_springs")


def main(root: Path = ROOT) -> list[Path]:
    """Write both folders; returns the files a person would open."""
    turbine = ow.load_turbine("oc6_phase2")
    written = []
    for foundation in FOUNDATIONS:
        system = ow.build(turbine, foundation)
        written += ow.export_urdf(system, root / f"{turbine.name}_{foundation}")
    return written


if __name__ == "__main__":
    for path in main():
        print(path)
