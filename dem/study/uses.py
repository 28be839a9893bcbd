# SPDX-License-Identifier: MIT
"""What each run is, for readers of the results: a line of runs.csv for each use of a run.

Columns: run (folder below runs/), kind (growth, unload, shear, sample or limit), stage (its name in
history.csv), test (of Table 5.2; 4a-table is 4a with the e = 0.11 of the table, 4a with the 0.176
of the text), family, shape, elongation (a / b at the stage's end), flatness, particles, pressure
(Pa), preparation, law, intermediate_ratio, contacts, seed, status (complete, failed or missing).
"""
from stages import elongation_of

COLUMNS = ("run", "kind", "stage", "test", "family", "shape", "elongation", "flatness", "particles",
           "pressure", "preparation", "law", "intermediate_ratio", "contacts", "seed", "status")

KINDS = {"grow": "growth", "unload": "unload", "shear": "shear", "relax": "sample",
         "compress": "sample", "servo": "sample"}
TESTS = {"spheroid-e11": "4a-table", "spheroid-p100": "4a", "spheroid-p070": "4b",
         "spheroid-p050": "4c", "spheroid-p030": "4d", "spheroid-p010": "4e",
         "test1-sample": "1", "test3-sample": "3", "test1": "1", "test3": "3"}
PREPARATIONS = {"horizontal": "horizontal", "slow": "slow growth", "loose": "loose",
                "published": "published rate"}


def _shape(run, elongation, flatness):
    if len(run.body["particles"]) > 1:
        return "two-size"
    if run.body["cell"].get("dimensions") == 2:
        return "disk" if elongation == 1.0 else "ellipse"
    if flatness != 1.0:
        return "triaxial"
    return "sphere" if elongation == 1.0 else "spheroid"


def _test(run):
    what = run.name.rpartition("-s")[0]
    return TESTS.get(what.removesuffix("shear").rstrip("-"), "")


def lines(programme, jobs):
    """The values of COLUMNS."""
    for run in programme.runs.values():
        status = jobs[run.name].status
        status = status if status in ("complete", "failed") else "missing"
        particles = next(iter(run.body["particles"].values()))
        elongation, flatness = particles.get("elongation", 1.0), particles.get("flatness", 1.0)
        own = len(programme.stages_of(run.name)) - len(run.stages)
        for at, stage in enumerate(programme.stages_of(run.name)):
            if "eccentricity" in stage:
                elongation = elongation_of(stage["eccentricity"])
            flatness = stage.get("flatness", flatness)
            if at < own or stage["kind"] not in KINDS:
                continue
            family = run.name.split("-")[0]
            name = stage.get("name", stage["kind"])
            kind = "limit" if name.startswith("limit") else KINDS[stage["kind"]]
            yield (run.name, kind, name, _test(run), family, _shape(run, elongation, flatness),
                   repr(elongation), repr(flatness),
                   sum(keys["count"] for keys in run.body["particles"].values()),
                   stage.get("mean_stress", ""), PREPARATIONS.get(family, "dense"),
                   run.body["contact"].get("law", "linear"), stage.get("intermediate_ratio", ""),
                   run.body["motion"].get("contacts", "follow"), run.seed, status)
