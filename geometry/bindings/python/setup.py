# SPDX-License-Identifier: MIT
"""Builds the wheel: Python files, and the library in C with the kernel in it, which fits every Python 3.

TANGENCY_C_LIBRARY names a library that is built already; else CMake builds it from this source tree. What
is made on the way lies in a folder of its own that is gone at the end, and not in the tree.
"""

import os
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

from setuptools import Distribution, setup
from setuptools.command.build_py import build_py

try:
    from setuptools.command.bdist_wheel import bdist_wheel
except ImportError:  # setuptools before 70.1
    try:
        from wheel.bdist_wheel import bdist_wheel
    except ImportError:
        raise SystemExit(f"{sys.executable} has neither the package wheel nor setuptools 70.1 or newer: install one "
                         "of them (on Debian: python3-wheel, and call /usr/bin/python3)") from None

ROOT = Path(__file__).resolve().parents[3]
SCRATCH = tempfile.TemporaryDirectory(prefix="tangency-wheel-")


def version():
    found = re.search(r"project\(tangency VERSION ([\d.]+)", (ROOT / "CMakeLists.txt").read_text())
    return found[1]


def built_library(folder):
    """The library, as CMake builds it."""
    folder.mkdir(parents=True, exist_ok=True)
    off = [f"-D TANGENCY_BUILD_{what}=OFF" for what in ("DEM", "TOOLS", "VERIFY", "TESTS", "BENCH")]
    subprocess.run(["cmake", "-G", "Ninja", "-S", str(ROOT), "-B", str(folder), "-D", "CMAKE_BUILD_TYPE=Release",
                    *(word for each in off for word in each.split()), "-D", "TANGENCY_INSTALL=OFF"], check=True)
    subprocess.run(["cmake", "--build", str(folder), "--target", "tangency_python"], check=True)
    return folder / "python" / "libtangency_c.so"


class BuildWithLibrary(build_py):
    def run(self):
        super().run()
        given = os.environ.get("TANGENCY_C_LIBRARY")
        library = Path(given) if given else built_library(Path(SCRATCH.name) / "library")
        to = Path(self.build_lib) / "tangency" / "libtangency_c.so"
        shutil.copyfile(library, to)
        strip = shutil.which("strip")
        if strip:
            subprocess.run([strip, "--strip-debug", str(to)], check=True)


class WheelOfAnyPython(bdist_wheel):
    def get_tag(self):
        return "py3", "none", super().get_tag()[2]


class BinaryDistribution(Distribution):
    def has_ext_modules(self):
        return True


setup(version=version(), distclass=BinaryDistribution,
      options={"build": {"build_base": SCRATCH.name}, "egg_info": {"egg_base": SCRATCH.name}},
      cmdclass={"build_py": BuildWithLibrary, "bdist_wheel": WheelOfAnyPython})
