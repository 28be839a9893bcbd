#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The whole programme of tests with few particles: it ends well, and every row is evaluated.

Values are what so small samples give, and are not looked at.
Usage: reduced_test.py DEM_STUDY TANGENCY_DEM OUT
"""
import csv
import os
import shutil
import subprocess
import sys

study, tool, out = (os.path.abspath(word) for word in sys.argv[1:4])
shutil.rmtree(out, ignore_errors=True)
command = [sys.executable, os.path.join(study, "study"), "--reduced", "--out", out, "--tool", tool]
status = subprocess.run(command, check=False).returncode
if status:
    sys.exit(f"reduced_test: exit status {status}")
with open(os.path.join(out, "rows.csv"), encoding="utf-8", newline="") as file:
    rows = list(csv.DictReader(file))
known = {"reproduced", "not reproduced", "doubtful in the text", "reported"}
for row in rows:
    if row["verdict"] not in known:
        sys.exit(f"reduced_test: row {row['id']}: {row['verdict']}: {row['note']}")
    if not row["ours"]:
        sys.exit(f"reduced_test: row {row['id']} has no value")
if {row["id"].partition("-")[0] for row in rows} != {f"3.{k}" for k in range(1, 8)}:
    sys.exit("reduced_test: a section has no row")
