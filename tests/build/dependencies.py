#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Holds docs/dependencies.md against .ci/packages and CMake, and the bill of materials against it.

    dependencies.py SOURCE

Every package of .ci/packages has a row and every row but Debian's C library its package; every name
that CMake looks for has a row, with the least version that is asked for anywhere. A tested version
is that which is installed, where the package is; one that is `-` moves with Debian's updates.
"""
import json
import re
import subprocess
import sys
from pathlib import Path

ASKED = re.compile(r"find_package\((\w+)(?: ([0-9.]+))?")
TABLED = re.compile(r"^set\(tangency_of_(\w+) (?:CONFIG|MODULE) (\S+?)(?: ([0-9.]+))?\)", re.MULTILINE)
BY_HEADER = re.compile(r"^set\(tangency_of_(\w+) HEADER (\S+)", re.MULTILINE)
# What the project finds of itself, and a variable.
OWN = {"tangency"}


def rows_of(page):
    """Every row of its tables by the columns' names."""
    rows, names = [], []
    for line in page.read_text().splitlines():
        if line.startswith("|---"):
            continue
        if not line.startswith("| "):
            names = []
            continue
        cells = [cell.strip() for cell in line.strip("|").split("|")]
        if not names:
            names = cells
        else:
            rows.append(dict(zip(names, cells)))
    return rows


def asked_by_cmake(source):
    """Names that CMake looks for, each with the least versions that are asked for."""
    asked = {}
    files = [file for folder in ("geometry", "dem", "verify", "bench", "tests")
             for file in (source / folder).rglob("CMakeLists.txt")]
    for file in files:
        if file.is_relative_to(source / "tests/consumer"):
            continue
        for name, version in ASKED.findall(file.read_text()):
            asked.setdefault(name, set()).add(version)
    table = (source / ".ci/packaging/dependencies.cmake").read_text()
    for name, _, version in TABLED.findall(table):
        asked.setdefault(name, set()).add(version)
    for name, _ in BY_HEADER.findall(table):
        asked.setdefault(name, set()).add("")
    return {name: versions for name, versions in asked.items() if name not in OWN}


def packages_of_cmake(source):
    table = (source / ".ci/packaging/dependencies.cmake").read_text()
    return {name: package for name, package, *_ in TABLED.findall(table) + BY_HEADER.findall(table)}


def installed(package):
    """Its upstream version; nothing where it, or Debian's tool, is not there."""
    try:
        shown = subprocess.run(["dpkg-query", "-W", "-f", "${db:Status-Abbrev} ${Version}", package],
                               capture_output=True, text=True, check=False)
    except FileNotFoundError:
        return None
    if shown.returncode != 0 or not shown.stdout.startswith("ii "):
        return None
    return re.sub(r"^\d+:", "", shown.stdout.split()[-1])


def faults_of(source):
    rows = rows_of(source / "docs/dependencies.md")
    by_package = {row["package"]: row for row in rows}
    if len(by_package) != len(rows):
        yield "a package has two rows"
    listed = {line.split()[1] for line in (source / ".ci/packages").read_text().splitlines()
              if line and not line.startswith("#")}
    for package in sorted(listed - by_package.keys()):
        yield f"{package} of .ci/packages has no row"
    for package in sorted(by_package.keys() - listed - {"libc6-dev"}):
        yield f"{package} is not in .ci/packages"
    by_name = {row["name in CMake"]: row for row in rows if row["name in CMake"] != "-"}
    asked = asked_by_cmake(source)
    for name in sorted(asked.keys() - by_name.keys()):
        yield f"find_package({name}) has no row"
    for name in sorted(by_name.keys() - asked.keys()):
        yield f"{name}: CMake does not look for it"
    for name in sorted(asked.keys() & by_name.keys()):
        versions = sorted(asked[name] - {""}) or ["-"]
        if by_name[name]["least version"] not in versions:
            yield f"{name}: least version {by_name[name]['least version']}, CMake asks for {versions}"
    for name, package in packages_of_cmake(source).items():
        if name in by_name and by_name[name]["package"] != package:
            yield f"{name} is of {package}"
    for package, row in by_package.items():
        version = installed(package)
        if version and row["tested version"] != "-" and not version.startswith(row["tested version"]):
            yield f"{package}: tested version {row['tested version']}, installed is {version}"
        if not row["licence"] or not row["for"]:
            yield f"{package}: a cell is empty"


def faults_of_bill(source):
    made = subprocess.run([source / ".ci/packaging/sbom"], capture_output=True, text=True, check=True)
    bill = json.loads(made.stdout)
    names = {package["name"] for package in bill["packages"]}
    wanted = {row["package"] for row in rows_of(source / "docs/dependencies.md")
              if "linked into" in row}
    if names != wanted | {"tangency"}:
        yield f"the bill of materials has other packages: {sorted(names ^ wanted)}"
    again = subprocess.run([source / ".ci/packaging/sbom"], capture_output=True, text=True, check=True)
    if again.stdout != made.stdout:
        yield "two bills of materials differ"


def main():
    source = Path(sys.argv[1])
    faults = [*faults_of(source), *faults_of_bill(source)]
    for fault in faults:
        print(f"docs/dependencies.md: {fault}")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
