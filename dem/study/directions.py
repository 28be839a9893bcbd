# SPDX-License-Identifier: MIT
"""Directions as surfaces: what depends on a direction, drawn as far from the middle as it is large.

Classes are those of dem/micromechanics/sphere_partition.hpp: 24 n^2 patches of the six faces of a
cube, each octant's third cut n by n at equal angles. Vectors are tuples of three, in the scene's
axes.
"""

import math


def dot(a, b):
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def scaled(a, factor):
    return (factor * a[0], factor * a[1], factor * a[2])


def unit(a):
    return scaled(a, 1.0 / math.sqrt(dot(a, a)))


def patches_of(classes):
    """n of 24 n^2 classes; ValueError for another number."""
    n = round(math.sqrt(classes / 24.0))
    if n < 1 or 24 * n * n != classes:
        raise ValueError(f"{classes} classes: not 24 n^2 of a near-uniform partition")
    return n


def place_of(d, n):
    """The class of a direction: (axis, sign) of its cube's face, then of the two axes after it in
    turn (sign, patch)."""
    k = max(range(3), key=lambda i: (abs(d[i]), -i))
    others = []
    for i in ((k + 1) % 3, (k + 2) % 3):
        angle = math.atan2(abs(d[i]), abs(d[k]))
        others.append((1.0 if d[i] >= 0.0 else -1.0, min(n - 1, int(4.0 * n * angle / math.pi))))
    return (k, 1.0 if d[k] >= 0.0 else -1.0), others[0], others[1]


def direction_at(place, u, v, n):
    """The unit vector of a class at the shares u, v of its two angles, 0 to 1."""
    (k, sign), (sign_p, patch_p), (sign_q, patch_q) = place
    d = [0.0, 0.0, 0.0]
    d[k] = sign
    d[(k + 1) % 3] = sign_p * math.tan((patch_p + u) * math.pi / (4.0 * n))
    d[(k + 2) % 3] = sign_q * math.tan((patch_q + v) * math.pi / (4.0 * n))
    return unit(d)


def area_of(place, n):
    """The solid angle of a class, by the areas of equiangular patches of a cube."""
    def part(u, v):
        return math.asin(math.sin(u) * math.sin(v))

    _, (_, i), (_, j) = place
    step = math.pi / (4.0 * n)
    u1, u2, v1, v2 = i * step, (i + 1) * step, j * step, (j + 1) * step
    return part(u2, v2) - part(u1, v2) - part(u2, v1) + part(u1, v1)


def all_places(n):
    return [((k, s), (sp, i), (sq, j)) for k in range(3) for s in (1.0, -1.0) for sp in (1.0, -1.0)
            for sq in (1.0, -1.0) for i in range(n) for j in range(n)]


class Mesh:
    """Triangles, each three indices of points."""

    def __init__(self):
        self.points, self.triangles = [], []

    def reach(self):
        """Of the point that is farthest from the middle."""
        return max((math.sqrt(dot(p, p)) for p in self.points), default=0.0)

    def add_grid(self, rows):
        """Two triangles of each mesh of a grid of points."""
        at, wide = len(self.points), len(rows[0])
        for row in rows:
            self.points += row
        for i in range(len(rows) - 1):
            for j in range(wide - 1):
                a = at + i * wide + j
                self.triangles += [(a, a + 1, a + wide + 1), (a, a + wide + 1, a + wide)]

    def add_sides(self, rim):
        """Triangles from the middle to the edges of a closed line."""
        at = len(self.points)
        self.points += [(0.0, 0.0, 0.0), *rim]
        self.triangles += [(at, at + 1 + k, at + 1 + (k + 1) % len(rim)) for k in range(len(rim))]


# Edges of the pieces that a class's outside is cut in, so that it is round.
CUTS = (0.0, 0.5, 1.0)


def spikes(values, n):
    """A histogram: of each class {place: value} a pyramid from the middle with a round end. Values
    that are not finite or not positive have none."""
    mesh = Mesh()
    for place, value in values.items():
        if not (math.isfinite(value) and value > 0.0):
            continue
        grid = [[scaled(direction_at(place, u, v, n), value) for v in CUTS] for u in CUTS]
        mesh.add_grid(grid)
        mesh.add_sides([row[0] for row in grid] + grid[-1][1:] + [row[-1] for row in grid[-2::-1]]
                       + grid[0][-2:0:-1])
    return mesh


def smooth(value_of, cuts=9):
    """A surface as far from the middle as value_of(direction) says."""
    mesh = Mesh()
    shares = [k / cuts for k in range(cuts + 1)]
    for place in all_places(1):
        grid = []
        for u in shares:
            row = [direction_at(place, u, v, 1) for v in shares]
            grid.append([scaled(d, max(0.0, value_of(d))) for d in row])
        mesh.add_grid(grid)
    return mesh


# Index triples of the monomials of order 3, each with i <= j <= k.
CUBES = [(i, j, k) for i in range(3) for j in range(i, 3) for k in range(j, 3)]


class Model:
    """1 + a n n + b n n n n, or the tangential field a n + b n n n less its part along n.

    @param second  components of a
    @param fourth  components of b, nested, the same at every order of indices; None leaves it out
    """

    def __init__(self, second, fourth=None):
        self.second = second
        self.cubic = [] if fourth is None else [
            (i, j, k, [len({(i, j, k), (i, k, j), (j, i, k), (j, k, i), (k, i, j), (k, j, i)})
                       * fourth[row][i][j][k] for row in range(3)]) for i, j, k in CUBES]

    def along(self, d):
        """a n + b n n n"""
        x, y, z = (dot(row, d) for row in self.second)
        for i, j, k, factors in self.cubic:
            monomial = d[i] * d[j] * d[k]
            x += factors[0] * monomial
            y += factors[1] * monomial
            z += factors[2] * monomial
        return x, y, z

    def factor(self, d):
        return 1.0 + dot(self.along(d), d)

    def tangential(self, d):
        """Its size."""
        total = self.along(d)
        normal = dot(total, d)
        return math.sqrt(max(0.0, dot(total, total) - normal * normal))
