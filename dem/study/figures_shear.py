# SPDX-License-Identifier: MIT
"""Chapters of the page on shear tests: stress, volume, contacts, forces (5.4.1 to 5.4.7)."""

import charts
import series
from charts import COLOURS
from figures import Chapter
from results import shear_of

# Chosen, of axial strain: over which the curves' rates are taken. Those of the peaks, which
# summaries have, are of dem/tool/shear_peaks.hpp.
WINDOW = 0.02

# The text's steady state, axial strain.
STEADY = 0.205


def axial_ratio(row):
    """a_s of an axisymmetric stress."""
    return (row["s_zz"] - 0.5 * (row["s_xx"] + row["s_yy"])) / row["mean_stress"]


TEXT = """
<p>Each sample is compressed along the vertical while a servo holds the mean stress. The tests go to
an axial strain of 0.4, in the reduced programme less far. Curves are means over the seeds, bands go
from the lowest seed to the highest. Compression is positive in stress and axial strain, dilation in
volumetric strain.</p>
"""


def stress(maker):
    results = maker.results
    return [
        maker.pressures("shear-ratio", "Shear stress ratio", "a_{s} = (σ_{1} − σ_{3}) / p",
                        axial_ratio,
                        "The text has a peak, softening, then one curve for all pressures: "
                        "strength falls as pressure grows, and the ultimate strength does not "
                        "depend on it."),
        maker.pressures("shear-angle", "Friction angle", "friction angle, degrees",
                        "friction_angle_deg",
                        "The same as an angle. The text has peaks from 39° to 43.5°."),
        maker.pressures("shear-volume", "Volumetric strain", "volumetric strain",
                        "volumetric_strain",
                        "In the text samples dilate from the start, less at higher pressure, "
                        "without contraction and in curves that do not meet.", zero=True),
        maker.pressures("shear-dilation", "Rate of dilation", "dε_{v} / dε_{a}",
                        "volumetric_strain",
                        "Slope of the curves before, over a window of 0.02. The text has a maximum "
                        "from 0.35 to 1.1, which falls and comes later as pressure grows.",
                        map_y=lambda x, y: series.slope(x, y, WINDOW), zero=True),
        maker.pressures("shear-porosity", "Porosity", "porosity", "porosity",
                        "In the text initial and steady values depend on the pressure."),
        maker.pressures("shear-density", "Packing density", "packing density",
                        lambda row: 1.0 - row["porosity"],
                        "The other side of porosity: how much of the cell is filled."),
        peak(maker, "peak-angle", "Peak friction angle", "friction angle, degrees",
             "peak_friction_angle_deg", "In the text it falls as pressure grows, from 43.5° to "
                                        "39°."),
        peak_strains(maker),
        peak(maker, "peak-dilation", "Peak rate of dilation", "dε_{v} / dε_{a}",
             "peak_dilation_rate",
             "In the text it falls as pressure grows, from 1.1 to 0.35."),
        maker.against_pressure(
            "steady-density", "Loss of packing density to the steady state", "ρ_{i} − ρ_{ss}",
            {"to 20.5 % strain": lambda folder: results.value_at(folder, "porosity", STEADY)
                                                - results.first(folder, "porosity")},
            "The text finds it strongly correlated with the pressure, and does not give the sign."),
        plane_dilation(maker),
    ]


def peak(maker, key, title, label, name, caption):
    results = maker.results

    def measure(folder):
        return results.summary(folder, name)

    return maker.against_pressure(key, title, label, {"b/a = 0.7": measure}, caption)


def peak_strains(maker):
    def of(name):
        return lambda folder: maker.results.summary(folder, name)

    return maker.against_pressure(
        "peak-strain", "Strains of the peaks", "axial strain",
        {"peak friction": of("strain_at_peak_friction"),
         "peak dilation": of("strain_at_peak_dilation")},
        "In the text both grow with the pressure; friction peaks well before dilation, and with it "
        "at the highest pressure.")


def plane_dilation(maker):
    """Peak dilation of spheroids, ellipses, disks, over eccentricity, beside published ranges."""
    results = maker.results

    def measure(folder):
        return results.summary(folder, "peak_dilation_rate")

    plane = results.points("disks and ellipses", {e: f"ellipse-e{round(100 * e):02d}-shear"
                                                  for e in (0.0, 0.05, 0.1, 0.15, 0.2)}, measure,
                           colour=COLOURS[0])
    space = []
    for k, pressure in enumerate((10, 100)):
        space.append(results.points(f"spheroids, {pressure} MPa", {0.176: shear_of(pressure)},
                                    measure,
                                    colour=COLOURS[1 + k]))
    ranges = [charts.Curve("published, plane", [0.05, 0.2, 0.2, 0.05, 0.05],
                           [0.8, 0.8, 1.9, 1.9, 0.8],
                           colour=COLOURS[7], style="dashes"),
              charts.Curve("published, space", [0.17, 0.182, 0.182, 0.17, 0.17],
                           [0.35, 0.35, 1.1, 1.1, 0.35], colour=COLOURS[4], style="dashes")]
    if not any(curve.shows() for curve in [plane, *space]):
        ranges = []
    return maker.chart("peak-dilation-plane", "Peak rate of dilation, plane and space",
                       "eccentricity e",
                       "dε_{v} / dε_{a}", [plane, *space, *ranges],
                       "Frames are the ranges of the text: 0.8 to 1.9 for ellipses in the plane, "
                       "0.35 to 1.1 in space. It gives 0 to 0.78 for Ham River "
                       "sand.", x_range=(-0.02, 0.23),
                       y_range=(0, None))


COMPARED = """
<p>The same test with other samples: spheres, a loose start, fewer particles, another contact law,
other shapes, and other ratios of the two lateral stresses. b = 0 is the triaxial test; with
b = 1 one lateral stress is as high as the axial one.</p>
"""


def compared(maker):
    results = maker.results

    def several(key, title, label, y, stems, caption, **options):
        curves = [results.curve(name, stem, y, stage="shear", colour=COLOURS[k])
                  for k, (name, stem) in enumerate(stems.items())]
        return maker.chart(key, title, "axial strain", label, curves, caption, **options)

    spheres = {"spheroids, 10 MPa": shear_of(10), "spheroids, 100 MPa": shear_of(100),
               "spheres, 10 MPa": shear_of(10, "sphere"),
               "spheres, 100 MPa": shear_of(100, "sphere")}
    loose = {"dense, 10 MPa": shear_of(10), "dense, 50 MPa": shear_of(50),
             "loose, 10 MPa": shear_of(10, "loose"), "loose, 50 MPa": shear_of(50, "loose")}
    sizes = {"test 3, 47 MPa": "test3-shear", "test 4c, 50 MPa": shear_of(50),
             "test 1, 7 MPa": "test1-shear", "test 4e, 10 MPa": shear_of(10)}
    bodies = {"spheroids": shear_of(50), "by Hertz's law": shear_of(50, "hertz"),
              "triaxial bodies": shear_of(50, "triaxial"), "two sizes": shear_of(50, "twosize")}
    angle, volume = "friction_angle_deg", "volumetric_strain"
    return [
        several("compared-spheres", "Spheroids and spheres", "friction angle, degrees", angle,
                spheres,
                "Samples are prepared alike. The text says that other bodies than spheres resist "
                "more, over a longer strain."),
        several("compared-loose", "Dense and loose samples", "friction angle, degrees", angle,
                loose,
                "In the text the ultimate angle does not depend on the initial state."),
        several("compared-loose-void", "Dense and loose: void ratio", "void ratio",
                lambda row: row["porosity"] / (1.0 - row["porosity"]), loose,
                "In the text the void ratio of the steady state depends on the pressure."),
        several("compared-size", "How many particles", "friction angle, degrees", angle, sizes,
                "Tests 1 and 3 have 27 and 125 particles, 4c and 4e 1000. The text finds test 3 "
                "very close to 4c, and test 1, which is ten times faster, unlike 4e."),
        several("compared-size-volume", "How many particles: volume", "volumetric strain", volume,
                sizes,
                "The same tests' volumetric strains.", zero=True),
        several("compared-bodies", "Other laws and bodies at 50 MPa", "friction angle, degrees",
                angle,
                bodies, "Hertz's law at equal mean overlap: the text finds similar results. "
                        "Triaxial bodies and two sizes are what it names as next."),
        *(several(f"compared-lode-{family}", f"Ratio b of the lateral stresses: {family}s",
                  "friction angle, degrees", angle,
                  {f"b = {b:g}": f"{family}-p030-b{round(100 * b):03d}-shear"
                   for b in (0.0, 0.25, 0.5, 1.0)},
                  "b = (σ<sub>yy</sub> − σ<sub>xx</sub>) / (σ<sub>zz</sub> − σ<sub>xx</sub>), at "
                  "30 MPa. The text says that the stress-force-fabric relation holds at any b; see "
                  "below.")
          for family in ("sphere", "spheroid")),
    ]


CONTACTS = """
<p>Contacts go in three <em>direction groups</em>: a contact is in the group of the axis along which
its normal's component is the largest. The text gives no rule for its groups; this is ours.</p>
"""


def contacts(maker):
    results = maker.results
    return [
        maker.pressures("shear-coordination", "Coordination number", "coordination number",
                        "coordination_number",
                        "In the text it falls steadily, is constant and near 6 at large strain, "
                        "and is delayed at the start for large pressures."),
        maker.pressures("shear-loss", "Rate of the loss of contacts", "dγ / dε_{a}",
                        "coordination_number",
                        "Slope over a window of 0.02. In the text it depends on pressure within "
                        "the first 5 % alone.", map_y=lambda x, y: series.slope(x, y, WINDOW),
                        zero=True),
        maker.pressures("shear-scatter", "Scatter of the coordination number",
                        "standard deviation s_{γ}",
                        "coordination_std",
                        "The text finds no significant change, in shear or with "
                        "pressure.", y_range=(0, None)),
        maker.against_pressure(
            "steady-coordination", "Loss of contacts to the steady state", "γ_{i} − γ_{ss}",
            {"to 20.5 % strain": lambda folder: results.first(folder, "coordination_number")
                                                - results.value_at(folder, "coordination_number",
                                                                   STEADY)},
            "The text calls it nearly independent of pressure, and has initial values that differ "
            "by 2.9: it contradicts itself.", y_range=(0, None)),
        maker.pressures("shear-force", "Mean normal force", "mean normal force, GN",
                        lambda row: 1e-9 * row["mean_normal_force"],
                        "Mean over contacts: fewer contacts bear a mean stress that is held."),
        maker.against_pressure(
            "force-pressure", "Mean normal force against pressure", "f_{0}, GN",
            {"initial": lambda folder: initial_f0(results, folder),
             "at 20.5 % strain": lambda folder: 1e-9 * results.value_at(folder, "f0", STEADY,
                                                                        "micro")},
            "Mean over orientations. The text finds initial and steady values strongly correlated "
            "with pressure.", y_range=(0, None)),
        groups_at(maker, 30),
        maker.pressures("groups-fraction", "Share of the direction groups", "share of the contacts",
                        "fraction_z",
                        "Full lines: axial group; dashes: mean of the two lateral ones. In the "
                        "text the axial share never falls below its initial value, and bias is "
                        "largest after the peak.",
                        kind="micro",
                        dashed=lambda row: 0.5 * (row["fraction_x"] + row["fraction_y"]),
                        dashed_name="lateral"),
        maker.pressures("groups-force", "Mean normal force of the direction groups",
                        "mean force / f_{0}", lambda row: row["normal_force_z"] / row["f0"],
                        "Full lines: axial group; dashes: lateral. In the text the axial force "
                        "rises up to the peak and the lateral one falls strongly.", kind="micro",
                        dashed=lambda row: (row["normal_force_x"] + row["normal_force_y"])
                                          / (2 * row["f0"]),
                        dashed_name="lateral", y_range=(0, None)),
    ]


def initial_f0(results, folder):
    """GN; of the state kept before shear, else of the first averages in it."""
    kept = results.averages(folder, "shear-A").get("f0")
    return 1e-9 * (kept or results.first(folder, "f0", "micro"))


def groups_at(maker, pressure):
    curves = [maker.results.curve(name, shear_of(pressure),
                                  lambda row, axis=axis: row["contacts"] * row["fraction_" + axis],
                                  kind="micro", stage="shear", colour=COLOURS[k])
              for k, (name, axis) in enumerate({"axial, z": "z", "lateral, x": "x",
                                                "lateral, y": "y"}.items())]
    return maker.chart("groups-contacts", f"Contacts of the direction groups at {pressure} MPa",
                       "axial strain", "contacts", curves,
                       "In the text all three groups lose contacts, the axial one slowest.",
                       y_range=(0, None))


def chapters(maker):
    return [Chapter("shear", "Shear: stress, volume and density", TEXT, stress(maker)),
            Chapter("compared", "Shear: other samples", COMPARED, compared(maker)),
            Chapter("contacts", "Contacts and forces in shear", CONTACTS, contacts(maker))]


