# SPDX-License-Identifier: MIT
"""Chapter of the page on states A to D of one test: distributions as surfaces, force lines, bodies.

The states are those of the first seed of test 4d: A before shear, B where yielding starts, C at the peak
of friction, D where the volume becomes constant. `tangency-dem` makes their tables in OUT/pictures:
state-X.json and state-X.csv (micro), contacts-X.csv and particles-X.csv.
"""

import json
import math
import os
import subprocess

import charts
import directions
import rendering
import series
from figures import Chapter, Figure, Picture, shown
from results import shear_of

PRESSURE = 30
POINTS = {"A": "before shear", "B": "start of yielding", "C": "peak friction", "D": "constant volume"}

# Of measured values and of models of order 2, and 2 and 4.
KINDS = {"measured": "#6fa8dc", "second order": "#e8935a", "second and fourth": "#5bb98c"}
GROUPS = {"z": "#b5476a", "x": "#3f7fb5", "y": "#4f9d69"}

# Chosen, pixels of a picture's edge.
SURFACE, LINES, BODIES = 270, 330, 480

# Chosen: radius of a line of force that is the mean normal force at C, in mean radii of a particle.
LINE_RADIUS = 0.07

# Patches of a third of an octant for long axes, of which there are fewer than contacts.
AXES_PATCHES = 2

# Angles of a long axis to the load, and the colour up to each, degrees: dark to light.
ANGLES = (18, 36, 54, 72, 90)

TEXT = """
<p>Four states of test 4d (30 MPa, first seed): A before shear, B where yielding starts, C at the peak of friction,
D where the volume becomes constant, or the end of the test. The text gives no rule for them; ours is in the run's
summary. A surface is as far from its middle as the quantity is large in that direction. The stick is the axis of the
load.</p>
"""


class Failed(Exception):
    """A table that tangency-dem did not make."""


class States:
    """Tables of the states, each made once."""

    def __init__(self, results, tool, folder, quick):
        self.results, self.tool, self.folder = results, tool, folder
        self.points = [p for p in POINTS if not quick or p in "AC"]
        self.kept = {}

    def state(self, point):
        folders = self.results.folders(shear_of(PRESSURE))
        file = folders and os.path.join(folders[0], "states", f"shear-{point}.state")
        if not file or not os.path.exists(file):
            raise Failed(f"state {point} of {shear_of(PRESSURE)}")
        return file

    def call(self, *words):
        try:
            run = subprocess.run([self.tool, *words], capture_output=True, text=True, check=False)
        except OSError as error:
            raise Failed(f"{self.tool}: {error.strerror}") from None
        if run.returncode != 0:
            said = run.stderr.strip().splitlines()
            raise Failed(f"tangency-dem {words[0]}: {said[-1] if said else 'no message'}")

    def once(self, name, make):
        """What make() returned; where it failed, the same failure again."""
        if name not in self.kept:
            try:
                self.kept[name] = make()
            except Failed as failure:
                self.kept[name] = failure
        if isinstance(self.kept[name], Failed):
            raise self.kept[name]
        return self.kept[name]

    def file(self, name):
        return os.path.join(self.folder, name)

    def averages(self, point):
        """(JSON, columns of the histogram)"""
        def make():
            averages, classes = self.file(f"state-{point}.json"), self.file(f"state-{point}.csv")
            self.call("micro", self.state(point), "--json", averages, "--histogram", classes)
            with open(averages, encoding="utf-8") as text:
                return json.load(text), series.Columns.of(classes)

        return self.once("averages" + point, make)

    def rings(self, point):
        """Rows of f_r over the angle to the load; none where they cannot be made."""
        def make():
            file = self.file(f"rings-{point}.json")
            self.call("micro", self.state(point), "--partition", "polar", "--json", file)
            with open(file, encoding="utf-8") as text:
                return json.load(text).get("radial_rings") or []

        try:
            return self.once("rings" + point, make)
        except Failed as failure:
            self.results.lack(str(failure))
            return []

    def table(self, command, point):
        """Columns of `tangency-dem contacts` or `particles`."""
        def make():
            file = self.file(f"{command}-{point}.csv")
            self.call(command, self.state(point), "--out", file)
            return series.Columns.of(file)

        return self.once(command + point, make)


class Pictures:
    """Scenes for POV-Ray, and their figures."""

    def __init__(self, states):
        self.states = states
        self.scenes = {}

    def gallery(self, title, columns, rows_of_point, points, caption):
        """A figure of the pictures that rows_of_point(point) gives; the points that fail are lacking."""
        pictures, lacking = [], []
        for point in points:
            try:
                pictures += rows_of_point(point)
            except Failed as failure:
                lacking.append(str(failure))
        return Figure(title, pictures, caption, list(dict.fromkeys(lacking)), columns)

    def add(self, file, bodies, width, centre, size):
        self.scenes[file] = (rendering.scene(bodies, width, centre), size, size)


def around(radius, width):
    """Two thin rings of a value that is the same in all directions: across the load, and towards the
    viewer."""
    thin = 0.004 * width
    ring = f"torus {{ {radius:.5g}, {thin:.4g} pigment {{ color srgb 0.35 }} finish {{ Surface }}"
    return f"{ring} rotate 90*x }}\n{ring} rotate -32*z }}\n"


def surfaces(pictures, key, title, quantity, caption, points=None):
    """Rows of three: measured, second order, second and fourth. quantity(point) gives measured values
    {place: value}, n, two models as functions of a direction, the ring's value and its words."""
    def row(point):
        measured, n, second, fourth, ring, words = quantity(point)
        meshes = [directions.spikes(measured, n), directions.smooth(second), directions.smooth(fourth)]
        width = 2.2 * max(ring, *(mesh.reach() for mesh in meshes))
        stick = rendering.stick((0, 0, -0.5 * width), (0, 0, 0.5 * width), 0.006 * width, "#333333")
        made = []
        for (kind, shade), mesh in zip(KINDS.items(), meshes):
            file = f"surface-{key}-{point}-{len(made)}.png"
            pictures.add(file, rendering.mesh(mesh, shade) + around(ring, width) + stick, width,
                         (0, 0, 0), SURFACE)
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
    ratio = axial / lateral if lateral else math.nan
    return f"Surface, {title}, state {point}, {kind}: along the load {shown(ratio)} times as far as across it."


def classes_of(columns, value):
    """({place: value of a row}, n) of a histogram."""
    n = directions.patches_of(columns.count)
    places = [directions.place_of(d, n) for d in zip(*(columns.column(c) for c in ("dx", "dy", "dz")))]
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
        return *axes_of(states.table("particles", point)), *models(averages["long_axes"], even), even, "1/4π"

    of = ("Blue spikes are classes of directions, orange the second-order model, green the second and fourth "
          "order. The three of a state have one scale; the grey rings are ")
    return [
        surfaces(pictures, "normals", "Contact normals E(n)", normals,
                 of + "an equal distribution. The text sees a sphere, an ellipsoid, then a peanut, and finds that "
                 "the fourth order improves the fit."),
        surfaces(pictures, "normal-force", "Mean normal force over directions", normal_force,
                 of + "the mean f<sub>0</sub>. The text finds that the fourth order changes little."),
        surfaces(pictures, "tangential-force", "Mean tangential force over directions", tangential_force,
                 of + "a tenth of f<sub>0</sub>. Shown is the size of the mean vector. The text finds that the "
                 "fourth order improves the fit dramatically."),
        surfaces(pictures, "axes", "Long axes", axes,
                 of + "an equal distribution. The text sees a circle become a donut across the load.",
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

    def row(point):
        columns = states.table("contacts", point)
        names = ("x", "y", "z", "ax", "ay", "az", "bx", "by", "bz", "nx", "ny", "nz", "fn")
        contacts = list(zip(*map(columns.column, names)))
        if not contacts:
            raise Failed(f"contacts of state {point}")
        mean = states.once("mean force", lambda: sum(c[-1] for c in contacts) / len(contacts))
        starts = [tuple(c[k] - c[3 + k] for k in range(3)) for c in contacts]
        centre = tuple(0.5 * (min(s[k] for s in starts) + max(s[k] for s in starts)) for k in range(3))
        reach = max(max(s[k] for s in starts) - min(s[k] for s in starts) for k in range(3))
        reach = states.once("reach", lambda: reach)
        radius = states.once("radius", lambda: LINE_RADIUS * sum(
            math.dist((0, 0, 0), c[3:6]) for c in contacts) / len(contacts))
        made = []
        for axis, (name, shade) in enumerate((("x", GROUPS["x"]), ("y", GROUPS["y"]), ("z", GROUPS["z"]))):
            sticks, count, force = [], 0, 0.0
            for start, c in zip(starts, contacts):
                n = [abs(v) for v in c[9:12]]
                if n.index(max(n)) != axis:
                    continue
                end = tuple(s + b for s, b in zip(start, c[6:9]))
                sticks.append(rendering.stick(start, end, max(0.02, c[-1] / mean) * radius, shade))
                count, force = count + 1, force + c[-1]
            file = f"force-{point}-{name}.png"
            pictures.add(file, "".join(sticks), 1.45 * reach, centre, LINES)
            share = count / len(contacts)
            made.append(Picture(file, f"Lines of force of the group {name} in state {point}: {count} contacts, "
                                f"{shown(100 * share)} % of all.", f"{point}, group {name}: {count}"))
        return made

    return pictures.gallery(
        "Lines of force by direction group", 3, row, pictures.states.points,
        "A line joins the centres of two particles that touch; its thickness is the normal force. Groups are the axes "
        "along which normals mostly point. The text sees the axial group, z, bear more and more, the lateral ones "
        "less.")


def bodies(pictures):
    states = pictures.states
    shades = charts.SCALE

    def row(point):
        particles = states.table("particles", point)
        rows = [series.Row(particles, k) for k in range(particles.count)]
        if not rows:
            raise Failed(f"particles of state {point}")
        places = [tuple(row[c] for c in "xyz") for row in rows]
        centre = tuple(0.5 * (min(p[k] for p in places) + max(p[k] for p in places)) for k in range(3))
        reach = max(max(p[k] for p in places) - min(p[k] for p in places) for k in range(3))
        reach = states.once("extent", lambda: reach)
        file = f"bodies-{point}.png"
        pictures.add(file, "".join(map(body, rows)), 1.75 * reach, centre, BODIES)
        across = sum(inclination(long_axis(row)) > 54 for row in rows) / len(rows)
        return [Picture(file, f"The sample in state {point}: {shown(100 * across)} % of the long axes are more than "
                        "54 degrees away from the load's axis.", f"{point}, {POINTS[point]}")]

    legend = " ".join(f'<span class="key"><i style="background:{shade}"></i>to {angle}°</span>'
                      for shade, angle in zip(shades, ANGLES))
    return pictures.gallery(
        "The sample before and after", 2, row, [states.points[0], states.points[-1]],
        f"Colours are angles of long axes to the load: {legend}. The text sees long axes turn across the load.")


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
    return (f"sphere {{ 0, 1 matrix {rendering.vector(matrix)} pigment {{ color {rendering.colour(shade)} }} "
            "finish { Surface } }\n")


def chapter(pictures):
    return Chapter("states", "States of one test", TEXT,
                   [bodies(pictures), *distributions(pictures), force_lines(pictures)])
