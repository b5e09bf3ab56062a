"""What a time history records: the records of the compiled code."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from offwind_pin.base.definition import Array
from offwind_pin.base.records import (
    Count,
    Counts,
    Counts2,
    Numbers,
    Numbers2,
    Numbers3,
    Record,
)
from offwind_pin.dynamics.compiled.model import Model
from offwind_pin.dynamics.system import System
from offwind_pin.loads.point_load import PointLoad
from offwind_pin.structure.chain import NDArrayInt
from offwind_pin.structure.section import lump

STATE_ENERGIES = ("kinetic", "gravitational", "elastic", "root")
"""First columns of the stored energies; one for each load follows."""

JOINT_DAMPERS, ROOT = 0, 1
"""First columns of the energies dissipated; one for each load follows."""

GROUND = 0
"""First column of the energies worked, by a moving ground; a void one and the loads' follow."""


class Cuts(Record):
    """Cuts of the chain at fixed heights: m cuts, each through one body.

    The piece between a cut and the upper end of its body is one round rigid body more.

    Attributes
    ----------
    height : (m,) in m
    body : (m,) that is cut
    offset : (m,) of the cut along it in m
    end : (m,) height at which that body ends in m, beyond everything for the last one
    piece : (m, 4) mass, centre along the body, transverse and axial inertia
    first : (m + 1,) where the points above each cut begin in the next array
    point : loaded points of a cut's own body that lie above it
    """

    height: Numbers
    body: Counts
    offset: Numbers
    end: Numbers
    piece: Numbers2
    first: Counts
    point: Counts


class Segments(Record):
    """Parts of the chain between two of its cuts each: g segments.

    Each is a list of round pieces, one for each body that it has part in, and of loaded points.

    Attributes
    ----------
    cut : (g, 2) lower and upper cut
    first_piece : (g + 1,) where each segment's pieces begin in the next two arrays
    body : body that a piece moves with
    piece : mass, centre along the body, transverse and axial inertia
    first_point : (g + 1,) where each segment's points begin in the next array
    point : loaded points above the lower and not above the upper cut
    """

    cut: Counts2
    first_piece: Counts
    body: Counts
    piece: Numbers2
    first_point: Counts
    point: Counts


class SoilNodes(Record):
    """Heights at which soil acts: n of them, each with one loaded point or more.

    Attributes
    ----------
    height : (n,) in m, rising
    point : (S,) loaded points of the soil
    node : (S,) height that each belongs to
    """

    height: Numbers
    point: Counts
    node: Counts


class Recorder(Record):
    """Room for T records at m cuts and g segments under L loads, and running sums.

    Attributes
    ----------
    cuts, segments, soil : what is recorded
    every : steps between records
    energies : (L,) addresses of the loads' kernels; 0 for a load that stores none
    commit, at_cuts : addresses of the kernels that end a step, 0 without memory, and that give
        motions and section loads
    each_step, each_record : addresses of the kernels that sum energies, and that write a record
    first_inertial : (m,) first of the points, in order of height, at which structural damping acts
        against the inertial frame above each cut
    end_inertial : the point after the last of them
    tally : (2,) steps taken, records made
    clock : (1,) time of the last step in s
    power, energy : (2, L + 2) dissipated and worked, at the last step in W and so far in J
    now : (2, L + 2) power of the step that is being noted
    time : (T,) in s
    displacement, acceleration : (T, m, 3) in m and m/s2
    section_load : (T, m, 6) in N and N m
    inertial_load : (T, m, 2) size of force and moment that such damping contributes; (T, 0, 2)
        without any
    imbalance : (T, g, 6) of the segments in N and N m
    soil_force : (T, n, 3) of the soil on the pile in N
    stroke : (T, D, 2) of the tuned mass dampers along x and y of their carriers in m
    stored : (T, L + 4) energies that the state holds in J, see :data:`STATE_ENERGIES`
    dissipated, worked : (T, L + 2) in J; see :data:`GROUND`
    iterations : (T,)
    residual : (T,) largest entry over the load scale
    """

    cuts: Cuts
    segments: Segments
    soil: SoilNodes
    every: Count
    energies: Counts
    commit: Count
    at_cuts: Count
    each_step: Counts
    each_record: Counts
    first_inertial: Counts
    end_inertial: Count
    tally: Counts
    clock: Numbers
    power: Numbers2
    energy: Numbers2
    now: Numbers2
    time: Numbers
    displacement: Numbers3
    acceleration: Numbers3
    section_load: Numbers3
    inertial_load: Numbers3
    imbalance: Numbers3
    soil_force: Numbers3
    stroke: Numbers3
    stored: Numbers2
    dissipated: Numbers2
    worked: Numbers2
    iterations: Counts
    residual: Numbers


def make_cuts(system: System, model: Model, height: Array) -> Cuts:
    """Cuts at heights (m,) in m, from the base to the yaw bearing."""
    chain = system.chain
    body = chain.body_at(height)
    ends = np.append(chain.joint_height, chain.top)[body]
    above = [
        np.flatnonzero((model.point_body == k) & _is_above(system, model, z))
        for k, z in zip(body, height, strict=True)
    ]
    return Cuts(
        height=height,
        body=body,
        offset=height - chain.origin[body],
        end=np.append(chain.joint_height, np.inf)[body],
        piece=_pieces(system, body, height, ends),
        first=_beginnings(above),
        point=np.concatenate([np.zeros(0, dtype=np.intp), *above]),
    )


def make_segments(
    system: System, model: Model, cuts: Cuts, ends: Sequence[tuple[float, float]]
) -> Segments:
    """Segments between pairs of cut heights in m, the lower first."""
    chain = system.chain
    edge = chain.cut
    bodies, pieces, points = [], [np.zeros((0, 4))], []
    for low, high in ends:
        inside = np.flatnonzero((edge[:-1] < high) & (edge[1:] > low))
        low_ends, high_ends = np.maximum(edge[inside], low), np.minimum(edge[inside + 1], high)
        bodies.append(inside)
        # A point mass at the yaw bearing lies above the cut there, as loads there do.
        pieces.append(_pieces(system, inside, low_ends, high_ends, with_end=False))
        points.append(
            np.flatnonzero(_is_above(system, model, low) & ~_is_above(system, model, high))
        )
    at = [[int(np.argmin(np.abs(cuts.height - z))) for z in pair] for pair in ends]
    none = np.zeros(0, dtype=np.intp)
    return Segments(
        cut=np.array(at, dtype=np.intp).reshape(-1, 2),
        first_piece=_beginnings(bodies),
        body=np.concatenate([none, *bodies]),
        piece=np.concatenate(pieces),
        first_point=_beginnings(points),
        point=np.concatenate([none, *points]),
    )


def make_soil_nodes(loads: Sequence[PointLoad]) -> SoilNodes:
    """Nodes of the soil among all the loads of a system."""
    first = _beginnings([np.arange(len(load.height)) for load in loads])
    points = [
        np.arange(begin, begin + len(load.height))
        for begin, load in zip(first[:-1], loads, strict=True)
        if _is_soil(load)
    ]
    heights = [load.height for load in loads if _is_soil(load)]
    height, node = np.unique(np.concatenate([np.zeros(0), *heights]), return_inverse=True)
    none = np.zeros(0, dtype=np.intp)
    return SoilNodes(height, np.concatenate([none, *points]), node.astype(np.intp))


def _is_soil(load: PointLoad) -> bool:
    return load.moves_with_ground and load.records_soil_force


def _is_above(system: System, model: Model, height: float) -> NDArray[np.bool_]:
    """(P,) whether each loaded point lies above a cut.

    A soil node at the cut belongs below it, whatever the last digit of its height; a load at the
    yaw bearing acts on the assembly above every cut.
    """
    return (model.point_height > height + 1e-9) | (model.point_height == system.chain.top)


def _pieces(
    system: System, body: NDArrayInt, low: Array, high: Array, *, with_end: bool = True
) -> Array:
    """(n, 4) mass, centre along the body, transverse and axial inertia of parts of bodies."""
    rows = []
    for k, bottom, top in zip(body, low, high, strict=True):
        piece = lump(system.turbine, bottom, top, with_end=with_end)
        center = piece.center - system.chain.origin[k]
        rows.append([piece.mass, center, piece.transverse, piece.axial])
    return np.array(rows).reshape(-1, 4)


def _beginnings(lists: Sequence[NDArrayInt]) -> NDArrayInt:
    return np.cumsum([0, *map(len, lists)], dtype=np.intp)


class Kernels(NamedTuple):
    """Addresses that a recorder needs, see :class:`Recorder`."""

    energies: NDArrayInt
    commit: int
    at_cuts: int
    each_step: NDArrayInt
    each_record: NDArrayInt


def inertial_points(
    system: System, model: Model, loads: Sequence[PointLoad], height: Array
) -> tuple[NDArrayInt, int]:
    """First point of inertial damping above each cut, and the point after the last.

    Parameters
    ----------
    loads : sequence of PointLoad
        All of a system, those of its structural damping side by side.
    height : (m,) array, m
        Of the cuts.
    """
    ours = [load in system.structural_loads for load in loads]
    points = np.flatnonzero(np.repeat(ours, np.diff(model.first_point)))
    if len(points) == 0:
        return np.zeros(len(height), dtype=np.intp), 0
    above = [int(np.sum(~_is_above(system, model, z)[points])) for z in height]
    return points[0] + np.array(above, dtype=np.intp), int(points[-1]) + 1


def make_recorder(
    model: Model,
    cuts: Cuts,
    segments: Segments,
    soil: SoilNodes,
    inertial: tuple[NDArrayInt, int],
    kernels: Kernels,
    every: int,
    records: int,
) -> Recorder:
    """An empty recorder for a number of records."""
    m, loads = len(cuts.height), len(model.forces)
    return Recorder(
        cuts=cuts,
        segments=segments,
        soil=soil,
        every=every,
        energies=kernels.energies,
        commit=kernels.commit,
        at_cuts=kernels.at_cuts,
        each_step=kernels.each_step,
        each_record=kernels.each_record,
        first_inertial=inertial[0],
        end_inertial=inertial[1],
        tally=np.zeros(2, dtype=np.intp),
        clock=np.zeros(1),
        power=np.zeros((2, loads + 2)),
        energy=np.zeros((2, loads + 2)),
        now=np.zeros((2, loads + 2)),
        time=np.zeros(records),
        displacement=np.zeros((records, m, 3)),
        acceleration=np.zeros((records, m, 3)),
        section_load=np.zeros((records, m, 6)),
        inertial_load=np.zeros((records, m if inertial[1] else 0, 2)),
        imbalance=np.zeros((records, len(segments.cut), 6)),
        soil_force=np.zeros((records, len(soil.height), 3)),
        stroke=np.zeros((records, len(model.tmd.body), 2)),
        stored=np.zeros((records, loads + len(STATE_ENERGIES))),
        dissipated=np.zeros((records, loads + 2)),
        worked=np.zeros((records, loads + 2)),
        iterations=np.zeros(records, dtype=np.intp),
        residual=np.zeros(records),
    )
