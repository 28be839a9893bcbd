# SPDX-License-Identifier: MIT
"""Shear tests: stress, volume, density (5.4.1-5.4.3, 8.5.1)."""
import dataclasses

from measures import STEADY, correlation
from rows.common import SETS, by_pressure, label, means, pressure, shear_name
from verdicts import (Finding, Section, all_of, each, labelled, on_sets, order, series, spread,
                      text)

rows = Section("3.3")


@rows.row("softening", "5.4.1, F. 5.7a",
          "Strength peaks and then falls, at every pressure", "peak, softening",
          "peak friction angle above that at the end")
def softening(study):
    def find(whats):
        drop = by_pressure(study, whats, lambda test: test.peak_friction[0]
                           - test.last("friction_angle_deg"))
        return Finding(*series(drop), min(means(drop)) > 0.0, "fall in degrees")
    return on_sets(SETS, find)


@rows.row("one-curve", "5.4.1, F. 5.7a",
          "At large strain all pressures have one friction angle", "one curve",
          "spread over pressures at most 3 degrees at the last strain")
def one_curve(study):
    def find(whats):
        last = by_pressure(study, whats, lambda test: test.last("friction_angle_deg"))
        return Finding(*series(last), spread(last) <= 3.0,
                       f"spread {spread(last):.2f} degrees")
    return on_sets(SETS, find)


@rows.row("peak-range", "5.4.1, F. 5.8a",
          "Peak friction angles", "39 to 43.5 degrees", "every pressure in 38 to 44.5 degrees")
def peak_range(study):
    def find(whats):
        peak = by_pressure(study, whats, lambda test: test.peak_friction[0])
        return Finding(*series(peak), all(38.0 <= x <= 44.5 for x in means(peak)))
    return on_sets(SETS, find)


@rows.row("peak-order", "F. 5.8a",
          "The peak friction angle falls with the pressure", "falls",
          "falls within the scatter of a seed, strictly from 30 MPa up")
def peak_order(study):
    def find(whats):
        peak = by_pressure(study, whats, lambda test: test.peak_friction[0])
        upper = {name: peak[name] for name in peak if name != "10"}
        return dataclasses.replace(
            order(peak, rising=False, within_scatter=True),
            met=order(peak, False, within_scatter=True).met and order(upper, False).met)
    return on_sets(SETS, find)


@rows.row("peak-strain", "F. 5.8c",
          "The axial strain at the peak grows with the pressure", "grows", "strict order")
def peak_strain(study):
    return on_sets(SETS, lambda whats: order(
        by_pressure(study, whats, lambda test: test.peak_friction[1]), rising=True))


@rows.row("no-contraction", "5.4.2, F. 5.7b",
          "The dense samples do not contract", "none", "volumetric strain never below -0.001")
def no_contraction(study):
    def find(whats):
        least = by_pressure(study, whats, lambda test: min(test["volumetric_strain"]))
        return Finding(*series(least, 2), min(means(least)) >= -0.001, "least values")
    return on_sets(SETS, find)


@rows.row("dilation-rise", "5.4.2",
          "The dilation rate rises to a maximum, then falls towards 0", "rises, falls",
          "its peak above its value at the first 1 % and at the end, every pressure")
def dilation_rise(study):
    def find(whats):
        def shape(test):
            slopes = test.slopes("volumetric_strain", 0.02)
            top = max(slope for _, slope in slopes)
            return top - max(slopes[0][1], slopes[-1][1])
        height = by_pressure(study, whats, shape)
        return Finding(*series(height), min(means(height)) > 0.0,
                       "peak over the larger of both ends")
    return on_sets(SETS, find)


@rows.row("dilation-order", "5.4.2, F. 5.7b",
          "At any strain the volume grows less at a higher pressure; the curves do not meet",
          "less at higher pressure", "order at axial strains 0.05, 0.1, 0.2 and the end")
def dilation_order(study):
    def find(whats):
        at = {f"{strain}": order(by_pressure(study, whats, lambda test: test.mean_at(
            "volumetric_strain", strain)), rising=False) for strain in (0.05, 0.1, 0.2)}
        at["end"] = order(by_pressure(study, whats, lambda test: test.last("volumetric_strain")),
                          rising=False)
        return all_of(*(labelled(f"at {strain}:", finding) for strain, finding in at.items()))
    return on_sets(SETS, find)


def _peak_dilation(study, whats, window=0.01, part=0):
    return by_pressure(study, whats, lambda test: test.peak_dilation(window)[part])


@rows.row("dilation-range", "F. 5.8b",
          "Peak dilation rates", "1.1 at the lowest pressure to 0.35",
          "both ends within 15 %, over a window of 0.01 of axial strain")
def dilation_range(study):
    def find(whats):
        peak = _peak_dilation(study, whats)
        low, high = means(peak)[0], means(peak)[-1]
        wider = ", ".join(map(text, means(_peak_dilation(study, whats, 0.02))))
        met = abs(low - 1.1) <= 0.15 * 1.1 and abs(high - 0.35) <= 0.15 * 0.35
        return Finding(*series(peak), met, f"over 0.02: {wider}")
    return on_sets(SETS, find)


@rows.row("dilation-falls", "F. 5.8b",
          "The peak dilation rate falls with the pressure", "falls", "strict order")
def dilation_falls(study):
    return on_sets(SETS, lambda whats: order(_peak_dilation(study, whats), rising=False))


@rows.row("dilation-strain", "F. 5.8d",
          "Its axial strain grows with the pressure", "grows", "strict order")
def dilation_strain(study):
    def find(whats):
        wider = ", ".join(map(text, means(_peak_dilation(study, whats, 0.02, 1))))
        return dataclasses.replace(order(_peak_dilation(study, whats, part=1), rising=True),
                                   note=f"over 0.02: {wider}")
    return on_sets(SETS, find)


@rows.row("peaks-apart", "F. 5.8e",
          "The friction angle peaks well before the dilation rate; at the highest pressure "
          "together",
          "before; together at the highest",
          "strain of the friction peak at most that of the dilation peak, every pressure",
          doubt="[C] 8.5.1 (5) has it before at every pressure")
def peaks_apart(study):
    def find(whats):
        lead = by_pressure(study, whats, lambda test: test.peak_dilation(0.02)[1]
                           - test.peak_friction[1])
        return Finding(*series(lead), min(means(lead)) >= 0.0,
                       "strain between, dilation over 0.02")
    return on_sets(SETS, find)


@rows.row("plane-dilation", "F. 5.9",
          "Peak dilation rates of plane ellipses, e = 0.05 to 0.2",
          "0.8 to 1.9; bodies in space 0.35 to 1.1, Ham River sand 0 to 0.78",
          "every e in 0.7 to 2.0")
def plane_dilation(study):
    peak = {f"e {e / 100}": each(study, lambda seed, e=e: study.test(
        shear_name("ellipse", f"e{e:02d}", seed)).peak_dilation(0.01)[0]) for e in (5, 10, 15, 20)}
    return Finding(*series(peak), all(0.7 <= x <= 2.0 for x in means(peak)))


@rows.row("density", "F. 5.10a",
          "Initial and steady packing fraction depend on the pressure", "depend",
          "both rise with it, in strict order")
def density(study):
    def find(whats):
        first = by_pressure(study, whats, lambda test: 1.0 - test.start("porosity"))
        steady = by_pressure(study, whats, lambda test: 1.0 - test.mean_at("porosity", STEADY))
        return all_of(labelled("initial", order(first, True)),
                      labelled("at 0.205", order(steady, True)))
    return on_sets(SETS, find)


@rows.row("density-loss", "(5.4), F. 5.10b",
          "The loss of packing fraction to the steady state (20.5 % strain) goes with the "
          "pressure",
          "strong correlation, steep", "|correlation| at least 0.98")
def density_loss(study):
    def find(whats):
        loss = by_pressure(study, whats, lambda test: test.mean_at("porosity", STEADY)
                           - test.start("porosity"))
        strength = correlation([pressure(what) for what in whats], means(loss))
        rates = ", ".join(text(-value / (STEADY * study.stretch)) for value in means(loss))
        return Finding(*series(loss), abs(strength) >= 0.98,
                       f"correlation {strength:.3f}; mean rates per axial strain {rates}")
    return on_sets(SETS, find)


@rows.row("ultimate", "8.5.1 (6)",
          "The ultimate friction angle does not depend on the initial state", "independent",
          "dense and loose preparation within 2 degrees at 10 and 50 MPa")
def ultimate(study):
    gap = {}
    for what in ("p010", "p050"):
        gap[label(what)] = each(study, lambda seed, what=what: study.test(
            shear_name("loose", what, seed)).last("friction_angle_deg") - study.test(
                shear_name("spheroid", what, seed)).last("friction_angle_deg"))
    return Finding(*series(gap), all(abs(x) <= 2.0 for x in means(gap)),
                   "loose less dense, degrees, by pressure in MPa")


@rows.row("steady-void", "8.5.1 (7)",
          "The steady void ratio depends on the pressure", "depends", "strict order at the end")
def steady_void(study):
    def void(test):
        porosity = test.last("porosity")
        return porosity / (1.0 - porosity)
    return on_sets(SETS, lambda whats: order(by_pressure(study, whats, void), rising=False))


@rows.row("spheres", "1.2, 8.1",
          "Non-spherical bodies resist more, and over a longer strain", "more",
          "spheres prepared alike: lower and earlier peak at 10, 50, 100 MPa")
def spheres(study):
    whats = ("p010", "p050", "p100")
    ours = by_pressure(study, whats, lambda test: test.peak_friction[0])
    round_ = by_pressure(study, whats, lambda test: test.peak_friction[0], "sphere")
    strain = by_pressure(study, whats, lambda test: test.peak_friction[1])
    round_strain = by_pressure(study, whats, lambda test: test.peak_friction[1], "sphere")
    met = all(a < b for a, b in zip(means(round_), means(ours))) and \
        all(a < b for a, b in zip(means(round_strain), means(strain)))
    return all_of(labelled("spheres, degrees", Finding(*series(round_), met)),
                  labelled("at strains", Finding(*series(round_strain))),
                  labelled("spheroids", Finding(*series(ours))),
                  labelled("at strains", Finding(*series(strain))))


@rows.row("points", "5.4.1",
          "Axial strains of the states A to D of test 4d", "not given", "reported",
          doubt="[?] no rule is given: B where a_s has lost four fifths of its steepest rise, C "
                "the peak, D where the volume changes by less than 0.02 a strain over 0.05")
def points(study):
    found = {point: each(study, lambda seed, point=point: study.test(
        shear_name("spheroid", "p030", seed)).points[point]) for point in "ABCD"}
    last = [study.test(shear_name("spheroid", "p030", seed)).points["D_is_last"]
            for seed in study.seeds[:len(found["D"])]]
    return Finding(*series(found), None, f"D is the last row in {sum(last)} of {len(last)}")
