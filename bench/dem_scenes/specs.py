# SPDX-License-Identifier: GPL-3.0-or-later
"""What a scene of the benchmarks is, and its text.

A scene is made from a sample, a small assembly that tangency-dem brings to rest by the published way
(placed, compacted, grown without friction, relaxed: dem/scenes/growth-1000.toml), which then stands
side by side as often as wanted. Its last stage is the one that is timed, and never ends.
"""

import dataclasses
import hashlib
import math

# Of the published study (Table 5.2): radius in m, stiffness in N/m, density in kg/m3.
RADIUS = 10.0
STIFFNESS = 1.5e10
DENSITY = 1000.0

# Chosen: with it a Hertz contact of equal spheres bears at an overlap of a tenth of the radius,
# that of the dense sample, what the linear one bears: 4/3 E/(2 (1 - nu^2)) sqrt(r/2) d^1.5 = K d.
YOUNG_MODULUS = 9.2e9

# Chosen: a stage that is timed does not end by itself.
WITHOUT_END = 10**12

# Cycles in which a sample settles in its scene. Chosen: under the linear law, by which it was made, it
# is near its stress from the start (0.1 %); a Hertz law has other forces.
SETTLING = {"linear": 20, "hertz": 1000}

# Chosen, as in the published scenes.
MOTION = {"max_strain_rate": 0.02, "time_step_factor": 0.3, "damping": 0.1}

# The time step of bodies from this aspect ratio on. A long body has more contacts, at longer arms: at
# 16 contacts a particle 0.3 is above the critical step, and samples vibrate instead of coming to rest.
# Chosen: half.
LONG_ASPECT = 5.0
LONG_TIME_STEP_FACTOR = 0.15

# Axial strain, logarithmic, that a sheared state has behind it.
SHEARED_BY = 0.4

# Porosity, in which overlaps count twice, that room is reckoned with. Chosen: under the pressure of
# Spec it is 0.11 of spheroids 5 and 0.14 of spheroids 3. Of spheroids 10 it is -0.09, so that 1400 of
# them might touch two images of another one; by seed 1 none does.
ROOM_POROSITY = 0.1


@dataclasses.dataclass(frozen=True)
class Spec:
    """A scene. `particles` are those of the sample; the scene has copies^3 times as many."""

    particles: int = 1000
    elongation: float = 1.0  # a / b
    flatness: float = 1.0  # b / c
    large: int = 0  # so many more particles, of size_ratio times the radius
    size_ratio: float = 1.0
    law: str = "linear"
    friction: float = 0.5
    walls: str = "none"
    state: str = "dense"
    pressure: float = 100e6  # Pa, mean stress
    copies: int = 1
    shuffle: int = 0  # seed of the order of the particles; 0 keeps it
    drift: bool = False  # all move alike and so fast that each cycle has a new neighbour list
    seed: int = 1

    def sample(self):
        """What of it the sample depends on: the rest is put back to its default."""
        pressure = 0.0 if self.state in ("loose", "lattice") else self.pressure
        return dataclasses.replace(
            self, law="linear", friction=0.5, copies=1, shuffle=0, drift=False, pressure=pressure,
            state="dense" if self.state == "sheared" else self.state)

    def aspect(self):
        """Longest over shortest semi-axis."""
        return self.elongation * self.flatness

    def motion(self):
        """Keys of its stages' motion."""
        return dict(MOTION, time_step_factor=LONG_TIME_STEP_FACTOR) if self.aspect() >= LONG_ASPECT else MOTION

    def has_room(self):
        """Whether the cell, at ROOM_POROSITY, is as wide as two of the longest particles are together,
        also at the end of a shear: none can then touch two images of another one."""
        if self.state in ("loose", "lattice") or self.walls != "none":
            return True
        # Of radius 1 each: semi-axes a = b e, b, c = b / f of volume 1.
        longest = (self.elongation**2 * self.flatness) ** (1 / 3)
        two = sorted([self.size_ratio] * min(self.large, 2) + [1.0, 1.0])[-2:]
        volume = 4.0 / 3.0 * math.pi * (self.particles + self.large * self.size_ratio**3)
        edge = (volume / (1.0 - ROOM_POROSITY)) ** (1 / 3)
        shortened = math.exp(-SHEARED_BY) if self.state == "sheared" else 1.0
        return edge * shortened >= 2.0 * longest * sum(two)

    def fault(self):
        """Why there is no such scene, one line; empty where there is one."""
        if self.state == "lattice" and (self.elongation, self.flatness, self.large) != (1, 1, 0):
            return "a lattice is one of equal spheres"
        if self.walls != "none" and (self.copies > 1 or self.state == "lattice"):
            return "between walls a sample stands alone"
        if self.drift and (self.state != "loose" or self.walls != "none"):
            return "only a loose state without walls drifts"
        if self.state == "sheared" and self.walls != "none":
            return "a sheared state has no walls"
        return ""


STATES = ("dense", "sheared", "loose", "lattice")

# The face-centred lattice of overlapping spheres, four in a cube: overlap over radius. Chosen: stiff
# enough to bear stress, and no second neighbours, which are 1.41 times as far.
LATTICE_OVERLAP = 0.02


def lattice_edge():
    """Edge in m of the cube of the lattice that holds four spheres."""
    return math.sqrt(2.0) * RADIUS * (2.0 - LATTICE_OVERLAP)


def digest(text):
    """Eight digits that tell one text from another."""
    return hashlib.sha256(text.encode()).hexdigest()[:8]


def table_text(values):
    """Keys of a TOML table, a line each."""
    def one(value):
        return f'"{value}"' if isinstance(value, str) else repr(value)
    return "".join(f"{key} = {one(value)}\n" for key, value in values.items())


def stage_text(**values):
    return "\n[[stage]]\n" + table_text(values)


def types_of(spec, copies=1):
    """The particle types: name, number and mean radius."""
    types = [("small", spec.particles * copies, RADIUS)]
    if spec.large:
        types.insert(0, ("large", spec.large * copies, RADIUS * spec.size_ratio))
    return types


def head(spec, cell_size, shape, copies=1):
    text = "# SPDX-License-Identifier: MIT\nschema = 1\n\n[cell]\n" + table_text({"walls": spec.walls})
    if cell_size:
        text += f"size = [{', '.join(map(repr, cell_size))}]\n"
    for name, count, radius in types_of(spec, copies):
        text += f"\n[particles.{name}]\n" + table_text(
            {"count": count, "mean_radius": radius, "elongation": shape[0], "flatness": shape[1],
             "density": DENSITY})
    text += "\n[contact]\n"
    if spec.law == "hertz":
        # The time step of the largest overlap that the key may have: the sample is soft.
        text += table_text({"law": "hertz", "young_modulus": YOUNG_MODULUS, "largest_overlap": 0.2})
    else:
        text += table_text({"normal_stiffness": STIFFNESS})
    return text + table_text({"friction_coefficient": spec.friction})


def increments_of(spec):
    """Of the growth, in which a / b and b / c grow by equal steps: at most 0.008 of a semi-axis each,
    where 0.01 is allowed. The first step is the largest, of a or of c."""
    a_b, b_c = spec.elongation - 1.0, spec.flatness - 1.0
    return max(100, math.ceil(max(2 * a_b + b_c, a_b + 2 * b_c) / 3 / 0.008))


def sample_text(spec):
    """The scene that tangency-dem makes the sample by; its last frame is the sample."""
    grown = (spec.elongation, spec.flatness) != (1.0, 1.0)
    loose = spec.state == "loose"
    # Growth waits little for balance, since the last stage does: a study would wait more.
    text = head(spec, None, (spec.elongation, spec.flatness) if loose else (1.0, 1.0))
    text += stage_text(kind="place", arrangement="random", bounding_fraction=0.3, seed=spec.seed)
    slow = dict(spec.motion(), max_strain_rate=0.05, mean_stress=spec.pressure)
    if loose:
        text += stage_text(kind="servo", duration=1)
    else:
        text += stage_text(kind="relax", name="compact", friction_coefficient=0.0,
                           stress_tolerance=0.01, max_unbalanced_ratio=0.05, **slow)
        if grown:
            text += stage_text(kind="grow", elongation=spec.elongation, flatness=spec.flatness,
                               increments=increments_of(spec), stress_tolerance=0.05,
                               max_inertial_fraction=0.1, **slow)
        text += stage_text(kind="relax", name="dense", friction_coefficient=0.0,
                           max_unbalanced_ratio=0.02, **slow)
    # Frames of the stages' ends alone, whatever their number of cycles.
    return text + "\n[output]\n" + table_text({"history_interval": 500, "frame_interval": WITHOUT_END})


def scene_text(spec, cell_size, copies, table):
    """The scene itself, whose bodies are in the file `table`."""
    text = head(spec, cell_size, (spec.elongation, spec.flatness), copies)
    text += stage_text(kind="place", arrangement="explicit", file=table)
    motion = spec.motion()
    held = {"kind": "servo", "max_cycles": WITHOUT_END}
    if spec.state == "loose":  # at rest, or drifting for ever
        held.update(motion, damping=0.0 if spec.drift else motion["damping"])
    elif spec.state == "lattice":
        held.update(motion)
    else:
        held.update(motion, mean_stress=spec.pressure)
    if spec.state == "sheared":
        shear = dict(motion, kind="shear", mean_stress=spec.pressure, axial_strain_rate=0.005,
                     max_cycles=WITHOUT_END)
        text += stage_text(name="shear", axial_strain=SHEARED_BY, **shear)
        text += stage_text(name="timed", axial_strain=3, **shear)
    else:
        text += stage_text(name="settle", duration=SETTLING[spec.law], **held) if not spec.drift else ""
        text += stage_text(name="timed", duration=WITHOUT_END, **held)
    return text + "\n[output]\n" + table_text({"history_interval": 1000, "frame_interval": 0})
