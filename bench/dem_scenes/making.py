# SPDX-License-Identifier: GPL-3.0-or-later
"""Makes the scenes of the benchmarks in a folder: NAME.toml, NAME.csv, and the samples beside them."""

import dataclasses
import os
import shutil
import subprocess
import sys

import bodies
import specs

Spec = specs.Spec


def named():
    """The scenes that have names."""
    scenes = {}
    # The longest need more of them for their room, or touch two images of another one.
    shapes = {
        "sphere": (1.0, 1.0, 1000), "spheroid-1.43": (1 / 0.7, 1.0, 1000), "ellipsoid-3-2-1": (1.5, 2.0, 1000),
        "spheroid-3": (3.0, 1.0, 1000), "spheroid-5": (5.0, 1.0, 1000), "spheroid-10": (10.0, 1.0, 1400)}
    for name, (elongation, flatness, count) in shapes.items():
        dense = Spec(particles=count, elongation=elongation, flatness=flatness)
        change = lambda spec=dense, **keys: dataclasses.replace(spec, **keys)
        scenes[f"{name}-{count}"] = dense
        sheared = change(state="sheared", pressure=50e6)
        if sheared.has_room():
            scenes[f"{name}-{count}-sheared"] = sheared
        scenes[f"{name}-{count}-hertz"] = change(law="hertz")
        scenes[f"{name}-{count}-frictionless"] = change(friction=0.0)
        scenes[f"{name}-{count}-walls"] = change(walls="xyz")
        for copies in (2, 4, 8, 10):
            scenes[f"{name}-{count * copies**3}"] = change(copies=copies)
            scenes[f"{name}-{count * copies**3}-shuffled"] = change(copies=copies, shuffle=1)
        # Small ones, to see whether all is well.
        small = change(particles=125)
        if small.has_room():
            scenes[f"{name}-125"] = small
            scenes[f"{name}-125-hertz"] = change(small, law="hertz")
            scenes[f"{name}-1000-of-125"] = change(small, copies=2)
            scenes[f"{name}-1000-of-125-shuffled"] = change(small, copies=2, shuffle=1)
    for copies in (6, 10, 13, 25):
        scenes[f"lattice-{4 * copies**3}"] = Spec(particles=4, state="lattice", copies=copies)
    # One large particle has room in a dense cell, which must be two of its diameters wide for two.
    for ratio, small in ((2, 1000), (5, 1000), (10, 4000), (20, 16000)):
        scenes[f"ratio-{ratio}"] = Spec(particles=small, large=1, size_ratio=float(ratio))
    scenes["ratio-2-8008"] = dataclasses.replace(scenes["ratio-2"], copies=2)
    for name, loose in {
            "equal-8001": Spec(particles=8001, state="loose"),
            "ratio-20-loose": Spec(particles=8000, large=4, size_ratio=20.0, state="loose"),
            "ratio-50-loose": Spec(particles=30000, large=1, size_ratio=50.0, state="loose")}.items():
        scenes[name] = loose
        scenes[name + "-drifting"] = dataclasses.replace(loose, drift=True)
    return scenes


class Maker:
    """Makes scenes in `folder`, each once; samples by the program `tool`, a tangency-dem."""

    def __init__(self, folder, tool, threads=1):
        self.folder, self.tool, self.threads = folder, tool, threads
        self.samples = {}

    def scene(self, name, spec):
        """The file of a scene, made where it is not there, or is another one of this name."""
        if fault := spec.fault():
            raise ValueError(f"{name}: {fault}")
        file, table = (os.path.join(self.folder, name + end) for end in (".toml", ".csv"))
        mark = mark_of(spec)
        if os.path.exists(table) and last_line_of(file) == mark:
            return file
        os.makedirs(self.folder, exist_ok=True)
        if spec.state == "lattice":
            size, some = bodies.lattice_cell()
        else:
            size, some = bodies.last_frame(self.sample(spec.sample()))
        all_bodies = bodies.side_by_side(size, some, spec.copies)
        if spec.state == "lattice":
            all_bodies = bodies.jittered(all_bodies, spec.seed)
        if spec.drift:
            all_bodies = bodies.drifting(spec, all_bodies)
        bodies.write_table(table, spec, all_bodies)
        text = specs.scene_text(spec, [spec.copies * edge for edge in size], spec.copies**3, name + ".csv")
        write_whole(file, f"{text}\n{mark}\n")
        return file

    def sample(self, spec):
        """The frames of a sample, made if they are not there."""
        folder = os.path.join(self.folder, "samples")
        os.makedirs(folder, exist_ok=True)
        text = specs.sample_text(spec)
        # Samples go by the text of their scenes, so that another way of making them makes new ones.
        name = f"{spec.state}-{spec.particles}-{spec.elongation:.3g}-{spec.flatness:.3g}"
        name += f"-{specs.digest(text)}"
        frames = os.path.join(folder, name + ".xyz")
        if os.path.exists(frames):
            return frames
        scene, out = (os.path.join(folder, name + end) for end in (".toml", "-out"))
        write_whole(scene, text)
        print(f"making the sample {name}", file=sys.stderr, flush=True)
        run = subprocess.run(
            [self.tool, "run", scene, "--out", out, "--replace", "--quiet", "--threads",
             str(self.threads)], stdin=subprocess.DEVNULL, capture_output=True, text=True, check=False)
        if run.returncode:
            raise ValueError(f"{scene}: {self.tool} ended with {run.returncode}: {last_line(run.stderr)}")
        os.replace(os.path.join(out, "frames.xyz"), frames)
        shutil.rmtree(out)
        return frames


def mark_of(spec):
    """The last line of a scene's file: a digest of all that the scene comes from."""
    with open(bodies.__file__, encoding="utf-8") as source:  # where its bodies stand
        parts = [repr(spec), source.read()]
    if spec.state != "lattice":
        parts.append(specs.sample_text(spec.sample()))
    parts.append(specs.scene_text(spec, [1.0] * 3, spec.copies**3, ""))
    return f"# Made from {specs.digest(chr(0).join(parts))}"


def last_line_of(file):
    """Nothing where there is no such file."""
    if not os.path.exists(file):
        return ""
    with open(file, encoding="utf-8") as text:
        return last_line(text.read())


def last_line(text):
    return (text.strip().splitlines() or ["nothing was said"])[-1]


def write_whole(file, text):
    with open(file + ".part", "w", encoding="utf-8") as out:
        out.write(text)
    os.replace(file + ".part", file)
