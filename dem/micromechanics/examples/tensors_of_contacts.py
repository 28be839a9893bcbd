#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Every tensor of a packing in space, from two tables and nothing else:

    tangency-dem contacts STATE > contacts.csv;  tangency-dem particles STATE > particles.csv
    tensors_of_contacts.py contacts.csv particles.csv

Prints JSON with the keys of `tangency-dem micro --json`: what it does not have are standard errors.
A harmonic of order L is a polynomial {(i, j, k): c}, the sum of c x^i y^j z^k, whose coefficients are
those of its tensor: a:nn or b::nnnn. Formulas: docs/derivations/micromechanics.md.
"""
import csv, json, math, sys
from itertools import product

HARMONICS = {2: [{(2, 0, 0): 1, (0, 2, 0): -1}, {(0, 2, 0): 1, (0, 0, 2): -1},
                 {(1, 1, 0): 1}, {(0, 1, 1): 1}, {(1, 0, 1): 1}],
             4: [{(4, 0, 0): 1, (2, 2, 0): -6, (0, 4, 0): 1}, {(0, 4, 0): 1, (0, 2, 2): -6, (0, 0, 4): 1},
                 {(0, 0, 4): 1, (2, 0, 2): -6, (4, 0, 0): 1}, {(3, 1, 0): 1, (1, 3, 0): -1},
                 {(0, 3, 1): 1, (0, 1, 3): -1}, {(1, 0, 3): 1, (3, 0, 1): -1},
                 {(1, 1, 2): 6, (3, 1, 0): -1, (1, 3, 0): -1}, {(2, 1, 1): 6, (0, 3, 1): -1, (0, 1, 3): -1},
                 {(1, 2, 1): 6, (1, 0, 3): -1, (3, 0, 1): -1}]}
BASIS = [(order, p) for order in (2, 4) for p in HARMONICS[order]]

dot = lambda u, v: sum(a * b for a, b in zip(u, v))
minus = lambda u, v, s=1.0: [a - s * b for a, b in zip(u, v)]
unit = lambda u: [a / math.sqrt(dot(u, u)) for a in u]
odd = lambda n: math.prod(range(n, 0, -2))  # n!!
monomial = lambda e, n: n[0] ** e[0] * n[1] ** e[1] * n[2] ** e[2]
value = lambda p, n: sum(c * monomial(e, n) for e, c in p.items())
lower = lambda e, k: tuple(e[i] - (i == k) for i in range(3))
gradient = lambda p, n: [sum(c * e[k] * monomial(lower(e, k), n) for e, c in p.items() if e[k])
                         for k in range(3)]


def sphere_mean(p, q):  # of the product of two polynomials
    total = 0.0
    for (e, c), (f, d) in product(p.items(), q.items()):
        s = [a + b for a, b in zip(e, f)]
        if not any(k % 2 for k in s):
            total += c * d * math.prod(odd(k - 1) for k in s) / odd(sum(s) + 1)
    return total


def solve(matrix, right):  # by elimination
    rows = [row[:] + [b] for row, b in zip(matrix, right)]
    for k in range(len(rows)):
        pivot = max(range(k, len(rows)), key=lambda i: abs(rows[i][k]))
        rows[k], rows[pivot] = rows[pivot], rows[k]
        for i in range(k + 1, len(rows)):
            rows[i] = minus(rows[i], rows[k], rows[i][k] / rows[k][k])
    x = [0.0] * len(rows)
    for k in reversed(range(len(rows))):
        x[k] = (rows[k][-1] - dot(rows[k][k + 1:-1], x[k + 1:])) / rows[k][k]
    return x


def tensors(coefficients):
    whole = {2: {}, 4: {}}
    for (order, p), x in zip(BASIS, coefficients):
        for e, c in p.items():
            ways = math.factorial(order) // math.prod(map(math.factorial, e))
            whole[order][e] = whole[order].get(e, 0.0) + x * c / ways
    at = lambda order, *index: whole[order].get(tuple(index.count(k) for k in range(3)), 0.0)
    second = [[at(2, i, j) for j in range(3)] for i in range(3)]
    fourth = [[[[at(4, i, j, k, l) for l in range(3)] for k in range(3)] for j in range(3)] for i in range(3)]
    return {"second": second, "fourth": fourth, "magnitude": math.sqrt(sum(dot(r, r) for r in second))}


scalar = lambda n: [value(p, n) for _, p in BASIS]
slope = lambda n: [[g / order for g in gradient(p, n)] for order, p in BASIS]  # a n or b nnn
tangential = lambda n: [minus(s, n, dot(s, n)) for s in slope(n)]
GRAM = [[sphere_mean(p, q) if a == b else 0.0 for b, q in BASIS] for a, p in BASIS]
RISE = [(order + 1) / order for order, _ in BASIS]  # mean square of the gradients' over the scalars'


def directions(all_of_them):
    return tensors(solve(GRAM, [sum(column) / len(all_of_them) for column in zip(*map(scalar, all_of_them))]))


def vectors(places, weights, normals, data, projected):
    """The mean of v.n, and the tensors of v.n and of the rest of v."""
    columns = [[1.0] + scalar(n) for n in places]
    along = [dot(v, n) for v, n in zip(data, normals)]
    rest = [minus(v, n, a) for v, n, a in zip(data, normals, along)]
    slopes = [slope(n) if projected else tangential(n) for n in places]
    right = [sum(w * c[m] * a for w, c, a in zip(weights, columns, along)) for m in range(15)]
    across = [sum(w * dot(s[m], t) for w, s, t in zip(weights, slopes, rest)) for m in range(14)]
    if projected:
        mean, found = right[0], solve(GRAM, right[1:])
        turned = solve([[r * g for g in row] for r, row in zip(RISE, GRAM)], across)
    else:
        sums = lambda f, size: [[sum(w * f(i, k, m) for i, w in enumerate(weights)) for m in range(size)]
                                for k in range(size)]
        mean, *found = solve(sums(lambda i, k, m: columns[i][k] * columns[i][m], 15), right)
        turned = solve(sums(lambda i, k, m: dot(slopes[i][k], slopes[i][m]), 14), across)
    return mean, tensors([x / mean for x in found]), tensors([x / mean for x in turned])


def near_uniform(n, count=4):
    """The class, that of the opposite direction, the area, and the middle."""
    k = max(range(3), key=lambda i: abs(n[i]))
    cut = [min(int(4 * count / math.pi * math.atan(abs(n[(k + s) % 3] / n[k]))), count - 1) for s in (1, 2)]
    side = [x >= 0.0 for x in n]
    edge = lambda i: i * math.pi / (4 * count)
    part = lambda i, j: math.asin(math.sin(edge(i)) * math.sin(edge(j)))
    area = part(cut[0] + 1, cut[1] + 1) - part(cut[0], cut[1] + 1) - part(cut[0] + 1, cut[1]) + part(*cut)
    middle = [0.0] * 3
    for s, tangent in enumerate([1.0] + [math.tan(edge(i + 0.5)) for i in cut]):
        middle[(k + s) % 3] = math.copysign(tangent, n[(k + s) % 3])
    return (k, *side, *cut), (k, *(not x for x in side), *cut), area, unit(middle)


def table(file):
    with open(file, newline="") as lines:
        return [{name: float(text) for name, text in row.items()} for row in csv.DictReader(lines)]


def in_body(particle, v):  # q* v q
    w, u = particle["qw"], [-particle[k] for k in ("qx", "qy", "qz")]
    cross = lambda a, b: [a[i - 2] * b[i - 1] - a[i - 1] * b[i - 2] for i in range(3)]
    t = cross(u, v)
    return [a + 2.0 * (w * b + c) for a, b, c in zip(v, t, cross(u, t))]


def axis_of(particle):  # of symmetry, else the longest; none of a sphere
    r = [particle[k] for k in ("r1", "r2", "r3")]
    same = lambda i, j: abs(r[i] - r[j]) <= 1e-9 * max(r)
    alone = [k for k in range(3) if same(k - 1, k - 2) and not same(k, k - 1)]
    if same(0, 1) and same(1, 2):
        return None
    e = [float(k == (alone[0] if alone else r.index(max(r)))) for k in range(3)]
    return in_body({"qw": particle["qw"], **{k: -particle[k] for k in ("qx", "qy", "qz")}}, e)


def main(contact_file, particle_file):
    contacts, particles = table(contact_file), table(particle_file)
    three = lambda row, name: [row[name + k] for k in "xyz"]
    n, force, branch, arm = ([three(row, name) for row in contacts] for name in "nfba")
    length = [[math.sqrt(dot(z, z)) * x for x in m] for z, m in zip(branch, n)]
    sides = [pair for c, row in enumerate(contacts)
             for pair in ((unit(arm[c]), row["a"]), (unit(minus(arm[c], branch[c])), row["b"]))]
    axes = [axis_of(p) for p in particles]
    of_sides = [in_body(particles[int(i)], v) for v, i in sides if axes[int(i)]]
    found = {"fabric": directions(n), "contact_vectors": directions([v for v, _ in sides]),
             "long_axes": directions([u for u in axes if u]) if any(axes) else None,
             "local_contacts": directions(of_sides) if of_sides else None}
    classes = [near_uniform(m) for m in n]
    count, area = {}, {}
    for one, other, size, _ in classes:
        for g in (one, other):
            count[g], area[g] = count.get(g, 0) + 1, size
    shares = [2.0 * size / sum(area.values()) / count[one] for one, _, size, _ in classes]
    a = found["fabric"]["second"]
    inverse = [1.0 / (len(n) * (1.0 + dot(m, [dot(row, m) for row in a]))) for m in n]
    for name, places, weights, projected in (
            ("", n, shares, False), ("published", [c[3] for c in classes], shares, True),
            ("contact_sums", n, inverse, True)):
        to = found.setdefault(name, {}) if name else found
        if min(weights) <= 0.0:  # order 2 alone makes a density below 0 there: no sums
            continue
        to["f0"], to["normal_force"], to["tangential_force"] = vectors(places, weights, n, force, projected)
        to["z0"], to["branch_normal"], to["branch_tangential"] = vectors(places, weights, n, branch, projected)
        to["mean_branch_length"], to["branch_length"], _ = vectors(places, weights, n, length, projected)
    print(json.dumps(found, indent=1))


main(*sys.argv[1:])
