# SPDX-License-Identifier: MIT
"""Programs of the project, started from Python."""

from __future__ import annotations

import os
import shutil
import subprocess
from collections.abc import Sequence
from pathlib import Path


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
    """The absolute path of a program: as given, as its variable names it, or on the path.

    Raises
    ------
    ProgramError
        It is not there, or may not be run.
    """
    variable = name.upper().replace("-", "_")
    named = given or os.environ.get(variable)
    path = shutil.which(named or name)
    if path is None and named:
        source = "program" if given else variable
        raise ProgramError(f"{source} = {str(named)!r}: must be a program that may be run, {name}")
    if path is None:
        raise ProgramError(f"{name} is not on the path: install it, or name it by program= or {variable}")
    return os.path.abspath(path)


def ended(arguments: Sequence[str], folder: Path | None = None) -> "subprocess.CompletedProcess[str]":
    """Runs it to its end in a folder, whatever its exit status.

    Raises
    ------
    ProgramError
        It cannot be started.
    """
    try:
        return subprocess.run(list(arguments), cwd=folder, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
                              check=False)
    except OSError as error:
        raise ProgramError(f"{arguments[0]} cannot be started: {error}") from error


def run(arguments: Sequence[str], good: tuple[int, ...] = (0,)) -> "subprocess.CompletedProcess[str]":
    """Runs it to its end.

    Raises
    ------
    ProgramError
        It cannot be started, or an exit status that is not among the good ones.
    """
    done = ended(arguments)
    if done.returncode not in good:
        said = (done.stderr.strip() or done.stdout.strip()).splitlines()
        raise ProgramError(said[-1] if said else f"{arguments[0]} ended with {done.returncode}", done.returncode)
    return done
