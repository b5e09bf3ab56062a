"""Export of a system for other programs: URDF, meshes and a sidecar file."""

from __future__ import annotations

from pathlib import Path

from offwind_pin.base.whole_files import whole_file, write_json, write_text
from offwind_pin.dynamics.system import System
from offwind_pin.structure.urdf import urdf_text, write_meshes, write_sidecar


def export_urdf(system: System, out: Path) -> list[Path]:
    """Write ``NAME.urdf``, ``NAME.json`` and ``meshes/`` to a folder.

    Parameters
    ----------
    system : System
    out : Path
        Folder, created if necessary.

    Returns
    -------
    list of Path
        Paths of the first two.
    """
    turbine, chain = system.turbine, system.chain
    for name, content in write_meshes(turbine, chain).items():
        with whole_file(out / "meshes" / name) as temporary:
            temporary.write_bytes(content)
    urdf, sidecar = out / f"{turbine.name}.urdf", out / f"{turbine.name}.json"
    write_text(urdf, urdf_text(turbine, chain))
    of_nodes = system.joint_damping[chain.roots : chain.axis_joints]
    damping = of_nodes.reshape(chain.joint_stiffness.shape)
    described = write_sidecar(turbine, chain, damping, system.foundation.describe())
    if system.structural_loads:
        described["inertial_damping"] = [load.describe() for load in system.structural_loads]
    write_json(sidecar, described)
    return [urdf, sidecar]
