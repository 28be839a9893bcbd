# SPDX-License-Identifier: MIT
"""Bodies and stages of the study's scenes: published parameters, and those that are not published.

Published (Table 5.2): radius, stiffnesses, friction, pressures, elongations. Density is not
published; it scales time alone. Steps, rates and damping are ours: any will do while the inertial
fraction stays low (tests/dem/shear_study.cpp).
"""
import math

RADIUS = 10.0  # m, published
DENSITY = 1000.0  # kg/m^3, chosen
STIFFNESS = 1.5e10  # N/m, published; K_s = K_n
FRICTION = 0.5  # published
DENSE = 100e6  # Pa, published: growth and its end

# Of a step, in sqrt(m/K): chosen, the largest that is right.
STEP = 0.3
# Of free particles, in sqrt(K/m): chosen by trial.
DAMPING = 0.1
# Per second: of the axial compression, of a servo in a shear, and of one in growth. Measured: peak
# friction angles at half the rate are 0.01 degrees away (docs/simulator.md).
AXIAL_RATE, SERVO_RATE, GROWTH_RATE = 0.005, 0.02, 0.05
# The same step is shorter in the plane, where a disk of unit thickness is lighter: rates in
# proportion are as slow.
PLANE_RATES = math.sqrt(4.0 / 3.0 * RADIUS)

# What `tangency-dem check` advises against: the published stiffness is low for DENSE, and the rates
# above reach an inertial number of 1.15e-3 at 30e6, which is as slow as it has to be.
INTENDED = ("overlap", "inertial_number")

# How samples are released from DENSE is not published. What it is here: friction, measured to leave
# the published contacts at 10e6 (docs/simulator.md), and the largest ratio of unbalanced to contact
# force at which a pressure is taken to be reached.
RELEASE_FRICTION = 0.02
RELEASE_BALANCE = 0.02


def elongation_of(eccentricity):
    """a / b of e = (a - b) / (a + b)."""
    return (1.0 + eccentricity) / (1.0 - eccentricity)


def eccentricity_of(ratio):
    """e of a / b."""
    return (ratio - 1.0) / (ratio + 1.0)


# Published shapes: b / a = 0.7 and 0.8.
E_LONG, E_SHORT = eccentricity_of(1 / 0.7), eccentricity_of(1 / 0.8)


def body(count, *, elongation=1.0, flatness=1.0, plane=False, contacts=None, kind="spheroid"):
    particles = {"count": count, "mean_radius": RADIUS, "density": DENSITY}
    if elongation != 1.0:
        particles["elongation"] = elongation
    if flatness != 1.0:
        particles["flatness"] = flatness
    return {
        "cell": {"dimensions": 2} if plane else {},
        "motion": {"contacts": contacts} if contacts else {},
        "particles": {kind: particles},
        "contact": {"normal_stiffness": STIFFNESS, "friction_coefficient": FRICTION},
        "intended": INTENDED,
    }


class Stages:
    """Stages of bodies in space, or with `plane` in the plane: the rates are in proportion."""

    def __init__(self, plane=False):
        self.pace = PLANE_RATES if plane else 1.0
        self.plane = plane

    def moving(self, rate):
        return {"max_strain_rate": rate * self.pace, "time_step_factor": STEP, "damping": DAMPING}

    def random(self, seed):
        return {"kind": "place", "arrangement": "random",
                "bounding_fraction": 0.4 if self.plane else 0.3, "seed": seed}

    def lattice(self, seed, **keys):
        return {"kind": "place", "arrangement": "lattice", "jitter": 0.0, "seed": seed, **keys}

    def compact(self, pressure, friction=0.0, name="compact"):
        """To a pressure, in balance but for what growth needs not wait for."""
        return {"kind": "relax", "name": name, "friction_coefficient": friction,
                "mean_stress": pressure, **self.moving(GROWTH_RATE), "stress_tolerance": 0.01,
                "max_unbalanced_ratio": 0.05}

    def grow(self, name, pressure, eccentricity, increments=None, **keys):
        """In increments, each of which waits; cycles_per_percent waits less often."""
        if increments:
            keys["increments"] = increments
        return {"kind": "grow", "name": name, "eccentricity": eccentricity,
                "mean_stress": pressure, **self.moving(GROWTH_RATE), "stress_tolerance": 0.02,
                **keys}

    def relax(self, name, pressure, **keys):
        return {"kind": "relax", "name": name, "friction_coefficient": 0.0,
                "mean_stress": pressure, **self.moving(GROWTH_RATE), **keys}

    def unload(self, name, pressure, **keys):
        return {"kind": "unload", "name": name, "friction_coefficient": RELEASE_FRICTION,
                "mean_stress": pressure, **self.moving(SERVO_RATE),
                "max_unbalanced_ratio": RELEASE_BALANCE, **keys}

    def hold(self, name, pressure, cycles):
        return {"kind": "servo", "name": name, "friction_coefficient": RELEASE_FRICTION,
                "mean_stress": pressure, "duration": cycles, **self.moving(SERVO_RATE)}

    def shear(self, pressure, strain, **keys):
        return {"kind": "shear", "mean_stress": pressure,
                "axial_strain_rate": AXIAL_RATE * self.pace, "axial_strain": strain,
                **self.moving(SERVO_RATE), **keys}
