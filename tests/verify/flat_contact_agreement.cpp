// SPDX-License-Identifier: GPL-3.0-or-later
// Holds the gaps by other definitions, the curvatures at a contact and the derivatives of the gap
// against 100 digits, in the directions in which flat and long bodies are hard: face to face many
// thicknesses apart, nearly concentric, rim to rim, crossing, nearly parallel, touched on a face.
// Prints the largest errors over their bounds. The merge gate runs a part of it; docs/testing.md
// names the whole.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <string>

#include <tangency/geometry/curvature.hpp>
#include <tangency/geometry/gap_derivatives.hpp>
#include <tangency/geometry/other_gaps.hpp>
#include <tangency/tests/support/gap_gradient.hpp>
#include <tangency/tests/verify/agreement.hpp>
#include <tangency/tests/verify/raw_sampler.hpp>
#include <tangency/verify/families/conversions.hpp>
#include <tangency/verify/oracles/perram_wertheim.hpp>

namespace {

using namespace tangency;
using verify::Real, verify::Real3;
using verify::to_ellipsoid, verify::to_raw;

constexpr double kU = tangency::kUnitRoundoff;

struct Pair {
  Ellipsoid a, b;
};

double size_of(const Pair& p) {
  return (p.b.centre() - p.a.centre()).norm() + p.a.largest_semi_axis() + p.b.largest_semi_axis();
}

double as_double(const Real& v) { return static_cast<double>(v); }
double distance(const Vec3& v, const Real3& truth) {
  Real square = 0;
  for (int i = 0; i < 3; ++i) {
    const Real off = Real(v[i]) - truth[static_cast<std::size_t>(i)];
    square += off * off;
  }
  return as_double(sqrt(square));
}

/// The largest error of one number in units of its bound, and the pair that has it.
struct Worst {
  const char* what;
  double error = 0;
  std::string row = {};

  void see(double x, const Pair& pair, const Vec3& normal = Vec3::Zero()) {
    if (x <= error || std::isnan(error)) return;  // a NaN is kept
    error = x;
    row.clear();
    const auto add = [&](double v) {
      char digits[40];
      std::snprintf(digits, sizeof digits, "%a,", v);
      row += digits;
    };
    for (const Ellipsoid* e : {&pair.a, &pair.b}) {
      const auto raw = verify::to_raw(*e);
      for (const double v : raw.centre) add(v);
      for (const double v : raw.semi_axes) add(v);
      for (const double v : raw.orientation) add(v);
    }
    for (const double v : normal) add(v);
  }
  bool kept() const { return error <= 1; }
  void print() const {
    std::printf("  %-52s %9.3g of its bound\n", what, error);
    if (!kept()) std::printf("    worst row: %s\n", row.c_str());
  }
};

/// Pairs in the directions that are hard for flat and long bodies, reproducible.
class Source {
 public:
  Source(unsigned seed, double aspect) : sampler_(seed), aspect_(aspect) {}

  double uniform(double low, double high) { return sampler_.uniform(low, high); }
  double log_uniform(double low, double high) { return sampler_.log_uniform(low, high); }
  int below(int n) { return std::min(n - 1, static_cast<int>(uniform(0, n))); }
  Vec3 direction() {
    const auto v = sampler_.vector();
    return Vec3(v[0], v[1], v[2]).normalized();
  }
  Eigen::Quaterniond orientation() {
    return {uniform(-1, 1), uniform(-1, 1), uniform(-1, 1), uniform(-1, 1)};
  }
  /// A disc, a blade or a needle about the origin: its last axis is the thinnest.
  Ellipsoid body(double size, const Eigen::Quaterniond& q) {
    const double thin = size / log_uniform(1, aspect_);
    const double middle[] = {size, thin, size * log_uniform(thin / size, 1)};
    return {Vec3::Zero(), {size, middle[below(3)], thin}, q};
  }
  /// q, turned about any axis or that one by an angle of any size.
  Eigen::Quaterniond turned(const Eigen::Quaterniond& q, const Vec3& axis) {
    const double angle = below(4) == 0 ? 0 : log_uniform(1e-14, 2);
    return Eigen::Quaterniond(Eigen::AngleAxisd(angle, axis)) * q.normalized();
  }

  /// Face to face at any distance, aside or not; nearly concentric; rim to rim; any.
  Pair apart() {
    const Ellipsoid a = body(log_uniform(0.1, 10), orientation());
    const double ratio = below(4) == 0 ? log_uniform(1e-8, 1e8) : log_uniform(0.1, 10);
    const double size = ratio * a.largest_semi_axis();
    const bool parallel = below(3) > 0;
    Quaternion q = parallel ? a.orientation() : Quaternion(orientation());
    if (parallel && below(2) > 0) q = turned(q, direction());
    const Ellipsoid b = body(size, q);
    const Vec3 face = a.rotation().col(2), along = a.rotation().col(below(2));
    const double thickness = a.smallest_semi_axis() + b.smallest_semi_axis();
    const double reach = a.largest_semi_axis() + b.largest_semi_axis();
    const Vec3 aside =
        below(3) == 0 ? Vec3(Vec3::Zero()) : Vec3(log_uniform(1e-12, 1) * reach * direction());
    Vec3 d = log_uniform(thickness * 1e-3, reach * 100) * face + aside;
    switch (below(4)) {
      case 0:
        d = log_uniform(1e-12, 10) * thickness * direction();
        break;
      case 1:
        d = uniform(0.5, 3) * reach * along + log_uniform(1e-3, 1e3) * thickness * face;
        break;
      case 2:
        d = (a.support(face) + b.support(face)) * uniform(0.3, 1000) * face + 1e-3 * aside;
        break;
      default:
        break;
    }
    return {a, b.moved_to(d)};
  }

  struct Contact {
    Pair pair;
    Vec3 normal;
  };
  /// Touching or nearly at a normal along an axis of A, near one or any: faces, rims and tips; B
  /// turned from A by a small angle about the normal, about anything, or not related to A.
  Contact touching() {
    const Ellipsoid a = body(log_uniform(0.1, 10), orientation());
    Vec3 n = a.rotation().col(below(3));
    if (below(3) == 0) n = (n + log_uniform(1e-14, 1) * direction()).normalized();
    if (below(6) == 0) n = direction();
    const double size = a.largest_semi_axis() * (below(2) == 0 ? 1 : log_uniform(0.01, 100));
    const Eigen::Quaterniond q = below(3) == 0   ? orientation()
                                 : below(2) == 0 ? turned(a.orientation(), direction())
                                                 : turned(a.orientation(), n);
    const bool twin = below(3) == 0;
    const Ellipsoid b = twin            ? Ellipsoid(Vec3::Zero(), a.semi_axes(), q)
                        : below(4) == 0 ? Ellipsoid(Vec3::Zero(), Vec3::Constant(size), q)
                                        : body(size, q);
    const double rho = a.least_radius() + b.least_radius();
    const double gap =
        below(2) == 0 ? -0.9 * rho * uniform(0, 1) : log_uniform(1e-6, 1) * a.largest_semi_axis();
    const Vec3 d = a.support_point(n) + b.support_point(n) + gap * n;
    return {{a, b.moved_to(d)}, n};
  }

 private:
  verify::RawSampler sampler_;
  double aspect_;
};

bool check_definitions(Source& source, long count) {
  Worst gap[2] = {{"perram_wertheim_gap: gap"}, {"midpoint_potential_gap: gap"}};
  Worst normal[2] = {{"perram_wertheim_gap: normal"}, {"midpoint_potential_gap: normal"}};
  Worst arms[2] = {{"perram_wertheim_gap: points"}, {"midpoint_potential_gap: points"}};
  Worst certified[2] = {{"perram_wertheim_gap: gap_error"}, {"midpoint_potential_gap: gap_error"}};
  Worst factor{"perram_wertheim_factor"};
  long answers[2] = {}, unknown[2] = {}, misses = 0, wrong = 0;
  for (long i = 0; i < count; ++i) {
    const Pair p = source.apart();
    const auto truth = verify::perram_wertheim(verify::to_raw(p.a), verify::to_raw(p.b));
    if (!truth) continue;
    const OtherGap found[] = {perram_wertheim_gap(p.a, p.b), midpoint_potential_gap(p.a, p.b)};
    const verify::DefinedGap* const right[] = {&truth->tangent_planes,
                                               truth->midpoint ? &*truth->midpoint : nullptr};
    const double size = size_of(p);
    const PerramWertheimFactor of_sizes = perram_wertheim_factor(p.a, p.b);
    const Real& level = truth->contact_function;
    factor.see(as_double(abs(Real(of_sizes.factor) - level)) / of_sizes.factor_error, p);
    factor.see(as_double(abs(Real(of_sizes.scale) - Real(sqrt(level)))) / of_sizes.scale_error, p);
    wrong += of_sizes.status != OtherGapStatus::ok;
    for (int k = 0; k < 2; ++k) {
      const bool ok = found[k].status == OtherGapStatus::ok;
      if (found[k].status == OtherGapStatus::not_converged) {
        ++unknown[k];
      } else if (ok != (right[k] != nullptr)) {
        ++wrong;
        gap[k].see(INFINITY, p);
      }
      if (!ok || right[k] == nullptr) {
        misses += found[k].status == OtherGapStatus::not_applicable;
        continue;
      }
      ++answers[k];
      const auto bound = [&](double value) { return kU * (value + size / 64); };
      const double off = as_double(abs(Real(found[k].gap) - right[k]->gap));
      gap[k].see(off / bound(std::abs(found[k].gap)), p);
      certified[k].see(off / found[k].gap_error, p);
      normal[k].see(distance(found[k].normal, right[k]->normal) / (8 * kU), p);
      arms[k].see(distance(found[k].arm_a, right[k]->arm_a) / bound(found[k].arm_a.norm()), p);
      arms[k].see(distance(found[k].arm_b, right[k]->arm_b) / bound(found[k].arm_b.norm()), p);
    }
  }
  std::printf(
      "gaps by other definitions, %ld pairs: %ld and %ld answers, %ld lines that miss, %ld "
      "and %ld not converged, %ld wrong in status\n",
      count, answers[0], answers[1], misses, unknown[0], unknown[1], wrong);
  bool kept = wrong == 0 && misses > count / 100 && answers[1] > count / 10;
  for (int k = 0; k < 2; ++k) {
    for (const Worst* w : {&gap[k], &certified[k], &normal[k], &arms[k]}) {
      w->print(), kept = kept && w->kept();
    }
  }
  factor.print();
  return kept && factor.kept();
}

Real dot(const Real3& a, const Real3& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Real3 cross(const Real3& a, const Real3& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
Real3 unit(const Real3& v) {
  const Real length = sqrt(dot(v, v));
  return {v[0] / length, v[1] / length, v[2] / length};
}

/// K = h M^-1 on the tangent plane: its xx, yy, xy.
Real3 curvature_of(const verify::Shape<Real>& shape, const Real3& n, const Real3& e1,
                   const Real3& e2) {
  Real hh = 0, xx = 0, yy = 0, xy = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const Real a2 = shape.semi_axes[k] * shape.semi_axes[k], on_n = dot(shape.axes[k], n);
    const Real on_1 = dot(shape.axes[k], e1), on_2 = dot(shape.axes[k], e2);
    hh += a2 * on_n * on_n, xx += on_1 * on_1 / a2, yy += on_2 * on_2 / a2, xy += on_1 * on_2 / a2;
  }
  const Real h = sqrt(hh);
  return {h * xx, h * yy, h * xy};
}

struct RealCurvatures {
  explicit RealCurvatures(const Real3& k, const Real3& e1, const Real3& e2) {
    const Real half = (k[0] - k[1]) / 2, spread = sqrt(half * half + k[2] * k[2]);
    larger = (k[0] + k[1]) / 2 + spread, smaller = (k[0] + k[1]) / 2 - spread;
    const Real angle = atan2(k[2], half) / 2;
    for (std::size_t i = 0; i < 3; ++i) direction[i] = cos(angle) * e1[i] + sin(angle) * e2[i];
  }
  Real larger, smaller;
  Real3 direction;
};

bool check_curvatures(Source& source, long count) {
  constexpr double kOfBody = 128, kOfDirection = 64, kRelative = 512;
  constexpr double kOfSmaller = 0x1p-91;  // times beta and the aspect ratio
  Worst body{"surface_curvature: curvatures"}, turn{"contact_curvature: directions"};
  Worst larger{"contact_curvature: larger relative curvature"};
  Worst smaller{"contact_curvature: smaller relative curvature"};
  for (long i = 0; i < count; ++i) {
    const auto [pair, n] = source.touching();
    const ContactCurvature found = contact_curvature(pair.a, pair.b, n);
    const auto shapes =
        separation(verify::real(verify::to_raw(pair.a)), verify::real(verify::to_raw(pair.b)));
    const Real3 up = unit({n[0], n[1], n[2]});
    int least;
    n.cwiseAbs().minCoeff(&least);
    Real3 axis{};
    axis[static_cast<std::size_t>(least)] = 1;
    const Real3 e1 = unit(cross(up, axis)), e2 = cross(up, e1);
    const Real3 of_a = curvature_of(shapes.a, up, e1, e2),
                of_b = curvature_of(shapes.b, up, e1, e2);
    const auto sharpness = [&](const Ellipsoid& e) { return e.largest_semi_axis() / e.support(n); };
    const auto aspect = [](const Ellipsoid& e) {
      return e.largest_semi_axis() / e.smallest_semi_axis();
    };
    const double beta = std::max(sharpness(pair.a), sharpness(pair.b));
    const double ratio = std::max(aspect(pair.a), aspect(pair.b));
    const auto relative = [](double value, const Real& truth) {
      return as_double(abs(Real(value) - truth) / truth);
    };
    const auto see_turn = [&](const PrincipalCurvatures& k, const RealCurvatures& truth,
                              double own_beta) {
      const Real3 off =
          cross({k.direction[0][0], k.direction[0][1], k.direction[0][2]}, truth.direction);
      const double apart =
          as_double((truth.larger - truth.smaller) / (truth.larger + truth.smaller));
      turn.see(as_double(sqrt(dot(off, off))) * apart / (kOfDirection * kU * own_beta), pair, n);
    };
    const auto see_body = [&](const PrincipalCurvatures& k, const Real3& tensor, double own_beta) {
      const RealCurvatures truth(tensor, e1, e2);
      body.see(relative(k.curvature[0], truth.larger) / (kOfBody * kU * own_beta), pair, n);
      body.see(relative(k.curvature[1], truth.smaller) / (kOfBody * kU * own_beta), pair, n);
      see_turn(k, truth, own_beta);
    };
    see_body(found.a, of_a, sharpness(pair.a));
    see_body(found.b, of_b, sharpness(pair.b));
    const RealCurvatures sum({of_a[0] + of_b[0], of_a[1] + of_b[1], of_a[2] + of_b[2]}, e1, e2);
    const double bound = kRelative * kU * beta;
    larger.see(relative(found.relative.curvature[0], sum.larger) / bound, pair, n);
    smaller.see(
        relative(found.relative.curvature[1], sum.smaller) / (bound + kOfSmaller * beta * ratio),
        pair, n);
    see_turn(found.relative, sum, beta);
  }
  std::printf("curvatures, %ld contacts\n", count);
  bool kept = true;
  for (const Worst* w : {&body, &larger, &smaller, &turn}) w->print(), kept = kept && w->kept();
  return kept;
}

/// d2g / dv_i dv_j by differences is half of a commutator off: gap_derivatives.hpp.
double half_commutator(const GapDerivatives& d, int i, int j) {
  if (!tangency::testing::is_angle(i) || !tangency::testing::is_angle(j) ||
      i / kOfBodyB != j / kOfBodyB)
    return 0;
  const int first = i - i % 3;
  return 0.5 *
         d.gradient.segment<3>(first).dot(Vec3::Unit(i - first).cross(Vec3(Vec3::Unit(j - first))));
}

bool check_derivatives(Source& source, long count) {
  constexpr double kGradient = 128, kHessian = 16;
  constexpr long kEvery = 8;               // pairs to a column of the Hessian
  const Real step = ldexp(Real(1), -133);  // 1e-40
  Worst centres{"gradient: centres"}, angles{"gradient: angles"}, axes{"gradient: semi-axes"};
  Worst hessian{"Hessian (measured, not derived)"};
  long answers = 0, degenerate = 0, columns = 0;
  for (long i = 0; i < count; ++i) {
    const Pair p = source.touching().pair;
    const Gap gap = signed_gap(p.a, p.b);
    const GapDerivatives d = gap_derivatives(p.a, p.b, gap);
    if (d.status != DerivativeStatus::ok && d.status != DerivativeStatus::local) {
      ++degenerate;
      continue;
    }
    const tangency::testing::RealPair pair{verify::real(verify::to_raw(p.a)),
                                           verify::real(verify::to_raw(p.b))};
    const auto truth_of = [&](const tangency::testing::RealPair& at) {
      return gradient_of(at,
                         stationary_gap(at.a, at.b, {gap.normal[0], gap.normal[1], gap.normal[2]}));
    };
    const auto truth = truth_of(pair);
    ++answers;
    const double size = size_of(p);
    const double deep = 1 + std::max(0.0, -gap.gap / d.least_radius);
    const double kappa = 1 + size / d.least_radius;
    const auto sharpness = [&](const Ellipsoid& e) {
      return e.largest_semi_axis() / e.support(gap.normal);
    };
    const double beta = std::max(sharpness(p.a), sharpness(p.b));
    const double unit = kU * deep * (kappa + std::sqrt(kappa * beta));
    const auto scale = [&](int k) {
      return k % kOfBodyB < kRotation ? 1 : tangency::testing::is_angle(k) ? size * beta : beta;
    };
    for (int k = 0; k < 18; ++k) {
      Worst& kind = k % kOfBodyB < kRotation         ? centres
                    : tangency::testing::is_angle(k) ? angles
                                                     : axes;
      const Real off = abs(Real(d.gradient[k]) - truth[static_cast<std::size_t>(k)]);
      kind.see(as_double(off) / (kGradient * unit * scale(k)), p, gap.normal);
    }
    if (i % kEvery != 0) continue;
    const int j = static_cast<int>(++columns % 18);
    const auto more = truth_of(changed(pair, j, step)), less = truth_of(changed(pair, j, -step));
    for (int k = 0; k < 18; ++k) {
      const auto row = static_cast<std::size_t>(k);
      const Real difference = (more[row] - less[row]) / (2 * step) - half_commutator(d, k, j);
      hessian.see(as_double(abs(Real(d.hessian(k, j)) - difference)) * d.least_radius /
                      (kHessian * kU * kappa * deep * beta * scale(k) * scale(j)),
                  p, gap.normal);
    }
  }
  std::printf("derivatives, %ld pairs: %ld with, %ld without, %ld columns of Hessians\n", count,
              answers, degenerate, columns);
  bool kept = answers > count / 4;
  for (const Worst* w : {&centres, &angles, &axes, &hessian}) w->print(), kept = kept && w->kept();
  return kept;
}

bool agree(unsigned seed, long count, double aspect, const std::string& only) {
  Source source(seed, aspect);
  std::printf("aspect ratios to %g; largest errors seen\n", aspect);
  bool kept = true;
  const auto run = [&](const char* name, auto check) {
    if (!only.empty() && only != name) return;
    kept = check(source, count) && kept;
    std::fflush(stdout);
  };
  run("gaps", check_definitions);
  run("curvatures", check_curvatures);
  run("derivatives", check_derivatives);
  return kept;
}

}  // namespace

int main(int argc, char** argv) {
  tangency::testing::AgreementProgram program("flat_contact_agreement",
                                              "Hold the numbers of flat bodies against 100 digits");
  long count = 100'000;
  double aspect = 1e8;
  std::string only;
  program.option("--count", count, "inputs of each");
  program.option("--aspect", aspect, "largest aspect ratio");
  program.option("--only", only, "gaps, curvatures or derivatives");
  return program.run(argc, argv, [&](std::uint64_t seed) {
    return agree(static_cast<unsigned>(seed), count, aspect, only);
  });
}
