# SPDX-License-Identifier: MIT
"""Pictures of bodies by POV-Ray, some at once, all in one view: z, along which is loaded, points
up.

POV-Ray that is missing or fails is a StudyError.
"""

import os
import subprocess
import time

import directions
from running import StudyError

HERE = os.path.dirname(os.path.abspath(__file__))


# Where the viewer is: at the side and a little above; his right and his up.
TOWARDS = directions.unit((-0.62, -1.0, 0.42))
RIGHT = directions.unit((-TOWARDS[1], TOWARDS[0], 0.0))
UP = (TOWARDS[1] * RIGHT[2] - TOWARDS[2] * RIGHT[1], TOWARDS[2] * RIGHT[0] - TOWARDS[0] * RIGHT[2],
      TOWARDS[0] * RIGHT[1] - TOWARDS[1] * RIGHT[0])


def span(points, height):
    """(centre, width) of a picture, height times as high as wide, that shows all these points."""
    across = [directions.dot(point, RIGHT) for point in points]
    along = [directions.dot(point, UP) for point in points]
    middle = [0.5 * (min(values) + max(values)) for values in (across, along)]
    centre = tuple(middle[0] * r + middle[1] * u for r, u in zip(RIGHT, UP))
    return centre, max(max(across) - min(across), (max(along) - min(along)) / height)


def vector(values):
    return "<" + ",".join(f"{value:.5g}" for value in values) + ">"


def colour(text):
    """#rrggbb as POV-Ray's."""
    parts = [int(text[k:k + 2], 16) / 255.0 for k in (1, 3, 5)]
    return f"srgb <{parts[0]:.3f},{parts[1]:.3f},{parts[2]:.3f}>"


def mesh(surface, shade):
    """A directions.Mesh in one colour; nothing of an empty one."""
    if not surface.triangles:
        return ""
    points = ",".join("<%.5g,%.5g,%.5g>" % point for point in surface.points)
    triangles = ",".join("<%d,%d,%d>" % triangle for triangle in surface.triangles)
    return (f"mesh2 {{\nvertex_vectors {{ {len(surface.points)}, {points} }}\n"
            f"face_indices {{ {len(surface.triangles)}, {triangles} }}\n"
            f"pigment {{ color {colour(shade)} }}\nfinish {{ Surface }} }}\n")


def stick(start, end, radius, shade):
    return (f"cylinder {{ {vector(start)}, {vector(end)}, {radius:.4g} "
            f"pigment {{ color {colour(shade)} }} finish {{ Surface }} }}\n")


def scene(bodies, width, centre=(0.0, 0.0, 0.0)):
    """The text of a picture that shows this width."""
    return (f'#include "view.inc"\n{bodies}\n'
            f'View({vector(centre)}, {vector(TOWARDS)}, {width:.5g})\n')


def render(folder, scenes, jobs):
    """@param scenes  {file.png: (scene, width, height)} in pixels; jobs pictures at once."""
    waiting, running = list(scenes.items()), {}
    try:
        while waiting or running:
            while waiting and len(running) < max(1, jobs):
                file, (text, width, height) = waiting.pop(0)
                running[file] = started(folder, file, text, width, height)
            for file, process in list(running.items()):
                if process.poll() is not None:
                    finish(folder, file, running.pop(file))
            time.sleep(0.01)
    finally:
        for process in running.values():
            process.kill()
            process.wait()


def started(folder, file, text, width, height):
    with open(os.path.join(folder, file + ".pov"), "w", encoding="utf-8") as source:
        source.write("// SPDX-License-Identifier: MIT\n" + text)
    with open(os.path.join(folder, file + ".log"), "w", encoding="utf-8") as log:
        try:
            return subprocess.Popen(
                ["povray", f"+I{file}.pov", f"+O{file}", "+FN", f"+W{width}", f"+H{height}",
                 "+A0.2",
                 "+AM1", "+R3", "+WT1", "-D", f"+L{HERE}"], cwd=folder, stdin=subprocess.DEVNULL,
                stdout=log, stderr=subprocess.STDOUT)
        except FileNotFoundError:
            raise StudyError("povray is not installed: ./demo installs it") from None


def finish(folder, file, process):
    log = os.path.join(folder, file + ".log")
    if process.returncode != 0 or not os.path.exists(os.path.join(folder, file)):
        with open(log, encoding="utf-8", errors="replace") as text:
            words = [line.strip() for line in text if "rror" in line] or ["no message"]
        raise StudyError(f"povray failed on {file}: {words[-1]}")
    os.remove(log)
    os.remove(os.path.join(folder, file + ".pov"))
