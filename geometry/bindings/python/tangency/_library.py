# SPDX-License-Identifier: MIT
"""The C library, loaded, and its errors."""

from __future__ import annotations

import ctypes
import os
from pathlib import Path
from typing import Any

from tangency._checks import TangencyError, integer, real
from tangency._table import FUNCTIONS, Code

#: What Debian's package of the library has; the part behind .so is its version.
INSTALLED = "libtangency_c.so.0.2"


def _loaded() -> ctypes.CDLL:
    """TANGENCY_C_LIBRARY, or the file beside this one, or the one of the system."""
    named = os.environ.get("TANGENCY_C_LIBRARY")
    beside = Path(__file__).with_name("libtangency_c.so")
    path = named or (str(beside) if beside.exists() else INSTALLED)
    try:
        return ctypes.CDLL(path)
    except OSError as error:
        raise ImportError(f"{path} cannot be loaded: {error}; TANGENCY_C_LIBRARY can name another file") from error


def _prototyped(library: ctypes.CDLL) -> dict[str, Any]:
    functions = {}
    for name, (result, arguments) in FUNCTIONS.items():
        function = getattr(library, "tangency_" + name)
        function.restype = result
        function.argtypes = arguments
        functions[name] = function
    return functions


library = _loaded()
functions = _prototyped(library)
_NO_ROW = ctypes.c_size_t(-1).value


def failed(code: int) -> Exception:
    """The exception for a code other than OK, of the last call of this thread."""
    message = functions["error_message"]().decode()
    row = functions["error_row"]()
    if code in (Code.bad_row, Code.bad_argument):
        return TangencyError(message, None if row == _NO_ROW else row)
    if code == Code.out_of_memory:
        return MemoryError(message)
    return RuntimeError(message)


def call(name: str, *arguments: object) -> None:
    """Calls tangency_NAME, without the lock of the interpreter."""
    code = functions[name](*arguments)
    if code != 0:
        raise failed(code)


def version() -> str:
    """MAJOR.MINOR.PATCH of the library."""
    return str(functions["version"]().decode())


def instruction_set() -> str:
    """The instruction set that calls for many pairs use on this machine."""
    return str(functions["instruction_set"]().decode())


def level_of_confidence(confidence: float, dimensions: int = 3) -> float:
    """The level of the ellipsoid (3) or ellipse (2) that holds a share of a normal distribution."""
    level = ctypes.c_double()
    call("level_of_confidence", real(confidence, "confidence"), integer(dimensions, "dimensions"),
         ctypes.addressof(level))
    return level.value
