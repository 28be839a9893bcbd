#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Random close packings of few bodies: dense as published, drawn, and not made twice.

Spheres of so small samples pack to 0.62 to 0.65 with 6 contacts each (isostatic, but for the stress
that is left), spheroids half as long again as thick to 0.69 to 0.72 with 9.2 to 10.1; the scene's
seeds are fixed.
Usage: packings_test.py DEM_STUDY TANGENCY_DEM
"""
import csv
import os
import subprocess
import sys
import tempfile

study, tool = (os.path.abspath(word) for word in sys.argv[1:3])


def run(out, *more):
    return subprocess.run([sys.executable, os.path.join(study, "packings"), "--out", out, "--tool",
                           tool, "--count", "100", "--seeds", "1", "--only", "1.0", "1.5", *more],
                          capture_output=True, text=True, check=False)


def main():
    with tempfile.TemporaryDirectory() as out:
        first = run(out)
        if first.returncode:
            return f"exit status {first.returncode}: {first.stderr}"
        with open(os.path.join(out, "packings.csv"), encoding="utf-8", newline="") as file:
            rows = {float(row["aspect"]): row for row in csv.DictReader(file)}
        for aspect, density, contacts in ((1.0, (0.62, 0.65), (5.9, 6.3)),
                                          (1.5, (0.69, 0.72), (9.2, 10.1))):
            for column, (low, high) in (("volume_fraction", density),
                                        ("contacts_without_rattlers", contacts)):
                value = float(rows[aspect][column])
                if not low <= value <= high:
                    return f"aspect ratio {aspect}: {column} = {value}, not in {low} to {high}"
        for name in ("packings-density.svg", "packings-contacts.svg"):
            if not os.path.getsize(os.path.join(out, name)):
                return f"{name} is empty"
        summary = os.path.join(out, "spheroids-1.5-1-of-100", "summary.json")
        made = os.stat(summary).st_mtime_ns
        run(out)
        if os.stat(summary).st_mtime_ns != made:
            return "a packing that is complete was made again"
        os.remove(summary)
        if run(out).returncode or not os.path.exists(summary):
            return "a packing that was interrupted does not go on"
        for words in (("--count", "0"), ("--only", "0"), ("--only", "nan"), ("--only", "many")):
            refused = run(out, *words)
            if refused.returncode != 2 or "Traceback" in refused.stderr or words[1] not in refused.stderr:
                return f"{' '.join(words)} is not refused by a line: {refused.stderr}"
    return 0


sys.exit(main())
