# SPDX-License-Identifier: MIT
"""How ellipsoids touch, exactly.

Rows of numbers go in, as NumPy arrays, structured arrays or data frames, and columns of answers come out. A
right-handed frame; lengths in any one unit; a gap > 0 is a distance, a gap < 0 minus a penetration depth;
normals point from A to B; witness points are given from their body's centre.

`contact` answers for one pair, `contacts` for many. `tangency.dem` reads and starts runs of the simulator,
`tangency.grade` grades a function against the exact truth.
"""

from tangency._bodies import Bodies, Ellipses
from tangency._checks import TangencyError
from tangency._columns import Columns
from tangency._library import instruction_set, level_of_confidence, version
from tangency._plane import plane_contacts, plane_points
from tangency._questions import (balls, bounded_gaps, classify, common_volumes, contact_curvatures, contacts,
                                 containments, gap_derivatives, neighbours, other_gaps, overlaps, overlaps_by_filter,
                                 perram_wertheim_factors, points, rays, relations, times_of_contact, walls)
from tangency._single import Contact, contact
from tangency._table import (BoundedGaps, CommonVolumes, Containments, Contacts, Curvatures, Definition,
                             DerivativeStatus, Derivatives, Factors, Form, NeighbourAnswers, Neighbours, OtherGaps,
                             PlaneContacts, PlaneForm, PlanePoints, Points, Quadrics, QuadricType, Rays, RayStatus,
                             Relation, Relations, Status, Times, TimeStatus, Walls)

__version__ = version()

__all__ = [
    "Bodies", "BoundedGaps", "Columns", "CommonVolumes", "Contact", "Contacts", "Containments", "Curvatures",
    "Definition", "DerivativeStatus", "Derivatives", "Ellipses", "Factors", "Form", "NeighbourAnswers", "Neighbours",
    "OtherGaps", "PlaneContacts", "PlaneForm", "PlanePoints", "Points", "QuadricType", "Quadrics", "RayStatus", "Rays",
    "Relation", "Relations", "Status", "TangencyError", "TimeStatus", "Times", "Walls", "balls", "bounded_gaps",
    "classify", "common_volumes", "contact", "contact_curvatures", "contacts", "containments", "gap_derivatives",
    "instruction_set", "level_of_confidence", "neighbours", "other_gaps", "overlaps", "overlaps_by_filter",
    "perram_wertheim_factors", "plane_contacts", "plane_points", "points", "rays", "relations", "times_of_contact",
    "version", "walls",
]
