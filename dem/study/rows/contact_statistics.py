# SPDX-License-Identifier: MIT
"""Where bodies are touched (chapter 7, b/a = 0.7); and beyond the programme (3.1, 8.1)."""
import math
import statistics

from measures import Unmeasurable, least_squares_slope
from rows.anisotropies import at_peak
from rows.common import FOUR, by_pressure, means, micro_by_pressure, shear_name
from rows.stress_force_fabric import at_end, of_test
from verdicts import Finding, Section, all_of, each, inside, labelled, near, series, text

rows = Section("3.7")

LENGTHS = ("short", "intermediate", "long")
PAIRS = ("ss", "si", "sl", "ii", "il", "ll")


def values_of(test, name):
    found = [v for v in test[name] if v is not None]
    if not found:
        raise Unmeasurable(f"{name} has no values")
    return found


@rows.row("constant", "F. 7.1b",
          "|a^cv|, of contact vectors in body axes, hardly changes over strain and four pressures",
          "nearly constant", "target: spread over all of them at most 15 % of the mean")
def constant(study):
    low = micro_by_pressure(study, FOUR, lambda test: min(values_of(test, "a_cv")))
    high = micro_by_pressure(study, FOUR, lambda test: max(values_of(test, "a_cv")))
    middle = micro_by_pressure(study, FOUR, lambda test: statistics.fmean(values_of(test, "a_cv")))
    part = (max(means(high)) - min(means(low))) / statistics.fmean(means(middle))
    return all_of(labelled("mean", Finding(*series(middle), part <= 0.15,
                                           f"spread {100 * part:.0f} %")),
                  labelled("least", Finding(*series(low))),
                  labelled("largest", Finding(*series(high))))


@rows.row("a1", "F. 7.2a",
          "Its component along the long axis", "0.5 to 0.8",
          "0.45 to 0.85 in the mean of each test")
def a_one(study):
    found = micro_by_pressure(study, FOUR, lambda test: statistics.fmean(values_of(test, "a1")))
    return Finding(*series(found), all(0.45 <= x <= 0.85 for x in means(found)))


def over_growth(study, run, name):
    """[(a / b, value)] of the rows of micro.csv while bodies grow."""
    micro, history = study.lineage(run, "micro"), study.lineage(run)
    shape = {(stage, cycle): e for stage, cycle, e in zip(history["stage"], history["cycle"],
                                                          history["eccentricity"])}
    found = []
    for stage, cycle, value in zip(micro["stage"], micro["cycle"], micro[name]):
        e = shape.get((stage, cycle))
        if stage.startswith("grow") and e and value is not None:
            found.append(((1 + e) / (1 - e), value))
    if len(found) < 3:
        raise Unmeasurable("too few rows of growth")
    return found


@rows.row("growth-line", "F. 7.1c",
          "In growth it is linear in a/b", "linear",
          "R^2 of a line at least 0.95 from a/b = 1.1 on, random start")
def growth_line(study):
    def fit(seed):
        found = [(x, y) for x, y in over_growth(study, f"spheroid-growth3-s{seed}", "a1")
                 if x >= 1.1]
        if len(found) < 3:
            raise Unmeasurable("too few rows of growth")
        x, y = zip(*found)
        slope, mx, my = least_squares_slope(x, y), statistics.fmean(x), statistics.fmean(y)
        total = sum((b - my)**2 for b in y)
        return 1.0 - sum((b - my - slope * (a - mx))**2 for a, b in found) / total if total else 0.0
    return inside(each(study, fit), low=0.95)


@rows.row("growth-zero", "F. 7.1c, 7.2",
          "|a^cv| in growth has a U whose zero is at a/b = 1.07, from the cubic start", "1.07",
          "least value at 1.07 within 0.02, lattice start",
          doubt="[E14] contradicts that a lattice's tensor is 0 (E11)")
def growth_zero(study):
    def least(run):
        return each(study, lambda seed: min((v, x) for x,
                                            v in over_growth(study, f"{run}-s{seed}", "a_cv"))[1])
    lattice, free = least("horizontal-growth2"), least("spheroid-growth3")
    found = near(lattice, 1.07, absolute=0.02)
    found.note += f"; random start {text(free.mean)}"
    return found


@rows.row("independent", "7.2",
          "Where a body is touched depends on neither its orientation nor its coordination",
          "independent",
          "correlations below twice their sampling error, released samples, 10 to 70 MPa")
def independent(study):
    found = {}
    for name in ("coordination", *(f"orientation_{k}" for k in "xyz")):
        def over(seed, name=name):
            sizes = []
            for what in FOUR:
                seen = study.averages(f"spheroid-{what}-s{seed}")["contact_statistics"]
                value, error = seen[f"correlation_{name}"], seen[f"correlation_{name}_error"]
                if value is None or not error:
                    raise Unmeasurable("no correlation")
                sizes.append(abs(value) / error)
            return statistics.fmean(sizes)
        found[name] = each(study, over)
    return Finding(*series(found, 2), max(means(found)) <= 2.0, "mean size over the error")


# Closed forms of 2.14, b = 1.


def share_beyond(a, a1, length):
    """H: the share of contacts whose contact vector is longer."""
    c = math.sqrt((1 - 1 / length**2) / (1 - 1 / a**2))
    return 1 - (1 - a1 / 2) * c - a1 / 2 * c**3


def length_shares(a, a1):
    first, second = (share_beyond(a, a1, 1 + (a - 1) * k / 3) for k in (1, 2))
    return 1 - first, first - second, second


@rows.row("formula", "(7.20)",
          "Shares of short, intermediate and long contacts, calculated for a1 = 0.75",
          "54, 27, 19 %", "the formula gives these to rounding")
def formula(study):
    found = [100 * x for x in length_shares(1 / 0.7, 0.75)]
    return Finding(", ".join(text(x) for x in found), "", len(study.seeds),
                   all(abs(x - y) <= 0.5 for x, y in zip(found, (54, 27, 19))))


def _distance(test, names, model):
    return max(abs(statistics.fmean(values_of(test, f"{names[0]}_{k}"))
                   - statistics.fmean(values_of(
        test, model.format(k)))) for k in names[1])


@rows.row("measured", "F. 7.4c",
          "Measured shares are close to those calculated from a1, at all pressures", "close",
          "within 0.02, means of each test, 10 to 70 MPa")
def measured(study):
    off = micro_by_pressure(study, FOUR, lambda test: _distance(test, ("f", LENGTHS), "f_{}_model"))
    short = micro_by_pressure(study, FOUR, lambda test: statistics.fmean(values_of(test,
        "f_short")))
    return all_of(labelled("distance", Finding(*series(off, 2), max(means(off)) <= 0.02)),
                  labelled("short", Finding(*series(short))))


@rows.row("pairs", "F. 7.4d",
          "So are those of the six types of pairs", "close", "within 0.03, 10 to 70 MPa")
def pairs(study):
    off = micro_by_pressure(study, FOUR, lambda test: _distance(test, ("pair", PAIRS),
                                                                "pair_model_{}"))
    return Finding(*series(off, 2), max(means(off)) <= 0.03)


@rows.row("area", "(7.22), F. 7.5b",
          "Contacts are distributed like the surface", "a1 from 0.5 to 0.8: error 0 to 0.3 of a1",
          "measured distribution within 0.03 of the area law, released samples, 10 to 70 MPa")
def area(study):
    def of(key):
        return {str(int(what[1:])): each(study, lambda seed, what=what: value(study.averages(
            f"spheroid-{what}-s{seed}")["contact_statistics"], key)) for what in FOUR}

    def value(seen, key):
        found = seen["a1"] - seen["a1_by_area"] if key == "a1" else seen[key]
        if found is None:
            raise Unmeasurable(f"no {key}")
        return found
    off = of("G_off_area")
    return all_of(labelled("distance", Finding(*series(off, 2), max(map(abs, means(off))) <= 0.03)),
                  labelled("a1 above the area's", Finding(*series(of("a1"), 2))))


@rows.row("short", "7.5, 8.7 (3)",
          "More than half of the contacts are short: near the flat parts", "above 50 %",
          "above 0.5 in the mean of each test",
          doubt="[E9] 58 % of the surface is short: contacts are rarer there")
def short(study):
    found = micro_by_pressure(study, FOUR, lambda test: statistics.fmean(values_of(test,
        "f_short")))
    return Finding(*series(found), min(means(found)) > 0.5)


@rows.row("axes", "F. 7.6-7.7a",
          "Long axes turn from all directions to across the load", "donut",
          "axial component of a^E below 0 at the end, 10 to 70 MPa")
def axes(study):
    found = micro_by_pressure(study, FOUR, lambda test: at_end(test, "a_axial_E"))
    return Finding(*series(found), max(means(found)) < 0.0)


@rows.row("axes-delay", "F. 7.7b",
          "Long axes do not turn before 3 % of strain at any pressure; then to a limit",
          "not before 3 %",
          "change of axial a^E to 2 % below a tenth of that to 20 %, 10 to 70 MPa")
def axes_delay(study):
    def part(test):
        late = test.mean_at("a_axial_E", 0.2, 0.01) - test.start("a_axial_E")
        early = test.mean_at("a_axial_E", 0.02, 0.005) - test.start("a_axial_E")
        if late == 0.0:
            raise Unmeasurable("axes do not turn")
        return abs(early / late)
    found = micro_by_pressure(study, FOUR, part)
    return Finding(*series(found, 2), max(means(found)) < 0.1)


@rows.row("axes-reinforced", "F. 7.7b",
          "Shear reinforces an initial anisotropy of the long axes", "reinforced",
          "axial a^E further below 0 at the end than at the start, axes grown horizontal, 10 to "
          "70 MPa")
def axes_reinforced(study):
    found = micro_by_pressure(study, FOUR, lambda test: at_end(test, "a_axial_E")
                              - test.start("a_axial_E"), "horizontal")
    return Finding(*series(found), max(means(found)) < 0.0)


def plane_factors(ratio):
    """c1, c2 of a/b (7.46)."""
    k = ratio**2
    return (k - 1) / (k + 1), -2 * k / (k + 1)**2


@rows.row("plane-factors", "F. 7.9-7.11",
          "c1 grows, |c2| shrinks with a/b; the normals' share of the axes' anisotropy goes from "
          "0 (disk) to 1 (needle)",
          "0 to 1", "closed forms: order over a/b = 1 to 100, c1 at both ends")
def plane_factors_row(study):
    ratios = (1.0, 1.25, 1 / 0.7, 2.0, 3.0, 10.0, 100.0)
    c1, c2 = zip(*map(plane_factors, ratios))
    met = all(a < b for a, b in zip(c1, c1[1:])) and all(abs(a) > abs(b) for a,
                                                         b in zip(c2, c2[1:])) \
        and c1[0] == 0.0 and c1[-1] > 0.999
    return Finding(f"c1 {', '.join(map(text, c1))}; c2 {', '.join(map(text, c2))}", "",
                   len(study.seeds), met)


@rows.row("plane-arcs", "7.4.1",
          "No data in the plane: contacts by arc length", "no data",
          "measured a^L reported beside that of the arcs, relaxed ellipses")
def plane_arcs(study):
    found = {}
    for e in (5, 10, 15, 20):
        for key, name in (("a_L", "measured"), ("a_L_by_arc", "arcs")):
            def of(seed, e=e, key=key):
                value = study.averages(f"ellipse-e{e:02d}-s{seed}")["contact_statistics"][key]
                if value is None:
                    raise Unmeasurable(f"no {key}")
                return value
            found[f"e {e / 100} {name}"] = each(study, of)
    return Finding(*series(found))


@rows.row("plane-rotation", "7.4.1",
          "No data in the plane: normals by rotation of the axes", "no data",
          "a^r at the end over <P2> a^E, and chi-squared over its degrees of freedom, reported, "
          "e = 0.2")
def plane_rotation(study):
    return _rotation(study, ["e05", "e10", "e15", "e20"], "ellipse",
                     lambda what: f"e {int(what[1:]) / 100}")


def _rotation(study, whats, family, name):
    def of(measure):
        return {name(what): of_test(study, what, measure, family) for what in whats}
    rotated = of(lambda test: at_end(test, "a_axial_r_rot"))
    all_ = of(lambda test: at_end(test, "a_axial_r"))
    chi = of(lambda test: at_end(test, "chi_squared") / at_end(test, "chi_degrees"))
    return all_of(labelled("axial, rotated", Finding(*series(rotated))),
                  labelled("all", Finding(*series(all_))),
                  labelled("chi-squared over degrees", Finding(*series(chi))))


@rows.row("space-rotation", "7.4.2, 8.7 (4)",
          "Intractable in space", "no data", "a^r_rot against a^r, reported")
def space_rotation(study):
    return _rotation(study, FOUR, "spheroid", lambda what: str(int(what[1:])))


@rows.row("space-factors", "7.4.2",
          "Intractable in space: the factors of the model", "no data",
          "measured and predicted <P2>, measured <P4>, reported")
def space_factors(study):
    return all_of(*(labelled(key, Finding(*series(micro_by_pressure(
        study, FOUR, lambda test, key=key: at_peak(test, key)))))
                    for key in ("P2", "P2_model", "P4")))


@rows.row("hertz", "3.1",
          "Contacts by Hertz give similar results", "similar",
          "peak friction angle within 1 degree of the linear law's, from one sample at 50 MPa, "
          "at equal mean overlap")
def hertz(study):
    gap = each(study, lambda seed: study.test(shear_name("hertz", "p050", seed)).peak_friction[0]
               - study.test(shear_name("spheroid", "p050", seed)).peak_friction[0])
    overlap = each(study, lambda seed: study.summary(f"hertz-p050-s{seed}")["mean_overlap"]
                   / study.summary(f"spheroid-p050-s{seed}")["mean_overlap"])
    return Finding(f"{text(gap.mean)} degrees", text(gap.scatter, 2), len(gap),
                   abs(gap.mean) <= 1.0,
                   f"mean overlap {text(overlap.mean)} times the linear one")


@rows.row("shapes", "3.4.9.1, 8.1",
          "Flatness and grading are named as next", "not done",
          "a triaxial and a two-size test, reported, 50 MPa")
def shapes(study):
    found = []
    for family in ("spheroid", "triaxial", "twosize"):
        tests = {"peak, degrees": lambda test: test.peak_friction[0],
                 "at": lambda test: test.peak_friction[1],
                 "end": lambda test: test.last("friction_angle_deg"),
                 "contacts": lambda test: test.start("coordination_number")}
        values = {name: each(study, lambda seed, f=family,
                             m=measure: m(study.test(shear_name(f, "p050", seed))))
                  for name, measure in tests.items()}
        found.append(labelled(family, Finding(*series(values))))
    return all_of(*found)


@rows.row("cost", "8.1",
          "A test takes 21e9 to 42e9 contacts", "21e9 to 42e9",
          "ours reported: contacts times cycles")
def cost(study):
    def contacts(test):
        cycles, count = test["stage_cycle"], test["contacts"]
        return sum((b - a) * c for a, b, c in zip(cycles, cycles[1:], count[1:]))
    return Finding(*series(by_pressure(study, FOUR, contacts)))


@rows.row("trace", "3 and 4",
          "The published contact scheme in a run", "used throughout",
          "peak friction angle, coordination at 0.19 and porosity there within the scatter of a "
          "seed of those by the common normal, 10 MPa",
          apart="trace")
def trace(study):
    measures = {"peak, degrees": lambda test: test.peak_friction[0],
                "contacts": lambda test: test.mean_at("coordination_number", 0.19),
                "porosity": lambda test: test.mean_at("porosity", 0.19)}
    found, met = [], True
    for name, measure in measures.items():
        ours = each(study, lambda seed, m=measure: m(study.test(shear_name("spheroid", "p010",
            seed))))
        theirs = each(study, lambda seed, m=measure: m(study.test(shear_name("trace", "p010",
            seed))))
        met &= abs(ours.mean - theirs.mean) <= max(math.hypot(ours.scatter, theirs.scatter), 1e-12)
        found.append(labelled(name, Finding(*series({"normal": ours, "trace": theirs}))))
    found[0].met = met
    return all_of(*found)


@rows.row("large", "8.1",
          "Larger samples are named as next", "not done",
          "one of 8000 beside those of 1000, reported, 50 MPa", apart="large")
def large(study):
    test = study.test(shear_name("large", "p050", study.seeds[0]))
    small = each(study, lambda seed: study.test(shear_name("spheroid", "p050",
                                                           seed)).peak_friction[0])
    last = each(study, lambda seed: study.test(shear_name("spheroid", "p050",
                                                          seed)).last("friction_angle_deg"))
    return Finding(f"peak {text(test.peak_friction[0])}, end "
                   f"{text(test.last('friction_angle_deg'))} degrees; 1000: "
                   f"{text(small.mean)}, {text(last.mean)}", f"{text(small.scatter, 2)}, "
                                                             f"{text(last.scatter, 2)}", 1)
