! SPDX-License-Identifier: MIT
! Made by geometry/bindings/generate.py of table.py. Change those.
! tangency.h in Fortran 2018, for machines of 64 bits. Rows are columns here, and places of bodies,
! walls and the like count from 0. An argument that is optional may be left out. Columns of answers
! are set by c_loc(); what is c_null_ptr is not asked for.
module tangency
  use, intrinsic :: iso_c_binding
  implicit none
  public

  ! What a call returns. Where it is not OK nothing was answered, and tangency_error_message()
  ! says why.
  integer(c_int), parameter :: TANGENCY_OK = 0
  ! a row of numbers makes no body, wall, point or pair: message and tangency_error_row() name
  ! it
  integer(c_int), parameter :: TANGENCY_BAD_ROW = 1
  ! another argument is not what it has to be
  integer(c_int), parameter :: TANGENCY_BAD_ARGUMENT = 2
  integer(c_int), parameter :: TANGENCY_OUT_OF_MEMORY = 3
  ! an error of this library: please report it
  integer(c_int), parameter :: TANGENCY_INTERNAL = 4

  ! The type of the numbers of rows.
  integer(c_int), parameter :: TANGENCY_NUMBER_DOUBLE = 0
  integer(c_int), parameter :: TANGENCY_NUMBER_FLOAT = 1

  ! How a row gives an ellipsoid.
  ! 10 numbers x y z r1 r2 r3 qw qx qy qz: centre, semi-axes > 0 in any order, and a quaternion
  ! of any length but 0 that turns body axes into space axes
  integer(c_int), parameter :: TANGENCY_FORM_AXES = 0
  ! 9 numbers x y z xx yy zz xy yz zx: centre and shape matrix M, length^2, of the body (p-c)'
  ! M^-1 (p-c) <= level
  integer(c_int), parameter :: TANGENCY_FORM_SHAPE = 1
  ! the same 9 with the inverse of M, length^-2
  integer(c_int), parameter :: TANGENCY_FORM_PRECISION = 2
  ! 12 numbers: centre, and the vectors of the three semi-axes, at right angles
  integer(c_int), parameter :: TANGENCY_FORM_VECTORS = 3
  ! 10 numbers A B C D E F G H J K: A x^2 + B y^2 + C z^2 + 2D xy + 2E yz + 2F zx + 2G x + 2H y
  ! + 2J z + K = 0, the inside of a real ellipsoid
  integer(c_int), parameter :: TANGENCY_FORM_QUADRIC = 4

  ! How a row gives an ellipse.
  ! 6 numbers x y r1 r2 ux uy: centre, semi-axes > 0, and the direction of the first, of any
  ! length but 0
  integer(c_int), parameter :: TANGENCY_PLANE_FORM_DIRECTION = 0
  ! 5 numbers x y r1 r2 angle: the angle of the first axis, rad
  integer(c_int), parameter :: TANGENCY_PLANE_FORM_ANGLE = 1
  ! 5 numbers x y xx yy xy: centre and shape matrix, length^2
  integer(c_int), parameter :: TANGENCY_PLANE_FORM_SHAPE = 2
  ! the same 5 with the inverse of the matrix, length^-2
  integer(c_int), parameter :: TANGENCY_PLANE_FORM_PRECISION = 3
  ! 6 numbers A B C D E F: A x^2 + B xy + C y^2 + D x + E y + F = 0
  integer(c_int), parameter :: TANGENCY_PLANE_FORM_CONIC = 4

  ! How two solids lie, as point sets: exact for the numbers as they are given.
  ! no common point
  integer(c_int), parameter :: TANGENCY_RELATION_SEPARATE = 0
  ! common points, interiors disjoint
  integer(c_int), parameter :: TANGENCY_RELATION_EXTERNAL_TOUCH = 1
  ! every other pair
  integer(c_int), parameter :: TANGENCY_RELATION_OVERLAP = 2
  ! one inside the other, not equal, boundaries meeting
  integer(c_int), parameter :: TANGENCY_RELATION_INTERNAL_TOUCH = 3
  ! A inside the interior of B
  integer(c_int), parameter :: TANGENCY_RELATION_A_IN_B = 4
  ! B inside the interior of A
  integer(c_int), parameter :: TANGENCY_RELATION_B_IN_A = 5
  integer(c_int), parameter :: TANGENCY_RELATION_EQUAL = 6

  ! The body inside, where the relation is internal_touch.
  integer(c_int), parameter :: TANGENCY_INNER_NONE = 0
  integer(c_int), parameter :: TANGENCY_INNER_A = 1
  integer(c_int), parameter :: TANGENCY_INNER_B = 2

  ! What knew the answer. Both give the same one.
  ! arithmetic in double with a proven bound
  integer(c_int), parameter :: TANGENCY_TIER_FILTER = 0
  ! integers
  integer(c_int), parameter :: TANGENCY_TIER_EXACT = 1

  ! What is known of a gap, distance or clearance.
  ! the global answer, proven
  integer(c_int), parameter :: TANGENCY_STATUS_OK = 0
  ! a stationary answer; that none is better elsewhere is not proven
  integer(c_int), parameter :: TANGENCY_STATUS_LOCAL = 1
  ! above accuracy.cutoff: gap is a lower bound, gap_error infinite, the rest 0
  integer(c_int), parameter :: TANGENCY_STATUS_BEYOND = 2

  ! Which method gave the answer, the cheapest first.
  integer(c_int), parameter :: TANGENCY_GAP_TIER_FAST = 0
  integer(c_int), parameter :: TANGENCY_GAP_TIER_SAFEGUARDED = 1
  integer(c_int), parameter :: TANGENCY_GAP_TIER_FACTORED = 2
  integer(c_int), parameter :: TANGENCY_GAP_TIER_SEARCH = 3
  ! any of these, and the exact relation decided the sign
  integer(c_int), parameter :: TANGENCY_GAP_TIER_EXACT = 4

  ! Definitions of a gap other than the common normal's.
  ! the distance of the tangent planes along the Perram-Wertheim normal
  integer(c_int), parameter :: TANGENCY_DEFINITION_PERRAM_WERTHEIM = 0
  ! along that normal through the point of equal potentials
  integer(c_int), parameter :: TANGENCY_DEFINITION_MIDPOINT_POTENTIAL = 1
  ! the published scheme of curves; no gap_error
  integer(c_int), parameter :: TANGENCY_DEFINITION_TRACE = 2

  ! What is known of an answer by another definition. Numbers are 0 unless ok.
  integer(c_int), parameter :: TANGENCY_OTHER_STATUS_OK = 0
  ! the definition says nothing about this pair
  integer(c_int), parameter :: TANGENCY_OTHER_STATUS_NOT_APPLICABLE = 1
  ! not known well enough
  integer(c_int), parameter :: TANGENCY_OTHER_STATUS_NOT_CONVERGED = 2

  ! Of what the derivatives are. They are 0 for tie and degenerate.
  ! of the gap
  integer(c_int), parameter :: TANGENCY_DERIVATIVE_STATUS_OK = 0
  ! of the branch of a local gap
  integer(c_int), parameter :: TANGENCY_DERIVATIVE_STATUS_LOCAL = 1
  ! two normals reach equally far: there is no derivative
  integer(c_int), parameter :: TANGENCY_DERIVATIVE_STATUS_TIE = 2
  ! the best normal is not safely isolated
  integer(c_int), parameter :: TANGENCY_DERIVATIVE_STATUS_DEGENERATE = 3

  ! Whether the errors of a common volume are within the tolerance.
  integer(c_int), parameter :: TANGENCY_VOLUME_STATUS_OK = 0
  ! they are not, and still hold
  integer(c_int), parameter :: TANGENCY_VOLUME_STATUS_TOLERANCE_NOT_REACHED = 1

  ! What a ray meets.
  ! no point of the surface in the interval
  integer(c_int), parameter :: TANGENCY_RAY_STATUS_MISS = 0
  ! one or two points
  integer(c_int), parameter :: TANGENCY_RAY_STATUS_HIT = 1
  ! the line touches the surface in one point, exactly
  integer(c_int), parameter :: TANGENCY_RAY_STATUS_GRAZING = 2

  ! What is known of the first contact.
  ! apart throughout [0, horizon]
  integer(c_int), parameter :: TANGENCY_TIME_STATUS_NONE = 0
  ! apart before `time`, in contact at some moment of [time, latest]
  integer(c_int), parameter :: TANGENCY_TIME_STATUS_CONTACT = 1
  ! a common point at t = 0: exact
  integer(c_int), parameter :: TANGENCY_TIME_STATUS_TOUCHING_AT_START = 2
  ! apart before `time`, when they are too close for rounding to tell
  integer(c_int), parameter :: TANGENCY_TIME_STATUS_GRAZING = 3
  ! apart before `time`; the rest was not looked at
  integer(c_int), parameter :: TANGENCY_TIME_STATUS_NOT_CONVERGED = 4

  ! What is wanted of each pair of neighbours. Each adds to those before it.
  ! which there are
  integer(c_int), parameter :: TANGENCY_NEIGHBOUR_ANSWERS_PAIRS = 0
  ! do the interiors meet?
  integer(c_int), parameter :: TANGENCY_NEIGHBOUR_ANSWERS_OVERLAPS = 1
  ! gap, gap_error, status
  integer(c_int), parameter :: TANGENCY_NEIGHBOUR_ANSWERS_GAPS = 2
  ! normal, arms and the separation
  integer(c_int), parameter :: TANGENCY_NEIGHBOUR_ANSWERS_CONTACTS = 3

  ! Whether the chord between two crossings is defined.
  integer(c_int), parameter :: TANGENCY_CHORD_STATUS_OK = 0
  ! the boundaries do not cross in exactly two points
  integer(c_int), parameter :: TANGENCY_CHORD_STATUS_NOT_APPLICABLE = 1

  ! What a quadric is, exactly.
  integer(c_int), parameter :: TANGENCY_QUADRIC_TYPE_REAL_ELLIPSOID = 0
  integer(c_int), parameter :: TANGENCY_QUADRIC_TYPE_IMAGINARY_ELLIPSOID = 1
  integer(c_int), parameter :: TANGENCY_QUADRIC_TYPE_HYPERBOLOID_ONE_SHEET = 2
  integer(c_int), parameter :: TANGENCY_QUADRIC_TYPE_HYPERBOLOID_TWO_SHEETS = 3
  integer(c_int), parameter :: TANGENCY_QUADRIC_TYPE_ELLIPTIC_PARABOLOID = 4
  integer(c_int), parameter :: TANGENCY_QUADRIC_TYPE_HYPERBOLIC_PARABOLOID = 5
  integer(c_int), parameter :: TANGENCY_QUADRIC_TYPE_REAL_ELLIPTIC_CONE = 6
  integer(c_int), parameter :: TANGENCY_QUADRIC_TYPE_IMAGINARY_ELLIPTIC_CONE = 7
  integer(c_int), parameter :: TANGENCY_QUADRIC_TYPE_REAL_ELLIPTIC_CYLINDER = 8
  integer(c_int), parameter :: TANGENCY_QUADRIC_TYPE_IMAGINARY_ELLIPTIC_CYLINDER = 9
  integer(c_int), parameter :: TANGENCY_QUADRIC_TYPE_HYPERBOLIC_CYLINDER = 10
  integer(c_int), parameter :: TANGENCY_QUADRIC_TYPE_PARABOLIC_CYLINDER = 11
  integer(c_int), parameter :: TANGENCY_QUADRIC_TYPE_REAL_INTERSECTING_PLANES = 12
  integer(c_int), parameter :: TANGENCY_QUADRIC_TYPE_IMAGINARY_INTERSECTING_PLANES = 13
  integer(c_int), parameter :: TANGENCY_QUADRIC_TYPE_REAL_PARALLEL_PLANES = 14
  integer(c_int), parameter :: TANGENCY_QUADRIC_TYPE_IMAGINARY_PARALLEL_PLANES = 15
  integer(c_int), parameter :: TANGENCY_QUADRIC_TYPE_COINCIDENT_PLANES = 16
  integer(c_int), parameter :: TANGENCY_QUADRIC_TYPE_PLANE = 17
  integer(c_int), parameter :: TANGENCY_QUADRIC_TYPE_NO_POINTS = 18
  integer(c_int), parameter :: TANGENCY_QUADRIC_TYPE_ALL_SPACE = 19

  ! How good a gap has to be. Sign, status and gap_error are proven at any; 0 everywhere, and
  ! NULL, is the gap to rounding and its normal to some 1e-8 rad.
  type, bind(c) :: tangency_accuracy
    integer(c_size_t) :: size = 40_c_size_t
    ! tolerance in parts of the size of the pair, >= 0
    real(c_double) :: of_size = 0.0_c_double
    ! tolerance, >= 0 (unit: length)
    real(c_double) :: length = 0.0_c_double
    ! not 0: normals and points to rounding too
    integer(c_int) :: normals = 0_c_int
    ! not 0: no answer is wanted of pairs whose gap is above cutoff; must be 0 for bodies by
    ! matrices
    integer(c_int) :: has_cutoff = 0_c_int
    ! >= 0; not read where has_cutoff is 0 (unit: length)
    real(c_double) :: cutoff = 0.0_c_double
  end type tangency_accuracy

  ! Answers of tangency_contacts().
  type, bind(c) :: tangency_contact_columns
    integer(c_size_t) :: size = 96_c_size_t
    ! > 0: the distance; < 0: minus the penetration depth (unit: length)
    type(c_ptr) :: gap = c_null_ptr
    ! proven: |gap - true gap| is at most this where the status is ok; where it is local the
    ! true gap is at least gap - gap_error (unit: length)
    type(c_ptr) :: gap_error = c_null_ptr
    ! unit, from A to B (3 a row)
    type(c_ptr) :: normal = c_null_ptr
    ! A's witness point less A's centre (3 a row, unit: length)
    type(c_ptr) :: arm_a = c_null_ptr
    ! B's witness point less B's centre (3 a row, unit: length)
    type(c_ptr) :: arm_b = c_null_ptr
    ! tangency_status
    type(c_ptr) :: status = c_null_ptr
    ! tangency_gap_tier
    type(c_ptr) :: tier = c_null_ptr
    ! the contact point, midway between the witness points, less A's centre (3 a row, unit:
    ! length)
    type(c_ptr) :: point = c_null_ptr
    ! proven: of |normal - true normal|; 2 where nothing is
    type(c_ptr) :: normal_bound = c_null_ptr
    ! proven: of |arm_a - true arm_a| (unit: length)
    type(c_ptr) :: arm_a_bound = c_null_ptr
    ! proven: of |arm_b - true arm_b| (unit: length)
    type(c_ptr) :: arm_b_bound = c_null_ptr
  end type tangency_contact_columns

  ! Answers of tangency_bounded_gaps().
  type, bind(c) :: tangency_bounded_columns
    integer(c_size_t) :: size = 80_c_size_t
    ! > 0: the distance; < 0: minus the penetration depth (unit: length)
    type(c_ptr) :: gap = c_null_ptr
    ! proven: |gap - true gap| is at most this where the status is ok; where it is local the
    ! true gap is at least gap - gap_error (unit: length)
    type(c_ptr) :: gap_error = c_null_ptr
    ! unit, from A to B (3 a row)
    type(c_ptr) :: normal = c_null_ptr
    ! A's witness point less A's centre (3 a row, unit: length)
    type(c_ptr) :: arm_a = c_null_ptr
    ! B's witness point less B's centre (3 a row, unit: length)
    type(c_ptr) :: arm_b = c_null_ptr
    ! tangency_status
    type(c_ptr) :: status = c_null_ptr
    ! tangency_gap_tier
    type(c_ptr) :: tier = c_null_ptr
    ! the contact point, midway between the witness points, less A's centre (3 a row, unit:
    ! length)
    type(c_ptr) :: point = c_null_ptr
    ! gap - gap_error <= true gap <= gap + above (unit: length)
    type(c_ptr) :: above = c_null_ptr
  end type tangency_bounded_columns

  ! Answers of tangency_relations().
  type, bind(c) :: tangency_relation_columns
    integer(c_size_t) :: size = 32_c_size_t
    ! tangency_relation
    type(c_ptr) :: relation = c_null_ptr
    ! tangency_inner
    type(c_ptr) :: inner = c_null_ptr
    ! tangency_tier
    type(c_ptr) :: tier = c_null_ptr
  end type tangency_relation_columns

  ! Answers of tangency_other_gaps().
  type, bind(c) :: tangency_other_gap_columns
    integer(c_size_t) :: size = 56_c_size_t
    ! > 0: the distance; < 0: minus the penetration depth (unit: length)
    type(c_ptr) :: gap = c_null_ptr
    ! proven: |gap - true gap| is at most this where the status is ok; where it is local the
    ! true gap is at least gap - gap_error (unit: length)
    type(c_ptr) :: gap_error = c_null_ptr
    ! unit, from A to B (3 a row)
    type(c_ptr) :: normal = c_null_ptr
    ! A's witness point less A's centre (3 a row, unit: length)
    type(c_ptr) :: arm_a = c_null_ptr
    ! B's witness point less B's centre (3 a row, unit: length)
    type(c_ptr) :: arm_b = c_null_ptr
    ! tangency_other_status
    type(c_ptr) :: status = c_null_ptr
  end type tangency_other_gap_columns

  ! Answers of tangency_perram_wertheim_factors().
  type, bind(c) :: tangency_factor_columns
    integer(c_size_t) :: size = 48_c_size_t
    ! F >= 0: > 1 apart, 1 touching, < 1 overlapping
    type(c_ptr) :: factor = c_null_ptr
    ! proven: of |factor - F|
    type(c_ptr) :: factor_error = c_null_ptr
    ! mu = sqrt F: both bodies, scaled by it about their centres, touch
    type(c_ptr) :: scale = c_null_ptr
    ! proven: of |scale - mu|
    type(c_ptr) :: scale_error = c_null_ptr
    ! tangency_other_status
    type(c_ptr) :: status = c_null_ptr
  end type tangency_factor_columns

  ! Answers of tangency_gap_derivatives(). Parameters, 18 in this order: centre, rotation vector
  ! in space (rad) and semi-axes of A, then of B.
  type, bind(c) :: tangency_derivative_columns
    integer(c_size_t) :: size = 40_c_size_t
    ! first derivatives of the gap (18 a row, unit: length/parameter)
    type(c_ptr) :: gradient = c_null_ptr
    ! second derivatives, symmetric (18x18 a row, unit: length/parameter^2)
    type(c_ptr) :: hessian = c_null_ptr
    ! how sharp the best normal is (unit: length)
    type(c_ptr) :: least_radius = c_null_ptr
    ! tangency_derivative_status
    type(c_ptr) :: status = c_null_ptr
  end type tangency_derivative_columns

  ! Answers of tangency_contact_curvatures(): principal curvatures, the larger first, and their
  ! directions.
  type, bind(c) :: tangency_curvature_columns
    integer(c_size_t) :: size = 56_c_size_t
    ! of A at its witness point (2 a row, unit: 1/length)
    type(c_ptr) :: a = c_null_ptr
    ! unit, tangent, in space (2x3 a row)
    type(c_ptr) :: a_directions = c_null_ptr
    ! of B at its witness point (2 a row, unit: 1/length)
    type(c_ptr) :: b = c_null_ptr
    ! unit, tangent, in space (2x3 a row)
    type(c_ptr) :: b_directions = c_null_ptr
    ! of the distance between the surfaces: 1/R' and 1/R'' of Hertz theory (2 a row, unit:
    ! 1/length)
    type(c_ptr) :: relative = c_null_ptr
    ! unit, tangent, in space (2x3 a row)
    type(c_ptr) :: relative_directions = c_null_ptr
  end type tangency_curvature_columns

  ! Answers of tangency_common_volumes().
  type, bind(c) :: tangency_volume_columns
    integer(c_size_t) :: size = 48_c_size_t
    ! of what both bodies have in common (unit: length^3)
    type(c_ptr) :: volume = c_null_ptr
    ! proven: of |volume - true volume| (unit: length^3)
    type(c_ptr) :: volume_error = c_null_ptr
    ! of the volume by B's centre (3 a row, unit: length^2)
    type(c_ptr) :: gradient = c_null_ptr
    ! proven: of |gradient - true gradient| (unit: length^2)
    type(c_ptr) :: gradient_error = c_null_ptr
    ! tangency_volume_status
    type(c_ptr) :: status = c_null_ptr
  end type tangency_volume_columns

  ! Answers of tangency_containments(): how far A lies inside B.
  type, bind(c) :: tangency_containment_columns
    integer(c_size_t) :: size = 72_c_size_t
    ! > 0: the least distance of the boundaries; < 0: minus the length by which A sticks out
    ! (unit: length)
    type(c_ptr) :: clearance = c_null_ptr
    ! proven: of |clearance - true clearance| (unit: length)
    type(c_ptr) :: clearance_error = c_null_ptr
    ! unit, outwards (3 a row)
    type(c_ptr) :: normal = c_null_ptr
    ! witness point of A less A's centre (3 a row, unit: length)
    type(c_ptr) :: arm_a = c_null_ptr
    ! witness point of B less B's centre (3 a row, unit: length)
    type(c_ptr) :: arm_b = c_null_ptr
    ! tangency_status, of the clearance
    type(c_ptr) :: status = c_null_ptr
    ! the largest factor by which A, scaled about its centre, lies in B
    type(c_ptr) :: margin = c_null_ptr
    ! proven: of |margin - true margin|
    type(c_ptr) :: margin_error = c_null_ptr
  end type tangency_containment_columns

  ! Answers of tangency_walls().
  type, bind(c) :: tangency_wall_columns
    integer(c_size_t) :: size = 72_c_size_t
    ! < 0 where the body reaches into the wall (unit: length)
    type(c_ptr) :: gap = c_null_ptr
    ! proven: of |gap - true gap| (unit: length)
    type(c_ptr) :: gap_error = c_null_ptr
    ! unit, from the body to the wall (3 a row)
    type(c_ptr) :: normal = c_null_ptr
    ! the body's point nearest to the wall, less its centre (3 a row, unit: length)
    type(c_ptr) :: arm_body = c_null_ptr
    ! the wall's point opposite to it, less the body's centre (3 a row, unit: length)
    type(c_ptr) :: arm_wall = c_null_ptr
    ! tangency_status
    type(c_ptr) :: status = c_null_ptr
    ! tangency_relation
    type(c_ptr) :: relation = c_null_ptr
    ! tangency_inner
    type(c_ptr) :: inner = c_null_ptr
  end type tangency_wall_columns

  ! Answers of tangency_points().
  type, bind(c) :: tangency_point_columns
    integer(c_size_t) :: size = 48_c_size_t
    ! < 0 inside (unit: length)
    type(c_ptr) :: distance = c_null_ptr
    ! proven: of |distance - true distance| (unit: length)
    type(c_ptr) :: distance_error = c_null_ptr
    ! unit, outwards, at the closest point of the surface (3 a row)
    type(c_ptr) :: normal = c_null_ptr
    ! closest point less the centre (3 a row, unit: length)
    type(c_ptr) :: arm = c_null_ptr
    ! tangency_status
    type(c_ptr) :: status = c_null_ptr
  end type tangency_point_columns

  ! Answers of tangency_rays().
  type, bind(c) :: tangency_ray_columns
    integer(c_size_t) :: size = 48_c_size_t
    ! tangency_ray_status
    type(c_ptr) :: status = c_null_ptr
    ! how many of the two points there are
    type(c_ptr) :: count = c_null_ptr
    ! origin + t direction, ascending; 0 beyond count (2 a row, unit: length of the direction)
    type(c_ptr) :: t = c_null_ptr
    ! the points less the body's centre (2x3 a row, unit: length)
    type(c_ptr) :: arm = c_null_ptr
    ! unit, outwards (2x3 a row)
    type(c_ptr) :: normal = c_null_ptr
  end type tangency_ray_columns

  ! Answers of tangency_times_of_contact().
  type, bind(c) :: tangency_time_columns
    integer(c_size_t) :: size = 48_c_size_t
    ! tangency_time_status
    type(c_ptr) :: status = c_null_ptr
    ! never after the first contact; the horizon for none (unit: time)
    type(c_ptr) :: time = c_null_ptr
    ! for contact: the first contact is no later (unit: time)
    type(c_ptr) :: latest = c_null_ptr
    ! the gap below which rounding hides whether there is one (unit: length)
    type(c_ptr) :: resolution = c_null_ptr
    ! unit, from A to B, near `time`; 0 for none and touching_at_start (3 a row)
    type(c_ptr) :: normal = c_null_ptr
  end type tangency_time_columns

  ! Which neighbours are wanted.
  type, bind(c) :: tangency_neighbour_question
    integer(c_size_t) :: size = 40_c_size_t
    ! pairs whose gap is at most this; finite, >= 0 (unit: length)
    real(c_double) :: reach = 0.0_c_double
    ! three edge vectors, one after the other, that repeat the bodies; NULL: nothing repeats (9
    ! a row, unit: length)
    type(c_ptr) :: edges = c_null_ptr
    ! along which of them; NULL: along all (3 a row)
    type(c_ptr) :: periodic = c_null_ptr
    ! tangency_neighbour_answers
    integer(c_int) :: answers = 0_c_int
    ! 0
    integer(c_int) :: reserved = 0_c_int
  end type tangency_neighbour_question

  ! What tangency_neighbours_columns() shows, NULL where it was not asked for, as is what this
  ! version does not know. Valid until the list is destroyed.
  type, bind(c) :: tangency_neighbour_columns
    integer(c_size_t) :: size = 88_c_size_t
    ! body a <= body b (2 a row)
    type(c_ptr) :: pairs = c_null_ptr
    ! b is moved by so many of each edge (3 a row)
    type(c_ptr) :: images = c_null_ptr
    ! 1 where the interiors meet
    type(c_ptr) :: overlaps = c_null_ptr
    ! as of contacts (unit: length)
    type(c_ptr) :: gap = c_null_ptr
    ! as of contacts (unit: length)
    type(c_ptr) :: gap_error = c_null_ptr
    ! tangency_status
    type(c_ptr) :: status = c_null_ptr
    ! unit, from a to the image of b (3 a row)
    type(c_ptr) :: normal = c_null_ptr
    ! a's witness point less a's centre (3 a row, unit: length)
    type(c_ptr) :: arm_a = c_null_ptr
    ! the witness point of b's image less its centre (3 a row, unit: length)
    type(c_ptr) :: arm_b = c_null_ptr
    ! from a's centre to that of b's image, rounded (3 a row, unit: length)
    type(c_ptr) :: separation = c_null_ptr
  end type tangency_neighbour_columns

  ! Answers of tangency_plane_contacts().
  type, bind(c) :: tangency_plane_contact_columns
    integer(c_size_t) :: size = 168_c_size_t
    ! tangency_relation
    type(c_ptr) :: relation = c_null_ptr
    ! tangency_inner
    type(c_ptr) :: inner = c_null_ptr
    ! points where the boundaries meet, exact; -1 where they are equal
    type(c_ptr) :: crossings = c_null_ptr
    ! > 0: the distance; < 0: minus the penetration depth (unit: length)
    type(c_ptr) :: gap = c_null_ptr
    ! as of contacts (unit: length)
    type(c_ptr) :: gap_error = c_null_ptr
    ! unit, from A to B (2 a row)
    type(c_ptr) :: normal = c_null_ptr
    ! A's witness point less A's centre (2 a row, unit: length)
    type(c_ptr) :: arm_a = c_null_ptr
    ! B's witness point less B's centre (2 a row, unit: length)
    type(c_ptr) :: arm_b = c_null_ptr
    ! tangency_status
    type(c_ptr) :: status = c_null_ptr
    ! of what both ellipses have in common (unit: length^2)
    type(c_ptr) :: area = c_null_ptr
    ! the crossings less A's centre; 0 beyond their number (4x2 a row, unit: length)
    type(c_ptr) :: crossing_arms = c_null_ptr
    ! of the crossings, and 0 beyond their number (4 a row)
    type(c_ptr) :: multiplicities = c_null_ptr
    ! tangency_chord_status
    type(c_ptr) :: chord_status = c_null_ptr
    ! of the published plane scheme (unit: length)
    type(c_ptr) :: chord_depth = c_null_ptr
    ! unit, across the chord (2 a row)
    type(c_ptr) :: chord_normal = c_null_ptr
    ! contact point less A's centre (2 a row, unit: length)
    type(c_ptr) :: chord_point = c_null_ptr
    ! how far A lies inside B, as of containments (unit: length)
    type(c_ptr) :: clearance = c_null_ptr
    ! proven: of |clearance - true clearance| (unit: length)
    type(c_ptr) :: clearance_error = c_null_ptr
    ! as of containments
    type(c_ptr) :: margin = c_null_ptr
    ! proven: of |margin - true margin|
    type(c_ptr) :: margin_error = c_null_ptr
  end type tangency_plane_contact_columns

  ! Answers of tangency_plane_points().
  type, bind(c) :: tangency_plane_point_columns
    integer(c_size_t) :: size = 48_c_size_t
    ! < 0 inside (unit: length)
    type(c_ptr) :: distance = c_null_ptr
    ! proven: of |distance - true distance| (unit: length)
    type(c_ptr) :: distance_error = c_null_ptr
    ! unit, outwards, at the closest point of the boundary (2 a row)
    type(c_ptr) :: normal = c_null_ptr
    ! closest point less the centre (2 a row, unit: length)
    type(c_ptr) :: arm = c_null_ptr
    ! tangency_status
    type(c_ptr) :: status = c_null_ptr
  end type tangency_plane_point_columns

  ! Answers of tangency_classify().
  type, bind(c) :: tangency_quadric_columns
    integer(c_size_t) :: size = 40_c_size_t
    ! tangency_quadric_type
    type(c_ptr) :: type = c_null_ptr
    ! rank of the discriminant matrix
    type(c_ptr) :: rank4 = c_null_ptr
    ! rank of its upper-left 3 x 3 block
    type(c_ptr) :: rank3 = c_null_ptr
    ! tangency_tier
    type(c_ptr) :: tier = c_null_ptr
  end type tangency_quadric_columns

  interface

    ! MAJOR.MINOR.PATCH of the library.
    function tangency_version() bind(c, name="tangency_version") result(code)
      use, intrinsic :: iso_c_binding
      type(c_ptr) :: code
    end function tangency_version

    ! The instruction set that calls for many pairs use here, as "AVX2".
    function tangency_instruction_set() bind(c, name="tangency_instruction_set") result(code)
      use, intrinsic :: iso_c_binding
      type(c_ptr) :: code
    end function tangency_instruction_set

    ! What was wrong with the last call of this thread that did not return OK: one line that
    ! names argument, row, field, value and rule. Valid until that thread's next such call.
    function tangency_error_message() bind(c, name="tangency_error_message") result(code)
      use, intrinsic :: iso_c_binding
      type(c_ptr) :: code
    end function tangency_error_message

    ! The row that was wrong there, from 0; the largest size_t where it was none.
    function tangency_error_row() bind(c, name="tangency_error_row") result(code)
      use, intrinsic :: iso_c_binding
      integer(c_size_t) :: code
    end function tangency_error_row

    ! The name of a value of an enumeration, as files write it: name_of("relation", 2) is
    ! "overlap". NULL where there is none.
    !   enumeration: its name without tangency_
    !   value: of the enumeration
    function tangency_name_of(enumeration, value) bind(c, name="tangency_name_of") result(code)
      use, intrinsic :: iso_c_binding
      character(kind=c_char), intent(in) :: enumeration(*)
      integer(c_int), value :: value
      type(c_ptr) :: code
    end function tangency_name_of

    ! The level of the ellipsoid (3) or ellipse (2) that holds a share of a normal distribution.
    !   confidence: in (0, 1)
    !   dimensions: 2 or 3
    !   level: the answer
    function tangency_level_of_confidence(confidence, dimensions, level) bind(c, &
        name="tangency_level_of_confidence") result(code)
      use, intrinsic :: iso_c_binding
      real(c_double), value :: confidence
      integer(c_int), value :: dimensions
      real(c_double), intent(out) :: level
      integer(c_int) :: code
    end function tangency_level_of_confidence

    ! Bodies of rows of numbers, which are copied. By forms other than axes relations are exact
    ! for the numbers as given, other answers hold with what is rounded in their errors, and
    ! pairs take longer.
    !   bodies: to be destroyed with tangency_bodies_destroy()
    !   form: tangency_form
    !   rows: the numbers of the first row, side by side
    !   number: their type, tangency_number
    !   count: rows
    !   stride: from one row to the next; may be negative (unit: bytes)
    !   level: of forms shape and precision, > 0; else 1
    function tangency_bodies_create(bodies, form, rows, number, count, stride, level) bind(c, &
        name="tangency_bodies_create") result(code)
      use, intrinsic :: iso_c_binding
      type(c_ptr), intent(out) :: bodies
      integer(c_int), value :: form
      type(c_ptr), value :: rows
      integer(c_int), value :: number
      integer(c_size_t), value :: count
      integer(c_ptrdiff_t), value :: stride
      real(c_double), value :: level
      integer(c_int) :: code
    end function tangency_bodies_create

    ! More bodies behind those there are. Here and in bodies_set() nobody may ask about them
    ! meanwhile; where it fails they are as before.
    !   bodies: as they were made
    !   form: tangency_form
    !   rows: the numbers of the first row, side by side
    !   number: their type, tangency_number
    !   count: rows
    !   stride: from one row to the next; may be negative (unit: bytes)
    !   level: as above
    function tangency_bodies_append(bodies, form, rows, number, count, stride, level) bind(c, &
        name="tangency_bodies_append") result(code)
      use, intrinsic :: iso_c_binding
      type(c_ptr), value :: bodies
      integer(c_int), value :: form
      type(c_ptr), value :: rows
      integer(c_int), value :: number
      integer(c_size_t), value :: count
      integer(c_ptrdiff_t), value :: stride
      real(c_double), value :: level
      integer(c_int) :: code
    end function tangency_bodies_append

    ! Other numbers, by axes, for the bodies from `first` on, as of bodies that move.
    !   bodies: as they were made
    !   first: from 0
    !   rows: the numbers of the first row, side by side
    !   number: their type, tangency_number
    !   count: rows
    !   stride: from one row to the next; may be negative (unit: bytes)
    function tangency_bodies_set(bodies, first, rows, number, count, stride) bind(c, &
        name="tangency_bodies_set") result(code)
      use, intrinsic :: iso_c_binding
      type(c_ptr), value :: bodies
      integer(c_size_t), value :: first
      type(c_ptr), value :: rows
      integer(c_int), value :: number
      integer(c_size_t), value :: count
      integer(c_ptrdiff_t), value :: stride
      integer(c_int) :: code
    end function tangency_bodies_set

    ! How many there are.
    !   bodies: as they were made
    function tangency_bodies_count(bodies) bind(c, name="tangency_bodies_count") result(code)
      use, intrinsic :: iso_c_binding
      type(c_ptr), value :: bodies
      integer(c_size_t) :: code
    end function tangency_bodies_count

    ! Ends them; NULL does nothing.
    !   bodies: as they were made
    subroutine tangency_bodies_destroy(bodies) bind(c, name="tangency_bodies_destroy")
      use, intrinsic :: iso_c_binding
      type(c_ptr), value :: bodies
    end subroutine tangency_bodies_destroy

    ! Signed gap, normal and witness points of pairs. The sign is that of the exact relation.
    !   bodies: as they were made
    !   pairs: places of A and B among the bodies, from 0. NULL: of pair k those of bodies k and
    !   count + k (2 a row)
    !   count: pairs
    !   separations: c_B - c_A in place of that of the centres, as for periodic images; NULL: of
    !   the centres (3 a row, unit: length)
    !   previous_normals: follow the branch of these, from A to B; may be the memory of
    !   answers.normal. A row of zeros, and NULL: the global gap (3 a row)
    !   accuracy: NULL: the gap to rounding
    !   answers: each column count rows, or NULL: not asked for
    !   threads: that may work on it; below 1 counts as 1
    function tangency_contacts(bodies, pairs, count, separations, previous_normals, accuracy, &
        answers, threads) bind(c, name="tangency_contacts") result(code)
      use, intrinsic :: iso_c_binding
      import :: tangency_accuracy, tangency_contact_columns
      type(c_ptr), value :: bodies
      integer(c_int), intent(in), optional :: pairs(2,*)
      integer(c_size_t), value :: count
      real(c_double), intent(in), optional :: separations(3,*)
      real(c_double), intent(in), optional :: previous_normals(3,*)
      type(tangency_accuracy), intent(in), optional :: accuracy
      type(tangency_contact_columns), intent(in) :: answers
      integer(c_int), value :: threads
      integer(c_int) :: code
    end function tangency_contacts

    ! The same for pairs of rows of form axes, read where they are: nothing is copied but some
    ! hundred rows at a time.
    !   a: row k is A of pair k
    !   a_stride: from one row to the next (unit: bytes)
    !   b: row k is B of pair k
    !   b_stride: from one row to the next (unit: bytes)
    !   count: pairs
    !   accuracy: NULL: the gap to rounding
    !   answers: each column count rows, or NULL: not asked for
    !   threads: that may work on it; below 1 counts as 1
    function tangency_contacts_of_rows(a, a_stride, b, b_stride, count, accuracy, answers, &
        threads) bind(c, name="tangency_contacts_of_rows") result(code)
      use, intrinsic :: iso_c_binding
      import :: tangency_accuracy, tangency_contact_columns
      real(c_double), intent(in) :: a(*)
      integer(c_ptrdiff_t), value :: a_stride
      real(c_double), intent(in) :: b(*)
      integer(c_ptrdiff_t), value :: b_stride
      integer(c_size_t), value :: count
      type(tangency_accuracy), intent(in), optional :: accuracy
      type(tangency_contact_columns), intent(in) :: answers
      integer(c_int), value :: threads
      integer(c_int) :: code
    end function tangency_contacts_of_rows

    ! The gap at a bounded cost, without search: true gap in [gap - gap_error, gap + above].
    !   bodies: as they were made
    !   pairs: places of A and B among the bodies, from 0. NULL: of pair k those of bodies k and
    !   count + k (2 a row)
    !   count: pairs
    !   separations: c_B - c_A in place of that of the centres, as for periodic images; NULL: of
    !   the centres (3 a row, unit: length)
    !   accuracy: NULL: the gap to rounding
    !   answers: each column count rows, or NULL: not asked for
    !   threads: that may work on it; below 1 counts as 1
    function tangency_bounded_gaps(bodies, pairs, count, separations, accuracy, answers, &
        threads) bind(c, name="tangency_bounded_gaps") result(code)
      use, intrinsic :: iso_c_binding
      import :: tangency_accuracy, tangency_bounded_columns
      type(c_ptr), value :: bodies
      integer(c_int), intent(in), optional :: pairs(2,*)
      integer(c_size_t), value :: count
      real(c_double), intent(in), optional :: separations(3,*)
      type(tangency_accuracy), intent(in), optional :: accuracy
      type(tangency_bounded_columns), intent(in) :: answers
      integer(c_int), value :: threads
      integer(c_int) :: code
    end function tangency_bounded_gaps

    ! Do the interiors meet? Exact.
    !   bodies: as they were made
    !   pairs: places of A and B among the bodies, from 0. NULL: of pair k those of bodies k and
    !   count + k (2 a row)
    !   count: pairs
    !   separations: c_B - c_A in place of that of the centres, as for periodic images; NULL: of
    !   the centres (3 a row, unit: length)
    !   answers: 1 or 0, count of them
    !   threads: that may work on it; below 1 counts as 1
    function tangency_overlaps(bodies, pairs, count, separations, answers, threads) bind(c, &
        name="tangency_overlaps") result(code)
      use, intrinsic :: iso_c_binding
      type(c_ptr), value :: bodies
      integer(c_int), intent(in), optional :: pairs(2,*)
      integer(c_size_t), value :: count
      real(c_double), intent(in), optional :: separations(3,*)
      integer(c_signed_char), intent(inout) :: answers(*)
      integer(c_int), value :: threads
      integer(c_int) :: code
    end function tangency_overlaps

    ! The same in bounded time: 2 where only integers would know. Of bodies by matrices also
    ! where their rounding to semi-axes leaves it open.
    !   bodies: as they were made
    !   pairs: places of A and B among the bodies, from 0. NULL: of pair k those of bodies k and
    !   count + k (2 a row)
    !   count: pairs
    !   separations: c_B - c_A in place of that of the centres, as for periodic images; NULL: of
    !   the centres (3 a row, unit: length)
    !   answers: 1, 0 or 2, count of them
    !   threads: that may work on it; below 1 counts as 1
    function tangency_overlaps_by_filter(bodies, pairs, count, separations, answers, threads) &
        bind(c, name="tangency_overlaps_by_filter") result(code)
      use, intrinsic :: iso_c_binding
      type(c_ptr), value :: bodies
      integer(c_int), intent(in), optional :: pairs(2,*)
      integer(c_size_t), value :: count
      real(c_double), intent(in), optional :: separations(3,*)
      integer(c_signed_char), intent(inout) :: answers(*)
      integer(c_int), value :: threads
      integer(c_int) :: code
    end function tangency_overlaps_by_filter

    ! How pairs lie, as point sets: exact.
    !   bodies: as they were made
    !   pairs: places of A and B among the bodies, from 0. NULL: of pair k those of bodies k and
    !   count + k (2 a row)
    !   count: pairs
    !   separations: c_B - c_A in place of that of the centres, as for periodic images; NULL: of
    !   the centres (3 a row, unit: length)
    !   answers: each column count rows, or NULL: not asked for
    !   threads: that may work on it; below 1 counts as 1
    function tangency_relations(bodies, pairs, count, separations, answers, threads) bind(c, &
        name="tangency_relations") result(code)
      use, intrinsic :: iso_c_binding
      import :: tangency_relation_columns
      type(c_ptr), value :: bodies
      integer(c_int), intent(in), optional :: pairs(2,*)
      integer(c_size_t), value :: count
      real(c_double), intent(in), optional :: separations(3,*)
      type(tangency_relation_columns), intent(in) :: answers
      integer(c_int), value :: threads
      integer(c_int) :: code
    end function tangency_relations

    ! The gap by another definition, to tell a difference of definition from an error. Where a
    ! body is by a matrix, gap_error is infinite: how far its rounding to semi-axes moves these
    ! gaps is not bounded.
    !   bodies: as they were made
    !   pairs: places of A and B among the bodies, from 0. NULL: of pair k those of bodies k and
    !   count + k (2 a row)
    !   count: pairs
    !   separations: c_B - c_A in place of that of the centres, as for periodic images; NULL: of
    !   the centres (3 a row, unit: length)
    !   definition: tangency_definition
    !   answers: each column count rows, or NULL: not asked for
    !   threads: that may work on it; below 1 counts as 1
    function tangency_other_gaps(bodies, pairs, count, separations, definition, answers, &
        threads) bind(c, name="tangency_other_gaps") result(code)
      use, intrinsic :: iso_c_binding
      import :: tangency_other_gap_columns
      type(c_ptr), value :: bodies
      integer(c_int), intent(in), optional :: pairs(2,*)
      integer(c_size_t), value :: count
      real(c_double), intent(in), optional :: separations(3,*)
      integer(c_int), value :: definition
      type(tangency_other_gap_columns), intent(in) :: answers
      integer(c_int), value :: threads
      integer(c_int) :: code
    end function tangency_other_gaps

    ! The Perram-Wertheim contact function.
    !   bodies: as they were made
    !   pairs: places of A and B among the bodies, from 0. NULL: of pair k those of bodies k and
    !   count + k (2 a row)
    !   count: pairs
    !   separations: c_B - c_A in place of that of the centres, as for periodic images; NULL: of
    !   the centres (3 a row, unit: length)
    !   answers: each column count rows, or NULL: not asked for
    !   threads: that may work on it; below 1 counts as 1
    function tangency_perram_wertheim_factors(bodies, pairs, count, separations, answers, &
        threads) bind(c, name="tangency_perram_wertheim_factors") result(code)
      use, intrinsic :: iso_c_binding
      import :: tangency_factor_columns
      type(c_ptr), value :: bodies
      integer(c_int), intent(in), optional :: pairs(2,*)
      integer(c_size_t), value :: count
      real(c_double), intent(in), optional :: separations(3,*)
      type(tangency_factor_columns), intent(in) :: answers
      integer(c_int), value :: threads
      integer(c_int) :: code
    end function tangency_perram_wertheim_factors

    ! First and second derivatives of the gap. Of a body by a matrix those by its semi-axes are
    ! NaN. A pair beyond a cutoff is degenerate.
    !   bodies: as they were made
    !   pairs: places of A and B among the bodies, from 0. NULL: of pair k those of bodies k and
    !   count + k (2 a row)
    !   count: pairs
    !   separations: c_B - c_A in place of that of the centres, as for periodic images; NULL: of
    !   the centres (3 a row, unit: length)
    !   normals: of tangency_contacts() for the same pairs (3 a row)
    !   statuses: of tangency_contacts() for the same pairs
    !   answers: each column count rows, or NULL: not asked for
    !   threads: that may work on it; below 1 counts as 1
    function tangency_gap_derivatives(bodies, pairs, count, separations, normals, statuses, &
        answers, threads) bind(c, name="tangency_gap_derivatives") result(code)
      use, intrinsic :: iso_c_binding
      import :: tangency_derivative_columns
      type(c_ptr), value :: bodies
      integer(c_int), intent(in), optional :: pairs(2,*)
      integer(c_size_t), value :: count
      real(c_double), intent(in), optional :: separations(3,*)
      real(c_double), intent(in) :: normals(3,*)
      integer(c_int), intent(in) :: statuses(*)
      type(tangency_derivative_columns), intent(in) :: answers
      integer(c_int), value :: threads
      integer(c_int) :: code
    end function tangency_gap_derivatives

    ! Curvatures where two bodies touch, of pairs whose longest semi-axis is at most 1e70 times
    ! the shortest.
    !   bodies: as they were made
    !   pairs: places of A and B among the bodies, from 0. NULL: of pair k those of bodies k and
    !   count + k (2 a row)
    !   count: pairs
    !   normals: of tangency_contacts() for the same pairs, unit (3 a row)
    !   answers: each column count rows, or NULL: not asked for
    !   threads: that may work on it; below 1 counts as 1
    function tangency_contact_curvatures(bodies, pairs, count, normals, answers, threads) &
        bind(c, name="tangency_contact_curvatures") result(code)
      use, intrinsic :: iso_c_binding
      import :: tangency_curvature_columns
      type(c_ptr), value :: bodies
      integer(c_int), intent(in), optional :: pairs(2,*)
      integer(c_size_t), value :: count
      real(c_double), intent(in) :: normals(3,*)
      type(tangency_curvature_columns), intent(in) :: answers
      integer(c_int), value :: threads
      integer(c_int) :: code
    end function tangency_contact_curvatures

    ! The volume that two bodies have in common, and its gradient.
    !   bodies: as they were made
    !   pairs: places of A and B among the bodies, from 0. NULL: of pair k those of bodies k and
    !   count + k (2 a row)
    !   count: pairs
    !   separations: c_B - c_A in place of that of the centres, as for periodic images; NULL: of
    !   the centres (3 a row, unit: length)
    !   tolerance: of the error over the smaller body's volume; > 0, 1e-12 is usual
    !   answers: each column count rows, or NULL: not asked for
    !   threads: that may work on it; below 1 counts as 1
    function tangency_common_volumes(bodies, pairs, count, separations, tolerance, answers, &
        threads) bind(c, name="tangency_common_volumes") result(code)
      use, intrinsic :: iso_c_binding
      import :: tangency_volume_columns
      type(c_ptr), value :: bodies
      integer(c_int), intent(in), optional :: pairs(2,*)
      integer(c_size_t), value :: count
      real(c_double), intent(in), optional :: separations(3,*)
      real(c_double), value :: tolerance
      type(tangency_volume_columns), intent(in) :: answers
      integer(c_int), value :: threads
      integer(c_int) :: code
    end function tangency_common_volumes

    ! How far A lies inside B: a length and a factor.
    !   bodies: as they were made
    !   pairs: places of A and B among the bodies, from 0. NULL: of pair k those of bodies k and
    !   count + k (2 a row)
    !   count: pairs
    !   separations: c_B - c_A in place of that of the centres, as for periodic images; NULL: of
    !   the centres (3 a row, unit: length)
    !   answers: each column count rows, or NULL: not asked for
    !   threads: that may work on it; below 1 counts as 1
    function tangency_containments(bodies, pairs, count, separations, answers, threads) bind(c, &
        name="tangency_containments") result(code)
      use, intrinsic :: iso_c_binding
      import :: tangency_containment_columns
      type(c_ptr), value :: bodies
      integer(c_int), intent(in), optional :: pairs(2,*)
      integer(c_size_t), value :: count
      real(c_double), intent(in), optional :: separations(3,*)
      type(tangency_containment_columns), intent(in) :: answers
      integer(c_int), value :: threads
      integer(c_int) :: code
    end function tangency_containments

    ! First contact of moving bodies in 0 <= t <= horizon.
    !   bodies: as they were made
    !   pairs: places of A and B among the bodies, from 0. NULL: of pair k those of bodies k and
    !   count + k (2 a row)
    !   count: pairs
    !   separations: c_B - c_A in place of that of the centres, as for periodic images; NULL: of
    !   the centres (3 a row, unit: length)
    !   motions: of each body: velocity of the pivot, angular velocity in space (rad per time),
    !   centre less pivot; finite (9 a row)
    !   horizon: finite, >= 0 (unit: time)
    !   tolerance: > 0 (unit: time)
    !   answers: each column count rows, or NULL: not asked for
    !   threads: that may work on it; below 1 counts as 1
    function tangency_times_of_contact(bodies, pairs, count, separations, motions, horizon, &
        tolerance, answers, threads) bind(c, name="tangency_times_of_contact") result(code)
      use, intrinsic :: iso_c_binding
      import :: tangency_time_columns
      type(c_ptr), value :: bodies
      integer(c_int), intent(in), optional :: pairs(2,*)
      integer(c_size_t), value :: count
      real(c_double), intent(in), optional :: separations(3,*)
      real(c_double), intent(in) :: motions(9,*)
      real(c_double), value :: horizon
      real(c_double), value :: tolerance
      type(tangency_time_columns), intent(in) :: answers
      integer(c_int), value :: threads
      integer(c_int) :: code
    end function tangency_times_of_contact

    ! Bodies against walls, the solid half-spaces normal . x <= offset.
    !   bodies: as they were made
    !   walls: normal of any length but 0, out of the wall, and offset (4 a row)
    !   walls_count: how many walls
    !   sheets: not 0: walls without thickness, free on both sides
    !   pairs: places of a body and of another thing, from 0. NULL: of pair k both are k (2 a
    !   row)
    !   count: pairs; without places at most the number of bodies and that of the others
    !   answers: each column count rows, or NULL: not asked for
    !   threads: that may work on it; below 1 counts as 1
    function tangency_walls(bodies, walls, walls_count, sheets, pairs, count, answers, threads) &
        bind(c, name="tangency_walls") result(code)
      use, intrinsic :: iso_c_binding
      import :: tangency_wall_columns
      type(c_ptr), value :: bodies
      real(c_double), intent(in) :: walls(4,*)
      integer(c_size_t), value :: walls_count
      integer(c_int), value :: sheets
      integer(c_int), intent(in), optional :: pairs(2,*)
      integer(c_size_t), value :: count
      type(tangency_wall_columns), intent(in) :: answers
      integer(c_int), value :: threads
      integer(c_int) :: code
    end function tangency_walls

    ! Closest points of surfaces, and signed distances.
    !   bodies: as they were made
    !   points: finite (3 a row, unit: length)
    !   points_count: how many points
    !   pairs: places of a body and of another thing, from 0. NULL: of pair k both are k (2 a
    !   row)
    !   count: pairs; without places at most the number of bodies and that of the others
    !   answers: each column count rows, or NULL: not asked for
    !   threads: that may work on it; below 1 counts as 1
    function tangency_points(bodies, points, points_count, pairs, count, answers, threads) &
        bind(c, name="tangency_points") result(code)
      use, intrinsic :: iso_c_binding
      import :: tangency_point_columns
      type(c_ptr), value :: bodies
      real(c_double), intent(in) :: points(3,*)
      integer(c_size_t), value :: points_count
      integer(c_int), intent(in), optional :: pairs(2,*)
      integer(c_size_t), value :: count
      type(tangency_point_columns), intent(in) :: answers
      integer(c_int), value :: threads
      integer(c_int) :: code
    end function tangency_points

    ! Contacts of bodies (A) and spheres (B). Of bodies by matrices the sign is known where the
    ! gap is beyond gap_error.
    !   bodies: as they were made
    !   balls: centre, and radius >= 0 (4 a row, unit: length)
    !   balls_count: how many balls
    !   pairs: places of a body and of another thing, from 0. NULL: of pair k both are k (2 a
    !   row)
    !   count: pairs; without places at most the number of bodies and that of the others
    !   answers: each column count rows, or NULL: not asked for
    !   threads: that may work on it; below 1 counts as 1
    function tangency_balls(bodies, balls, balls_count, pairs, count, answers, threads) bind(c, &
        name="tangency_balls") result(code)
      use, intrinsic :: iso_c_binding
      import :: tangency_contact_columns
      type(c_ptr), value :: bodies
      real(c_double), intent(in) :: balls(4,*)
      integer(c_size_t), value :: balls_count
      integer(c_int), intent(in), optional :: pairs(2,*)
      integer(c_size_t), value :: count
      type(tangency_contact_columns), intent(in) :: answers
      integer(c_int), value :: threads
      integer(c_int) :: code
    end function tangency_balls

    ! Where rays, segments and lines meet surfaces: whether they do is exact.
    !   bodies: as they were made
    !   rays: origin, direction of any length but 0, and the ends of the interval of t, which
    !   may be infinite (8 a row)
    !   rays_count: how many rays
    !   pairs: places of a body and of another thing, from 0. NULL: of pair k both are k (2 a
    !   row)
    !   count: pairs; without places at most the number of bodies and that of the others
    !   answers: each column count rows, or NULL: not asked for
    !   threads: that may work on it; below 1 counts as 1
    function tangency_rays(bodies, rays, rays_count, pairs, count, answers, threads) bind(c, &
        name="tangency_rays") result(code)
      use, intrinsic :: iso_c_binding
      import :: tangency_ray_columns
      type(c_ptr), value :: bodies
      real(c_double), intent(in) :: rays(8,*)
      integer(c_size_t), value :: rays_count
      integer(c_int), intent(in), optional :: pairs(2,*)
      integer(c_size_t), value :: count
      type(tangency_ray_columns), intent(in) :: answers
      integer(c_int), value :: threads
      integer(c_int) :: code
    end function tangency_rays

    ! All pairs of images whose gap is at most a reach, in ascending order.
    !   neighbours: to be destroyed with tangency_neighbours_destroy()
    !   bodies: as they were made
    !   question: which pairs, and which answers
    !   accuracy: of gaps; NULL: to rounding
    !   threads: that may work on it; below 1 counts as 1
    function tangency_neighbours_create(neighbours, bodies, question, accuracy, threads) bind(c, &
        name="tangency_neighbours_create") result(code)
      use, intrinsic :: iso_c_binding
      import :: tangency_accuracy, tangency_neighbour_question
      type(c_ptr), intent(out) :: neighbours
      type(c_ptr), value :: bodies
      type(tangency_neighbour_question), intent(in) :: question
      type(tangency_accuracy), intent(in), optional :: accuracy
      integer(c_int), value :: threads
      integer(c_int) :: code
    end function tangency_neighbours_create

    ! How many pairs there are.
    !   neighbours: as they were made
    function tangency_neighbours_count(neighbours) bind(c, name="tangency_neighbours_count") &
        result(code)
      use, intrinsic :: iso_c_binding
      type(c_ptr), value :: neighbours
      integer(c_size_t) :: code
    end function tangency_neighbours_count

    ! Their columns.
    !   neighbours: as they were made
    !   columns: its size is set before
    function tangency_neighbours_columns(neighbours, columns) bind(c, &
        name="tangency_neighbours_columns") result(code)
      use, intrinsic :: iso_c_binding
      import :: tangency_neighbour_columns
      type(c_ptr), value :: neighbours
      type(tangency_neighbour_columns), intent(inout) :: columns
      integer(c_int) :: code
    end function tangency_neighbours_columns

    ! Ends them; NULL does nothing.
    !   neighbours: as they were made
    subroutine tangency_neighbours_destroy(neighbours) bind(c, &
        name="tangency_neighbours_destroy")
      use, intrinsic :: iso_c_binding
      type(c_ptr), value :: neighbours
    end subroutine tangency_neighbours_destroy

    ! Ellipses of rows of numbers, which are copied.
    !   ellipses: to be destroyed with tangency_ellipses_destroy()
    !   form: tangency_plane_form
    !   rows: the numbers of the first row, side by side
    !   number: their type, tangency_number
    !   count: rows
    !   stride: from one row to the next; may be negative (unit: bytes)
    !   level: of forms shape and precision, > 0; else 1
    function tangency_ellipses_create(ellipses, form, rows, number, count, stride, level) &
        bind(c, name="tangency_ellipses_create") result(code)
      use, intrinsic :: iso_c_binding
      type(c_ptr), intent(out) :: ellipses
      integer(c_int), value :: form
      type(c_ptr), value :: rows
      integer(c_int), value :: number
      integer(c_size_t), value :: count
      integer(c_ptrdiff_t), value :: stride
      real(c_double), value :: level
      integer(c_int) :: code
    end function tangency_ellipses_create

    ! More ellipses behind those there are.
    !   ellipses: as they were made
    !   form: tangency_plane_form
    !   rows: the numbers of the first row, side by side
    !   number: their type, tangency_number
    !   count: rows
    !   stride: from one row to the next; may be negative (unit: bytes)
    !   level: as above
    function tangency_ellipses_append(ellipses, form, rows, number, count, stride, level) &
        bind(c, name="tangency_ellipses_append") result(code)
      use, intrinsic :: iso_c_binding
      type(c_ptr), value :: ellipses
      integer(c_int), value :: form
      type(c_ptr), value :: rows
      integer(c_int), value :: number
      integer(c_size_t), value :: count
      integer(c_ptrdiff_t), value :: stride
      real(c_double), value :: level
      integer(c_int) :: code
    end function tangency_ellipses_append

    ! How many there are.
    !   ellipses: as they were made
    function tangency_ellipses_count(ellipses) bind(c, name="tangency_ellipses_count") &
        result(code)
      use, intrinsic :: iso_c_binding
      type(c_ptr), value :: ellipses
      integer(c_size_t) :: code
    end function tangency_ellipses_count

    ! Ends them; NULL does nothing.
    !   ellipses: as they were made
    subroutine tangency_ellipses_destroy(ellipses) bind(c, name="tangency_ellipses_destroy")
      use, intrinsic :: iso_c_binding
      type(c_ptr), value :: ellipses
    end subroutine tangency_ellipses_destroy

    ! All questions about pairs of ellipses.
    !   ellipses: as they were made
    !   pairs: as of tangency_contacts() (2 a row)
    !   count: pairs
    !   answers: each column count rows, or NULL: not asked for
    !   threads: that may work on it; below 1 counts as 1
    function tangency_plane_contacts(ellipses, pairs, count, answers, threads) bind(c, &
        name="tangency_plane_contacts") result(code)
      use, intrinsic :: iso_c_binding
      import :: tangency_plane_contact_columns
      type(c_ptr), value :: ellipses
      integer(c_int), intent(in), optional :: pairs(2,*)
      integer(c_size_t), value :: count
      type(tangency_plane_contact_columns), intent(in) :: answers
      integer(c_int), value :: threads
      integer(c_int) :: code
    end function tangency_plane_contacts

    ! Closest points of boundaries, and signed distances.
    !   ellipses: as they were made
    !   points: finite (2 a row, unit: length)
    !   points_count: how many points
    !   pairs: places of a body and of another thing, from 0. NULL: of pair k both are k (2 a
    !   row)
    !   count: pairs; without places at most the number of bodies and that of the others
    !   answers: each column count rows, or NULL: not asked for
    !   threads: that may work on it; below 1 counts as 1
    function tangency_plane_points(ellipses, points, points_count, pairs, count, answers, &
        threads) bind(c, name="tangency_plane_points") result(code)
      use, intrinsic :: iso_c_binding
      import :: tangency_plane_point_columns
      type(c_ptr), value :: ellipses
      real(c_double), intent(in) :: points(2,*)
      integer(c_size_t), value :: points_count
      integer(c_int), intent(in), optional :: pairs(2,*)
      integer(c_size_t), value :: count
      type(tangency_plane_point_columns), intent(in) :: answers
      integer(c_int), value :: threads
      integer(c_int) :: code
    end function tangency_plane_points

    ! The type of quadrics, exact: rows A B C D E F G H J K as of form quadric.
    !   coefficients: of the first row
    !   count: quadrics
    !   stride: from one row to the next (unit: bytes)
    !   answers: each column count rows, or NULL: not asked for
    !   threads: that may work on it; below 1 counts as 1
    function tangency_classify(coefficients, count, stride, answers, threads) bind(c, &
        name="tangency_classify") result(code)
      use, intrinsic :: iso_c_binding
      import :: tangency_quadric_columns
      real(c_double), intent(in) :: coefficients(*)
      integer(c_size_t), value :: count
      integer(c_ptrdiff_t), value :: stride
      type(tangency_quadric_columns), intent(in) :: answers
      integer(c_int), value :: threads
      integer(c_int) :: code
    end function tangency_classify

  end interface

contains

  ! The text at a pointer to C's characters, as of tangency_error_message().
  function tangency_text(from) result(text)
    type(c_ptr), intent(in) :: from
    character(len=:), allocatable :: text
    character(kind=c_char), pointer :: letters(:)
    integer :: length
    text = ""
    if (.not. c_associated(from)) return
    call c_f_pointer(from, letters, [4096])
    do length = 1, 4096
      if (letters(length) == c_null_char) exit
      text = text // letters(length)
    end do
  end function tangency_text

end module tangency
