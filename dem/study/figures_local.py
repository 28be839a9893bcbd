# SPDX-License-Identifier: MIT
"""Chapter of the page on contacts of one particle and on rotation (chapter 7)."""

import math

import charts
from charts import COLOURS
from figures import Chapter
from results import shear_of

TEXT = """
<p>Where on its surface is a particle touched, and how does the turning of long axes turn contact
normals? The <em>contact vector</em> joins a particle's centre and a contact. Its anisotropy in the
particle's own axes is a<sup>cv</sup>, with the component a<sub>1</sub> along the long axis. By
their length contact vectors are <em>short</em>, <em>intermediate</em> or <em>long</em>: thirds
between b and a.</p>
"""

LENGTHS = ("short", "intermediate", "long")
PAIRS = ("ss", "si", "sl", "ii", "il", "ll")

# The published axis ratio of the tests, a / b.
RATIO = 1 / 0.7


def local(maker):
    return [
        maker.pressures("local-cv", "Anisotropy of contact vectors", "modulus of a^{cv}", "a_cv",
                        "In the particle's own axes. The text finds it nearly constant over strain "
                        "and pressure.", kind="micro", y_range=(0, None)),
        maker.pressures("local-a1", "Along the long axis", "a_{1}", "a1",
                        "Above 0: contacts gather near the ends, as area does. The text has 0.5 to "
                        "0.8; by area alone it would be 0.515.", kind="micro", y_range=(0, None)),
        lengths(maker),
        maker.pressures("local-short", "Short contact vectors", "share of contact sides", "f_short",
                        "Full lines are counted, dashes calculated from the measured "
                        "a<sub>1</sub>. In the text more than half are short, and both are close "
                        "at every pressure.", kind="micro",
                        dashed="f_short_model", dashed_name="calculated", y_range=(0.4, 0.7)),
        pairs(maker),
        spread(maker),
        maker.pressures("local-axes", "Long axes against strain", "modulus of a^{E}",
                        lambda row: abs(row["A_E"]),
                        "In the text it is not mobilised before 3 % of strain at any pressure, "
                        "then goes hyperbolically to a limit.", kind="micro", y_range=(0, None)),
        maker.pressures("local-P2", "From long axes to normals", "mean of P_{2}(cos γ)", "P2",
                        "γ is the angle between a contact normal and the particle's long axis. "
                        "Full lines are measured, dashes follow from a<sub>1</sub>. The text "
                        "stopped before this.",
                        kind="micro", dashed="P2_model", dashed_name="predicted"),
        deviation(maker),
        rotation(maker),
        plane_factors(maker),
        plane_rotation(maker),
    ]


def lengths(maker):
    results, drawn = maker.results, []
    for k, name in enumerate(LENGTHS):
        for suffix, style, legend in (("", "line", name), ("_model", "dashes", "")):
            drawn.append(results.curve(legend, shear_of(30), f"f_{name}{suffix}", kind="micro",
                                       stage="shear", colour=COLOURS[k], style=style))
    return maker.chart("local-lengths", "Lengths of contact vectors at 30 MPa", "axial strain",
                       "share of contact sides", drawn,
                       "Full lines are counted, dashes calculated from the measured a<sub>1</sub>. "
                       "The text calculates 54, 27 and 19 % for a<sub>1</sub> = "
                       "0.75.", y_range=(0, None))


def pairs(maker):
    results, strain = maker.results, 0.2
    drawn = []
    for name, suffix, style, colour in (("counted", "", "bars", COLOURS[5]),
                                        ("calculated", "_model", "points", COLOURS[1])):
        means = []
        for pair in PAIRS:
            values = results.per_seed(shear_of(30), lambda folder, c=f"pair{suffix}_{pair}":
                                      results.value_at(folder, c, strain, "micro"))
            finite = [value for value in values if math.isfinite(value)]
            means.append(sum(finite) / len(finite) if finite else math.nan)
        drawn.append(charts.Curve(name, list(range(len(PAIRS))), means, colour=colour, style=style))
    return maker.chart("local-pairs", "Types of contacts at 30 MPa, 20 % strain",
                       "short, intermediate, long on either side", "share of contacts", drawn,
                       "If both sides are independent, shares are products of those of the "
                       "lengths. The text finds counted and calculated ones close.",
                       y_range=(0, None), x_range=(-0.6, 5.6),
                       labels=dict(enumerate(PAIRS)))


def cumulated(a1, beta):
    """G (7.13): the share of contact vectors within beta of one end of the long axis."""
    c = math.cos(beta)
    return 0.5 * (1.0 - (1.0 - 0.5 * a1) * c - 0.5 * a1 * c**3)


def area_share(ratio, beta):
    """The share of a prolate spheroid's area within beta of one end, (7.23) over its whole."""
    e = math.sqrt(1.0 - 1.0 / ratio**2)
    length = 1.0 / math.sqrt(math.cos(beta)**2 / ratio**2 + math.sin(beta)**2)  # in b
    xi = e * length * math.cos(beta) / ratio

    def strip(t):
        return math.asin(t) + t * math.sqrt(1.0 - t * t)

    return 0.5 * (1.0 - strip(xi) / strip(e))


def spread(maker):
    degrees = list(range(0, 91, 2))
    drawn = [charts.Curve(f"a_{{1}} = {a1:g}", degrees,
                          [cumulated(a1, math.radians(d)) for d in degrees], colour=COLOURS[k])
             for k, a1 in enumerate((0.5, 0.8))]
    drawn.append(charts.Curve("by area", degrees,
                              [area_share(RATIO, math.radians(d)) for d in degrees],
                              colour=COLOURS[7], style="dashes"))
    return maker.chart("local-spread", "Share of contacts up to an angle, b/a = 0.7",
                       "angle to the long axis, degrees", "G", drawn,
                       "Calculated: contacts within an angle of one end. The text finds the law "
                       "with a<sub>1</sub> from 0.5 to 0.8 near that of equal contacts on equal "
                       "areas.",
                       y_range=(0, None), labels={k: str(k) for k in range(0, 91, 15)})


def deviation_of(ratio, beta):
    """Angle between contact vector and normal at the angle beta to the long axis, (7.29)."""
    c, s = math.cos(beta)**2, math.sin(beta)**2
    cosine = (c / ratio**2 + s) / math.sqrt(c / ratio**4 + s)
    return math.acos(min(1.0, cosine))


def deviation(maker):
    degrees = list(range(0, 91, 2))
    drawn = [charts.Curve(f"b/a = {1 / ratio:.1f}", degrees,
                          [math.degrees(deviation_of(ratio, math.radians(d))) for d in degrees],
                          colour=COLOURS[k]) for k, ratio in enumerate((1 / 0.7, 1 / 0.8))]
    return maker.chart("local-deviation", "Between contact vector and normal",
                       "angle of the contact vector to the long axis, "
                       "degrees", "angle, degrees", drawn,
                       "Calculated. At b/a = 0.7 it is 20° at most, and 13° on average over the "
                       "surface; the text calls it very small.", y_range=(0, None),
                       labels={k: str(k) for k in range(0, 91, 15)})


def rotation(maker):
    results, drawn = maker.results, []
    for k, (name, column, style) in enumerate((
            ("a^{r}", "a_axial_r", "line"), ("a^{r} by rotation", "a_axial_r_rot", "dashes"),
            ("a^{E}", "a_axial_E", "line"))):
        drawn.append(results.curve(name, shear_of(30), column, kind="micro", stage="shear",
                                   colour=COLOURS[k], style=style))
    return maker.chart("local-rotation", "What rotation gives to the fabric, at 30 "
                                         "MPa", "axial strain",
                       "axial component", drawn,
                       "The part of a<sup>r</sup> that follows from the turned axes alone, the "
                       "mean of P<sub>2</sub> times a<sup>E</sup>. The rest is due to gained and "
                       "lost contacts.", zero=True)


def arc_anisotropy(ratio, points=720):
    """a^L of contacts spread over an ellipse by arc length, (7.51) and (7.52)."""
    def density(beta):
        c, s = math.cos(beta)**2, math.sin(beta)**2
        return math.sqrt(c / ratio**4 + s) / (c / ratio**2 + s)**1.5

    angles = [(k + 0.5) * math.pi / points for k in range(points)]
    whole = sum(map(density, angles))
    return 2.0 * sum(density(b) * math.cos(2.0 * b) for b in angles) / whole


def plane_factors(maker):
    ratios = [10 ** (k / 40) for k in range(0, 61)]
    k2 = [ratio**2 for ratio in ratios]
    c1 = [(k - 1.0) / (k + 1.0) for k in k2]
    c2 = [-2.0 * k / (k + 1.0)**2 for k in k2]
    whole = [a + arc_anisotropy(ratio) * b for ratio, a, b in zip(ratios, c1, c2)]
    drawn = [charts.Curve("c_{1}", ratios, c1, colour=COLOURS[0]),
             charts.Curve("c_{2}", ratios, c2, colour=COLOURS[1]),
             charts.Curve("c_{1} + a^{L} c_{2}", ratios, whole, colour=COLOURS[2])]
    return maker.chart("local-plane-factors", "Factors of the plane model", "a / b, logarithmic",
                       "factor from a^{E} to a^{r}", drawn,
                       "Calculated: how much of the axes' anisotropy the normals of ellipses take "
                       "over, with contacts by arc length. As in the text it goes from 0 for disks "
                       "to 1 for needles.",
                       zero=True, logarithmic=True, labels={x: str(x) for x in (1, 2, 5, 10, 20)})


def plane_rotation(maker):
    results, drawn = maker.results, []
    for k, e in enumerate((0.05, 0.1, 0.15, 0.2)):
        stem = f"ellipse-e{round(100 * e):02d}-shear"
        drawn.append(results.curve(f"e = {e:g}", stem, lambda row: abs(row["A_E"]), kind="micro",
                                   stage="shear", colour=COLOURS[k]))
        drawn.append(results.curve("", stem, lambda row: abs(row["A_r"]), kind="micro",
                                   stage="shear", colour=COLOURS[k], style="dashes", band=False))
    return maker.chart("local-plane", "Ellipses in the plane", "axial strain", "modulus", drawn,
                       "Full lines: a<sup>E</sup> of the long axes; dashes: a<sup>r</sup> of the "
                       "normals. The text had no data of its own in the plane.", y_range=(0, None))


def chapters(maker):
    return [Chapter("local", "Contacts of one particle, and rotation", TEXT, local(maker))]
