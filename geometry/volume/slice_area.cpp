// SPDX-License-Identifier: MIT
#include <tangency/geometry/volume/slice_area.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>

#include <tangency/geometry/numbers/arc_tangent.hpp>

namespace tangency::inline v0::detail {
namespace {

struct Node {
  double at, weight;
};
// Positive zeros of Legendre polynomials and their weights, rounded from 60 digits.
constexpr std::array<Node, 4> kEight{{{0x1.77ac94f3c7345p-3, 0x1.736360b199343p-2},
                                      {0x1.0d129583284b4p-1, 0x1.413c50a255615p-2},
                                      {0x1.97e4ab249f41ep-1, 0x1.c76fb531d2b96p-3},
                                      {0x1.ebab1cb0acc67p-1, 0x1.9ea1d04ca0374p-4}}};
constexpr std::array<Node, 6> kTwelve{{{0x1.007a5f8f630e4p-3, 0x1.fe40ce6d4f025p-3},
                                       {0x1.78a8d20a8b19dp-2, 0x1.de3155c256ab5p-3},
                                       {0x1.2cb4f05c077f9p-1, 0x1.a0163e6b1ab72p-3},
                                       {0x1.8a30aeed88f36p-1, 0x1.47d7258f22d8fp-3},
                                       {0x1.cee874ffb88b4p-1, 0x1.b60602bce6181p-4},
                                       {0x1.f68f1d8e42e81p-1, 0x1.8275d9dea6d8fp-5}}};
constexpr std::array<Node, 8> kSixteen{{{0x1.852bd6676a9f9p-4, 0x1.83feae80e4dfcp-3},
                                        {0x1.205cae642337cp-2, 0x1.75f8c77e0c00fp-3},
                                        {0x1.d50259a43a772p-2, 0x1.5a6ebbb5a75fcp-3},
                                        {0x1.3c5a466d5e8b8p-1, 0x1.325f61bca3cbfp-3},
                                        {0x1.82c45dda4726bp-1, 0x1.fe7af2bad386ap-4},
                                        {0x1.bb3403514e483p-1, 0x1.85c4ee79cc258p-4},
                                        {0x1.e39f56616f9b0p-1, 0x1.fdfb1a2c1265dp-5},
                                        {0x1.fa92c264d787ep-1, 0x1.bcddab4b7c211p-6}}};
constexpr std::array<Node, 10> kTwenty{{{0x1.3973df98b86b0p-4, 0x1.38d6c490a3370p-3},
                                        {0x1.d281636928bc0p-3, 0x1.31819b52c5992p-3},
                                        {0x1.7eaccf15652c4p-2, 0x1.230348f34a535p-3},
                                        {0x1.05905c13f7ff7p-1, 0x1.0db2c5db26dffp-3},
                                        {0x1.45a8d3fa710dbp-1, 0x1.e41ff31573b48p-4},
                                        {0x1.7e1f37346a54ep-1, 0x1.a1817a317a821p-4},
                                        {0x1.ada0bd5efd6e7p-1, 0x1.5519fe196e24ap-4},
                                        {0x1.d31064173fd92p-1, 0x1.00b467df7e475p-4},
                                        {0x1.ed8dba7bd769fp-1, 0x1.4c9b5ea53b67fp-5},
                                        {0x1.fc7b5a0c71ce0p-1, 0x1.209680274e8afp-6}}};
constexpr std::array<std::span<const Node>, 4> kRules{kEight, kTwelve, kSixteen, kTwenty};

/// A Bernstein ellipse: the sum of its semi-axes, the larger of them, and 1/rho^(2N - 1) for the
/// rules.
struct Bernstein {
  double rho, reach;
  std::array<double, 4> falls;
};
constexpr Bernstein bernstein(double rho) {
  Bernstein e{rho, 0.5 * (rho + 1.0 / rho), {}};
  double power = 1.0;
  int n = 0;
  for (std::size_t k = 0; k < kRules.size(); ++k) {
    for (const int odd = 2 * (8 + 4 * static_cast<int>(k)) - 1; n < odd; ++n) power /= rho;
    e.falls[k] = power;
  }
  return e;
}
// Chosen: a wide ellipse takes fewer sections, a narrow one fewer ranges.
constexpr std::array<Bernstein, 3> kEllipses{bernstein(6.0), bernstein(4.0), bernstein(2.5)};

// In units of u: section 6.
constexpr double kOfCoefficients = 14.0 * kUnitRoundoff;  // and Horner's rule, and the node
constexpr double kOfSection = 80.0 * kUnitRoundoff;       // of a sum of areas

/// angle - sine cosine, for an angle in [0, pi].
double segment(double angle, double sine_cosine) {
  const double t = 2.0 * angle;
  if (t > 2.0) return angle - sine_cosine;
  // (t - sin t) / 2 by its series, to below rounding at t = 2.
  const double square = t * t;
  double sum = 1.0;
  for (int n = 24; n >= 4; n -= 2) sum = 1.0 - square * sum / (n * (n + 1.0));
  return t * square * sum / 12.0;
}

/// |angle - sine cosine| for complex angles up to `angle`.
double most_segment(double angle, double sine_cosine) {
  return angle <= 1.0 ? angle * angle * angle : angle + sine_cosine;
}

/// Sections at one height.
struct Section {
  double area;    ///< r_1^2 (angle - sine cosine) of the ball's segment, and that of the second
  double angle;   ///< of the ball's
  double root_p;  ///< sqrt(P)
};
Section section(const SliceExpansion& e, double v, double p) {
  const double root = std::sqrt(p), q1 = e.q1(v), q2 = e.q2(v);
  const double first = angle_of(root, q1), second = angle_of(root, q2);
  const double area = e.ball(v) * segment(first, root * q1 / (q1 * q1 + p)) +
                      e.second(v) * segment(second, root * q2 / (q2 * q2 + p));
  return {area, first, root};
}

/// Sums of a rule: of the area, of the angle, of z times it, of the chord along the line of
/// centres.
struct Sums {
  double area = 0.0, angle = 0.0, moment = 0.0, x = 0.0, y = 0.0, of_chord = 0.0;
};
void add(Sums& sums, const SliceExpansion& e, double v, double p, double weight) {
  const Section s = section(e, v, p);
  const double z = e.base + e.step * v, x = e.x(v);
  const double chord = weight * s.root_p / e.distance(v);
  sums.area += weight * s.area;
  sums.moment += weight * z * s.angle;
  sums.angle += weight * s.angle;
  sums.x += chord * x, sums.y += chord * e.y;
  sums.of_chord += chord * (std::abs(e.x.c[0]) + std::abs(e.x.c[1]) + std::abs(e.y));
}

Sums sums_of(const SliceExpansion& e, SliceRange range, std::span<const Node> rule) {
  Sums sums;
  const SlicePolynomial<4> deflated = e.p.deflated();
  for (const auto& [at, weight] : rule) {
    for (const double t : {-at, at}) {
      if (range == SliceRange::about_middle) {
        add(sums, e, t, e.p(t), weight);
      } else {
        const double root = 0.5 + 0.5 * t, v = root * root;
        add(sums, e, v, v * deflated(v), weight * root);
      }
    }
  }
  return sums;
}

/// What the integrands come to at most on the ellipse in t, their dz/dt included.
struct Majorants {
  double area, moment, chord;
};
Majorants majorants(const SliceExpansion& e, SliceRange range, const SliceBounds& b, double root,
                    double reach) {
  const bool middle = range == SliceRange::about_middle;
  const double step = std::abs(e.step) * (middle ? 1.0 : root);
  const double p_here = middle ? e.p.c[0] : 0.0, root_p = std::sqrt(b.p) * (middle ? 1.0 : root);
  const double way = middle ? reach : root;
  const double angle_1 = angle_of(std::sqrt(p_here), e.q1.c[0]) + way * b.rate_1;
  const double angle_2 = angle_of(std::sqrt(p_here), e.q2.c[0]) + way * b.rate_2;
  const double segments = b.ball * most_segment(angle_1, root_p * b.q1 / b.least_1) +
                          b.second * most_segment(angle_2, root_p * b.q2 / b.least_2);
  const double z = std::abs(e.base) + std::abs(e.step) * (middle ? reach : root * root);
  const double centre = e.x.most(middle ? reach : root * root) + std::abs(e.y);
  return {step * segments, step * 2.0 * z * angle_1, step * root_p * centre / b.least_distance};
}

/// How far sections are off the true ones, integrated over the range.
struct SectionErrors {
  double area, gradient;
};
SectionErrors section_errors(const SliceExpansion& e, SliceRange range) {
  const SliceBounds b(e, range, 1.0);
  const double length = std::abs(e.step) * (range == SliceRange::about_middle ? 2.0 : 1.0);
  const double of_ball = kOfCoefficients * 3.0 * b.ball + e.of_square;
  const double of_second = kOfCoefficients * 3.0 * b.second + e.of_square;
  const double of_q1 = kOfCoefficients * 3.0 * b.q1 + e.of_square;
  const double of_q2 = kOfCoefficients * 3.0 * b.q2 + e.of_square;
  const double off_p = kOfCoefficients * 5.0 * b.p + discriminant_error(e, range);
  const double root_p = std::sqrt(b.p + off_p), of_root = 2.0 * off_p / std::sqrt(b.least_p);
  const double root_here = range == SliceRange::about_middle ? std::sqrt(e.p.c[0]) : 0.0;
  const double base_1 = angle_of(root_here, e.q1.c[0]), base_2 = angle_of(root_here, e.q2.c[0]);
  const double most_1 = std::min(kPi, base_1 + b.rate_1), most_2 = std::min(kPi, base_2 + b.rate_2);
  const double area = most_segment(most_1, most_1) * of_ball +
                      most_segment(most_2, most_2) * of_second +
                      2.0 * root_p *
                          (b.ball * (b.q1 * off_p + b.p * of_q1) / (b.least_1 * b.least_1) +
                           b.second * (b.q2 * off_p + b.p * of_q2) / (b.least_2 * b.least_2));
  const double of_angle = (b.q1 * of_root + root_p * of_q1) / b.least_1;
  const double z = std::abs(e.base) + std::abs(e.step);
  const double of_x = kOfCoefficients * e.x.most(1.0) + e.of_x;
  const double of_distance = kOfCoefficients * 3.0 * b.distance + e.of_square;
  const double root_distance = std::sqrt(b.least_distance);
  const double chord =
      of_root / root_distance + root_p * (of_x + of_distance / root_distance) / b.least_distance;
  return {length * area, length * (2.0 * z * of_angle + chord)};
}

}  // namespace

SliceBounds::SliceBounds(const SliceExpansion& e, SliceRange range, double r) noexcept
    : ball(e.ball.most(r)),
      second(e.second.most(r)),
      distance(e.distance.most(r)),
      q1(e.q1.most(r)),
      q2(e.q2.most(r)),
      least_distance(e.distance.least(r)) {
  constexpr double kRounding = 24.0 * kUnitRoundoff;
  const SlicePolynomial<4> deflated = e.p.deflated();
  double p_whole, root, slope_p;  // |P|; sqrt(P), times dv / d sqrt(v) from a touch; d sqrt(P)
  if (range == SliceRange::about_middle) {
    p = p_whole = e.p.most(r), least_p = e.p.least(r) - e.of_p - kRounding * p;
    root = std::sqrt(p), slope_p = 0.5 * e.p.derivative().most(r) / std::sqrt(least_p);
  } else {
    p = deflated.most(r), p_whole = r * p, least_p = deflated.least(r) - kRounding * p;
    root = 2.0 * r * std::sqrt(p);
    slope_p = std::sqrt(p) + r * deflated.derivative().most(r) / std::sqrt(least_p);
  }
  const double off_p = discriminant_error(e, range);
  const auto least_of = [&](double most_radius, double least_radius, double most_q) {
    const double off = kRounding * (4.0 * distance * most_radius + most_q * most_q + p_whole) +
                       4.0 * off_p + 4.0 * most_q * e.of_square;
    if (!(least_distance > 0.0) || !(least_radius > 0.0)) return -1.0;
    return 4.0 * least_distance * least_radius - off;
  };
  least_1 = least_of(ball, e.ball.least(r), q1);
  least_2 = least_of(second, e.second.least(r), q2);
  rate_1 = (slope_p * q1 + e.q1.derivative().most(r) * root) / least_1;
  rate_2 = (slope_p * q2 + e.q2.derivative().most(r) * root) / least_2;
}

double discriminant_error(const SliceExpansion& e, SliceRange range) noexcept {
  return e.of_p + (range == SliceRange::from_touch ? std::abs(e.p.c[0]) : 0.0);
}

std::optional<SliceShare> crossing_share(const SliceExpansion& e, SliceRange range,
                                         double volume_budget, double gradient_budget) noexcept {
  for (const Bernstein& ellipse : kEllipses) {
    const double root = 0.5 * (1.0 + ellipse.reach);
    const double r = range == SliceRange::about_middle ? ellipse.reach : root * root;
    const SliceBounds bounds(e, range, r);
    if (!bounds.regular()) continue;
    const Majorants most = majorants(e, range, bounds, root, ellipse.reach);
    for (std::size_t k = 0; k < kRules.size(); ++k) {
      const double share = 8.1 * ellipse.falls[k] / (ellipse.rho - 1.0);
      const double of_volume = share * most.area, of_gradient = share * (most.moment + most.chord);
      if (!(of_volume <= volume_budget) || !(of_gradient <= gradient_budget)) continue;
      const Sums sums = sums_of(e, range, kRules[k]);
      const SectionErrors errors = section_errors(e, range);
      const double step = std::abs(e.step), far = std::abs(e.base) + step;
      SliceShare result;
      result.volume = step * sums.area;
      result.volume_error = 1.01 * (of_volume + errors.area) + kOfSection * result.volume;
      result.gradient = -step * Vec3(sums.x, sums.y, 2.0 * sums.moment);
      result.gradient_error = 1.01 * (of_gradient + errors.gradient) +
                              kOfSection * step * (2.0 * far * sums.angle + sums.of_chord);
      result.surface = 2.0 * step * sums.angle;
      result.slices = 2 * static_cast<int>(kRules[k].size());
      return result;
    }
  }
  return std::nullopt;
}

}  // namespace tangency::inline v0::detail
