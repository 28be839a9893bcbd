# SPDX-License-Identifier: MIT
"""What each anisotropy bears of the shear strength (6.5.2, Table 6.1): per cent of a_s as predicted
by the seven published parts."""
import statistics

from measures import STEADY, Unmeasurable, least_squares_slope
from rows.anisotropies import at_peak
from rows.common import FOUR, means, micro_by_pressure
from rows.stress_force_fabric import BRANCH, FORCE, TEST_4E, at_end, of_test
from verdicts import Finding, Section, all_of, near, on_sets, series, text

rows = Section("3.6")


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


@rows.row("prevail", "F. 6.7-6.10, 4e",
          "Forces and fabric prevail; branches are small, growing and mostly negative; fabric "
          "and force is the first of the joint parts",
          "order",
          "test 4e at the end: forces > fabric > |branch|, branch below 0, |rf| above |rz| and "
          "|zf|")
def prevail(study):
    found = {name: of_test(study, TEST_4E, lambda test, parts=parts: share(test, parts, at_end))
             for name, parts in (("forces", FORCE), ("fabric", ("r",)), ("branch", BRANCH),
                                 ("rf", ("rf",)),
                                 ("rz", ("rz",)), ("zf", ("zf",)))}
    force, fabric, branch, rf, rz, zf = means(found)
    return Finding(*series(found), force > fabric > abs(branch) and branch < 0.0
                   and abs(rf) > max(abs(rz), abs(zf)), "per cent of a_s")


@rows.row("least-fabric", "F. 6.14-6.15, 4e",
          "The fabric's share grows from 15 to 38 %", "15 to 38 %", "its least value in 10 to 20 %")
def least_fabric(study):
    found = of_test(study, TEST_4E, lambda test: min(value for _,
                                                     value in shares_of(test, ("r",), 0.005)))
    return Finding(text(found.mean), text(found.scatter, 2), len(found), 10.0 <= found.mean <= 20.0,
                   "per cent, from 0.5 % of strain on")


@rows.row("force-shares", "F. 6.14-6.15, 4e",
          "The share of normal forces drops suddenly, then grows from 41 to 45 %; that of "
          "tangential forces has an early maximum, and is 18 % from softening on",
          "order",
          "normal: least share before the peak, end above peak; tangential: largest before the "
          "peak")
def force_shares(study):
    def lead(parts, largest):
        def measure(test):
            found = shares_of(test, parts, 0.005)
            best = (max if largest else min)(found, key=lambda row: row[1])
            return test.peak_friction[1] - best[0]
        return of_test(study, TEST_4E, measure)
    normal, tangential = lead(("n",), False), lead(("t",), True)
    rise = of_test(study, TEST_4E, lambda test: share(test, ("n",), at_end)
                   - share(test, ("n",), at_peak))
    found = {"least normal share before the peak by": normal, "largest tangential by": tangential,
             "normal, end less peak, %": rise}
    return Finding(*series(found, 2), min(means(found)) > 0.0)


# Table 6.1: per cent of a_s at the peak and steady, with bars; None is reported.
TABLE = {
    "a^r": (("r",), 28, 5, 38, 2.5), "a^n": (("n",), 41, 5, 45, 2.5),
    "a^t": (("t",), 18, 5, 18, 2.5),
    "force": (FORCE, 59, 5, 63, 3), "rf": (("rf",), 13, 5, 13, 2.5),
    "a^z": (("z",), 0, 1, -6, None),
    "a^zt": (("zt",), 0, 1, -3.75, None), "branch": (BRANCH, 0, 1, -9.75, 2.5),
    "rz": (("rz",), 0, 1, -1.75, 1.5),
    "zf": (("zf",), 0, 1, -2.5, 1.5)}
E5 = ("[E5] said to be at 10 MPa, where the peak is highest; its own row adds up to 100 at "
      "a_s = 1.57 alone")
SPLIT = ("[C] the split implies a ratio of moduli of 0.417; 6.5.3.3 calls their dominance "
         "shared")


def _table_row(name, parts, peak, peak_bar, steady, steady_bar):
    @rows.row(f"table-peak-{name}", "Table 6.1", f"Share of {name} in a_s at the peak, 10 MPa",
              f"{peak} %",
              f"within {peak_bar}", doubt=E5)
    def at_c(study):
        return near(of_test(study, TEST_4E, lambda test: share(test, parts, at_peak)), peak,
                    absolute=peak_bar)

    @rows.row(f"table-steady-{name}", "Table 6.1", f"Share of {name} in a_s in the steady state, "
                                                   f"10 MPa",
              f"{steady} %", f"within {steady_bar}" if steady_bar else "reported",
              doubt="" if steady_bar else SPLIT)
    def at_steady(study):
        def find(where):
            measure = at_end if where == "end" else lambda test, key: test.mean_at(key, STEADY,
                0.02)
            sample = of_test(study, TEST_4E, lambda test: share(test, parts, measure))
            met = abs(sample.mean - steady) <= steady_bar if steady_bar else None
            return Finding(text(sample.mean), text(sample.scatter, 2), len(sample), met,
                           f"{text(sample.mean)} at {where}")
        if not steady_bar:
            return all_of(find("0.205"), find("end"))
        return on_sets({"at 0.205": "0.205", "at the end": "end"}, find, shown="end")


for _name, _columns in TABLE.items():
    _table_row(_name, *_columns)


@rows.row("maxima", "6.6",
          "The order in which the shares reach their maxima", "unreadable", "strains reported",
          doubt="[?] the symbols cannot be read")
def maxima(study):
    found = {part: of_test(study, TEST_4E, lambda test, part=part: max(
        shares_of(test, (part,), 0.005), key=lambda row: row[1])[0])
             for part in ("r", "n", "t", "rf", "z", "zt")}
    return Finding(*series(found, 2))


@rows.row("shape", "F. 6.16",
          "The share of shape is positive, about 0 at the peak, then negative, linear, to -12 %",
          "0 to -12 %",
          "within 1.5 of 0 at the peak, -12 within 2 at the end, R^2 of a line at least 0.95, "
          "test 4e")
def shape(study):
    def of_shape(test, measure):
        return 100.0 * measure(test, "share_shape") / measure(test, "a_s_seven")

    def line(test):
        after = test.peak_friction[1] / test.stretch
        x, y = zip(*shares_of(test, ("shape",), after))
        slope, mx, my = least_squares_slope(x, y), statistics.fmean(x), statistics.fmean(y)
        total = sum((b - my)**2 for b in y)
        return 1.0 - sum((b - my - slope * (a - mx))**2 for a,
                         b in zip(x, y)) / total if total else 0.0
    found = {"peak": of_test(study, TEST_4E, lambda test: of_shape(test, at_peak)),
             "end": of_test(study, TEST_4E, lambda test: of_shape(test, at_end)),
             "R^2": of_test(study, TEST_4E, line)}
    peak, end, fit = means(found)
    return Finding(*series(found), abs(peak) <= 1.5 and abs(end + 12.0) <= 2.0 and fit >= 0.95)


@rows.row("main-parts", "6.6 (3)",
          "Fabric, forces and their joint part make more than 90 % of the stress", "above 90 %",
          "at least 0.9 of a_s at every row after 1 %, 10 to 70 MPa",
          doubt="[E9] it can only be of the deviator")
def main_parts(study):
    found = micro_by_pressure(study, FOUR, lambda test: min(
        value for _, value in shares_of(test, ("r", "n", "t", "rf"), 0.01)))
    return Finding(*series(found), min(means(found)) >= 90.0, "least, per cent")
