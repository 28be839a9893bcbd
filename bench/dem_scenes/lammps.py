# SPDX-License-Identifier: GPL-3.0-or-later
"""Debian's LAMMPS beside ours: pair_style gran/hooke/history on the spheres of one of our scenes.

The same linear law and friction, the same box, time step and order of the particles; its neighbour
skin such that it lists as many pairs a particle as ours does. Newton's third law is on, so that a
pair is listed once, and only velocities are integrated beside the pairs (fix nve/sphere): no
damping, no servo, which ours has. Its friction is not quite ours (lever arm and turning of the shear
force), so that answers are compared before the first step: stress and number of contacts.
"""

import os
import re
import shutil
import tempfile
import tomllib

import bodies
import sessions

MISSING = "there is no lmp: apt-get install lammps (Debian 12), or .ci/setup long"

# Of the mean stress before the first step. Both sum some thousand forces in other orders; the jitter
# of a lattice and the overlaps lose three digits more. Chosen on that ground.
SAME_STRESS = 1e-9

# By how much LAMMPS' own stress and contacts may change from there: it is undamped. Chosen.
STILL_STANDS = 0.1


def is_there():
    """stdbuf is Debian's coreutils."""
    return bool(shutil.which("lmp") and shutil.which("stdbuf"))


class Lammps(sessions.Program):
    """`lmp` on the scene of a session of ours, with as many pairs a particle as `listed`."""

    threads = 1

    def __init__(self, ours, listed=None):
        if not is_there():
            raise sessions.Failure(MISSING)
        self.scene = ours.scene
        with open(ours.scene, "rb") as file:
            scene = tomllib.load(file)
        self.data = tempfile.NamedTemporaryFile("w", suffix=".data")
        write_data(self.data, scene, os.path.dirname(ours.scene))
        # By lines, also into a pipe: else its answers would wait in its buffer.
        super().__init__(f"lammps {name_of(ours.scene)}",
                         ["stdbuf", "-oL", "lmp", "-log", "none", "-nocite"], {"OMP_NUM_THREADS": "1"})
        contact = scene["contact"]
        stiffness = contact["normal_stiffness"]
        self.commands(
            "units si", "atom_style sphere", "newton on", "comm_modify vel yes",
            f"read_data {self.data.name}",
            f"pair_style gran/hooke/history {stiffness!r} {contact.get('shear_stiffness', stiffness)!r}"
            f" 0.0 0.0 {contact['friction_coefficient']!r} 0",
            "pair_coeff * *", "fix move all nve/sphere", f"timestep {ours.ready['time_step']!r}",
            "neigh_modify delay 0 every 1 check yes",
            # Of the pairs that touch: their number is the sum over the mean.
            "compute touching all pair/local dist cutoff radius",
            "compute sum all reduce sum c_touching", "compute mean all reduce ave c_touching",
            "compute stress all pressure NULL virial",
            "thermo_style custom step c_stress c_sum c_mean", "thermo_modify format float %.15g norm no",
            "thermo 1000000000")
        self.start = self.placed(ours, listed if listed else ours.ready["start"]["listed"] / ours.ready["start"]["particles"])

    def placed(self, ours, listed):
        """Finds the skin by halving, and compares answers before the first step."""
        low, high = 0.0, 2.0 * ours.ready["largest_radius"]
        seen = None
        for trial in range(30):
            self.skin = 0.5 * (low + high)
            # A compute keeps its neighbour list from one run to the next of the same step.
            self.commands(f"neighbor {self.skin!r} bin", f"reset_timestep {trial}")
            seen = self.run(0).end
            a_particle = seen["listed"] / seen["particles"]
            if abs(a_particle - listed) < 1e-3 * listed:
                break
            low, high = (self.skin, high) if a_particle < listed else (low, self.skin)
        else:
            raise sessions.Failure(f"{self.label}: no skin lists {listed:.4f} pairs a particle; one of "
                                   f"{self.skin:.4g} m lists {a_particle:.4f}")
        ready = ours.ready["placed"]
        if seen["touching"] != ready["touching"]:
            raise sessions.Failure(
                f"{self.label}: {seen['touching']} contacts, and ours has {ready['touching']}")
        if abs(seen["mean_stress"] - ready["mean_stress"]) > SAME_STRESS * ready["mean_stress"]:
            raise sessions.Failure(f"{self.label}: a mean stress of {seen['mean_stress']!r}, and ours "
                                   f"has {ready['mean_stress']!r}")
        return seen

    def commands(self, *lines):
        """Does them; what was printed meanwhile."""
        for line in lines:
            self.tell(line)
        self.tell('print "-- done"')
        said = []
        while (line := self.next_line()) != "-- done":
            said.append(line)
            if line.startswith("ERROR"):
                raise sessions.Failure(f"{self.label}: {line}")
        return "\n".join(said)

    def run(self, cycles):
        said = self.commands(f"run {cycles}")
        rows = re.search(r"\nStep .*\n((?:\s*\d.*\n)+)Loop time of (\S+) on .* with (\d+) atoms", said)
        neighbours = re.search(r"Total # of neighbors = (\d+)", said)
        share = re.search(r"([\d.]+)% CPU use", said)
        if not rows or not neighbours:
            raise sessions.Failure(f"{self.label}: run {cycles} printed no times: {said[-200:]}")
        _, stress, summed, mean = rows[1].strip().splitlines()[-1].split()
        wall = float(rows[2])
        end = {"particles": int(rows[3]), "listed": int(neighbours[1]),
               "touching": round(float(summed) / float(mean)), "mean_stress": float(stress)}
        cpu = wall * (float(share[1]) / 100.0 if share else 1.0)
        return sessions.Block(cycles, cpu, wall, float(cycles * end["listed"]), end)

    def block(self, cycles):
        block = self.run(cycles)
        for key in ("mean_stress", "touching"):
            if not abs(block.end[key] - self.start[key]) <= STILL_STANDS * self.start[key]:
                raise sessions.Failure(f"{self.label}: {key} went from {self.start[key]:.6g} to "
                                       f"{block.end[key]:.6g}")
        return block

    def close(self):
        super().close()
        self.data.close()


def name_of(scene):
    return os.path.basename(scene).removesuffix(".toml")


def write_data(out, scene, folder):
    """LAMMPS' data file of a scene of make_scene with one type of sphere between no walls."""
    types = list(scene["particles"].values())
    if len(types) != 1 or (types[0]["elongation"], types[0]["flatness"]) != (1.0, 1.0):
        raise sessions.Failure("LAMMPS' granular style has spheres; its scene has to have one type of them")
    if scene["cell"].get("walls", "none") != "none" or scene["contact"].get("law", "linear") != "linear":
        raise sessions.Failure("LAMMPS' scene has to have a linear law and no walls")
    sphere = types[0]
    places = bodies.read_table(os.path.join(folder, scene["stage"][0]["file"]))
    out.write(f"spheres\n\n{len(places)} atoms\n1 atom types\n\n")
    for axis, edge in zip("xyz", scene["cell"]["size"]):
        out.write(f"0 {edge!r} {axis}lo {axis}hi\n")
    out.write("\nAtoms # sphere\n\n")
    for k, x in enumerate(places):
        out.write(f"{k + 1} 1 {2.0 * sphere['mean_radius']!r} {sphere['density']!r} "
                  f"{x[0]!r} {x[1]!r} {x[2]!r}\n")
    out.flush()
