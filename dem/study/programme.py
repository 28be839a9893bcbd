# SPDX-License-Identifier: MIT
"""Which runs the study has, as data: bodies, stages, and what resumes what.

A run is one scene: its own stages after those of the run whose final.state it resumes. Names are
FAMILY-WHAT-sSEED: `spheroid-p050-s1` is the sample of the family `spheroid` at 50e6, and
`spheroid-p050-shear-s1` its shear test.
"""
import dataclasses

import stages
from stages import DENSE, E_LONG, E_SHORT, Stages, body

# Of Table 5.2, Pa: what the dense sample is released to, one after the other.
PRESSURES = (70e6, 50e6, 30e6, 10e6)
# What --only takes; those after the first line have their own time and run only when asked for.
PARTS = ("table", "growth", "horizontal", "spheres", "plane", "lode", "loose", "hertz", "shapes",
         "limits")
APART = ("trace", "published", "large")


# Of intervals, cycles: a row at each stage's end alone.
STAGE_ENDS = 10**9


@dataclasses.dataclass(frozen=True)
class Scale:
    """How large the study is. Strains of its rows are in proportion to `strain`."""
    particles: int = 1000
    seeds: tuple = (1, 2, 3)
    strain: float = 0.4  # axial, logarithmic, at which a shear test ends
    increments: int = 100  # of the growth to e = 0.176
    large: int = 8000
    small: tuple = (27, 125)  # of tests 1 and 3
    history: int = 10  # cycles between rows of a shear
    micro: int = 200  # and between rows of micro.csv
    more_small: int = 3  # seeds of tests 1 and 3 for one of the others


# Fewer than 64 are too few for a cell that is sheared in the plane or of triaxial bodies.
REDUCED = Scale(particles=64, seeds=(1,), strain=0.1, increments=40, large=125, small=(27, 64),
                micro=100, more_small=1)


def with_seeds(scale, count):
    return dataclasses.replace(scale, seeds=tuple(range(1, count + 1)))


@dataclasses.dataclass(frozen=True)
class Run:
    name: str
    part: str
    seed: int
    body: dict
    stages: tuple
    after: str | None = None  # the run whose final.state is resumed
    output: dict = dataclasses.field(default_factory=dict)
    # States of which averages are taken: names below the run's directory, with @polar at the end
    # by the polar partition.
    tables: tuple = ()
    cost: float = 1.0  # seconds of one core, roughly: for the order and the time left


def p_name(pressure):
    return f"p{round(pressure / 1e6):03d}"


class Programme:
    """All runs of a scale, by name; ancestors stand before what resumes them."""

    def __init__(self, scale):
        self.scale = scale
        self.runs = {}
        for seed in scale.seeds:
            self._spheroids(seed)
            self._growth(seed)
            self._horizontal(seed)
            self._spheres(seed)
            self._plane(seed)
            self._lode(seed)
            self._loose(seed)
            self._hertz(seed)
            self._shapes(seed)
            self._limits(seed)
            self._apart(seed)
        for seed in self.small_seeds():
            self._small(seed)

    def small_seeds(self):
        """Tests of few particles scatter more and cost less."""
        return tuple(range(self.scale.seeds[0],
                           self.scale.seeds[0] + self.scale.more_small * len(self.scale.seeds)))

    def ancestors(self, name):
        """The run and what it resumes, oldest first."""
        chain = []
        while name:
            chain.append(self.runs[name])
            name = chain[-1].after
        return chain[::-1]

    def stages_of(self, name):
        return [stage for run in self.ancestors(name) for stage in run.stages]

    def of_parts(self, parts):
        """The runs of these parts and their ancestors, in the programme's order."""
        wanted = {run.name for name, one in self.runs.items() if one.part in parts
                  for run in self.ancestors(name)}
        return [run for name, run in self.runs.items() if name in wanted]

    # What runs are made of.

    def _add(self, family, what, seed, part, body_, *own, after=None, history=50, micro=STAGE_ENDS,
             tables=(), cost=1.0):
        name = f"{family}-{what}-s{seed}"
        output = {"history_interval": history, "frame_interval": STAGE_ENDS,
                  "micro_interval": micro}
        count = sum(keys["count"] for keys in body_["particles"].values())
        self.runs[name] = Run(name, part, seed, body_, own, after, output, tuple(tables),
                              cost * count / 1000)
        return name

    def _shear(self, family, what, seed, part, body_, pressure, after, *, of=Stages(), strain=None,
               points=False, **keys):
        """A test with its averages, and with its states A, B, C, D, which cost as much again."""
        tables = ["final.state"]
        if points:
            keys["save_points"] = True
            tables += [f"states/shear-{point}.state" for point in "ABCD"]
            tables += ["states/shear-C.state@polar", "final.state@polar"]
        stage = of.shear(pressure, strain or self.scale.strain, **keys)
        return self._add(family, f"{what}shear", seed, part, body_, stage, after=after,
                         history=self.scale.history, micro=self.scale.micro, tables=tables,
                         cost=12 if points else 6)

    def _release(self, family, seed, part, body_, after, pressures=PRESSURES, *, of=Stages(),
                 cost=1.0, **keys):
        """Releases to one pressure after the other: {pressure: run}."""
        reached = {}
        for pressure in pressures:
            name = p_name(pressure)
            after = reached[pressure] = self._add(
                family, name, seed, part, body_, of.unload(name, pressure, **keys), after=after,
                tables=["final.state"], cost=cost)
        return reached

    # The families.

    def _spheroids(self, seed):
        """Tests 4a-4e: grown at DENSE from random places, released, sheared."""
        of, scale, b = Stages(), self.scale, body(self.scale.particles)
        start = [of.random(seed), of.compact(DENSE)]
        steps = [of.grow(f"grow{round(100 * e):02d}", DENSE, e,
                         max(4, round(share * scale.increments)))
                 for e, share in ((0.01, 0.06), (0.05, 0.22), (E_SHORT, 0.32))]
        short = self._add("spheroid", "growth", seed, "table", b, *start, *steps, history=20,
                          micro=scale.micro // 2, tables=["final.state"], cost=4)
        long = self._add("spheroid", "growth2", seed, "table", b,
                         *[of.grow(f"grow{round(100 * e):02d}", DENSE, e,
                                   max(4, round(share * scale.increments)))
                           for e, share in ((0.15, 0.22), (E_LONG, 0.18))],
                         after=short, history=20, micro=scale.micro // 2, cost=2)
        dense_short = self._add("spheroid", "e11", seed, "table", b, of.relax("e11", DENSE),
                                after=short, tables=["final.state"])
        dense = self._add("spheroid", "p100", seed, "table", b, of.relax("p100", DENSE), after=long,
                          tables=["final.state"])
        self._shear("spheroid", "e11-", seed, "table", b, DENSE, dense_short)
        reached = {DENSE: dense, **self._release("spheroid", seed, "table", b, dense)}
        for pressure, run in reached.items():
            self._shear("spheroid", f"{p_name(pressure)}-", seed, "table", b, pressure, run,
                        points=pressure == 30e6)  # test 4d, whose states are published

    def _small(self, seed):
        """Tests 1 and 3, grown at their own pressures."""
        of, scale = Stages(), self.scale
        for family, count, pressure in (("test1", scale.small[0], 7e6),
                                        ("test3", scale.small[1], 47e6)):
            b = body(count)
            grown = self._add(family, "sample", seed, "table", b, of.random(seed),
                              of.compact(pressure),
                              of.grow("grow", pressure, E_LONG, scale.increments),
                              of.relax("dense", pressure), history=20, tables=["final.state"],
                              cost=6)
            # Beyond, a body of 27 touches another one twice: measured, of nine samples the first
            # at 0.19, and such a run ends.
            self._shear(family, "", seed, "table", b, pressure, grown,
                        strain=min(0.17, scale.strain) if family == "test1" else None)

    def _growth(self, seed):
        """Growth to e = 0.22, as fast as the tests' and slowly."""
        of, scale, b = Stages(), self.scale, body(self.scale.particles)
        self._add("spheroid", "growth3", seed, "growth", b,
                  *[of.grow(f"grow{round(100 * e)}", DENSE, e,
                            max(4, round(0.23 * scale.increments)))
                    for e in (0.2, 0.22)],
                  after=f"spheroid-growth2-s{seed}", history=20, micro=scale.micro // 2, cost=3)
        self._add("slow", "growth", seed, "growth", b, of.random(seed), of.compact(DENSE),
                  of.grow("grow22", DENSE, 0.22, round(2 * scale.increments),
                          max_inertial_fraction=0.002), history=20, cost=15)

    def _horizontal(self, seed):
        """The published start: a lattice whose axes will grow across the load; p follows e."""
        of, scale, b = Stages(), self.scale, body(self.scale.particles)
        lattice = self._add("horizontal", "lattice", seed, "horizontal", b,
                            of.lattice(seed, axes="plane"), of.compact(10e6), history=20,
                            tables=["final.state"], cost=0.5)
        middle = 0.5 * (10e6 + DENSE)  # the ramp in two stages, as a state half way is looked at
        # While the lattice falls together a servo of the default gain takes thousands of cycles.
        ramp = {"servo_gain": 0.05, "stress_tolerance": 0.01}
        first = self._add("horizontal", "growth", seed, "horizontal", b,
                          of.grow("grow005", middle, 0.005, 8, mean_stress_start=10e6,
                                  ramp_eccentricity=0.005, **ramp),
                          after=lattice, history=2, micro=scale.micro, tables=["final.state"],
                          cost=2)
        second = self._add("horizontal", "ramp", seed, "horizontal", b,
                           of.grow("grow01", DENSE, 0.01, 8, mean_stress_start=middle,
                                   ramp_eccentricity=0.01, **ramp),
                           after=first, history=2, micro=scale.micro, cost=1)
        grown = self._add("horizontal", "growth2", seed, "horizontal", b,
                          of.grow("grow18", DENSE, E_LONG, scale.increments),
                          of.relax("p100", DENSE), after=second, history=20,
                          micro=scale.micro // 2, tables=["final.state"], cost=6)
        for pressure, run in self._release("horizontal", seed, "horizontal", b, grown).items():
            self._shear("horizontal", f"{p_name(pressure)}-", seed, "horizontal", b, pressure, run)

    def _spheres(self, seed):
        of, b = Stages(), body(self.scale.particles, kind="sphere")
        dense = self._add("sphere", "p100", seed, "spheres", b, of.random(seed), of.compact(DENSE),
                          of.relax("p100", DENSE), tables=["final.state"], cost=1)
        reached = {DENSE: dense, **self._release("sphere", seed, "spheres", b, dense, cost=0.5)}
        for pressure in (DENSE, 50e6, 10e6):
            self._shear("sphere", f"{p_name(pressure)}-", seed, "spheres", b, pressure,
                        reached[pressure])

    def _plane(self, seed):
        """Disks and ellipses at a mean stress at which overlaps are those of 10e6 in space."""
        of, scale, pressure = Stages(plane=True), self.scale, scale_plane(10e6)
        b = body(scale.particles, plane=True, kind="ellipse")
        after = self._add("ellipse", "e00", seed, "plane", b, of.random(seed),
                          of.compact(pressure), of.relax("e00", pressure,
                                                         max_unbalanced_ratio=0.02),
                          history=20, tables=["final.state"], cost=3)
        self._shear("ellipse", "e00-", seed, "plane", b, pressure, after, of=of)
        for e in (0.05, 0.1, 0.15, 0.2, 0.25, 0.3):
            name = f"e{round(100 * e):02d}"
            after = self._add("ellipse", name, seed, "plane", b,
                              of.grow("grow", pressure, e,
                                      max(8, round(0.12 * scale.increments))),
                              of.relax(name, pressure, max_unbalanced_ratio=0.02), after=after,
                              history=20,
                              tables=["final.state"], cost=3)
            if e <= 0.2:  # as published
                self._shear("ellipse", f"{name}-", seed, "plane", b, pressure, after, of=of)

    def _lode(self, seed):
        """True triaxial tests of spheres and of spheroids at 30e6."""
        of = Stages()
        for family, kind in (("sphere", "sphere"), ("spheroid", "spheroid")):
            b = body(self.scale.particles, kind=kind)
            for ratio in (0.0, 0.25, 0.5, 1.0):
                self._shear(family, f"p030-b{round(100 * ratio):03d}-", seed, "lode", b, 30e6,
                            f"{family}-p030-s{seed}", of=of, strain=self.scale.strain / 2,
                            intermediate_ratio=ratio)

    def _loose(self, seed):
        """Spheroids from random places, brought to their pressure with full friction."""
        of, b = Stages(), body(self.scale.particles, elongation=1 / 0.7)
        for pressure in (50e6, 10e6):
            name = p_name(pressure)
            sample = self._add("loose", name, seed, "loose", b, of.random(seed),
                               of.compact(pressure, friction=stages.FRICTION),
                               of.relax(name, pressure, max_unbalanced_ratio=0.02)
                               | {"friction_coefficient": stages.FRICTION},
                               tables=["final.state"], cost=3)
            self._shear("loose", f"{name}-", seed, "loose", b, pressure, sample)

    def _hertz(self, seed):
        """The dense sample at 50e6 by the law of Hertz and Mindlin, at equal mean overlap.

        A contact of two spheres of RADIUS with the overlap d bears (4/3) E' sqrt(RADIUS/2) d^1.5,
        E' = E/(2 (1 - nu^2)); it is STIFFNESS d at the mean overlap d of the linear sample."""
        of, b = Stages(), dict(body(self.scale.particles))
        overlap = 7.39e9 / stages.STIFFNESS
        modulus = 0.75 * stages.STIFFNESS / (0.5 * stages.RADIUS * overlap)**0.5
        b["contact"] = {"law": "hertz", "young_modulus": 2 * (1 - 0.3**2) * modulus,
                        "largest_overlap": 0.15, "friction_coefficient": stages.FRICTION}
        # The old law's balance would end an unload at once: the new law acts for a while first.
        sample = self._add("hertz", "p050", seed, "hertz", b, of.hold("hertz", 50e6, 500),
                           of.unload("p050", 50e6),
                           after=f"spheroid-p050-s{seed}", tables=["final.state"], cost=2)
        self._shear("hertz", "p050-", seed, "hertz", b, 50e6, sample)

    def _shapes(self, seed):
        """Triaxial bodies, and spheroids of two sizes."""
        of, scale = Stages(), self.scale
        triaxial = body(scale.particles, kind="triaxial")
        two = body(scale.particles, kind="large")
        large = two["particles"]["large"]
        two["particles"] = {"large": large | {"count": scale.particles // 5, "mean_radius": 15.0},
                            "small": large | {"count": scale.particles - scale.particles // 5}}
        for family, b, keys in (("triaxial", triaxial, {"flatness": 1.25}), ("twosize", two, {})):
            e = 1 / 9 if family == "triaxial" else E_LONG
            dense = self._add(family, "p100", seed, "shapes", b, of.random(seed),
                              of.compact(DENSE), of.grow("grow", DENSE, e, scale.increments,
                                                         **keys),
                              of.relax("p100", DENSE), history=20, tables=["final.state"], cost=6)
            reached = self._release(family, seed, "shapes", b, dense, (50e6,))
            self._shear(family, "p050-", seed, "shapes", b, 50e6, reached[50e6])

    def _limits(self, seed):
        """Towards no pressure, without friction: how many contacts remain."""
        scale = self.scale
        for family, after in (("sphere", f"sphere-p010-s{seed}"),
                              ("spheroid", f"spheroid-p010-s{seed}"),
                              ("triaxial", f"triaxial-p050-s{seed}"),
                              ("ellipse", f"ellipse-e15-s{seed}"),
                              ("disk", f"ellipse-e00-s{seed}")):
            plane = family in ("ellipse", "disk")
            old = self.runs[after]
            pressures = (4e6, 1e6, 0.25e6)  # chosen
            if plane:
                pressures = tuple(map(scale_plane, pressures))
            for k, pressure in enumerate(pressures):
                after = self._add(family, f"limit{k + 1}", seed, "limits", old.body,
                                  Stages(plane).unload(f"limit{k + 1}", pressure,
                                                       friction_coefficient=0.0,
                                                       max_unbalanced_ratio=0.05,
                                                       stress_tolerance=0.05),
                                  after=after, tables=["final.state"], cost=3)

    def _apart(self, seed):
        """The published contact scheme, growth at the published rate, a sample of 8000."""
        of, scale, b = Stages(), self.scale, body(self.scale.particles)
        self._shear("trace", "p010-", seed, "trace", b | {"motion": {"contacts": "trace"}}, 10e6,
                    f"spheroid-p010-s{seed}", strain=scale.strain / 2)
        for family, count, pressure in (("published", scale.particles, DENSE),
                                        ("published27", scale.small[0], 7e6),
                                        ("published125", scale.small[1], 47e6)):
            b = body(count)
            start = () if count == scale.particles and family == "published" else (
                of.lattice(seed, axes="plane"), of.compact(0.1 * pressure))
            self._add(family, "growth", seed, "published", b, *start,
                      of.grow("grow01", pressure, 0.01, mean_stress_start=0.1 * pressure,
                              ramp_eccentricity=0.01, cycles_per_percent=1000),
                      of.grow("grow22", pressure, 0.22, cycles_per_percent=1000),
                      after=None if start else f"horizontal-lattice-s{seed}", history=50, cost=100)
        if seed != scale.seeds[0]:
            return
        b = body(scale.large)
        large = self._add("large", "p100", seed, "large", b, of.random(seed), of.compact(DENSE),
                          of.grow("grow", DENSE, E_LONG, scale.increments), of.relax("p100", DENSE),
                          cost=10)
        reached = self._release("large", seed, "large", b, large, (50e6,))
        self._shear("large", "p050-", seed, "large", b, 50e6, reached[50e6])


def scale_plane(pressure):
    """The mean stress of plane bodies whose overlaps are about those of bodies in space.

    A contact bears p V 3/(M 2r) in space and p A 2/(M 2r) in the plane; with dense packings' M/V of
    6.2 contacts a body (porosity 0.18) and 3 (0.12) these are equal at this ratio."""
    radius = stages.RADIUS
    space = 3 * (4.0 / 3.0 * radius**3 / 0.82) / (6.2 * 2 * radius)
    plane = 2 * (radius**2 / 0.88) / (3.0 * 2 * radius)
    return round(pressure * space / plane)
