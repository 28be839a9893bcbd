// SPDX-License-Identifier: MIT
// Turns of space: a quaternion [w, x, y, z], and its matrix by rows. Every page that draws has them.

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
