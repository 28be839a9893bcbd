// SPDX-License-Identifier: GPL-3.0-or-later
//
// A contact library of somebody else, with a program that answers tables: do two ellipsoids
// overlap, by the potential of Perram and Wertheim in plain doubles. It has a fault: bodies turn
// the wrong way round.
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <iostream>
#include <map>
#include <sstream>
#include <string>

namespace {

using Vector = std::array<double, 3>;
using Matrix = std::array<Vector, 3>;

struct Body {
  Vector centre;
  Matrix shape;  // R diag(r^2) R'
};

Matrix rotation(std::array<double, 4> q) {
  double square = 0;
  for (const double v : q) square += v * v;
  for (double& v : q) v /= std::sqrt(square);
  const double w = -q[0], x = q[1], y = q[2], z = q[3];
  return {{{1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)},
           {2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)},
           {2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)}}};
}

Body body(const std::map<std::string, double>& row, const std::string& who) {
  const auto cell = [&](const char* name) { return row.at(who + name); };
  const Matrix r = rotation({cell(".qw"), cell(".qx"), cell(".qy"), cell(".qz")});
  const Vector axes{cell(".r1"), cell(".r2"), cell(".r3")};
  Body one{{cell(".x"), cell(".y"), cell(".z")}, {}};
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      for (std::size_t k = 0; k < 3; ++k) one.shape[i][j] += r[i][k] * axes[k] * axes[k] * r[j][k];
    }
  }
  return one;
}

// d' M^-1 d, by cofactors.
double inverse_form(const Matrix& m, const Vector& d) {
  Matrix cofactors;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      const std::size_t a = (i + 1) % 3, b = (i + 2) % 3, c = (j + 1) % 3, e = (j + 2) % 3;
      cofactors[i][j] = m[a][c] * m[b][e] - m[a][e] * m[b][c];
    }
  }
  double det = 0, form = 0;
  for (std::size_t j = 0; j < 3; ++j) det += m[0][j] * cofactors[0][j];
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) form += d[i] * cofactors[i][j] * d[j];
  }
  return form / det;
}

double potential(const Body& a, const Body& b, double t) {
  Matrix m;
  Vector d;
  for (std::size_t i = 0; i < 3; ++i) {
    d[i] = b.centre[i] - a.centre[i];
    for (std::size_t j = 0; j < 3; ++j) m[i][j] = (1 - t) * a.shape[i][j] + t * b.shape[i][j];
  }
  return t * (1 - t) * inverse_form(m, d);
}

bool overlap(const Body& a, const Body& b) {
  double low = 0, high = 1;
  for (int i = 0; i < 100; ++i) {  // the potential is concave
    const double left = low + 0.382 * (high - low), right = low + 0.618 * (high - low);
    (potential(a, b, left) < potential(a, b, right) ? low : high) =
        potential(a, b, left) < potential(a, b, right) ? left : right;
  }
  return potential(a, b, (low + high) / 2) < 1;
}

}  // namespace

int main() {
  std::string line, cell;
  std::getline(std::cin, line);
  std::istringstream header(line);
  std::array<std::string, 20> names;
  for (std::string& name : names) std::getline(header, name, ',');
  std::puts("row,overlaps");
  for (int row = 0; std::getline(std::cin, line); ++row) {
    std::istringstream cells(line);
    std::map<std::string, double> numbers;
    for (const std::string& name : names) {
      std::getline(cells, cell, ',');
      numbers[name] = std::strtod(cell.c_str(), nullptr);
    }
    std::printf("%d,%d\n", row, overlap(body(numbers, "a"), body(numbers, "b")) ? 1 : 0);
  }
}
