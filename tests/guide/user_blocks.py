#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs what README, guide and the pages of the languages tell a user to type, in a clone and with a home folder of its own.

Blocks of kind sh are run one after the other from the root of the clone, those of a page in one shell with -e. The first
program of the pages of C and Fortran lies there as contact.c and contact.f90. Blocks of kind cmake become a project each,
with a program to link, which is configured, built and run with the package that the sh blocks have installed.
Usage: user_blocks.py ROOT SCRATCH
"""
import os
import pathlib
import shutil
import subprocess
import sys

from blocks import blocks_of, user_pages

# Pages of the languages. They come after those of the guide, the last of which installs what they use.
LANGUAGES = ["docs/c.md", "docs/fortran.md", "docs/python.md"]
# The file that holds the first program of a page, by the kind of its block.
PROGRAMS = {"c": "contact.c", "fortran": "contact.f90"}


def say(text):
    print(text, flush=True)


def run(command, place, environment):
    done = subprocess.run(command, cwd=place, env=environment, text=True, check=False, stdin=subprocess.DEVNULL)
    return done.returncode == 0


def try_project(block, number, clone, scratch, environment):
    """A project that says what the block says."""
    place = scratch / f"project_{number}"
    (place / "external").mkdir(parents=True)
    (place / "external" / "tangency").symlink_to(clone)
    shutil.copyfile(clone / "docs" / "example" / "first_contact.cpp", place / "my_program.cpp")
    (place / "CMakeLists.txt").write_text(
        "cmake_minimum_required(VERSION 3.25)\nproject(user LANGUAGES CXX)\nadd_executable(my_program my_program.cpp)\n"
        + block.text, encoding="utf-8")
    prefix = pathlib.Path(environment["HOME"]) / "tangency"
    return (run(["cmake", "-G", "Ninja", "-S", ".", "-B", "build", "-D", f"CMAKE_PREFIX_PATH={prefix}",
                 "-D", "CMAKE_BUILD_TYPE=Release"], place, environment)
            and run(["cmake", "--build", "build", "--target", "my_program"], place, environment)
            and run(["build/my_program"], place, environment))


def main():
    root, scratch = pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2]).resolve()
    shutil.rmtree(scratch, ignore_errors=True)
    clone, home = scratch / "clone", scratch / "home"
    home.mkdir(parents=True)
    subprocess.run(["git", "clone", "-q", str(root), str(clone)], check=True)
    # What is not committed yet counts too.
    changes = subprocess.run(["git", "-C", str(root), "diff", "HEAD", "--binary"], check=True, stdout=subprocess.PIPE).stdout
    if changes:
        subprocess.run(["git", "-C", str(clone), "apply"], input=changes, check=True)
    new = subprocess.run(["git", "-C", str(root), "ls-files", "--others", "--exclude-standard", "-z"], check=True,
                         stdout=subprocess.PIPE).stdout.decode()
    for file in filter(None, new.split("\0")):
        (clone / file).parent.mkdir(parents=True, exist_ok=True)
        shutil.copy2(root / file, clone / file, follow_symlinks=False)
    environment = dict(os.environ, HOME=str(home))
    failed, count = [], 0
    blocks = [block for page in user_pages(root) + LANGUAGES for block in blocks_of(root, page)]
    for page in dict.fromkeys(block.page for block in blocks if block.kind == "sh"):
        lines = "".join(block.text for block in blocks if block.kind == "sh" and block.page == page)
        # A page that installs begins with a clean clone, but for what is built: pages give the same commands again.
        if "--install" in lines:
            shutil.rmtree(home / "tangency", ignore_errors=True)
            shutil.rmtree(clone / "first", ignore_errors=True)
        for kind, file in PROGRAMS.items():
            for program in [block.text for block in blocks if block.page == page and block.kind == kind][:1]:
                (clone / file).write_text(program, encoding="utf-8")
        say(f"== {page}\n{lines}")
        count += 1
        if not run(["bash", "-euo", "pipefail", "-c", lines], clone, environment):
            failed.append(page)
    for number, block in enumerate(block for block in blocks if block.kind == "cmake"):
        say(f"== {block.place()}\n{block.text}")
        count += 1
        if not try_project(block, number, clone, scratch, environment):
            failed.append(block.place())
    say(f"{count} run, {len(failed)} failed {' '.join(failed)}")
    return 1 if failed or not count else 0


sys.exit(main())
