# SPDX-License-Identifier: MIT
# Made by geometry/bindings/generate.py of table.py. Change those.
"""Prototypes of the C library for ctypes, its constants and the classes of answers."""

import ctypes
from ctypes import c_char_p, c_double, c_int, c_size_t, c_ssize_t, c_void_p
from dataclasses import dataclass
from enum import IntEnum

import numpy as np
from numpy.typing import NDArray

from tangency._columns import Column, Columns


class Code(IntEnum):
    """What a call returns. Where it is not OK nothing was answered, and tangency_error_message()
    says why.
    """

    ok = 0
    bad_row = 1
    bad_argument = 2
    out_of_memory = 3
    internal = 4


class Number(IntEnum):
    """The type of the numbers of rows."""

    double = 0
    float = 1


class Form(IntEnum):
    """How a row gives an ellipsoid."""

    axes = 0
    shape = 1
    precision = 2
    vectors = 3
    quadric = 4


class PlaneForm(IntEnum):
    """How a row gives an ellipse."""

    direction = 0
    angle = 1
    shape = 2
    precision = 3
    conic = 4


class Relation(IntEnum):
    """How two solids lie, as point sets: exact for the numbers as they are given."""

    separate = 0
    external_touch = 1
    overlap = 2
    internal_touch = 3
    a_in_b = 4
    b_in_a = 5
    equal = 6


class Inner(IntEnum):
    """The body inside, where the relation is internal_touch."""

    none = 0
    a = 1
    b = 2


class Tier(IntEnum):
    """What knew the answer. Both give the same one."""

    filter = 0
    exact = 1


class Status(IntEnum):
    """What is known of a gap, distance or clearance."""

    ok = 0
    local = 1
    beyond = 2


class GapTier(IntEnum):
    """Which method gave the answer, the cheapest first."""

    fast = 0
    safeguarded = 1
    factored = 2
    search = 3
    exact = 4


class Definition(IntEnum):
    """Definitions of a gap other than the common normal's."""

    perram_wertheim = 0
    midpoint_potential = 1
    trace = 2


class OtherStatus(IntEnum):
    """What is known of an answer by another definition. Numbers are 0 unless ok."""

    ok = 0
    not_applicable = 1
    not_converged = 2


class DerivativeStatus(IntEnum):
    """Of what the derivatives are. They are 0 for tie and degenerate."""

    ok = 0
    local = 1
    tie = 2
    degenerate = 3


class VolumeStatus(IntEnum):
    """Whether the errors of a common volume are within the tolerance."""

    ok = 0
    tolerance_not_reached = 1


class RayStatus(IntEnum):
    """What a ray meets."""

    miss = 0
    hit = 1
    grazing = 2


class TimeStatus(IntEnum):
    """What is known of the first contact."""

    none = 0
    contact = 1
    touching_at_start = 2
    grazing = 3
    not_converged = 4


class NeighbourAnswers(IntEnum):
    """What is wanted of each pair of neighbours. Each adds to those before it."""

    pairs = 0
    overlaps = 1
    gaps = 2
    contacts = 3


class ChordStatus(IntEnum):
    """Whether the chord between two crossings is defined."""

    ok = 0
    not_applicable = 1


class QuadricType(IntEnum):
    """What a quadric is, exactly."""

    real_ellipsoid = 0
    imaginary_ellipsoid = 1
    hyperboloid_one_sheet = 2
    hyperboloid_two_sheets = 3
    elliptic_paraboloid = 4
    hyperbolic_paraboloid = 5
    real_elliptic_cone = 6
    imaginary_elliptic_cone = 7
    real_elliptic_cylinder = 8
    imaginary_elliptic_cylinder = 9
    hyperbolic_cylinder = 10
    parabolic_cylinder = 11
    real_intersecting_planes = 12
    imaginary_intersecting_planes = 13
    real_parallel_planes = 14
    imaginary_parallel_planes = 15
    coincident_planes = 16
    plane = 17
    no_points = 18
    all_space = 19


class AccuracyStruct(ctypes.Structure):
    _fields_ = [
        ("size", c_size_t),
        ("of_size", c_double),
        ("length", c_double),
        ("normals", c_int),
        ("has_cutoff", c_int),
        ("cutoff", c_double),
    ]


class ContactColumnsStruct(ctypes.Structure):
    _fields_ = [
        ("size", c_size_t),
        ("gap", c_void_p),
        ("gap_error", c_void_p),
        ("normal", c_void_p),
        ("arm_a", c_void_p),
        ("arm_b", c_void_p),
        ("status", c_void_p),
        ("tier", c_void_p),
        ("point", c_void_p),
        ("normal_bound", c_void_p),
        ("arm_a_bound", c_void_p),
        ("arm_b_bound", c_void_p),
    ]


class BoundedColumnsStruct(ctypes.Structure):
    _fields_ = [
        ("size", c_size_t),
        ("gap", c_void_p),
        ("gap_error", c_void_p),
        ("normal", c_void_p),
        ("arm_a", c_void_p),
        ("arm_b", c_void_p),
        ("status", c_void_p),
        ("tier", c_void_p),
        ("point", c_void_p),
        ("above", c_void_p),
    ]


class RelationColumnsStruct(ctypes.Structure):
    _fields_ = [
        ("size", c_size_t),
        ("relation", c_void_p),
        ("inner", c_void_p),
        ("tier", c_void_p),
    ]


class OtherGapColumnsStruct(ctypes.Structure):
    _fields_ = [
        ("size", c_size_t),
        ("gap", c_void_p),
        ("gap_error", c_void_p),
        ("normal", c_void_p),
        ("arm_a", c_void_p),
        ("arm_b", c_void_p),
        ("status", c_void_p),
    ]


class FactorColumnsStruct(ctypes.Structure):
    _fields_ = [
        ("size", c_size_t),
        ("factor", c_void_p),
        ("factor_error", c_void_p),
        ("scale", c_void_p),
        ("scale_error", c_void_p),
        ("status", c_void_p),
    ]


class DerivativeColumnsStruct(ctypes.Structure):
    _fields_ = [
        ("size", c_size_t),
        ("gradient", c_void_p),
        ("hessian", c_void_p),
        ("least_radius", c_void_p),
        ("status", c_void_p),
    ]


class CurvatureColumnsStruct(ctypes.Structure):
    _fields_ = [
        ("size", c_size_t),
        ("a", c_void_p),
        ("a_directions", c_void_p),
        ("b", c_void_p),
        ("b_directions", c_void_p),
        ("relative", c_void_p),
        ("relative_directions", c_void_p),
    ]


class VolumeColumnsStruct(ctypes.Structure):
    _fields_ = [
        ("size", c_size_t),
        ("volume", c_void_p),
        ("volume_error", c_void_p),
        ("gradient", c_void_p),
        ("gradient_error", c_void_p),
        ("status", c_void_p),
    ]


class ContainmentColumnsStruct(ctypes.Structure):
    _fields_ = [
        ("size", c_size_t),
        ("clearance", c_void_p),
        ("clearance_error", c_void_p),
        ("normal", c_void_p),
        ("arm_a", c_void_p),
        ("arm_b", c_void_p),
        ("status", c_void_p),
        ("margin", c_void_p),
        ("margin_error", c_void_p),
    ]


class WallColumnsStruct(ctypes.Structure):
    _fields_ = [
        ("size", c_size_t),
        ("gap", c_void_p),
        ("gap_error", c_void_p),
        ("normal", c_void_p),
        ("arm_body", c_void_p),
        ("arm_wall", c_void_p),
        ("status", c_void_p),
        ("relation", c_void_p),
        ("inner", c_void_p),
    ]


class PointColumnsStruct(ctypes.Structure):
    _fields_ = [
        ("size", c_size_t),
        ("distance", c_void_p),
        ("distance_error", c_void_p),
        ("normal", c_void_p),
        ("arm", c_void_p),
        ("status", c_void_p),
    ]


class RayColumnsStruct(ctypes.Structure):
    _fields_ = [
        ("size", c_size_t),
        ("status", c_void_p),
        ("count", c_void_p),
        ("t", c_void_p),
        ("arm", c_void_p),
        ("normal", c_void_p),
    ]


class TimeColumnsStruct(ctypes.Structure):
    _fields_ = [
        ("size", c_size_t),
        ("status", c_void_p),
        ("time", c_void_p),
        ("latest", c_void_p),
        ("resolution", c_void_p),
        ("normal", c_void_p),
    ]


class NeighbourQuestionStruct(ctypes.Structure):
    _fields_ = [
        ("size", c_size_t),
        ("reach", c_double),
        ("edges", c_void_p),
        ("periodic", c_void_p),
        ("answers", c_int),
        ("reserved", c_int),
    ]


class NeighbourColumnsStruct(ctypes.Structure):
    _fields_ = [
        ("size", c_size_t),
        ("pairs", c_void_p),
        ("images", c_void_p),
        ("overlaps", c_void_p),
        ("gap", c_void_p),
        ("gap_error", c_void_p),
        ("status", c_void_p),
        ("normal", c_void_p),
        ("arm_a", c_void_p),
        ("arm_b", c_void_p),
        ("separation", c_void_p),
    ]


class PlaneContactColumnsStruct(ctypes.Structure):
    _fields_ = [
        ("size", c_size_t),
        ("relation", c_void_p),
        ("inner", c_void_p),
        ("crossings", c_void_p),
        ("gap", c_void_p),
        ("gap_error", c_void_p),
        ("normal", c_void_p),
        ("arm_a", c_void_p),
        ("arm_b", c_void_p),
        ("status", c_void_p),
        ("area", c_void_p),
        ("crossing_arms", c_void_p),
        ("multiplicities", c_void_p),
        ("chord_status", c_void_p),
        ("chord_depth", c_void_p),
        ("chord_normal", c_void_p),
        ("chord_point", c_void_p),
        ("clearance", c_void_p),
        ("clearance_error", c_void_p),
        ("margin", c_void_p),
        ("margin_error", c_void_p),
    ]


class PlanePointColumnsStruct(ctypes.Structure):
    _fields_ = [
        ("size", c_size_t),
        ("distance", c_void_p),
        ("distance_error", c_void_p),
        ("normal", c_void_p),
        ("arm", c_void_p),
        ("status", c_void_p),
    ]


class QuadricColumnsStruct(ctypes.Structure):
    _fields_ = [
        ("size", c_size_t),
        ("type", c_void_p),
        ("rank4", c_void_p),
        ("rank3", c_void_p),
        ("tier", c_void_p),
    ]


@dataclass(init=False, repr=False, eq=False)
class Contacts(Columns):
    """Answers of contacts.

    Attributes
    ----------
    gap : ndarray of float64, shape (N,)
        > 0: the distance; < 0: minus the penetration depth (length)
    gap_error : ndarray of float64, shape (N,)
        proven: |gap - true gap| is at most this where the status is ok; where it is local the
        true gap is at least gap - gap_error (length)
    normal : ndarray of float64, shape (N, 3)
        unit, from A to B
    arm_a : ndarray of float64, shape (N, 3)
        A's witness point less A's centre (length)
    arm_b : ndarray of float64, shape (N, 3)
        B's witness point less B's centre (length)
    status : ndarray of int32, shape (N,)
        Values of Status.
    tier : ndarray of int32, shape (N,)
        Values of GapTier.
    point : ndarray of float64, shape (N, 3)
        the contact point, midway between the witness points, less A's centre (length)
    normal_bound : ndarray of float64, shape (N,)
        proven: of |normal - true normal|; 2 where nothing is
    arm_a_bound : ndarray of float64, shape (N,)
        proven: of |arm_a - true arm_a| (length)
    arm_b_bound : ndarray of float64, shape (N,)
        proven: of |arm_b - true arm_b| (length)
    """

    gap: NDArray[np.float64]
    gap_error: NDArray[np.float64]
    normal: NDArray[np.float64]
    arm_a: NDArray[np.float64]
    arm_b: NDArray[np.float64]
    status: NDArray[np.int32]
    tier: NDArray[np.int32]
    point: NDArray[np.float64]
    normal_bound: NDArray[np.float64]
    arm_a_bound: NDArray[np.float64]
    arm_b_bound: NDArray[np.float64]

    struct = ContactColumnsStruct
    fields = (
        Column("gap", "float64", (), None),
        Column("gap_error", "float64", (), None),
        Column("normal", "float64", (3,), None),
        Column("arm_a", "float64", (3,), None),
        Column("arm_b", "float64", (3,), None),
        Column("status", "int32", (), Status),
        Column("tier", "int32", (), GapTier),
        Column("point", "float64", (3,), None),
        Column("normal_bound", "float64", (), None),
        Column("arm_a_bound", "float64", (), None),
        Column("arm_b_bound", "float64", (), None),
    )


@dataclass(init=False, repr=False, eq=False)
class BoundedGaps(Columns):
    """Answers of bounded_gaps.

    Attributes
    ----------
    gap : ndarray of float64, shape (N,)
        > 0: the distance; < 0: minus the penetration depth (length)
    gap_error : ndarray of float64, shape (N,)
        proven: |gap - true gap| is at most this where the status is ok; where it is local the
        true gap is at least gap - gap_error (length)
    normal : ndarray of float64, shape (N, 3)
        unit, from A to B
    arm_a : ndarray of float64, shape (N, 3)
        A's witness point less A's centre (length)
    arm_b : ndarray of float64, shape (N, 3)
        B's witness point less B's centre (length)
    status : ndarray of int32, shape (N,)
        Values of Status.
    tier : ndarray of int32, shape (N,)
        Values of GapTier.
    point : ndarray of float64, shape (N, 3)
        the contact point, midway between the witness points, less A's centre (length)
    above : ndarray of float64, shape (N,)
        gap - gap_error <= true gap <= gap + above (length)
    """

    gap: NDArray[np.float64]
    gap_error: NDArray[np.float64]
    normal: NDArray[np.float64]
    arm_a: NDArray[np.float64]
    arm_b: NDArray[np.float64]
    status: NDArray[np.int32]
    tier: NDArray[np.int32]
    point: NDArray[np.float64]
    above: NDArray[np.float64]

    struct = BoundedColumnsStruct
    fields = (
        Column("gap", "float64", (), None),
        Column("gap_error", "float64", (), None),
        Column("normal", "float64", (3,), None),
        Column("arm_a", "float64", (3,), None),
        Column("arm_b", "float64", (3,), None),
        Column("status", "int32", (), Status),
        Column("tier", "int32", (), GapTier),
        Column("point", "float64", (3,), None),
        Column("above", "float64", (), None),
    )


@dataclass(init=False, repr=False, eq=False)
class Relations(Columns):
    """Answers of relations.

    Attributes
    ----------
    relation : ndarray of int32, shape (N,)
        Values of Relation.
    inner : ndarray of int32, shape (N,)
        Values of Inner.
    tier : ndarray of int32, shape (N,)
        Values of Tier.
    """

    relation: NDArray[np.int32]
    inner: NDArray[np.int32]
    tier: NDArray[np.int32]

    struct = RelationColumnsStruct
    fields = (
        Column("relation", "int32", (), Relation),
        Column("inner", "int32", (), Inner),
        Column("tier", "int32", (), Tier),
    )


@dataclass(init=False, repr=False, eq=False)
class OtherGaps(Columns):
    """Answers of other_gaps.

    Attributes
    ----------
    gap : ndarray of float64, shape (N,)
        > 0: the distance; < 0: minus the penetration depth (length)
    gap_error : ndarray of float64, shape (N,)
        proven: |gap - true gap| is at most this where the status is ok; where it is local the
        true gap is at least gap - gap_error (length)
    normal : ndarray of float64, shape (N, 3)
        unit, from A to B
    arm_a : ndarray of float64, shape (N, 3)
        A's witness point less A's centre (length)
    arm_b : ndarray of float64, shape (N, 3)
        B's witness point less B's centre (length)
    status : ndarray of int32, shape (N,)
        Values of OtherStatus.
    """

    gap: NDArray[np.float64]
    gap_error: NDArray[np.float64]
    normal: NDArray[np.float64]
    arm_a: NDArray[np.float64]
    arm_b: NDArray[np.float64]
    status: NDArray[np.int32]

    struct = OtherGapColumnsStruct
    fields = (
        Column("gap", "float64", (), None),
        Column("gap_error", "float64", (), None),
        Column("normal", "float64", (3,), None),
        Column("arm_a", "float64", (3,), None),
        Column("arm_b", "float64", (3,), None),
        Column("status", "int32", (), OtherStatus),
    )


@dataclass(init=False, repr=False, eq=False)
class Factors(Columns):
    """Answers of perram_wertheim_factors.

    Attributes
    ----------
    factor : ndarray of float64, shape (N,)
        F >= 0: > 1 apart, 1 touching, < 1 overlapping
    factor_error : ndarray of float64, shape (N,)
        proven: of |factor - F|
    scale : ndarray of float64, shape (N,)
        mu = sqrt F: both bodies, scaled by it about their centres, touch
    scale_error : ndarray of float64, shape (N,)
        proven: of |scale - mu|
    status : ndarray of int32, shape (N,)
        Values of OtherStatus.
    """

    factor: NDArray[np.float64]
    factor_error: NDArray[np.float64]
    scale: NDArray[np.float64]
    scale_error: NDArray[np.float64]
    status: NDArray[np.int32]

    struct = FactorColumnsStruct
    fields = (
        Column("factor", "float64", (), None),
        Column("factor_error", "float64", (), None),
        Column("scale", "float64", (), None),
        Column("scale_error", "float64", (), None),
        Column("status", "int32", (), OtherStatus),
    )


@dataclass(init=False, repr=False, eq=False)
class Derivatives(Columns):
    """Answers of gap_derivatives. Parameters, 18 in this order: centre, rotation vector in space
    (rad) and semi-axes of A, then of B.

    Attributes
    ----------
    gradient : ndarray of float64, shape (N, 18)
        first derivatives of the gap (length/parameter)
    hessian : ndarray of float64, shape (N, 18, 18)
        second derivatives, symmetric (length/parameter^2)
    least_radius : ndarray of float64, shape (N,)
        how sharp the best normal is (length)
    status : ndarray of int32, shape (N,)
        Values of DerivativeStatus.
    """

    gradient: NDArray[np.float64]
    hessian: NDArray[np.float64]
    least_radius: NDArray[np.float64]
    status: NDArray[np.int32]

    struct = DerivativeColumnsStruct
    fields = (
        Column("gradient", "float64", (18,), None),
        Column("hessian", "float64", (18, 18), None),
        Column("least_radius", "float64", (), None),
        Column("status", "int32", (), DerivativeStatus),
    )


@dataclass(init=False, repr=False, eq=False)
class Curvatures(Columns):
    """Answers of contact_curvatures: principal curvatures, the larger first, and their
    directions.

    Attributes
    ----------
    a : ndarray of float64, shape (N, 2)
        of A at its witness point (1/length)
    a_directions : ndarray of float64, shape (N, 2, 3)
        unit, tangent, in space
    b : ndarray of float64, shape (N, 2)
        of B at its witness point (1/length)
    b_directions : ndarray of float64, shape (N, 2, 3)
        unit, tangent, in space
    relative : ndarray of float64, shape (N, 2)
        of the distance between the surfaces: 1/R' and 1/R'' of Hertz theory (1/length)
    relative_directions : ndarray of float64, shape (N, 2, 3)
        unit, tangent, in space
    """

    a: NDArray[np.float64]
    a_directions: NDArray[np.float64]
    b: NDArray[np.float64]
    b_directions: NDArray[np.float64]
    relative: NDArray[np.float64]
    relative_directions: NDArray[np.float64]

    struct = CurvatureColumnsStruct
    fields = (
        Column("a", "float64", (2,), None),
        Column("a_directions", "float64", (2, 3), None),
        Column("b", "float64", (2,), None),
        Column("b_directions", "float64", (2, 3), None),
        Column("relative", "float64", (2,), None),
        Column("relative_directions", "float64", (2, 3), None),
    )


@dataclass(init=False, repr=False, eq=False)
class CommonVolumes(Columns):
    """Answers of common_volumes.

    Attributes
    ----------
    volume : ndarray of float64, shape (N,)
        of what both bodies have in common (length^3)
    volume_error : ndarray of float64, shape (N,)
        proven: of |volume - true volume| (length^3)
    gradient : ndarray of float64, shape (N, 3)
        of the volume by B's centre (length^2)
    gradient_error : ndarray of float64, shape (N,)
        proven: of |gradient - true gradient| (length^2)
    status : ndarray of int32, shape (N,)
        Values of VolumeStatus.
    """

    volume: NDArray[np.float64]
    volume_error: NDArray[np.float64]
    gradient: NDArray[np.float64]
    gradient_error: NDArray[np.float64]
    status: NDArray[np.int32]

    struct = VolumeColumnsStruct
    fields = (
        Column("volume", "float64", (), None),
        Column("volume_error", "float64", (), None),
        Column("gradient", "float64", (3,), None),
        Column("gradient_error", "float64", (), None),
        Column("status", "int32", (), VolumeStatus),
    )


@dataclass(init=False, repr=False, eq=False)
class Containments(Columns):
    """Answers of containments: how far A lies inside B.

    Attributes
    ----------
    clearance : ndarray of float64, shape (N,)
        > 0: the least distance of the boundaries; < 0: minus the length by which A sticks out
        (length)
    clearance_error : ndarray of float64, shape (N,)
        proven: of |clearance - true clearance| (length)
    normal : ndarray of float64, shape (N, 3)
        unit, outwards
    arm_a : ndarray of float64, shape (N, 3)
        witness point of A less A's centre (length)
    arm_b : ndarray of float64, shape (N, 3)
        witness point of B less B's centre (length)
    status : ndarray of int32, shape (N,)
        Values of Status.
    margin : ndarray of float64, shape (N,)
        the largest factor by which A, scaled about its centre, lies in B
    margin_error : ndarray of float64, shape (N,)
        proven: of |margin - true margin|
    """

    clearance: NDArray[np.float64]
    clearance_error: NDArray[np.float64]
    normal: NDArray[np.float64]
    arm_a: NDArray[np.float64]
    arm_b: NDArray[np.float64]
    status: NDArray[np.int32]
    margin: NDArray[np.float64]
    margin_error: NDArray[np.float64]

    struct = ContainmentColumnsStruct
    fields = (
        Column("clearance", "float64", (), None),
        Column("clearance_error", "float64", (), None),
        Column("normal", "float64", (3,), None),
        Column("arm_a", "float64", (3,), None),
        Column("arm_b", "float64", (3,), None),
        Column("status", "int32", (), Status),
        Column("margin", "float64", (), None),
        Column("margin_error", "float64", (), None),
    )


@dataclass(init=False, repr=False, eq=False)
class Walls(Columns):
    """Answers of walls.

    Attributes
    ----------
    gap : ndarray of float64, shape (N,)
        < 0 where the body reaches into the wall (length)
    gap_error : ndarray of float64, shape (N,)
        proven: of |gap - true gap| (length)
    normal : ndarray of float64, shape (N, 3)
        unit, from the body to the wall
    arm_body : ndarray of float64, shape (N, 3)
        the body's point nearest to the wall, less its centre (length)
    arm_wall : ndarray of float64, shape (N, 3)
        the wall's point opposite to it, less the body's centre (length)
    status : ndarray of int32, shape (N,)
        Values of Status.
    relation : ndarray of int32, shape (N,)
        Values of Relation.
    inner : ndarray of int32, shape (N,)
        Values of Inner.
    """

    gap: NDArray[np.float64]
    gap_error: NDArray[np.float64]
    normal: NDArray[np.float64]
    arm_body: NDArray[np.float64]
    arm_wall: NDArray[np.float64]
    status: NDArray[np.int32]
    relation: NDArray[np.int32]
    inner: NDArray[np.int32]

    struct = WallColumnsStruct
    fields = (
        Column("gap", "float64", (), None),
        Column("gap_error", "float64", (), None),
        Column("normal", "float64", (3,), None),
        Column("arm_body", "float64", (3,), None),
        Column("arm_wall", "float64", (3,), None),
        Column("status", "int32", (), Status),
        Column("relation", "int32", (), Relation),
        Column("inner", "int32", (), Inner),
    )


@dataclass(init=False, repr=False, eq=False)
class Points(Columns):
    """Answers of points.

    Attributes
    ----------
    distance : ndarray of float64, shape (N,)
        < 0 inside (length)
    distance_error : ndarray of float64, shape (N,)
        proven: of |distance - true distance| (length)
    normal : ndarray of float64, shape (N, 3)
        unit, outwards, at the closest point of the surface
    arm : ndarray of float64, shape (N, 3)
        closest point less the centre (length)
    status : ndarray of int32, shape (N,)
        Values of Status.
    """

    distance: NDArray[np.float64]
    distance_error: NDArray[np.float64]
    normal: NDArray[np.float64]
    arm: NDArray[np.float64]
    status: NDArray[np.int32]

    struct = PointColumnsStruct
    fields = (
        Column("distance", "float64", (), None),
        Column("distance_error", "float64", (), None),
        Column("normal", "float64", (3,), None),
        Column("arm", "float64", (3,), None),
        Column("status", "int32", (), Status),
    )


@dataclass(init=False, repr=False, eq=False)
class Rays(Columns):
    """Answers of rays.

    Attributes
    ----------
    status : ndarray of int32, shape (N,)
        Values of RayStatus.
    count : ndarray of int32, shape (N,)
        how many of the two points there are
    t : ndarray of float64, shape (N, 2)
        origin + t direction, ascending; 0 beyond count (length of the direction)
    arm : ndarray of float64, shape (N, 2, 3)
        the points less the body's centre (length)
    normal : ndarray of float64, shape (N, 2, 3)
        unit, outwards
    """

    status: NDArray[np.int32]
    count: NDArray[np.int32]
    t: NDArray[np.float64]
    arm: NDArray[np.float64]
    normal: NDArray[np.float64]

    struct = RayColumnsStruct
    fields = (
        Column("status", "int32", (), RayStatus),
        Column("count", "int32", (), None),
        Column("t", "float64", (2,), None),
        Column("arm", "float64", (2, 3), None),
        Column("normal", "float64", (2, 3), None),
    )


@dataclass(init=False, repr=False, eq=False)
class Times(Columns):
    """Answers of times_of_contact.

    Attributes
    ----------
    status : ndarray of int32, shape (N,)
        Values of TimeStatus.
    time : ndarray of float64, shape (N,)
        never after the first contact; the horizon for none (time)
    latest : ndarray of float64, shape (N,)
        for contact: the first contact is no later (time)
    resolution : ndarray of float64, shape (N,)
        the gap below which rounding hides whether there is one (length)
    normal : ndarray of float64, shape (N, 3)
        unit, from A to B, near `time`; 0 for none and touching_at_start
    """

    status: NDArray[np.int32]
    time: NDArray[np.float64]
    latest: NDArray[np.float64]
    resolution: NDArray[np.float64]
    normal: NDArray[np.float64]

    struct = TimeColumnsStruct
    fields = (
        Column("status", "int32", (), TimeStatus),
        Column("time", "float64", (), None),
        Column("latest", "float64", (), None),
        Column("resolution", "float64", (), None),
        Column("normal", "float64", (3,), None),
    )


@dataclass(init=False, repr=False, eq=False)
class Neighbours(Columns):
    """What neighbours_columns shows, NULL where it was not asked for, as is what this version
    does not know. Valid until the list is destroyed.

    Attributes
    ----------
    pairs : ndarray of uint32, shape (N, 2)
        body a <= body b
    images : ndarray of int32, shape (N, 3)
        b is moved by so many of each edge
    overlaps : ndarray of uint8, shape (N,)
        1 where the interiors meet
    gap : ndarray of float64, shape (N,)
        as of contacts (length)
    gap_error : ndarray of float64, shape (N,)
        as of contacts (length)
    status : ndarray of int32, shape (N,)
        Values of Status.
    normal : ndarray of float64, shape (N, 3)
        unit, from a to the image of b
    arm_a : ndarray of float64, shape (N, 3)
        a's witness point less a's centre (length)
    arm_b : ndarray of float64, shape (N, 3)
        the witness point of b's image less its centre (length)
    separation : ndarray of float64, shape (N, 3)
        from a's centre to that of b's image, rounded (length)
    """

    pairs: NDArray[np.uint32]
    images: NDArray[np.int32]
    overlaps: NDArray[np.uint8]
    gap: NDArray[np.float64]
    gap_error: NDArray[np.float64]
    status: NDArray[np.int32]
    normal: NDArray[np.float64]
    arm_a: NDArray[np.float64]
    arm_b: NDArray[np.float64]
    separation: NDArray[np.float64]

    struct = NeighbourColumnsStruct
    fields = (
        Column("pairs", "uint32", (2,), None),
        Column("images", "int32", (3,), None),
        Column("overlaps", "uint8", (), None),
        Column("gap", "float64", (), None),
        Column("gap_error", "float64", (), None),
        Column("status", "int32", (), Status),
        Column("normal", "float64", (3,), None),
        Column("arm_a", "float64", (3,), None),
        Column("arm_b", "float64", (3,), None),
        Column("separation", "float64", (3,), None),
    )


@dataclass(init=False, repr=False, eq=False)
class PlaneContacts(Columns):
    """Answers of plane_contacts.

    Attributes
    ----------
    relation : ndarray of int32, shape (N,)
        Values of Relation.
    inner : ndarray of int32, shape (N,)
        Values of Inner.
    crossings : ndarray of int32, shape (N,)
        points where the boundaries meet, exact; -1 where they are equal
    gap : ndarray of float64, shape (N,)
        > 0: the distance; < 0: minus the penetration depth (length)
    gap_error : ndarray of float64, shape (N,)
        as of contacts (length)
    normal : ndarray of float64, shape (N, 2)
        unit, from A to B
    arm_a : ndarray of float64, shape (N, 2)
        A's witness point less A's centre (length)
    arm_b : ndarray of float64, shape (N, 2)
        B's witness point less B's centre (length)
    status : ndarray of int32, shape (N,)
        Values of Status.
    area : ndarray of float64, shape (N,)
        of what both ellipses have in common (length^2)
    crossing_arms : ndarray of float64, shape (N, 4, 2)
        the crossings less A's centre; 0 beyond their number (length)
    multiplicities : ndarray of int32, shape (N, 4)
        of the crossings, and 0 beyond their number
    chord_status : ndarray of int32, shape (N,)
        Values of ChordStatus.
    chord_depth : ndarray of float64, shape (N,)
        of the published plane scheme (length)
    chord_normal : ndarray of float64, shape (N, 2)
        unit, across the chord
    chord_point : ndarray of float64, shape (N, 2)
        contact point less A's centre (length)
    clearance : ndarray of float64, shape (N,)
        how far A lies inside B, as of containments (length)
    clearance_error : ndarray of float64, shape (N,)
        proven: of |clearance - true clearance| (length)
    margin : ndarray of float64, shape (N,)
        as of containments
    margin_error : ndarray of float64, shape (N,)
        proven: of |margin - true margin|
    """

    relation: NDArray[np.int32]
    inner: NDArray[np.int32]
    crossings: NDArray[np.int32]
    gap: NDArray[np.float64]
    gap_error: NDArray[np.float64]
    normal: NDArray[np.float64]
    arm_a: NDArray[np.float64]
    arm_b: NDArray[np.float64]
    status: NDArray[np.int32]
    area: NDArray[np.float64]
    crossing_arms: NDArray[np.float64]
    multiplicities: NDArray[np.int32]
    chord_status: NDArray[np.int32]
    chord_depth: NDArray[np.float64]
    chord_normal: NDArray[np.float64]
    chord_point: NDArray[np.float64]
    clearance: NDArray[np.float64]
    clearance_error: NDArray[np.float64]
    margin: NDArray[np.float64]
    margin_error: NDArray[np.float64]

    struct = PlaneContactColumnsStruct
    fields = (
        Column("relation", "int32", (), Relation),
        Column("inner", "int32", (), Inner),
        Column("crossings", "int32", (), None),
        Column("gap", "float64", (), None),
        Column("gap_error", "float64", (), None),
        Column("normal", "float64", (2,), None),
        Column("arm_a", "float64", (2,), None),
        Column("arm_b", "float64", (2,), None),
        Column("status", "int32", (), Status),
        Column("area", "float64", (), None),
        Column("crossing_arms", "float64", (4, 2), None),
        Column("multiplicities", "int32", (4,), None),
        Column("chord_status", "int32", (), ChordStatus),
        Column("chord_depth", "float64", (), None),
        Column("chord_normal", "float64", (2,), None),
        Column("chord_point", "float64", (2,), None),
        Column("clearance", "float64", (), None),
        Column("clearance_error", "float64", (), None),
        Column("margin", "float64", (), None),
        Column("margin_error", "float64", (), None),
    )


@dataclass(init=False, repr=False, eq=False)
class PlanePoints(Columns):
    """Answers of plane_points.

    Attributes
    ----------
    distance : ndarray of float64, shape (N,)
        < 0 inside (length)
    distance_error : ndarray of float64, shape (N,)
        proven: of |distance - true distance| (length)
    normal : ndarray of float64, shape (N, 2)
        unit, outwards, at the closest point of the boundary
    arm : ndarray of float64, shape (N, 2)
        closest point less the centre (length)
    status : ndarray of int32, shape (N,)
        Values of Status.
    """

    distance: NDArray[np.float64]
    distance_error: NDArray[np.float64]
    normal: NDArray[np.float64]
    arm: NDArray[np.float64]
    status: NDArray[np.int32]

    struct = PlanePointColumnsStruct
    fields = (
        Column("distance", "float64", (), None),
        Column("distance_error", "float64", (), None),
        Column("normal", "float64", (2,), None),
        Column("arm", "float64", (2,), None),
        Column("status", "int32", (), Status),
    )


@dataclass(init=False, repr=False, eq=False)
class Quadrics(Columns):
    """Answers of classify.

    Attributes
    ----------
    type : ndarray of int32, shape (N,)
        Values of QuadricType.
    rank4 : ndarray of int32, shape (N,)
        rank of the discriminant matrix
    rank3 : ndarray of int32, shape (N,)
        rank of its upper-left 3 x 3 block
    tier : ndarray of int32, shape (N,)
        Values of Tier.
    """

    type: NDArray[np.int32]
    rank4: NDArray[np.int32]
    rank3: NDArray[np.int32]
    tier: NDArray[np.int32]

    struct = QuadricColumnsStruct
    fields = (
        Column("type", "int32", (), QuadricType),
        Column("rank4", "int32", (), None),
        Column("rank3", "int32", (), None),
        Column("tier", "int32", (), Tier),
    )


FUNCTIONS = {
    "version": (c_char_p, []),
    "instruction_set": (c_char_p, []),
    "error_message": (c_char_p, []),
    "error_row": (c_size_t, []),
    "name_of": (c_char_p, [c_char_p, c_int]),
    "level_of_confidence": (c_int, [c_double, c_int, c_void_p]),
    "bodies_create": (c_int, [c_void_p, c_int, c_void_p, c_int, c_size_t, c_ssize_t, c_double]),
    "bodies_append": (c_int, [c_void_p, c_int, c_void_p, c_int, c_size_t, c_ssize_t, c_double]),
    "bodies_set": (c_int, [c_void_p, c_size_t, c_void_p, c_int, c_size_t, c_ssize_t]),
    "bodies_count": (c_size_t, [c_void_p]),
    "bodies_destroy": (None, [c_void_p]),
    "contacts": (c_int, [c_void_p, c_void_p, c_size_t, c_void_p, c_void_p, c_void_p, c_void_p,
        c_int]),
    "contacts_of_rows": (c_int, [c_void_p, c_ssize_t, c_void_p, c_ssize_t, c_size_t, c_void_p,
        c_void_p, c_int]),
    "bounded_gaps": (c_int, [c_void_p, c_void_p, c_size_t, c_void_p, c_void_p, c_void_p, c_int]),
    "overlaps": (c_int, [c_void_p, c_void_p, c_size_t, c_void_p, c_void_p, c_int]),
    "overlaps_by_filter": (c_int, [c_void_p, c_void_p, c_size_t, c_void_p, c_void_p, c_int]),
    "relations": (c_int, [c_void_p, c_void_p, c_size_t, c_void_p, c_void_p, c_int]),
    "other_gaps": (c_int, [c_void_p, c_void_p, c_size_t, c_void_p, c_int, c_void_p, c_int]),
    "perram_wertheim_factors": (c_int, [c_void_p, c_void_p, c_size_t, c_void_p, c_void_p, c_int]),
    "gap_derivatives": (c_int, [c_void_p, c_void_p, c_size_t, c_void_p, c_void_p, c_void_p,
        c_void_p, c_int]),
    "contact_curvatures": (c_int, [c_void_p, c_void_p, c_size_t, c_void_p, c_void_p, c_int]),
    "common_volumes": (c_int, [c_void_p, c_void_p, c_size_t, c_void_p, c_double, c_void_p,
        c_int]),
    "containments": (c_int, [c_void_p, c_void_p, c_size_t, c_void_p, c_void_p, c_int]),
    "times_of_contact": (c_int, [c_void_p, c_void_p, c_size_t, c_void_p, c_void_p, c_double,
        c_double, c_void_p, c_int]),
    "walls": (c_int, [c_void_p, c_void_p, c_size_t, c_int, c_void_p, c_size_t, c_void_p, c_int]),
    "points": (c_int, [c_void_p, c_void_p, c_size_t, c_void_p, c_size_t, c_void_p, c_int]),
    "balls": (c_int, [c_void_p, c_void_p, c_size_t, c_void_p, c_size_t, c_void_p, c_int]),
    "rays": (c_int, [c_void_p, c_void_p, c_size_t, c_void_p, c_size_t, c_void_p, c_int]),
    "neighbours_create": (c_int, [c_void_p, c_void_p, c_void_p, c_void_p, c_int]),
    "neighbours_count": (c_size_t, [c_void_p]),
    "neighbours_columns": (c_int, [c_void_p, c_void_p]),
    "neighbours_destroy": (None, [c_void_p]),
    "ellipses_create": (c_int, [c_void_p, c_int, c_void_p, c_int, c_size_t, c_ssize_t, c_double]),
    "ellipses_append": (c_int, [c_void_p, c_int, c_void_p, c_int, c_size_t, c_ssize_t, c_double]),
    "ellipses_count": (c_size_t, [c_void_p]),
    "ellipses_destroy": (None, [c_void_p]),
    "plane_contacts": (c_int, [c_void_p, c_void_p, c_size_t, c_void_p, c_int]),
    "plane_points": (c_int, [c_void_p, c_void_p, c_size_t, c_void_p, c_size_t, c_void_p, c_int]),
    "classify": (c_int, [c_void_p, c_size_t, c_ssize_t, c_void_p, c_int]),
}
