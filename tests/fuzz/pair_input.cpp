// SPDX-License-Identifier: GPL-3.0-or-later
#include <tangency/tests/fuzz/pair_input.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <span>

#include <tangency/geometry/bounded_gap.hpp>
#include <tangency/geometry/tables/csv.hpp>
#include <tangency/tests/fuzz/mutate.hpp>
#include <tangency/verify/families/conversions.hpp>
#include <tangency/verify/hunt/moves.hpp>

namespace tangency::testing::fuzz {
namespace {

constexpr std::array<std::string_view, 10> kNumbers{"x",  "y",  "z",  "r1", "r2",
                                                    "r3", "qw", "qx", "qy", "qz"};

std::array<double*, 20> numbers_of(verify::EllipsoidPair& pair) {
  std::array<double*, 20> numbers{};
  std::size_t k = 0;
  for (verify::RawEllipsoid* body : {&pair.a, &pair.b}) {
    for (double& x : body->centre) numbers[k++] = &x;
    for (double& x : body->semi_axes) numbers[k++] = &x;
    for (double& x : body->orientation) numbers[k++] = &x;
  }
  return numbers;
}

bool is_body(const verify::RawEllipsoid& raw) {
  const auto& [c, r, q] = raw;
  return !Ellipsoid::find_fault({c[0], c[1], c[2]}, {r[0], r[1], r[2]},
                                Quaternion(q[0], q[1], q[2], q[3]));
}

verify::Nearness nearness_of(const Bodies& bodies) {
  verify::Nearness near;
  const Vec3 d = bodies.b.centre() - bodies.a.centre();
  if (!d.allFinite()) return near;
  const BoundedGap gap = bounded_gap(bodies.a, bodies.b);
  if (!gap.normal.allFinite() || !std::isfinite(gap.gap)) return near;
  near.normal = {gap.normal[0], gap.normal[1], gap.normal[2]};
  near.gap = gap.gap;
  near.size = d.stableNorm() + bodies.a.largest_semi_axis() + bodies.b.largest_semi_axis();
  return near;
}

/// Rows of a table of pairs, spread over it, up to `most`.
void add_rows(const std::string& path, std::size_t most,
              std::vector<verify::EllipsoidPair>& pairs) {
  const std::string text = source_file(path);
  tables::Reader reader(tables::NamedText{path, text});
  std::vector<verify::EllipsoidPair> all;
  tables::for_each_row(reader, [&](const tables::RowCursor& row) {
    verify::EllipsoidPair& pair = all.emplace_back();
    const auto numbers = numbers_of(pair);
    for (std::size_t k = 0; k < numbers.size(); ++k) {
      const std::string body = k < kNumbers.size() ? "a." : "b.";
      const auto column = reader.header().require(body + std::string(kNumbers[k % 10]));
      *numbers[k] = row.number(column);
    }
  });
  const std::size_t step = std::max<std::size_t>(1, all.size() / most);
  for (std::size_t i = 0; i < all.size(); i += step) pairs.push_back(all[i]);
}

}  // namespace

verify::EllipsoidPair pair_of(Bytes input) {
  verify::EllipsoidPair pair{};
  const auto numbers = numbers_of(pair);
  for (std::size_t k = 0; k < numbers.size(); ++k) {
    const Bytes rest = input.subspan(std::min(input.size(), k * sizeof(double)));
    std::memcpy(numbers[k], rest.data(), std::min(rest.size(), sizeof(double)));
  }
  return pair;
}

void write_pair(const verify::EllipsoidPair& pair, std::uint8_t* to) {
  verify::EllipsoidPair copy = pair;
  for (const double* x : numbers_of(copy)) {
    std::memcpy(to, x, sizeof *x);
    to += sizeof *x;
  }
}

std::string row_of(const verify::EllipsoidPair& pair) {
  verify::EllipsoidPair copy = pair;
  std::string row;
  for (const double* x : numbers_of(copy)) {
    char number[40];
    std::snprintf(number, sizeof number, row.empty() ? "%a" : ",%a", *x);
    row += number;
  }
  return row;
}

std::optional<Bodies> bodies_of(const verify::EllipsoidPair& pair) {
  if (!is_body(pair.a) || !is_body(pair.b)) return std::nullopt;
  return Bodies{verify::to_ellipsoid(pair.a), verify::to_ellipsoid(pair.b)};
}

void move_pair(verify::EllipsoidPair& pair, verify::Draw& draw) {
  const std::span<const verify::Move> moves = verify::moves();
  // The first makes a near touch: as often as all others.
  const int last = static_cast<int>(moves.size()) - 1;
  const int which = draw.coin() ? 0 : draw.integer(1, last);
  const std::optional<Bodies> bodies = bodies_of(pair);
  const verify::Nearness near = bodies ? nearness_of(*bodies) : verify::Nearness();
  moves[static_cast<std::size_t>(which)].change(draw, pair, near);
}

void mutate_pair(verify::EllipsoidPair& pair, std::uint64_t seed) {
  std::uint64_t state = seed;
  for (std::size_t turns = 1 + below(state, 3); turns > 0; --turns) {
    if (below(state, 8) == 0) {
      double& number = *numbers_of(pair)[below(state, 20)];
      number = mutated(number, state);
    } else {
      verify::Draw draw(next(state));
      move_pair(pair, draw);
    }
  }
}

std::vector<verify::EllipsoidPair> seed_pairs() {
  std::vector<verify::EllipsoidPair> pairs;
  for (const char* name : {"classes", "deep", "extreme", "near", "nested", "symmetric", "touching"})
    add_rows("verify/corpora/" + std::string(name) + ".csv", 6, pairs);
  add_rows("tests/data/regressions/pairs.csv", 1000, pairs);
  return pairs;
}

}  // namespace tangency::testing::fuzz
