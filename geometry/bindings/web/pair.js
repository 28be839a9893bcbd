// SPDX-License-Identifier: MIT
// A pair of bodies as numbers, link, table and code. A body is {x, y, z, r1, r2, r3, qw, qx, qy, qz}.

const numbersOf = (body) => BODY_COLUMNS.map((name) => body[name]);
const pairNumbers = (pair) => [...numbersOf(pair.a), ...numbersOf(pair.b)];
const bodyOf = (numbers) => Object.fromEntries(BODY_COLUMNS.map((name, k) => [name, numbers[k]]));

/** Text that reads back to the same double in every language below. */
const textOf = (x) => (Object.is(x, -0) ? "-0.0" : Number.isInteger(x) && Math.abs(x) < 1e15 ? x.toFixed(0) : String(x));
const literal = (x) => (/[.e]/.test(textOf(x)) ? textOf(x) : textOf(x) + ".0");

function linkOf(pair) {
  const text = (body) => numbersOf(body).map(textOf).join(",");
  return `#a=${text(pair.a)}&b=${text(pair.b)}`;
}

/** The pair of a link; null where it has none. */
function pairOfLink(hash) {
  const values = new URLSearchParams(hash.replace(/^#/, ""));
  const pair = {};
  for (const name of ["a", "b"]) {
    const cells = (values.get(name) ?? "").split(",");
    if (cells.length !== BODY_COLUMNS.length || cells.some((cell) => cell.trim() === "" || Number.isNaN(Number(cell))))
      return null;
    pair[name] = bodyOf(cells.map(Number));
  }
  return pair;
}

function csvOf(pair) {
  const names = ["a", "b"].flatMap((body) => BODY_COLUMNS.map((name) => `${body}.${name}`));
  return `${names.join(",")}\n${pairNumbers(pair).map(textOf).join(",")}\n`;
}

const list = (names, body, write) => names.map((name) => write(body[name])).join(", ");
const CENTRE = ["x", "y", "z"], AXES = ["r1", "r2", "r3"], TURN = ["qw", "qx", "qy", "qz"];

const CODE = {
  "C++": (pair) => {
    const body = (name) => `  const Ellipsoid ${name}({${list(CENTRE, pair[name], literal)}}, ` +
      `{${list(AXES, pair[name], literal)}},\n                    {${list(TURN, pair[name], literal)}});`;
    return `#include <iostream>

#include <tangency/geometry/gap.hpp>
#include <tangency/geometry/relation.hpp>

int main() {
  using namespace tangency;
${body("a")}
${body("b")}
  const Gap found = signed_gap(a, b);
  std::cout << to_string(relation(a, b).relation) << ' ' << found.gap << " +- " << found.gap_error << '\\n';
}
`;
  },
  Python: (pair) => `import tangency

a = [${list(BODY_COLUMNS, pair.a, textOf)}]
b = [${list(BODY_COLUMNS, pair.b, textOf)}]
found = tangency.contact(a, b)
print(found.gap, found.gap_error, found.normal, found.status.name)
`,
  Shell: (pair) => `tangency contact - <<'END'\n${csvOf(pair)}END\n`,
};

/**
 * What bounding spheres would have said: the gap of the least spheres about each body's centre that hold it.
 */
function sphereGap({ a, b }) {
  const radius = (body) => Math.max(body.r1, body.r2, body.r3);
  return Math.hypot(b.x - a.x, b.y - a.y, b.z - a.z) - radius(a) - radius(b);
}

// Turns of space: a unit quaternion [w, x, y, z], and its matrix by rows.

function normalised(q) {
  const size = Math.hypot(...q);
  return q.map((x) => x / size);
}

function product([aw, ax, ay, az], [bw, bx, by, bz]) {
  return [aw * bw - ax * bx - ay * by - az * bz, aw * bx + ax * bw + ay * bz - az * by,
          aw * by - ax * bz + ay * bw + az * bx, aw * bz + ax * by - ay * bx + az * bw];
}

function matrixOf(q) {
  const [w, x, y, z] = normalised(q);
  return [[1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
          [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
          [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)]];
}

/** The unit quaternion of a turn about an axis of any length; that of no turn for the axis 0. */
function turnAbout(axis, angle) {
  const size = Math.hypot(...axis);
  if (size === 0) return [1, 0, 0, 0];
  const sine = Math.sin(angle / 2) / size;
  return [Math.cos(angle / 2), ...axis.map((x) => x * sine)];
}

const times = (m, v) => m.map((row) => row[0] * v[0] + row[1] * v[1] + row[2] * v[2]);
const timesTransposed = (m, v) => [0, 1, 2].map((k) => m[0][k] * v[0] + m[1][k] * v[1] + m[2][k] * v[2]);
