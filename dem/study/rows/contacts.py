# SPDX-License-Identifier: MIT
"""Shear tests: contacts and forces (5.4.4-5.4.7, 8.5.2)."""
import dataclasses
import statistics

from measures import STEADY, correlation, least_squares_slope
from rows.common import SETS, by_pressure, label, means, micro_by_pressure, pressure, shear_name
from verdicts import (Finding, Section, all_of, each, inside, labelled, on_sets, order, series,
                      spread, text)

rows = Section("3.4")

COORDINATION = "coordination_number"
# Axial strains at which two tests are compared.
GRID = tuple(0.01 + 0.0125 * k for k in range(26))


@rows.row("loss", "5.4.4, F. 5.11a",
          "Coordination falls steadily in shear, then stays", "falls, stays",
          "falls from 0 over 0.05 to 0.1, and from 0.3 on by less than a tenth of all that is "
          "lost")
def loss(study):
    def find(whats):
        findings = []
        for what in whats:
            at = {f"{x}": each(study, lambda seed, x=x: study.test(shear_name(
                "spheroid", what, seed)).mean_at(COORDINATION, x, 0.005))
                  for x in (0.0, 0.05, 0.1, 0.3, 0.4)}
            falls = order({k: at[k] for k in ("0.0", "0.05", "0.1")}, rising=False)
            stays = abs(at["0.3"].mean - at["0.4"].mean) <= 0.1 * (at["0.0"].mean - at["0.4"].mean)
            findings.append(labelled(f"{label(what)} MPa", dataclasses.replace(
                Finding(*series(at)), met=falls.met and stays)))
        return all_of(*findings)
    return on_sets(SETS, find)


@rows.row("steady", "F. 5.11a, 2.3.2.2",
          "Near the steady state a thousand bodies have 3000 contacts", "coordination 6",
          "6 within 0.5 at the end, up to 30 MPa")
def steady(study):
    last = by_pressure(study, ("p010", "p030"), lambda test: test.last(COORDINATION))
    return Finding(*series(last), all(abs(x - 6.0) <= 0.5 for x in means(last)),
                   "by pressure in MPa")


@rows.row("densest", "8.1, 2.3.2.2",
          "The densest thousand bodies have 6000 contacts", "6000", "within 5 %")
def densest(study):
    count = each(study, lambda seed: 500.0 * study.test(shear_name(
        "spheroid", "p100", seed)).start(COORDINATION))
    return inside(count, 5700.0, 6300.0)


@rows.row("scatter", "F. 5.11b",
          "The standard deviation of coordination changes little in shear, and little with the "
          "pressure",
          "no significant change",
          "after 1 % of strain its range at most 25 % of its mean, in each test and over "
          "pressures")
def scatter(study):
    def find(whats):
        def change(test):
            near = [test.mean_at("coordination_std", x) for x in GRID]
            return (max(near) - min(near)) / statistics.fmean(near)
        changes = by_pressure(study, whats, change)
        level = by_pressure(study, whats, lambda test: statistics.fmean(
            test.after("coordination_std", 0.01)))
        over = spread(level) / statistics.fmean(means(level))
        return all_of(labelled("range over mean", Finding(*series(changes),
                                                          max(means(changes)) <= 0.25)),
                      labelled("means", Finding(*series(level), over <= 0.25,
                                                f"over pressures {100 * over:.0f} %")))
    return on_sets(SETS, find)


def _early(test):
    """The rate of contact loss at 0.1 % over that at 1 %."""
    late = test.slope_at(COORDINATION, 0.01, 0.01)
    return test.slope_at(COORDINATION, 0.001, 0.002) / late if late else 0.0


@rows.row("delay", "5.4.4, 8.5.2",
          "Contact loss starts with a delay at high pressure, and without one at the lowest",
          "delay at high pressure",
          "rate of loss at 0.1 % over that at 1 % of strain falls with the pressure")
def delay(study):
    return on_sets(SETS, lambda whats: order(by_pressure(study, whats, _early), rising=False))


@rows.row("delay-spheres", "5.4.4",
          "Spheres lose contacts without a delay", "none",
          "the same rate ratio above that of spheroids at the highest pressure")
def delay_spheres(study):
    whats = ("p010", "p050", "p100")
    spheres = by_pressure(study, whats, _early, "sphere")
    bodies = by_pressure(study, whats, _early)
    return all_of(labelled("spheres", Finding(*series(spheres),
                                              means(spheres)[-1] > means(bodies)[-1])),
                  labelled("spheroids", Finding(*series(bodies))))


@rows.row("rates", "F. 5.11c",
          "The rate of contact loss depends on the pressure within the first 5 % of strain alone",
          "first 5 % alone",
          "spread of its mean over pressures after 5 % at most a third of that before")
def rates(study):
    def find(whats):
        early = by_pressure(study, whats, lambda test: (test.mean_at(COORDINATION, 0.05)
                                                        - test.start(
            COORDINATION)) / (0.05 * test.stretch))
        late = by_pressure(study, whats, lambda test: (test.mean_at(COORDINATION, STEADY)
                                                       - test.mean_at(
            COORDINATION, 0.05)) / ((STEADY - 0.05) * test.stretch))
        return all_of(labelled("to 0.05", Finding(*series(early))),
                      labelled("to 0.205", Finding(*series(late),
                                                   spread(late) <= spread(early) / 3.0)))
    return on_sets(SETS, find)


@rows.row("lost", "F. 5.11d",
          "The coordination lost to the steady state hardly depends on the pressure",
          "nearly independent", "target: range at most 20 % of the mean",
          doubt="[C] initial values run from 9.50 to 12.44, and the steady one is said to be 6")
def lost(study):
    def find(whats):
        fall = by_pressure(study, whats, lambda test: test.start(COORDINATION)
                           - test.mean_at(COORDINATION, STEADY))
        p = [pressure(what) for what in whats]
        part = spread(fall) / statistics.fmean(means(fall))
        return Finding(*series(fall), part <= 0.2, f"range {100 * part:.0f} % of the mean, slope "
                       f"{least_squares_slope(p, means(fall)):.4f} per MPa, correlation "
                       f"{correlation(p, means(fall)):.3f}")
    return on_sets(SETS, find)


@rows.row("force", "F. 5.12",
          "The mean normal force, at first and in the steady state, and its mean rate go with "
          "the pressure",
          "strong correlation", "each correlation at least 0.98")
def force(study):
    def find(whats):
        p = [pressure(what) for what in whats]
        first = by_pressure(study, whats, lambda test: test.start("mean_normal_force"))
        last = by_pressure(study, whats, lambda test: test.mean_at("mean_normal_force", STEADY))
        rate = by_pressure(study, whats, lambda test: (test.mean_at("mean_normal_force", STEADY)
                           - test.start("mean_normal_force")) / (STEADY * test.stretch))
        found = []
        for name, samples in (("initial", first), ("at 0.205", last), ("rate", rate)):
            r = correlation(p, means(samples))
            found.append(labelled(name, Finding(*series(samples), r >= 0.98, f"{name} {r:.3f}")))
        return all_of(*found)
    return on_sets(SETS, find)


def _apart(study, small, large):
    """Largest distance of two tests' mean curves after 1 % of strain, and their scatter there:
    {column: (distance, scatter)}."""
    found = {}
    for column in ("friction_angle_deg", "volumetric_strain", COORDINATION, "porosity"):
        end = min(study.test(f"{small}-shear-s{study.small_seeds[0]}").end,
                  study.test(shear_name("spheroid", large, study.seeds[0])).end) / study.stretch
        most = (0.0, 0.0)
        for x in (x for x in GRID if x <= end):
            a = each(study, lambda seed, x=x: study.test(f"{small}-shear-s{seed}").mean_at(column,
                x),
                     study.small_seeds)
            b = each(study, lambda seed, x=x: study.test(shear_name(
                "spheroid", large, seed)).mean_at(column, x))
            most = max(most, (abs(a.mean - b.mean), (a.scatter**2 + b.scatter**2)**0.5))
        found[column] = most
    return found


@rows.row("test3", "5.4.6 i",
          "125 bodies at 47 MPa (test 3) behave as 1000 at 50 MPa (4c)", "very close",
          "friction angles within 2 degrees after 1 % of strain, or within the scatter of a seed")
def test3(study):
    apart = _apart(study, "test3", "p050")
    degrees, scatter_ = apart["friction_angle_deg"]
    return Finding(text(degrees), text(scatter_, 2), len(study.seeds),
                   degrees <= max(2.0, scatter_),
                   "largest distances: " + ", ".join(
                       f"{name} {text(value)}" for name, (value, _) in apart.items()))


@rows.row("test1", "5.4.6 ii",
          "27 bodies at 7 MPa (test 1) behave otherwise than 1000 at 10 MPa (4e)",
          "differ, coordination by more than 1",
          "friction angles apart by more than 2 degrees and the scatter; coordination by more "
          "than 1")
def test1(study):
    apart = _apart(study, "test1", "p010")
    degrees, scatter_ = apart["friction_angle_deg"]
    contacts = apart[COORDINATION][0]
    return Finding(f"{text(degrees)}; {text(contacts)}", text(scatter_, 2), len(study.seeds),
                   degrees > max(2.0, scatter_) and contacts > 1.0,
                   "the published rate of test 1 is ten times that of the others, ours is the "
                   f"same; to {text(study.test(f'test1-shear-s{study.small_seeds[0]}').end)} of "
                   "strain, since bodies of so small a cell then touch each other twice; largest "
                   "distances: " + ", ".join(
                       f"{name} {text(value)}" for name, (value, _) in apart.items()))


@rows.row("groups", "F. 5.14",
          "Contacts by direction group at A to D of test 4d", "pictures",
          "the groups' numbers add up to all contacts",
          doubt="[?] no rule is given: a contact is of the axis along which its normal is largest")
def groups(study):
    shares, complete = {}, True
    for point in "ABCD":
        def axial(seed, point=point):
            found = study.averages(shear_name("spheroid", "p030", seed), f"shear-{point}")
            return found["direction_groups"], found["contacts"]
        taken = [axial(seed) for seed in study.seeds if each(study, axial)]
        complete &= all(sum(group[k]["contacts"] for k in "xyz") == total for group, total in taken)
        shares[point] = each(study, lambda seed: axial(seed)[0]["z"]["fraction"])
    return Finding(*series(shares), complete, "axial group's share of all contacts")


@rows.row("group-share", "F. 5.15 a, b",
          "The axial group loses contacts the slowest, and its share never falls below the "
          "initial one",
          "never below",
          "share at least the initial less 0.01 at every strain; the lateral groups lose more")
def group_share(study):
    def find(whats):
        least = micro_by_pressure(study, whats, lambda test: min(test["fraction_z"])
                                  - test.start("fraction_z"))
        def kept(test, axes):
            count = [sum(test[f"fraction_{k}"][row] for k in axes) * test["contacts"][row]
                     for row in (0, -1)]
            return count[1] / count[0]
        axial = micro_by_pressure(study, whats, lambda test: kept(test, "z"))
        lateral = micro_by_pressure(study, whats, lambda test: kept(test, "xy"))
        slower = all(a > b for a, b in zip(means(axial), means(lateral)))
        return all_of(labelled("least less initial", Finding(*series(least),
                                                             min(means(least)) >= -0.01)),
                      labelled("axial kept", Finding(*series(axial), slower)),
                      labelled("lateral kept", Finding(*series(lateral))))
    return on_sets(SETS, find)


@rows.row("group-bias", "F. 5.15 b",
          "The bias towards the axis is largest after the peak (C)", "after C",
          "strain of the largest axial share above that of the peak friction angle")
def group_bias(study):
    def find(whats):
        def lead(test):
            share = test["fraction_z"]
            return test.strain[share.index(max(share))] - test.peak_friction[1]
        after = micro_by_pressure(study, whats, lead)
        return Finding(*series(after), min(means(after)) > 0.0, "strain after the peak")
    return on_sets(SETS, find)


@rows.row("group-force", "F. 5.15c",
          "The axial group's mean force rises to C, the lateral ones' falls strongly",
          "rises; falls", "axial at C above the initial; lateral at the end below it")
def group_force(study):
    def find(whats):
        def lateral(test, at):
            return statistics.fmean(at(test, f"normal_force_{k}") for k in "xy")
        def late(test, name):
            return test.last(name, 0.02)
        axial = micro_by_pressure(study, whats, lambda test: test.mean_at(
            "normal_force_z", test.peak_friction[1] / test.stretch, 0.02)
                                  / test.start("normal_force_z"))
        across = micro_by_pressure(study, whats, lambda test: lateral(test, late) / lateral(
            test, lambda one, name: one.start(name)))
        return all_of(labelled("axial, C over A", Finding(*series(axial), min(means(axial)) > 1.0)),
                      labelled("lateral, end over A", Finding(*series(across),
                                                              max(means(across)) < 1.0)))
    return on_sets(SETS, find)
