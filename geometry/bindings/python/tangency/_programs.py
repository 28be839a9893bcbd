# SPDX-License-Identifier: MIT
"""Programs of the project, started from Python."""

from __future__ import annotations

import os
import shutil
import subprocess
from collections.abc import Sequence


class ProgramError(RuntimeError):
    """A program that is not there, or that refused its input: what it said last.

    Attributes
    ----------
    status : int or None
        Its exit status.
    """

    def __init__(self, message: str, status: int | None = None) -> None:
        super().__init__(message)
        self.status = status


def found(name: str, given: str | None) -> str:
    """The path of a program: as given, as its variable names it, or on the path."""
    variable = name.upper().replace("-", "_")
    path = given or os.environ.get(variable) or shutil.which(name)
    if path is None:
        raise ProgramError(f"{name} is not on the path: install it, or name it by program= or {variable}")
    return path


def run(arguments: Sequence[str], good: tuple[int, ...] = (0,)) -> "subprocess.CompletedProcess[str]":
    """Runs it to its end.

    Raises
    ------
    ProgramError
        An exit status that is not among the good ones.
    """
    done = subprocess.run(list(arguments), stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, check=False)
    if done.returncode not in good:
        said = (done.stderr.strip() or done.stdout.strip()).splitlines()
        raise ProgramError(said[-1] if said else f"{arguments[0]} ended with {done.returncode}", done.returncode)
    return done
