// SPDX-License-Identifier: GPL-3.0-or-later
// How far the published contact scheme of curves (geometry/trace_contact.hpp) is from the signed
// gap, and what its answer depends on: the tables of docs/trace.md. Takes no arguments; under a
// minute.
//
//   1. |depth - true depth| / true depth of manufactured contacts against true depth / rho, rho the
//      sum of the least radii of curvature; as published, and with the two middle curves cut again
//      20 times; with the exponent fitted to the medians.
//   2. The spread of the depth, over the true one, when the bodies are exchanged, and over eight
//   turns
//      of a spheroid A about its own axis: equal semi-axes labelled in other ways.
//   3. Which pairs have an answer, from which cone and pole, after how many curves.
//   4. Rounding: float and double against long double.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <limits>
#include <map>
#include <random>
#include <string>
#include <vector>

#include <tangency/geometry/trace/scheme.hpp>
#include <tangency/geometry/trace_contact.hpp>
#include <tangency/verify/families/conversions.hpp>
#include <tangency/verify/families/manufactured.hpp>

namespace {

using namespace tangency;
using detail::TraceFound;
using detail::TraceOptions;
using verify::ContactFamily;

constexpr std::uint64_t kSeed = 20261122;
constexpr int kPairs = 2000;
constexpr double kDepths[] = {1e-1, 1e-2, 1e-3, 1e-4, 1e-5};

struct Sample {
  Ellipsoid a, b;
  double depth;
  Vec3 normal;
  double size;  ///< |d| and the largest semi-axes
};

/// Spheroids 1 : 0.7 whose axes and centres lie in one plane: the published comparison.
std::vector<Sample> draw_in_plane(double depth) {
  std::mt19937_64 random(kSeed);
  const auto angle = [&random] { return M_PI * 0x1p-52 * static_cast<double>(random() >> 11); };
  const auto body = [&] {
    const double half = angle();
    return Ellipsoid(Vec3::Zero(), {1, 0.7, 0.7}, {std::cos(half), 0, 0, std::sin(half)});
  };
  std::vector<Sample> samples;
  while (samples.size() < kPairs) {
    const Ellipsoid a = body(), b = body();
    const double t = angle();
    const double overlap = depth * (a.least_radius() + b.least_radius());
    const Vec3 n(std::cos(t), std::sin(t), 0);
    const Vec3 d = a.support_point(n) + b.support_point(n) - overlap * n;
    samples.push_back({a, b.moved_to(d), overlap, n, d.norm() + 2});
  }
  return samples;
}

/// Contacts of depths from half of `depth` to it, in rho.
std::vector<Sample> draw(ContactFamily family, double depth) {
  if (family.name == "plane") return draw_in_plane(depth);
  family.gap_unit = ContactFamily::GapUnit::rho;
  family.largest_gap = depth;
  verify::ManufacturedContacts contacts(family, kSeed);
  std::vector<Sample> samples;
  while (samples.size() < kPairs) {
    const auto c = contacts.next();
    const Ellipsoid a = verify::to_ellipsoid(c.a), b = verify::to_ellipsoid(c.b);
    if (c.gap >= -0.5 * depth * (a.least_radius() + b.least_radius())) continue;
    samples.push_back({a, b, -c.gap, {c.normal[0], c.normal[1], c.normal[2]}, c.size});
  }
  return samples;
}

std::vector<ContactFamily> all_families() {
  const auto classes = verify::contact_classes();
  std::vector<ContactFamily> result(classes.begin(), classes.end());
  result.insert(result.begin() + 1, {"oblate", ContactFamily::Shape::spheroid, 1 / 1.43, 1.0,
                                     ContactFamily::GapUnit::rho, 0.02});
  result.insert(result.begin(), {"plane", ContactFamily::Shape::spheroid, 1 / 0.7, 1.0,
                                 ContactFamily::GapUnit::rho, 0.02});
  return result;
}

template <class Real = double>
TraceFound<Real> scheme(const Ellipsoid& a, const Ellipsoid& b, const TraceOptions& options = {}) {
  return detail::trace_scheme<Real>(detail::trace_body<Real>(a), detail::trace_body<Real>(b),
                                    (b.centre() - a.centre()).cast<Real>(), options);
}

/// Of a list in any order; of an empty one nan.
double quantile(std::vector<double> values, double part) {
  if (values.empty()) return std::nan("");
  const auto k = static_cast<std::ptrdiff_t>(part * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), values.begin() + k, values.end());
  return values[static_cast<std::size_t>(k)];
}

/// Slope of log y over log x by least squares.
double exponent(const std::vector<double>& x, const std::vector<double>& y) {
  double sx = 0, sy = 0, sxx = 0, sxy = 0;
  const double n = static_cast<double>(x.size());
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double p = std::log(x[i]), q = std::log(y[i]);
    sx += p, sy += q, sxx += p * p, sxy += p * q;
  }
  return (n * sxy - sx * sy) / (n * sxx - sx * sx);
}

/// Over contacts with an answer.
template <class Measure>
std::vector<double> over(const std::vector<Sample>& samples, const Measure& measure) {
  std::vector<double> values;
  for (const Sample& s : samples) {
    const double value = measure(s);
    if (!std::isnan(value)) values.push_back(value);
  }
  return values;
}

void differences(const ContactFamily& family) {
  for (const int refinements : {0, 20}) {
    std::vector<double> x, medians;
    for (const double depth : kDepths) {
      const std::vector<Sample> samples = draw(family, depth);
      const auto of = [&](const Sample& s) {
        const auto t = scheme(s.a, s.b, {.refinements = refinements});
        return t.status == TraceStatus::ok ? std::abs(-t.gap / s.depth - 1) : std::nan("");
      };
      const std::vector<double> d = over(samples, of);
      x.push_back(depth);
      medians.push_back(quantile(d, 0.5));
      std::printf("%-8s %-10s %8.0e %7zu %10.2e %10.2e %10.2e\n", family.name.c_str(),
                  refinements == 0 ? "published" : "cut again", depth, d.size(), medians.back(),
                  quantile(d, 0.9), quantile(d, 1.0));
    }
    std::printf("%-8s %-10s exponent of the median %.3f\n", family.name.c_str(),
                refinements == 0 ? "published" : "cut again", exponent(x, medians));
  }
}

double exchange_spread(const Sample& s) {
  const auto ab = scheme(s.a, s.b), ba = scheme(s.b, s.a);
  const bool both = ab.status == TraceStatus::ok && ba.status == TraceStatus::ok;
  return both ? std::abs(ab.gap - ba.gap) / s.depth : std::nan("");
}

/// Of a spheroid A, stored turned about its axis of symmetry.
double label_spread(const Sample& s, bool turned_to_the_pair) {
  const Vec3& r = s.a.semi_axes();
  const int axis = r[0] == r[1] ? 2 : (r[1] == r[2] ? 0 : 1);
  double low = 0, high = -INFINITY;
  for (int k = 0; k < 8; ++k) {
    const Eigen::Quaterniond q(Eigen::AngleAxisd(M_PI / 8 * k, Vec3::Unit(axis)));
    const Ellipsoid a(s.a.centre(), r, s.a.orientation() * q);
    const auto t = scheme(a, s.b, {.turned_to_the_pair = turned_to_the_pair});
    if (t.status != TraceStatus::ok) return std::nan("");
    low = std::min(low, t.gap);
    high = std::max(high, t.gap);
  }
  return (high - low) / s.depth;
}

void spreads(const ContactFamily& family) {
  const auto row = [&](const char* what, double depth, const std::vector<double>& d) {
    std::printf("%-8s %-18s %8.0e %7zu %10.2e %10.2e %10.2e\n", family.name.c_str(), what, depth,
                d.size(), quantile(d, 0.5), quantile(d, 0.9), quantile(d, 1.0));
  };
  for (const double depth : {1e-2, 1e-4}) {
    const std::vector<Sample> samples = draw(family, depth);
    row("exchange", depth, over(samples, exchange_spread));
    if (family.shape != ContactFamily::Shape::spheroid) continue;
    for (const bool turned : {false, true}) {
      row(turned ? "labels, as offered" : "labels, as stored", depth,
          over(samples, [&](const Sample& s) { return label_spread(s, turned); }));
    }
  }
}

void statuses(const ContactFamily& family) {
  for (const double depth : kDepths) {
    std::map<TraceStatus, int> status;
    std::map<TraceCone, int> cone;
    std::vector<double> curves;
    int other_pole = 0;
    for (const Sample& s : draw(family, depth)) {
      const TraceContact t = trace_contact(s.a, s.b);
      ++status[t.status];
      if (t.status != TraceStatus::ok) continue;
      ++cone[t.cone];
      other_pole += t.other_pole ? 1 : 0;
      curves.push_back(t.curves);
    }
    std::printf("%-8s %8.0e %5d %5d %5d %5d %5d %5d %5d %5d %5d %7.0f %7.0f\n", family.name.c_str(),
                depth, status[TraceStatus::ok], status[TraceStatus::no_arc],
                status[TraceStatus::several_arcs], status[TraceStatus::no_overlap_on_the_line],
                status[TraceStatus::not_overlapping], cone[TraceCone::published],
                cone[TraceCone::common_part], cone[TraceCone::whole], other_pole,
                quantile(curves, 0.5), quantile(curves, 1.0));
  }
}

/// |depth - that in long double|, in u (of that scalar) times the size of the pair, and the share
/// of pairs without an answer, or with one from another curve.
template <class Real>
void rounding(const char* name, const ContactFamily& family) {
  constexpr double u = std::numeric_limits<Real>::epsilon() / 2;
  for (const double depth : {1e-2, 1e-4}) {
    int other = 0;
    std::vector<double> error, relative;
    for (const Sample& s : draw(family, depth)) {
      const auto exact = scheme<long double>(s.a, s.b);
      const auto t = scheme<Real>(s.a, s.b);
      if (exact.status != TraceStatus::ok) continue;
      if (t.status != TraceStatus::ok || t.curves != exact.curves) {
        ++other;
        continue;
      }
      const double e = std::abs(static_cast<double>(t.gap - exact.gap));
      error.push_back(e / (u * s.size));
      relative.push_back(e / s.depth);
    }
    std::printf("%-8s %-7s %8.0e %6d %10.3g %10.3g %10.2e %10.2e\n", family.name.c_str(), name,
                depth, other, quantile(error, 0.5), quantile(error, 1.0), quantile(relative, 0.5),
                quantile(relative, 1.0));
  }
}

}  // namespace

int main() {
  std::printf("seed %llu, %d pairs a row\n\n", static_cast<unsigned long long>(kSeed), kPairs);
  std::printf("1. |depth / true depth - 1|\n%-8s %-10s %8s %7s %10s %10s %10s\n", "family",
              "scheme", "dep./rho", "answers", "median", "90 %", "largest");
  for (const auto& family : all_families()) differences(family);
  std::printf("\n2. spread / true depth\n%-8s %-18s %8s %7s %10s %10s %10s\n", "family", "of",
              "dep./rho", "answers", "median", "90 %", "largest");
  for (const auto& family : all_families()) spreads(family);
  std::printf("\n3. pairs\n%-8s %8s %5s %5s %5s %5s %5s %5s %5s %5s %5s %7s %7s\n", "family",
              "dep./rho", "ok", "noarc", "arcs", "line", "rel.", "publ.", "part", "whole", "pole",
              "curves", "most");
  for (const auto& family : all_families()) statuses(family);
  std::printf("\n4. rounding\n%-8s %-7s %8s %6s %10s %10s %10s %10s\n", "family", "scalar",
              "dep./rho", "other", "med./u L", "max/u L", "med./depth", "max/depth");
  for (const auto& family : all_families()) {
    rounding<float>("float", family);
    rounding<double>("double", family);
  }
  return 0;
}
