"""Elements that shear: what the files say is the system, and two integrators move it alike."""

import json
import xml.etree.ElementTree as ET
from pathlib import Path

import numpy as np
import pinocchio as pin
import pytest
from numpy.testing import assert_allclose
from numpy.typing import NDArray
from scipy.linalg import eigh

import offwind_pin as ow
from offwind_pin.analysis.integrators import GeneralizedAlpha, SciPyIVP
from offwind_pin.loads.tower_top.load_history import TowerTopLoad
from offwind_pin.solvers.steps import FixedStep
from offwind_pin.structure.section import shear_flexibility

Array = NDArray[np.float64]


@pytest.fixture(scope="module")
def clamped(oc6: ow.Turbine) -> ow.System:
    return ow.build(oc6, "clamped", elements=10, element="timoshenko")


@pytest.fixture(scope="module")
def files(clamped: ow.System, tmp_path_factory: pytest.TempPathFactory) -> tuple[Path, Path]:
    urdf, sidecar = ow.export_urdf(clamped, tmp_path_factory.mktemp("shear"))
    return urdf, sidecar


def test_joints_of_the_file(clamped: ow.System, files: tuple[Path, Path]) -> None:
    """A node is two prismatic joints along x and y, then three revolute ones, one above the other."""
    joints = [j for j in ET.parse(files[0]).getroot().findall("joint") if j.get("type") != "fixed"]
    assert len(joints) == 5 * clamped.chain.elements
    for node in range(clamped.chain.elements):
        five = joints[5 * node : 5 * node + 5]
        assert [j.get("type") for j in five] == ["prismatic"] * 2 + ["revolute"] * 3
        axes = [j.find("axis") for j in five]
        assert [a.get("xyz") for a in axes if a is not None] == [
            "1 0 0",
            "0 1 0",
            "1 0 0",
            "0 1 0",
            "0 0 1",
        ]


def test_sidecar_has_the_shear_springs(clamped: ow.System, files: tuple[Path, Path]) -> None:
    """kappa G A over the element's length in N/m, by joint name, for both directions."""
    sidecar = json.loads(files[1].read_text())
    chain = clamped.chain
    assert sidecar["node_joints"] == ["px", "py", "rx", "ry", "rz"]
    for name, low, high in zip(
        chain.joint_name[::5], chain.boundary[:-1], chain.boundary[1:], strict=True
    ):
        expected = 1 / shear_flexibility(clamped.turbine, low, high)
        for joint in ("px", "py"):
            stiffness = sidecar["joint_stiffness"][name.replace("px", joint)]
            assert stiffness == pytest.approx(expected, rel=1e-14)
            assert sidecar["joint_damping"][name.replace("px", joint)] > 0


def from_files(files: tuple[Path, Path]) -> tuple[pin.Model, Array, Array]:
    """Model, joint stiffness and joint damping, by nothing but the two files."""
    model = pin.buildModelFromUrdf(str(files[0]))
    sidecar = json.loads(files[1].read_text())
    springs, dampers = np.zeros((2, model.nv))
    for name in model.names[1:]:
        index = model.joints[model.getJointId(name)].idx_v
        springs[index] = sidecar["joint_stiffness"][name]
        dampers[index] = sidecar["joint_damping"][name]
    return model, springs, dampers


def test_round_trip(clamped: ow.System, files: tuple[Path, Path]) -> None:
    """Frequencies of the model read back, upright under gravity, are those of the system."""
    model, springs, dampers = from_files(files)
    model.gravity.linear = np.array([0.0, 0.0, -clamped.turbine.site.gravity])
    assert_allclose(springs, clamped.joint_stiffness, rtol=1e-15)
    assert_allclose(dampers, clamped.joint_damping, rtol=1e-15)
    rest = np.zeros(model.nv)
    data = model.createData()
    pin.computeRNEADerivatives(model, data, rest, rest, rest)
    stiffness = data.dtau_dq + np.diag(springs)
    upper = np.triu(pin.crba(model, data, rest))
    mass = upper + np.triu(upper, 1).T
    squares = eigh((stiffness + stiffness.T) / 2, mass, eigvals_only=True)
    equations = clamped.equations((), ramp_time=np.inf)
    ours = equations.tangents(0.0, rest, rest)[0]
    expected = eigh((ours + ours.T) / 2, equations.mass(rest), eigvals_only=True)
    assert_allclose(squares[:12], expected[:12], rtol=1e-8)


def test_lost_shear_springs_are_seen(clamped: ow.System, files: tuple[Path, Path]) -> None:
    """Negative control: with shear springs a tenth as stiff the second modes are elsewhere."""
    softer = clamped.joint_stiffness.copy()
    softer[0::5] /= 10
    softer[1::5] /= 10
    equations = clamped.equations((), ramp_time=np.inf)
    rest = np.zeros(clamped.nv)
    stiffness = equations.tangents(0.0, rest, rest)[0]
    change = np.diag(softer - clamped.joint_stiffness)
    mass = equations.mass(rest)
    squares = [
        eigh((k + k.T) / 2, mass, eigvals_only=True)[:6] for k in (stiffness, stiffness + change)
    ]
    assert np.abs(squares[1] / squares[0] - 1).max() > 0.05


END = 3.0


@pytest.fixture(scope="module")
def dry(oc6: ow.Turbine) -> ow.System:
    return ow.build(oc6, "clamped", elements=3, element="timoshenko")


def motion(system: ow.System, integrator: GeneralizedAlpha | SciPyIVP) -> list[Array]:
    """Mudline moment and tower-top displacement under a load that turns, both (t, 3)."""
    time = np.linspace(0, END, 3001)
    load = np.zeros((len(time), 6))
    load[:, 0] = 1e6 * (1 - np.cos(2 * np.pi * time / END))
    load[:, 1] = 5e5 * np.sin(2 * np.pi * time / END) ** 2
    load[:, 5] = 5e6 * np.sin(2 * np.pi * time / END) ** 2
    acting = TowerTopLoad(system.chain.top, ow.LoadHistory(time, load, "turning"), np.zeros(6))
    data = ow.simulate(system, END, loads=[acting], save_at=ow.SaveAt(0.1), integrator=integrator)
    assert data.attrs["element"] == "timoshenko"
    return [data[name].to_numpy() for name in ("mudline_moment", "tower_top_displacement")]


def test_integrators_agree(dry: ow.System) -> None:
    """The limit of generalised-alpha for dt -> 0 is Radau's motion on Pinocchio's equations."""
    exact = motion(dry, SciPyIVP("Radau", 1e-8, 1e-10))
    coarse, fine = (
        motion(dry, GeneralizedAlpha(FixedStep(dt), 0.9, 1e-11, 1e-12)) for dt in (0.02, 0.01)
    )
    for rough, close, truth in zip(coarse, fine, exact, strict=True):
        scale = np.abs(truth).max()
        errors = [np.abs(run - truth).max() / scale for run in (rough, close)]
        assert errors[1] < 1e-3
        assert errors[0] / errors[1] == pytest.approx(4.0, rel=0.1)
        assert np.abs(close + (close - rough) / 3 - truth).max() / scale < 0.1 * errors[1]
