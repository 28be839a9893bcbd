# SPDX-License-Identifier: GPL-3.0-or-later
"""What a file of llvm-cov's export says about its lines and branches."""
import dataclasses
import re

# A branch that a sound program never takes is no gap in the tests: the failing side of an assertion,
# and what is marked as never reached.
NEVER = re.compile(r"\bassert\(|\bHWY_DASSERT\(|\b__builtin_unreachable\(")
CODE = (".cpp", ".hpp", ".h")


@dataclasses.dataclass
class Counts:
    lines: int
    branches: int
    missed_lines: list
    missed_branches: list  # (line, "true" or "false")

    @property
    def lines_run(self):
        return self.lines - len(self.missed_lines)

    @property
    def branches_run(self):
        return self.branches - len(self.missed_branches)


def is_ours(path, folders):
    return path.suffix in CODE and path.parts[0] in folders


def line_counts(segments):
    """How often each line ran that holds code: the rule of llvm-cov, by its segments
    [line, column, count, has count, begins a region, is a gap]."""
    counts = {}
    wrapped = None
    at = 0
    last = segments[-1][0] if segments else 0
    for line in range(segments[0][0] if segments else 1, last + 1):
        here = []
        while at < len(segments) and segments[at][0] == line:
            here.append(segments[at])
            at += 1
        begun = [s for s in here if s[4] and s[3] and not s[5]]
        skipped = here and here[0][4] and not here[0][3]
        mapped = not skipped and ((wrapped is not None and wrapped[3]) or begun)
        if mapped:
            count = max([s[2] for s in begun] + ([wrapped[2]] if wrapped is not None and wrapped[3] else []))
            if begun or wrapped is not None:
                counts[line] = count
        if here:
            wrapped = here[-1]
    return counts


def branch_counts(branches):
    """Each place once, whatever number of templates and instruction sets it was compiled for."""
    counts = {}
    for line, column, end_line, end_column, yes, no, *_ in branches:
        place = (line, column, end_line, end_column)
        before = counts.get(place, (0, 0))
        counts[place] = (before[0] + yes, before[1] + no)
    return counts


def counted(files, source):
    """Counts of one file, whose lines are these: the export has it once for each name by which it was
    compiled."""
    lines = {}
    for file in files:
        for line, count in line_counts(file["segments"]).items():
            lines[line] = max(count, lines.get(line, 0))
    missed_lines = [line for line, count in sorted(lines.items()) if count == 0]
    branches = 0
    missed = []
    every = [branch for file in files for branch in file.get("branches", [])]
    for (line, *_), ways in sorted(branch_counts(every).items()):
        if NEVER.search(source[line - 1]):
            continue
        branches += 2
        missed += [(line, way) for way, count in zip(("true", "false"), ways) if count == 0]
    return Counts(len(lines), branches, missed_lines, missed)
