# SPDX-License-Identifier: GPL-3.0-or-later
"""Mutants that stand in a file: of each its source, its lines before and after, and what is wrong."""
import dataclasses
import pathlib
import re


@dataclasses.dataclass(frozen=True)
class Planted:
    file: str  # from the project's root
    before: str
    after: str
    reason: str

    @property
    def change(self):
        """What a Tree asks for applied_to()."""
        return self

    def applied_to(self, text):
        if text.count(self.before) != 1:
            raise ValueError(f"{self.file}: these lines are not there once: {self.before}")
        return text.replace(self.before, self.after)


def planted_in(text):
    """Sections `### geometry/FILE`, each with a block of diff and a reason."""
    section = re.compile(r"^### (\S+)\n+```diff\n(.*?)^```\n(.*?)(?=^#|\Z)", re.M | re.S)
    found = []
    for file, diff, reason in section.findall(text):
        sides = ["\n".join(row[1:] for row in diff.splitlines() if row[:1] == mark) for mark in "-+"]
        found.append(Planted(file, *sides, " ".join(reason.split())))
    return found


def read(path):
    return planted_in(pathlib.Path(path).read_text())
