# SPDX-License-Identifier: GPL-3.0-or-later
"""Made-up results of a study: small tables with all columns, and a program in place of
tangency-dem.

Values are smooth and simple; what they are does not matter, but that they are there and are drawn.
"""

import csv
import json
import math
import os
import random
import sys

import directions

MODULI = ("r", "n", "t", "z", "zt", "len", "E", "lambda")
SHARES = ("r", "n", "t", "z", "zt", "rz", "rf", "zf")
PAIRS = ("ss", "si", "sl", "ii", "il", "ll")

# Axial components that the fake program plants.
SECOND = {"fabric": 0.8, "normal_force": 0.9, "tangential_force": 0.4, "long_axes": -1.5}
F0 = 5e9


def write_table(file, rows):
    os.makedirs(os.path.dirname(file), exist_ok=True)
    with open(file, "w", encoding="utf-8", newline="") as table:
        writer = csv.DictWriter(table, list(rows[0]), lineterminator="\n")
        writer.writeheader()
        writer.writerows(rows)


def rise(x, pressure):
    """A curve with a peak that is later at higher pressure."""
    t = x / (0.01 + 0.001 * pressure)
    return t / (1.0 + t) * (1.0 - 0.6 * x)


def history_row(stage, x, pressure, seed):
    ratio = 1.8 * rise(x, pressure) + 0.01 * seed
    p = 1e6 * pressure
    return {"cycle": round(1e5 * x), "stage": stage, "axial_strain": x,
            "volumetric_strain": 0.5 * x * x / (x + 0.001 * pressure), "mean_stress": p,
            "s_xx": p * (1 - ratio / 3), "s_yy": p * (1 - ratio / 3),
            "s_zz": p * (1 + 2 * ratio / 3),
            "s_xy": 0, "s_yz": 0, "s_zx": 0, "friction_angle_deg": 25 * ratio,
            "coordination_number": 6 + 5 * math.exp(-10 * x), "coordination_std": 1.3,
            "porosity": 0.2 + 0.3 * x, "contacts": 500, "mean_normal_force": F0,
            "mean_overlap": 0.4,
            "inertial_fraction": 1e-3, "elongation": 1 + x, "eccentricity": x / (2 + x),
            "packing_density": 0.8 - 0.3 * x, "void_ratio": 0.25,
            "overlap_fraction": 0.02 + 0.1 * x}


def micro_row(stage, x, pressure, seed):
    a_s = 1.8 * rise(x, pressure) + 0.01 * seed
    p = 1e6 * pressure
    row = {"cycle": round(1e5 * x), "stage": stage, "axial_strain": x, "contacts": 500,
           "f0": F0, "z0": 19.0, "a_cv": 0.8, "a1": 0.6 + 0.1 * x, "P2": -0.17, "P2_model": -0.174,
           "a_axial_r_rot": 0.2 * x, "a_s": a_s, "a_s_small": a_s, "a_s_coaxial": 0.98 * a_s}
    for k, name in enumerate(MODULI):
        row["A_" + name] = a_s / (k + 1)
        row["a_axial_" + name] = a_s / (k + 1)
    for kind in ("seven", "eight", "fourth", "noshape", "independent"):
        row["a_s_" + kind] = 0.97 * a_s + 1e-3
    for k in (1, 2, 3):
        row[f"s{k}"] = p * (1 + a_s * (2 / 3, -1 / 3, -1 / 3)[k - 1])
        row[f"s{k}_seven"] = 0.98 * row[f"s{k}"]
    for name in SHARES:
        row["share_" + name] = a_s / 8
    row["share_shape"] = 0.1 - x
    for name in ("fabric", "branch", "force", "fabric_force"):
        row["axial_deg_" + name] = 1.0
    for axis, share in zip("xyz", (0.3, 0.3, 0.4)):
        row["fraction_" + axis], row["normal_force_" + axis] = share, F0 * 3 * share
    for name in ("short", "intermediate", "long"):
        row["f_" + name] = row[f"f_{name}_model"] = 1 / 3
    for name in PAIRS:
        row["pair_" + name] = row["pair_model_" + name] = 1 / 6
    return row


def write_run(out, stem, seed=1, stage="shear", pressure=50, states=()):
    """A complete run over a strain of 0.4; the first row of its history is of an earlier stage."""
    folder = os.path.join(out, "runs", f"{stem}-s{seed}")
    strains = [0.005 * k for k in range(81)]
    write_table(os.path.join(folder, "history.csv"),
                [history_row("before" if x == 0 else stage, x, pressure, seed) for x in strains])
    write_table(os.path.join(folder, "micro.csv"),
                [micro_row(stage, x, pressure, seed) for x in strains[4::4]])
    os.makedirs(os.path.join(folder, "tables"))
    os.makedirs(os.path.join(folder, "states"))
    with open(os.path.join(folder, "summary.json"), "w", encoding="utf-8") as file:
        json.dump({"mean_stress": 1e6 * pressure, "peak_friction_angle_deg": 40.0 - 0.01 * pressure,
                   "strain_at_peak_friction": 0.001 * pressure, "peak_dilation_rate": 0.8,
                   "strain_at_peak_dilation": 0.002 * pressure}, file)
    for name in ("final", "shear-A"):
        with open(os.path.join(folder, "tables", name + ".json"), "w", encoding="utf-8") as file:
            json.dump({"coordination": {"without_rattlers": 10.1, "histogram": [0, 0, 3, 10, 4]},
                       "f0": F0}, file)
    for point in states:
        with open(os.path.join(folder, "states", f"shear-{point}.state"), "wb"):
            pass
    return folder


def diagonal(axial):
    return [[-axial / 2, 0, 0], [0, -axial / 2, 0], [0, 0, axial]]


def fourth_order():
    return [[[[0.0] * 3 for _ in range(3)] for _ in range(3)] for _ in range(3)]


def averages():
    tensors = {name: {"second": diagonal(axial), "fourth": fourth_order()}
               for name, axial in SECOND.items()}
    rings = [{"beta": math.radians(5 + 10 * k), "value": F0 * math.sin(math.radians(10 + 20 * k)),
              "sectors": 36, "model2": F0 * 0.1, "model4": None} for k in range(18)]
    return {**tensors, "f0": F0, "radial_rings": rings}


def classes():
    rows, n = [], 4
    for k, place in enumerate(directions.all_places(n)):
        d = directions.direction_at(place, 0.5, 0.5, n)
        second = {name: 1 + directions.dot(d, (-a / 2 * d[0], -a / 2 * d[1], a * d[2]))
                  for name, a in SECOND.items()}
        empty = k == 7  # a class without a contact
        rows.append({"class": k, "dx": d[0], "dy": d[1], "dz": d[2],
                     "area": directions.area_of(place, n), "sides": 0 if empty else 20,
                     "E": 0 if empty else second["fabric"] / (4 * math.pi),
                     "fn": "" if empty else F0 * second["normal_force"],
                     "ftx": "" if empty else 0.1 * F0 * d[2], "fty": "" if empty else 0.0,
                     "ftz": "" if empty else -0.1 * F0 * d[0]})
    return rows


def bodies(command, count=40):
    draw = random.Random(5)
    rows = []
    for k in range(count):
        place = {axis: 20 * draw.random() for axis in "xyz"}
        if command == "particles":
            q = [draw.gauss(0, 1) for _ in range(4)]
            size = math.sqrt(sum(v * v for v in q))
            rows.append({"id": k, **place, "r1": 3, "r2": 2, "r3": 2,
                         **{"q" + c: v / size for c, v in zip("wxyz", q)}})
        else:
            n = directions.unit([draw.gauss(0, 1) for _ in range(3)])
            rows.append({"a": k, "b": k + 1, **place, **{"n" + c: v for c, v in zip("xyz", n)},
                         **{"a" + c: 2 * v for c, v in zip("xyz", n)},
                         **{"b" + c: 4 * v for c, v in zip("xyz", n)}, "fn": F0 * draw.random()})
    return rows


def main(words):
    """In place of tangency-dem: micro, contacts and particles of any file."""
    given = dict(zip(words[2::2], words[3::2]))
    if not os.path.exists(words[1]):
        sys.exit(f"tangency-dem: {words[1]}: no such file")
    if words[0] == "micro":
        with open(given["--json"], "w", encoding="utf-8") as file:
            json.dump(averages(), file)
        if "--histogram" in given:
            write_table(given["--histogram"], classes())
    else:
        write_table(given["--out"], bodies(words[0]))


def write_tool(file, study):
    """A program that does what main() does."""
    with open(file, "w", encoding="utf-8") as text:
        text.write(f"#!{sys.executable}\nimport sys\nsys.dont_write_bytecode = True\n"
                   f"sys.path[:0] = [{study!r}, {os.path.dirname(os.path.abspath(__file__))!r}]\n"
                   "import made_up\nmade_up.main(sys.argv[1:])\n")
    os.chmod(file, 0o755)
