// SPDX-License-Identifier: GPL-3.0-or-later
#include <tangency/bench/speed_accuracy/overlaps_first.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <utility>

#include <tangency/bench/moved_back.hpp>
#include <tangency/bench/speed_accuracy/pairs.hpp>
#include <tangency/verify/families/conversions.hpp>
#include <tangency/verify/families/draw.hpp>
#include <tangency/verify/families/manufactured.hpp>

namespace tangency::speed_accuracy {
namespace {

// Of the mean radius. Chosen: as far as neighbour lists reach, and far above rounding.
constexpr double kFurthest = 0.2, kNearest = 1e-6;
// Of the smallest semi-axis: gaps of the three classes are known and answered better than this.
constexpr double kRight = 1e-9;

double mean_radius(const Ellipsoid& a, const Ellipsoid& b) {
  return 0.5 * (std::cbrt(a.semi_axes().prod()) + std::cbrt(b.semi_axes().prod()));
}

/// What both ways work with.
struct Contacts {
  std::vector<Gap> gaps;  ///< of single calls, as many as asked for
  std::vector<double> gap, gap_error;
  std::vector<Vec3> normal, start;
  std::vector<GapStatus> status;
  std::vector<IndexedPair> list;
  std::vector<std::size_t> index;  ///< of the pairs that were asked for, in order
  std::unique_ptr<bool[]> meet;

  explicit Contacts(std::size_t count)
      : gap(count),
        gap_error(count),
        normal(count),
        start(count),
        status(count),
        list(count),
        meet(new bool[count]) {
    gaps.reserve(count);
    index.reserve(count);
  }
  GapColumns columns(std::size_t count) {
    return {std::span(gap).first(count),
            std::span(gap_error).first(count),
            std::span(normal).first(count),
            {},
            {},
            std::span(status).first(count)};
  }
};

/// Do the gaps, of the pairs of these indices, hold every touching pair's?
template <class GapOf>
bool all_touching(const ListedPairs& pairs, const std::vector<std::size_t>& index,
                  const GapOf& gap_of) {
  std::size_t found = 0;
  for (std::size_t k = 0; k < index.size(); ++k) {
    const std::size_t i = index[k];
    if (!(std::abs(gap_of(k) - pairs.gap[i]) < kRight * pairs.unit[i])) return false;
    found += gap_of(k) < 0;
  }
  const auto touches = [](double gap) { return gap < 0; };
  return found ==
         static_cast<std::size_t>(std::count_if(pairs.gap.begin(), pairs.gap.end(), touches));
}

std::vector<std::size_t> every(std::size_t count) {
  std::vector<std::size_t> index(count);
  for (std::size_t i = 0; i < count; ++i) index[i] = i;
  return index;
}

Ahead single_way(const ListedPairs& p) {
  const std::size_t count = p.list.size();
  const auto whole = std::make_shared<Contacts>(count), part = std::make_shared<Contacts>(count);
  Ahead way{"signed_gap", 0, {}, {}, {}};
  way.all = [&p, whole, count] {
    whole->gaps.clear();
    for (std::size_t i = 0; i < count; ++i)
      whole->gaps.push_back(signed_gap(p.bodies[2 * i], p.bodies[2 * i + 1]));
  };
  way.asked = [&p, part, count] {
    part->gaps.clear();
    part->index.clear();
    for (std::size_t i = 0; i < count; ++i) {
      if (!overlaps(p.bodies[2 * i], p.bodies[2 * i + 1])) continue;
      part->gaps.push_back(signed_gap(p.bodies[2 * i], p.bodies[2 * i + 1]));
      part->index.push_back(i);
    }
  };
  way.right = [&p, whole, part, count] {
    const auto gap_of = [](const Contacts& c) {
      return [&c](std::size_t k) { return c.gaps[k].gap; };
    };
    return all_touching(p, every(count), gap_of(*whole)) &&
           all_touching(p, part->index, gap_of(*part));
  };
  return way;
}

Ahead batch_way(const ListedPairs& p, const BodyArray& array, bool following, std::int64_t level) {
  const std::size_t count = p.list.size();
  const auto whole = std::make_shared<Contacts>(count), part = std::make_shared<Contacts>(count);
  Ahead way{following ? "follow_gaps" : "signed_gaps", level, {}, {}, {}};
  way.all = [&p, &array, whole, following, count] {
    if (following)
      follow_gaps(array, {p.list, {}}, p.previous_normal, whole->columns(count));
    else
      signed_gaps(array, {p.list, {}}, whole->columns(count));
  };
  way.asked = [&p, &array, part, following, count] {
    Contacts& c = *part;
    overlaps(array, {p.list, {}}, std::span(c.meet.get(), count));
    c.index.clear();
    for (std::size_t i = 0; i < count; ++i) {
      if (c.meet[i]) c.index.push_back(i);
    }
    const std::size_t met = c.index.size();
    for (std::size_t k = 0; k < met; ++k) c.list[k] = p.list[c.index[k]];
    const std::span<const IndexedPair> list = std::span(c.list).first(met);
    if (!following) return signed_gaps(array, {list, {}}, c.columns(met));
    for (std::size_t k = 0; k < met; ++k) c.start[k] = p.previous_normal[c.index[k]];
    follow_gaps(array, {list, {}}, std::span(c.start).first(met), c.columns(met));
  };
  way.right = [&p, whole, part, count] {
    const auto gap_of = [](const Contacts& c) { return [&c](std::size_t k) { return c.gap[k]; }; };
    return all_touching(p, every(count), gap_of(*whole)) &&
           all_touching(p, part->index, gap_of(*part));
  };
  return way;
}

}  // namespace

std::span<const int> touching_shares() {
  static constexpr std::array<int, 7> kShares = {0, 10, 25, 50, 75, 90, 100};
  return kShares;
}

ListedPairs listed_pairs(const std::string& family, int touching, std::size_t count) {
  const auto classes = verify::contact_classes();
  const auto shape = std::find_if(classes.begin(), classes.end(),
                                  [&](const auto& kind) { return kind.name == family; });
  verify::ManufacturedContacts contacts(*shape, kSeed);
  verify::Draw draw(kSeed);
  std::vector<char> touches(count);
  std::fill_n(touches.begin(), count * static_cast<std::size_t>(touching) / 100, 1);
  draw.shuffle(touches);

  ListedPairs p{family, touching, {}, {}, {}, {}, {}};
  for (std::uint32_t i = 0; i < count; ++i) {
    verify::ManufacturedContact c = contacts.next();
    while (c.gap >= 0) c = contacts.next();
    const Ellipsoid a = verify::to_ellipsoid(c.a);
    Ellipsoid b = verify::to_ellipsoid(c.b);
    double gap = c.gap;
    if (!touches[i]) {
      gap = draw.real(kNearest, kFurthest) * mean_radius(a, b);
      b = b.moved_to(b.centre() + (gap - c.gap) * Vec3(c.normal.data()));
    }
    p.bodies.push_back(a);
    p.bodies.push_back(b);
    p.list.push_back({2 * i, 2 * i + 1});
    p.gap.push_back(gap);
    p.unit.push_back(c.smallest_semi_axis);
    p.previous_normal.push_back(
        signed_gap(a, bench::moment_ago(b, c.smallest_semi_axis, i)).normal);
  }
  return p;
}

std::vector<Ahead> ways_to_contacts(const ListedPairs& pairs, const BodyArray& array,
                                    std::span<const std::int64_t> levels) {
  std::vector<Ahead> ways = {single_way(pairs)};
  for (const std::int64_t level : levels) {
    for (const bool following : {false, true})
      ways.push_back(batch_way(pairs, array, following, level));
  }
  return ways;
}

}  // namespace tangency::speed_accuracy
