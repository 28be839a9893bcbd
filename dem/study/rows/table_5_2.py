# SPDX-License-Identifier: MIT
"""Table 5.2: the samples of the seven tests before they are sheared."""
from verdicts import Section, each, near

rows = Section("3.1")

# Test: sample, particles, e, pressure (MPa), mean normal force (N), coordination number, porosity.
TESTS = {
    "1": ("test1-sample", 27, 0.176, 7, 1.15e9, 10.52, 0.262, ""),
    "3": ("test3-sample", 125, 0.176, 47, 7.15e9, 11.21, 0.218, ""),
    "4a-table": ("spheroid-e11", 1000, 0.111, 100, 1.3e10, 12.44, 0.144,
           "[C] the table has e = 0.11 for this test, the text one shape, 0.176, for all"),
    "4a": ("spheroid-p100", 1000, 0.176, 100, 1.3e10, 12.44, 0.144,
            "[C] the other reading of test 4a: the table has e = 0.11, the text 0.176 for all"),
    "4b": ("spheroid-p070", 1000, 0.176, 70, 9.91e9, 11.70, 0.180, ""),
    "4c": ("spheroid-p050", 1000, 0.176, 50, 7.39e9, 11.46, 0.205, ""),
    "4d": ("spheroid-p030", 1000, 0.176, 30, 4.81e9, 10.92, 0.235, ""),
    "4e": ("spheroid-p010", 1000, 0.176, 10, 1.93e9, 9.50, 0.268, ""),
}


def seeds_of(study, test):
    return study.small_seeds if test in ("1", "3") else study.seeds


def sample_of(study, test, key):
    """A value of the summaries of a test's sample."""
    run = TESTS[test][0]
    return each(study, lambda seed: study.summary(f"{run}-s{seed}")[key], seeds_of(study, test))


def _row(test, what, key, published, shown, bar, doubt, **allowed):
    _, particles, e, pressure, *_ = TESTS[test]

    @rows.row(f"{test}-{what.split()[-1]}", "Table 5.2",
              f"Test {test} ({particles} bodies, e = {e}, {pressure} MPa): {what}",
              shown, bar, doubt=doubt)
    def find(study):
        return near(sample_of(study, test, key), published, **allowed)


for _test, (_, _, _, _, _force, _contacts, _porosity, _doubt) in TESTS.items():
    _row(_test, "mean normal force", "mean_normal_force", _force, f"{_force:.3g} N", "within 6 %",
         _doubt, relative=0.06)
    _row(_test, "coordination number", "coordination_number", _contacts, f"{_contacts:.2f}",
         "within 4 %", _doubt, relative=0.04)
    _row(_test, "porosity", "porosity", _porosity, f"{_porosity:.3f}", "within 0.01", _doubt,
         absolute=0.01)
