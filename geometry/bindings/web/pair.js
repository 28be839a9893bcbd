// SPDX-License-Identifier: MIT
// A pair of bodies as numbers, link, table and code, and words for what is said of it. A body is {x, y, z, r1, r2, r3, qw, qx, qy, qz}.

/** The columns of a body, as in the tables of `tangency contact`. */
const BODY_COLUMNS = ["x", "y", "z", "r1", "r2", "r3", "qw", "qx", "qy", "qz"];

const SAYS = {
  separate: "The bodies are apart: no common point.",
  external_touch: "The bodies touch from outside: common points, but no common inner point.",
  overlap: "The bodies overlap.",
  internal_touch: "One body is inside the other, and the surfaces meet.",
  a_in_b: "A is inside B, and the surfaces do not meet.",
  b_in_a: "B is inside A, and the surfaces do not meet.",
  equal: "The two are the same set of points.",
};
const MEANS = {
  "common-normal": "distance, or minus the length of the shortest way out",
  "perram-wertheim": "distance of the tangent planes at the point of equal potentials",
  "midpoint-potential": "along the line through the point of equal potentials",
  trace: "published scheme of curves; only where the bodies overlap",
  spheres: "distance of the least spheres about the centres",
};
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
