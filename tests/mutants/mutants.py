# SPDX-License-Identifier: GPL-3.0-or-later
"""Which mutants a run makes, what names them, and what is known of them beforehand."""
import dataclasses
import hashlib
import pathlib
import random
import re

import operators
from cpp_text import Source


@dataclasses.dataclass(frozen=True)
class Mutant:
    file: str  # from the project's root
    change: operators.Change
    id: str
    original: str  # the whole lines that the change reaches over
    mutated: str

    def diff(self):
        taken = [f"-{line}" for line in self.original.splitlines()]
        given = [f"+{line}" for line in self.mutated.splitlines() if line.strip()]
        return "\n".join([f"@@ {self.file}:{self.change.line} {self.id} {self.change.operator}"] +
                         taken + given)


def plain(text):
    """Without what moving, indenting or breaking a line changes."""
    return " ".join(text.split())


def mutants_of(file, text):
    """Every mutant of a file, by place. Ids stay the same while the mutated lines do."""
    seen, found = {}, []
    for change in operators.changes(text):
        begin = text.rfind("\n", 0, change.begin) + 1
        end = text.find("\n", change.end)
        original = text[begin:end]
        mutated = text[begin:change.begin] + change.text + text[change.end:end]
        key = (file, plain(original), plain(mutated))
        seen[key] = seen.get(key, 0) + 1
        digest = hashlib.sha256("\n".join((*key, str(seen[key]))).encode()).hexdigest()[:8]
        found.append(Mutant(file, change, digest, original, mutated))
    return found


def lines_of_code(text):
    return len({token.line for token in Source(text).tokens})


def sources(root, pattern):
    """The C++ texts of geometry/ whose path matches, by path; without bindings/, a library of its own."""
    found = {}
    for path in sorted(pathlib.Path(root, "geometry").rglob("*.[ch]pp")):
        file = path.relative_to(root).as_posix()
        if re.search(pattern, file) and not file.startswith("geometry/bindings/"):
            found[file] = path.read_text()
    return found


def shares(weights, count):
    """`count` in proportion to the weights, but at least one each."""
    given = {name: 1 for name in weights}
    scale = count / max(1, sum(weights.values()))
    while weights and sum(given.values()) < count:
        given[max(weights, key=lambda name: (weights[name] * scale - given[name], name))] += 1
    return given


def draws(seed, file, mutants):
    """A file's mutants in the order in which it gives them: a line of its own each while there
    are such, any operator that has something to do there, any of what it can do."""
    chance = random.Random(f"{seed}:{file}")
    by_line = {}
    for mutant in mutants:
        by_line.setdefault(mutant.change.line, []).append(mutant)
    while by_line:
        for line in chance.sample(sorted(by_line), len(by_line)):
            at_line = by_line[line]
            operator = chance.choice(sorted({m.change.operator for m in at_line}))
            mutant = chance.choice([m for m in at_line if m.change.operator == operator])
            at_line.remove(mutant)
            if not at_line:
                del by_line[line]
            yield mutant


class Explained:
    """The survivors that are known, each with its reason: equivalents, which break no promise, and
    those that would but that no test is worth.

    The file has a part for each, `## Equivalent` and `## Not noticed`, and in it sections
    `### geometry/FILE`, a block of diff and a reason. A mutant is found by its file and by the
    text of its lines before and after.
    """

    STATUS = {"Equivalent": "equivalent", "Not noticed": "survived"}

    def __init__(self, text):
        self.known = {}  # (file, before, after): (status, reason)
        section = re.compile(r"^### (\S+)\n+```diff\n(.*?)^```\n(.*?)(?=^#|\Z)", re.M | re.S)
        for part in re.split(r"^## ", text, flags=re.M)[1:]:
            status = self.STATUS[part.split("\n", 1)[0].strip()]
            for file, diff, reason in section.findall(part):
                parts = {mark: "\n".join(row[1:] for row in diff.splitlines() if row[:1] == mark)
                         for mark in "-+"}
                key = (file, plain(parts["-"]), plain(parts["+"]))
                if not reason.strip():
                    raise ValueError(f"mutant of {file} without a reason: {key[2]}")
                self.known[key] = status, reason.strip()

    @staticmethod
    def key(mutant):
        return mutant.file, plain(mutant.original), plain(mutant.mutated)

    def of(self, mutant):
        """Status and reason, or None."""
        return self.known.get(self.key(mutant))

    def stale(self, texts):
        """Those which no mutant of these texts is."""
        keys = {self.key(m) for file, text in texts.items() for m in mutants_of(file, text)}
        return [key for key in self.known if key[0] in texts and key not in keys]
