// SPDX-License-Identifier: MIT
#include <tangency/geometry/ray.hpp>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <optional>
#include <utility>

#include <tangency/geometry/bodies/rational_solid.hpp>
#include <tangency/geometry/bodies/ray_form.hpp>
#include <tangency/geometry/bodies/surface_projection.hpp>
#include <tangency/geometry/numbers/floating_point_environment.hpp>
#include <tangency/geometry/power_of_two.hpp>

namespace tangency::inline v0 {
namespace {

using detail::DoubleDouble;
using detail::DoubleDoubleMatrix;
using detail::DoubleDoubleVector;

constexpr double kEpsilon = detail::kDoubleDoubleEpsilon;
// docs/derivations/primitives.md, section 4.
constexpr double kTurned = 64 * kEpsilon;
constexpr double kCrossed = 8 * kEpsilon;
constexpr double kSquared = 16 * kEpsilon;
constexpr double kBeyond = 16.0;      // as seen: no hit has a t beyond it
constexpr double kFarMiss = 0x1p-40;  // chosen: far above the rounding of the double test, 2^-49

/// The line z + t v in the coordinates that make the body the unit ball, and how far it is off.
struct UnitBallLine {
  DoubleDoubleVector z, v;
  double dz[3], dv[3];        ///< bounds of their errors
  DoubleDoubleVector moment;  ///< z x v
  DoubleDouble discriminant;  ///< |v|^2 - |z x v|^2: > 0 where the line meets the ball's interior
  double error;               ///< a bound of its error
};

/// Is the line proven to miss the sphere around the body? Lengths as seen, direction in [1, 2).
bool passes_far(const detail::SeenFromCentre& seen, const Vec3& direction) {
  const Vec3 d = detail::rounded(seen.separation);
  const double reach = seen.semi_axes.maxCoeff() * direction.norm();
  return d.cross(direction).norm() - reach > kFarMiss * d.norm() * direction.norm();
}

UnitBallLine unit_ball_line(const detail::SeenFromCentre& seen, const DoubleDoubleMatrix& rotation,
                            const Vec3& direction) {
  UnitBallLine line{turned_back(rotation, seen.separation),
                    turned_back(rotation, detail::exactly(direction)),
                    {},
                    {},
                    {},
                    {},
                    0.0};
  const double distance = detail::rounded(seen.separation).norm(), speed = direction.norm();
  double z[3], v[3];  // absolute values
  for (std::size_t i = 0; i < 3; ++i) {
    const double a = seen.semi_axes[static_cast<int>(i)];
    line.z[i] = line.z[i] / DoubleDouble(a);
    line.v[i] = line.v[i] / DoubleDouble(a);
    z[i] = std::abs(line.z[i].high),
    line.dz[i] = (kTurned * distance + detail::kLeastComponent) / a;
    v[i] = std::abs(line.v[i].high), line.dv[i] = kTurned * speed / a;
  }
  DoubleDoubleVector& x = line.moment;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
    x[i] = line.z[j] * line.v[k] - line.z[k] * line.v[j];
    const double dx = line.dz[j] * v[k] + (z[j] + line.dz[j]) * line.dv[k] + line.dz[k] * v[j] +
                      (z[k] + line.dz[k]) * line.dv[j] + kCrossed * (z[j] * v[k] + z[k] * v[j]);
    line.error += (2.0 * std::abs(x[i].high) + dx) * dx + (2.0 * v[i] + line.dv[i]) * line.dv[i];
  }
  const DoubleDouble vv = detail::dot(line.v, line.v), xx = detail::dot(x, x);
  line.discriminant = vv - xx;
  line.error += kSquared * (vv.high + xx.high);
  return line;
}

/// The sign of a number that is within `error` of the value; 0 where that does not tell.
int certain_sign(double value, double error) { return value > error ? 1 : value < -error ? -1 : 0; }

/// The body that is asked about: the ellipsoid or, where it is given by a matrix, the exact one.
struct AskedBody {
  const Ellipsoid& ellipsoid;
  const exact::RationalSolid<3>* exact = nullptr;
};

/// The line and the ball in both arithmetics. Units of length and of the direction are powers of
/// two: t is the caller's, 2^exponent times that of the unit ball's line.
class Chord {
 public:
  /// @param in_integers  is the line that of another body than the one that is asked about?
  Chord(const AskedBody& body, const Ray& ray, const UnitBallLine& line, int exponent,
        bool in_integers)
      : body_(body), ray_(ray), line_(line), exponent_(exponent) {
    sign_ = in_integers ? 0 : certain_sign(line.discriminant.high, line.error);
    if (sign_ == 0) sign_ = integers().discriminant_sign();
    filtered_ = !in_integers;
  }

  /// Of the discriminant, exact.
  int sign() const { return sign_; }

  /// -2 before the first hit, -1 at it, 0 between, 1 at the second, 2 after it. For a tangent -2,
  /// 0 at its touch, 2. Exact.
  int place_of(double t) {
    const double scaled = std::scalbn(t, -exponent_);
    if (std::abs(scaled) > kBeyond) return t < 0.0 ? -2 : 2;
    const auto [level, slope] =
        sign_ == 0 ? Signs{1, integers().slope_sign(t)} : signs_at(t, scaled);
    return level < 0 ? 0 : level == 0 ? slope : 2 * slope;
  }

  struct Hit {
    DoubleDouble t;  ///< of the unit ball's line
    Vec3 normal;
  };
  /// @param side  -1, 1, or 0 for a tangent
  Hit hit(int side, const detail::SeenFromCentre& seen, const DoubleDoubleMatrix& rotation) {
    if (form_) {
      const auto [t, normal] = form_->hit(side, exponent_);
      return {t, normal};
    }
    // The nearest point of the line to the centre, v x (z x v) / |v|^2, and what is left of 1 along
    // v: of unit length whatever the origin's distance.
    const DoubleDoubleVector &v = line_.v, &x = line_.moment;
    const DoubleDouble square = detail::dot(v, v), root = sqrt(line_.discriminant);
    const DoubleDouble half = DoubleDouble(side) * root;
    DoubleDoubleVector gradient;
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
      gradient[i] = (v[j] * x[k] - v[k] * x[j] + half * v[i]) /
                    (square * DoubleDouble(seen.semi_axes[static_cast<int>(i)]));
    }
    const DoubleDoubleVector normal = DoubleDouble(1.0) / detail::length(gradient) * gradient;
    return {(half - detail::dot(line_.z, v)) / square, detail::rounded(turned(rotation, normal))};
  }

 private:
  /// Of the level |z + t v|^2 - 1 and of its derivative.
  struct Signs {
    int level, slope;
  };

  Signs signs_at(double t, double scaled) {
    const Signs signs = filtered_ ? filtered_signs(scaled) : Signs{0, 0};
    if (signs.level < 0 || signs.level * signs.slope != 0) return signs;
    return {integers().level_sign(t), integers().slope_sign(t)};
  }

  Signs filtered_signs(double t) const {
    DoubleDouble level(-1.0), slope;
    double of_level = kSquared, of_slope = 0.0;  // bounds of their errors
    for (std::size_t i = 0; i < 3; ++i) {
      const DoubleDouble step = DoubleDouble(t) * line_.v[i], w = line_.z[i] + step;
      const double v = std::abs(line_.v[i].high), size = std::abs(w.high);
      const double dw = line_.dz[i] + std::abs(t) * line_.dv[i] +
                        kCrossed * (std::abs(line_.z[i].high) + std::abs(step.high));
      level = level + w * w, slope = slope + w * line_.v[i];
      of_level += (2.0 * size + dw) * dw + kSquared * size * size;
      of_slope += dw * v + (size + dw) * line_.dv[i] + kSquared * size * v;
    }
    return {certain_sign(level.high, of_level), certain_sign(slope.high, of_slope)};
  }

  const exact::RayForm& integers() {
    if (!form_ && body_.exact != nullptr)
      form_.emplace(*body_.exact, body_.ellipsoid, ray_.origin, ray_.direction);
    if (!form_) form_.emplace(body_.ellipsoid, ray_.origin, ray_.direction);
    return *form_;
  }

  const AskedBody& body_;
  const Ray& ray_;
  const UnitBallLine& line_;
  int exponent_, sign_;
  bool filtered_ = false;
  std::optional<exact::RayForm> form_;
};

RayHit found_hit(const AskedBody& asked, const Ray& ray, double t_begin, double t_end) {
  const Ellipsoid& body = asked.ellipsoid;
  assert(ray.origin.allFinite() && ray.direction.allFinite() && ray.direction != Vec3::Zero());
  assert(t_begin <= t_end);
  RayHit hit{
      RayStatus::miss, 0, {{0.0, Vec3::Zero(), Vec3::Zero()}, {0.0, Vec3::Zero(), Vec3::Zero()}}};
  const detail::SeenFromCentre seen = detail::seen_from_centre(body, ray.origin);
  const int turn = exponent_of(ray.direction);
  const Vec3 direction = scaled_by_power(ray.direction, -turn);
  const bool is_rounded = asked.exact != nullptr;
  if (!is_rounded && passes_far(seen, direction)) return hit;

  const DoubleDoubleMatrix rotation = detail::double_double_rotation(body.orientation());
  const UnitBallLine line = unit_ball_line(seen, rotation, direction);
  Chord chord(asked, ray, line, seen.exponent - turn,
              is_rounded || seen.semi_axes.minCoeff() <= detail::kThinnestAxisSeen);
  if (chord.sign() < 0) return hit;

  const int begin = chord.place_of(t_begin), end = chord.place_of(t_end);
  const auto consider = [&](int side) {
    if (begin > side || end < side) return;
    auto [t, normal] = chord.hit(side, seen, rotation);
    // An end that is the hit itself, and one that its rounding would pass.
    double rounded = std::clamp(std::scalbn(t.high, seen.exponent - turn), t_begin, t_end);
    for (const auto& [place, at] : {std::pair(begin, t_begin), std::pair(end, t_end)}) {
      if (place == side) rounded = at, t = std::scalbn(at, turn - seen.exponent);
    }
    const Vec3 arm =
        detail::rounded(seen.separation + t * detail::exactly(direction)).unaryExpr([&](double x) {
          return std::scalbn(x, seen.exponent);
        });
    hit.points[hit.count++] = {rounded, arm, normal};
  };
  if (chord.sign() == 0) {
    consider(0);
  } else {
    consider(-1);
    consider(1);
  }
  if (hit.count > 0) hit.status = chord.sign() > 0 ? RayStatus::hit : RayStatus::grazing;
  return hit;
}

}  // namespace

RayHit intersect(const Ellipsoid& body, const Ray& ray, double t_begin, double t_end) noexcept {
  return in_default_environment([&] { return found_hit({body}, ray, t_begin, t_end); });
}

RayHit intersect(const MatrixEllipsoid& body, const Ray& ray, double t_begin,
                 double t_end) noexcept {
  return in_default_environment([&] {
    return found_hit({body.ellipsoid(), body.exact()}, ray, t_begin, t_end);
  });
}

RayHit intersect_from_centre(const Ellipsoid& body, const Vec3& separation, const Vec3& direction,
                             double t_begin, double t_end) noexcept {
  return intersect(body.moved_to(Vec3::Zero()), Ray{separation, direction}, t_begin, t_end);
}

}  // namespace tangency::inline v0
