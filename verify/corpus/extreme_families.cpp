// SPDX-License-Identifier: GPL-3.0-or-later
//
// Families at the extremes of shape, size, place and depth.
#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>

#include <tangency/verify/corpus/placing.hpp>
#include <tangency/verify/oracles/newton_ascent.hpp>

namespace tangency::verify {
namespace {

enum class Form { needle, disc, any };

struct Extreme {
  Form form;
  double aspect;
  double size_ratio = 3;
  double scale = 1;
  double origin = 0;  // distance of A's centre from the origin, over `scale`
};

std::array<double, 3> extreme_axes(Draw& draw, double size, const Extreme& kind) {
  if (kind.form == Form::any) return triaxial_axes(draw, size / kind.aspect, kind.aspect);
  // The two like axes are equal, or differ by up to 2.
  const double factor = draw.coin() ? 1 : draw.log_uniform(1, std::min(kind.aspect, 2.0));
  const double thin = size / kind.aspect;
  std::array<double, 3> axes{size, kind.form == Form::needle ? thin * factor : size / factor, thin};
  draw.shuffle(axes);
  return axes;
}

// A third anywhere, a third along an axis of a body, a third at 1e-12 to 1 of it.
Real3 contact_normal(Draw& draw, const EllipsoidPair& pair) {
  const Real3 any = draw.direction();
  const int kind = draw.integer(0, 2);
  if (kind == 0) return any;
  const Separation<Real> shapes = separation(real(pair.a), real(pair.b));
  const Shape<Real>& of = draw.coin() ? shapes.a : shapes.b;
  const Real off = kind == 1 ? 0 : draw.log_uniform(1e-12, 1);
  const Real3 axis = of.axes[static_cast<std::size_t>(draw.integer(0, 2))];
  return ascent::normalised(ascent::combined(axis, off, any, Real(0), any));
}

PairDraw extreme_draw(const Extreme& kind) {
  return [kind](Draw& draw) {
    EllipsoidPair pair{turned_body(draw, extreme_axes(draw, kind.scale, kind)), {}};
    const double size = kind.scale * draw.log_uniform(1 / kind.size_ratio, kind.size_ratio);
    pair.b = turned_body(draw, extreme_axes(draw, size, kind));
    const Real3 place = draw.direction();
    for (std::size_t i = 0; i < 3; ++i) {
      pair.a.centre[i] = rounded(place[i] * (kind.scale * kind.origin));
    }
    const double least = std::min(least_axis(pair.a), least_axis(pair.b));
    const double most = std::max(most_axis(pair.a), most_axis(pair.b)), radii = least_radii(pair);
    double gap = least * draw.log_uniform(1e-16, 1e6 * (most / least));
    if (draw.integer(0, 2) == 0) gap = -radii * draw.log_uniform(1e-10, 1);
    place_b(pair, contact_normal(draw, pair), gap);
    if (draw.coin()) std::swap(pair.a, pair.b);
    return pair;
  };
}

// Overlaps: B's centre at `least` to `most` of the way out to a touch.
PairDraw deep_draw(double aspect, double least, double most) {
  return [=](Draw& draw) {
    EllipsoidPair pair{turned_body(draw, triaxial_axes(draw, 1, draw.log_uniform(1, aspect))),
                       turned_body(draw, triaxial_axes(draw, draw.log_uniform(0.3, 3),
                                                       draw.log_uniform(1, aspect)))};
    place_b(pair, draw.direction(), 0, draw.real(least, most));
    return pair;
  };
}

}  // namespace

PairFamilies extreme_families() {
  PairFamilies families;
  for (const auto& [aspect, text] :
       {std::pair(1e1, "1e1"), std::pair(1e2, "1e2"), std::pair(1e4, "1e4"), std::pair(1e6, "1e6"),
        std::pair(1e8, "1e8")}) {
    families.push_back(
        drawn_family(std::string("needles ") + text, 24, extreme_draw({Form::needle, aspect})));
    families.push_back(
        drawn_family(std::string("discs ") + text, 24, extreme_draw({Form::disc, aspect})));
  }
  families.push_back(drawn_family("size ratio 1e8", 40, extreme_draw({Form::any, 10, 1e8})));
  families.push_back(drawn_family("scale 1e-150", 30, extreme_draw({Form::any, 100, 3, 1e-150})));
  families.push_back(drawn_family("scale 1e+150", 30, extreme_draw({Form::any, 100, 3, 1e150})));
  families.push_back(drawn_family("origin 1e12", 40, extreme_draw({Form::any, 10, 3, 1, 1e12})));
  return families;
}

PairFamilies deep_families() {
  return {drawn_family("aspect to 1.05", 50, deep_draw(1.05, 0, 1)),
          drawn_family("aspect to 5", 80, deep_draw(5, 0, 1)),
          drawn_family("aspect to 20", 80, deep_draw(20, 0, 1)),
          drawn_family("aspect to 100", 50, deep_draw(100, 0, 1)),
          drawn_family("nearly concentric", 50, deep_draw(20, 0, 0.05)),
          drawn_family("concentric", 50, deep_draw(20, 0, 0))};
}

}  // namespace tangency::verify
