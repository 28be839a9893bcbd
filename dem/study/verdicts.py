# SPDX-License-Identifier: MIT
"""Rows of the study's table, and how a bar gives a verdict. No verdict is written by hand.

A row has a function that looks at the study and returns a Finding: our value as text, its scatter,
and whether the bar is met. Verdicts:
  reproduced             the bar is met
  not reproduced         it is not
  doubtful in the text   it is not, and the text contradicts itself there or cannot be read ([C],
                         [?], an erratum); also where there is no bar for that reason; and where the
                         text is in error and what is compared is the corrected statement
  reported               the text has no number or ordering to compare with
  not run                a run that the row needs is not complete
"""
import dataclasses
import math
import statistics

import programme
from measures import NotRun, Unmeasurable

REPRODUCED, NOT_REPRODUCED = "reproduced", "not reproduced"
DOUBTFUL, REPORTED, NOT_RUN = "doubtful in the text", "reported", "not run"
FAULT = "not evaluated"  # a fault of this program


class Sample(tuple):
    """Values of one quantity, one a seed."""

    @property
    def mean(self):
        return statistics.fmean(self)

    @property
    def scatter(self):
        """Standard deviation of a seed, 0 of one."""
        return statistics.stdev(self) if len(self) > 1 else 0.0

    @property
    def error(self):
        """Standard deviation of the mean."""
        return self.scatter / math.sqrt(len(self))


@dataclasses.dataclass
class Finding:
    ours: str
    scatter: str = ""
    seeds: int = 0
    met: bool | None = None  # None: nothing to be met
    note: str = ""
    doubt: str = ""  # of this comparison, beside that of the row


@dataclasses.dataclass
class Row:
    id: str
    section: str
    statement: str
    published: str
    bar: str
    find: object
    doubt: str = ""  # C, ?, E5: a mark of the programme, and why
    corrected: bool = False  # the bar is of what is so, not of what is published
    apart: str = ""  # the part that has to be asked for


@dataclasses.dataclass
class Result:
    id: str
    section: str
    statement: str
    published: str
    bar: str
    ours: str = ""
    scatter: str = ""
    seeds: int = 0
    verdict: str = NOT_RUN
    note: str = ""


COLUMNS = [field.name for field in dataclasses.fields(Result)]


class Section:
    """Collects rows: `rows = Section("3.1")`, `@rows.row("4b-force", "Table 5.2", ...)`."""

    def __init__(self, number):
        self.number = number
        self.rows = []

    def row(self, name, section, statement, published, bar, **keys):
        def keep(find):
            self.rows.append(Row(f"{self.number}-{name}", section, statement, published, bar, find,
                                 **keys))
            return find
        return keep


def is_due(row, parts):
    """Whether a study of these parts should have evaluated the row: those of a part by itself only
    in a study that has that part, the others in a study of all the other parts."""
    if row.apart:
        return row.apart in parts
    return set(programme.PARTS) <= set(parts)


def verdict_of(row, finding):
    doubt = row.doubt or finding.doubt
    if finding.met is None:
        return DOUBTFUL if doubt else REPORTED
    if row.corrected:
        return DOUBTFUL if finding.met else NOT_REPRODUCED
    if finding.met:
        return REPRODUCED
    return DOUBTFUL if doubt else NOT_REPRODUCED


def evaluate(row, study):
    result = Result(row.id, row.section, row.statement, row.published, row.bar)
    notes = [row.doubt] if row.doubt else []
    try:
        finding = row.find(study)
    except NotRun as missing:
        result.note = f"needs the run {missing}"
        return result
    except Unmeasurable as why:
        finding = Finding("none", met=False, note=f"not measurable: {why}")
    except Exception as fault:  # one faulty row must not take the table away
        result.verdict = FAULT
        result.note = f"{type(fault).__name__}: {fault}"
        return result
    result.ours, result.scatter, result.seeds = finding.ours, finding.scatter, finding.seeds
    result.verdict = verdict_of(row, finding)
    if row.corrected:
        notes.append("the bar is of the corrected statement"
                     + (", and is met" if finding.met else ", and is not met"))
    result.note = "; ".join([*notes, *([finding.note] if finding.note else [])])
    return result


def text(value, digits=3):
    """Enough digits to read: 12.5, 0.144, 1.27e10."""
    if value is None:
        return "-"
    size = abs(value)
    if size and (size >= 1e5 or size < 1e-3):
        mantissa, _, exponent = f"{value:.{digits - 1}e}".partition("e")
        return f"{mantissa}e{int(exponent)}"
    return f"{value:#.{max(digits, len(str(int(size))))}g}".rstrip(".")


def each(study, measure, seeds=None):
    """Sample of measure(seed) over the seeds whose runs are complete; NotRun where none is."""
    values, missing = [], None
    for seed in seeds or study.seeds:
        try:
            values.append(measure(seed))
        except NotRun as error:
            missing = missing or error
    if not values:
        raise missing
    return Sample(values)


def near(sample, wanted, relative=None, absolute=None):
    """The mean within a share of what is wanted, or within a distance."""
    allowed = absolute if relative is None else relative * abs(wanted)
    off = sample.mean - wanted
    how = f"{100 * off / wanted:+.1f} %" if relative is not None else f"{off:+.3g}"
    return Finding(text(sample.mean, 4), text(sample.scatter, 2), len(sample), abs(off) <= allowed,
                   f"off by {how}")


def inside(sample, low=-math.inf, high=math.inf):
    """The mean within these bounds, both included."""
    return Finding(text(sample.mean, 4), text(sample.scatter, 2), len(sample),
                   low <= sample.mean <= high)


def reported(sample, note=""):
    return Finding(text(sample.mean, 4), text(sample.scatter, 2), len(sample), None, note)


def series(samples, digits=3):
    """`10: 44.1, 30: 43.0` of {label: Sample}, their scatters alike."""
    ours = ", ".join(f"{label}: {text(sample.mean, digits)}" for label, sample in samples.items())
    scatter = ", ".join(text(sample.scatter, 2) for sample in samples.values())
    return ours, scatter, min(len(sample) for sample in samples.values())


def order(samples, rising, within_scatter=False, of="mean"):
    """{label: Sample} in their order rise (or fall) strictly; or, within the scatter of a seed, do
    not go the other way."""
    values = list(samples.values())
    sign = 1.0 if rising else -1.0
    met, worst = True, ""
    for (name, a), (other, b) in zip(list(samples.items()), list(samples.items())[1:]):
        slack = math.hypot(a.scatter, b.scatter) if within_scatter else 0.0
        step = sign * (b.mean - a.mean)
        if not (step > 0.0 or (within_scatter and step > -slack)):
            met, worst = False, worst or f"{name} to {other} goes the other way"
    return Finding(*series(samples), met, worst)


def spread(samples):
    """Largest less smallest mean."""
    means = [sample.mean for sample in samples.values()]
    return max(means) - min(means)


def all_of(*findings):
    """Met where each is; the texts one after the other."""
    mets = [finding.met for finding in findings if finding.met is not None]
    return Finding("; ".join(f.ours for f in findings if f.ours),
                   "; ".join(f.scatter for f in findings if f.scatter),
                   min(f.seeds for f in findings), all(mets) if mets else None,
                   "; ".join(f.note for f in findings if f.note))


def labelled(label, finding):
    return dataclasses.replace(finding, ours=f"{label} {finding.ours}")


def on_sets(sets, find, shown=None):
    """The text does not say over which pressures a range spans: {name: keys of one set}. Met on all
    of them is met; on some of them it is as doubtful as the text. The note says on which.

    @param shown  keys of which values are shown, without a bar [those of all sets]"""
    findings = {name: find(keys) for name, keys in sets.items()}
    met = {name: finding.met for name, finding in findings.items()}
    note = "; ".join(f"{name}: {'met' if met[name] else 'not met'}"
                     + (f" ({finding.note})" if finding.note else "")
                     for name, finding in findings.items())
    some = any(met.values()) and not all(met.values())
    doubt = "holds for one reading of the range" if some else ""
    keys = shown or list(dict.fromkeys(key for keys in sets.values() for key in keys))
    return dataclasses.replace(find(keys), met=all(met.values()), doubt=doubt, note=note)
