"""The pure-Python core of the benchmark against Pinocchio, on chains and on robots."""

import importlib
import json
import sys
from collections.abc import Callable
from dataclasses import dataclass, replace
from importlib import metadata
from pathlib import Path
from typing import Any

import numpy as np
import pinocchio as pin
import pytest
from helpers.numerics import relative_difference
from numpy.typing import NDArray

import offwind_pin as ow

# The benchmark is a folder of scripts; they find one another as they do when run.
sys.path.insert(0, str(Path(__file__).parents[2] / "benchmarks" / "pure_python"))
algorithms, kinematic_tree, slim_data, speedup, uniform_chain = (
    importlib.import_module(name)
    for name in ("algorithms", "kinematic_tree", "slim_data", "speedup", "uniform_chain")
)
sys.path.pop(0)

Array = NDArray[np.float64]

ROBOTS = {
    "ur5": ("ur_description/urdf/ur5_robot.urdf", None),
    "panda": ("panda_description/urdf/panda.urdf", None),
    "continuous pendulum": ("double_pendulum_description/urdf/double_pendulum_continuous.urdf", None),
    "pendulum on a ball": ("double_pendulum_description/urdf/double_pendulum.urdf", pin.JointModelSpherical),
    "kinova": ("kinova_description/robots/kinova.urdf", None),
    "anymal, floating": ("anymal_c_simple_description/urdf/anymal.urdf", pin.JointModelFreeFlyer),
    "solo12, floating": ("solo_description/robots/solo12.urdf", pin.JointModelFreeFlyer),
    "talos, floating": ("talos_data/robots/talos_reduced.urdf", pin.JointModelFreeFlyer),
    "romeo, floating": ("romeo_description/urdf/romeo_small.urdf", pin.JointModelFreeFlyer),
    "tiago": ("tiago_description/robots/tiago.urdf", None),
    "pr2": ("pr2_description/urdf/pr2.urdf", None),
    "icub": ("icub_description/robots/icub.urdf", None),
}  # fmt: skip
CHAINS = "clamped", "distributed_springs"


@dataclass(frozen=True)
class Case:
    """A model on both sides in a random state, with Pinocchio's results."""

    model: pin.Model
    tree: Any
    q: Array
    v: Array
    a: Array
    tau: Array  # rnea of q, v, a
    mass: Array  # crba of q
    tau_given: Array
    accelerations: Array  # aba of q, v, tau_given


def make_case(model: pin.Model, seed: int) -> Case:
    """A state whose angles and displacements lie within the limits and 1 of their middle."""
    rng, data = np.random.default_rng(seed), model.createData()
    pin.seed(seed)
    low = np.maximum(model.lowerPositionLimit, -1e3)
    high = np.minimum(model.upperPositionLimit, 1e3)
    middle, half = (low + high) / 2, np.minimum((high - low) / 2, 1.0)
    q = pin.randomConfiguration(model, middle - half, middle + half)
    v, a, other = rng.uniform(-1, 1, (3, model.nv))
    upper = np.triu(pin.crba(model, data, q))
    tau_given = pin.rnea(model, data, q, v, other).copy()
    return Case(
        model=model,
        tree=kinematic_tree.read_tree(model),
        q=q,
        v=v,
        a=a,
        tau=pin.rnea(model, data, q, v, a).copy(),
        mass=upper + np.triu(upper, 1).T,
        tau_given=tau_given,
        accelerations=pin.aba(model, data, q, v, tau_given).copy(),
    )


def urdf(path: str) -> str:
    """A file of example-robot-data."""
    robots = metadata.distribution("example-robot-data")
    return str(robots.locate_file(f"cmeel.prefix/share/example-robot-data/robots/{path}"))


def robot(name: str) -> pin.Model:
    """A robot of example-robot-data, on a floating or spherical root where one is named."""
    path, root = ROBOTS[name]
    return pin.buildModelFromUrdf(urdf(path), *([root()] if root else []))


def skew_arm() -> pin.Model:
    """Joints that no robot has: an unbounded one about a tilted axis, and free ones up the tree."""
    model = pin.buildModelFromXML(
        """<robot name="skew_arm"><link name="base"/><link name="first"/>
        <joint name="turning" type="continuous"><parent link="base"/><child link="first"/>
        <origin xyz="0.1 0.2 0.3" rpy="0.4 0.5 0.6"/><axis xyz="2 3 6"/></joint></robot>"""
    )
    rng = np.random.default_rng(5)
    joints = [
        pin.JointModelSpherical(),
        pin.JointModelPrismaticUnaligned(np.array([0.6, 0.0, 0.8])),
        pin.JointModelFreeFlyer(),
        pin.JointModelRUBY(),
    ]
    # Pinocchio's crba wants each branch whole before the next.
    for parent, joint in zip([1, 2, 3, 1], joints, strict=True):
        place = pin.SE3(pin.exp3(rng.uniform(-1, 1, 3)), rng.uniform(-1, 1, 3))
        index = model.addJoint(parent, joint, place, f"{joint.shortname()}_{parent}")
        body = pin.Inertia.FromEllipsoid(rng.uniform(1, 2), *rng.uniform(0.1, 0.5, 3))
        model.appendBodyToJoint(index, body, pin.SE3(np.eye(3), rng.uniform(-1, 1, 3)))
    return model


@pytest.fixture(scope="module", params=[*CHAINS, *ROBOTS, "skew arm"])
def model(undamped: ow.Turbine, request: pytest.FixtureRequest) -> pin.Model:
    if request.param in CHAINS:
        return ow.build(undamped, request.param, elements=20).pin_model
    return skew_arm() if request.param == "skew arm" else robot(request.param)


@pytest.fixture(params=[1, 2, 3])
def case(model: pin.Model, request: pytest.FixtureRequest) -> Case:
    return make_case(model, request.param)


def rnea_error(case: Case, tree: Any) -> float:
    return relative_difference(algorithms.rnea(tree, case.q, case.v, case.a), case.tau)


def crba_error(case: Case, tree: Any) -> float:
    return relative_difference(algorithms.crba(tree, case.q), case.mass)


def aba_error(case: Case, tree: Any) -> float:
    """Error of the accelerations in the joint forces that they need."""
    error = algorithms.aba(tree, case.q, case.v, case.tau_given) - case.accelerations
    return relative_difference(case.tau_given + case.mass @ error, case.tau_given)


def test_inverse_dynamics(case: Case) -> None:
    assert rnea_error(case, case.tree) < 1e-12


def test_mass_matrix(case: Case) -> None:
    assert crba_error(case, case.tree) < 1e-12


def test_forward_dynamics(case: Case) -> None:
    """The same forces; and accelerations as close as rounding in the forces lets any two be."""
    assert aba_error(case, case.tree) < 1e-12
    error = algorithms.aba(case.tree, case.q, case.v, case.tau_given) - case.accelerations
    rounding = 10 * np.finfo(float).eps * np.linalg.norm(case.tau_given)
    assert np.linalg.norm(error) < rounding / np.linalg.eigvalsh(case.mass)[0]


def test_forward_dynamics_inverts_inverse_dynamics(case: Case) -> None:
    accelerations = algorithms.aba(case.tree, case.q, case.v, case.tau)
    tau = algorithms.rnea(case.tree, case.q, case.v, accelerations)
    assert relative_difference(tau, case.tau) < 1e-12


def test_columns_of_the_mass_matrix(case: Case) -> None:
    """Column j is the joint force that a unit acceleration of freedom j needs."""
    rest = np.zeros(case.model.nv)
    weight = algorithms.rnea(case.tree, case.q, rest, rest)
    columns = [
        algorithms.rnea(case.tree, case.q, rest, unit) - weight for unit in np.eye(case.model.nv)
    ]
    assert relative_difference(algorithms.crba(case.tree, case.q), np.array(columns).T) < 1e-12


def test_mass_matrix_is_symmetric_positive_definite(case: Case) -> None:
    mass = algorithms.crba(case.tree, case.q)
    assert relative_difference(mass, mass.T) < 1e-15
    assert np.linalg.eigvalsh(mass)[0] > 0


def test_a_wrong_inertia_is_found(case: Case) -> None:
    """Negative control: the last body a thousandth too heavy."""
    *others, last = case.tree.bodies
    heavier = replace(case.tree, bodies=(*others, replace(last, inertia=1.001 * last.inertia)))
    assert rnea_error(case, heavier) > 1e-10
    assert crba_error(case, heavier) > 1e-10
    assert aba_error(case, heavier) > 1e-10


@pytest.mark.parametrize("product", ["cross_motion", "cross_force"])
def test_a_missing_velocity_product_is_found(
    case: Case, product: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Negative control: Coriolis and centrifugal, or gyroscopic terms left out."""
    monkeypatch.setattr(algorithms, product, lambda motion: np.zeros((6, 6)))
    assert rnea_error(case, case.tree) > 1e-10
    assert aba_error(case, case.tree) > 1e-10


def test_a_planar_joint_is_refused() -> None:
    model = pin.Model()
    model.addJoint(0, pin.JointModelPlanar(), pin.SE3.Identity(), "sled")
    with pytest.raises(ValueError, match=r"sled is a JointModelPlanar; use"):
        kinematic_tree.read_tree(model)


def test_rotor_inertia_is_refused() -> None:
    model = robot("ur5")
    model.armature = np.full(model.nv, 0.1)
    with pytest.raises(ValueError, match="rotor inertia"):
        kinematic_tree.read_tree(model)


def test_slim_data_changes_nothing(model: pin.Model) -> None:
    """To the last bit, in two states one after the other."""
    slim, whole = slim_data.slim_data(model), model.createData()
    for seed in 1, 2:
        case = make_case(model, seed)
        for run in pinocchio_calls(case):
            assert np.array_equal(run(slim), run(whole))


def pinocchio_calls(case: Case) -> list[Callable[[pin.Data], Array]]:
    """The calls that slim data is for."""
    model, q, v = case.model, case.q, case.v
    return [
        lambda data: pin.rnea(model, data, q, v, case.a).copy(),
        lambda data: pin.aba(model, data, q, v, case.tau_given).copy(),
        lambda data: pin.crba(model, data, q).copy(),
        lambda data: pin.crba(model, data, q, pin.Convention.WORLD).copy(),
    ]


def test_slim_data_is_refused_to_mimic_joints() -> None:
    """The gripper's second finger follows the first."""
    model = pin.buildModelFromUrdf(urdf("panda_description/urdf/panda.urdf"), mimic=True)
    with pytest.raises(ValueError, match=r"mimic joints; use model\.createData"):
        slim_data.slim_data(model)


def test_uniform_chain_is_jointed_as_the_package_s_own(undamped: ow.Turbine) -> None:
    own = ow.build(undamped, "distributed_springs", elements=9).pin_model
    uniform = uniform_chain.uniform_chain(9)
    assert [j.shortname() for j in uniform.joints] == [j.shortname() for j in own.joints]
    assert list(uniform.parents) == list(own.parents)
    loaded = [inertia.mass > 0 for inertia in uniform.inertias]
    assert loaded[1:] == [inertia.mass > 0 for inertia in own.inertias][1:]


def test_uniform_chain_is_one_tube() -> None:
    """Its mass, centre and inertia about the foot are those of the whole, however finely cut.

    With r the mid-surface radius and t the thickness: m = 2 pi r t rho L, about the foot across the
    axis m (r^2/2 + t^2/8 + L^2/3).
    """
    model = uniform_chain.uniform_chain(7)
    mass = pin.crba(model, model.createData(), np.zeros(model.nv))
    length, thickness = uniform_chain.LENGTH, uniform_chain.THICKNESS
    radius = (uniform_chain.DIAMETER - thickness) / 2
    whole = 2 * np.pi * radius * thickness * uniform_chain.DENSITY * length
    across = whole * (radius**2 / 2 + thickness**2 / 8 + length**2 / 3)
    assert np.allclose(np.diag(mass)[:3], whole, rtol=1e-12)
    assert np.allclose(np.diag(mass)[3:5], across, rtol=1e-12)
    assert np.isclose(mass[0, 4], whole * length / 2, rtol=1e-12)


def test_driver(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """One chain on each side of the limits: both agree, and what was run is written down.

    The limits are lowered, because one mass matrix of 489 freedoms takes seconds in pure Python.
    """
    monkeypatch.setattr(speedup, "LARGEST_OWN_CHAIN", 8)
    monkeypatch.setattr(speedup, "LARGEST_TENSORS", slim_data.tensor_bytes(77))
    out = tmp_path / "made" / "speedup.json"
    report = speedup.main(["--out", str(out), "--repeats", "1", "--elements", "8", "24"])
    assert json.loads(out.read_text()) == report
    small, large = report["rows"]
    assert (small["chain"], large["chain"]) == ("own", "uniform tube")
    assert (small["pinocchio_data"], large["pinocchio_data"]) == (
        "createData",
        "without second-order tensors",
    )
    assert (small["degrees_of_freedom"], large["degrees_of_freedom"]) == (30, 78)
    for row in small, large:
        assert list(row["algorithms"]) == ["rnea", "crba", "crba_world", "aba"]
        for result in row["algorithms"].values():
            assert result["relative_difference"] < 1e-12
            assert result["speed_up"] == result["pure_python_s"] / result["pinocchio_s"]


def test_driver_times_nothing_that_is_wrong() -> None:
    wrong = speedup.Pair(lambda: np.ones(3), lambda: np.array([1.0, 1.0, 1.0 + 2e-10]), np.copy)
    with pytest.raises(RuntimeError, match=r"rnea differs by 2\.0e-10"):
        speedup.race("rnea", wrong, 1)


def test_exponents_of_known_growth() -> None:
    """Seconds 2e-6 nv and 3e-9 nv^2."""
    rows = [
        {
            "degrees_of_freedom": nv,
            "algorithms": {"rnea": {"pure_python_s": 2e-6 * nv, "pinocchio_s": 3e-9 * nv**2}},
        }
        for nv in (36, 66, 126)
    ]
    fitted = speedup.exponents(rows)["rnea"]
    assert list(fitted["pure_python"].values()) == pytest.approx([1, 1])
    assert list(fitted["pinocchio"].values()) == pytest.approx([2, 2])
