# SPDX-License-Identifier: GPL-3.0-or-later
"""How much longer a million pairs take from NumPy than in C++, and what a single call takes.

Usage: python_speed.py CPP_BATCH [--turns N]
CPP_BATCH is the library made of cpp_batch.cpp. Turns of both alternate in one process, on the same
memory; the least of each is compared. Ends with 1 where the ratio is above 1.05, where a single call takes
5 us, or where an answer differs.
"""

import argparse
import ctypes
import sys
import time

import numpy as np

import tangency

PAIRS = 1_000_000
RATIO, SINGLE = 1.05, 5.0  # bars; the second in us


def sample(count, generator):
    """Bodies of aspect to 3 that touch, nearly touch or overlap a little."""
    rows = np.empty((count, 10))
    rows[:, :3] = generator.normal(size=(count, 3))
    rows[:, 3:6] = generator.uniform(0.5, 1.5, (count, 3))
    rows[:, 6:] = generator.normal(size=(count, 4))
    return rows


def least(turns, *calls):
    best = [np.inf] * len(calls)
    for _ in range(turns):
        for k, call in enumerate(calls):
            start = time.perf_counter()
            call()
            best[k] = min(best[k], time.perf_counter() - start)
    return best


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("library")
    parser.add_argument("--turns", type=int, default=15)
    options = parser.parse_args()
    cpp = ctypes.CDLL(options.library)
    generator = np.random.default_rng(21)
    print("seed 21,", tangency.instruction_set())

    a, b = sample(PAIRS, generator), sample(PAIRS, generator)
    directions = generator.normal(size=(PAIRS, 3))
    b[:, :3] = a[:, :3] + 2.1 * directions / np.linalg.norm(directions, axis=1)[:, np.newaxis]
    rows = np.vstack([a, b])
    pairs = np.stack([np.arange(PAIRS), PAIRS + np.arange(PAIRS)], 1).astype(np.uint32)
    bodies = tangency.Bodies(rows)
    out = tangency.contacts(bodies, pairs=pairs)
    own = tangency.contacts(bodies, pairs=pairs)
    addresses = [ctypes.c_void_p(array.ctypes.data) for _, array in own]
    length, list_ = ctypes.c_size_t(PAIRS), ctypes.c_void_p(pairs.ctypes.data)
    row_address, row_count = ctypes.c_void_p(rows.ctypes.data), ctypes.c_size_t(2 * PAIRS)
    cpp.take_bodies(row_address, row_count)

    def cpp_pairs():
        cpp.ask_pairs(list_, length, *addresses, 1)

    def cpp_rows():
        cpp.take_bodies(row_address, row_count)
        cpp_pairs()

    def python_pairs():
        tangency.contacts(bodies, pairs=pairs, out=out)

    def python_rows():
        tangency.contacts(a, b, out=out)

    failed = False
    for name, of_cpp, of_python in (("bodies made before", cpp_pairs, python_pairs),
                                    ("rows to answers", cpp_rows, python_rows)):
        cpp_time, python_time = least(options.turns, of_cpp, of_python)
        same = all(np.array_equal(left, right) for (_, left), (_, right) in zip(own, out))
        ratio = python_time / cpp_time
        failed |= ratio > RATIO or not same
        print(f"{name}: C++ {1e9 * cpp_time / PAIRS:.1f} ns a pair, Python {1e9 * python_time / PAIRS:.1f}: "
              f"{ratio:.3f} x; answers {'the same' if same else 'DIFFER'}")

    def single():
        for _ in range(100):
            tangency.contact(a[0], b[0])

    (taken,) = least(40 * options.turns, single)
    failed |= taken * 1e4 >= SINGLE
    print(f"a single call: {taken * 1e4:.2f} us")
    sys.exit(failed)


main()
