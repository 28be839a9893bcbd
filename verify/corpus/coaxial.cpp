// SPDX-License-Identifier: GPL-3.0-or-later
#include <tangency/verify/corpus/coaxial.hpp>

#include <algorithm>
#include <cstddef>

#include <tangency/verify/oracles/newton_ascent.hpp>

namespace tangency::inline v0::verify {
namespace {

using ascent::dot;

// Chosen: two thirds of the digits; stored doubles that are not parallel differ by far more.
const Real kParallel("1e-100");
// Chosen: values of f that agree to this share of the size tie.
const Real kTie("1e-120");

bool parallel(const Real3& u, const Real3& v) {
  const Real3 across = ascent::cross(u, v);
  return dot(across, across) <= kParallel * kParallel * dot(u, u) * dot(v, v);
}

bool is_sphere(const Shape<Real>& body) {
  return body.semi_axes[0] == body.semi_axes[1] && body.semi_axes[1] == body.semi_axes[2];
}

// The index of the axis of revolution of a body that is no sphere.
std::optional<std::size_t> revolution(const Shape<Real>& body) {
  for (std::size_t k = 0; k < 3; ++k) {
    if (body.semi_axes[(k + 1) % 3] == body.semi_axes[(k + 2) % 3]) return k;
  }
  return std::nullopt;
}

struct Meridian {
  Real ee, k;  // e^2, p^2 - e^2

  Meridian(const Shape<Real>& body, std::size_t polar) {
    const Real &p = body.semi_axes[polar], &e = body.semi_axes[(polar + 1) % 3];
    ee = e * e;
    k = (p - e) * (p + e);
  }
  Real h(const Real& x) const { return sqrt(ee + k * x * x); }
};

struct Profile {
  Real distance;
  Meridian a, b;

  Real value(const Real& x) const { return distance * x - a.h(x) - b.h(x); }
  Real slope(const Real& x) const { return distance - a.k * x / a.h(x) - b.k * x / b.h(x); }
  // f'' at x, up to a positive factor, has the sign of this.
  Real bend(const Real& x) const {
    const Real ha = a.h(x), hb = b.h(x);
    return -a.k * a.ee / (ha * ha * ha) - b.k * b.ee / (hb * hb * hb);
  }
};

// Where f'' changes sign between 0 and 1.
std::optional<Real> inflection(const Profile& f) {
  if (f.a.k * f.b.k >= 0) return std::nullopt;
  const Real ratio = pow(Real(-f.a.k * f.a.ee / (f.b.k * f.b.ee)), Real(2) / 3);
  const Real square = (ratio * f.b.ee - f.a.ee) / (f.a.k - ratio * f.b.k);
  if (!(square > 0 && square < 1)) return std::nullopt;
  return sqrt(square);
}

Real concave_maximum(const Profile& f, Real low, Real high) {
  if (f.slope(low) <= 0) return low;
  if (f.slope(high) >= 0) return high;
  for (int step = 0; step < 500; ++step) {  // chosen: as many bits as a Real has
    const Real middle = (low + high) / 2;
    (f.slope(middle) > 0 ? low : high) = middle;
  }
  return low;
}

std::vector<Real> candidates(const Profile& f) {
  std::vector<Real> ends{0, 1};
  if (const auto x = inflection(f)) ends.insert(ends.begin() + 1, *x);
  std::vector<Real> at = ends;
  for (std::size_t i = 0; i + 1 < ends.size(); ++i) {
    if (f.bend((ends[i] + ends[i + 1]) / 2) < 0) {
      at.push_back(concave_maximum(f, ends[i], ends[i + 1]));
    }
  }
  return at;
}

// Unit, along the common axis; nothing where there is none.
std::optional<Real3> common_axis(const Separation<Real>& pair) {
  std::optional<Real3> axis;
  if (dot(pair.d, pair.d) > 0) axis = ascent::normalised(pair.d);
  for (const Shape<Real>* body : {&pair.a, &pair.b}) {
    if (is_sphere(*body)) continue;
    const auto k = revolution(*body);
    if (!k || (axis && !parallel(*axis, body->axes[*k]))) return std::nullopt;
    if (!axis) axis = body->axes[*k];
  }
  return axis ? axis : Real3{0, 0, 1};
}

}  // namespace

std::optional<CoaxialGap> coaxial_gap(const RealEllipsoid& a, const RealEllipsoid& b) {
  const Separation<Real> pair = separation(a, b);
  const auto axis = common_axis(pair);
  if (!axis) return std::nullopt;
  const auto polar = [](const Shape<Real>& body) { return revolution(body).value_or(0); };
  const Profile f{sqrt(dot(pair.d, pair.d)), Meridian(pair.a, polar(pair.a)),
                  Meridian(pair.b, polar(pair.b))};
  const bool every = f.distance == 0 && is_sphere(pair.a) && is_sphere(pair.b);
  const std::vector<Real> at = candidates(f);
  CoaxialGap found{f.value(1), *axis, {}, every};
  for (const Real& x : at) found.gap = std::max(found.gap, f.value(x));
  const Real tie = kTie * ascent::extent(pair);
  for (const Real& x : at) {
    for (const Real& cosine : {x, Real(-x)}) {
      // Twins: the same maximum found as an end and as a root.
      const auto same = [&](const Real& y) { return abs(y - cosine) < Real("1e-50"); };
      const bool best = f.value(cosine) >= found.gap - tie;
      if (best && std::ranges::none_of(found.cosines, same)) found.cosines.push_back(cosine);
    }
  }
  std::ranges::sort(found.cosines, std::ranges::greater());
  return found;
}

}  // namespace tangency::inline v0::verify
