# SPDX-License-Identifier: MIT
"""In which sense anisotropies contribute (6.5.3): signs relative to the fabric; branches."""
import math

from measures import Unmeasurable
from rows.common import FOUR, SETS, label, means, micro_by_pressure
from rows.stress_force_fabric import at_end
from verdicts import Finding, Sample, Section, all_of, labelled, on_sets, series, text

rows = Section("3.6")


def sign_rate(test, name, sign, low, high=9.0):
    """Part of the rows in a range of strain whose sign is this one."""
    found = [v for x, v in zip(test.strain, test[name])
             if low * test.stretch <= x <= high * test.stretch and v is not None]
    if not found:
        raise Unmeasurable("no rows in that range of strain")
    return sum(math.copysign(1.0, v) == sign and v != 0 for v in found) / len(found)


@rows.row("signs", "F. 6.17a-d",
          "Force anisotropies have the sign of the fabric's; branch anisotropies the other one "
          "at large strain",
          "+ and -", "+ after 1 %, - after 10 %, in at least 95 % of the rows, 10 to 70 MPa")
def signs(study):
    found = []
    for name, sign, low in (("n", 1.0, 0.01), ("t", 1.0, 0.01), ("z", -1.0, 0.1),
                            ("zt", -1.0, 0.1)):
        rate = micro_by_pressure(study, FOUR, lambda test, n=name, s=sign,
                                 low=low: sign_rate(test, f"sign_{n}", s, low))
        found.append(labelled(name, Finding(*series(rate, 2), min(means(rate)) >= 0.95)))
    return all_of(*found)


@rows.row("signs-early", "F. 6.17a-d",
          "In the first per cents branch anisotropies have the fabric's sign, from initial "
          "anisotropy",
          "+", "sign of a^z + in most rows to 2 %, sample whose axes grew horizontal")
def signs_early(study):
    rate = micro_by_pressure(study, FOUR, lambda test: sign_rate(test, "sign_z", 1.0, 0.002, 0.02),
                             "horizontal")
    return Finding(*series(rate, 2), min(means(rate)) > 0.5)


@rows.row("sign-change", "F. 6.17e",
          "The sign of a^z - a^zt changes at 7.5 % of strain at 10 MPa, and is - at higher "
          "pressures",
          "7.5 %; -",
          "last + at 5 to 10 % in the sample whose axes grew horizontal, - above; random axes "
          "reported")
def sign_change(study):
    def last_positive(test):
        return max((x for x, v in zip(test.strain, test["sign_dz"]) if v is not None and v > 0),
                   default=0.0)
    grown = micro_by_pressure(study, FOUR, last_positive, "horizontal")
    free = micro_by_pressure(study, FOUR, last_positive)
    found = means(grown)
    met = 0.05 * study.stretch <= found[0] <= 0.1 * study.stretch and max(found[1:]) <= 0.01
    return all_of(labelled("horizontal", Finding(*series(grown, 2), met)),
                  labelled("random", Finding(*series(free, 2))))


JOINT = {"r_zt": -1, "r_dz": -1, "r_t": 1, "r_df": 1, "t_zt": -1, "t_dz": -1, "df_zt": -1,
         "df_dz": -1}


@rows.row("joint-signs", "6.5.3.4-6",
          "Signs of the joint contributions", "rt, rDf: +; the six others -",
          "these after 10 % of strain, and that of a^n - a^t + throughout, in at least 95 % of "
          "the rows, 10 to 70 MPa")
def joint_signs(study):
    found = {}
    for name, sign in JOINT.items():
        found[name] = Sample(means(micro_by_pressure(
            study, FOUR, lambda test, n=name, s=sign: sign_rate(test, f"joint_{n}", s, 0.1))))
    found["df"] = Sample(means(micro_by_pressure(study, FOUR,
                                                 lambda test: sign_rate(test, "sign_df", 1.0,
                                                     0.01))))
    return Finding(", ".join(f"{name} {text(min(rates), 2)}" for name, rates in found.items()), "",
                   len(study.seeds),
                   min(min(rates) for rates in found.values()) >= 0.95,
                   "least part of rows over pressures")


@rows.row("branch-moduli", "F. 6.18",
          "|a^z| against |a^zt|: the normal part dominates at higher pressure", "dominates",
          "|a^z| above |a^zt| at the end at the highest pressure")
def branch_moduli(study):
    def find(whats):
        ratio = micro_by_pressure(study, whats, lambda test: abs(at_end(test, "A_z"))
                                  / abs(at_end(test, "A_zt")))
        return Finding(*series(ratio), ratio[label(whats[-1])].mean > 1.0)
    return on_sets(SETS, find)


@rows.row("largest-moduli", "F. 6.18",
          "Axes of that figure end at 0.18", "0.18", "largest moduli reported")
def largest_moduli(study):
    return all_of(*(labelled(name, Finding(*series(micro_by_pressure(
        study, FOUR, lambda test, name=name: max(abs(v) for v in test[name] if v is not None)))))
                    for name in (
            "A_z", "A_zt")))
