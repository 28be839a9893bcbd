# SPDX-License-Identifier: GPL-3.0-or-later
"""The codes that stand in this folder, and the pages that tables of them are written to."""
import subprocess
import sys
from dataclasses import dataclass, field
from pathlib import Path

HERE = Path(__file__).resolve().parent


@dataclass
class Code:
    """A code with its options: how it is asked, and what came out, by corpus."""

    command: list
    key: str
    name: str
    definition: str
    values: dict = field(default_factory=dict)  # corpus: {name of the value: value}
    ended: dict = field(default_factory=dict)   # corpus: "failed / ended / hung"
    letter: str = ""

    def total(self, what):
        """Over the corpora; None where the code is not held to it."""
        seen = [v[what] for v in self.values.values() if what in v]
        return sum(seen) if seen else None

    def largest(self, what):
        seen = [v[what] for v in self.values.values() if what in v]
        return max(seen) if seen else None


def run(command, **options):
    return subprocess.run(command, text=True, capture_output=True, **options)


def listed(program):
    """The codes that a program of this folder names."""
    found = run([program, "--list"], check=True).stdout.splitlines()
    for line in found:
        key, library, version, call, options, definition = line.split("\t")
        library += "" if version == "-" else f" {version}"
        yield Code([str(program), key], key, f"{library} `{call}`, {options}", definition)


def listed_codes(answers):
    """Those of peer_answers, and those of the adapters that are scripts."""
    return [code for program in (answers, *sorted(HERE.glob("*/answers.py")))
            for code in listed(program)]


def put_between_marks(page, first, last, tables):
    """Between the comment that begins with `first` and the comment `last`, each of which stands in the
    page once."""
    begin, end = f"<!-- {first}", f"<!-- {last} -->\n"
    text = page.read_text()
    if text.count(begin) != 1 or text.count(end) != 1:
        sys.exit(f"{Path(sys.argv[0]).name}: {page} lacks the two marks")
    head, rest = text.split(begin)
    mark, tail = rest.split("\n", 1)[0], rest.split(end)[1]
    page.write_text(f"{head}{begin}{mark}\n\n{tables}\n{end}{tail}")
