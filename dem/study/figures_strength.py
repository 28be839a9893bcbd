# SPDX-License-Identifier: MIT
"""Chapter of the page on stress, force and fabric (chapter 6): what bears the shear strength."""

from charts import COLOURS
from figures import Chapter, in_legend
from results import shear_of

# Of a_s, in the order of the legend.
SHARES = ("r", "n", "t", "z", "zt", "rz", "rf", "zf")

TEXT = """
<p>The stress is a mean over directions of force times branch, so it is a sum of parts that belong
to the anisotropies and to products of them. The text takes seven: isotropic, fabric, branch, force,
and the three products of two. Below, <em>predicted</em> is this sum from the measured
anisotropies.</p>
"""


def strength(maker):
    return [
        *(principal(maker, pressure) for pressure in (10, 30, 100)),
        maker.pressures("sff-ratio", "Shear stress ratio, predicted", "a_{s}", "a_s",
                        "Full lines are measured, dashes predicted by seven parts. The text finds "
                        "them close, slightly worse at large "
                        "strain.", kind="micro", dashed="a_s_seven",
                        dashed_name="predicted", y_range=(0, None)),
        orders(maker),
        *(lode(maker, family) for family in ("sphere", "spheroid")),
        *(parts(maker, pressure) for pressure in (10, 50, 100)),
        maker.pressures("share-shape", "Share of the shape", "share of a_{s}, %",
                        lambda row: 100.0 * row["share_shape"] / row["a_s_seven"],
                        "What branches bear: their own two shares and half of each product with "
                        "them. The text has it positive, near 0 at the peak, then negative down to "
                        "−12 %.",
                        kind="micro", zero=True),
        branches(maker),
        axes(maker),
    ]


def principal(maker, pressure):
    results, stem = maker.results, shear_of(pressure)
    drawn = []
    for k in (1, 2, 3):
        drawn.append(results.curve(f"σ_{{{k}}}", stem, lambda row, k=k: 1e-6 * row[f"s{k}"],
                                   kind="micro", stage="shear", colour=COLOURS[k - 1]))
        drawn.append(results.curve("", stem,
                                   lambda row, k=k: 1e-6 * row[f"s{k}_seven"], kind="micro",
                                   stage="shear", colour=COLOURS[k - 1], style="dashes",
                                   band=False))
    drawn.append(in_legend("predicted", drawn))
    return maker.chart(f"sff-principal-{pressure:03d}", f"Principal stresses at {pressure} MPa",
                       "axial strain", "stress, MPa", drawn,
                       "Full lines are measured, dashes predicted by seven parts. In the text they "
                       "are close; the minor and intermediate ones are most off at large "
                       "strain.", y_range=(0, None))


def orders(maker):
    results, stem = maker.results, shear_of(30)
    drawn = [results.curve(name, stem, column, kind="micro", stage="shear", colour=COLOURS[k],
                           style=style, band=False)
             for k, (name, column, style) in enumerate((
                 ("measured", "a_s", "line"), ("seven parts", "a_s_seven", "dashes"),
                 ("eight parts", "a_s_eight", "dashes"), ("orders 2 and 4", "a_s_fourth", "dots"),
                 ("without shape", "a_s_noshape", "dots"),
                 ("group means", "a_s_independent", "dots")))]
    return maker.chart("sff-orders", "How the prediction is made, at 30 MPa", "axial strain",
                       "a_{s}",
                       drawn,
                       "The eighth part is the product of all three; fourth orders are the models' "
                       "next terms. Without shape, branches are as those of "
                       "spheres.", y_range=(0, None))


def lode(maker, family):
    results, drawn = maker.results, []
    for k, b in enumerate((0.0, 0.25, 0.5, 1.0)):
        stem = f"{family}-p030-b{round(100 * b):03d}-shear"
        drawn.append(results.curve(f"b = {b:g}", stem, "a_s", kind="micro", stage="shear",
                                   colour=COLOURS[k]))
        drawn.append(results.curve("", stem, "a_s_seven", kind="micro", stage="shear",
                                   colour=COLOURS[k], style="dashes", band=False))
    return maker.chart(f"sff-lode-{family}", f"Predicted in true triaxial tests: {family}s",
                       "axial strain", "a_{s}", drawn,
                       "Full lines are measured, dashes predicted by seven parts. The text finds "
                       "that the relation holds in true triaxial tests.", y_range=(0, None))


def parts(maker, pressure):
    drawn = [maker.results.curve(x, shear_of(pressure),
                                 lambda row, x=x: 100.0 * row[f"share_{x}"] / row["a_s_seven"],
                                 kind="micro", stage="shear", colour=COLOURS[k], band=False)
             for k, x in enumerate(SHARES)]
    return maker.chart(f"shares-{pressure:03d}", f"Who bears the shear stress at {pressure} MPa",
                       "axial strain", "share of a_{s}, %", drawn,
                       "r: fabric; n and t: normal and tangential force; z and zt: branch; rz, rf "
                       "and zf: products. In the text force and fabric prevail; branches bear "
                       "little, more with strain, and mostly against the load.", zero=True,
                       x_range=(0.01, None))


def branches(maker):
    drawn = [maker.results.curve(name, shear_of(p), lambda row, x=x: abs(row[x]), kind="micro",
                                 stage="shear", colour=COLOURS[k], style=style, band=False)
             for k, p in enumerate((10, 100))
             for name, x, style in ((f"a^{{z}}, {p} MPa", "A_z", "line"),
                                    (f"a^{{zt}}, {p} MPa", "A_zt", "dashes"))]
    return maker.chart("branch-parts", "Normal and tangential part of the branch", "axial strain",
                       "modulus", drawn,
                       "The text finds that the normal part dominates at higher pressure.",
                       y_range=(0, None))


def axes(maker):
    drawn = [maker.results.curve(name, shear_of(30), "axial_deg_" + part, kind="micro",
                                 stage="shear",
                                 colour=COLOURS[k], band=False)
             for k, (part, name) in enumerate({"fabric": "fabric", "branch": "branch",
                                               "force": "force",
                                               "fabric_force": "fabric-force"}.items())]
    return maker.chart("sff-axes", "Axes of the parts at 30 MPa", "axial strain",
                       "angle, degrees", drawn,
                       "Angle between the axial principal axes of a part and of the stress. In the "
                       "text the parts are coaxial.",
                       y_range=(0, None), x_range=(0.01, None))


def chapters(maker):
    return [Chapter("strength", "Stress, force and fabric", TEXT, strength(maker))]
