# SPDX-License-Identifier: MIT
"""What anisotropies bear of the stress and of the shear strength (chapter 6).

Predicted is by the published seven parts of second order (`_seven`); `_eight` has the part that the
text drops, `_fourth` the terms of fourth order too. Shares are of a_s as predicted by the seven.
"""
import math
import statistics

from measures import Unmeasurable
from rows.anisotropies import at_peak
from rows.common import FOUR, SETS, means, micro_by_pressure, shear_name
from verdicts import Finding, Section, all_of, each, labelled, on_sets, series, text

rows = Section("3.6")

TEST_4E = "p010"
FORCE, BRANCH = ("n", "t"), ("z", "zt")


def at_end(test, name):
    return test.last(name, 0.02)


def of_test(study, what, measure, family="spheroid"):
    return each(study, lambda seed: measure(study.micro_test(shear_name(family, what, seed))))


@rows.row("branch-fit", "F. 6.2",
          "Second order fits normal parts of branches very well; tangential parts are fitted "
          "poorly by second and fourth order",
          "very well; poorly",
          "normal parts: unexplained below 0.2 at 20 %, 10 to 70 MPa; tangential parts reported")
def branch_fit(study):
    def left(name):
        return micro_by_pressure(study, FOUR, lambda test: test.mean_at(name, 0.2, 0.02))
    normal = left("unexplained2_z")
    return all_of(labelled("normal", Finding(*series(normal, 2), max(means(normal)) < 0.2)),
                  labelled("tangential, order 2", Finding(*series(left("unexplained2_zt"), 2))),
                  labelled("order 4", Finding(*series(left("unexplained4_zt"), 2))))


def _predicted(study, whats, family="spheroid", names=("s1", "mean_stress", "a_s")):
    """Largest relative errors of the seven parts at C and at the end, and of the other models."""
    def worst(kind, measure):
        return micro_by_pressure(study, whats, lambda test: max(abs(
            measure(test, f"{name}_{kind}") / measure(test, name) - 1.0) for name in names), family)
    peak, end = worst("seven", at_peak), worst("seven", at_end)
    met = max(means(peak)) <= 0.04 and max(means(end)) <= 0.08
    beside = "; ".join(f"{kind}: {text(max(means(worst(kind, at_peak))), 2)} and "
                       f"{text(max(means(worst(kind, at_end))), 2)}"
                       for kind in ("eight", "fourth"))
    return all_of(labelled("at C", Finding(*series(peak, 2), met)),
                  labelled("at the end", Finding(*series(end, 2), note=f"at worst with {beside}")))


@rows.row("stress", "F. 6.3-6.6",
          "Principal stresses and a_s are close to the measured ones, slightly less at large "
          "strain",
          "close",
          "major and mean stress and a_s within 4 % at C and 8 % at the end, by unbiased fits")
def stress(study):
    return on_sets(SETS, lambda whats: _predicted(study, whats))


@rows.row("triaxial", "6.4.1",
          "The relation holds in true triaxial tests", "holds",
          "the same bars at b = 0, 0.25, 0.5, 1, spheres and spheroids at 30 MPa")
def triaxial(study):
    whats = [f"p030-b{ratio:03d}" for ratio in (0, 25, 50, 100)]
    return all_of(*(labelled(f"{family}s", _predicted_lode(study, whats, family)) for family in (
        "sphere", "spheroid")))


def _predicted_lode(study, whats, family):
    def worst(measure):
        return {f"b {int(what[-3:]) / 100}": of_test(study, what, lambda test: max(abs(
            measure(test, f"{name}_seven") / measure(test, name) - 1.0)
            for name in ("s1", "mean_stress", "a_s")), family) for what in whats}
    peak, end = worst(at_peak), worst(at_end)
    met = max(means(peak)) <= 0.04 and max(means(end)) <= 0.08
    return all_of(labelled("at C", Finding(*series(peak, 2), met)),
                  labelled("at the end", Finding(*series(end, 2))))


@rows.row("inherent", "6.4.1",
          "It holds at any initial anisotropy", "holds",
          "the same bars for the sample whose axes grew horizontal, 10 to 70 MPa")
def inherent(study):
    return _predicted(study, FOUR, "horizontal")


@rows.row("lode", "3.1",
          "The Lode parameter is held in true triaxial tests", "constant",
          "(s_yy - s_xx)/(s_zz - s_xx) within 0.01 of b after 1 % of strain")
def lode(study):
    found = {}
    for family in ("sphere", "spheroid"):
        for ratio in (0, 25, 50, 100):
            def off(test, b=ratio / 100):
                rows_ = zip(test.strain, test["s_xx"], test["s_yy"], test["s_zz"])
                return max(abs((yy - xx) / (zz - xx) - b) for x, xx, yy, zz in rows_
                           if x >= 0.01 and zz != xx)
            found[f"{family} b {ratio / 100}"] = each(study, lambda seed, f=family, r=ratio,
                                                      off=off: off(
                study.test(shear_name(f, f"p030-b{r:03d}", seed))))
    return Finding(*series(found, 2), max(means(found)) <= 0.01, "largest distance in any row")


@rows.row("coaxial", "F. 6.7-6.10, 4e",
          "The parts are coaxial with the stress", "coaxial",
          "axes of the fabric's and the forces' part within 3 degrees after 1 % of strain, test "
          "4e")
def coaxial(study):
    found = {name: of_test(study, TEST_4E, lambda test,
                           name=name: max(test.after(f"axial_deg_{name}", 0.01)))
             for name in ("fabric", "force", "fabric_force")}
    return Finding(*series(found, 2), max(means(found)[:2]) <= 3.0, "largest, degrees")


def mean_of(test, part, k):
    values = [test[f"{part}_{axis}"][k] for axis in ("xx", "yy", "zz")]
    return None if None in values else sum(values) / 3.0


@rows.row("mean", "6.4.2 iii",
          "Fabric and force has the second largest mean, and offsets the fall of the isotropic "
          "part",
          "offsets", "|s0 + mean of rf - p| at most 0.03 p after 1 %, 10 to 70 MPa")
def mean(study):
    def worst(test):
        found = [abs(s0 + rf - p) / p for x, s0, rf, p in zip(
            test.strain, test["s0"], (mean_of(test, "fabric_force", k)
                                      for k in range(len(test.strain))),
            test["mean_stress"]) if x >= 0.01 * test.stretch and None not in (s0, rf)]
        if not found:
            raise Unmeasurable("no rows")
        return max(found)
    found = micro_by_pressure(study, FOUR, worst)
    return Finding(*series(found, 2), max(means(found)) <= 0.03, "largest, over p")


@rows.row("isotropic", "6.4.2 iv",
          "The isotropic part falls to a minimum, then rises very slowly; the mean force rises, "
          "the contact density falls",
          "order",
          "least value inside the test and below both ends; the mean force higher, the density "
          "lower at the end, 10 to 70 MPa",
          doubt="[E6] the branch is said to be constant")
def isotropic(study):
    def depth(test):
        least = min((v, x) for x, v in zip(test.strain, test["s0"]) if v is not None)
        return (at_end(test, "s0") - least[0]) / test.start("s0"), (test.start("s0")
            - least[0]) / test.start("s0")
    rise = micro_by_pressure(study, FOUR, lambda test: depth(test)[0])
    fall = micro_by_pressure(study, FOUR, lambda test: depth(test)[1])
    force = micro_by_pressure(study, FOUR, lambda test: at_end(test, "f0") / test.start("f0"))
    density = micro_by_pressure(study, FOUR, lambda test: at_end(test, "contact_density")
                                / test.start("contact_density"))
    met = min(means(rise) + means(fall)) > 0 and min(means(force)) > 1 and max(means(density)) < 1
    return all_of(labelled("fall", Finding(*series(fall, 2), met)),
                  labelled("rise", Finding(*series(rise, 2))),
                  labelled("force, end over start", Finding(*series(force))),
                  labelled("density", Finding(*series(density))))


@rows.row("noshape", "F. 6.11",
          "Leaving branches out matters more at large strain", "grows",
          "relative change of a_s larger at the end than at the peak, every pressure")
def noshape(study):
    def find(whats):
        def change(measure):
            return micro_by_pressure(study, whats, lambda test: abs(
                measure(test, "a_s_noshape") / measure(test, "a_s_seven") - 1.0))
        peak, end = change(at_peak), change(at_end)
        return all_of(labelled("peak", Finding(*series(peak, 2),
                                               all(a < b for a,
                                                   b in zip(means(peak), means(end))))),
                      labelled("end", Finding(*series(end, 2))))
    return on_sets(SETS, find)


@rows.row("axisymmetric", "F. 6.12",
          "Intermediate and minor principal values are equal", "equal",
          "their difference over the major value below 0.15 for a^r, a^n, a^t, test 4e at the "
          "peak and the end")
def axisymmetric(study):
    found = {f"{name}, {where}": of_test(study, TEST_4E, lambda test, name=name,
                                         measure=measure: measure(
        test, f"axisymmetry_{name}")) for name in ("r", "n", "t") for where, measure in (
            ("peak", at_peak), ("end", at_end))}
    return Finding(*series(found, 2), max(means(found)) < 0.15)


@rows.row("components", "F. 6.13",
          "a_s by components is a_s by the moduli alone (6.46)", "equal",
          "1e-12 on coaxial axisymmetric tensors is a test of the library; here the largest "
          "difference is reported")
def components(study):
    found = micro_by_pressure(study, FOUR, lambda test: max(
        abs(a / b - 1.0) for x, a, b in zip(test.strain, test["a_s_axisymmetric"],
                                            test["a_s_seven"])
        if x >= 0.01 * test.stretch and a is not None and b))
    return Finding(*series(found, 2), None, "relative, after 1 %")


def by_moduli(r, n, t, z, zt):
    """a_s by (6.49) from moduli: signs of large strain."""
    r, n, t, z, zt = abs(r), abs(n), abs(t), -abs(z), -abs(zt)
    d_n = 1 + (2 / 15) * (r * n + r * z + n * z + 1.5 * t * zt)
    c = math.sqrt(1.5) * 0.4 / d_n
    d = math.sqrt(1.5) * (2 / 35) / math.sqrt(6) / d_n
    return c * (r + z + 1.5 * zt + n + 1.5 * t) + d * (
        r * (4 * z + 3 * zt) + r * (4 * n + 3 * t) + 4 * n * z + 3 * t * z + 3 * n * zt + 7.5 * t
        * zt)


@rows.row("large-strain", "6.5.3.7",
          "The relation for large strain (6.49) holds from before the peak on", "holds",
          "within 2 % of the seven parts after the peak, 10 to 70 MPa")
def large_strain(study):
    def worst(test):
        found = []
        for k, x in enumerate(test.strain):
            sizes = [test[f"A_{name}"][k] for name in ("r", "n", "t", "z", "zt")]
            if x >= test.peak_friction[1] and None not in sizes and test["a_s_seven"][k]:
                found.append(abs(by_moduli(*sizes) / test["a_s_seven"][k] - 1.0))
        if not found:
            raise Unmeasurable("no rows after the peak")
        return statistics.fmean(found)
    found = micro_by_pressure(study, FOUR, worst)
    return Finding(*series(found, 2), max(means(found)) <= 0.02, "mean relative distance after "
                                                                 "the peak")
