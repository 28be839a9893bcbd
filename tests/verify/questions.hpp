// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// What the parts of question_agreement share: the draws, and the tally of one kind of question.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <optional>
#include <random>

#include <tangency/geometry/floating_point.hpp>
#include <tangency/geometry/vectors.hpp>

namespace tangency::questions {

/// Reproducible across standard libraries.
class Source {
 public:
  explicit Source(std::uint64_t seed) : random_(seed) {}

  double uniform(double low, double high) {
    return low + (high - low) * (static_cast<double>(random_() >> 11) * kUnitRoundoff);
  }
  double log_uniform(double low, double high) {
    return std::exp(uniform(std::log(low), std::log(high)));
  }
  int below(int n) { return static_cast<int>(random_() % static_cast<std::uint64_t>(n)); }
  int whole(int most) { return below(2 * most + 1) - most; }
  Vec3 wholes(int most) {
    for (;;) {
      const Vec3 v(whole(most), whole(most), whole(most));
      if (v != Vec3::Zero()) return v;
    }
  }
  Vec3 direction() {
    for (;;) {
      const Vec3 v(uniform(-1, 1), uniform(-1, 1), uniform(-1, 1));
      if (v.norm() > 0.01 && v.norm() <= 1) return v.normalized();
    }
  }
  /// Symmetric to the bit, with eigenvalues of a ratio to 1e12 and any size.
  std::optional<Mat3> definite(double size) {
    const Vec3 u = direction(), v = u.cross(direction()).normalized();
    Mat3 r;
    r << u, v, u.cross(v);
    const double ratio = log_uniform(1, 1e6);
    const Vec3 roots(1, log_uniform(1 / ratio, 1), 1 / ratio);
    Mat3 m = size * r * roots.cwiseProduct(roots).asDiagonal() * r.transpose();
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < i; ++j) m(i, j) = m(j, i);
    }
    return m;
  }

 private:
  std::mt19937_64 random_;
};

struct Tally {
  const char* what;
  long asked = 0, special = 0, wrong = 0;
  double worst = 0.0;  ///< error over its bound

  void see(bool kept, double share) {
    ++asked, wrong += !kept || !(share <= 1.0), worst = std::max(worst, share);
  }
  bool print(const char* of_special, long least) const {
    std::printf("%-28s %8ld, %8ld %-18s %ld wrong, %.3f of the bound at most\n", what, asked,
                special, of_special, wrong, worst);
    return wrong == 0 && special >= least && asked > 0;
  }
};

/// Of a number of many digits.
template <class Digits>
double share_of(const Digits& error, double bound) {
  if (error == 0) return 0.0;
  return bound > 0.0 ? static_cast<double>(Digits(abs(error) / bound)) : 2.0;
}

// Bodies inside bodies: containment_questions.cpp. Each holds so many inputs against the oracle and
// prints what it saw.
bool check_clearances(Source& source, long count);
bool check_margins(Source& source, long count);
bool check_plane_clearances(Source& source, long count);
bool check_plane_margins(Source& source, long count);

}  // namespace tangency::questions
