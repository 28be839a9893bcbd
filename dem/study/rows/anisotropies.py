# SPDX-License-Identifier: MIT
"""Distributions by direction (chapter 2) and anisotropies in shear (5.4.8, 8.5.2).

Moduli are sqrt(a_ij a_ij); a_s is sqrt(3/2) |deviator| over the mean stress. Chapter 2 looks at
20 % of strain and does not say at which pressure: all are looked at.
"""
import statistics

from measures import Unmeasurable, least_squares_slope
from rows.common import FOUR, SETS, means, micro_by_pressure, pressure, shear_name
from verdicts import Finding, Section, all_of, each, labelled, on_sets, order, series, spread, text

rows = Section("3.5")

LATE = 0.2  # of chapter 2
SIZES = ("A_r", "A_n", "A_t")


def at_peak(test, name):
    """Mean over 0.02 of strain at the peak friction angle."""
    return test.mean_at(name, test.peak_friction[1] / test.stretch, 0.02)


def top(test, name):
    """(largest mean over 0.02 of axial strain, its strain)"""
    values, strains = test[name], test.strain
    known = [(x, v) for x, v in zip(strains, values) if v is not None]
    if not known:
        raise Unmeasurable(f"{name} has no values")
    return max((statistics.fmean(w for y, w in known if abs(y - x) <= 0.01), x) for x, _ in known)


@rows.row("classes", "2.3.2.2",
          "384 classes of direction hold 15 to 30 contact normals each", "15 to 30",
          "sides of a thousand bodies' contacts over 384 in 14 to 33, test 4d at A and at the end")
def classes(study):
    found = {}
    for name, measure in (("A", lambda test: test.start("coordination_number")),
                          ("end", lambda test: test.last("coordination_number"))):
        found[name] = each(study, lambda seed, measure=measure: 1000 * measure(
            study.test(shear_name("spheroid", "p030", seed))) / 384)
    return Finding(*series(found), all(14 <= x <= 33 for x in means(found)))


@rows.row("fourth-order", "2.5.1-2.5.3",
          "Fourth-order terms improve the fit to normals noticeably, to normal forces not "
          "dramatically, to tangential forces dramatically",
          "order",
          "unexplained variance falls for each, relatively most for tangential forces, at the "
          "peak and at 20 %, 10 to 70 MPa")
def fourth_order(study):
    findings = []
    for where, measure in (("peak", at_peak), ("20 %", lambda test,
                                               name: test.mean_at(name, LATE, 0.02))):
        def gain(what, measure=measure):
            return statistics.fmean(means(micro_by_pressure(study, FOUR, lambda test: 1.0 - measure(
                test, f"unexplained4_{what}") / measure(test, f"unexplained2_{what}"))))
        gains = {name: gain(what) for name, what in (("normals", "r"), ("normal", "n"),
                                                     ("tangential", "t"))}
        met = min(gains.values()) > 0.0 and max(gains, key=gains.get) == "tangential"
        findings.append(Finding(f"{where}: " + ", ".join(f"{k} {text(v)}" for k,
                                                         v in gains.items()),
                                "", len(study.seeds), met))
    found = all_of(*findings)
    found.note = "share of what order 2 leaves that order 4 takes"
    return found


@rows.row("radial", "2.5.4, F. 2.10",
          "Fourth-order terms correct size and direction of the largest radial tangential force",
          "both corrected",
          "both nearer to the measured rings than second order, test 4d at the peak")
def radial(study):
    def off(seed):
        rings = study.averages(shear_name("spheroid", "p030", seed),
                               "shear-C.polar")["radial_rings"]
        rings = [ring for ring in rings or [] if ring["value"] is not None]
        if not rings:
            raise Unmeasurable("no rings")

        def largest(name):
            best = max(rings, key=lambda ring: abs(ring[name]))
            return abs(best[name]), min(best["beta"], 3.141592653589793 - best["beta"])
        size, angle = largest("value")
        return [(abs(s / size - 1.0), abs(b - angle)) for s,
                b in (largest("model2"), largest("model4"))]
    size2, size4 = (each(study, lambda seed, k=k: off(seed)[k][0]) for k in (0, 1))
    turn2, turn4 = (each(study, lambda seed, k=k: off(seed)[k][1]) for k in (0, 1))
    samples = {"size, order 2": size2, "order 4": size4, "angle, order 2": turn2,
               "angle, order 4": turn4}
    return Finding(*series(samples), size4.mean < size2.mean and turn4.mean <= turn2.mean,
                   "distances from the measured ones: part, and rad")


@rows.row("symmetric", "2.4.2.1",
          "The tensor of tangential forces is symmetric, as contact vector and normal are nearly "
          "parallel",
          "symmetric; very small angle", "both reported",
          doubt="[E12] the angle's surface mean is 13 degrees; symmetry needs balance of moments "
                "alone")
def symmetric(study):
    lack = micro_by_pressure(study, FOUR, lambda test: test.mean_at("asymmetry_t", LATE, 0.02))
    angle = micro_by_pressure(study, FOUR, lambda test: test.mean_at("vector_normal_angle_mean_deg",
        LATE, 0.02))
    return all_of(labelled("|F - F'|/|F|", Finding(*series(lack, 2))),
                  labelled("mean angle, degrees", Finding(*series(angle))))


@rows.row("independent", "2.6",
          "Forces and contact vectors are independent inside classes of direction", "independent",
          "from class means the mean stress within 3 % and a_s within 1 % of the direct ones, at "
          "20 %, 10 to 70 MPa")
def independent(study):
    def ratio(test, name):
        return test.mean_at(f"{name}_independent", LATE, 0.02) / test.mean_at(name, LATE,
            0.02) - 1.0
    mean = micro_by_pressure(study, FOUR, lambda test: ratio(test, "mean_stress"))
    shear = micro_by_pressure(study, FOUR, lambda test: ratio(test, "a_s"))
    met = max(map(abs, means(mean))) <= 0.03 and max(map(abs, means(shear))) <= 0.01
    return all_of(labelled("mean stress", Finding(*series(mean, 2), met)),
                  labelled("a_s", Finding(*series(shear, 2))))


@rows.row("fabric", "F. 5.16",
          "The anisotropy of contact normals rises and then softens: sphere, ellipsoid, peanut",
          "peak, softening",
          "largest value above that at the start and that at the end, every pressure",
          doubt="[C] whether its steady value depends on the pressure: 8.5.2 (4)")
def fabric(study):
    def find(whats):
        peak = micro_by_pressure(study, whats, lambda test: top(test, "A_r")[0])
        last = micro_by_pressure(study, whats, lambda test: test.last("A_r", 0.02))
        first = micro_by_pressure(study, whats, lambda test: test.start("A_r"))
        met = all(p > a and p > b for p, a, b in zip(means(peak), means(last), means(first)))
        return all_of(labelled("largest", Finding(*series(peak), met)),
                      labelled("at the end", Finding(*series(last))))
    return on_sets(SETS, find)


def _steady(study, name):
    def find(whats):
        last = micro_by_pressure(study, whats, lambda test: test.last(name, 0.02))
        part = spread(last) / abs(statistics.fmean(means(last)))
        return Finding(*series(last), part <= 0.15, f"spread {100 * part:.0f} % of the mean")
    return on_sets(SETS, find)


@rows.row("normal-steady", "F. 5.17",
          "The steady anisotropy of normal forces does not depend on the pressure", "independent",
          "spread of the last values at most 15 % of their mean")
def normal_steady(study):
    return _steady(study, "A_n")


@rows.row("tangential-steady", "F. 5.18",
          "That of tangential forces rises fast and declines slowly to one value", "one value",
          "spread of the last values at most 15 % of their mean")
def tangential_steady(study):
    return _steady(study, "A_t")


def _tops(study, whats, part):
    return {name: micro_by_pressure(study, whats, lambda test, name=name: top(test, name)[part])
            for name in (*SIZES, "a_s")}


@rows.row("maxima", "F. 5.19",
          "Largest values: normal force above a_s; normals second, tangential force third", "order",
          "max a^n > max a_s, and max a^n > max a^r > max a^t, at every pressure")
def maxima(study):
    def find(whats):
        found = _tops(study, whats, 0)
        met = all(n > s and n > r > t for r, n, t,
                  s in zip(*(means(found[k]) for k in (*SIZES, "a_s"))))
        return all_of(*(labelled(name, Finding(*series(one), met)) for name, one in found.items()))
    return on_sets(SETS, find)


@rows.row("maxima-strains", "F. 5.19",
          "Normals and normal force peak after a_s, tangential force before it", "order",
          "strains of the maxima in this order at every pressure")
def maxima_strains(study):
    def find(whats):
        found = _tops(study, whats, 1)
        met = all(t < s < r and s < n for r, n, t,
                  s in zip(*(means(found[k]) for k in (*SIZES, "a_s"))))
        return all_of(*(labelled(name, Finding(*series(one), met)) for name, one in found.items()))
    return on_sets(SETS, find)


@rows.row("maxima-slopes", "F. 5.19, 8.5.2 (5)",
          "The peak of normals falls sharply with the pressure; those of the forces rise very "
          "moderately",
          "order", "slope of the first below 0, of the others at least 0 and smaller in size")
def maxima_slopes(study):
    def find(whats):
        found = _tops(study, whats, 0)
        p = [pressure(what) / 100.0 for what in whats]
        slope = {name: least_squares_slope(p, means(found[name])) for name in SIZES}
        met = slope["A_r"] < 0.0 and all(0.0 <= slope[k] < -slope["A_r"] for k in ("A_n", "A_t"))
        shown = ", ".join(f"{name} {text(value)}" for name, value in slope.items())
        return Finding(shown, "", len(study.seeds), met, "per 100 MPa")
    return on_sets(SETS, find)


@rows.row("rates", "8.5.2 (4)",
          "The initial rates of all three fall with the pressure", "fall",
          "rates to 1 % of strain in strict order")
def rates(study):
    def find(whats):
        return all_of(*(labelled(name, order(micro_by_pressure(
            study, whats, lambda test, name=name: (test.mean_at(name, 0.01, 0.004)
                                                   - test.start(name))
            / (0.01 * test.stretch)), rising=False)) for name in SIZES))
    return on_sets(SETS, find)


@rows.row("plane", "(5.5)",
          "Plane disks: a_s is half the sum of the anisotropies while these are small",
          "a_s = (a^r + a^n + a^t)/2",
          "within 5 % at the peak and at the end; the exact form within 3 %")
def plane(study):
    found = {}
    for name in ("a_s_small", "a_s_coaxial"):
        for where, measure in (("peak", at_peak), ("end", lambda test, key: test.last(key, 0.02))):
            found[f"{name[4:]}, {where}"] = each(study, lambda seed, name=name, measure=measure: (
                lambda test: measure(test, name) / measure(test, "a_s") - 1.0)(
                    study.micro_test(shear_name("ellipse", "e00", seed))))
    off = list(map(abs, means(found)))
    return Finding(*series(found, 2), max(off[:2]) <= 0.05 and max(off[2:]) <= 0.03,
                   "part above the measured a_s")


@rows.row("branch", "F. 5.20",
          "The anisotropy of branch vectors grows linearly, and depends little on the pressure",
          "linear", "R^2 of a line at least 0.95 from 5 % of strain on; spread reported")
def branch(study):
    def find(whats):
        def fit(test):
            rows_ = [(x, v) for x, v in zip(test.strain, test["A_z"]) if x >= 0.05 * test.stretch
                     and v is not None]
            if len(rows_) < 3:
                raise Unmeasurable("too few rows")
            x, y = zip(*rows_)
            slope, mean = least_squares_slope(x, y), statistics.fmean(y)
            rest = sum((b - mean - slope * (a - statistics.fmean(x)))**2 for a, b in rows_)
            total = sum((b - mean)**2 for b in y)
            return 1.0 - rest / total if total else 0.0
        line = micro_by_pressure(study, whats, fit)
        last = micro_by_pressure(study, whats, lambda test: test.last("A_z", 0.02))
        return all_of(labelled("R^2", Finding(*series(line), min(means(line)) >= 0.95)),
                      labelled("at the end", Finding(*series(last))))
    return on_sets(SETS, find)


@rows.row("branch-length", "F. 5.21",
          "The mean branch is constant, independent of the pressure, above two radii", "above 20 m",
          "reported, beside spheres",
          doubt="[E6] overlaps of Table 5.2 run from 0.6 to 4.3 % of two radii, and two support "
                "heights average 19.58 before overlap")
def branch_length(study):
    def find(family, whats, name):
        return Finding(*series(micro_by_pressure(study, whats, lambda test: statistics.fmean(
            v for v in test[name] if v is not None), family), 4))
    return all_of(labelled("normal part", find("spheroid", FOUR, "z0")),
                  labelled("length", find("spheroid", FOUR, "mean_branch_length")),
                  labelled("spheres, length", find("sphere", ("p010", "p050", "p100"),
                                                   "mean_branch_length")))


@rows.row("horizontal", "5.4.8.5",
          "Long axes, and long branches, turn horizontal", "horizontal",
          "axial components of both below 0 at the end, every pressure")
def horizontal(study):
    def find(whats):
        axes = micro_by_pressure(study, whats, lambda test: test.last("a_axial_E", 0.02))
        branches = micro_by_pressure(study, whats, lambda test: test.last("a_axial_len", 0.02))
        return all_of(labelled("axes", Finding(*series(axes), max(means(axes)) < 0.0)),
                      labelled("branches", Finding(*series(branches), max(means(branches)) < 0.0)))
    return on_sets(SETS, find)
