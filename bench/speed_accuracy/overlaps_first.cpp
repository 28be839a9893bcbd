// SPDX-License-Identifier: GPL-3.0-or-later
#include <tangency/bench/speed_accuracy/overlaps_first.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <utility>

#include <tangency/verify/families/conversions.hpp>
#include <tangency/verify/families/draw.hpp>

namespace tangency::speed_accuracy {
namespace {

using bench::Columns;
using bench::Pairs;

// Of the mean radius. Chosen: as far as neighbour lists reach, and far above rounding.
constexpr double kFurthest = 0.2, kNearest = 1e-6;
// Of the smallest semi-axis: gaps of the three classes are known and answered better than this.
constexpr double kRight = 1e-9;

double mean_radius(const Ellipsoid& a, const Ellipsoid& b) {
  return 0.5 * (std::cbrt(a.semi_axes().prod()) + std::cbrt(b.semi_axes().prod()));
}

/// Contacts of some of the pairs, and what a way to them works with.
struct Contacts {
  std::vector<std::size_t> index;  ///< of the pairs that were asked for, in order
  std::vector<Gap> gaps;           ///< theirs, of single calls
  Columns columns;                 ///< theirs, of a batch
  std::vector<IndexedPair> list;
  std::vector<Vec3> start;
  std::unique_ptr<bool[]> meet;

  explicit Contacts(std::size_t count)
      : index(count), columns(count), list(count), start(count), meet(new bool[count]) {
    std::iota(index.begin(), index.end(), std::size_t{0});
    gaps.reserve(count);
  }

  bool right(const Pairs& pairs, bool single) const {
    std::vector<std::optional<verify::CallAnswer>> answers(pairs.size());
    for (std::size_t k = 0; k < index.size(); ++k) {
      answers[index[k]] = single ? bench::to_answer(gaps[k]) : columns.answer(k);
    }
    for (std::size_t i = 0; i < pairs.size(); ++i) {
      if (!answers[i] && pairs.truth[i].gap.high < 0) return false;
    }
    const verify::CallGrade grade = bench::grade_without_bounds(pairs, answers);
    return grade.wrong == 0 && grade.gap.largest < kRight && grade.local_error.value_or(0) < kRight;
  }
};

Ahead single_way(const Pairs& p) {
  const auto whole = std::make_shared<Contacts>(p.size()),
             part = std::make_shared<Contacts>(p.size());
  Ahead way{"signed_gap", 0, {}, {}, {}};
  way.all = [&p, whole] {
    whole->gaps.clear();
    for (std::size_t i = 0; i < p.size(); ++i) whole->gaps.push_back(signed_gap(p.a(i), p.b(i)));
  };
  way.asked = [&p, part] {
    part->gaps.clear();
    part->index.clear();
    for (std::size_t i = 0; i < p.size(); ++i) {
      if (!overlaps(p.a(i), p.b(i))) continue;
      part->gaps.push_back(signed_gap(p.a(i), p.b(i)));
      part->index.push_back(i);
    }
  };
  way.right = [&p, whole, part] { return whole->right(p, true) && part->right(p, true); };
  return way;
}

Ahead batch_way(const Pairs& p, bool following, std::int64_t level) {
  const std::size_t count = p.size();
  const auto whole = std::make_shared<Contacts>(count), part = std::make_shared<Contacts>(count);
  Ahead way{following ? "follow_gaps" : "signed_gaps", level, {}, {}, {}};
  way.all = [&p, whole, following, count] {
    if (following)
      follow_gaps(*p.array, {p.list, {}}, p.previous_normal, whole->columns.usual(count));
    else
      signed_gaps(*p.array, {p.list, {}}, whole->columns.usual(count));
  };
  way.asked = [&p, part, following, count] {
    Contacts& c = *part;
    overlaps(*p.array, {p.list, {}}, std::span(c.meet.get(), count));
    c.index.clear();
    for (std::size_t i = 0; i < count; ++i) {
      if (c.meet[i]) c.index.push_back(i);
    }
    const std::size_t met = c.index.size();
    for (std::size_t k = 0; k < met; ++k) c.list[k] = p.list[c.index[k]];
    const std::span<const IndexedPair> list = std::span(c.list).first(met);
    if (!following) return signed_gaps(*p.array, {list, {}}, c.columns.usual(met));
    for (std::size_t k = 0; k < met; ++k) c.start[k] = p.previous_normal[c.index[k]];
    follow_gaps(*p.array, {list, {}}, std::span(c.start).first(met), c.columns.usual(met));
  };
  way.right = [&p, whole, part] { return whole->right(p, false) && part->right(p, false); };
  return way;
}

}  // namespace

std::unique_ptr<Pairs> listed_pairs(const std::string& family, int touching, std::size_t count) {
  const auto kind =
      std::ranges::find(verify::contact_classes(), family, &verify::ContactFamily::name);
  verify::ManufacturedContacts contacts(*kind, bench::kSeed);
  verify::Draw draw(bench::kSeed);
  std::vector<char> touches(count);
  std::fill_n(touches.begin(), count * static_cast<std::size_t>(touching) / 100, 1);
  draw.shuffle(touches);

  auto pairs = std::make_unique<Pairs>();
  pairs->name = family;
  for (std::uint32_t i = 0; i < count; ++i) {
    verify::ManufacturedContact c = contacts.next();
    while (c.gap >= 0) c = contacts.next();
    const Ellipsoid a = verify::to_ellipsoid(c.a);
    Ellipsoid b = verify::to_ellipsoid(c.b);
    double gap = c.gap;
    if (!touches[i]) {
      const auto part = draw.real(kNearest, kFurthest);
      gap = part * mean_radius(a, b);
      b = b.moved_to(b.centre() + (gap - c.gap) * Vec3(c.normal.data()));
    }
    pairs->add(a, b);
    pairs->truth.push_back({.gap = {gap, 0}, .unit = c.smallest_semi_axis});
  }
  pairs->array.emplace(pairs->bodies);
  return pairs;
}

std::vector<Ahead> ways_to_contacts(const Pairs& pairs, std::span<const std::int64_t> levels) {
  std::vector<Ahead> ways = {single_way(pairs)};
  for (const std::int64_t level : levels) {
    for (const bool following : {false, true}) ways.push_back(batch_way(pairs, following, level));
  }
  return ways;
}

}  // namespace tangency::speed_accuracy
