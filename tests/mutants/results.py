# SPDX-License-Identifier: GPL-3.0-or-later
"""What became of the mutants: a file that grows by a line a mutant, and the tables of the end."""
import collections
import json
import pathlib

from operators import OPERATORS

# killed: a test failed. equivalent: a survivor whose reason is written down, or the same machine
# code. survived: all tests passed. not compiling: counts apart, another is drawn.
STATUSES = ("killed", "survived", "equivalent", "not compiling")


class Results:
    """
    @param resume     is what the file has to be kept as far as it holds?
    @param explained  ids of mutants whose survival is explained: a resumed run does not ask them
                      again while their file is the same
    """

    def __init__(self, path, settings, resume, explained=frozenset()):
        self.path = pathlib.Path(path)
        self.settings = settings
        self.rows = {}
        if resume and self.path.exists():
            self._read(explained)
        self.path.parent.mkdir(parents=True, exist_ok=True)
        lines = [json.dumps(settings)] + [json.dumps(row) for row in self.rows.values()]
        self.path.write_text("".join(line + "\n" for line in lines))

    def _read(self, explained):
        """What was found out before and still holds. A mutant that a test killed stays killed while
        its file is the same; what survived is asked again once any text has changed, or by slower
        tests than before."""
        for row in rows_of(self.path):
            same = (row["tree"] == self.settings["tree"] and
                    row["slowest"] >= self.settings["slowest"])
            same_file = row["text"] == self.settings["texts"].get(row["file"])
            if same_file and (same or row["status"] != "survived" or row["id"] in explained):
                self.rows[row["id"]] = row

    def add(self, row):
        self.rows[row["id"]] = row
        with self.path.open("a") as out:
            out.write(json.dumps(row) + "\n")


def rows_of(path):
    """The mutants of a result file. The last line of a run that was ended may be torn."""
    for line in pathlib.Path(path).read_text().splitlines()[1:]:
        try:
            yield json.loads(line)
        except json.JSONDecodeError:
            pass


def share_killed(rows):
    counts = collections.Counter(row["status"] for row in rows)
    known = counts["killed"] + counts["survived"]
    return counts["killed"] / known if known else 0.0


def table(rows, column, order=None):
    """Lines of a table: a row for each value of the column, and one for all."""
    by_value = collections.defaultdict(collections.Counter)
    for row in rows:
        by_value[row[column]][row["status"]] += 1
        by_value["all"][row["status"]] += 1
    names = [n for n in (order or sorted(set(by_value) - {"all"})) if n in by_value] + ["all"]
    width = max(len(name) for name in names)
    yield f"| {column:{width}} | mutants | " + " | ".join(STATUSES) + " | killed of what is not equivalent |"
    yield "|---" * (len(STATUSES) + 3) + "|"
    for name in names:
        counts = by_value[name]
        compiled = sum(counts.values()) - counts["not compiling"]
        known = counts["killed"] + counts["survived"]
        share = f"{100 * counts['killed'] / known:.1f} %" if known else "-"
        yield (f"| {name:{width}} | {compiled} | " +
               " | ".join(str(counts[s]) for s in STATUSES) + f" | {share} |")


def report(rows):
    """The tables and the survivors."""
    lines = [*table(rows, "operator", OPERATORS), "", *table(rows, "file"), ""]
    for row in rows:
        if row["status"] == "survived":
            lines += [row["diff"], ""]
    return "\n".join(lines)
