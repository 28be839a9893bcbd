// SPDX-License-Identifier: GPL-3.0-or-later
#include <tangency/tests/fuzz/pair_checks.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include <tangency/geometry/bounded_gap.hpp>
#include <tangency/geometry/gap_batch.hpp>
#include <tangency/tests/fuzz/mutate.hpp>
#include <tangency/tests/support/same_bits.hpp>
#include <tangency/verify/oracles/relation.hpp>

namespace tangency::testing::fuzz {
namespace {

using Wide = long double;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
// Of a sum of two doubles in an extended one; chosen: a few of its roundings.
constexpr Wide kRounded = 0x1p-60L;

Relation exchanged(Relation relation) {
  if (relation == Relation::a_in_b) return Relation::b_in_a;
  return relation == Relation::b_in_a ? Relation::a_in_b : relation;
}
Inner exchanged(Inner inner) {
  if (inner == Inner::none) return inner;
  return inner == Inner::a ? Inner::b : Inner::a;
}

/// Holds a pair's promises, and names the pair where one is broken.
class Checks {
 public:
  Checks(const std::string& target, const verify::EllipsoidPair& raw, const Bodies& bodies,
         std::uint64_t choice)
      : target_(target), raw_(raw), a_(bodies.a), b_(bodies.b), choice_(choice) {}

  void run() {
    relations();
    gaps();
    // A search takes up to some ms, and is asked for ten times below: of one in eight.
    if (gap_.tier == GapTier::search && choice_ / 1024 % 8 != 0) return;
    scaled();
    separated();
    batches();
  }

 private:
  void hold(bool holds, const char* what) const {
    if (!holds) broken(target_, std::string(what) + ": " + row_of(raw_));
  }

  void relations() {
    relation_ = relation(a_, b_);
    const RelationAnswer other = relation(b_, a_);
    hold(other.relation == exchanged(relation_.relation) &&
             other.inner == exchanged(relation_.inner),
         "relation and exchange");
    const bool overlap = meets(relation_.relation);
    hold(overlaps(a_, b_) == overlap && overlaps(b_, a_) == overlap, "relation and overlaps");
    const std::optional<bool> known = overlaps_by_filter(a_, b_);
    hold(!known || *known == overlap, "relation and overlaps_by_filter");
    count(relation_.tier == Tier::filter ? "relation by filter" : "relation exact");
  }

  void gaps() {
    static constexpr std::array kTiers{"tier fast", "tier safeguarded", "tier factored",
                                       "tier search", "tier exact"};
    gap_ = signed_gap(a_, b_);
    const Gap other = signed_gap(b_, a_);
    hold(has_sign(gap_.gap, relation_.relation), "relation and the gap's sign");
    hold(meet(enclosure_of(gap_), enclosure_of(other)), "gap and exchange");
    const BoundedGap bounded = bounded_gap(a_, b_);
    hold(meet(enclosure_of(gap_), enclosure_of(bounded.gap, bounded.gap_error, bounded.above)),
         "gap and bounded_gap");
    const ContactBounds bounds = contact_bounds(a_, b_, gap_);
    hold(bounds.normal >= 0 && bounds.arm_a >= 0 && bounds.arm_b >= 0, "contact_bounds");
    count(kTiers[static_cast<std::size_t>(gap_.tier)]);
    count(gap_.status == GapStatus::ok ? "status ok" : "status local");
  }

  // By a power of two that takes no number into the subnormals or beyond all doubles.
  void scaled() const {
    const int power = static_cast<int>(choice_ % 801) - 400;
    verify::EllipsoidPair pair = raw_;
    for (verify::RawEllipsoid* body : {&pair.a, &pair.b}) {
      for (auto* triple : {&body->centre, &body->semi_axes}) {
        for (double& x : *triple) {
          const double before = x;
          x = std::ldexp(x, power);
          if (before != 0 && !std::isnormal(x)) return;
          if (before != 0 && !std::isnormal(before)) return;
        }
      }
    }
    const std::optional<Bodies> bodies = bodies_of(pair);
    hold(bodies.has_value(), "a scaled body");
    const RelationAnswer other = relation(bodies->a, bodies->b);
    hold(other.relation == relation_.relation && other.inner == relation_.inner,
         "relation and scaling");
    const Gap gap = signed_gap(bodies->a, bodies->b);
    hold(has_sign(gap.gap, relation_.relation), "the sign of a scaled gap");
    // Where neither of them is beyond the range of doubles or among the subnormals.
    const auto back = [&](double x) { return std::ldexp(Wide(x), -power); };
    const auto is_plain = [](double x) { return x == 0 || std::isnormal(x); };
    if (!is_plain(gap.gap) || !is_plain(gap.gap_error) || gap.status != GapStatus::ok) return;
    hold(meet(enclosure_of(gap_), {back(gap.gap) - back(gap.gap_error) * (1 + kRounded),
                                   back(gap.gap) + back(gap.gap_error) * (1 + kRounded)}),
         "gap and scaling");
    count("scaled");
  }

  // About the origin, and a followed answer.
  void separated() const {
    const Vec3 d = b_.centre() - a_.centre();
    if (!d.allFinite()) return;
    const Ellipsoid here = a_.moved_to(Vec3::Zero()), there = b_.moved_to(Vec3::Zero());
    const Gap gap = signed_gap(here, there, d);
    const RelationAnswer of_d = relation(here, there, d);
    hold(has_sign(gap.gap, of_d.relation), "relation and the gap's sign, separated");
    const Vec3 back = a_.centre() + d, forth = b_.centre() - d;
    if (is_exact(d) && back == b_.centre() && forth == a_.centre())
      hold(of_d.relation == relation_.relation, "relation and separation");
    if (gap.normal.allFinite() && gap.normal.cwiseAbs().maxCoeff() > 0.5) {
      const Gap followed = follow_gap(here, there, d, gap.normal);
      hold(meet(enclosure_of(gap), enclosure_of(followed)), "gap and follow_gap");
      hold(!(followed.gap < 0) || meets(of_d.relation), "follow_gap of bodies that are apart");
    }
  }

  // Is d the unrounded c_B - c_A? [Knuth's sum of two, whose error is a double.]
  bool is_exact(const Vec3& d) const {
    for (int k = 0; k < 3; ++k) {
      const double x = b_.centre()[k], y = -a_.centre()[k], s = d[k], z = s - x;
      if ((x - (s - z)) + (y - z) != 0) return false;
    }
    return true;
  }

  // The pair, and its exchange, at several places of a list.
  void batches() const {
    const std::vector<Ellipsoid> bodies{a_, b_};
    const BodyArray array(bodies);
    constexpr IndexedPair kForth{0, 1}, kBack{1, 0};
    const std::vector<IndexedPair> pairs{kForth, kBack, kForth};
    std::vector<Gap> gaps(pairs.size());
    signed_gaps(array, {pairs, {}}, gaps, accuracy());
    for (std::size_t i = 0; i < pairs.size(); ++i) {
      if (gaps[i].status == GapStatus::beyond) {
        hold(Wide(gaps[i].gap) <= enclosure_of(gap_).high, "a gap beyond the cutoff");
        continue;
      }
      hold(has_sign(gaps[i].gap, relation_.relation), "relation and the sign in a batch");
      hold(meet(enclosure_of(gaps[i]), enclosure_of(gap_)), "gap and batch");
    }
    hold(same_bits(gaps[0], gaps[2]), "places in a batch");
    std::vector<std::uint8_t> overlapping(pairs.size());
    overlaps(array, {pairs, {}}, overlapping);
    for (const std::uint8_t one : overlapping)
      hold(static_cast<bool>(one) == meets(relation_.relation), "relation and overlaps in a batch");
    floats(array, {kForth});
  }

  void floats(const BodyArray& array, const std::vector<IndexedPair>& pairs) const {
    std::vector<float> gaps(pairs.size()), errors(pairs.size());
    FloatGapColumns columns;
    columns.gap = gaps;
    columns.gap_error = errors;
    std::vector<GapStatus> status(pairs.size());
    columns.status = status;
    signed_gaps(array, {pairs, {}}, columns);
    for (std::size_t i = 0; i < pairs.size(); ++i) {
      hold(has_sign(static_cast<double>(gaps[i]), relation_.relation), "the sign in float");
      const double error = static_cast<double>(errors[i]);
      hold(meet(enclosure_of(gap_), enclosure_of(static_cast<double>(gaps[i]), error,
                                                 status[i] == GapStatus::ok ? error : kInfinity)),
           "gap and float columns");
    }
  }

  Accuracy accuracy() const {
    switch (choice_ % 5) {
      case 0:
        return Accuracy::fast();
      case 1:
        return Accuracy::certified();
      case 2:
        return Accuracy::within(1e-3 * a_.smallest_semi_axis());
      case 3:
        return Accuracy::standard().up_to(0.125 * a_.smallest_semi_axis());
      default:
        return Accuracy::standard();
    }
  }

  const std::string& target_;
  const verify::EllipsoidPair& raw_;
  const Ellipsoid &a_, &b_;
  std::uint64_t choice_;
  RelationAnswer relation_{};
  Gap gap_{};
};

}  // namespace

bool meets(Relation relation) {
  return relation != Relation::separate && relation != Relation::external_touch;
}

Enclosure enclosure_of(double gap, double below, double above) {
  const Wide most = std::numeric_limits<Wide>::infinity();
  // Beyond the range of doubles nothing is known but the sign.
  if (!std::isfinite(gap)) return gap > 0 ? Enclosure{0, most} : Enclosure{-most, 0};
  return {Wide(gap) - Wide(below), Wide(gap) + Wide(above)};
}

Enclosure enclosure_of(const Gap& gap) {
  return enclosure_of(gap.gap, gap.gap_error,
                      gap.status == GapStatus::ok ? gap.gap_error : kInfinity);
}

bool meet(const Enclosure& one, const Enclosure& other) {
  const auto below = [](Wide low, Wide high) {
    if (std::isinf(low) || std::isinf(high)) return low < high;
    return low - high <= kRounded * (std::abs(low) + std::abs(high));
  };
  return below(one.low, other.high) && below(other.low, one.high);
}

bool has_sign(double gap, Relation relation) {
  if (relation == Relation::separate) return gap > 0;
  return relation == Relation::external_touch ? gap == 0 : gap < 0;
}

void check_pair(const std::string& target, const verify::EllipsoidPair& raw, const Bodies& bodies,
                std::uint64_t choice) {
  Checks(target, raw, bodies, choice).run();
}

void check_known(const std::string& target, const verify::EllipsoidPair& raw, const Bodies& bodies,
                 const Enclosure& known) {
  if (!meet(enclosure_of(signed_gap(bodies.a, bodies.b)), known))
    broken(target, "the gap as the pair was made: " + row_of(raw));
}

void check_by_oracle(const std::string& target, const verify::EllipsoidPair& raw,
                     const Bodies& bodies) {
  const verify::ExactRelation exact = verify::exact_relation(raw.a, raw.b);
  const RelationAnswer answer = relation(bodies.a, bodies.b);
  if (verify::name(exact.relation) != to_string(answer.relation) ||
      static_cast<int>(exact.inner) != static_cast<int>(answer.inner))
    broken(target, "relation and the oracle: " + row_of(raw));
  count("by the oracle");
}

}  // namespace tangency::testing::fuzz
