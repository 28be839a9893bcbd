# SPDX-License-Identifier: MIT
"""Chapter of the page on anisotropies in shear (sections 5.4.8 and 8.5.2), but for the surfaces."""

import math

import charts
from charts import COLOURS
from figures import Chapter


TEXT = """
<p>An <em>anisotropy</em> a is the second-order part of how a quantity depends on the direction n of
a contact: a factor 1 + a<sub>ij</sub>n<sub>i</sub>n<sub>j</sub>. Its modulus is
√(a<sub>ij</sub>a<sub>ij</sub>). a<sup>r</sup> is that of the contact normals, a<sup>n</sup> and
a<sup>t</sup> of the normal and tangential force, a<sup>z</sup> and a<sup>zt</sup> of the normal and
tangential component of the branch, which joins two centres, and a<sup>E</sup> of the long axes.</p>
"""


def curves(maker):
    def modulus(name):
        return lambda row: abs(row[name])

    def anisotropy(key, title, label, column, caption, **options):
        return maker.pressures(key, title, label, column, caption, kind="micro", **options)

    return [
        anisotropy("anisotropy-r", "Contact normals", "modulus of a^{r}", modulus("A_r"),
                   "The text has a hyperbolic rise, softening, and a steady value that depends on "
                   "the pressure.",
                   y_range=(0, None)),
        anisotropy("anisotropy-n", "Normal force", "modulus of a^{n}", modulus("A_n"),
                   "Like the shear stress ratio; in the text its steady value is independent of "
                   "pressure and its peak is near that of the stress.", y_range=(0, None)),
        anisotropy("anisotropy-t", "Tangential force", "modulus of a^{t}", modulus("A_t"),
                   "In the text it rises fast, then declines slowly to one value for all "
                   "pressures.",
                   y_range=(0, None)),
        anisotropy("anisotropy-z", "Branch, normal component", "axial component of a^{z}",
                   "a_axial_z",
                   "In the text it grows linearly with strain and hardly depends on the pressure. "
                   "Below 0: branches are longer across the load.", zero=True),
        anisotropy("anisotropy-zt", "Branch, tangential component", "axial component of a^{zt}",
                   "a_axial_zt",
                   "It belongs to bodies that are no spheres: branches of spheres have no "
                   "tangential component.", zero=True),
        anisotropy("anisotropy-len", "Branch, length", "axial component", "a_axial_len",
                   "Of the distance of the centres. The text says that branches become long "
                   "horizontally.",
                   zero=True),
        anisotropy("anisotropy-E", "Long axes", "axial component of a^{E}", "a_axial_E",
                   "Below 0: long axes turn across the load. The text says that they "
                   "do.", zero=True),
        anisotropy("branch-mean", "Mean branch", "mean over orientations, m", "z0",
                   "Mean normal component z<sub>0</sub>, with 2r = 20 m. The text calls it "
                   "constant, independent of pressure and above 20 m; overlaps make that "
                   "impossible at high pressure."),
        peaks(maker),
        peak_strains(maker),
        rings(maker),
        plane(maker),
    ]


def peaks(maker):
    def top(column):
        return lambda folder: abs(maker.results.largest(folder, lambda row: abs(row[column]))[0])

    return maker.against_pressure(
        "anisotropy-peaks", "Peak anisotropies", "largest modulus",
        {"a_{s}, stress": top("a_s"), "a^{n}": top("A_n"), "a^{r}": top("A_r"),
         "a^{t}": top("A_t")},
        "In the text a<sup>n</sup> is above the stress ratio, then come a<sup>r</sup> and "
        "a<sup>t</sup>, and a<sup>r</sup> falls most steeply.", y_range=(0, None))


def peak_strains(maker):
    def place(column):
        return lambda folder: maker.results.largest(folder, lambda row: abs(row[column]))[1]

    return maker.against_pressure(
        "anisotropy-strains", "Strains of the peaks", "axial strain",
        {"a_{s}, stress": place("a_s"), "a^{n}": place("A_n"), "a^{r}": place("A_r"),
         "a^{t}": place("A_t")},
        "In the text a<sup>t</sup> peaks well before the stress, a<sup>n</sup> later than it, and "
        "a<sup>r</sup> well after.", y_range=(0, None))


def rings(maker):
    """f_r over the angle to the load at the peak: measured rings, models of order 2 and 4."""
    rows = maker.states.rings("C")
    beta = [math.degrees(row["beta"]) for row in rows]

    def values(name):
        return [math.nan if row.get(name) is None else 1e-9 * row[name] for row in rows]

    drawn = [charts.Curve("measured", beta, values("value"), colour=COLOURS[0], style="points"),
             charts.Curve("second order", beta, values("model2"), colour=COLOURS[1],
                          style="dashes"),
             charts.Curve("second and fourth", beta, values("model4"), colour=COLOURS[2])]
    return maker.chart("radial-force", "Tangential force away from the load's axis, at C",
                       "angle of the normal to the load, degrees", "f_{r}, GN", drawn,
                       "Mean over rings of 10° at the peak, at 30 MPa. The text finds that the "
                       "fourth order corrects size and direction of the largest value; the second "
                       "order has it at 35°.",
                       zero=True, labels={k: str(k) for k in range(0, 181, 30)})


def plane(maker):
    results = maker.results
    drawn = [results.curve(name, "ellipse-e00-shear", column, kind="micro", stage="shear",
                           colour=COLOURS[k], style=style)
             for k, (name, column, style) in enumerate((
                 ("measured", "a_s", "line"), ("half the sum", "a_s_small", "dashes"),
                 ("full form", "a_s_coaxial", "dots")))]
    return maker.chart("plane-disks", "Disks in the plane", "axial strain",
                       "a_{s} = (σ_{1} − σ_{2}) / (σ_{1} + σ_{2})", drawn,
                       "Half the sum of a<sup>r</sup>, a<sup>n</sup> and a<sup>t</sup> against the "
                       "measured stress. The text gives it for small anisotropies; the full form "
                       "has their products.",
                       y_range=(0, None))


def chapters(maker):
    return [Chapter("anisotropies", "Anisotropies in shear", TEXT, curves(maker))]
