# SPDX-License-Identifier: MIT
# Made by geometry/bindings/generate.py of table.py. Change those.
import ctypes
from dataclasses import dataclass
from enum import IntEnum
from typing import Any

import numpy as np
from numpy.typing import NDArray

from tangency._columns import Columns

class Code(IntEnum):
    ok = 0
    bad_row = 1
    bad_argument = 2
    out_of_memory = 3
    internal = 4

class Number(IntEnum):
    double = 0
    float = 1

class Form(IntEnum):
    axes = 0
    shape = 1
    precision = 2
    vectors = 3
    quadric = 4

class PlaneForm(IntEnum):
    direction = 0
    angle = 1
    shape = 2
    precision = 3
    conic = 4

class Relation(IntEnum):
    separate = 0
    external_touch = 1
    overlap = 2
    internal_touch = 3
    a_in_b = 4
    b_in_a = 5
    equal = 6

class Inner(IntEnum):
    none = 0
    a = 1
    b = 2

class Tier(IntEnum):
    filter = 0
    exact = 1

class Status(IntEnum):
    ok = 0
    local = 1
    beyond = 2

class GapTier(IntEnum):
    fast = 0
    safeguarded = 1
    factored = 2
    search = 3
    exact = 4

class Definition(IntEnum):
    perram_wertheim = 0
    midpoint_potential = 1
    trace = 2

class OtherStatus(IntEnum):
    ok = 0
    not_applicable = 1
    not_converged = 2

class DerivativeStatus(IntEnum):
    ok = 0
    local = 1
    tie = 2
    degenerate = 3

class VolumeStatus(IntEnum):
    ok = 0
    tolerance_not_reached = 1

class RayStatus(IntEnum):
    miss = 0
    hit = 1
    grazing = 2

class TimeStatus(IntEnum):
    none = 0
    contact = 1
    touching_at_start = 2
    grazing = 3
    not_converged = 4

class NeighbourAnswers(IntEnum):
    pairs = 0
    overlaps = 1
    gaps = 2
    contacts = 3

class ChordStatus(IntEnum):
    ok = 0
    not_applicable = 1

class QuadricType(IntEnum):
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
    size: int
    of_size: float
    length: float
    normals: int
    has_cutoff: int
    cutoff: float

class ContactColumnsStruct(ctypes.Structure):
    size: int
    gap: int | None
    gap_error: int | None
    normal: int | None
    arm_a: int | None
    arm_b: int | None
    status: int | None
    tier: int | None
    point: int | None
    normal_bound: int | None
    arm_a_bound: int | None
    arm_b_bound: int | None

class BoundedColumnsStruct(ctypes.Structure):
    size: int
    gap: int | None
    gap_error: int | None
    normal: int | None
    arm_a: int | None
    arm_b: int | None
    status: int | None
    tier: int | None
    point: int | None
    above: int | None

class RelationColumnsStruct(ctypes.Structure):
    size: int
    relation: int | None
    inner: int | None
    tier: int | None

class OtherGapColumnsStruct(ctypes.Structure):
    size: int
    gap: int | None
    gap_error: int | None
    normal: int | None
    arm_a: int | None
    arm_b: int | None
    status: int | None

class FactorColumnsStruct(ctypes.Structure):
    size: int
    factor: int | None
    factor_error: int | None
    scale: int | None
    scale_error: int | None
    status: int | None

class DerivativeColumnsStruct(ctypes.Structure):
    size: int
    gradient: int | None
    hessian: int | None
    least_radius: int | None
    status: int | None

class CurvatureColumnsStruct(ctypes.Structure):
    size: int
    a: int | None
    a_directions: int | None
    b: int | None
    b_directions: int | None
    relative: int | None
    relative_directions: int | None

class VolumeColumnsStruct(ctypes.Structure):
    size: int
    volume: int | None
    volume_error: int | None
    gradient: int | None
    gradient_error: int | None
    status: int | None

class ContainmentColumnsStruct(ctypes.Structure):
    size: int
    clearance: int | None
    clearance_error: int | None
    normal: int | None
    arm_a: int | None
    arm_b: int | None
    status: int | None
    margin: int | None
    margin_error: int | None

class WallColumnsStruct(ctypes.Structure):
    size: int
    gap: int | None
    gap_error: int | None
    normal: int | None
    arm_body: int | None
    arm_wall: int | None
    status: int | None
    relation: int | None
    inner: int | None

class PointColumnsStruct(ctypes.Structure):
    size: int
    distance: int | None
    distance_error: int | None
    normal: int | None
    arm: int | None
    status: int | None

class RayColumnsStruct(ctypes.Structure):
    size: int
    status: int | None
    count: int | None
    t: int | None
    arm: int | None
    normal: int | None

class TimeColumnsStruct(ctypes.Structure):
    size: int
    status: int | None
    time: int | None
    latest: int | None
    resolution: int | None
    normal: int | None

class NeighbourQuestionStruct(ctypes.Structure):
    size: int
    reach: float
    edges: int | None
    periodic: int | None
    answers: int
    reserved: int

class NeighbourColumnsStruct(ctypes.Structure):
    size: int
    pairs: int | None
    images: int | None
    overlaps: int | None
    gap: int | None
    gap_error: int | None
    status: int | None
    normal: int | None
    arm_a: int | None
    arm_b: int | None
    separation: int | None

class PlaneContactColumnsStruct(ctypes.Structure):
    size: int
    relation: int | None
    inner: int | None
    crossings: int | None
    gap: int | None
    gap_error: int | None
    normal: int | None
    arm_a: int | None
    arm_b: int | None
    status: int | None
    area: int | None
    crossing_arms: int | None
    multiplicities: int | None
    chord_status: int | None
    chord_depth: int | None
    chord_normal: int | None
    chord_point: int | None
    clearance: int | None
    clearance_error: int | None
    margin: int | None
    margin_error: int | None

class PlanePointColumnsStruct(ctypes.Structure):
    size: int
    distance: int | None
    distance_error: int | None
    normal: int | None
    arm: int | None
    status: int | None

class QuadricColumnsStruct(ctypes.Structure):
    size: int
    type: int | None
    rank4: int | None
    rank3: int | None
    tier: int | None

@dataclass(init=False, repr=False, eq=False)
class Contacts(Columns):
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

@dataclass(init=False, repr=False, eq=False)
class BoundedGaps(Columns):
    gap: NDArray[np.float64]
    gap_error: NDArray[np.float64]
    normal: NDArray[np.float64]
    arm_a: NDArray[np.float64]
    arm_b: NDArray[np.float64]
    status: NDArray[np.int32]
    tier: NDArray[np.int32]
    point: NDArray[np.float64]
    above: NDArray[np.float64]

@dataclass(init=False, repr=False, eq=False)
class Relations(Columns):
    relation: NDArray[np.int32]
    inner: NDArray[np.int32]
    tier: NDArray[np.int32]

@dataclass(init=False, repr=False, eq=False)
class OtherGaps(Columns):
    gap: NDArray[np.float64]
    gap_error: NDArray[np.float64]
    normal: NDArray[np.float64]
    arm_a: NDArray[np.float64]
    arm_b: NDArray[np.float64]
    status: NDArray[np.int32]

@dataclass(init=False, repr=False, eq=False)
class Factors(Columns):
    factor: NDArray[np.float64]
    factor_error: NDArray[np.float64]
    scale: NDArray[np.float64]
    scale_error: NDArray[np.float64]
    status: NDArray[np.int32]

@dataclass(init=False, repr=False, eq=False)
class Derivatives(Columns):
    gradient: NDArray[np.float64]
    hessian: NDArray[np.float64]
    least_radius: NDArray[np.float64]
    status: NDArray[np.int32]

@dataclass(init=False, repr=False, eq=False)
class Curvatures(Columns):
    a: NDArray[np.float64]
    a_directions: NDArray[np.float64]
    b: NDArray[np.float64]
    b_directions: NDArray[np.float64]
    relative: NDArray[np.float64]
    relative_directions: NDArray[np.float64]

@dataclass(init=False, repr=False, eq=False)
class CommonVolumes(Columns):
    volume: NDArray[np.float64]
    volume_error: NDArray[np.float64]
    gradient: NDArray[np.float64]
    gradient_error: NDArray[np.float64]
    status: NDArray[np.int32]

@dataclass(init=False, repr=False, eq=False)
class Containments(Columns):
    clearance: NDArray[np.float64]
    clearance_error: NDArray[np.float64]
    normal: NDArray[np.float64]
    arm_a: NDArray[np.float64]
    arm_b: NDArray[np.float64]
    status: NDArray[np.int32]
    margin: NDArray[np.float64]
    margin_error: NDArray[np.float64]

@dataclass(init=False, repr=False, eq=False)
class Walls(Columns):
    gap: NDArray[np.float64]
    gap_error: NDArray[np.float64]
    normal: NDArray[np.float64]
    arm_body: NDArray[np.float64]
    arm_wall: NDArray[np.float64]
    status: NDArray[np.int32]
    relation: NDArray[np.int32]
    inner: NDArray[np.int32]

@dataclass(init=False, repr=False, eq=False)
class Points(Columns):
    distance: NDArray[np.float64]
    distance_error: NDArray[np.float64]
    normal: NDArray[np.float64]
    arm: NDArray[np.float64]
    status: NDArray[np.int32]

@dataclass(init=False, repr=False, eq=False)
class Rays(Columns):
    status: NDArray[np.int32]
    count: NDArray[np.int32]
    t: NDArray[np.float64]
    arm: NDArray[np.float64]
    normal: NDArray[np.float64]

@dataclass(init=False, repr=False, eq=False)
class Times(Columns):
    status: NDArray[np.int32]
    time: NDArray[np.float64]
    latest: NDArray[np.float64]
    resolution: NDArray[np.float64]
    normal: NDArray[np.float64]

@dataclass(init=False, repr=False, eq=False)
class Neighbours(Columns):
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

@dataclass(init=False, repr=False, eq=False)
class PlaneContacts(Columns):
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

@dataclass(init=False, repr=False, eq=False)
class PlanePoints(Columns):
    distance: NDArray[np.float64]
    distance_error: NDArray[np.float64]
    normal: NDArray[np.float64]
    arm: NDArray[np.float64]
    status: NDArray[np.int32]

@dataclass(init=False, repr=False, eq=False)
class Quadrics(Columns):
    type: NDArray[np.int32]
    rank4: NDArray[np.int32]
    rank3: NDArray[np.int32]
    tier: NDArray[np.int32]

FUNCTIONS: dict[str, tuple[Any, list[Any]]]
