# SPDX-License-Identifier: GPL-3.0-or-later
"""A copy of the project in which mutants are built, and from which they are taken out again."""
import fcntl
import os
import pathlib
import shutil
import subprocess

PROGRAMS = ["tests_tool", "tests_grade", "tangency_tool", "tangency_verify_tool", "sphere_tool",
            "tests_geometry", "tests_geometry_allocation", "relation_agreement", "gap_agreement",
            "primitives_agreement", "ray_agreement", "quartic_agreement",
            "time_of_contact_agreement", "ellipse_agreement", "batch_agreement"]
# A shared library is linked once and no program again; bound to itself, it runs its own mutated
# inline functions even where a program has clean ones. No optimisation that compiling pays for.
CONFIGURE = ["-G", "Ninja", "-DCMAKE_BUILD_TYPE=RelWithDebInfo",
             "-DCMAKE_CXX_FLAGS_RELWITHDEBINFO=-O1", "-DBUILD_SHARED_LIBS=ON",
             "-DCMAKE_LINK_DEPENDS_NO_SHARED=ON", "-DCMAKE_SHARED_LINKER_FLAGS=-Wl,-Bsymbolic",
             "-DTANGENCY_BUILD_BENCH=OFF"]
LIBRARY = "tangency_geometry"
# What a change in geometry/ reaches without compiling a test again.
KERNEL = [LIBRARY, "tangency_tool"]


class BuildFailed(Exception):
    pass


def project_files(root):
    names = subprocess.run(["git", "ls-files", "-z", "-co", "--exclude-standard"], cwd=root,
                           check=True, capture_output=True).stdout
    return [n.decode() for n in names.split(b"\0") if n and pathlib.Path(root, n.decode()).is_file()]


class Tree:
    def __init__(self, root, place, threads, programs=PROGRAMS, configure=CONFIGURE, build=None):
        self.root, self.place, self.threads = root, place, threads
        self.programs, self.configure = programs, configure
        self.source = place / "source"
        self.build = self.source / build if build else place / "build"
        self.store = place / "clean"  # the build as it was without a mutant
        self.originals = place / "originals"  # of the file that is mutated now

    def prepare(self):
        """Copies what has changed, builds all of it and keeps the result."""
        self.place.mkdir(parents=True, exist_ok=True)
        self.lock = (self.place / "lock").open("w")
        try:
            fcntl.flock(self.lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            raise BuildFailed(f"{self.place} is in use by another run; --build takes another place")
        self.take_out()  # what a run that was ended has left
        self._copy_sources()
        if not (self.build / "build.ninja").exists():
            self._run(["cmake", "-S", str(self.source), "-B", str(self.build), *self.configure])
        self._run(["ninja", "-C", str(self.build), f"-j{self.threads}", *self.programs])
        self._keep_build()

    def put(self, mutant):
        path, kept = self.source / mutant.file, self.originals / mutant.file
        kept.parent.mkdir(parents=True, exist_ok=True)
        shutil.copy2(path, kept)
        path.write_text(mutant.change.applied_to(path.read_text()))

    def compile(self, targets):
        """False where the mutant is no C++."""
        command = ["ninja", "-C", str(self.build), f"-j{self.threads}", *targets]
        return subprocess.run(command, capture_output=True).returncode == 0

    def is_clean(self, targets):
        """Did the compiler make the same code of the mutant as of the original?"""
        return all(self._same(path) for path in self._built() if path.name in targets)

    def take_out(self):
        """With the times as they were, so that nothing is compiled again."""
        for kept in self.originals.rglob("*"):
            if kept.is_file():
                shutil.copy2(kept, self.source / kept.relative_to(self.originals))
        self._restore_build()
        shutil.rmtree(self.originals, ignore_errors=True)

    def _copy_sources(self):
        wanted = set(project_files(self.root))
        have = {p.relative_to(self.source).as_posix() for p in self.source.rglob("*")
                if p.is_file() and not p.is_relative_to(self.build)}
        for name in have - wanted:
            (self.source / name).unlink()
        for name in wanted:
            origin, copy = self.root / name, self.source / name
            if not copy.exists() or copy.read_bytes() != origin.read_bytes():
                copy.parent.mkdir(parents=True, exist_ok=True)
                shutil.copyfile(origin, copy)  # with the time of now, so that it is compiled
                shutil.copymode(origin, copy)

    def _run(self, command):
        done = subprocess.run(command, capture_output=True, text=True)
        if done.returncode != 0:
            raise BuildFailed(f"{' '.join(command)}:\n{(done.stdout + done.stderr)[-4000:]}")

    def _built(self):
        for folder, _, names in os.walk(self.build):
            for name in names:
                path = pathlib.Path(folder, name)
                if not path.is_symlink() and (
                        name in (".ninja_log", ".ninja_deps") or path.suffix in (".o", ".so", ".a") or
                        os.access(path, os.X_OK)):
                    yield path

    def _stored(self, path):
        return self.store / path.relative_to(self.build)

    def _same(self, path):
        kept = self._stored(path)
        return kept.exists() and path.read_bytes() == kept.read_bytes()

    @staticmethod
    def _unchanged(path, kept):
        if not path.exists() or not kept.exists():
            return False
        one, other = path.stat(), kept.stat()
        return (one.st_mtime_ns, one.st_size) == (other.st_mtime_ns, other.st_size)

    def _keep_build(self):
        for path in self._built():
            kept = self._stored(path)
            if not self._unchanged(path, kept):
                kept.parent.mkdir(parents=True, exist_ok=True)
                shutil.copy2(path, kept)

    def _restore_build(self):
        for kept in self.store.rglob("*"):
            path = self.build / kept.relative_to(self.store)
            if kept.is_file() and not self._unchanged(path, kept):
                shutil.copy2(kept, path)
