# SPDX-License-Identifier: MIT
"""The one table of the C interface: every enumeration, struct, function and error code.

generate.py writes of it the C header, the Fortran module, the prototypes and result classes of the
Python package, their stubs, and the checks that its numbers are those of the C++ library.

Types are written as in C. An array has the shape of one row behind it: "double[3]" is read, "double*[3]"
is written, by rows of three doubles. Nullable arguments have a question mark: "double[3]?".
"""

from dataclasses import dataclass, field


@dataclass(frozen=True)
class Enum:
    """An enumeration: tangency_NAME with the constants TANGENCY_NAME_MEMBER, from 0."""

    name: str
    doc: str
    members: tuple  # of (name, doc)
    cpp: str = ""  # the same enumeration of the C++ library, whose values these are
    python: str = ""  # class in Python


@dataclass(frozen=True)
class Field:
    name: str
    type: str
    unit: str
    doc: str
    enum: str = ""  # whose values the numbers are


@dataclass(frozen=True)
class Struct:
    """A plain struct, tangency_NAME, that begins with its size."""

    name: str
    doc: str
    fields: tuple
    python: str = ""  # the result class in Python, for columns of answers


@dataclass(frozen=True)
class Argument:
    name: str
    type: str
    doc: str
    unit: str = ""


@dataclass(frozen=True)
class Function:
    name: str
    doc: str
    arguments: tuple = field(default=())
    returns: str = "int"


OPAQUE = (
    ("bodies", "Ellipsoids that questions are asked about."),
    ("ellipses", "Ellipses in the plane."),
    ("neighbours", "A list of neighbours and its answers."),
)

ENUMS = (
    Enum("code", "What a call returns. Where it is not OK nothing was answered, "
                 "and tangency_error_message() says why.", (
        ("ok", ""),
        ("bad_row", "a row of numbers makes no body, wall, point or pair: message and "
                    "tangency_error_row() name it"),
        ("bad_argument", "another argument is not what it has to be"),
        ("out_of_memory", ""),
        ("internal", "an error of this library: please report it"),
    )),
    Enum("number", "The type of the numbers of rows.", (("double", ""), ("float", ""))),
    Enum("form", "How a row gives an ellipsoid.", (
        ("axes", "10 numbers x y z r1 r2 r3 qw qx qy qz: centre, semi-axes > 0 in any order, and a "
                 "quaternion of any length but 0 that turns body axes into space axes"),
        ("shape", "9 numbers x y z xx yy zz xy yz zx: centre and shape matrix M, length^2, of the body "
                  "(p-c)' M^-1 (p-c) <= level"),
        ("precision", "the same 9 with the inverse of M, length^-2"),
        ("vectors", "12 numbers: centre, and the vectors of the three semi-axes, at right angles"),
        ("quadric", "10 numbers A B C D E F G H J K: A x^2 + B y^2 + C z^2 + 2D xy + 2E yz + 2F zx + "
                    "2G x + 2H y + 2J z + K = 0, the inside of a real ellipsoid"),
    )),
    Enum("plane_form", "How a row gives an ellipse.", (
        ("direction", "6 numbers x y r1 r2 ux uy: centre, semi-axes > 0, and the direction of the first, "
                      "of any length but 0"),
        ("angle", "5 numbers x y r1 r2 angle: the angle of the first axis, rad"),
        ("shape", "5 numbers x y xx yy xy: centre and shape matrix, length^2"),
        ("precision", "the same 5 with the inverse of the matrix, length^-2"),
        ("conic", "6 numbers A B C D E F: A x^2 + B xy + C y^2 + D x + E y + F = 0"),
    )),
    Enum("relation", "How two solids lie, as point sets: exact for the numbers as they are given.", (
        ("separate", "no common point"),
        ("external_touch", "common points, interiors disjoint"),
        ("overlap", "every other pair"),
        ("internal_touch", "one inside the other, not equal, boundaries meeting"),
        ("a_in_b", "A inside the interior of B"),
        ("b_in_a", "B inside the interior of A"),
        ("equal", ""),
    ), "Relation", "Relation"),
    Enum("inner", "The body inside, where the relation is internal_touch.",
         (("none", ""), ("a", ""), ("b", "")), "Inner", "Inner"),
    Enum("tier", "What knew the answer. Both give the same one.",
         (("filter", "arithmetic in double with a proven bound"), ("exact", "integers")),
         "Tier", "Tier"),
    Enum("status", "What is known of a gap, distance or clearance.", (
        ("ok", "the global answer, proven"),
        ("local", "a stationary answer; that none is better elsewhere is not proven"),
        ("beyond", "above accuracy.cutoff: gap is a lower bound, gap_error infinite, the rest 0"),
    ), "GapStatus", "Status"),
    Enum("gap_tier", "Which method gave the answer, the cheapest first.", (
        ("fast", ""), ("safeguarded", ""), ("factored", ""), ("search", ""),
        ("exact", "any of these, and the exact relation decided the sign"),
    ), "GapTier", "GapTier"),
    Enum("definition", "Definitions of a gap other than the common normal's.", (
        ("perram_wertheim", "the distance of the tangent planes along the Perram-Wertheim normal"),
        ("midpoint_potential", "along that normal through the point of equal potentials"),
        ("trace", "the published scheme of curves; no gap_error"),
    ), "", "Definition"),
    Enum("other_status", "What is known of an answer by another definition. Numbers are 0 unless ok.", (
        ("ok", ""),
        ("not_applicable", "the definition says nothing about this pair"),
        ("not_converged", "not known well enough"),
    ), "OtherGapStatus", "OtherStatus"),
    Enum("derivative_status", "Of what the derivatives are. They are 0 for tie and degenerate.", (
        ("ok", "of the gap"),
        ("local", "of the branch of a local gap"),
        ("tie", "two normals reach equally far: there is no derivative"),
        ("degenerate", "the best normal is not safely isolated"),
    ), "DerivativeStatus", "DerivativeStatus"),
    Enum("volume_status", "Whether the errors of a common volume are within the tolerance.", (
        ("ok", ""), ("tolerance_not_reached", "they are not, and still hold"),
    ), "CommonVolumeStatus", "VolumeStatus"),
    Enum("ray_status", "What a ray meets.", (
        ("miss", "no point of the surface in the interval"), ("hit", "one or two points"),
        ("grazing", "the line touches the surface in one point, exactly"),
    ), "RayStatus", "RayStatus"),
    Enum("time_status", "What is known of the first contact.", (
        ("none", "apart throughout [0, horizon]"),
        ("contact", "apart before `time`, in contact at some moment of [time, latest]"),
        ("touching_at_start", "a common point at t = 0: exact"),
        ("grazing", "apart before `time`, when they are too close for rounding to tell"),
        ("not_converged", "apart before `time`; the rest was not looked at"),
    ), "ContactTimeStatus", "TimeStatus"),
    Enum("neighbour_answers", "What is wanted of each pair of neighbours. Each adds to those before it.", (
        ("pairs", "which there are"), ("overlaps", "do the interiors meet?"),
        ("gaps", "gap, gap_error, status"), ("contacts", "normal, arms and the separation"),
    ), "NeighbourAnswers", "NeighbourAnswers"),
    Enum("chord_status", "Whether the chord between two crossings is defined.", (
        ("ok", ""), ("not_applicable", "the boundaries do not cross in exactly two points"),
    ), "ChordStatus", "ChordStatus"),
    Enum("quadric_type", "What a quadric is, exactly.", tuple((name, "") for name in (
        "real_ellipsoid imaginary_ellipsoid hyperboloid_one_sheet hyperboloid_two_sheets "
        "elliptic_paraboloid hyperbolic_paraboloid real_elliptic_cone imaginary_elliptic_cone "
        "real_elliptic_cylinder imaginary_elliptic_cylinder hyperbolic_cylinder parabolic_cylinder "
        "real_intersecting_planes imaginary_intersecting_planes real_parallel_planes "
        "imaginary_parallel_planes coincident_planes plane no_points all_space").split()),
        "QuadricType", "QuadricType"),
)

_GAP = (
    Field("gap", "double*", "length", "> 0: the distance; < 0: minus the penetration depth"),
    Field("gap_error", "double*", "length", "proven: |gap - true gap| is at most this where the status is "
                                            "ok; where it is local the true gap is at least gap - gap_error"),
    Field("normal", "double*[3]", "1", "unit, from A to B"),
    Field("arm_a", "double*[3]", "length", "A's witness point less A's centre"),
    Field("arm_b", "double*[3]", "length", "B's witness point less B's centre"),
    Field("status", "int*", "", "tangency_status", "status"),
    Field("tier", "int*", "", "tangency_gap_tier", "gap_tier"),
)
_POINT = Field("point", "double*[3]", "length",
               "the contact point, midway between the witness points, less A's centre")
_RELATION = Field("relation", "int*", "", "tangency_relation", "relation")
_INNER = Field("inner", "int*", "", "tangency_inner", "inner")
_TIER = Field("tier", "int*", "", "tangency_tier", "tier")
# Behind an odd number of ints: a struct ends with a field and not with padding, so that one that a
# later version adds begins at the old sizeof.
_RESERVED = Field("reserved", "int", "", "0")

STRUCTS = (
    Struct("accuracy", "How good a gap has to be. Sign, status and gap_error are proven at any; 0 "
                       "everywhere, and NULL, is the gap to rounding and its normal to some 1e-8 rad.", (
        Field("of_size", "double", "1", "tolerance in parts of the size of the pair, >= 0"),
        Field("length", "double", "length", "tolerance, >= 0"),
        Field("normals", "int", "", "not 0: normals and points to rounding too"),
        Field("has_cutoff", "int", "", "not 0: no answer is wanted of pairs whose gap is above cutoff; must be 0 for "
                                    "bodies by matrices"),
        Field("cutoff", "double", "length", ">= 0; not read where has_cutoff is 0"),
    )),
    Struct("contact_columns", "Answers of tangency_contacts().", _GAP + (
        _POINT,
        Field("normal_bound", "double*", "1", "proven: of |normal - true normal|; 2 where nothing is"),
        Field("arm_a_bound", "double*", "length", "proven: of |arm_a - true arm_a|"),
        Field("arm_b_bound", "double*", "length", "proven: of |arm_b - true arm_b|"),
    ), "Contacts"),
    Struct("bounded_columns", "Answers of tangency_bounded_gaps().", _GAP + (
        _POINT,
        Field("above", "double*", "length", "gap - gap_error <= true gap <= gap + above"),
    ), "BoundedGaps"),
    Struct("relation_columns", "Answers of tangency_relations().", (_RELATION, _INNER, _TIER), "Relations"),
    Struct("other_gap_columns", "Answers of tangency_other_gaps().", _GAP[:5] + (
        Field("status", "int*", "", "tangency_other_status", "other_status"),), "OtherGaps"),
    Struct("factor_columns", "Answers of tangency_perram_wertheim_factors().", (
        Field("factor", "double*", "1", "F >= 0: > 1 apart, 1 touching, < 1 overlapping"),
        Field("factor_error", "double*", "1", "proven: of |factor - F|"),
        Field("scale", "double*", "1", "mu = sqrt F: both bodies, scaled by it about their centres, touch"),
        Field("scale_error", "double*", "1", "proven: of |scale - mu|"),
        Field("status", "int*", "", "tangency_other_status", "other_status"),
    ), "Factors"),
    Struct("derivative_columns",
           "Answers of tangency_gap_derivatives(). Parameters, 18 in this order: centre, rotation vector "
           "in space (rad) and semi-axes of A, then of B.", (
        Field("gradient", "double*[18]", "length/parameter", "first derivatives of the gap"),
        Field("hessian", "double*[18,18]", "length/parameter^2", "second derivatives, symmetric"),
        Field("least_radius", "double*", "length", "how sharp the best normal is"),
        Field("status", "int*", "", "tangency_derivative_status", "derivative_status"),
    ), "Derivatives"),
    Struct("curvature_columns", "Answers of tangency_contact_curvatures(): principal curvatures, the larger "
                                "first, and their directions.", (
        Field("a", "double*[2]", "1/length", "of A at its witness point"),
        Field("a_directions", "double*[2,3]", "1", "unit, tangent, in space"),
        Field("b", "double*[2]", "1/length", "of B at its witness point"),
        Field("b_directions", "double*[2,3]", "1", "unit, tangent, in space"),
        Field("relative", "double*[2]", "1/length", "of the distance between the surfaces: 1/R' and 1/R'' of "
                                                    "Hertz theory"),
        Field("relative_directions", "double*[2,3]", "1", "unit, tangent, in space"),
    ), "Curvatures"),
    Struct("volume_columns", "Answers of tangency_common_volumes().", (
        Field("volume", "double*", "length^3", "of what both bodies have in common"),
        Field("volume_error", "double*", "length^3", "proven: of |volume - true volume|"),
        Field("gradient", "double*[3]", "length^2", "of the volume by B's centre"),
        Field("gradient_error", "double*", "length^2", "proven: of |gradient - true gradient|"),
        Field("status", "int*", "", "tangency_volume_status", "volume_status"),
    ), "CommonVolumes"),
    Struct("containment_columns", "Answers of tangency_containments(): how far A lies inside B.", (
        Field("clearance", "double*", "length", "> 0: the least distance of the boundaries; < 0: minus the "
                                                "length by which A sticks out"),
        Field("clearance_error", "double*", "length", "proven: of |clearance - true clearance|"),
        Field("normal", "double*[3]", "1", "unit, outwards"),
        Field("arm_a", "double*[3]", "length", "witness point of A less A's centre"),
        Field("arm_b", "double*[3]", "length", "witness point of B less B's centre"),
        Field("status", "int*", "", "tangency_status, of the clearance", "status"),
        Field("margin", "double*", "1", "the largest factor by which A, scaled about its centre, lies in B"),
        Field("margin_error", "double*", "1", "proven: of |margin - true margin|"),
    ), "Containments"),
    Struct("wall_columns", "Answers of tangency_walls().", (
        Field("gap", "double*", "length", "< 0 where the body reaches into the wall"),
        Field("gap_error", "double*", "length", "proven: of |gap - true gap|"),
        Field("normal", "double*[3]", "1", "unit, from the body to the wall"),
        Field("arm_body", "double*[3]", "length", "the body's point nearest to the wall, less its centre"),
        Field("arm_wall", "double*[3]", "length", "the wall's point opposite to it, less the body's centre"),
        Field("status", "int*", "", "tangency_status", "status"),
        _RELATION, _INNER,
    ), "Walls"),
    Struct("point_columns", "Answers of tangency_points().", (
        Field("distance", "double*", "length", "< 0 inside"),
        Field("distance_error", "double*", "length", "proven: of |distance - true distance|"),
        Field("normal", "double*[3]", "1", "unit, outwards, at the closest point of the surface"),
        Field("arm", "double*[3]", "length", "closest point less the centre"),
        Field("status", "int*", "", "tangency_status", "status"),
    ), "Points"),
    Struct("ray_columns", "Answers of tangency_rays().", (
        Field("status", "int*", "", "tangency_ray_status", "ray_status"),
        Field("count", "int*", "", "how many of the two points there are"),
        Field("t", "double*[2]", "length of the direction", "origin + t direction, ascending; 0 beyond count"),
        Field("arm", "double*[2,3]", "length", "the points less the body's centre"),
        Field("normal", "double*[2,3]", "1", "unit, outwards"),
    ), "Rays"),
    Struct("time_columns", "Answers of tangency_times_of_contact().", (
        Field("status", "int*", "", "tangency_time_status", "time_status"),
        Field("time", "double*", "time", "never after the first contact; the horizon for none"),
        Field("latest", "double*", "time", "for contact: the first contact is no later"),
        Field("resolution", "double*", "length", "the gap below which rounding hides whether there is one"),
        Field("normal", "double*[3]", "1", "unit, from A to B, near `time`; 0 for none and touching_at_start"),
    ), "Times"),
    Struct("neighbour_question", "Which neighbours are wanted.", (
        Field("reach", "double", "length", "pairs whose gap is at most this; finite, >= 0"),
        Field("edges", "double[9]?", "length", "three edge vectors, one after the other, that repeat the bodies; "
                                               "NULL: nothing repeats"),
        Field("periodic", "int[3]?", "", "along which of them; NULL: along all"),
        Field("answers", "int", "", "tangency_neighbour_answers", "neighbour_answers"),
        _RESERVED,
    )),
    Struct("neighbour_columns", "What tangency_neighbours_columns() shows, NULL where it was not asked for, as "
                                "is what this version does not know. Valid until the list is destroyed.", (
        Field("pairs", "unsigned[2]", "", "body a <= body b"),
        Field("images", "int[3]", "", "b is moved by so many of each edge"),
        Field("overlaps", "unsigned char[]", "", "1 where the interiors meet"),
        Field("gap", "double[]", "length", "as of contacts"),
        Field("gap_error", "double[]", "length", "as of contacts"),
        Field("status", "int[]", "", "tangency_status", "status"),
        Field("normal", "double[3]", "1", "unit, from a to the image of b"),
        Field("arm_a", "double[3]", "length", "a's witness point less a's centre"),
        Field("arm_b", "double[3]", "length", "the witness point of b's image less its centre"),
        Field("separation", "double[3]", "length", "from a's centre to that of b's image, rounded"),
    ), "Neighbours"),
    Struct("plane_contact_columns", "Answers of tangency_plane_contacts().", (
        _RELATION, _INNER,
        Field("crossings", "int*", "", "points where the boundaries meet, exact; -1 where they are equal"),
        Field("gap", "double*", "length", "> 0: the distance; < 0: minus the penetration depth"),
        Field("gap_error", "double*", "length", "as of contacts"),
        Field("normal", "double*[2]", "1", "unit, from A to B"),
        Field("arm_a", "double*[2]", "length", "A's witness point less A's centre"),
        Field("arm_b", "double*[2]", "length", "B's witness point less B's centre"),
        Field("status", "int*", "", "tangency_status", "status"),
        Field("area", "double*", "length^2", "of what both ellipses have in common"),
        Field("crossing_arms", "double*[4,2]", "length", "the crossings less A's centre; 0 beyond their number"),
        Field("multiplicities", "int*[4]", "", "of the crossings, and 0 beyond their number"),
        Field("chord_status", "int*", "", "tangency_chord_status", "chord_status"),
        Field("chord_depth", "double*", "length", "of the published plane scheme"),
        Field("chord_normal", "double*[2]", "1", "unit, across the chord"),
        Field("chord_point", "double*[2]", "length", "contact point less A's centre"),
        Field("clearance", "double*", "length", "how far A lies inside B, as of containments"),
        Field("clearance_error", "double*", "length", "proven: of |clearance - true clearance|"),
        Field("margin", "double*", "1", "as of containments"),
        Field("margin_error", "double*", "1", "proven: of |margin - true margin|"),
    ), "PlaneContacts"),
    Struct("plane_point_columns", "Answers of tangency_plane_points().", (
        Field("distance", "double*", "length", "< 0 inside"),
        Field("distance_error", "double*", "length", "proven: of |distance - true distance|"),
        Field("normal", "double*[2]", "1", "unit, outwards, at the closest point of the boundary"),
        Field("arm", "double*[2]", "length", "closest point less the centre"),
        Field("status", "int*", "", "tangency_status", "status"),
    ), "PlanePoints"),
    Struct("quadric_columns", "Answers of tangency_classify().", (
        Field("type", "int*", "", "tangency_quadric_type", "quadric_type"),
        Field("rank4", "int*", "", "rank of the discriminant matrix"),
        Field("rank3", "int*", "", "rank of its upper-left 3 x 3 block"),
        _TIER,
    ), "Quadrics"),
)

_ROWS = (
    Argument("rows", "const void*", "the numbers of the first row, side by side"),
    Argument("number", "int", "their type, tangency_number"),
    Argument("count", "size_t", "rows"),
    Argument("stride", "ptrdiff_t", "from one row to the next; may be negative", "bytes"),
)
_BODIES = Argument("bodies", "const tangency_bodies*", "as they were made")
_PAIRS_OF_BODIES = (
    Argument("pairs", "unsigned[2]?", "places of A and B among the bodies, from 0. NULL: of pair k those of "
                                      "bodies k and count + k"),
    Argument("count", "size_t", "pairs"),
)
_PAIRS = _PAIRS_OF_BODIES + (
    Argument("separations", "double[3]?", "c_B - c_A in place of that of the centres, as for periodic images; "
                                          "NULL: of the centres", "length"),
)
_MEETINGS = (
    Argument("pairs", "unsigned[2]?", "places of a body and of another thing, from 0. NULL: of pair k both are k"),
    Argument("count", "size_t", "pairs; without places at most the number of bodies and that of the others"),
)
_THREADS = Argument("threads", "int", "that may work on it; below 1 counts as 1")


def _answers(columns):
    return Argument("answers", f"const tangency_{columns}*", "each column count rows, or NULL: not asked for")


FUNCTIONS = (
    Function("version", "MAJOR.MINOR.PATCH of the library.", (), "const char*"),
    Function("instruction_set", "The instruction set that calls for many pairs use here, as \"AVX2\".", (),
             "const char*"),
    Function("error_message", "What was wrong with the last call of this thread that did not return OK: one line "
                              "that names argument, row, field, value and rule. Valid until that thread's next "
                              "such call.", (), "const char*"),
    Function("error_row", "The row that was wrong there, from 0; the largest size_t where it was none.", (),
             "size_t"),
    Function("name_of", "The name of a value of an enumeration, as files write it: name_of(\"relation\", 2) is "
                        "\"overlap\". NULL where there is none.", (
        Argument("enumeration", "const char*", "its name without tangency_"),
        Argument("value", "int", "of the enumeration"),
    ), "const char*"),
    Function("level_of_confidence", "The level of the ellipsoid (3) or ellipse (2) that holds a share of a normal "
                                    "distribution.", (
        Argument("confidence", "double", "in (0, 1)", "1"),
        Argument("dimensions", "int", "2 or 3"),
        Argument("level", "double*", "the answer"),
    )),
    Function("bodies_create", "Bodies of rows of numbers, which are copied. By forms other than axes relations "
                              "are exact for the numbers as given, other answers hold with what is rounded in "
                              "their errors, and pairs take longer.", (
        Argument("bodies", "tangency_bodies**", "to be destroyed with tangency_bodies_destroy()"),
        Argument("form", "int", "tangency_form"),
    ) + _ROWS + (Argument("level", "double", "of forms shape and precision, > 0; else 1", "1"),)),
    Function("bodies_append", "More bodies behind those there are. Here and in bodies_set() nobody may ask about "
                              "them meanwhile; where it fails they are as before.", (
        Argument("bodies", "tangency_bodies*", "as they were made"),
        Argument("form", "int", "tangency_form"),
    ) + _ROWS + (Argument("level", "double", "as above", "1"),)),
    Function("bodies_set", "Other numbers, by axes, for the bodies from `first` on, as of bodies that move.", (
        Argument("bodies", "tangency_bodies*", "as they were made"),
        Argument("first", "size_t", "from 0"),
    ) + _ROWS),
    Function("bodies_count", "How many there are.", (_BODIES,), "size_t"),
    Function("bodies_destroy", "Ends them; NULL does nothing.", (Argument("bodies", "tangency_bodies*", "as they were made"),), "void"),
    Function("contacts", "Signed gap, normal and witness points of pairs. The sign is that of the exact relation.",
             (_BODIES,) + _PAIRS + (
        Argument("previous_normals", "double[3]?", "follow the branch of these, from A to B; may be the memory of "
                                                   "answers.normal. A row of zeros, and NULL: the global gap"),
        Argument("accuracy", "const tangency_accuracy*?", "NULL: the gap to rounding"),
        _answers("contact_columns"), _THREADS)),
    Function("contacts_of_rows", "The same for pairs of rows of form axes, read where they are: nothing is copied "
                                 "but some hundred rows at a time.", (
        Argument("a", "const double*", "row k is A of pair k"),
        Argument("a_stride", "ptrdiff_t", "from one row to the next", "bytes"),
        Argument("b", "const double*", "row k is B of pair k"),
        Argument("b_stride", "ptrdiff_t", "from one row to the next", "bytes"),
        Argument("count", "size_t", "pairs"),
        Argument("accuracy", "const tangency_accuracy*?", "NULL: the gap to rounding"),
        _answers("contact_columns"), _THREADS)),
    Function("bounded_gaps", "The gap at a bounded cost, without search: true gap in [gap - gap_error, gap + above].",
             (_BODIES,) + _PAIRS + (
        Argument("accuracy", "const tangency_accuracy*?", "NULL: the gap to rounding"),
        _answers("bounded_columns"), _THREADS)),
    Function("overlaps", "Do the interiors meet? Exact.", (_BODIES,) + _PAIRS + (
        Argument("answers", "unsigned char*[]", "1 or 0, count of them"), _THREADS)),
    Function("overlaps_by_filter", "The same in bounded time: 2 where only integers would know. Of bodies by "
                                   "matrices also where their rounding to semi-axes leaves it open.",
             (_BODIES,) + _PAIRS + (Argument("answers", "unsigned char*[]", "1, 0 or 2, count of them"), _THREADS)),
    Function("relations", "How pairs lie, as point sets: exact.",
             (_BODIES,) + _PAIRS + (_answers("relation_columns"), _THREADS)),
    Function("other_gaps", "The gap by another definition, to tell a difference of definition from an error. "
                           "Where a body is by a matrix, gap_error is infinite: how far its rounding to "
                           "semi-axes moves these gaps is not bounded.",
             (_BODIES,) + _PAIRS + (Argument("definition", "int", "tangency_definition"),
                                    _answers("other_gap_columns"), _THREADS)),
    Function("perram_wertheim_factors", "The Perram-Wertheim contact function.",
             (_BODIES,) + _PAIRS + (_answers("factor_columns"), _THREADS)),
    Function("gap_derivatives", "First and second derivatives of the gap. Of a body by a matrix those by its "
                                "semi-axes are NaN. A pair beyond a cutoff is degenerate.", (_BODIES,) + _PAIRS + (
        Argument("normals", "double[3]", "of tangency_contacts() for the same pairs", "1"),
        Argument("statuses", "int[]", "of tangency_contacts() for the same pairs"),
        _answers("derivative_columns"), _THREADS)),
    Function("contact_curvatures", "Curvatures where two bodies touch, of pairs whose longest semi-axis is "
                                    "at most 1e70 times the shortest.", (_BODIES,) + _PAIRS_OF_BODIES + (
        Argument("normals", "double[3]", "of tangency_contacts() for the same pairs, unit", "1"),
        _answers("curvature_columns"), _THREADS)),
    Function("common_volumes", "The volume that two bodies have in common, and its gradient.",
             (_BODIES,) + _PAIRS + (
        Argument("tolerance", "double", "of the error over the smaller body's volume; > 0, 1e-12 is usual", "1"),
        _answers("volume_columns"), _THREADS)),
    Function("containments", "How far A lies inside B: a length and a factor.",
             (_BODIES,) + _PAIRS + (_answers("containment_columns"), _THREADS)),
    Function("times_of_contact", "First contact of moving bodies in 0 <= t <= horizon.", (_BODIES,) + _PAIRS + (
        Argument("motions", "double[9]", "of each body: velocity of the pivot, angular velocity in space (rad per "
                                         "time), centre less pivot; finite"),
        Argument("horizon", "double", "finite, >= 0", "time"),
        Argument("tolerance", "double", "> 0", "time"),
        _answers("time_columns"), _THREADS)),
    Function("walls", "Bodies against walls, the solid half-spaces normal . x <= offset.", (
        _BODIES,
        Argument("walls", "double[4]", "normal of any length but 0, out of the wall, and offset"),
        Argument("walls_count", "size_t", "how many walls"),
        Argument("sheets", "int", "not 0: walls without thickness, free on both sides")) + _MEETINGS + (
        _answers("wall_columns"), _THREADS)),
    Function("points", "Closest points of surfaces, and signed distances.", (
        _BODIES,
        Argument("points", "double[3]", "finite", "length"),
        Argument("points_count", "size_t", "how many points")) + _MEETINGS + (_answers("point_columns"), _THREADS)),
    Function("balls", "Contacts of bodies (A) and spheres (B). Of bodies by matrices the sign is known where "
                      "the gap is beyond gap_error.", (
        _BODIES,
        Argument("balls", "double[4]", "centre, and radius >= 0", "length"),
        Argument("balls_count", "size_t", "how many balls")) + _MEETINGS + (_answers("contact_columns"), _THREADS)),
    Function("rays", "Where rays, segments and lines meet surfaces: whether they do is exact.", (
        _BODIES,
        Argument("rays", "double[8]", "origin, direction of any length but 0, and the ends of the interval of t, "
                                      "which may be infinite"),
        Argument("rays_count", "size_t", "how many rays")) + _MEETINGS + (_answers("ray_columns"), _THREADS)),
    Function("neighbours_create", "All pairs of images whose gap is at most a reach, in ascending order.", (
        Argument("neighbours", "tangency_neighbours**", "to be destroyed with tangency_neighbours_destroy()"),
        _BODIES,
        Argument("question", "const tangency_neighbour_question*", "which pairs, and which answers"),
        Argument("accuracy", "const tangency_accuracy*?", "of gaps; NULL: to rounding"), _THREADS)),
    Function("neighbours_count", "How many pairs there are.",
             (Argument("neighbours", "const tangency_neighbours*", "as they were made"),), "size_t"),
    Function("neighbours_columns", "Their columns.", (
        Argument("neighbours", "const tangency_neighbours*", "as they were made"),
        Argument("columns", "tangency_neighbour_columns*", "its size is set before"))),
    Function("neighbours_destroy", "Ends them; NULL does nothing.",
             (Argument("neighbours", "tangency_neighbours*", "as they were made"),), "void"),
    Function("ellipses_create", "Ellipses of rows of numbers, which are copied.", (
        Argument("ellipses", "tangency_ellipses**", "to be destroyed with tangency_ellipses_destroy()"),
        Argument("form", "int", "tangency_plane_form"),
    ) + _ROWS + (Argument("level", "double", "of forms shape and precision, > 0; else 1", "1"),)),
    Function("ellipses_append", "More ellipses behind those there are.", (
        Argument("ellipses", "tangency_ellipses*", "as they were made"),
        Argument("form", "int", "tangency_plane_form"),
    ) + _ROWS + (Argument("level", "double", "as above", "1"),)),
    Function("ellipses_count", "How many there are.", (Argument("ellipses", "const tangency_ellipses*", "as they were made"),),
             "size_t"),
    Function("ellipses_destroy", "Ends them; NULL does nothing.", (Argument("ellipses", "tangency_ellipses*", "as they were made"),),
             "void"),
    Function("plane_contacts", "All questions about pairs of ellipses.", (
        Argument("ellipses", "const tangency_ellipses*", "as they were made"),
        Argument("pairs", "unsigned[2]?", "as of tangency_contacts()"),
        Argument("count", "size_t", "pairs"),
        _answers("plane_contact_columns"), _THREADS)),
    Function("plane_points", "Closest points of boundaries, and signed distances.", (
        Argument("ellipses", "const tangency_ellipses*", "as they were made"),
        Argument("points", "double[2]", "finite", "length"),
        Argument("points_count", "size_t", "how many points")) + _MEETINGS + (_answers("plane_point_columns"), _THREADS)),
    Function("classify", "The type of quadrics, exact: rows A B C D E F G H J K as of form quadric.", (
        Argument("coefficients", "const double*", "of the first row"),
        Argument("count", "size_t", "quadrics"),
        Argument("stride", "ptrdiff_t", "from one row to the next", "bytes"),
        _answers("quadric_columns"), _THREADS)),
)
