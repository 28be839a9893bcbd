# SPDX-License-Identifier: MIT
"""Chapters of the page on how samples are made: growth of eccentricity, and release of pressure."""

import math

import charts
import series
from charts import COLOURS
from figures import Chapter

# Growth of the tests' sample from spheres to e = 0.176, and on to 0.22: each resumes the one
# before.
CHAIN = ("spheroid-growth", "spheroid-growth2")
FURTHER = CHAIN + ("spheroid-growth3",)
HORIZONTAL = ("horizontal-growth", "horizontal-ramp", "horizontal-growth2")

ECCENTRICITY = "eccentricity e = (a − b) / (a + b)"

# Table 5.2: pressure in MPa to coordination number, porosity and mean normal force in GN.
PUBLISHED = {10: (9.50, 0.268, 1.93), 30: (10.92, 0.235, 4.81), 50: (11.46, 0.205, 7.39),
             70: (11.70, 0.180, 9.91), 100: (12.44, 0.144, 13.0)}

TEXT = """
<p>Samples begin as spheres, which are compacted under 100 MPa without friction. Then every
particle's <em>eccentricity</em> e grows in small steps, at constant volume of the particle, while a
servo holds the mean stress. Growth turns particles, makes contacts, and leaves a dense sample of
spheroids without a preferred direction. At e = 0.176, where b/a = 0.7, growth ends for the tests.
Curves here go on to 0.22. Tests 1 and 3 have fewer particles and grow at their own pressures.</p>
"""


def growth(maker):
    """Quantities of the sample against e."""
    results = maker.results

    def over_e(key, title, label, y, caption, *, map_y=None, **options):
        curves = [results.curve(name, stems, y, x="eccentricity", colour=COLOURS[k], map_y=map_y)
                  for k, (name, stems) in enumerate({"the tests' sample": FURTHER,
                                                     "slowly": "slow-growth",
                                                     "test 3": "test3-sample",
                                                     "test 1": "test1-sample"}.items())]
        optional = published(results, y, map_y)
        return maker.chart(key, title, ECCENTRICITY, label, curves + optional, caption,
                           **{"x_range": (0, None)} | options)

    return [
        over_e("growth-coordination", "Coordination number in growth", "coordination number",
               "coordination_number",
               "Mean number of contacts of a particle. The text has 6 at first, more than 10 at e "
               "= 0.05, the largest value, 12.5, near e = 0.15, and then a decline."),
        over_e("growth-scatter", "Scatter of the coordination number", "standard deviation",
               "coordination_std",
               "Standard deviation of a particle's number of contacts. The text has 0.67 at first, "
               "a rise in compression, then a fall, and at most 1.5 up to e = 0.2."),
        over_e("growth-relative-scatter", "Relative scatter of the coordination number",
               "standard deviation / mean, %",
               lambda row: 100.0 * row["coordination_std"] / row["coordination_number"],
               "The text has 10 to 18 %: 11 % at first, and less from e = 0.05 to 0.17 than before "
               "and after.",
               y_range=(0, 30)),
        over_e("growth-packing", "Packing density in growth", "packing density",
               lambda row: 1.0 - row["porosity"],
               "Share of the cell that particles fill, overlaps counted twice. The text has 0.81 "
               "at e = 0.01 and 0.84 at the densest."),
        over_e("growth-void-ratio", "Void ratio in growth", "void ratio",
               lambda row: row["porosity"] / (1.0 - row["porosity"]),
               "Volume of voids over that of particles: the packing density, seen from the other "
               "side."),
        over_e("growth-overlap", "Overlap in growth", "overlap / mean radius, in 10^{−2}",
               lambda row: 100.0 * row["overlap_fraction"],
               "The text has a linear rise, a moderate decline with a minimum near the densest "
               "state, and a rise again."),
        over_e("growth-friction", "Deviation from an isotropic stress",
               "sin φ of the principal stresses",
               lambda row: math.sin(math.radians(row["friction_angle_deg"])),
               "(σ<sub>1</sub> − σ<sub>3</sub>) / (σ<sub>1</sub> + σ<sub>3</sub>) while the sample "
               "grows. The text has less than 0.04.",
               y_range=(0, 0.2)),
        over_e("growth-inertia", "Balance in growth", "inertial fraction",
               "inertial_fraction",
               "Mean unbalanced force of a particle over the mean contact force, a mean over 0.01 "
               "of e: each step of growth raises it. The text has it low up to e = 0.15, then "
               "rising, and finds no equilibrium beyond 0.2.",
               map_y=lambda x, y: series.running_mean(x, y, 0.01), x_range=(0.01, None),
               y_range=(0, None)),
        anisotropies(maker, "growth-anisotropy", "Anisotropies in growth", FURTHER,
                     "Samples from random places, from e = 0.002 on. Normals of 4000 contacts "
                     "without any preferred direction have a modulus of some 0.1 by chance, long "
                     "axes of 1000 particles of 0.2.", x_range=(0.002, None), y_range=(0, None)),
        anisotropies(maker, "growth-horizontal", "Anisotropies where axes start "
                                                 "horizontal", HORIZONTAL,
                     "The published start: a cubic lattice with long axes across the load. The "
                     "text finds that anisotropies drop at once and a small residue of the axes' "
                     "stays.",
                     x_range=(0, None), y_range=(0, 3)),
        flatness(maker),
        histogram(maker),
    ]


def published(results, y, map_y):
    """Growth at the published rate, which runs only when it is asked for."""
    before = list(results.lacking)
    curve = results.curve("published rate", "published-growth", y, x="eccentricity",
                          colour=COLOURS[4], style="dashes", map_y=map_y)
    results.lacking = before
    return [curve] if curve.shows() else []


def anisotropies(maker, key, title, stems, caption, **ranges):
    names = {"a^{r}, contact normals": "A_r", "a^{n}, normal force": "A_n",
             "a^{z}, branch": "A_z", "a^{E}, long axes": "A_E"}
    curves = [maker.results.curve(name, stems, lambda row, column=column: abs(row[column]),
                                  x="eccentricity", kind="micro", colour=COLOURS[k])
              for k, (name, column) in enumerate(names.items())]
    return maker.chart(key, title, ECCENTRICITY, "modulus of the anisotropy", curves, caption,
                       **ranges)


def flatness(maker):
    curves = [maker.results.curve(name, stems, "a1", x="elongation", kind="micro",
                                  colour=COLOURS[k])
              for k, (name, stems) in enumerate({"from random places": FURTHER,
                                                 "from a lattice": HORIZONTAL}.items())]
    return maker.chart("growth-a1", "Contacts near the sides or the ends", "a / b",
                       "a_{1}, along the long axis", curves,
                       "Anisotropy of contact vectors in the particle's own axes: above 0 they "
                       "gather near the ends. The text has a U with its zero at a/b = 1.07, and "
                       "then a line.",
                       zero=True, x_range=(1.01, None))


def histogram(maker):
    """How many particles have so many contacts, before shear."""
    results, curves = maker.results, []
    for k, pressure in enumerate((100, 10)):
        counts = {}
        for folder in results.folders(f"spheroid-p{pressure:03d}"):
            found = results.averages(folder, "final").get("coordination", {}).get("histogram", [])
            for contacts, particles in enumerate(found):
                counts[contacts] = counts.get(contacts, 0) + particles
        total = sum(counts.values())
        if total:
            most = max(contacts for contacts, count in counts.items() if count)
            least = min(contacts for contacts, count in counts.items() if count)
            x = list(range(least, most + 1))
            curves.append(charts.Curve(f"{pressure} MPa", x,
                                       [100.0 * counts.get(c, 0) / total for c in x],
                                       colour=COLOURS[k], style=("bars", "points")[k]))
    if not curves:
        results.lack("averages of spheroid-p100 and spheroid-p010")
    return maker.chart("coordination-histogram", "Coordination numbers of the samples",
                       "contacts of a particle", "particles, %", curves,
                       "Dense sample and the one that was released furthest, all seeds. The text "
                       "finds a Gaussian shape.", y_range=(0, None))


RELEASE = """
<p>From the dense sample at 100 MPa the pressure is released in steps to 70, 50, 30 and 10 MPa. The
text does not say how: rate, friction and waiting are this programme's choices. Points with bars are
means and ends over the seeds, open marks the published values (Table 5.2).</p>
"""


def release(maker):
    results = maker.results

    def against(key, title, label, at, factor, column, caption):
        def measure(folder):
            return factor * results.first(folder, column)

        published_ = charts.Curve("published", list(PUBLISHED),
                                  [row[at] for row in PUBLISHED.values()],
                                  colour=COLOURS[1], style="marks")
        short = results.points("here, b/a = 0.8", {100: "spheroid-e11-shear"}, measure,
                               colour=COLOURS[2])
        figure = maker.against_pressure(key, title, label, {"here, b/a = 0.7": measure}, caption)
        if figure.pictures:
            maker.charts[-1].curves += [short, published_]
        return figure

    return [
        against("release-coordination", "Coordination number before shear", "coordination number",
                0,
                1.0, "coordination_number",
                "The text has 12.44 at 100 MPa, for b/a = 0.8, and 9.50 at 10 MPa."),
        against("release-porosity", "Porosity before shear", "porosity", 1, 1.0, "porosity",
                "Share of the cell that particles do not fill; overlaps count twice."),
        against("release-force", "Mean normal force before shear", "mean normal force, GN", 2, 1e-9,
                "mean_normal_force",
                "Published values go about with the pressure, as the number of contacts changes "
                "little."),
        limits(maker),
    ]


def limits(maker):
    """Contacts of a particle that has any as the pressure goes to 0, without friction."""
    results = maker.results
    families = {"spheres": "sphere", "spheroids": "spheroid", "triaxial": "triaxial",
                "disks": "disk", "ellipses": "ellipse"}
    curves = []
    for k, (name, family) in enumerate(families.items()):
        def measure(folder):
            return (results.averages(folder, "final").get("coordination") or {}).get(
                "without_rattlers") or math.nan

        def pressure(folder):
            return 1e-6 * results.summary(folder, "mean_stress")

        stems = {step: f"{family}-limit{step}" for step in (1, 2, 3)}
        curve = results.points(name, stems, measure, colour=COLOURS[k])
        curve.x = [series.mean_and_ends(results.per_seed(stem, pressure))[0]
                   for stem in stems.values()]
        curves.append(curve)
    return maker.chart("release-limit", "Towards no pressure, without friction",
                       "mean stress, MPa, logarithmic",
                       "contacts of a particle, rattlers apart", curves,
                       "As many contacts as free motions need: 6 for spheres, 10 for bodies of "
                       "revolution, 12 for three different axes, 4 for disks, 6 for ellipses. The "
                       "text has 12 for smooth spheroids, which is an "
                       "erratum.", logarithmic=True, y_range=(3, 13))


def chapters(maker):
    return [Chapter("growth", "Growth of the samples", TEXT, growth(maker)),
            Chapter("release", "Release of pressure", RELEASE, release(maker))]
