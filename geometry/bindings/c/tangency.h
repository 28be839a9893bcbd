/* SPDX-License-Identifier: MIT */
/* Made by geometry/bindings/generate.py of table.py. Change those. */
/** @file
 * How ellipsoids touch, exactly: the interface in C (C89).
 *
 * A right-handed frame; lengths in any one unit; a gap > 0 is a distance, a gap < 0 minus a
 * penetration depth; normals point from A to B. Rows and indices count from 0. Every struct
 * begins with its size, which the caller sets to sizeof; what is NULL in it is not asked for. A
 * call returns TANGENCY_OK, or says why not in tangency_error_message(); then columns of answers
 * mean nothing. No call ends the process for numbers it is handed; where memory ends within an
 * exact answer, the process ends. Any number of threads may ask about the same bodies while none
 * changes them.
 */
#ifndef TANGENCY_H
#define TANGENCY_H

#include <stddef.h>

#ifndef TANGENCY_API
#if defined(__GNUC__)
#define TANGENCY_API __attribute__((visibility("default")))
#else
#define TANGENCY_API
#endif
#endif

#ifdef __cplusplus
extern "C" {
#endif

/** Ellipsoids that questions are asked about. */
typedef struct tangency_bodies tangency_bodies;

/** Ellipses in the plane. */
typedef struct tangency_ellipses tangency_ellipses;

/** A list of neighbours and its answers. */
typedef struct tangency_neighbours tangency_neighbours;

/**
 * What a call returns. Where it is not OK nothing was answered, and tangency_error_message() says
 * why.
 */
enum tangency_code {
  TANGENCY_OK = 0,
  /**
   * a row of numbers makes no body, wall, point or pair: message and tangency_error_row() name it
   */
  TANGENCY_BAD_ROW = 1,
  /** another argument is not what it has to be */
  TANGENCY_BAD_ARGUMENT = 2,
  TANGENCY_OUT_OF_MEMORY = 3,
  /** an error of this library: please report it */
  TANGENCY_INTERNAL = 4
};

/** The type of the numbers of rows. */
enum tangency_number {
  TANGENCY_NUMBER_DOUBLE = 0,
  TANGENCY_NUMBER_FLOAT = 1
};

/** How a row gives an ellipsoid. */
enum tangency_form {
  /**
   * 10 numbers x y z r1 r2 r3 qw qx qy qz: centre, semi-axes > 0 in any order, and a quaternion
   * of any length but 0 that turns body axes into space axes
   */
  TANGENCY_FORM_AXES = 0,
  /**
   * 9 numbers x y z xx yy zz xy yz zx: centre and shape matrix M, length^2, of the body (p-c)'
   * M^-1 (p-c) <= level
   */
  TANGENCY_FORM_SHAPE = 1,
  /** the same 9 with the inverse of M, length^-2 */
  TANGENCY_FORM_PRECISION = 2,
  /** 12 numbers: centre, and the vectors of the three semi-axes, at right angles */
  TANGENCY_FORM_VECTORS = 3,
  /**
   * 10 numbers A B C D E F G H J K: A x^2 + B y^2 + C z^2 + 2D xy + 2E yz + 2F zx + 2G x + 2H y +
   * 2J z + K = 0, the inside of a real ellipsoid
   */
  TANGENCY_FORM_QUADRIC = 4
};

/** How a row gives an ellipse. */
enum tangency_plane_form {
  /**
   * 6 numbers x y r1 r2 ux uy: centre, semi-axes > 0, and the direction of the first, of any
   * length but 0
   */
  TANGENCY_PLANE_FORM_DIRECTION = 0,
  /** 5 numbers x y r1 r2 angle: the angle of the first axis, rad */
  TANGENCY_PLANE_FORM_ANGLE = 1,
  /** 5 numbers x y xx yy xy: centre and shape matrix, length^2 */
  TANGENCY_PLANE_FORM_SHAPE = 2,
  /** the same 5 with the inverse of the matrix, length^-2 */
  TANGENCY_PLANE_FORM_PRECISION = 3,
  /** 6 numbers A B C D E F: A x^2 + B xy + C y^2 + D x + E y + F = 0 */
  TANGENCY_PLANE_FORM_CONIC = 4
};

/** How two solids lie, as point sets: exact for the numbers as they are given. */
enum tangency_relation {
  /** no common point */
  TANGENCY_RELATION_SEPARATE = 0,
  /** common points, interiors disjoint */
  TANGENCY_RELATION_EXTERNAL_TOUCH = 1,
  /** every other pair */
  TANGENCY_RELATION_OVERLAP = 2,
  /** one inside the other, not equal, boundaries meeting */
  TANGENCY_RELATION_INTERNAL_TOUCH = 3,
  /** A inside the interior of B */
  TANGENCY_RELATION_A_IN_B = 4,
  /** B inside the interior of A */
  TANGENCY_RELATION_B_IN_A = 5,
  TANGENCY_RELATION_EQUAL = 6
};

/** The body inside, where the relation is internal_touch. */
enum tangency_inner {
  TANGENCY_INNER_NONE = 0,
  TANGENCY_INNER_A = 1,
  TANGENCY_INNER_B = 2
};

/** What knew the answer. Both give the same one. */
enum tangency_tier {
  /** arithmetic in double with a proven bound */
  TANGENCY_TIER_FILTER = 0,
  /** integers */
  TANGENCY_TIER_EXACT = 1
};

/** What is known of a gap, distance or clearance. */
enum tangency_status {
  /** the global answer, proven */
  TANGENCY_STATUS_OK = 0,
  /** a stationary answer; that none is better elsewhere is not proven */
  TANGENCY_STATUS_LOCAL = 1,
  /** above accuracy.cutoff: gap is a lower bound, gap_error infinite, the rest 0 */
  TANGENCY_STATUS_BEYOND = 2
};

/** Which method gave the answer, the cheapest first. */
enum tangency_gap_tier {
  TANGENCY_GAP_TIER_FAST = 0,
  TANGENCY_GAP_TIER_SAFEGUARDED = 1,
  TANGENCY_GAP_TIER_FACTORED = 2,
  TANGENCY_GAP_TIER_SEARCH = 3,
  /** any of these, and the exact relation decided the sign */
  TANGENCY_GAP_TIER_EXACT = 4
};

/** Definitions of a gap other than the common normal's. */
enum tangency_definition {
  /** the distance of the tangent planes along the Perram-Wertheim normal */
  TANGENCY_DEFINITION_PERRAM_WERTHEIM = 0,
  /** along that normal through the point of equal potentials */
  TANGENCY_DEFINITION_MIDPOINT_POTENTIAL = 1,
  /** the published scheme of curves; no gap_error */
  TANGENCY_DEFINITION_TRACE = 2
};

/** What is known of an answer by another definition. Numbers are 0 unless ok. */
enum tangency_other_status {
  TANGENCY_OTHER_STATUS_OK = 0,
  /** the definition says nothing about this pair */
  TANGENCY_OTHER_STATUS_NOT_APPLICABLE = 1,
  /** not known well enough */
  TANGENCY_OTHER_STATUS_NOT_CONVERGED = 2
};

/** Of what the derivatives are. They are 0 for tie and degenerate. */
enum tangency_derivative_status {
  /** of the gap */
  TANGENCY_DERIVATIVE_STATUS_OK = 0,
  /** of the branch of a local gap */
  TANGENCY_DERIVATIVE_STATUS_LOCAL = 1,
  /** two normals reach equally far: there is no derivative */
  TANGENCY_DERIVATIVE_STATUS_TIE = 2,
  /** the best normal is not safely isolated */
  TANGENCY_DERIVATIVE_STATUS_DEGENERATE = 3
};

/** Whether the errors of a common volume are within the tolerance. */
enum tangency_volume_status {
  TANGENCY_VOLUME_STATUS_OK = 0,
  /** they are not, and still hold */
  TANGENCY_VOLUME_STATUS_TOLERANCE_NOT_REACHED = 1
};

/** What a ray meets. */
enum tangency_ray_status {
  /** no point of the surface in the interval */
  TANGENCY_RAY_STATUS_MISS = 0,
  /** one or two points */
  TANGENCY_RAY_STATUS_HIT = 1,
  /** the line touches the surface in one point, exactly */
  TANGENCY_RAY_STATUS_GRAZING = 2
};

/** What is known of the first contact. */
enum tangency_time_status {
  /** apart throughout [0, horizon] */
  TANGENCY_TIME_STATUS_NONE = 0,
  /** apart before `time`, in contact at some moment of [time, latest] */
  TANGENCY_TIME_STATUS_CONTACT = 1,
  /** a common point at t = 0: exact */
  TANGENCY_TIME_STATUS_TOUCHING_AT_START = 2,
  /** apart before `time`, when they are too close for rounding to tell */
  TANGENCY_TIME_STATUS_GRAZING = 3,
  /** apart before `time`; the rest was not looked at */
  TANGENCY_TIME_STATUS_NOT_CONVERGED = 4
};

/** What is wanted of each pair of neighbours. Each adds to those before it. */
enum tangency_neighbour_answers {
  /** which there are */
  TANGENCY_NEIGHBOUR_ANSWERS_PAIRS = 0,
  /** do the interiors meet? */
  TANGENCY_NEIGHBOUR_ANSWERS_OVERLAPS = 1,
  /** gap, gap_error, status */
  TANGENCY_NEIGHBOUR_ANSWERS_GAPS = 2,
  /** normal, arms and the separation */
  TANGENCY_NEIGHBOUR_ANSWERS_CONTACTS = 3
};

/** Whether the chord between two crossings is defined. */
enum tangency_chord_status {
  TANGENCY_CHORD_STATUS_OK = 0,
  /** the boundaries do not cross in exactly two points */
  TANGENCY_CHORD_STATUS_NOT_APPLICABLE = 1
};

/** What a quadric is, exactly. */
enum tangency_quadric_type {
  TANGENCY_QUADRIC_TYPE_REAL_ELLIPSOID = 0,
  TANGENCY_QUADRIC_TYPE_IMAGINARY_ELLIPSOID = 1,
  TANGENCY_QUADRIC_TYPE_HYPERBOLOID_ONE_SHEET = 2,
  TANGENCY_QUADRIC_TYPE_HYPERBOLOID_TWO_SHEETS = 3,
  TANGENCY_QUADRIC_TYPE_ELLIPTIC_PARABOLOID = 4,
  TANGENCY_QUADRIC_TYPE_HYPERBOLIC_PARABOLOID = 5,
  TANGENCY_QUADRIC_TYPE_REAL_ELLIPTIC_CONE = 6,
  TANGENCY_QUADRIC_TYPE_IMAGINARY_ELLIPTIC_CONE = 7,
  TANGENCY_QUADRIC_TYPE_REAL_ELLIPTIC_CYLINDER = 8,
  TANGENCY_QUADRIC_TYPE_IMAGINARY_ELLIPTIC_CYLINDER = 9,
  TANGENCY_QUADRIC_TYPE_HYPERBOLIC_CYLINDER = 10,
  TANGENCY_QUADRIC_TYPE_PARABOLIC_CYLINDER = 11,
  TANGENCY_QUADRIC_TYPE_REAL_INTERSECTING_PLANES = 12,
  TANGENCY_QUADRIC_TYPE_IMAGINARY_INTERSECTING_PLANES = 13,
  TANGENCY_QUADRIC_TYPE_REAL_PARALLEL_PLANES = 14,
  TANGENCY_QUADRIC_TYPE_IMAGINARY_PARALLEL_PLANES = 15,
  TANGENCY_QUADRIC_TYPE_COINCIDENT_PLANES = 16,
  TANGENCY_QUADRIC_TYPE_PLANE = 17,
  TANGENCY_QUADRIC_TYPE_NO_POINTS = 18,
  TANGENCY_QUADRIC_TYPE_ALL_SPACE = 19
};

/**
 * How good a gap has to be. Sign, status and gap_error are proven at any; 0 everywhere, and NULL,
 * is the gap to rounding and its normal to some 1e-8 rad.
 */
typedef struct tangency_accuracy {
  /** sizeof(this struct) */
  size_t size;
  /** tolerance in parts of the size of the pair, >= 0 */
  double of_size;
  /** tolerance, >= 0 (unit: length) */
  double length;
  /** not 0: normals and points to rounding too */
  int normals;
  /**
   * not 0: no answer is wanted of pairs whose gap is above cutoff; must be 0 for bodies by
   * matrices
   */
  int has_cutoff;
  /** >= 0; not read where has_cutoff is 0 (unit: length) */
  double cutoff;
} tangency_accuracy;

/** Answers of tangency_contacts(). */
typedef struct tangency_contact_columns {
  /** sizeof(this struct) */
  size_t size;
  /** > 0: the distance; < 0: minus the penetration depth (unit: length) */
  double* gap;
  /**
   * proven: |gap - true gap| is at most this where the status is ok; where it is local the true
   * gap is at least gap - gap_error (unit: length)
   */
  double* gap_error;
  /** unit, from A to B (3 a row) */
  double* normal;
  /** A's witness point less A's centre (3 a row, unit: length) */
  double* arm_a;
  /** B's witness point less B's centre (3 a row, unit: length) */
  double* arm_b;
  /** tangency_status */
  int* status;
  /** tangency_gap_tier */
  int* tier;
  /**
   * the contact point, midway between the witness points, less A's centre (3 a row, unit: length)
   */
  double* point;
  /** proven: of |normal - true normal|; 2 where nothing is */
  double* normal_bound;
  /** proven: of |arm_a - true arm_a| (unit: length) */
  double* arm_a_bound;
  /** proven: of |arm_b - true arm_b| (unit: length) */
  double* arm_b_bound;
} tangency_contact_columns;

/** Answers of tangency_bounded_gaps(). */
typedef struct tangency_bounded_columns {
  /** sizeof(this struct) */
  size_t size;
  /** > 0: the distance; < 0: minus the penetration depth (unit: length) */
  double* gap;
  /**
   * proven: |gap - true gap| is at most this where the status is ok; where it is local the true
   * gap is at least gap - gap_error (unit: length)
   */
  double* gap_error;
  /** unit, from A to B (3 a row) */
  double* normal;
  /** A's witness point less A's centre (3 a row, unit: length) */
  double* arm_a;
  /** B's witness point less B's centre (3 a row, unit: length) */
  double* arm_b;
  /** tangency_status */
  int* status;
  /** tangency_gap_tier */
  int* tier;
  /**
   * the contact point, midway between the witness points, less A's centre (3 a row, unit: length)
   */
  double* point;
  /** gap - gap_error <= true gap <= gap + above (unit: length) */
  double* above;
} tangency_bounded_columns;

/** Answers of tangency_relations(). */
typedef struct tangency_relation_columns {
  /** sizeof(this struct) */
  size_t size;
  /** tangency_relation */
  int* relation;
  /** tangency_inner */
  int* inner;
  /** tangency_tier */
  int* tier;
} tangency_relation_columns;

/** Answers of tangency_other_gaps(). */
typedef struct tangency_other_gap_columns {
  /** sizeof(this struct) */
  size_t size;
  /** > 0: the distance; < 0: minus the penetration depth (unit: length) */
  double* gap;
  /**
   * proven: |gap - true gap| is at most this where the status is ok; where it is local the true
   * gap is at least gap - gap_error (unit: length)
   */
  double* gap_error;
  /** unit, from A to B (3 a row) */
  double* normal;
  /** A's witness point less A's centre (3 a row, unit: length) */
  double* arm_a;
  /** B's witness point less B's centre (3 a row, unit: length) */
  double* arm_b;
  /** tangency_other_status */
  int* status;
} tangency_other_gap_columns;

/** Answers of tangency_perram_wertheim_factors(). */
typedef struct tangency_factor_columns {
  /** sizeof(this struct) */
  size_t size;
  /** F >= 0: > 1 apart, 1 touching, < 1 overlapping */
  double* factor;
  /** proven: of |factor - F| */
  double* factor_error;
  /** mu = sqrt F: both bodies, scaled by it about their centres, touch */
  double* scale;
  /** proven: of |scale - mu| */
  double* scale_error;
  /** tangency_other_status */
  int* status;
} tangency_factor_columns;

/**
 * Answers of tangency_gap_derivatives(). Parameters, 18 in this order: centre, rotation vector in
 * space (rad) and semi-axes of A, then of B.
 */
typedef struct tangency_derivative_columns {
  /** sizeof(this struct) */
  size_t size;
  /** first derivatives of the gap (18 a row, unit: length/parameter) */
  double* gradient;
  /** second derivatives, symmetric (18x18 a row, unit: length/parameter^2) */
  double* hessian;
  /** how sharp the best normal is (unit: length) */
  double* least_radius;
  /** tangency_derivative_status */
  int* status;
} tangency_derivative_columns;

/**
 * Answers of tangency_contact_curvatures(): principal curvatures, the larger first, and their
 * directions.
 */
typedef struct tangency_curvature_columns {
  /** sizeof(this struct) */
  size_t size;
  /** of A at its witness point (2 a row, unit: 1/length) */
  double* a;
  /** unit, tangent, in space (2x3 a row) */
  double* a_directions;
  /** of B at its witness point (2 a row, unit: 1/length) */
  double* b;
  /** unit, tangent, in space (2x3 a row) */
  double* b_directions;
  /**
   * of the distance between the surfaces: 1/R' and 1/R'' of Hertz theory (2 a row, unit:
   * 1/length)
   */
  double* relative;
  /** unit, tangent, in space (2x3 a row) */
  double* relative_directions;
} tangency_curvature_columns;

/** Answers of tangency_common_volumes(). */
typedef struct tangency_volume_columns {
  /** sizeof(this struct) */
  size_t size;
  /** of what both bodies have in common (unit: length^3) */
  double* volume;
  /** proven: of |volume - true volume| (unit: length^3) */
  double* volume_error;
  /** of the volume by B's centre (3 a row, unit: length^2) */
  double* gradient;
  /** proven: of |gradient - true gradient| (unit: length^2) */
  double* gradient_error;
  /** tangency_volume_status */
  int* status;
} tangency_volume_columns;

/** Answers of tangency_containments(): how far A lies inside B. */
typedef struct tangency_containment_columns {
  /** sizeof(this struct) */
  size_t size;
  /**
   * > 0: the least distance of the boundaries; < 0: minus the length by which A sticks out (unit:
   * length)
   */
  double* clearance;
  /** proven: of |clearance - true clearance| (unit: length) */
  double* clearance_error;
  /** unit, outwards (3 a row) */
  double* normal;
  /** witness point of A less A's centre (3 a row, unit: length) */
  double* arm_a;
  /** witness point of B less B's centre (3 a row, unit: length) */
  double* arm_b;
  /** tangency_status, of the clearance */
  int* status;
  /** the largest factor by which A, scaled about its centre, lies in B */
  double* margin;
  /** proven: of |margin - true margin| */
  double* margin_error;
} tangency_containment_columns;

/** Answers of tangency_walls(). */
typedef struct tangency_wall_columns {
  /** sizeof(this struct) */
  size_t size;
  /** < 0 where the body reaches into the wall (unit: length) */
  double* gap;
  /** proven: of |gap - true gap| (unit: length) */
  double* gap_error;
  /** unit, from the body to the wall (3 a row) */
  double* normal;
  /** the body's point nearest to the wall, less its centre (3 a row, unit: length) */
  double* arm_body;
  /** the wall's point opposite to it, less the body's centre (3 a row, unit: length) */
  double* arm_wall;
  /** tangency_status */
  int* status;
  /** tangency_relation */
  int* relation;
  /** tangency_inner */
  int* inner;
} tangency_wall_columns;

/** Answers of tangency_points(). */
typedef struct tangency_point_columns {
  /** sizeof(this struct) */
  size_t size;
  /** < 0 inside (unit: length) */
  double* distance;
  /** proven: of |distance - true distance| (unit: length) */
  double* distance_error;
  /** unit, outwards, at the closest point of the surface (3 a row) */
  double* normal;
  /** closest point less the centre (3 a row, unit: length) */
  double* arm;
  /** tangency_status */
  int* status;
} tangency_point_columns;

/** Answers of tangency_rays(). */
typedef struct tangency_ray_columns {
  /** sizeof(this struct) */
  size_t size;
  /** tangency_ray_status */
  int* status;
  /** how many of the two points there are */
  int* count;
  /**
   * origin + t direction, ascending; 0 beyond count (2 a row, unit: length of the direction)
   */
  double* t;
  /** the points less the body's centre (2x3 a row, unit: length) */
  double* arm;
  /** unit, outwards (2x3 a row) */
  double* normal;
} tangency_ray_columns;

/** Answers of tangency_times_of_contact(). */
typedef struct tangency_time_columns {
  /** sizeof(this struct) */
  size_t size;
  /** tangency_time_status */
  int* status;
  /** never after the first contact; the horizon for none (unit: time) */
  double* time;
  /** for contact: the first contact is no later (unit: time) */
  double* latest;
  /** the gap below which rounding hides whether there is one (unit: length) */
  double* resolution;
  /** unit, from A to B, near `time`; 0 for none and touching_at_start (3 a row) */
  double* normal;
} tangency_time_columns;

/** Which neighbours are wanted. */
typedef struct tangency_neighbour_question {
  /** sizeof(this struct) */
  size_t size;
  /** pairs whose gap is at most this; finite, >= 0 (unit: length) */
  double reach;
  /**
   * three edge vectors, one after the other, that repeat the bodies; NULL: nothing repeats (9 a
   * row, unit: length)
   */
  const double* edges;
  /** along which of them; NULL: along all (3 a row) */
  const int* periodic;
  /** tangency_neighbour_answers */
  int answers;
  /** 0 */
  int reserved;
} tangency_neighbour_question;

/**
 * What tangency_neighbours_columns() shows, NULL where it was not asked for, as is what this
 * version does not know. Valid until the list is destroyed.
 */
typedef struct tangency_neighbour_columns {
  /** sizeof(this struct) */
  size_t size;
  /** body a <= body b (2 a row) */
  const unsigned int* pairs;
  /** b is moved by so many of each edge (3 a row) */
  const int* images;
  /** 1 where the interiors meet */
  const unsigned char* overlaps;
  /** as of contacts (unit: length) */
  const double* gap;
  /** as of contacts (unit: length) */
  const double* gap_error;
  /** tangency_status */
  const int* status;
  /** unit, from a to the image of b (3 a row) */
  const double* normal;
  /** a's witness point less a's centre (3 a row, unit: length) */
  const double* arm_a;
  /** the witness point of b's image less its centre (3 a row, unit: length) */
  const double* arm_b;
  /** from a's centre to that of b's image, rounded (3 a row, unit: length) */
  const double* separation;
} tangency_neighbour_columns;

/** Answers of tangency_plane_contacts(). */
typedef struct tangency_plane_contact_columns {
  /** sizeof(this struct) */
  size_t size;
  /** tangency_relation */
  int* relation;
  /** tangency_inner */
  int* inner;
  /** points where the boundaries meet, exact; -1 where they are equal */
  int* crossings;
  /** > 0: the distance; < 0: minus the penetration depth (unit: length) */
  double* gap;
  /** as of contacts (unit: length) */
  double* gap_error;
  /** unit, from A to B (2 a row) */
  double* normal;
  /** A's witness point less A's centre (2 a row, unit: length) */
  double* arm_a;
  /** B's witness point less B's centre (2 a row, unit: length) */
  double* arm_b;
  /** tangency_status */
  int* status;
  /** of what both ellipses have in common (unit: length^2) */
  double* area;
  /** the crossings less A's centre; 0 beyond their number (4x2 a row, unit: length) */
  double* crossing_arms;
  /** of the crossings, and 0 beyond their number (4 a row) */
  int* multiplicities;
  /** tangency_chord_status */
  int* chord_status;
  /** of the published plane scheme (unit: length) */
  double* chord_depth;
  /** unit, across the chord (2 a row) */
  double* chord_normal;
  /** contact point less A's centre (2 a row, unit: length) */
  double* chord_point;
  /** how far A lies inside B, as of containments (unit: length) */
  double* clearance;
  /** proven: of |clearance - true clearance| (unit: length) */
  double* clearance_error;
  /** as of containments */
  double* margin;
  /** proven: of |margin - true margin| */
  double* margin_error;
} tangency_plane_contact_columns;

/** Answers of tangency_plane_points(). */
typedef struct tangency_plane_point_columns {
  /** sizeof(this struct) */
  size_t size;
  /** < 0 inside (unit: length) */
  double* distance;
  /** proven: of |distance - true distance| (unit: length) */
  double* distance_error;
  /** unit, outwards, at the closest point of the boundary (2 a row) */
  double* normal;
  /** closest point less the centre (2 a row, unit: length) */
  double* arm;
  /** tangency_status */
  int* status;
} tangency_plane_point_columns;

/** Answers of tangency_classify(). */
typedef struct tangency_quadric_columns {
  /** sizeof(this struct) */
  size_t size;
  /** tangency_quadric_type */
  int* type;
  /** rank of the discriminant matrix */
  int* rank4;
  /** rank of its upper-left 3 x 3 block */
  int* rank3;
  /** tangency_tier */
  int* tier;
} tangency_quadric_columns;

/** MAJOR.MINOR.PATCH of the library. */
TANGENCY_API const char* tangency_version(void);

/** The instruction set that calls for many pairs use here, as "AVX2". */
TANGENCY_API const char* tangency_instruction_set(void);

/**
 * What was wrong with the last call of this thread that did not return OK: one line that names
 * argument, row, field, value and rule. Valid until that thread's next such call.
 */
TANGENCY_API const char* tangency_error_message(void);

/** The row that was wrong there, from 0; the largest size_t where it was none. */
TANGENCY_API size_t tangency_error_row(void);

/**
 * The name of a value of an enumeration, as files write it: name_of("relation", 2) is "overlap".
 * NULL where there is none.
 * @param enumeration  its name without tangency_
 * @param value  of the enumeration
 */
TANGENCY_API const char* tangency_name_of(const char* enumeration, int value);

/**
 * The level of the ellipsoid (3) or ellipse (2) that holds a share of a normal distribution.
 * @param confidence  in (0, 1)
 * @param dimensions  2 or 3
 * @param level  the answer
 */
TANGENCY_API int tangency_level_of_confidence(double confidence, int dimensions, double* level);

/**
 * Bodies of rows of numbers, which are copied. By forms other than axes relations are exact for
 * the numbers as given, other answers hold with what is rounded in their errors, and pairs take
 * longer.
 * @param bodies  to be destroyed with tangency_bodies_destroy()
 * @param form  tangency_form
 * @param rows  the numbers of the first row, side by side
 * @param number  their type, tangency_number
 * @param count  rows
 * @param stride  from one row to the next; may be negative (unit: bytes)
 * @param level  of forms shape and precision, > 0; else 1
 */
TANGENCY_API int tangency_bodies_create(tangency_bodies** bodies, int form, const void* rows, int
    number, size_t count, ptrdiff_t stride, double level);

/**
 * More bodies behind those there are. Here and in bodies_set() nobody may ask about them
 * meanwhile; where it fails they are as before.
 * @param bodies  as they were made
 * @param form  tangency_form
 * @param rows  the numbers of the first row, side by side
 * @param number  their type, tangency_number
 * @param count  rows
 * @param stride  from one row to the next; may be negative (unit: bytes)
 * @param level  as above
 */
TANGENCY_API int tangency_bodies_append(tangency_bodies* bodies, int form, const void* rows, int
    number, size_t count, ptrdiff_t stride, double level);

/**
 * Other numbers, by axes, for the bodies from `first` on, as of bodies that move.
 * @param bodies  as they were made
 * @param first  from 0
 * @param rows  the numbers of the first row, side by side
 * @param number  their type, tangency_number
 * @param count  rows
 * @param stride  from one row to the next; may be negative (unit: bytes)
 */
TANGENCY_API int tangency_bodies_set(tangency_bodies* bodies, size_t first, const void* rows, int
    number, size_t count, ptrdiff_t stride);

/**
 * How many there are.
 * @param bodies  as they were made
 */
TANGENCY_API size_t tangency_bodies_count(const tangency_bodies* bodies);

/**
 * Ends them; NULL does nothing.
 * @param bodies  as they were made
 */
TANGENCY_API void tangency_bodies_destroy(tangency_bodies* bodies);

/**
 * Signed gap, normal and witness points of pairs. The sign is that of the exact relation.
 * @param bodies  as they were made
 * @param pairs  places of A and B among the bodies, from 0. NULL: of pair k those of bodies k and
 * count + k (2 a row)
 * @param count  pairs
 * @param separations  c_B - c_A in place of that of the centres, as for periodic images; NULL: of
 * the centres (3 a row, unit: length)
 * @param previous_normals  follow the branch of these, from A to B; may be the memory of
 * answers.normal. A row of zeros, and NULL: the global gap (3 a row)
 * @param accuracy  NULL: the gap to rounding
 * @param answers  each column count rows, or NULL: not asked for
 * @param threads  that may work on it; below 1 counts as 1
 */
TANGENCY_API int tangency_contacts(const tangency_bodies* bodies, const unsigned int* pairs,
    size_t count, const double* separations, const double* previous_normals, const
    tangency_accuracy* accuracy, const tangency_contact_columns* answers, int threads);

/**
 * The same for pairs of rows of form axes, read where they are: nothing is copied but some
 * hundred rows at a time.
 * @param a  row k is A of pair k
 * @param a_stride  from one row to the next (unit: bytes)
 * @param b  row k is B of pair k
 * @param b_stride  from one row to the next (unit: bytes)
 * @param count  pairs
 * @param accuracy  NULL: the gap to rounding
 * @param answers  each column count rows, or NULL: not asked for
 * @param threads  that may work on it; below 1 counts as 1
 */
TANGENCY_API int tangency_contacts_of_rows(const double* a, ptrdiff_t a_stride, const double* b,
    ptrdiff_t b_stride, size_t count, const tangency_accuracy* accuracy, const
    tangency_contact_columns* answers, int threads);

/**
 * The gap at a bounded cost, without search: true gap in [gap - gap_error, gap + above].
 * @param bodies  as they were made
 * @param pairs  places of A and B among the bodies, from 0. NULL: of pair k those of bodies k and
 * count + k (2 a row)
 * @param count  pairs
 * @param separations  c_B - c_A in place of that of the centres, as for periodic images; NULL: of
 * the centres (3 a row, unit: length)
 * @param accuracy  NULL: the gap to rounding
 * @param answers  each column count rows, or NULL: not asked for
 * @param threads  that may work on it; below 1 counts as 1
 */
TANGENCY_API int tangency_bounded_gaps(const tangency_bodies* bodies, const unsigned int* pairs,
    size_t count, const double* separations, const tangency_accuracy* accuracy, const
    tangency_bounded_columns* answers, int threads);

/**
 * Do the interiors meet? Exact.
 * @param bodies  as they were made
 * @param pairs  places of A and B among the bodies, from 0. NULL: of pair k those of bodies k and
 * count + k (2 a row)
 * @param count  pairs
 * @param separations  c_B - c_A in place of that of the centres, as for periodic images; NULL: of
 * the centres (3 a row, unit: length)
 * @param answers  1 or 0, count of them
 * @param threads  that may work on it; below 1 counts as 1
 */
TANGENCY_API int tangency_overlaps(const tangency_bodies* bodies, const unsigned int* pairs,
    size_t count, const double* separations, unsigned char* answers, int threads);

/**
 * The same in bounded time: 2 where only integers would know. Of bodies by matrices also where
 * their rounding to semi-axes leaves it open.
 * @param bodies  as they were made
 * @param pairs  places of A and B among the bodies, from 0. NULL: of pair k those of bodies k and
 * count + k (2 a row)
 * @param count  pairs
 * @param separations  c_B - c_A in place of that of the centres, as for periodic images; NULL: of
 * the centres (3 a row, unit: length)
 * @param answers  1, 0 or 2, count of them
 * @param threads  that may work on it; below 1 counts as 1
 */
TANGENCY_API int tangency_overlaps_by_filter(const tangency_bodies* bodies, const unsigned int*
    pairs, size_t count, const double* separations, unsigned char* answers, int threads);

/**
 * How pairs lie, as point sets: exact.
 * @param bodies  as they were made
 * @param pairs  places of A and B among the bodies, from 0. NULL: of pair k those of bodies k and
 * count + k (2 a row)
 * @param count  pairs
 * @param separations  c_B - c_A in place of that of the centres, as for periodic images; NULL: of
 * the centres (3 a row, unit: length)
 * @param answers  each column count rows, or NULL: not asked for
 * @param threads  that may work on it; below 1 counts as 1
 */
TANGENCY_API int tangency_relations(const tangency_bodies* bodies, const unsigned int* pairs,
    size_t count, const double* separations, const tangency_relation_columns* answers, int
    threads);

/**
 * The gap by another definition, to tell a difference of definition from an error. Where a body
 * is by a matrix, gap_error is infinite: how far its rounding to semi-axes moves these gaps is
 * not bounded.
 * @param bodies  as they were made
 * @param pairs  places of A and B among the bodies, from 0. NULL: of pair k those of bodies k and
 * count + k (2 a row)
 * @param count  pairs
 * @param separations  c_B - c_A in place of that of the centres, as for periodic images; NULL: of
 * the centres (3 a row, unit: length)
 * @param definition  tangency_definition
 * @param answers  each column count rows, or NULL: not asked for
 * @param threads  that may work on it; below 1 counts as 1
 */
TANGENCY_API int tangency_other_gaps(const tangency_bodies* bodies, const unsigned int* pairs,
    size_t count, const double* separations, int definition, const tangency_other_gap_columns*
    answers, int threads);

/**
 * The Perram-Wertheim contact function.
 * @param bodies  as they were made
 * @param pairs  places of A and B among the bodies, from 0. NULL: of pair k those of bodies k and
 * count + k (2 a row)
 * @param count  pairs
 * @param separations  c_B - c_A in place of that of the centres, as for periodic images; NULL: of
 * the centres (3 a row, unit: length)
 * @param answers  each column count rows, or NULL: not asked for
 * @param threads  that may work on it; below 1 counts as 1
 */
TANGENCY_API int tangency_perram_wertheim_factors(const tangency_bodies* bodies, const unsigned
    int* pairs, size_t count, const double* separations, const tangency_factor_columns* answers,
    int threads);

/**
 * First and second derivatives of the gap. Of a body by a matrix those by its semi-axes are NaN.
 * A pair beyond a cutoff is degenerate.
 * @param bodies  as they were made
 * @param pairs  places of A and B among the bodies, from 0. NULL: of pair k those of bodies k and
 * count + k (2 a row)
 * @param count  pairs
 * @param separations  c_B - c_A in place of that of the centres, as for periodic images; NULL: of
 * the centres (3 a row, unit: length)
 * @param normals  of tangency_contacts() for the same pairs (3 a row)
 * @param statuses  of tangency_contacts() for the same pairs
 * @param answers  each column count rows, or NULL: not asked for
 * @param threads  that may work on it; below 1 counts as 1
 */
TANGENCY_API int tangency_gap_derivatives(const tangency_bodies* bodies, const unsigned int*
    pairs, size_t count, const double* separations, const double* normals, const int* statuses,
    const tangency_derivative_columns* answers, int threads);

/**
 * Curvatures where two bodies touch, of pairs whose longest semi-axis is at most 1e70 times the
 * shortest.
 * @param bodies  as they were made
 * @param pairs  places of A and B among the bodies, from 0. NULL: of pair k those of bodies k and
 * count + k (2 a row)
 * @param count  pairs
 * @param normals  of tangency_contacts() for the same pairs, unit (3 a row)
 * @param answers  each column count rows, or NULL: not asked for
 * @param threads  that may work on it; below 1 counts as 1
 */
TANGENCY_API int tangency_contact_curvatures(const tangency_bodies* bodies, const unsigned int*
    pairs, size_t count, const double* normals, const tangency_curvature_columns* answers, int
    threads);

/**
 * The volume that two bodies have in common, and its gradient.
 * @param bodies  as they were made
 * @param pairs  places of A and B among the bodies, from 0. NULL: of pair k those of bodies k and
 * count + k (2 a row)
 * @param count  pairs
 * @param separations  c_B - c_A in place of that of the centres, as for periodic images; NULL: of
 * the centres (3 a row, unit: length)
 * @param tolerance  of the error over the smaller body's volume; > 0, 1e-12 is usual
 * @param answers  each column count rows, or NULL: not asked for
 * @param threads  that may work on it; below 1 counts as 1
 */
TANGENCY_API int tangency_common_volumes(const tangency_bodies* bodies, const unsigned int* pairs,
    size_t count, const double* separations, double tolerance, const tangency_volume_columns*
    answers, int threads);

/**
 * How far A lies inside B: a length and a factor.
 * @param bodies  as they were made
 * @param pairs  places of A and B among the bodies, from 0. NULL: of pair k those of bodies k and
 * count + k (2 a row)
 * @param count  pairs
 * @param separations  c_B - c_A in place of that of the centres, as for periodic images; NULL: of
 * the centres (3 a row, unit: length)
 * @param answers  each column count rows, or NULL: not asked for
 * @param threads  that may work on it; below 1 counts as 1
 */
TANGENCY_API int tangency_containments(const tangency_bodies* bodies, const unsigned int* pairs,
    size_t count, const double* separations, const tangency_containment_columns* answers, int
    threads);

/**
 * First contact of moving bodies in 0 <= t <= horizon.
 * @param bodies  as they were made
 * @param pairs  places of A and B among the bodies, from 0. NULL: of pair k those of bodies k and
 * count + k (2 a row)
 * @param count  pairs
 * @param separations  c_B - c_A in place of that of the centres, as for periodic images; NULL: of
 * the centres (3 a row, unit: length)
 * @param motions  of each body: velocity of the pivot, angular velocity in space (rad per time),
 * centre less pivot; finite (9 a row)
 * @param horizon  finite, >= 0 (unit: time)
 * @param tolerance  > 0 (unit: time)
 * @param answers  each column count rows, or NULL: not asked for
 * @param threads  that may work on it; below 1 counts as 1
 */
TANGENCY_API int tangency_times_of_contact(const tangency_bodies* bodies, const unsigned int*
    pairs, size_t count, const double* separations, const double* motions, double horizon, double
    tolerance, const tangency_time_columns* answers, int threads);

/**
 * Bodies against walls, the solid half-spaces normal . x <= offset.
 * @param bodies  as they were made
 * @param walls  normal of any length but 0, out of the wall, and offset (4 a row)
 * @param walls_count  how many walls
 * @param sheets  not 0: walls without thickness, free on both sides
 * @param pairs  places of a body and of another thing, from 0. NULL: of pair k both are k (2 a
 * row)
 * @param count  pairs; without places at most the number of bodies and that of the others
 * @param answers  each column count rows, or NULL: not asked for
 * @param threads  that may work on it; below 1 counts as 1
 */
TANGENCY_API int tangency_walls(const tangency_bodies* bodies, const double* walls, size_t
    walls_count, int sheets, const unsigned int* pairs, size_t count, const tangency_wall_columns*
    answers, int threads);

/**
 * Closest points of surfaces, and signed distances.
 * @param bodies  as they were made
 * @param points  finite (3 a row, unit: length)
 * @param points_count  how many points
 * @param pairs  places of a body and of another thing, from 0. NULL: of pair k both are k (2 a
 * row)
 * @param count  pairs; without places at most the number of bodies and that of the others
 * @param answers  each column count rows, or NULL: not asked for
 * @param threads  that may work on it; below 1 counts as 1
 */
TANGENCY_API int tangency_points(const tangency_bodies* bodies, const double* points, size_t
    points_count, const unsigned int* pairs, size_t count, const tangency_point_columns* answers,
    int threads);

/**
 * Contacts of bodies (A) and spheres (B). Of bodies by matrices the sign is known where the gap
 * is beyond gap_error.
 * @param bodies  as they were made
 * @param balls  centre, and radius >= 0 (4 a row, unit: length)
 * @param balls_count  how many balls
 * @param pairs  places of a body and of another thing, from 0. NULL: of pair k both are k (2 a
 * row)
 * @param count  pairs; without places at most the number of bodies and that of the others
 * @param answers  each column count rows, or NULL: not asked for
 * @param threads  that may work on it; below 1 counts as 1
 */
TANGENCY_API int tangency_balls(const tangency_bodies* bodies, const double* balls, size_t
    balls_count, const unsigned int* pairs, size_t count, const tangency_contact_columns* answers,
    int threads);

/**
 * Where rays, segments and lines meet surfaces: whether they do is exact.
 * @param bodies  as they were made
 * @param rays  origin, direction of any length but 0, and the ends of the interval of t, which
 * may be infinite (8 a row)
 * @param rays_count  how many rays
 * @param pairs  places of a body and of another thing, from 0. NULL: of pair k both are k (2 a
 * row)
 * @param count  pairs; without places at most the number of bodies and that of the others
 * @param answers  each column count rows, or NULL: not asked for
 * @param threads  that may work on it; below 1 counts as 1
 */
TANGENCY_API int tangency_rays(const tangency_bodies* bodies, const double* rays, size_t
    rays_count, const unsigned int* pairs, size_t count, const tangency_ray_columns* answers, int
    threads);

/**
 * All pairs of images whose gap is at most a reach, in ascending order.
 * @param neighbours  to be destroyed with tangency_neighbours_destroy()
 * @param bodies  as they were made
 * @param question  which pairs, and which answers
 * @param accuracy  of gaps; NULL: to rounding
 * @param threads  that may work on it; below 1 counts as 1
 */
TANGENCY_API int tangency_neighbours_create(tangency_neighbours** neighbours, const
    tangency_bodies* bodies, const tangency_neighbour_question* question, const tangency_accuracy*
    accuracy, int threads);

/**
 * How many pairs there are.
 * @param neighbours  as they were made
 */
TANGENCY_API size_t tangency_neighbours_count(const tangency_neighbours* neighbours);

/**
 * Their columns.
 * @param neighbours  as they were made
 * @param columns  its size is set before
 */
TANGENCY_API int tangency_neighbours_columns(const tangency_neighbours* neighbours,
    tangency_neighbour_columns* columns);

/**
 * Ends them; NULL does nothing.
 * @param neighbours  as they were made
 */
TANGENCY_API void tangency_neighbours_destroy(tangency_neighbours* neighbours);

/**
 * Ellipses of rows of numbers, which are copied.
 * @param ellipses  to be destroyed with tangency_ellipses_destroy()
 * @param form  tangency_plane_form
 * @param rows  the numbers of the first row, side by side
 * @param number  their type, tangency_number
 * @param count  rows
 * @param stride  from one row to the next; may be negative (unit: bytes)
 * @param level  of forms shape and precision, > 0; else 1
 */
TANGENCY_API int tangency_ellipses_create(tangency_ellipses** ellipses, int form, const void*
    rows, int number, size_t count, ptrdiff_t stride, double level);

/**
 * More ellipses behind those there are.
 * @param ellipses  as they were made
 * @param form  tangency_plane_form
 * @param rows  the numbers of the first row, side by side
 * @param number  their type, tangency_number
 * @param count  rows
 * @param stride  from one row to the next; may be negative (unit: bytes)
 * @param level  as above
 */
TANGENCY_API int tangency_ellipses_append(tangency_ellipses* ellipses, int form, const void* rows,
    int number, size_t count, ptrdiff_t stride, double level);

/**
 * How many there are.
 * @param ellipses  as they were made
 */
TANGENCY_API size_t tangency_ellipses_count(const tangency_ellipses* ellipses);

/**
 * Ends them; NULL does nothing.
 * @param ellipses  as they were made
 */
TANGENCY_API void tangency_ellipses_destroy(tangency_ellipses* ellipses);

/**
 * All questions about pairs of ellipses.
 * @param ellipses  as they were made
 * @param pairs  as of tangency_contacts() (2 a row)
 * @param count  pairs
 * @param answers  each column count rows, or NULL: not asked for
 * @param threads  that may work on it; below 1 counts as 1
 */
TANGENCY_API int tangency_plane_contacts(const tangency_ellipses* ellipses, const unsigned int*
    pairs, size_t count, const tangency_plane_contact_columns* answers, int threads);

/**
 * Closest points of boundaries, and signed distances.
 * @param ellipses  as they were made
 * @param points  finite (2 a row, unit: length)
 * @param points_count  how many points
 * @param pairs  places of a body and of another thing, from 0. NULL: of pair k both are k (2 a
 * row)
 * @param count  pairs; without places at most the number of bodies and that of the others
 * @param answers  each column count rows, or NULL: not asked for
 * @param threads  that may work on it; below 1 counts as 1
 */
TANGENCY_API int tangency_plane_points(const tangency_ellipses* ellipses, const double* points,
    size_t points_count, const unsigned int* pairs, size_t count, const
    tangency_plane_point_columns* answers, int threads);

/**
 * The type of quadrics, exact: rows A B C D E F G H J K as of form quadric.
 * @param coefficients  of the first row
 * @param count  quadrics
 * @param stride  from one row to the next (unit: bytes)
 * @param answers  each column count rows, or NULL: not asked for
 * @param threads  that may work on it; below 1 counts as 1
 */
TANGENCY_API int tangency_classify(const double* coefficients, size_t count, ptrdiff_t stride,
    const tangency_quadric_columns* answers, int threads);

#ifdef __cplusplus
}
#endif

#endif
