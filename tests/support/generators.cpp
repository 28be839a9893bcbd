// SPDX-License-Identifier: GPL-3.0-or-later
#include <tangency/tests/support/generators.hpp>

#include <array>
#include <cmath>
#include <cstdint>
#include <ios>
#include <ostream>
#include <tuple>
#include <utility>

namespace tangency {

void showValue(const Ellipsoid& e, std::ostream& os) {
  const auto& q = e.orientation();
  os << std::hexfloat << "{c " << e.centre().transpose() << " r " << e.semi_axes().transpose()
     << " q " << q.w() << ' ' << q.x() << ' ' << q.y() << ' ' << q.z() << '}';
}

namespace testing {

rc::Gen<double> uniform(double low, double high) {
  return rc::gen::map(
      rc::gen::inRange<std::int64_t>(0, (std::int64_t{1} << 53) + 1),
      [=](std::int64_t k) { return low + (high - low) * (static_cast<double>(k) * 0x1p-53); });
}

rc::Gen<double> log_uniform(double low, double high) {
  return rc::gen::map(uniform(std::log(low), std::log(high)), [](double x) { return std::exp(x); });
}

rc::Gen<Vec3> direction() {
  const auto any = rc::gen::map(
      rc::gen::pair(uniform(-1, 1), uniform(-M_PI, M_PI)), [](const std::pair<double, double>& p) {
        const double s = std::sqrt(1 - p.first * p.first);
        return Vec3(s * std::cos(p.second), s * std::sin(p.second), p.first);
      });
  const auto small = rc::gen::suchThat(
      rc::gen::map(
          rc::gen::tuple(rc::gen::inRange(-1, 2), rc::gen::inRange(-1, 2), rc::gen::inRange(-1, 2)),
          [](const std::tuple<int, int, int>& t) {
            return Vec3(std::get<0>(t), std::get<1>(t), std::get<2>(t));
          }),
      [](const Vec3& v) { return v != Vec3::Zero(); });
  return rc::gen::weightedOneOf<Vec3>(
      {{3, any}, {1, rc::gen::map(small, [](const Vec3& v) { return Vec3(v.normalized()); })}});
}

rc::Gen<Vec3> semi_axes(double aspect) {
  const auto half = std::sqrt(aspect);
  const auto axis = log_uniform(1 / half, half);
  return rc::gen::map(
      rc::gen::tuple(axis, axis, axis, rc::gen::inRange(0, 8), rc::gen::inRange(0, 3)),
      [](const std::tuple<double, double, double, int, int>& t) {
        Vec3 a(std::get<0>(t), std::get<1>(t), std::get<2>(t));
        const int kind = std::get<3>(t), turn = std::get<4>(t);
        if (kind == 0) a[1] = a[2] = a[0];
        if (kind == 1 || kind == 2) a[1] = a[0];
        if (kind == 3) a[1] = std::nextafter(a[0], 2 * a[0]);
        return Vec3(a[turn], a[(turn + 1) % 3], a[(turn + 2) % 3]);
      });
}

rc::Gen<Eigen::Quaterniond> orientation() {
  const auto c = uniform(-1, 1);
  const auto some = rc::gen::map(
      rc::gen::tuple(c, c, c, c, rc::gen::inRange(0, 16), rc::gen::inRange(-20, 21)),
      [](const std::tuple<double, double, double, double, int, int>& t) {
        const int mask = std::get<4>(t);  // generic half of the time
        Eigen::Vector4d q(std::get<0>(t), std::get<1>(t), std::get<2>(t), std::get<3>(t));
        for (int i = 0; i < 4; ++i) {
          if (mask < 8 && (mask >> i & 1) != 0) q[i] = 0;
        }
        if (mask == 8) q = {1, 0, 0, 0};
        if (mask == 9) q *= 1e-9, q[0] = 1;
        q *= std::exp2(std::get<5>(t));
        return Eigen::Quaterniond(q[0], q[1], q[2], q[3]);
      });
  // Not 0; chosen: far below the 2^-20 that the length of any other comes down to.
  return rc::gen::suchThat(some, [](const Eigen::Quaterniond& q) { return q.norm() > 1e-12; });
}

rc::Gen<Ellipsoid> ellipsoid(double aspect, double size_ratio) {
  const auto centre =
      rc::gen::map(rc::gen::pair(direction(), uniform(0, 3)),
                   [](const std::pair<Vec3, double>& p) { return Vec3(p.second * p.first); });
  return rc::gen::map(rc::gen::tuple(centre, semi_axes(aspect), orientation(),
                                     log_uniform(1 / std::sqrt(size_ratio), std::sqrt(size_ratio))),
                      [](const std::tuple<Vec3, Vec3, Eigen::Quaterniond, double>& t) {
                        return Ellipsoid(std::get<0>(t), std::get<3>(t) * std::get<1>(t),
                                         std::get<2>(t));
                      });
}

rc::Gen<Pair> pair_at(double aspect, rc::Gen<double> fraction) {
  return rc::gen::map(
      rc::gen::tuple(ellipsoid(aspect), ellipsoid(aspect), direction(), std::move(fraction)),
      [](const std::tuple<Ellipsoid, Ellipsoid, Vec3, double>& t) {
        const auto& [a, b, n, f] = t;
        const Vec3 reach = a.support_point(n) + b.support_point(n);
        return Pair{a, b.moved_to(a.centre() + f * reach)};
      });
}

rc::Gen<Pair> pair(double aspect) {
  const auto near = rc::gen::map(
      rc::gen::pair(log_uniform(1e-16, 1e-2), rc::gen::inRange(0, 2)),
      [](const std::pair<double, int>& p) { return p.second == 0 ? 1 - p.first : 1 + p.first; });
  return pair_at(aspect,
                 rc::gen::weightedOneOf<double>(
                     {{1, rc::gen::just(0.0)}, {3, uniform(0, 1)}, {3, near}, {2, uniform(1, 5)}}));
}

rc::Gen<Pair> whole_pair() {
  const auto body = rc::gen::map(
      rc::gen::tuple(rc::gen::container<std::array<int, 3>>(rc::gen::inRange(-2, 3)),
                     rc::gen::container<std::array<int, 3>>(rc::gen::inRange(1, 4)),
                     rc::gen::container<std::array<int, 4>>(rc::gen::inRange(-1, 2))),
      [](const std::tuple<std::array<int, 3>, std::array<int, 3>, std::array<int, 4>>& t) {
        const auto& [c, r, q] = t;
        Eigen::Quaterniond orientation(q[0], q[1], q[2], q[3]);
        if (orientation.coeffs() == Eigen::Vector4d::Zero()) orientation.w() = 1;
        return Ellipsoid(Vec3(c[0], c[1], c[2]), Vec3(r[0], r[1], r[2]), orientation);
      });
  return rc::gen::map(rc::gen::pair(body, body), [](const std::pair<Ellipsoid, Ellipsoid>& p) {
    return Pair{p.first, p.second};
  });
}

rc::Gen<Pair> any_pair() { return rc::gen::oneOf(whole_pair(), pair(1000), pair(5)); }

void showValue(const Pair& p, std::ostream& os) {
  os << "a ";
  showValue(p.a, os);
  os << " b ";
  showValue(p.b, os);
}

}  // namespace testing
}  // namespace tangency
