#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""LAMMPS (Debian's lammps), run as a program: nothing of it is linked, its licence is GPL 2 alone.

Its pair_style gayberne calls h = r - sigma12 the distance of closest approach of two ellipsoids,
sigma12 = (u' G^-1 u / 2)^-1/2, u the direction of the line of centres and G the sum of both shape
matrices: an approximation in closed form [EveraersEjtehadi2003], exact for equal bodies with parallel
axes. It says how far b moves along the line of centres until both touch: `centre-line`, which has no
normal.

LAMMPS prints energies, not h. With gamma = 3, upsilon = 0, mu = 1, wells of 1 and epsilon = sigma = 1
the energy is 4 (q^2 - q), q = (h + 3)^-6, which grows with h and is solved for it here. One well is
the double above 1: LAMMPS takes spheres with three equal wells for points. A pair is handed over in
units of L, the distance of the centres and both largest semi-axes, a at the origin: LAMMPS needs a
box.

Where LAMMPS stops with an error, or prints no number, the pair has no answer.
"""
import math
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
from adapter import Code, Contact, main  # noqa: E402

GAMMA = 3
WELL = math.nextafter(1, 2)
PAIR = """clear
units lj
atom_style ellipsoid
boundary f f f
read_data pair{row}.data
pair_style gayberne {gamma} 0 1 4
pair_coeff * * 1 1 1 1 {well} 1 1 {well}
thermo_modify norm no
run 0 post no
variable energy equal pe
print "{row} $(v_energy:%.17g)" append answers screen no
"""
DATA = """pair

2 atoms
2 atom types
2 ellipsoids
-2 2 xlo xhi
-2 2 ylo yhi
-2 2 zlo zhi

Atoms # ellipsoid

1 1 1 1 0 0 0
2 2 1 1 {x:.17g} {y:.17g} {z:.17g}

Ellipsoids

"""


def size(a, b):
    return math.dist(a.centre, b.centre) + max(a.semi_axes) + max(b.semi_axes)


def data_file(a, b):
    unit = size(a, b)
    x, y, z = ((q - p) / unit for p, q in zip(a.centre, b.centre))
    text = DATA.format(x=x, y=y, z=z)
    for atom, body in enumerate((a, b), 1):
        length = math.hypot(*body.quaternion)
        numbers = [2 * r / unit for r in body.semi_axes] + [q / length for q in body.quaternion]
        text += f"{atom} " + " ".join(f"{n:.17g}" for n in numbers) + "\n"
    return text


def energies(program, pairs, folder):
    """LAMMPS' own, by row. It is started again behind a row at which it stops."""
    for row, pair in enumerate(pairs):
        (folder / f"pair{row}.data").write_text(data_file(*pair))
    found, begin = {}, 0
    while begin < len(pairs):
        (folder / "answers").write_text("")
        (folder / "in").write_text("".join(PAIR.format(row=row, gamma=GAMMA, well=WELL)
                                           for row in range(begin, len(pairs))))
        subprocess.run([program, "-in", "in", "-log", "none", "-screen", "none"], cwd=folder,
                       stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, check=False)
        lines = (folder / "answers").read_text().splitlines()
        for line in lines:
            row, energy = line.split()
            found[int(row)] = float(energy)
        begin += len(lines) + 1
    return found


def contact(energy, unit):
    if energy is None or not -1 < energy < 0:
        return None
    gap = ((-energy / (2 * (1 + math.sqrt(1 + energy)))) ** (-1 / 6) - GAMMA) * unit
    return Contact(gap < 0, gap)


def answers_of(program):
    def answers(pairs):
        with tempfile.TemporaryDirectory() as folder:
            found = energies(program, pairs, Path(folder))
        for row, (a, b) in enumerate(pairs):
            yield contact(found.get(row), size(a, b))
    return answers


def codes():
    program = shutil.which("lmp")
    if program is None:
        return []
    head = subprocess.run([program, "-h"], text=True, capture_output=True, check=False).stdout
    version = re.search(r"Simulator - (.*)", head)
    return [Code("lammps-gayberne", "LAMMPS", version[1] if version else "-",
                 "pair_style gayberne", "gamma 3, upsilon 0, mu 1", "centre-line",
                 answers_of(program))]


if __name__ == "__main__":
    sys.exit(main(codes()))
