# SPDX-License-Identifier: MIT
"""What several sections ask: the shear tests by pressure, and in which sets the text may mean."""
from verdicts import each

# Tests of e = 0.176 by pressure, MPa, and the two readings of 4a.
FOUR = ("p010", "p030", "p050", "p070")
WITH_SHORT, WITH_LONG = (*FOUR, "e11"), (*FOUR, "p100")
# The text does not say over which pressures its ranges and orders are.
SETS = {"10 to 70 MPa": FOUR, "to 100 MPa with e = 0.11": WITH_SHORT,
        "to 100 MPa with e = 0.176": WITH_LONG}


def label(what):
    """10 of p010, 100* of the shorter bodies."""
    return "100*" if what == "e11" else str(int(what[1:]))


def pressure(what):
    """In MPa."""
    return 100.0 if what == "e11" else float(what[1:])


def shear_name(family, what, seed):
    return f"{family}-{what}-shear-s{seed}"


def by_pressure(study, whats, measure, family="spheroid"):
    """{label: Sample} of measure(Test) over the seeds."""
    return {label(what): each(study, lambda seed, what=what: measure(
        study.test(shear_name(family, what, seed)))) for what in whats}


def micro_by_pressure(study, whats, measure, family="spheroid"):
    """The same over rows of micro.csv."""
    return {label(what): each(study, lambda seed, what=what: measure(
        study.micro_test(shear_name(family, what, seed)))) for what in whats}


def means(samples):
    return [sample.mean for sample in samples.values()]


def no_less(value, bound):
    """For findings of one number: value >= bound, a hair of rounding aside."""
    return value >= bound - 1e-12
