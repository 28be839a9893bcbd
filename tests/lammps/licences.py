#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Everything in dem/lammps is GPL-2.0-or-later, and no file of it reaches one that is GPL-3.0-or-later
by its includes, at any depth, or names a target of verify/, bench/ or tests/ to link.

Usage: licences.py ROOT
Prints what departs, and ends with 1 where anything does.
"""
import os
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "build"))
from include_graph import Tree  # noqa: E402

OWN = "GPL-2.0-or-later"
ALLOWED = (OWN, "MIT")
FORBIDDEN = ("tangency_verify", "tangency::verify", "tangency_oracles", "tangency_test", "tangency_bench")


def licence(path):
    with open(path, encoding="utf-8") as file:
        for line in file:
            if "SPDX-License-Identifier:" in line:
                return line.split("SPDX-License-Identifier:")[1].split()[0]
    return "none"


def departures(root):
    tree = Tree(root)
    sources = [path for path in tree.text if path.startswith("dem/lammps/")]
    if len(sources) < 5:
        yield "dem/lammps has hardly any source: this test cannot fail"
    for path in sorted(sources):
        for reached in sorted(tree.reached(path)):
            if licence(os.path.join(root, reached)) not in ALLOWED:
                yield f"{path} reaches {reached}"
    for folder, _, names in os.walk(os.path.join(root, "dem", "lammps")):
        for name in sorted(names):
            path = os.path.join(folder, name)
            if licence(path) != OWN:
                yield f"{os.path.relpath(path, root)}: {licence(path)}, not {OWN}"
            if name == "CMakeLists.txt":
                with open(path, encoding="utf-8") as file:
                    text = file.read()
                yield from (f"{os.path.relpath(path, root)} names {word}" for word in FORBIDDEN if word in text)


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    found = list(departures(sys.argv[1]))
    print("\n".join(found) if found else "dem/lammps: nothing of GPL-3.0-or-later")
    sys.exit(1 if found else 0)


if __name__ == "__main__":
    main()
