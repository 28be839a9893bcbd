// SPDX-License-Identifier: GPL-3.0-or-later
// Usage: user [layout]
// A user of the libraries, compiled for one processor or another. Prints what the libraries answer,
// or the layout of their public types: neither may depend on what the user is compiled for.
#include <cstdint>
#include <cstdio>
#include <new>
#include <random>
#include <string_view>
#include <vector>

#include "layout.inc"

namespace {

using tangency::Ellipsoid;
using tangency::Vec3;

/// FNV-1a over the bits of numbers.
class Hash {
 public:
  template <class... Parts>
  void add(const Parts&... parts) {
    (add_all(parts), ...);
  }
  std::uint64_t value() const { return value_; }

 private:
  void add_all(double x) {
    const auto* bytes = reinterpret_cast<const unsigned char*>(&x);
    for (std::size_t i = 0; i < sizeof x; ++i) value_ = (value_ ^ bytes[i]) * 1099511628211u;
  }
  template <class Derived>
  void add_all(const Eigen::DenseBase<Derived>& m) {
    for (Eigen::Index j = 0; j < m.cols(); ++j) {
      for (Eigen::Index i = 0; i < m.rows(); ++i) add_all(m.coeff(i, j));
    }
  }
  std::uint64_t value_ = 14695981039346656037u;
};

/// Uniform numbers, the same for every compiler, also where it may contract: a volatile is rounded.
class Draw {
 public:
  double operator()(double low, double high) {
    const volatile double above = (high - low) * (static_cast<double>(random_() >> 11) * 0x1p-53);
    return low + above;
  }
  Vec3 vector(double low, double high) {
    const double x = (*this)(low, high), y = (*this)(low, high), z = (*this)(low, high);
    return {x, y, z};
  }

 private:
  std::mt19937_64 random_{20261130};
};

/// A quaternion as users have it, at every address that the smallest alignment of the type allows:
/// where a library and its user disagree on it, one address in two or four is wrong.
class QuaternionAnywhere {
 public:
  const Eigen::Quaterniond& operator()(int turn, double w, double x, double y, double z) {
    constexpr std::size_t kAlignment = alignof(Eigen::Quaterniond);
    const std::size_t place = kAlignment * (static_cast<std::size_t>(turn) % (64 / kAlignment));
    return *new (memory_ + place) Eigen::Quaterniond(w, x, y, z);
  }

 private:
  alignas(64) unsigned char memory_[128];
};

Ellipsoid body(Draw& draw, QuaternionAnywhere& anywhere, int turn, double spread) {
  const Vec3 centre = draw.vector(-spread, spread), semi_axes = draw.vector(0.02, 1.0);
  const double w = draw(-1, 1), x = draw(-1, 1), y = draw(-1, 1), z = draw(-1, 1);
  return {centre, semi_axes, anywhere(turn, w, x, y, z)};
}

void print_gaps() {
  Draw draw;
  QuaternionAnywhere anywhere;
  Hash bodies, gaps, derivatives, curvatures, quadrics;
  for (int i = 0; i < 400; ++i) {
    const Ellipsoid a = body(draw, anywhere, i, 1.0), b = body(draw, anywhere, i, 1.0);
    bodies.add(a.rotation(), a.bounding_box().min(), a.support(b.centre()));
    const tangency::Gap gap = tangency::signed_gap(a, b);
    const tangency::ContactBounds bounds = tangency::contact_bounds(a, b, gap);
    gaps.add(gap.gap, gap.gap_error, gap.normal, gap.arm_a, gap.arm_b, bounds.normal, bounds.arm_a);
    const Vec3 separation = b.centre() - a.centre();
    const auto slopes = tangency::gap_derivatives(a, b, separation, gap);
    derivatives.add(slopes.gradient, slopes.hessian);
    const auto at_contact = tangency::contact_curvature(a, b, gap.normal);
    for (const auto* c : {&at_contact.a, &at_contact.b, &at_contact.relative}) {
      curvatures.add(c->curvature[0], c->curvature[1], c->direction[0]);
    }
    const auto quadric = tangency::Quadric::from_ellipsoid(a);
    const auto moved = quadric.moved(anywhere(i + 1, 0.3, 0.5, -0.2, 0.7), b.centre());
    quadrics.add(quadric.discriminant(), moved.discriminant());
  }
  std::printf(
      "bodies %016jx\ngaps %016jx\nderivatives %016jx\ncurvatures %016jx\nquadrics %016jx\n",
      bodies.value(), gaps.value(), derivatives.value(), curvatures.value(), quadrics.value());
}

void print_plane_gaps() {
  Draw draw;
  Hash gaps;
  for (int i = 0; i < 200; ++i) {
    const auto ellipse = [&] {
      const double x = draw(-1, 1), y = draw(-1, 1), r = draw(0.02, 1), s = draw(0.02, 1);
      return tangency::Ellipse::at_angle(Eigen::Vector2d(x, y), Eigen::Vector2d(r, s), draw(-4, 4));
    };
    const tangency::Ellipse a = ellipse(), b = ellipse();
    const auto gap = tangency::signed_gap(a, b, tangency::Vec2(b.centre() - a.centre()));
    gaps.add(gap.gap, gap.normal, gap.arm_a);
  }
  std::printf("plane gaps %016jx\n", gaps.value());
}

/// Arrays that grew in the library are copied, written to and freed by the user.
void print_particles() {
  Draw draw;
  QuaternionAnywhere anywhere;
  Hash copies;
  for (int count = 1; count <= 64; ++count) {
    tangency::dem::Particles particles;
    for (int i = 0; i < count; ++i) {
      const Vec3 centre = draw.vector(0.0, 9.0), semi_axes = draw.vector(0.5, 1.0);
      particles.add(centre, anywhere(i, 0.4, -0.3, 0.7, draw(-1, 1)), semi_axes, 2.0, 0);
    }
    tangency::dem::Particles copy = particles;
    for (auto& q : copy.orientation) q = q.conjugate();
    for (std::size_t i = 0; i < copy.size(); ++i) {
      copies.add(copy.position[i], copy.orientation[i].coeffs());
    }
    const std::vector<tangency::dem::Body> bodies(static_cast<std::size_t>(count));
    copies.add(bodies.back().orientation.coeffs());
  }
  std::printf("particles %016jx\n", copies.value());
}

}  // namespace

int main(int argc, char** argv) {
  if (argc == 2 && std::string_view(argv[1]) == "layout") {
    for (const Layout& type : kLayouts) {
      std::printf("%s %zu %zu\n", type.name, type.size, type.alignment);
    }
    return 0;
  }
  print_gaps();
  print_plane_gaps();
  print_particles();
  return 0;
}
