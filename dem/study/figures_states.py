# SPDX-License-Identifier: MIT
"""Chapter of the page on states A to D of one test: distributions as surfaces, force lines, bodies.

The states are those of the first seed of test 4d: A before shear, B where yielding starts, C at the
peak of friction, D where the volume becomes constant.
"""

import math

import charts
import directions
import rendering
import series
from figures import Chapter, Figure, Picture, shown
from state_tables import POINTS, Failed

# Of measured values and of models of order 2, and 2 and 4.
KINDS = {"measured": "#6fa8dc", "second order": "#e8935a", "second and fourth": "#5bb98c"}
GROUPS = {"x": "#3f7fb5", "y": "#4f9d69", "z": "#b5476a"}

# Chosen, pixels of a picture's width; and heights of the wide ones over their widths.
SURFACE, LINES, BODIES, HEIGHT = 270, 330, 480, 0.8

# Chosen: radius of a line of the mean normal force of the first state, in mean arms of its
# contacts.
LINE_RADIUS = 0.07

# Chosen: width of a picture of lines, in what they span.
ROOM = 1.05

# Patches of a third of an octant for long axes, of which there are fewer than contacts.
AXES_PATCHES = 2

# Angles of a long axis to the load, and the colour up to each, degrees: dark to light.
ANGLES = (18, 36, 54, 72, 90)

TEXT = """
<p>Four states of test 4d (30 MPa, first seed): A before shear, B where yielding starts, C at the
peak of friction, D where the volume becomes constant, or the end of the test. The text gives no
rule for them; ours is in the run's summary. A surface is as far from its middle as the quantity is
large in that direction. The stick is the axis of the load.</p>
"""


class Pictures:
    """Scenes for POV-Ray, and their figures."""

    def __init__(self, states):
        self.states = states
        self.scenes = {}

    def gallery(self, title, columns, rows_of_point, points, caption):
        """A figure of the pictures that rows_of_point(point) gives; the points that fail are
        lacking."""
        pictures, lacking = [], []
        for point in points:
            try:
                pictures += rows_of_point(point)
            except Failed as failure:
                lacking.append(str(failure))
        return Figure(title, pictures, caption, list(dict.fromkeys(lacking)), columns)

    def add(self, file, bodies, width, centre, pixels, height=HEIGHT):
        self.scenes[file] = (rendering.scene(bodies, width, centre), pixels, round(height * pixels))


def around(radius, width):
    """Two thin rings of a value that is the same in all directions: across the load, and towards
    the viewer."""
    thin = 0.004 * width
    ring = f"torus {{ {radius:.5g}, {thin:.4g} pigment {{ color srgb 0.35 }} finish {{ Surface }}"
    return f"{ring} rotate 90*x }}\n{ring} rotate -32*z }}\n"


def surfaces(pictures, key, title, quantity, caption, points=None):
    """Rows of three: measured, second order, second and fourth. quantity(point) gives measured
    values {place: value}, n, two models as functions of a direction, the ring's value and its
    words."""
    def row(point):
        measured, n, second, fourth, ring, words = quantity(point)
        meshes = [directions.spikes(measured, n), directions.smooth(second),
                  directions.smooth(fourth)]
        width = 2.2 * max(ring, *(mesh.reach() for mesh in meshes))
        stick = rendering.stick((0, 0, -0.5 * width), (0, 0, 0.5 * width), 0.006 * width, "#333333")
        made = []
        for (kind, shade), mesh in zip(KINDS.items(), meshes):
            file = f"surface-{key}-{point}-{len(made)}.png"
            pictures.add(file, rendering.mesh(mesh, shade) + around(ring, width) + stick, width,
                         (0, 0, 0), SURFACE, 1.0)
            label = f"{point}, {kind}" + (f"; rings: {words}" if kind == "measured" else "")
            made.append(Picture(file, alt_of(title, point, kind, measured, n,
                                             (None, second, fourth)[len(made)]), label))
        return made

    return pictures.gallery(title, 6, row, points or pictures.states.points, caption)


def alt_of(title, point, kind, measured, n, model):
    """Mean value near the axis of the load and near the plane across, over one another."""
    def mean(keep):
        found = []
        for place, value in measured.items():
            d = directions.direction_at(place, 0.5, 0.5, n)
            if keep(abs(d[2])) and math.isfinite(value):
                found.append(value if model is None else model(d))
        return sum(found) / len(found) if found else math.nan

    axial, lateral = mean(lambda z: z > 0.85), mean(lambda z: z < 0.3)
    said = (f"along the load {shown(axial / lateral)} times as far as across it" if lateral > 0.0
            else "nothing across the load")
    return f"Surface, {title}, state {point}, {kind}: {said}."


def classes_of(columns, value):
    """({place: value of a row}, n) of a histogram."""
    n = directions.patches_of(columns.count)
    places = [directions.place_of(d, n) for d in zip(*(columns.column(c) for c in ("dx", "dy",
                                                                                   "dz")))]
    return dict(zip(places, columns.column(value))), n


def size_of(row):
    return 1e-9 * math.sqrt(row["ftx"]**2 + row["fty"]**2 + row["ftz"]**2)


def distributions(pictures):
    states = pictures.states

    def models(tensors, factor, field="factor"):
        if tensors is None:
            raise Failed("averages without a tensor")
        pair = (directions.Model(tensors["second"]),
                directions.Model(tensors["second"], tensors["fourth"]))
        return [lambda d, m=m: factor * getattr(m, field)(d) for m in pair]

    def normals(point):
        averages, columns = states.averages(point)
        even = 0.25 / math.pi
        return *classes_of(columns, "E"), *models(averages["fabric"], even), even, "1/4π"

    def normal_force(point):
        averages, columns = states.averages(point)
        f0 = 1e-9 * averages["f0"]
        return (*classes_of(columns, lambda row: 1e-9 * row["fn"]),
                *models(averages["normal_force"], f0), f0, f"{shown(f0)} GN")

    def tangential_force(point):
        averages, columns = states.averages(point)
        f0 = 1e-9 * averages["f0"]
        return (*classes_of(columns, size_of),
                *models(averages["tangential_force"], f0, "tangential"), 0.1 * f0,
                f"{shown(0.1 * f0)} GN")

    def axes(point):
        averages, _ = states.averages(point)
        even = 0.25 / math.pi
        return *axes_of(states.table("particles", point)), *models(averages["long_axes"],
                                                                   even), even, "1/4π"

    of = ("Blue spikes are classes of directions, orange the second-order model, green the second "
          "and fourth order. The three of a state have one scale; the grey rings are ")
    return [
        surfaces(pictures, "normals", "Contact normals E(n)", normals,
                 of + "an equal distribution. The text sees a sphere, an ellipsoid, then a peanut, "
                      "and finds that the fourth order improves the fit."),
        surfaces(pictures, "normal-force", "Mean normal force over directions", normal_force,
                 of + "the mean f<sub>0</sub>. The text finds that the fourth order changes "
                      "little."),
        surfaces(pictures, "tangential-force", "Mean tangential force over directions",
                 tangential_force,
                 of + "a tenth of f<sub>0</sub>. Shown is the size of the mean vector. The text "
                      "finds that the fourth order improves the fit dramatically."),
        surfaces(pictures, "axes", "Long axes", axes,
                 of + "an equal distribution. The text sees a circle become a donut across the "
                      "load.",
                 points=[states.points[0], states.points[-1]]),
    ]


def long_axis(row):
    """The direction of body axis 0."""
    w, x, y, z = (row[c] for c in ("qw", "qx", "qy", "qz"))
    return (1 - 2 * (y * y + z * z), 2 * (x * y + w * z), 2 * (x * z - w * y))


def axes_of(particles):
    """({place: density of the long axes, both ends of each counted}, patches)"""
    n, ends = AXES_PATCHES, particles.column(long_axis)
    counts = dict.fromkeys(directions.all_places(n), 0)
    for u in ends:
        counts[directions.place_of(u, n)] += 1
        counts[directions.place_of(directions.scaled(u, -1.0), n)] += 1
    return {place: count / (2 * len(ends) * directions.area_of(place, n))
            for place, count in counts.items()}, n


def force_lines(pictures):
    states = pictures.states

    names = ("x", "y", "z", "ax", "ay", "az", "bx", "by", "bz", "nx", "ny", "nz", "fn")

    def lines(point):
        """(start, end, normal, force) of each contact."""
        columns = states.table("contacts", point)
        found = []
        for c in zip(*map(columns.column, names)):
            start = tuple(x - arm for x, arm in zip(c[:3], c[3:6]))
            found.append((start, tuple(s + b for s, b in zip(start, c[6:9])), c[9:12], c[12]))
        if not found:
            raise Failed(f"contacts of state {point}")
        return found

    def scales():
        """Width of the pictures, and the radius of a line over its force."""
        width = max(rendering.span(ends_of(lines(p)), HEIGHT)[1] for p in states.points)
        first = lines(states.points[0])
        arm = 0.5 * sum(math.dist(start, end) for start, end, *_ in first) / len(first)
        return ROOM * width, LINE_RADIUS * arm * len(first) / sum(force for *_, force in first)

    def row(point):
        contacts = states.once("lines" + point, lambda: lines(point))
        width, per_force = states.once("scales of lines", scales)
        centre, _ = rendering.span(ends_of(contacts), HEIGHT)
        made = []
        for axis, (name, shade) in enumerate(GROUPS.items()):
            group = [c for c in contacts if axis_of(c[2]) == axis]
            sticks = [rendering.stick(start, end, max(0.02 * width / LINES, per_force * force),
                                      shade)
                      for start, end, _, force in group]
            file = f"force-{point}-{name}.png"
            pictures.add(file, "".join(sticks), width, centre, LINES)
            share = 100 * len(group) / len(contacts)
            made.append(Picture(file, f"Lines of force of the group {name} in state {point}: "
                                      f"{len(group)} contacts, {shown(share)} % of all.",
                                      f"{point}, group {name}: {len(group)}"))
        return made

    return pictures.gallery(
        "Lines of force by direction group", 3, row, pictures.states.points,
        "A line joins the centres of two particles that touch; its thickness is the normal force, "
        "on one scale. Groups are the axes along which normals mostly point. The text sees the "
        "axial group, z, bear more and more, the lateral ones less.")


def ends_of(contacts):
    return [end for contact in contacts for end in contact[:2]]


def axis_of(normal):
    """The axis along which a normal mostly points."""
    sizes = [abs(component) for component in normal]
    return sizes.index(max(sizes))


def bodies(pictures):
    states = pictures.states
    shades = charts.SCALE

    points = [states.points[0], states.points[-1]]

    def rows_of(point):
        particles = states.table("particles", point)
        if not particles.count:
            raise Failed(f"particles of state {point}")
        return [series.Row(particles, k) for k in range(particles.count)]

    def places(rows):
        return [(row["x"], row["y"], row["z"]) for row in rows]

    def width():
        """Of the widest state, with room for the bodies at its ends."""
        return max(rendering.span(places(rows_of(p)),
                                  HEIGHT)[1] + 2 * rows_of(p)[0]["r1"] for p in points)

    def row(point):
        rows = rows_of(point)
        centre, _ = rendering.span(places(rows), HEIGHT)
        file = f"bodies-{point}.png"
        pictures.add(file, "".join(map(body, rows)), 1.05 * states.once("width of bodies", width),
                     centre, BODIES)
        across = sum(inclination(long_axis(row)) > 54 for row in rows) / len(rows)
        return [Picture(file, f"The sample in state {point}: {shown(100 * across)} % of the long "
                              "axes are more than 54 degrees away from the load's "
                              "axis.", f"{point}, {POINTS[point]}")]

    legend = " ".join(f'<span class="key"><i style="background:{shade}"></i>to {angle}°</span>'
                      for shade, angle in zip(shades, ANGLES))
    return pictures.gallery(
        "The sample before and after", 2, row, points,
        f"Colours are angles of long axes to the load: {legend}. The text sees long axes turn "
        "across the load.")


def inclination(axis):
    return math.degrees(math.acos(min(1.0, abs(axis[2]))))


def body(row):
    """A sphere under the body's axes and place."""
    w, x, y, z = (row[c] for c in ("qw", "qx", "qy", "qz"))
    columns = (long_axis(row), (2 * (x * y - w * z), 1 - 2 * (x * x + z * z), 2 * (y * z + w * x)),
               (2 * (x * z + w * y), 2 * (y * z - w * x), 1 - 2 * (x * x + y * y)))
    matrix = [row[r] * value for r, column in zip(("r1", "r2", "r3"), columns) for value in column]
    matrix += [row[c] for c in "xyz"]
    angle = inclination(columns[0])
    shade = charts.SCALE[next((k for k, most in enumerate(ANGLES) if angle <= most), -1)]
    return (f"sphere {{ 0, 1 matrix {rendering.vector(matrix)} "
            f"pigment {{ color {rendering.colour(shade)} }} finish {{ Surface }} }}\n")


def chapter(pictures):
    return Chapter("states", "States of one test", TEXT,
                   [bodies(pictures), *distributions(pictures), force_lines(pictures)])
