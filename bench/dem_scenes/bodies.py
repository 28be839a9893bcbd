# SPDX-License-Identifier: GPL-3.0-or-later
"""Bodies of a scene: from the last frame of a sample or from a lattice, side by side, as a table.

A body is (type, position, rest): rest is the text of its orientation and velocity in the table.
Lengths are in m, cells are boxes with a corner at the origin.
"""

import itertools
import math
import random
import re

import specs

# Of a body that drifts, in radii of the largest one a cycle. Chosen: several times any skin of a
# neighbour list, so that it is renewed in each cycle.
DRIFT = 3.0

# Of a lattice's sites, in radii. Chosen: forces then differ, and no touching pair parts.
JITTER = 1e-3

HEADER = "type,x,y,z,qw,qx,qy,qz,vx,vy,vz\n"


def last_frame(file):
    """Cell size and bodies at rest of the last frame in an extended XYZ file of tangency-dem."""
    with open(file, encoding="utf-8") as text:
        lines = text.read().split("\n")
    at = 0
    while at < len(lines) and lines[at]:
        first, count = at, int(lines[at])
        at += count + 2
    lattice = re.search(r'Lattice="([^"]*)"', lines[first + 1])[1].split()
    if any(float(lattice[k]) != 0.0 for k in (1, 2, 3, 5, 6, 7)):
        raise ValueError(f"{file}: the cell of the last frame is no box")
    bodies = []
    for line in lines[first + 2 : at]:
        name, x, y, z, qx, qy, qz, qw = line.split()[:8]
        bodies.append((name, (float(x), float(y), float(z)), f",{qw},{qx},{qy},{qz},0,0,0"))
    return [float(lattice[k]) for k in (0, 4, 8)], bodies


def lattice_cell():
    """One cube of the face-centred cubic lattice of specs.lattice_edge()."""
    edge = specs.lattice_edge()
    sites = ((0, 0, 0), (0, 0.5, 0.5), (0.5, 0, 0.5), (0.5, 0.5, 0))
    bodies = [("small", tuple(edge * (s + 0.25) for s in site), ",1,0,0,0,0,0,0") for site in sites]
    return [edge] * 3, bodies


def side_by_side(size, bodies, copies):
    """copies^3 of them, one behind the other."""
    for at in itertools.product(range(copies), repeat=3):
        shift = [at[k] * size[k] for k in range(3)]
        for name, x, rest in bodies:
            yield name, (x[0] + shift[0], x[1] + shift[1], x[2] + shift[2]), rest


def jittered(bodies, seed):
    draw = random.Random(seed).uniform
    most = JITTER * specs.RADIUS
    for name, x, rest in bodies:
        yield name, tuple(c + draw(-most, most) for c in x), rest


def drifting(spec, bodies):
    """With one velocity for all."""
    mass = specs.DENSITY * 4.0 / 3.0 * math.pi * specs.RADIUS**3
    step = spec.motion()["time_step_factor"] * math.sqrt(mass / specs.STIFFNESS)
    speed = DRIFT * specs.RADIUS * spec.size_ratio * spec.elongation / step
    velocity = f"{speed!r},{0.7 * speed!r},{0.4 * speed!r}"
    for name, x, rest in bodies:
        yield name, x, rest.removesuffix("0,0,0") + velocity


def write_table(file, spec, bodies):
    """In an order drawn by spec.shuffle, or in their own. Returns their number."""
    lines = [f"{name},{x[0]!r},{x[1]!r},{x[2]!r}{rest}\n" for name, x, rest in bodies]
    if spec.shuffle:
        random.Random(spec.shuffle).shuffle(lines)
    with open(file, "w", encoding="utf-8") as table:
        table.write(HEADER)
        table.writelines(lines)
    return len(lines)


def read_table(file):
    """Positions in m of the bodies of a table, in its order."""
    with open(file, encoding="utf-8") as table:
        if table.readline() != HEADER:
            raise ValueError(f"{file}: not a table of make_scene")
        return [tuple(map(float, line.split(",")[1:4])) for line in table]
