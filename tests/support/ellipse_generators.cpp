// SPDX-License-Identifier: GPL-3.0-or-later
#include <tangency/tests/support/ellipse_generators.hpp>

#include <array>
#include <cmath>
#include <ios>
#include <ostream>
#include <tuple>
#include <utility>

#include <tangency/tests/support/generators.hpp>

namespace tangency {

void showValue(const Ellipse& e, std::ostream& os) {
  os << std::hexfloat << "{c " << e.centre().transpose() << " r " << e.semi_axes().transpose()
     << " u " << e.direction().transpose() << '}';
}

namespace testing {

void showValue(const EllipsePair& p, std::ostream& os) {
  os << "a ";
  showValue(p.a, os);
  os << " b ";
  showValue(p.b, os);
}

rc::Gen<Vec2> plane_direction() {
  return rc::gen::map(rc::gen::pair(uniform(-M_PI, M_PI), rc::gen::inRange(0, 16)),
                      [](const std::pair<double, int>& p) {
                        const double t = p.second < 8 ? p.second * (M_PI / 4) : p.first;
                        Vec2 n(std::cos(t), std::sin(t));
                        if (p.second < 8 && p.second % 2 == 0)
                          n = Vec2(std::round(n[0]), std::round(n[1]));
                        return n;
                      });
}

rc::Gen<Ellipse> ellipse(double aspect) {
  const double half = std::sqrt(aspect);
  const auto axis = log_uniform(1 / half, half);
  return rc::gen::map(
      rc::gen::tuple(uniform(-2, 2), uniform(-2, 2), axis, axis, plane_direction(),
                     rc::gen::inRange(-9, 10), rc::gen::inRange(0, 8)),
      [](const std::tuple<double, double, double, double, Vec2, int, int>& t) {
        const auto& [x, y, p, q, u, exponent, kind] = t;
        const double second = kind == 0 ? p : kind == 1 ? std::nextafter(p, 2 * p) : q;
        return Ellipse(Vec2(x, y), Vec2(p, second), std::exp2(exponent) * u);
      });
}

rc::Gen<Ellipse> whole_ellipse() {
  const auto range = [](int low, int high) { return rc::gen::inRange(low, high); };
  return rc::gen::map(
      rc::gen::tuple(range(-3, 4), range(-3, 4), range(1, 4), range(1, 4), range(0, 6)),
      [](const std::tuple<int, int, int, int, int>& t) {
        static const std::array<Vec2, 6> kDirections{
            {{1, 0}, {0, 2}, {-3, 0}, {1, 1}, {3, 4}, {4, -3}}};
        return Ellipse(Vec2(std::get<0>(t), std::get<1>(t)), Vec2(std::get<2>(t), std::get<3>(t)),
                       kDirections[static_cast<std::size_t>(std::get<4>(t))]);
      });
}

rc::Gen<EllipsePair> ellipse_pair(double aspect) {
  const auto near = rc::gen::map(
      rc::gen::pair(log_uniform(1e-16, 1e-2), rc::gen::inRange(0, 2)),
      [](const std::pair<double, int>& p) { return p.second == 0 ? 1 - p.first : 1 + p.first; });
  const auto fraction = rc::gen::weightedOneOf<double>(
      {{1, rc::gen::just(0.0)}, {3, uniform(0, 1)}, {3, near}, {2, uniform(1, 5)}});
  return rc::gen::map(rc::gen::tuple(ellipse(aspect), ellipse(aspect), plane_direction(), fraction),
                      [](const std::tuple<Ellipse, Ellipse, Vec2, double>& t) {
                        const auto& [a, b, n, f] = t;
                        const Vec2 reach = a.support_point(n) + b.support_point(n);
                        return EllipsePair{a, b.moved_to(a.centre() + f * reach)};
                      });
}

rc::Gen<EllipsePair> any_ellipse_pair() {
  const auto whole = rc::gen::map(rc::gen::pair(whole_ellipse(), whole_ellipse()),
                                  [](const std::pair<Ellipse, Ellipse>& p) {
                                    return EllipsePair{p.first, p.second};
                                  });
  return rc::gen::oneOf(whole, ellipse_pair(5), ellipse_pair(1000));
}

}  // namespace testing
}  // namespace tangency
