# SPDX-License-Identifier: MIT
"""What anisotropies bear of the stress and of the shear strength (chapter 6).

Predicted is by the published seven parts of second order (`_seven`); `_eight` has the part that the
text drops, `_fourth` the terms of fourth order too. Shares are of a_s as predicted by the seven.
"""
import math
import statistics

from measures import STEADY, Unmeasurable, least_squares_slope
from rows.anisotropies import at_peak
from rows.common import FOUR, SETS, label, means, micro_by_pressure, shear_name
from verdicts import Finding, Sample, Section, all_of, each, labelled, near, on_sets, series, text

rows = Section("3.6")

TEST_4E = "p010"
FORCE, BRANCH = ("n", "t"), ("z", "zt")


def at_end(test, name):
    return test.last(name, 0.02)


def share(test, parts, measure):
    """Per cent of a_s of these parts together."""
    whole = measure(test, "a_s_seven")
    return 100.0 * sum(measure(test, f"share_{part}") for part in parts) / whole


def shares_of(test, parts, after=0.0):
    """(axial strain, per cent) of the rows from a strain of the study on."""
    found = []
    for k, x in enumerate(test.strain):
        values = [test[f"share_{part}"][k] for part in parts]
        whole = test["a_s_seven"][k]
        if x >= after * test.stretch and whole and None not in values:
            found.append((x, 100.0 * sum(values) / whole))
    if not found:
        raise Unmeasurable("no rows after that strain")
    return found


def of_test(study, what, measure, family="spheroid"):
    return each(study, lambda seed: measure(study.micro_test(shear_name(family, what, seed))))


@rows.row("branch-fit", "F. 6.2", "Second order fits normal parts of branches very well; tangential parts are "
          "fitted poorly by second and fourth order", "very well; poorly", "normal parts: unexplained below 0.2 at "
          "20 %, 10 to 70 MPa; tangential parts reported")
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
                       f"{text(max(means(worst(kind, at_end))), 2)}" for kind in ("eight", "fourth"))
    return all_of(labelled("at C", Finding(*series(peak, 2), met)),
                  labelled("at the end", Finding(*series(end, 2), note=f"at worst with {beside}")))


@rows.row("stress", "F. 6.3-6.6", "Principal stresses and a_s are close to the measured ones, slightly less at "
          "large strain", "close", "major and mean stress and a_s within 4 % at C and 8 % at the end, by unbiased fits")
def stress(study):
    return on_sets(SETS, lambda whats: _predicted(study, whats))


@rows.row("triaxial", "6.4.1", "The relation holds in true triaxial tests", "holds",
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


@rows.row("inherent", "6.4.1", "It holds at any initial anisotropy", "holds",
          "the same bars for the sample whose axes grew horizontal, 10 to 70 MPa")
def inherent(study):
    return _predicted(study, FOUR, "horizontal")


@rows.row("lode", "3.1", "The Lode parameter is held in true triaxial tests", "constant",
          "(s_yy - s_xx)/(s_zz - s_xx) within 0.01 of b after 1 % of strain")
def lode(study):
    found = {}
    for family in ("sphere", "spheroid"):
        for ratio in (0, 25, 50, 100):
            def off(test, b=ratio / 100):
                rows_ = zip(test.strain, test["s_xx"], test["s_yy"], test["s_zz"])
                return max(abs((yy - xx) / (zz - xx) - b) for x, xx, yy, zz in rows_
                           if x >= 0.01 and zz != xx)
            found[f"{family} b {ratio / 100}"] = each(study, lambda seed, f=family, r=ratio, off=off: off(
                study.test(shear_name(f, f"p030-b{r:03d}", seed))))
    return Finding(*series(found, 2), max(means(found)) <= 0.01, "largest distance in any row")


@rows.row("prevail", "F. 6.7-6.10, 4e", "Forces and fabric prevail; branches are small, growing and mostly "
          "negative; fabric and force is the first of the joint parts", "order", "test 4e at the end: forces > "
          "fabric > |branch|, branch below 0, |rf| above |rz| and |zf|")
def prevail(study):
    found = {name: of_test(study, TEST_4E, lambda test, parts=parts: share(test, parts, at_end))
             for name, parts in (("forces", FORCE), ("fabric", ("r",)), ("branch", BRANCH), ("rf", ("rf",)),
                                 ("rz", ("rz",)), ("zf", ("zf",)))}
    force, fabric, branch, rf, rz, zf = means(found)
    return Finding(*series(found), force > fabric > abs(branch) and branch < 0.0
                   and abs(rf) > max(abs(rz), abs(zf)), "per cent of a_s")


@rows.row("coaxial", "F. 6.7-6.10, 4e", "The parts are coaxial with the stress", "coaxial",
          "axes of the fabric's and the forces' part within 3 degrees after 1 % of strain, test 4e")
def coaxial(study):
    found = {name: of_test(study, TEST_4E, lambda test, name=name: max(test.after(f"axial_deg_{name}", 0.01)))
             for name in ("fabric", "force", "fabric_force")}
    return Finding(*series(found, 2), max(means(found)[:2]) <= 3.0, "largest, degrees")


def mean_of(test, part, k):
    values = [test[f"{part}_{axis}"][k] for axis in ("xx", "yy", "zz")]
    return None if None in values else sum(values) / 3.0


@rows.row("mean", "6.4.2 iii", "Fabric and force has the second largest mean, and offsets the fall of the "
          "isotropic part", "offsets", "|s0 + mean of rf - p| at most 0.03 p after 1 %, 10 to 70 MPa")
def mean(study):
    def worst(test):
        found = [abs(s0 + rf - p) / p for x, s0, rf, p in zip(
            test.strain, test["s0"], (mean_of(test, "fabric_force", k) for k in range(len(test.strain))),
            test["mean_stress"]) if x >= 0.01 * test.stretch and None not in (s0, rf)]
        if not found:
            raise Unmeasurable("no rows")
        return max(found)
    found = micro_by_pressure(study, FOUR, worst)
    return Finding(*series(found, 2), max(means(found)) <= 0.03, "largest, over p")


@rows.row("isotropic", "6.4.2 iv", "The isotropic part falls to a minimum, then rises very slowly; the mean force "
          "rises, the contact density falls", "order", "least value inside the test and below both ends; the mean "
          "force higher, the density lower at the end, 10 to 70 MPa",
          doubt="[E6] the branch is said to be constant")
def isotropic(study):
    def depth(test):
        least = min((v, x) for x, v in zip(test.strain, test["s0"]) if v is not None)
        return (at_end(test, "s0") - least[0]) / test.start("s0"), (test.start("s0") - least[0]) / test.start("s0")
    rise = micro_by_pressure(study, FOUR, lambda test: depth(test)[0])
    fall = micro_by_pressure(study, FOUR, lambda test: depth(test)[1])
    force = micro_by_pressure(study, FOUR, lambda test: at_end(test, "f0") / test.start("f0"))
    density = micro_by_pressure(study, FOUR, lambda test: at_end(test, "contact_density")
                                / test.start("contact_density"))
    met = min(means(rise)) > 0 and min(means(fall)) > 0 and min(means(force)) > 1 and max(means(density)) < 1
    return all_of(labelled("fall", Finding(*series(fall, 2), met)), labelled("rise", Finding(*series(rise, 2))),
                  labelled("force, end over start", Finding(*series(force))),
                  labelled("density", Finding(*series(density))))


@rows.row("noshape", "F. 6.11", "Leaving branches out matters more at large strain", "grows",
          "relative change of a_s larger at the end than at the peak, every pressure")
def noshape(study):
    def find(whats):
        def change(measure):
            return micro_by_pressure(study, whats, lambda test: abs(
                measure(test, "a_s_noshape") / measure(test, "a_s_seven") - 1.0))
        peak, end = change(at_peak), change(at_end)
        return all_of(labelled("peak", Finding(*series(peak, 2), all(a < b for a, b in zip(means(peak), means(end))))),
                      labelled("end", Finding(*series(end, 2))))
    return on_sets(SETS, find)


@rows.row("axisymmetric", "F. 6.12", "Intermediate and minor principal values are equal", "equal",
          "their difference over the major value below 0.15 for a^r, a^n, a^t, test 4e at the peak and the end")
def axisymmetric(study):
    found = {f"{name}, {where}": of_test(study, TEST_4E, lambda test, name=name, measure=measure: measure(
        test, f"axisymmetry_{name}")) for name in ("r", "n", "t") for where, measure in (
            ("peak", at_peak), ("end", at_end))}
    return Finding(*series(found, 2), max(means(found)) < 0.15)


@rows.row("components", "F. 6.13", "a_s by components is a_s by the moduli alone (6.46)", "equal",
          "1e-12 on coaxial axisymmetric tensors is a test of the library; here the largest difference is reported")
def components(study):
    found = micro_by_pressure(study, FOUR, lambda test: max(
        abs(a / b - 1.0) for x, a, b in zip(test.strain, test["a_s_axisymmetric"], test["a_s_seven"])
        if x >= 0.01 * test.stretch and a is not None and b))
    return Finding(*series(found, 2), None, "relative, after 1 %")


@rows.row("least-fabric", "F. 6.14-6.15, 4e", "The fabric's share grows from 15 to 38 %", "15 to 38 %",
          "its least value in 10 to 20 %")
def least_fabric(study):
    found = of_test(study, TEST_4E, lambda test: min(value for _, value in shares_of(test, ("r",), 0.005)))
    return Finding(text(found.mean), text(found.scatter, 2), len(found), 10.0 <= found.mean <= 20.0,
                   "per cent, from 0.5 % of strain on")


@rows.row("force-shares", "F. 6.14-6.15, 4e", "The share of normal forces drops suddenly, then grows from 41 to "
          "45 %; that of tangential forces has an early maximum, and is 18 % from softening on", "order",
          "normal: least share before the peak, end above peak; tangential: largest before the peak")
def force_shares(study):
    def lead(parts, largest):
        def measure(test):
            found = shares_of(test, parts, 0.005)
            best = (max if largest else min)(found, key=lambda row: row[1])
            return test.peak_friction[1] - best[0]
        return of_test(study, TEST_4E, measure)
    normal, tangential = lead(("n",), False), lead(("t",), True)
    rise = of_test(study, TEST_4E, lambda test: share(test, ("n",), at_end) - share(test, ("n",), at_peak))
    found = {"least normal share before the peak by": normal, "largest tangential by": tangential,
             "normal, end less peak, %": rise}
    return Finding(*series(found, 2), min(means(found)) > 0.0)


# Table 6.1: per cent of a_s at the peak and steady, with bars; None is reported.
TABLE = {
    "a^r": (("r",), 28, 5, 38, 2.5), "a^n": (("n",), 41, 5, 45, 2.5), "a^t": (("t",), 18, 5, 18, 2.5),
    "force": (FORCE, 59, 5, 63, 3), "rf": (("rf",), 13, 5, 13, 2.5), "a^z": (("z",), 0, 1, -6, None),
    "a^zt": (("zt",), 0, 1, -3.75, None), "branch": (BRANCH, 0, 1, -9.75, 2.5), "rz": (("rz",), 0, 1, -1.75, 1.5),
    "zf": (("zf",), 0, 1, -2.5, 1.5)}
E5 = "[E5] said to be at 10 MPa, where the peak is highest; its own row adds up to 100 at a_s = 1.57 alone"
SPLIT = "[C] the split implies a ratio of moduli of 0.417 at 10 MPa; 6.5.3.3 calls their dominance shared"


def _table_row(name, parts, peak, peak_bar, steady, steady_bar):
    @rows.row(f"table-peak-{name}", "Table 6.1", f"Share of {name} in a_s at the peak, 10 MPa", f"{peak} %",
              f"within {peak_bar}", doubt=E5)
    def at_c(study):
        return near(of_test(study, TEST_4E, lambda test: share(test, parts, at_peak)), peak, absolute=peak_bar)

    @rows.row(f"table-steady-{name}", "Table 6.1", f"Share of {name} in a_s in the steady state, 10 MPa",
              f"{steady} %", f"within {steady_bar}" if steady_bar else "reported", doubt="" if steady_bar else SPLIT)
    def at_steady(study):
        def find(where):
            measure = at_end if where == "end" else lambda test, key: test.mean_at(key, STEADY, 0.02)
            sample = of_test(study, TEST_4E, lambda test: share(test, parts, measure))
            met = abs(sample.mean - steady) <= steady_bar if steady_bar else None
            return Finding(text(sample.mean), text(sample.scatter, 2), len(sample), met,
                           f"{text(sample.mean)} at {where}")
        if not steady_bar:
            return all_of(find("0.205"), find("end"))
        return on_sets({"at 0.205": "0.205", "at the end": "end"}, find, shown="end")


for _name, _columns in TABLE.items():
    _table_row(_name, *_columns)


@rows.row("maxima", "6.6", "The order in which the shares reach their maxima", "unreadable", "strains reported",
          doubt="[?] the symbols cannot be read")
def maxima(study):
    found = {part: of_test(study, TEST_4E, lambda test, part=part: max(
        shares_of(test, (part,), 0.005), key=lambda row: row[1])[0]) for part in ("r", "n", "t", "rf", "z", "zt")}
    return Finding(*series(found, 2))


@rows.row("shape", "F. 6.16", "The share of shape is positive, about 0 at the peak, then negative, linear, to -12 %",
          "0 to -12 %", "within 1.5 of 0 at the peak, -12 within 2 at the end, R^2 of a line at least 0.95, test 4e")
def shape(study):
    def of_shape(test, measure):
        return 100.0 * measure(test, "share_shape") / measure(test, "a_s_seven")

    def line(test):
        after = test.peak_friction[1] / test.stretch
        x, y = zip(*shares_of(test, ("shape",), after))
        slope, mx, my = least_squares_slope(x, y), statistics.fmean(x), statistics.fmean(y)
        total = sum((b - my)**2 for b in y)
        return 1.0 - sum((b - my - slope * (a - mx))**2 for a, b in zip(x, y)) / total if total else 0.0
    found = {"peak": of_test(study, TEST_4E, lambda test: of_shape(test, at_peak)),
             "end": of_test(study, TEST_4E, lambda test: of_shape(test, at_end)), "R^2": of_test(study, TEST_4E, line)}
    peak, end, fit = means(found)
    return Finding(*series(found), abs(peak) <= 1.5 and abs(end + 12.0) <= 2.0 and fit >= 0.95)


def sign_rate(test, name, sign, low, high=9.0):
    """Part of the rows in a range of strain whose sign is this one."""
    found = [v for x, v in zip(test.strain, test[name])
             if low * test.stretch <= x <= high * test.stretch and v is not None]
    if not found:
        raise Unmeasurable("no rows in that range of strain")
    return sum(math.copysign(1.0, v) == sign and v != 0 for v in found) / len(found)


@rows.row("signs", "F. 6.17a-d", "Force anisotropies have the sign of the fabric's; branch anisotropies the other "
          "one at large strain", "+ and -", "+ after 1 %, - after 10 %, in at least 95 % of the rows, 10 to 70 MPa")
def signs(study):
    found = []
    for name, sign, low in (("n", 1.0, 0.01), ("t", 1.0, 0.01), ("z", -1.0, 0.1), ("zt", -1.0, 0.1)):
        rate = micro_by_pressure(study, FOUR, lambda test, n=name, s=sign, low=low: sign_rate(test, f"sign_{n}", s, low))
        found.append(labelled(name, Finding(*series(rate, 2), min(means(rate)) >= 0.95)))
    return all_of(*found)


@rows.row("signs-early", "F. 6.17a-d", "In the first per cents branch anisotropies have the fabric's sign, from initial "
          "anisotropy", "+", "sign of a^z + in most rows to 2 %, sample whose axes grew horizontal")
def signs_early(study):
    rate = micro_by_pressure(study, FOUR, lambda test: sign_rate(test, "sign_z", 1.0, 0.002, 0.02), "horizontal")
    return Finding(*series(rate, 2), min(means(rate)) > 0.5)


@rows.row("sign-change", "F. 6.17e", "The sign of a^z - a^zt changes at 7.5 % of strain at 10 MPa, and is - at higher "
          "pressures", "7.5 %; -", "last + at 5 to 10 % in the sample whose axes grew horizontal, - above; random axes "
          "reported")
def sign_change(study):
    def last_positive(test):
        return max((x for x, v in zip(test.strain, test["sign_dz"]) if v is not None and v > 0), default=0.0)
    grown = micro_by_pressure(study, FOUR, last_positive, "horizontal")
    free = micro_by_pressure(study, FOUR, last_positive)
    found = means(grown)
    met = 0.05 * study.stretch <= found[0] <= 0.1 * study.stretch and max(found[1:]) <= 0.01
    return all_of(labelled("horizontal", Finding(*series(grown, 2), met)), labelled("random", Finding(*series(free, 2))))


JOINT = {"r_zt": -1, "r_dz": -1, "r_t": 1, "r_df": 1, "t_zt": -1, "t_dz": -1, "df_zt": -1, "df_dz": -1}


@rows.row("joint-signs", "6.5.3.4-6", "Signs of the joint contributions", "rt, rDf: +; the six others -",
          "these after 10 % of strain, and that of a^n - a^t + throughout, in at least 95 % of the rows, 10 to 70 MPa")
def joint_signs(study):
    found = {}
    for name, sign in JOINT.items():
        found[name] = Sample(means(micro_by_pressure(
            study, FOUR, lambda test, n=name, s=sign: sign_rate(test, f"joint_{n}", s, 0.1))))
    found["df"] = Sample(means(micro_by_pressure(study, FOUR, lambda test: sign_rate(test, "sign_df", 1.0, 0.01))))
    return Finding(", ".join(f"{name} {text(min(rates), 2)}" for name, rates in found.items()), "", len(study.seeds),
                   min(min(rates) for rates in found.values()) >= 0.95, "least part of rows over pressures")


@rows.row("branch-moduli", "F. 6.18", "|a^z| against |a^zt|: the normal part dominates at higher pressure", "dominates",
          "|a^z| above |a^zt| at the end at the highest pressure")
def branch_moduli(study):
    def find(whats):
        ratio = micro_by_pressure(study, whats, lambda test: abs(at_end(test, "A_z")) / abs(at_end(test, "A_zt")))
        return Finding(*series(ratio), ratio[label(whats[-1])].mean > 1.0)
    return on_sets(SETS, find)


def by_moduli(r, n, t, z, zt):
    """a_s by (6.49) from moduli: signs of large strain."""
    r, n, t, z, zt = abs(r), abs(n), abs(t), -abs(z), -abs(zt)
    d_n = 1 + (2 / 15) * (r * n + r * z + n * z + 1.5 * t * zt)
    c = math.sqrt(1.5) * 0.4 / d_n
    d = math.sqrt(1.5) * (2 / 35) / math.sqrt(6) / d_n
    return c * (r + z + 1.5 * zt + n + 1.5 * t) + d * (
        r * (4 * z + 3 * zt) + r * (4 * n + 3 * t) + 4 * n * z + 3 * t * z + 3 * n * zt + 7.5 * t * zt)


@rows.row("large-strain", "6.5.3.7", "The relation for large strain (6.49) holds from before the peak on", "holds",
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
    return Finding(*series(found, 2), max(means(found)) <= 0.02, "mean relative distance after the peak")


@rows.row("main-parts", "6.6 (3)", "Fabric, forces and their joint part make more than 90 % of the stress", "above 90 %",
          "at least 0.9 of a_s at every row after 1 %, 10 to 70 MPa", doubt="[E9] it can only be of the deviator")
def main_parts(study):
    found = micro_by_pressure(study, FOUR, lambda test: min(
        value for _, value in shares_of(test, ("r", "n", "t", "rf"), 0.01)))
    return Finding(*series(found), min(means(found)) >= 90.0, "least, per cent")


@rows.row("largest-moduli", "F. 6.18", "Axes of that figure end at 0.18", "0.18", "largest moduli reported")
def largest_moduli(study):
    return all_of(*(labelled(name, Finding(*series(micro_by_pressure(
        study, FOUR, lambda test, name=name: max(abs(v) for v in test[name] if v is not None))))) for name in (
            "A_z", "A_zt")))
